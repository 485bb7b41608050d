"""Layers on walls: made, remodelled, checked, converted and drawn by the program."""

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
            (("--layers", "--first-height", 1e-5, "--y-plus", 1), "--first-height"),
            ((*LAYERS, "--layer-count", 3, "--layer-thickness", 0.1), "--layer-count"),
            ((*LAYERS, "--points", 100), "--points"),
            ((*LAYERS, "--growth", 3), "--growth"),
        ):
            with self.subTest(options):
                self.refused("mesh", "naca:0012", *options, "-o", "m.su2", names=word)
        self.make("-o", "a.vtkhdf")
        self.refused("update", "a.vtkhdf", "naca:0012", "--points", 100, "-o", "b.su2", names="--points")
        self.refused("batch", "a.vtkhdf", "naca:0012", "-o", "run", names="a mesh with layers found")


if __name__ == "__main__":
    unittest.main()
