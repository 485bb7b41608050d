"""`remodel design`: a design falls in drag and keeps its constraints, on fresh meshes too; refusals. `flow --gradient`."""

import json

from harness import SOURCE, ProgramTest

PROBLEM = {
    "airfoil": "naca:0012",
    "degree": 4,
    "symmetric": True,
    "mesh": {"points": 40},
    "flow": [{"mach": 0.8, "alpha_deg": 0}],
    "objective": "drag",
    "constraints": [{"kind": "area", "of_start": 1}],
    "designer": {"evaluations": 5, "trust": 0.02, "bounds": 0.2},
    "verify": [40],
}


class Designs(ProgramTest):
    def problem(self, **changes):
        return self.write("problem.json", json.dumps({**PROBLEM, **changes}))

    def test_drag_falls_and_the_area_stays(self):
        start = self.figures("flow", "naca:0012", "--points", 40, "--gradation", 0.8, "--cst-degree", 4, "--mach", 0.8)
        figures = self.figures("design", self.problem(), "-o", "run")
        self.assertLess(figures["objective"], 0.9 * figures["start_objective"])
        self.assertAlmostEqual(figures["start_objective"], start["cd"], delta=0.4 * start["cd"])  # half a mesh, another one
        self.assertEqual(figures["evaluations"], 5)
        best = figures["best"]
        self.assertEqual([-c for c in best["upper"]], best["lower"])
        self.assertTrue(figures["verified"][0]["converged"])
        self.assertLess(figures["verified"][0]["cd"], start["cd"])
        resumed = self.figures("design", self.problem(), "-o", "run", "--resume")
        self.assertEqual(resumed["best"], best)

    def test_adodg_1_on_a_coarse_mesh(self):
        """NACA 0012 contained, Mach 0.85: half a mesh, page and film of the run."""
        problem = json.loads((SOURCE / "examples/design/adodg1_coarse.json").read_text())
        problem["designer"]["evaluations"] = 25
        problem["verify"] = []
        figures = self.figures("design", self.write("adodg1.json", json.dumps(problem)), "-o", "run")
        self.assertLess(figures["objective"], 0.5 * figures["start_objective"])
        self.assertLess(figures["cold_equivalents"], figures["flows"] / 2)
        self.assertEqual([-c for c in figures["best"]["upper"]], figures["best"]["lower"])
        boundary = self.figures("check", "run/last.vtkhdf")["boundary"]
        self.assertEqual(sorted(boundary), ["airfoil", "farfield", "symmetry"])
        report = self.figures("design", "report", "run")
        self.assertEqual(report["objective"], figures["objective"])
        page = self.path("run/report.html").read_text()
        self.assertEqual(page.count("<img"), 6)  # pressures, two fields, convergence, two meshes
        self.assertNotIn("src=\"http", page)
        self.assertEqual(self.figures("film", "run", "-o", "film.webp", "--frames", 5)["frames"], 5)

    def test_report_refuses_other_runs(self):
        self.succeed("optimise", "--from", "naca:0012", "--to", "naca:2412", "--points", 40, "--evaluations", 3, "-o", "run")
        self.refused("design", "report", "run", names="history.sqlite")
        self.refused("design", "report", "nothing", names="nothing")
        self.refused("design", names="PROBLEM")

    def test_refusals(self):
        for changes, name in (
            ({"speed": 1}, "speed"),
            ({"objective": "beauty"}, "beauty"),
            ({"flow": []}, "flow"),
            ({"flow": [{"mach": 0}]}, "mach"),
            ({"constraints": [{"kind": "lift", "point": 1, "at_least": 0}]}, "point"),
            ({"airfoil": "naca:xyz"}, "xyz"),
        ):
            self.refused("design", self.problem(**changes), "-o", "run", names=name)
        self.refused("design", self.write("a.json", "{"), "-o", "run", names="a.json")
        self.path("thesis").mkdir()
        self.path("thesis/chapter").write_text("1")
        self.refused("design", self.problem(), "-o", "thesis", names="thesis")


class Gradients(ProgramTest):
    def test_a_gradient_is_the_slope_of_two_flows(self):
        flow = ("--mach", 0.4, "--alpha", 1)
        base = {key: value for key, value in self.figures("fit", "naca:2412").items() if key in ("degree", "upper", "lower")}
        self.succeed("mesh", self.write("a.json", json.dumps(base)), "--points", 40, "-o", "a.vtkhdf")
        gradient = self.figures("flow", "a.vtkhdf", *flow, "--gradient")["gradient"]
        self.assertEqual(len(gradient["cl"]["coefficients"]), 14 + 4 + 5 + 4)
        lifts = []
        for step in (1e-4, -1e-4):
            upper = [base["upper"][0] + step, *base["upper"][1:]]
            self.succeed("update", "a.vtkhdf", self.write("b.json", json.dumps({**base, "upper": upper})), "-o", "b.vtkhdf")
            lifts.append(self.figures("flow", "b.vtkhdf", *flow)["cl"])
        self.assertAlmostEqual((lifts[0] - lifts[1]) / 2e-4, gradient["cl"]["coefficients"][0], delta=1e-4)

    def test_a_mesh_without_curves_has_none(self):
        self.succeed("mesh", "naca:2412", "--points", 40, "-o", "mesh.su2")
        self.refused("flow", "mesh.su2", "--mach", 0.4, "--gradient", names="--gradient")
