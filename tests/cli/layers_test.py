"""Layers on walls: made, remodelled, checked, converted and drawn by the program."""

import json
import unittest

import shapes
from harness import ProgramTest

LAYERS = ("--layers", "--reynolds", 6.5e6, "--max-spacing", 0.02)


class Layers(ProgramTest):
    def make(self, *options):
        return self.succeed("mesh", "rae2822", *LAYERS, *options, "--json").json()

    def test_a_mesh_is_what_the_contract_says(self):
        mesh = self.make("-o", "a.vtkhdf", "-o", "a.su2")
        layers = mesh["layers"]
        self.assertEqual(mesh["cells"], mesh["triangles"] + mesh["quadrilaterals"])
        self.assertAlmostEqual(layers["first_height"], 4.2e-6, delta=0.2e-6)
        self.assertAlmostEqual(layers["thickness"]["most"], 1.2 * 0.37 * 6.5e6**-0.2, places=12)
        self.assertLessEqual(layers["growth"]["most"], 1.2)
        self.assertGreater(layers["corner_min_deg"], 56)
        self.assertEqual(layers["shrunk"], 0)
        self.assertGreaterEqual(mesh["min_angle_deg"], 30)
        for file, rules in (("a.vtkhdf", "native"), ("a.su2", "topology")):
            check = self.succeed("check", file, "--json").json()
            self.assertTrue(check["valid"])
            self.assertTrue(check["rules"].startswith(rules))
            self.assertEqual(check["quadrilaterals"], mesh["quadrilaterals"])
        self.assertEqual(self.succeed("check", "a.vtkhdf", "--json").json()["layers"], layers)

    def test_a_layer_lives_in_the_native_file(self):
        self.make("-o", "a.vtkhdf")
        for strategy in ("morph", "reference", "renew"):
            with self.subTest(strategy):
                step = self.succeed("update", "a.vtkhdf", "naca:2412", "--strategy", strategy, "-o", "b.vtkhdf",
                                    "-o", "b.su2", "--json").json()
                self.assertTrue(step["same_columns"])
                self.assertGreater(step["connectivity_percent"], 80)
                self.assertTrue(self.succeed("check", "b.vtkhdf", "--json").json()["valid"])
                back = self.succeed("update", "b.vtkhdf", "rae2822", "--strategy", strategy, "-o", "c.vtkhdf",
                                    "--json").json()
                self.assertEqual(back["layers"]["columns"], step["layers"]["columns"])

    def test_by_reference_the_same_design_has_the_same_bytes(self):
        self.succeed("mesh", "naca:2412", *LAYERS, "--refine-angle", 32, "-o", "a.vtkhdf")
        reference = ("--strategy", "reference")
        step = self.succeed("update", "a.vtkhdf", "naca:2413", *reference, "-o", "there.vtkhdf", "--json").json()
        self.assertTrue(step["held"])
        self.succeed("update", "there.vtkhdf", "naca:2412", *reference, "-o", "back.su2")
        self.succeed("convert", "a.vtkhdf", "-o", "a.su2")
        self.assertEqual(self.path("back.su2").read_bytes(), self.path("a.su2").read_bytes())

    def test_an_edge_that_opens_gets_other_columns(self):
        self.make("-o", "a.vtkhdf")
        self.write("blunt.json", '{"degree": 2, "upper": [0.2, 0.2, 0.2], "lower": [-0.2, -0.2, -0.2],'
                                 ' "te_upper": 0.004, "te_lower": -0.004}')
        step = self.succeed("update", "a.vtkhdf", "blunt.json", "-o", "b.vtkhdf", "--json")
        self.assertFalse(step.json()["same_columns"])
        self.assertIn("other columns", step.stderr)
        self.assertTrue(self.succeed("check", "b.vtkhdf", "--json").json()["valid"])

    def test_files_elements_and_triangles(self):
        self.write("a.dat", shapes.selig())
        mesh = self.succeed("mesh", "a.dat", "naca:0012", "--place", "1,0,0,0", "--place", "0.3,-20,0.98,-0.06", "--name",
                            "main", "--name", "flap", *LAYERS, "--layer-cells", "triangles", "-o", "m.su2",
                            "-o", "m.vtkhdf", "--json").json()
        self.assertEqual(mesh["quadrilaterals"], 0)
        self.assertEqual(self.succeed("check", "m.vtkhdf", "--json").json()["triangles"], mesh["triangles"])
        given = self.succeed("mesh", "a.dat", "--as-given", "spline", *LAYERS, "-o", "g.vtkhdf", "--json").json()
        self.assertGreater(given["layers"]["columns"], 100)
        self.succeed("draw", "g.vtkhdf", "-o", "g.png")

    def duct(self, height=0.1):
        line = lambda name, a, b, n: {"name": name, "shape": {"kind": "line", "from": a, "to": b}, "stations": n}
        wall = {"kind": "spline", "points": [[0, 0], [0.8, 0.01], [1.5, height], [2.2, 0.01], [3, 0]]}
        self.write(f"duct{height}.json", json.dumps({"loops": [{"role": "outer", "curves": [
            {"name": "wall", "shape": wall, "stations": 90}, line("outlet", [3, 0], [3, 1], 5),
            line("roof", [3, 1], [0, 1], 40), line("inlet", [0, 1], [0, 0], 5)]}]}))
        return f"duct{height}.json"

    def test_walls_of_a_duct_end_at_its_inlet_and_outlet(self):
        mesh = self.succeed("mesh", self.duct(), "--layers", "--reynolds", 1e5, "-o", "a.vtkhdf", "-o", "a.su2", "-o", "a.msh",
                            "-o", "a.foam", "--json").json()
        self.assertEqual(mesh["layers"]["columns"], 91 + 41)
        for file in ("a.vtkhdf", "a.su2", "a.msh"):
            check = self.succeed("check", file, "--json").json()
            self.assertTrue(check["valid"], check["violations"])
            self.assertEqual(check["quadrilaterals"], mesh["quadrilaterals"])
            self.assertEqual(check["boundary"]["wall"], 90)
            self.assertGreaterEqual(check["boundary"]["inlet"], 2 * mesh["layers"]["levels"] + 4)
        self.succeed("draw", "a.vtkhdf", "--window=-0.01,-0.01,0.1,0.1", "-o", "corner.png")
        for strategy in ("renew", "morph", "reference"):
            step = self.succeed("update", "a.vtkhdf", self.duct(0.102), "--strategy", strategy, "-o", "b.vtkhdf", "--json").json()
            self.assertTrue(step["same_columns"])
            self.assertTrue(self.succeed("check", "b.vtkhdf", "--json").json()["valid"])
        one = self.succeed("mesh", self.duct(), "--layers", "--reynolds", 1e5, "--layer-wall", "roof", "-o", "c.su2", "--json").json()
        self.assertEqual(one["layers"]["columns"], 41)

    def test_a_count_of_cells_in_place_of_a_thickness(self):
        layers = self.succeed("mesh", "naca:0012", "--layers", "--first-height", 1e-4, "--layer-count", 12, "--growth",
                              1.3, "-o", "m.su2", "--json").json()["layers"]
        self.assertEqual(layers["levels"], 12)
        self.assertAlmostEqual(layers["growth"]["most"], 1.3, places=9)
        self.assertEqual(layers["first_height"], 1e-4)

    def test_what_makes_no_sense_is_refused(self):
        for options, word in (
            (("--layers",), "--reynolds"),
            (("--reynolds", 1e6), "--layers"),
            (("--layers", "--y-plus", 1), "--reynolds"),
            (("--wake", 1), "--layers"),
            ((*LAYERS, "--wake-angle", 3), "--wake"),
            (("--wake-angle", 3), "--layers"),
            (("--layers", "--first-height", 1e-5, "--y-plus", 1), "--first-height"),
            ((*LAYERS, "--layer-count", 3, "--layer-thickness", 0.1), "--layer-count"),
            ((*LAYERS, "--points", 100), "--points"),
            ((*LAYERS, "--growth", 3), "--growth"),
        ):
            with self.subTest(options):
                self.refused("mesh", "naca:0012", *options, "-o", "m.su2", names=word)
        self.make("-o", "a.vtkhdf")
        self.refused("update", "a.vtkhdf", "naca:0012", "--points", 100, "-o", "b.su2", names="--points")
        for command, options in (("batch", ("--boundary", "airfoil")), ("batch", LAYERS), ("batch", ("--dissolve-layers",)),
                                 ("optimise", LAYERS), ("optimise", ("--points", 100)), ("optimise", ("--gradation", 4))):
            with self.subTest(command, options=options):
                shapes = ("a.vtkhdf", "naca:0012") if command == "batch" else ("--mesh", "a.vtkhdf", "--to", "naca:0012")
                self.refused(command, *shapes, *options, "-o", "run", names=options[0])
        self.refused("optimise", "--from", "naca:0012", "--to", "rae2822", "--layers", "-o", "run", names="--reynolds")
        self.refused("optimise", "--from", "naca:0012", "--to", "rae2822", *LAYERS, "--points", 60, "-o", "run", names="--points")
        self.assertFalse(self.path("run").exists())

    def test_a_batch_of_layered_meshes(self):
        self.make("-o", "a.vtkhdf")
        batch = self.figures("batch", "a.vtkhdf", "naca:2412", "naca:0012", "rae2822", "-o", "out", "--meshes", "vtkhdf,su2")
        self.assertEqual(batch["strategy"], "morph")
        self.assertEqual(batch["invalid_meshes"], 0)
        in_order = sorted(batch["designs"], key=lambda design: design["position"])
        for design in in_order:
            for mesh in design["meshes"]:
                checked = self.figures("check", f"out/{mesh}")
                self.assertTrue(checked["valid"])
                self.assertEqual((checked["triangles"], checked["quadrilaterals"]), (design["triangles"], design["quadrilaterals"]))
            self.assertEqual(design["cells"], design["triangles"] + design["quadrilaterals"])
            self.assertGreater(design["connectivity_percent"], 90)
        for before, after in zip(in_order, in_order[1:]):
            self.assertEqual(after["cells_before"], before["cells"])
        # One step of it is what `update` makes.
        self.succeed("update", "a.vtkhdf", in_order[0]["shape"], "--strategy", "morph", "-o", "u.vtkhdf")
        self.assertEqual(self.path("u.vtkhdf").read_bytes(), self.path("out/" + in_order[0]["meshes"][0]).read_bytes())
        triangles = self.figures("batch", "a.vtkhdf", "naca:0012", "-o", "triangles", "--layer-cells", "triangles")
        self.assertEqual(triangles["designs"][0]["quadrilaterals"], 0)

    def test_a_batch_puts_layers_on_a_mesh_without(self):
        self.succeed("mesh", "naca:0012", "-o", "plain.vtkhdf")
        batch = self.figures("batch", "plain.vtkhdf", "naca:0013", *LAYERS, "--wake", 1, "-o", "out", "--meshes", "vtkhdf")
        self.assertGreater(batch["layers"]["columns"], 100)
        checked = self.figures("check", "out/001.vtkhdf")
        self.assertTrue(checked["valid"])
        self.assertGreater(checked["boundary"]["wake"], 20)

    def test_a_run_around_layers(self):
        run = ("optimise", "--from", "naca:0012", "--to", "rae2822", *LAYERS, "--wake", 1, "--evaluations", 30, "--checkpoint-every", 10)
        figures = self.figures(*run, "-o", "run", "--quiet")
        self.assertEqual((figures["invalid_meshes"], figures["evaluations"]), (0, 30))
        self.assertEqual(figures["options"]["strategy"], "morph")
        for name in ("first", "middle", "last"):
            checked = self.figures("check", f"run/{name}.vtkhdf")
            self.assertTrue(checked["valid"])
            self.assertEqual(checked["layers"]["columns"], figures["layers"]["columns"])
            self.assertGreater(checked["boundary"]["wake"], 20)
        self.succeed("film", "run", "--frames", 4, "-o", "film.webp")
        on = self.figures("optimise", "--mesh", "run/last.vtkhdf", "--to", "rae2822", "--evaluations", 5, "-o", "on", "--quiet")
        self.assertEqual(on["invalid_meshes"], 0)
        self.assertEqual(on["start"]["cells"], self.figures("check", "run/last.vtkhdf")["quadrilaterals"] + checked["triangles"])
        # What is not the run's own layer cannot be gone on with.
        self.refused(*run[:-3], 40, "--resume", "--growth", 1.3, "-o", "run", "--quiet", names="layers")

    def test_programs_of_a_run_see_the_cells_that_are_asked_for(self):
        kinds = "import json, sys; lines = open(sys.argv[1]).read().split('NPOIN')[0].splitlines()[2:]; "
        program = kinds + "print(json.dumps({'objective': sum(line.startswith('9 ') for line in lines)}))"
        self.write("kinds.py", program)
        run = ("optimise", "--from", "naca:0012", *LAYERS, "--evaluate", "python3 kinds.py {mesh}", "--quiet", "--evaluations", 2)
        self.assertGreater(self.figures(*run, "-o", "quads")["objective"], 100)
        self.assertEqual(self.figures(*run, "--layer-cells", "triangles", "-o", "triangles")["objective"], 0)
        self.refused(*run[:-1], 4, "--resume", "-o", "triangles", names="found others: layer_cells")

    def test_a_line_in_the_wake(self):
        plain = self.make()
        mesh = self.make("--wake", 1, "--wake-angle", 3, "-o", "a.vtkhdf")
        self.assertEqual(mesh["layers"]["columns"], plain["layers"]["columns"])
        self.assertEqual(mesh["layers"]["thickness"], plain["layers"]["thickness"])
        self.assertGreater(mesh["boundary"]["wake"], 20)
        for strategy in ("morph", "reference", "renew"):
            with self.subTest(strategy):
                step = self.figures("update", "a.vtkhdf", "naca:2412", "--strategy", strategy, "-o", "b.vtkhdf")
                self.assertTrue(step["same_columns"])
                check = self.figures("check", "b.vtkhdf")
                self.assertTrue(check["valid"])
                self.assertGreater(check["boundary"]["wake"], 20)

    def test_a_line_in_the_wake_goes_with_its_airfoil(self):
        self.make("--wake", 1, "--wake-angle", 3, "-o", "a.vtkhdf")
        wake = self.figures("check", "a.vtkhdf")["boundary"]["wake"]
        for place in ("1,0,0,0", "1.3,0,0,0", "0.7,5,0.1,0.2"):
            with self.subTest(place):
                self.figures("update", "a.vtkhdf", "naca:2412", "--place", place, "-o", "b.vtkhdf")
                check = self.figures("check", "b.vtkhdf")
                self.assertTrue(check["valid"])
                self.assertAlmostEqual(check["boundary"]["wake"], wake, delta=0.5 * wake)

    def test_a_step_counts_its_own_cells_whatever_files_hold(self):
        self.make("-o", "a.vtkhdf")
        counts = [self.figures("update", "a.vtkhdf", "naca:2412", "--layer-cells", cells, "-o", "b.su2")
                  for cells in ("quads", "triangles")]  # fmt: skip
        for key in ("cells_before", "cells", "triangles", "quadrilaterals", "born", "gone"):
            self.assertEqual(counts[0][key], counts[1][key], key)
        self.assertEqual(counts[0]["cells"], counts[0]["cells_before"] + counts[0]["born"] - counts[0]["gone"])

    def test_fates_of_cells(self):
        self.make("-o", "a.vtkhdf")
        self.succeed("update", "a.vtkhdf", "naca:2412", "-o", "b.vtkhdf")
        self.succeed("draw", "b.vtkhdf", "--color", "fate", "--since", "a.vtkhdf", "-o", "b.png")


if __name__ == "__main__":
    unittest.main()
