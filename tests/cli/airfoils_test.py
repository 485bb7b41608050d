"""Coordinate files of airfoils as they are found: blunt, with remarks, turned, in pieces, fitted or as given."""

import json
import math
import pathlib

import harness
import shapes
from harness import ProgramTest, main


def blunt(gap, incline=0.0, half=20):
    """NACA 0012 with a trailing edge that is open by `gap` chords, its chord line inclined."""
    points = shapes.selig_points(half)
    nose = len(points) // 2
    return [(x, y + (0.5 if i < nose else -0.5) * gap * x + incline * x) for i, (x, y) in enumerate(points)]


FILES = pathlib.Path(__file__).resolve().parents[1] / "airfoils"


def placed(points, chord, degrees, x, y):
    c, s = chord * math.cos(math.radians(degrees)), chord * math.sin(math.radians(degrees))
    return [(x + c * a - s * b, y + s * a + c * b) for a, b in points]


def rows_of(points):
    return "".join(f"{x:.9f} {y:.9f}\n" for x, y in points)


class Airfoils(ProgramTest):
    def points_of(self, mesh):
        self.succeed("convert", mesh, "-o", "x.su2")
        lines = self.path("x.su2").read_text().splitlines()
        return [tuple(map(float, line.split()[:2])) for line in lines if len(line.split()) == 3]

    def assert_points(self, mesh, wanted, within=1e-7):
        found = self.points_of(mesh)
        for x, y in wanted:
            nearest = min(math.hypot(x - a, y - b) for a, b in found)
            self.assertLess(nearest, within, (x, y))

    def test_a_symmetric_file_without_a_point_on_the_nose_is_fitted_symmetric(self):
        file = FILES / "nose_between_points.dat"
        fit = self.figures("fit", file)
        self.assertLess(abs(fit["camber"]["value"]), 1e-9)
        self.assertLess(fit["max_error"], 5e-4)
        self.assertEqual(fit["warnings"], [])
        for upper, lower in zip(fit["upper"], fit["lower"]):
            self.assertAlmostEqual(upper, -lower, places=9)
        flow = self.figures("flow", file, "--model", "potential", "--alpha", 0)
        self.assertLess(abs(flow["cl"]), 0.005)

    def test_a_section_drawn_at_an_incidence_keeps_it_and_says_so(self):
        file = FILES / "drawn_at_8_degrees.dat"
        outcome = self.run_program("fit", file, "--json")
        self.assertIn("8.0 degrees", outcome.stderr)
        fit = outcome.json()
        self.assertAlmostEqual(fit["frame"]["turned_deg"], 8.0, delta=0.02)
        self.assertEqual(len(fit["warnings"]), 1)
        self.assertLess(fit["max_error"], 5e-4)
        lift = []
        for options in ([], ["--as-given", "spline"], ["--keep-coordinates"]):
            flow = self.figures("flow", file, *options, "--model", "potential", "--alpha", 0)
            lift.append(flow["cl"])
        for cl in lift:
            self.assertAlmostEqual(cl / lift[1], 1.0, delta=0.05)
        self.assertGreater(lift[0], 1.0)
        self.succeed("mesh", file, "-o", "x.vtkhdf")
        self.assert_points("x.vtkhdf", [(0.990268069, -0.139173101)], within=1e-4)
        turned = self.run_program("update", "x.vtkhdf", file, "-o", "x.vtkhdf", "--json")
        self.assertEqual(turned.json()["preserved_percent"], 100.0)

    def test_a_section_at_an_incidence_stays_there_when_its_edge_opens(self):
        self.succeed("mesh", FILES / "drawn_at_8_degrees.dat", "-o", "x.vtkhdf")
        self.succeed("update", "x.vtkhdf", self.write("blunt.dat", shapes.text_of(blunt(0.01))), "-o", "x.vtkhdf")
        c, s = math.cos(math.radians(8.0027)), math.sin(math.radians(8.0027))
        ends = [(c + 0.005 * s, -s + 0.005 * c), (c - 0.005 * s, -s - 0.005 * c)]
        self.assert_points("x.vtkhdf", ends, within=1e-4)

    def test_an_edge_that_rounding_opens_or_crosses_is_closed(self):
        for name in ("te_crossed_by_rounding.dat", "te_open_by_rounding.dat"):
            for curve in ("spline", "polyline"):
                with self.subTest(name, curve=curve):
                    figures = self.figures("mesh", FILES / name, "--as-given", curve, "-o", "x.vtkhdf")
                    self.assertGreaterEqual(figures["min_angle_deg"], 30.0)
                    self.assertEqual(figures["outlines"][0]["trailing_edge_gap"], 0.0)
                    self.assertEqual(self.gap_of("x.vtkhdf"), 0.0)

    def test_outlines_of_any_shape_as_given(self):
        section = shapes.selig_points(30)
        ring = section[:-1]
        at = shapes.thickness(0.9)
        cap = [(0.9 + at * math.cos(a), at * math.sin(a)) for a in (math.pi * k / 8 for k in range(-3, 4))]
        fore = [p for p in section if p[0] < 0.9]
        nose = min(range(len(section)), key=lambda i: section[i][0])
        front = [p for p in section[:nose] if p[0] > 0.02], [p for p in section[nose:] if p[0] > 0.02]
        horns = [(0.01, 0.025), (-0.01, 0.04), (-0.02, 0.05), (-0.018, 0.03), (-0.01, 0.01), (-0.012, 0.0),
                 (-0.01, -0.012), (-0.02, -0.03), (-0.01, -0.032), (0.012, -0.025)]
        outlines = {
            "gurney": ring + [(0.998, -0.0004), (0.998, -0.015), (1.0, -0.015)],
            "round base": cap[3:] + fore + cap[:3],
            "slanted base": [p for p in section[:nose] if 0 < p[0] < 0.96] + [p for p in section[nose:] if p[0] < 0.9],
            "ice": front[0] + horns + front[1],
            "cove": section[: nose + 1] + [p for p in section[nose + 1:] if p[0] < 0.7]
                    + [(0.72, 0.0), (0.78, 0.02), (0.88, 0.012), (0.96, 0.004), (1.0, 0.0)],
            "backwards": list(reversed(ring)),
            "from the lower side": ring[45:] + ring[:45],
        }
        for name, points in outlines.items():
            file = self.write("outline.dat", name + "\n" + rows_of(points))
            for curve in ("spline", "polyline"):
                with self.subTest(name, curve=curve):
                    figures = self.figures("mesh", file, "--as-given", curve, "-o", "x.vtkhdf")
                    self.assertEqual(figures["stopped"], "done")
                    self.assertTrue(self.figures("check", "x.vtkhdf")["valid"])
                    self.assert_points("x.vtkhdf", points)

    def test_elements_in_common_coordinates_stay_where_they_are(self):
        section = shapes.selig_points(24)
        elements = {"slat": placed(section, 0.15, -30, -0.12, -0.06), "main": placed(section, 1, 0, 0, 0),
                    "flap": placed(section, 0.3, -35, 1.02, -0.03)}
        wanted = [p for points in elements.values() for p in points]
        files = [self.write(f"{name}.dat", name + "\n" + rows_of(points)) for name, points in elements.items()]
        together = self.write("three.dat", "three\n" + "999.0 999.0\n".join(rows_of(p) for p in elements.values()))
        ends = [p for points in elements.values() for p in (points[0], points[24])]
        for given in (files + ["--keep-coordinates"], [together]):
            self.assertEqual(self.figures("mesh", *given, "-o", "x.vtkhdf")["stopped"], "done")
            self.assert_points("x.vtkhdf", ends, within=1e-4)
            figures = self.figures("mesh", *given, "--as-given", "spline", "-o", "x.vtkhdf")
            self.assertEqual(len(figures["outlines"]), 3)
            self.assert_points("x.vtkhdf", wanted)
        self.refused("fit", together, names="3 elements")
        self.refused("mesh", together, "--place", "1,0,0,0", names="3 elements")
        self.refused("mesh", *files, "--keep-coordinates", "--place", "1,0,0,0", names="--keep-coordinates")
        self.refused("mesh", "naca:0012", "--keep-coordinates", names="--keep-coordinates")

    def test_units_are_kept_where_asked_to_and_said_where_not(self):
        points = placed(shapes.selig_points(24), 250, 0, 40, -7)
        file = self.write("mm.dat", "mm\n" + rows_of(points))
        fit = self.figures("fit", file)
        self.assertAlmostEqual(fit["frame"]["scaled"], 1 / 250, places=9)
        self.assertIn("chord of 250", fit["warnings"][0])
        for options in ([], ["--as-given", "polyline"]):
            self.succeed("mesh", file, *options, "-o", "x.vtkhdf")
            self.assert_points("x.vtkhdf", [(0, 0), (1, 0)])
            self.succeed("mesh", file, *options, "--keep-coordinates", "-o", "x.vtkhdf")
            self.assert_points("x.vtkhdf", [(40, -7), (290, -7)], within=1e-4)

    def test_designs_of_symmetric_sections_take_a_file_whose_nose_lies_between_points(self):
        problem = {"airfoil": str(FILES / "nose_between_points.dat"), "symmetric": True,
                   "mesh": {"points": 40, "farfield_radius": 10}, "flow": [{"mach": 0.3, "alpha_deg": 0}],
                   "objective": "drag", "constraints": [{"kind": "contains", "airfoil": "naca:0008"}],
                   "designer": {"name": "sqp", "evaluations": 1}}
        self.succeed("design", self.write("problem.json", json.dumps(problem)), "-o", "run", "--quiet",
                     status=3)  # one evaluation is a limit

    def test_designs_say_what_became_of_the_frames_of_files(self):
        turned = str(FILES / "drawn_at_8_degrees.dat")
        problem = {"airfoil": turned, "mesh": {"points": 40, "farfield_radius": 10}, "flow": [{"mach": 0.3, "alpha_deg": 2}],
                   "objective": "drag", "constraints": [{"kind": "contains", "airfoil": turned}],
                   "designer": {"name": "sqp", "evaluations": 1}}
        outcome = self.succeed("design", self.write("problem.json", json.dumps(problem)), "-o", "run", "--quiet", "--json",
                               status=3)
        warnings = [text for text in outcome.json()["warnings"] if "8.0 degrees" in text]
        self.assertEqual(len(warnings), 1, outcome)
        self.assertIn("remodel: " + warnings[0], outcome.stderr.splitlines())

    def test_naca_sections_by_their_designations(self):
        for name, thickness in (("0012-64", 0.12), ("63-206", 0.06), ("65(1)-412", 0.12), ("64A010", 0.10),
                                ("63-206 a=.8", 0.06), ("23112", 0.12)):
            fit = self.figures("fit", "naca:" + name, "--cst-degree", 8)
            self.assertAlmostEqual(fit["thickness"]["value"], thickness, delta=0.003, msg=name)
        self.refused("fit", "naca:747A315", names="747A315")

    def gap_of(self, mesh):
        """The trailing edge's height in the mesh, from its lowest and highest point at x = 1."""
        self.succeed("convert", mesh, "-o", "x.su2")
        lines = self.path("x.su2").read_text().splitlines()
        start = next(i for i, line in enumerate(lines) if line.startswith("NPOIN"))
        count = int(lines[start].split("=")[1].split()[0])
        points = [tuple(map(float, line.split()[:2])) for line in lines[start + 1 : start + 1 + count]]
        heights = [y for x, y in points if abs(x - 1.0) < 1e-12 and abs(y) < 0.2]
        return max(heights) - min(heights)

    def test_a_blunt_trailing_edge_is_kept(self):
        file = self.write("blunt.dat", shapes.text_of(blunt(0.01)))
        fit = self.figures("fit", file, "-o", "blunt.json")
        self.assertAlmostEqual(fit["te_upper"], 0.005, places=12)
        self.assertAlmostEqual(fit["te_lower"], -0.005, places=12)
        self.assertAlmostEqual(fit["trailing_edge_gap"], 0.01, places=12)
        self.assertLess(fit["max_error"], 5e-4)
        for shape in (file, "blunt.json"):
            self.assertEqual(self.figures("mesh", shape, "--points", 60, "-o", "x.vtkhdf")["stopped"], "done")
            self.assertTrue(self.figures("check", "x.vtkhdf")["valid"])
            self.assertAlmostEqual(self.gap_of("x.vtkhdf"), 0.01, places=12)
        report = self.figures("mesh", file, "--points", 60, "-o", "x.vtkhdf")["fits"]
        self.assertEqual(len(report), 1)
        self.assertAlmostEqual(report[0]["trailing_edge_gap"], 0.01, places=12)
        self.assertEqual(report[0]["max_error"], fit["max_error"])

    def test_it_is_closed_where_asked_to(self):
        file = self.write("blunt.dat", shapes.text_of(blunt(0.01)))
        fit = self.figures("fit", file, "--close-trailing-edge")
        self.assertEqual((fit["te_upper"], fit["te_lower"]), (0.0, 0.0))
        self.assertGreaterEqual(fit["max_error"], 0.005 * (1 - 1e-9))
        self.succeed("mesh", file, "--close-trailing-edge", "--points", 60, "-o", "x.vtkhdf")
        self.assertEqual(self.gap_of("x.vtkhdf"), 0.0)

    def test_update_keeps_it_and_back(self):
        file = self.write("blunt.dat", shapes.text_of(blunt(0.01)))
        self.succeed("mesh", "naca:0012", "--points", 60, "-o", "x.vtkhdf")
        for shape, gap in ((file, 0.01), ("naca:0012", 0.0), (file, 0.01), (file, 0.01)):
            self.figures("update", "x.vtkhdf", shape, "-o", "x.vtkhdf")
            self.assertTrue(self.figures("check", "x.vtkhdf")["valid"])
            self.assertAlmostEqual(self.gap_of("x.vtkhdf"), gap, places=12)

    def test_stations_by_turning_stay_and_several_elements_keep_their_names(self):
        pair = ("naca:2412", "naca:0012", "--place", "1,0,0,0", "--place", "0.3,-20,1.02,-0.05")
        self.succeed("mesh", *pair, "--name", "main", "--name", "flap", "--turning-share", 0.5, "--points", 60, "-o", "a.vtkhdf")
        moved = [word.replace("-20", "-21") for word in pair]
        figures = self.figures("update", "a.vtkhdf", *moved, "-o", "b.su2")
        self.assertGreater(figures["preserved"], 0.8 * figures["triangles"])
        self.assertIn("MARKER_TAG= flap", self.path("b.su2").read_text())
        even, turned = (self.figures("mesh", "naca:2408", "--points", 60, "--turning-share", share, "-o", f"{share}.vtkhdf") for share in (0, 0.3))
        self.assertNotEqual(even["vertices"], turned["vertices"])
        self.refused("mesh", "naca:0012", "--turning-share", 1, names="--turning-share")
        self.refused("mesh", harness.SOURCE / "examples/domains/duct.json", "--turning-share", 0.2, names="--turning-share")
        self.refused("flow", "as_given_missing.dat", "--mach", 0.5, names="as_given_missing.dat: cannot be read")

    def test_the_outline_as_given(self):
        for gap in (0.0, 0.02):
            points = blunt(gap, incline=0.1)
            file = self.write("given.dat", shapes.text_of(points))
            for curve in ("spline", "polyline"):
                with self.subTest(curve, gap=gap):
                    figures = self.figures("mesh", file, "--as-given", curve, "-o", "x.vtkhdf")
                    self.assertEqual(figures["stopped"], "done")
                    self.assertTrue(self.figures("check", "x.vtkhdf")["valid"])
                    self.assertNotIn("fits", figures)
                    self.assertAlmostEqual(figures["outlines"][0]["trailing_edge_gap"], gap / math.hypot(1, 0.1), delta=2e-6)
                    self.refused("mesh", file, "--as-given", curve, "--close-trailing-edge", names="--close-trailing-edge")
                    self.succeed("convert", "x.vtkhdf", "-o", "x.su2")
                    lines = self.path("x.su2").read_text().splitlines()
                    found = [tuple(map(float, l.split()[:2])) for l in lines if len(l.split()) == 3]
                    for x, y in points:
                        nearest = min(math.hypot(x - a, y - b) for a, b in found)
                        self.assertLess(nearest, 1e-6, (x, y))
        updated = self.figures("update", "x.vtkhdf", file, "--as-given", "spline", "-o", "x.vtkhdf")
        self.assertFalse(updated["regenerated"])
        self.assertTrue(self.figures("check", "x.vtkhdf")["valid"])
        self.refused("mesh", "naca:0012", "--as-given", "spline", "-o", "x.vtkhdf", names="--as-given")
        domain = harness.SOURCE / "examples/domains/duct.json"
        for option in (("--as-given", "spline"), ("--keep-coordinates",), ("--close-trailing-edge",)):
            self.refused("mesh", domain, *option, "-o", "x.vtkhdf", names=option[0])

    def test_remarks_around_the_coordinates(self):
        rows = shapes.selig().split("\n", 1)[1]
        plain = self.figures("fit", self.write("plain.dat", shapes.selig()))
        for number, text in enumerate([
            "NACA 0012\nfrom the archive, 41 rows\n" + rows,
            "NACA 0012\n" + rows + "\ndigitised in 1987\n\x1a",
            "NACA 0012\n41 points\n-----\n" + rows + "end of file\n",
        ]):
            with self.subTest(number):
                self.assertEqual(self.figures("fit", self.write("remarks.dat", text))["upper"], plain["upper"])

    def test_the_next_degree_where_the_fit_crosses(self):
        points = []
        for i in range(61):
            x = 0.5 * (1 + math.cos(math.pi * i / 60))
            height = 0.0 if i == 0 else math.sqrt(x) * (1 - x) * (40 * ((x - 0.3) * (x - 0.8)) ** 4 + 2e-4)
            points.append((x, height))
        text = "pinched\n" + "".join(f"{x:.15f} {y:.15f}\n" for x, y in
                                     points + [(x, -y) for x, y in reversed(points[:-1])])
        outcome = self.run_program("fit", self.write("pinched.dat", text), "--json")
        self.assertEqual(outcome.status, 0, outcome)
        self.assertGreater(outcome.json()["degree"], 5)
        self.assertTrue(outcome.json()["surfaces_apart"])
        self.assertIn("degree 5 crosses", outcome.stderr)


if __name__ == "__main__":
    import sys

    main(sys.argv)
