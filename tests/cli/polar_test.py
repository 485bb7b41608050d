"""`remodel polar`: rows of flows, past the largest lift, in tables and pictures."""

import csv
import io
import json
import os
import pty
import signal
import subprocess
import time
import unittest

import harness
import shapes
from harness import ProgramTest

SMALL = ("--points", 40, "--farfield-radius", 10)
ROW = ("polar", "naca:0012", "--mach", 0.4, "--alpha", "0:4:2", *SMALL)
POINT = "shape mach alpha_deg cl cd cm cd_pressure cd_friction converged status asked newton_steps residual warm seconds"


class Polars(ProgramTest):
    def test_keys_and_flows_of_a_row(self):
        figures = self.figures(*ROW)
        self.assertKeys(figures, "points cl_max seconds polars model found not_found warnings")
        self.assertEqual([p["alpha_deg"] for p in figures["points"]], [0, 2, 4])
        for point in figures["points"]:
            self.assertKeys(point, POINT)
            self.assertTrue(point["converged"])
            flow = self.figures("flow", "naca:0012", "--mach", 0.4, "--alpha", point["alpha_deg"], *SMALL)
            for key in ("cl", "cd", "cm"):
                self.assertAlmostEqual(point[key], flow[key], delta=1e-8)
        self.assertEqual([p["warm"] == "cold" for p in figures["points"]], [True, False, False])
        self.assertEqual(figures["cl_max"], figures["points"][2]["cl"])
        self.assertFalse(figures["polars"][0]["cl_max_passed"])

    def test_files_of_several_shapes_and_mach_numbers(self):
        figures = self.figures("polar", "naca:0012", "naca:2412", "--mach", "0.3:0.4:0.1", "--alpha", "-1:1:1", *SMALL,
                               "-o", "a.csv", "-o", "a.svg", "-o", "a.json", "-o", "a.png")
        rows = list(csv.DictReader(io.StringIO(self.path("a.csv").read_text())))
        self.assertEqual([(r["shape"], r["mach"]) for r in rows[::3]],
                         [("naca:0012", "0.3"), ("naca:0012", "0.4"), ("naca:2412", "0.3"), ("naca:2412", "0.4")])
        self.assertEqual([r["alpha_deg"] for r in rows], ["-1", "0", "1"] * 4)
        self.assertEqual([float(r["cl"]) for r in rows], [p["cl"] for p in figures["points"]])
        self.assertEqual(json.loads(self.path("a.json").read_text()), figures)
        self.assertIn("</svg>", self.path("a.svg").read_text())
        self.assertEqual(self.path("a.png").read_bytes()[:4], b"\x89PNG")
        # A flow is found from nothing for each mesh, and not for each Mach number.
        self.assertEqual([p["warm"] for p in figures["points"]].count("cold"), 2)

    def test_angles_for_lifts(self):
        figures = self.figures("polar", "naca:2412", "--mach", 0.4, "--cl", "0.2:0.4:0.1", *SMALL)
        for point, lift in zip(figures["points"], (0.2, 0.3, 0.4)):
            self.assertAlmostEqual(point["cl"], lift, delta=1e-8)
        angles = [p["alpha_deg"] for p in figures["points"]]
        self.assertEqual(angles, sorted(angles))

    def test_a_mesh_of_a_file_has_the_row_of_its_shape(self):
        self.succeed("mesh", "naca:2412", *SMALL, "-o", "a.vtkhdf", "-o", "a.su2")
        row = ("--mach", 0.4, "--alpha", "0:2:1")
        shape = self.figures("polar", "naca:2412", *row, *SMALL)
        for name in ("a.vtkhdf", "a.su2"):
            mesh = self.figures("polar", name, *row)
            for a, b in zip(shape["points"], mesh["points"]):
                self.assertAlmostEqual(a["cl"], b["cl"], delta=1e-8)

    def test_forces_of_each_body(self):
        self.write("front.dat", shapes.selig())
        rows = [line.split() for line in shapes.selig().splitlines()[1:]]
        self.write("rear.dat", "rear\n" + "".join(f"{float(x) + 1.2} {float(y) - 0.1}\n" for x, y in rows))
        self.succeed("mesh", "front.dat", "rear.dat", "--as-given", "spline", "--keep-coordinates", *SMALL, "-o", "two.vtkhdf")
        figures = self.figures("polar", "two.vtkhdf", "--mach", 0.3, "--alpha", "0:2:1")
        for point in figures["points"]:
            self.assertEqual([body["name"] for body in point["bodies"]], ["front", "rear"])
            for key in ("cl", "cd", "cm"):
                self.assertAlmostEqual(sum(body[key] for body in point["bodies"]), point[key], delta=1e-12)

    def test_a_flow_that_is_not_found_is_a_row_that_says_so(self):
        outcome = self.succeed(*ROW, "--max-steps", 1, "-o", "a.csv", "-o", "a.svg", "--json", status=3)
        figures = outcome.json()
        self.assertEqual([p["status"] for p in figures["points"]], ["step-limit", "step-limit", "not-looked-for"])
        for point in figures["points"]:
            self.assertFalse(point["converged"])
            self.assertIsNone(point["cl"])
            self.assertTrue(point["reason"])
        self.assertIn("no flow was found at 0 and 2", figures["points"][2]["reason"])
        self.assertIsNone(figures["cl_max"])
        self.assertEqual(figures["written"], ["a.csv"])
        self.assertFalse(self.path("a.svg").exists())
        self.assertIn("a.svg: not written", outcome.stderr)
        rows = list(csv.DictReader(io.StringIO(self.path("a.csv").read_text())))
        self.assertEqual([(r["alpha_deg"], r["cl"], r["converged"]) for r in rows],
                         [("0", "", "0"), ("2", "", "0"), ("4", "", "0")])

    def test_friction_has_its_own_layer_and_figures(self):
        figures = self.figures("polar", "naca:0012", "--model", "laminar", "--reynolds", 500, "--mach", 0.3, "--alpha", "0:2:2",
                               "--farfield-radius", 10, "--tolerance", 1e-8, "-o", "a.svg")
        for point in figures["points"]:
            self.assertTrue(point["converged"], point)
            self.assertAlmostEqual(point["cd_pressure"] + point["cd_friction"], point["cd"], places=12)
            self.assertGreater(point["cd_friction"], 0.1)
        self.assertAlmostEqual(figures["points"][0]["cl"], 0, delta=2e-3)

    def test_what_is_no_row_is_refused(self):
        mach, alpha = ("--mach", 0.4), ("--alpha", "0:4:2")
        for words, message in (
            (alpha, "--mach: not given"),
            (mach, "--alpha: not given"),
            ((*mach, *alpha, "--cl", "0:1:0.5"), "--cl: given with --alpha"),
            ((*mach, "--alpha", "4:0:1"), "--alpha: found '4:0:1', expected a last value"),
            ((*mach, "--alpha", "0:4:0"), "--alpha: found '0:4:0', expected a step above 0"),
            ((*mach, "--alpha", "0:4"), "--alpha: found '0:4', expected a number, or FIRST:LAST:STEP"),
            ((*mach, "--alpha", ""), "--alpha: found '', expected a number, or FIRST:LAST:STEP"),
            ((*mach, "--alpha", "0:90:0.01"), "--alpha: found '0:90:0.01', expected at most 1000 values"),
            (("--mach", "1:4:1", *alpha), "--mach: found '1:4:1', expected numbers from 0.01 to 3"),
            ((*mach, *alpha, "--reynolds", 1e6), "--reynolds: given without friction"),
            ((*mach, *alpha, "--model", "sa"), "--reynolds: not given"),
            ((*mach, *alpha, "--model", "sa", "--reynolds", 1e6, "--points", 100), "--points: given with a model with friction"),
            ((*mach, *alpha, "-o", "a.vtu"), "a.vtu"),
            ((*mach, *alpha, "-o", "a.csv", "-o", "./a.csv"), "-o: found './a.csv' twice"),
        ):
            with self.subTest(message):
                self.refused("polar", "naca:0012", *words, names=message)
        # The last shape is read before the first flow.
        self.refused("polar", "naca:0012", "missing.dat", *mach, *alpha, "-o", "a.csv", names="missing.dat")

    def test_a_killed_run_leaves_the_rows_so_far(self):
        table = self.path("a.csv")
        with subprocess.Popen([harness.PROGRAM, "polar", "naca:0012", "--mach", "0.4", "--alpha", "0:90:0.1", "-o", "a.csv", *map(str, SMALL)],
                              cwd=self.directory, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as process:
            ends = time.monotonic() + 60
            while not (table.exists() and table.read_text().count("\n") > 2) and time.monotonic() < ends:
                time.sleep(0.01)
            process.kill()
        rows = list(csv.DictReader(io.StringIO(table.read_text())))
        self.assertGreaterEqual(len(rows), 2)
        self.assertEqual([float(row["alpha_deg"]) for row in rows[:2]], [0, 0.1])
        self.assertEqual({row["converged"] for row in rows}, {"1"})

    def test_an_interrupt_leaves_the_rows_so_far(self):
        ours, terminal = pty.openpty()
        with subprocess.Popen([harness.PROGRAM, "polar", "naca:0012", "--mach", "0.4", "--alpha", "0:90:0.1", "-o", "a.csv", *map(str, SMALL)],
                              cwd=self.directory, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=terminal) as process:
            os.close(terminal)
            shown = b""
            while b"angle 0.2 " not in shown:  # the line of progress
                shown += os.read(ours, 4096)
            process.send_signal(signal.SIGINT)
            shown += harness.read_terminal(ours)
        self.assertEqual(process.returncode, 3, shown)
        rows = list(csv.DictReader(io.StringIO(self.path("a.csv").read_text())))
        self.assertGreaterEqual(len(rows), 2)
        self.assertLess(len(rows), 901)
        self.assertEqual({row["converged"] for row in rows}, {"1"})
        self.assertEqual([float(row["alpha_deg"]) for row in rows[:2]], [0, 0.1])


if __name__ == "__main__":
    unittest.main()
