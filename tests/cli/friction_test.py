"""Flows with friction, by the program."""

import csv
import json
import math
import unittest

from harness import ProgramTest

LAYERS = ("--layers", "--reynolds", 5000, "--y-plus", 0.5, "--max-spacing", 0.04, "--wall-spacing", 0.008,
          "--te-spacing", 0.008)


class Friction(ProgramTest):
    def test_a_duct_gets_its_layer_by_itself(self):
        line = lambda name, a, b, n: {"name": name, "shape": {"kind": "line", "from": a, "to": b}, "stations": n}
        self.write("channel.json", json.dumps({"loops": [{"role": "outer", "curves": [
            line("floor", [0, 0], [3, 0], 60), line("behind", [3, 0], [3, 1], 4), line("roof", [3, 1], [0, 1], 60),
            line("ahead", [0, 1], [0, 0], 4)]}]}))  # fmt: skip
        flow = self.succeed("flow", "channel.json", "--model", "laminar", "--mach", 0.03, "--reynolds", 20, "--inlet", "ahead",
                            "--outlet", "behind", "--pressure", 0.9976, "--wall-table", "wall.csv", "--json").json()
        self.assertTrue(flow["converged"])
        mean = -next(o["mass_flow"] for o in flow["openings"] if o["name"] == "behind") / 0.03
        rows = [row for row in csv.DictReader(self.path("wall.csv").open()) if float(row["x"]) > 1.5]
        self.assertEqual({row["wall"] for row in rows}, {"floor", "roof"})
        for row in rows:  # Poiseuille's
            self.assertAlmostEqual(float(row["cf"]) / (12 * mean / 20), 1.0, delta=0.04)

    def test_laminar_flow_on_a_mesh_with_a_layer(self):
        self.succeed("mesh", "naca:0012", *LAYERS, "-o", "a.vtkhdf")
        flow = self.succeed("flow", "a.vtkhdf", "--model", "laminar", "--mach", 0.5, "--reynolds", 5000,
                            "--tolerance", 1e-8, "--cf-plot", "cf.svg", "--wall-table", "wall.csv",
                            "--profiles", "profiles.csv", "--profiles-at", "0.3,0.7",
                            "-o", "b.vtkhdf", "--json").json()
        self.assertTrue(flow["converged"])
        self.assertEqual(flow["model"], "laminar")
        self.assertEqual(flow["reynolds"], 5000)
        self.assertAlmostEqual(flow["cd_pressure"] + flow["cd_friction"], flow["cd"], places=12)
        self.assertAlmostEqual(flow["cd"], 0.055, delta=0.004)
        self.assertAlmostEqual(flow["cl"], 0.0, delta=2e-3)
        self.assertGreater(flow["y_plus_max"], 0)
        self.assertIn("<svg", self.path("cf.svg").read_text())
        self.assertIn("wall.csv", " ".join(flow["written"]))
        rows = list(csv.DictReader(self.path("wall.csv").open()))
        self.assertAlmostEqual(max(float(row["y_plus"]) for row in rows), flow["y_plus_max"], places=12)
        middle = [row for row in rows if 0.2 < float(row["x"]) < 0.4]
        self.assertGreater(len(middle), 5)
        for row in middle:  # Blasius's is 2.59; it grows towards separation
            self.assertTrue(2 < float(row["shape_factor"]) < 4, row)

        profiles = list(csv.DictReader(self.path("profiles.csv").open()))
        self.assertEqual({row["place"] for row in profiles}, {"0.3", "0.7"})
        self.assertEqual(len({(row["x"], row["y"]) for row in profiles}), 4)
        for row in profiles:
            if float(row["height"]) == 0:
                self.assertEqual((float(row["speed"]), float(row["u_plus"])), (0, 0))
        self.assertAlmostEqual(max(float(row["speed"]) for row in profiles), 1.15, delta=0.1)

    def test_profiles_at_both_ends_are_of_both_sides_and_need_columns(self):
        options = ("--model", "laminar", "--mach", 0.3, "--reynolds", 500, "--profiles", "p.csv", "--profiles-at", "0,1")
        layer = ("--layers", "--first-height", 5e-3, "--growth", 1.5, "--layer-thickness", 0.1, "--max-spacing", 0.08,
                 "--wall-spacing", 0.02, "--te-spacing", 0.02, "--farfield-radius", 10)  # fmt: skip
        self.succeed("mesh", "naca:0012", *layer, "-o", "quads.vtkhdf")
        self.succeed("mesh", "naca:0012", *layer, "--layer-cells", "triangles", "-o", "triangles.su2")
        self.succeed("flow", "quads.vtkhdf", *options)
        rows = list(csv.DictReader(self.path("p.csv").open()))
        self.assertEqual(len({(row["place"], row["x"], row["y"]) for row in rows}), 4)
        self.assertIn("no columns of quadrilaterals", self.succeed("flow", "triangles.su2", *options).stderr)

    def test_layers_are_in_chords_where_coordinates_are_kept(self):
        points = [(0.5 + 0.5 * math.cos(math.pi * i / 20), 0.3 * math.sin(math.pi * i / 20) * 0.2) for i in range(41)]
        counts = []
        for chord in (1, 10):
            self.write("a.dat", "ellipse\n" + "".join(f"{chord * x:.9f} {chord * y:.9f}\n" for x, y in points))
            figures = self.figures("mesh", "a.dat", "--as-given", "spline", "--keep-coordinates", "--layers", "--reynolds", 1e4)
            counts.append((figures["layers"]["columns"], figures["layers"]["levels"]))
            self.assertAlmostEqual(figures["layers"]["first_height"] / chord, 0.0017, delta=0.0001)
        self.assertEqual(*counts)

    def test_estimates_of_errors(self):
        self.succeed("mesh", "naca:0012", "--layers", "--first-height", 3e-3, "--growth", 1.5, "--layer-thickness", 0.085,
                     "--max-spacing", 0.06, "--wall-spacing", 0.012, "--te-spacing", 0.012, "-o", "a.vtkhdf")  # fmt: skip
        flow = self.figures("flow", "a.vtkhdf", "--model", "laminar", "--mach", 0.5, "--reynolds", 5000, "--alpha", 1,
                            "--tolerance", 1e-8, "--error")  # fmt: skip
        # Of the mesh with all lengths a quarter of these, 1.5^(1/4) the growth and 32 the gradation: 13,133 vertices.
        for key, fine in (("cl", 0.0203034), ("cd", 0.0567236)):
            lack = fine - flow[key]
            self.assertAlmostEqual(flow["error"][key], lack, delta=0.4 * abs(lack))
        self.assertGreater(flow["error"]["finer"]["vertices"], 3 * flow["vertices"])

    def test_heat_passes_walls_with_a_temperature(self):
        self.succeed("mesh", "naca:0012", *LAYERS, "-o", "a.vtkhdf")
        heat = {}
        for warmth in (0.9, 1.2):
            flow = self.succeed("flow", "a.vtkhdf", "--model", "laminar", "--mach", 0.5, "--reynolds", 5000,
                                "--wall-temperature", warmth, "--wall-table", f"{warmth}.csv", "--json").json()
            self.assertTrue(flow["converged"])
            self.assertEqual(flow["wall_temperature"], warmth)
            heat[warmth] = flow["heat"]
            rows = list(csv.DictReader(self.path(f"{warmth}.csv").open()))
            place = [(float(row["x"]), float(row["y"])) for row in rows]
            ch = [float(row["ch"]) for row in rows]
            around = range(len(rows))
            whole = sum(ch[i] * 0.5 * (math.dist(place[i - 1], place[i]) + math.dist(place[i], place[(i + 1) % len(rows)]))
                        for i in around)  # fmt: skip
            self.assertAlmostEqual(whole, heat[warmth], delta=1e-9)
        self.assertGreater(heat[0.9], 0)
        # The gas recovers about 1.04 of the stream's temperature: 0.16 below the warm wall's, 0.14 above the cold one's.
        self.assertAlmostEqual(heat[1.2] / heat[0.9], -0.16 / 0.14, delta=0.15)

    def test_a_domain_in_other_units_has_the_same_flow(self):
        """The layer of a domain's walls, too, is that of its reference length."""
        flows = []
        for chord in (1, 1024):
            self.write("a.json", json.dumps({"loops": [
                {"airfoil": "naca:0012", "stations": 80, "placement": {"chord": chord, "rotation_deg": 0, "position": [0, 0]}},
                {"role": "outer", "curves": [{"name": "farfield", "stations": 40, "shape": {
                    "kind": "arc", "centre": [chord / 2, 0], "radius": 15 * chord, "start": 0, "sweep": 2 * math.pi}}]}]}))  # fmt: skip
            flows.append(self.figures("flow", "a.json", "--model", "laminar", "--mach", 0.3, "--reynolds", 2000, "--alpha", 2,
                                      "--growth", 1.4, "--reference-length", chord, "--reference", f"{chord / 4},0"))  # fmt: skip
        for key in ("cl", "cd", "cd_friction", "cm", "y_plus_max"):
            self.assertAlmostEqual(flows[1][key] / flows[0][key], 1.0, delta=1e-3, msg=key)

    def test_cells_too_high_are_told_of_in_every_model(self):
        options = ("--mach", 0.3, "--reynolds", 1e5, "--layer-thickness", 0.05, "--max-spacing", 0.06, "--wall-spacing", 0.015,
                   "--te-spacing", 0.015)  # fmt: skip
        for model, height, sentence in (("laminar", 0.002, "of the friction acts across the wall"), ("sa", 0.01, "y+ of the cells at the wall")):
            flow = self.succeed("flow", "naca:0012", "--model", model, *options, "--first-height", height, "--json")
            self.assertIn(sentence, " ".join(flow.json()["warnings"]) + flow.stderr, model)

    def test_laminar_friction_is_told_from_pressure_at_low_reynolds_and_mach_numbers(self):
        options = ("--model", "laminar", "--reynolds", 500, "--mach", 0.03, "--max-spacing", 0.06, "--wall-spacing", 0.004,
                   "--te-spacing", 0.01, "--growth", 1.4)  # fmt: skip
        parts = {}
        for name, height in (("usual", ()), ("fine", ("--first-height", 1e-4)), ("high", ("--first-height", 8e-3))):
            flow = self.figures("flow", "naca:0012", *options, *height)
            parts[name] = flow["cd_pressure"] / flow["cd"]
            told = any("acts across the wall" in warning for warning in flow["warnings"])
            self.assertEqual(told, name == "high", name)
        self.assertAlmostEqual(parts["usual"], parts["fine"], delta=0.03 * parts["fine"])
        self.assertGreater(parts["high"], 1.3 * parts["fine"])

    def test_a_section_and_a_stream_that_turn_together_have_the_same_flow(self):
        options = ("--model", "sa", "--mach", 0.2, "--reynolds", 1e6, "--max-spacing", 0.06, "--wall-spacing", 0.01, "--te-spacing", 0.01,
                   "--growth", 1.4, "--farfield-radius", 15)  # fmt: skip
        level = self.figures("flow", "naca:2412", *options, "--alpha", 2)
        turned = self.figures("flow", "naca:2412", *options, "--place", "1,60,0,0", "--alpha", 62)
        self.assertAlmostEqual(turned["cl"], level["cl"], delta=0.02 * level["cl"])
        self.assertAlmostEqual(turned["cd"], level["cd"], delta=0.02 * level["cd"])
        self.assertLess(turned["newton_steps"], level["newton_steps"] + 10)

    def test_each_body_has_its_parts_of_the_drag(self):
        self.succeed("mesh", "naca:0012", "naca:0012", "--place", "0.7,0,0,0", "--place", "0.3,-10,0.72,-0.02", *LAYERS,
                     "-o", "a.vtkhdf")  # fmt: skip
        flow = self.figures("flow", "a.vtkhdf", "--model", "laminar", "--mach", 0.3, "--reynolds", 2000)
        self.assertEqual(len(flow["bodies"]), 2)
        for key in ("cd", "cd_pressure", "cd_friction"):
            self.assertAlmostEqual(sum(body[key] for body in flow["bodies"]), flow[key], places=12)
        self.assertEqual(max(body["y_plus_max"] for body in flow["bodies"]), flow["y_plus_max"])

    def test_a_row_of_designs_on_layers_without_friction(self):
        self.succeed("mesh", "naca:0012", *LAYERS, "-o", "a.vtkhdf")
        designs = []
        for shape in ("naca:0012", "naca:1412"):
            fitted = self.succeed("fit", shape, "--json").json()
            designs.append({key: fitted[key] for key in ("degree", "upper", "lower")})
        self.write("designs.json", json.dumps(designs))
        row = self.figures("flow", "a.vtkhdf", "--mach", 0.3, "--alpha", 1, "--series", "designs.json")
        self.assertEqual((row["flows"], row["not_converged"]), (2, 0))
        for shape, entry in zip(("naca:0012", "naca:1412"), row["designs"]):
            self.succeed("update", "a.vtkhdf", shape, "--strategy", "renew", "-o", "b.vtkhdf")
            alone = self.figures("flow", "b.vtkhdf", "--mach", 0.3, "--alpha", 1)
            self.assertAlmostEqual(entry["cl"], alone["cl"], delta=2e-3)

    def test_rows_of_designs_and_gradients(self):
        """The slope of CD along a line of designs, by the adjoint, is that of the row's flows."""
        self.succeed("mesh", "naca:0012", "--cst-degree", 3, *LAYERS, "-o", "a.vtkhdf")
        options = ("--model", "laminar", "--mach", 0.5, "--alpha", 1, "--reynolds", 5000)
        fitted = self.succeed("fit", "naca:0012", "--cst-degree", 3, "--json").json()
        airfoil = {key: fitted[key] for key in ("degree", "upper", "lower")}
        step = 1e-4
        designs = [{**airfoil, "upper": [airfoil["upper"][0] + place * step, *airfoil["upper"][1:]]} for place in (-1, 0, 1)]
        self.write("designs.json", json.dumps(designs))
        row = self.succeed("flow", "a.vtkhdf", *options, "--series", "designs.json", "--json").json()
        self.assertEqual((row["flows"], row["not_converged"], row["model"]), (3, 0, "laminar"))
        self.assertEqual(row["designs"][2]["warm"], "carried")
        flow = self.succeed("flow", "a.vtkhdf", *options, "--gradient", "--json").json()
        self.assertAlmostEqual(flow["cd"], row["designs"][1]["cd"], delta=1e-9)
        gradient = flow["gradient"]
        self.assertEqual(gradient["names"][0], "airfoil.upper[0]")
        # The row's interior, by `morph`, moves a little otherwise than the gradient's, which goes as by `reference`.
        beside = []
        for design in (designs[0], designs[2]):
            self.succeed("update", "a.vtkhdf", self.write("b.json", json.dumps(design)), "--strategy", "reference", "-o", "b.vtkhdf")
            beside.append(self.figures("flow", "b.vtkhdf", *options))
        for key in ("cd", "cd_pressure"):
            for first, last, part in ((row["designs"][0], row["designs"][2], 1e-3), (*beside, 1e-4)):
                slope = (last[key] - first[key]) / (2 * step)
                self.assertAlmostEqual(gradient[key][0], slope, delta=part * abs(slope))
        self.assertLess(gradient["reynolds"]["cd"], 0)

    def test_the_page_of_a_design_parts_its_drag(self):
        problem = {"airfoil": "naca:0012", "degree": 3, "flow": [{"mach": 0.5, "alpha_deg": 1, "model": "laminar", "reynolds": 5000}],
                   "mesh": {"points": 150, "layers": {"first_height": 2e-3}}, "objective": "friction_drag", "verify": [150],
                   "designer": {"evaluations": 2}}  # fmt: skip
        self.write("problem.json", json.dumps(problem))
        figures = self.succeed("design", "problem.json", "-o", "run", "--json", status=3).json()
        self.assertAlmostEqual(figures["cd_pressure"] + figures["cd_friction"], figures["cd"], places=12)
        self.succeed("design", "report", "run")
        page = self.path("run/report.html").read_text()
        self.assertIn(" quadrilaterals", page)
        self.assertIn("<h2>Friction</h2>", page)
        (fresh,) = figures["verified"]
        for part in (figures["cd_pressure"], figures["cd_friction"], fresh["cd_pressure"], fresh["cd_friction"]):
            self.assertIn(f"<td>{1e4 * part:.2f}</td>", page)

    def test_a_flow_takes_the_sizes_of_its_layer(self):
        sizes = (*LAYERS[3:], "--wake", 0.5, "--wake-angle", 2)
        conditions = ("--model", "laminar", "--mach", 0.5, "--reynolds", 5000, "--layer-thickness", 0.1, "--growth", 1.4,
                      "--tolerance", 1e-4, "--json")  # fmt: skip
        self.succeed("mesh", "naca:0012", *LAYERS, *sizes[8:], "--layer-thickness", 0.1, "--growth", 1.4, "-o", "a.vtkhdf")
        of_a_mesh = self.succeed("flow", "a.vtkhdf", *conditions[:6], *conditions[10:]).json()
        of_a_shape = self.succeed("flow", "naca:0012", *sizes, *conditions).json()
        self.assertEqual(of_a_shape["cd"], of_a_mesh["cd"])
        self.assertEqual(of_a_shape["vertices"], of_a_mesh["vertices"])
        row = self.succeed("polar", "naca:0012", *sizes, *conditions, "--alpha", 0).json()["points"][0]
        self.assertEqual(row["cd"], of_a_mesh["cd"])
        self.refused("flow", "a.vtkhdf", *conditions, names="given with a mesh, which has its own")

    def test_what_does_not_fit_is_refused(self):
        for words, message in (
            (("--growth", 1.3), "--growth: given without friction"),
            (("--wake", 1), "--wake: given without friction"),
            (("--model", "sa", "--reynolds", 1e6, "--wake-angle", 3), "--wake-angle: given without --wake"),
            (("--model", "potential", "--y-plus", 1), "--y-plus: given without friction"),
            (("--model", "sa", "--reynolds", 1e6, "--y-plus", 1, "--first-height", 1e-5), "--first-height: given with --y-plus"),
            (("--model", "sa"), "--reynolds: not given"),
            (("--model", "laminar", "--reynolds", 1e6, "--transition", "0.1,0.2"), "--transition: given without turbulence"),
            (("--transition", "0.1,0.2"), "--transition: given without turbulence"),
            (("--model", "sa", "--reynolds", 1e6, "--transition", "0.1,1.2"), "--transition: found '0.1,1.2'"),
            (("--model", "sa", "--reynolds", 1e6, "--transition", "0.1"), "--transition: found '0.1'"),
            (("--reynolds", 1e6), "--reynolds: given without friction"),
            (("--wall-table", "a.csv"), "--wall-table: given without friction"),
            (("--wall-temperature", 1.1), "--wall-temperature: given without friction"),
            (("--model", "potential", "--wall-temperature", 1.1), "--wall-temperature: given without friction"),
            (("--model", "laminar", "--reynolds", 1e6, "--wall-temperature", 0), "--wall-temperature: found '0'"),
            (("--model", "sa", "--reynolds", 1e6, "--wall-table", "a.txt"), "a.txt"),
            (("--profiles", "a.csv"), "--profiles: given without friction"),
            (("--model", "sa", "--reynolds", 1e6, "--profiles-at", "0.5"), "--profiles-at: given without --profiles"),
            (("--model", "sa", "--reynolds", 1e6, "--profiles", "a.csv", "--profiles-at", "1.5"), "--profiles-at: found '1.5'"),
            (("--model", "sa", "--reynolds", 1e6, "--cf-plot", "a.svg", "--series", "x.json"), "--series: given with a file"),
            (("--model", "sa", "--reynolds", 1e6, "--error", "--series", "designs.json"), "--error: given with --series"),
            (("--model", "sa", "--reynolds", 1e6, "--points", 100), "--points: given with a model with friction"),
        ):
            with self.subTest(message):
                self.refused("flow", "naca:0012", "--mach", 0.3, *words, names=message)


if __name__ == "__main__":
    unittest.main()
