"""Coordinate files of airfoils as they are found: blunt, with remarks, fitted or as given."""

import math

import shapes
from harness import ProgramTest, main


def blunt(gap, incline=0.0, half=20):
    """NACA 0012 with a trailing edge that is open by `gap` chords, its chord line inclined."""
    points = shapes.selig_points(half)
    nose = len(points) // 2
    return [(x, y + (0.5 if i < nose else -0.5) * gap * x + incline * x) for i, (x, y) in enumerate(points)]


class Airfoils(ProgramTest):
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
                    self.assertAlmostEqual(figures["outlines"][0]["trailing_edge_gap"], gap, delta=1e-6)
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
