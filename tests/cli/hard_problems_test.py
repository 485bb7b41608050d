"""Problems of `remodel design` that cannot be solved, or are mistakes: each gets one sentence, and nothing is lost."""

import copy
import json
import signal
import sqlite3
import subprocess
import time

import harness
from bad_input_test import limit_file_size
from deform_test import DUCT, POINTS
from design_test import PROBLEM
from harness import SOURCE, ProgramTest

ENDS = {"inlets": [{"name": "inlet"}], "outlets": [{"name": "outlet", "pressure": 0.75}], "symmetry": ["axis"]}


class HardProblems(ProgramTest):
    def problem(self, **changes):
        return self.write("problem.json", json.dumps({**PROBLEM, "verify": [], **changes}))

    def duct(self, domain=None, constraints=(), objective="mass_flow", **flow):
        self.write("duct.json", json.dumps(domain or DUCT))
        space = {"domain": "duct.json", "deformations": [POINTS]}
        return self.write("problem.json", json.dumps({
            "space": space, "flow": [{"mach": 0.3, **ENDS, **flow}], "objective": objective,
            "constraints": list(constraints), "designer": {"evaluations": 2},
        }))  # fmt: skip

    def test_openings_are_judged_when_the_problem_is_read(self):
        closed = copy.deepcopy(DUCT)
        for curve in closed["loops"][0]["curves"]:
            curve["name"] = "inlet" if curve["name"] == "inlet" else "outlet" if curve["name"] == "outlet" else "axis"
        with_line = copy.deepcopy(DUCT)
        with_line["loops"].append({"role": "internal", "open": True, "curves": [
            {"name": "line", "shape": {"kind": "line", "from": [1, 0.1], "to": [1.2, 0.2]}, "stations": 2}]})  # fmt: skip
        curves = "axis, outlet, wall, turn, inlet"
        for problem, name in (
            ({"outlets": [{"name": "exit"}]}, f"found 'exit' as the name of an outlet, expected that of curves of the domain: {curves}"),
            ({"symmetry": ["axes"]}, f"found 'axes' as the name of a symmetry plane, expected that of curves of the domain: {curves}"),
            ({"symmetry": ["inlet"]}, "found 'inlet' as the name of a symmetry plane, expected another name for each boundary"),
            ({"symmetry": ["wall"]}, "found 'wall' as the name of a symmetry plane, expected a straight line along the stream of 0.0 degrees"),
            ({"alpha_deg": 2}, "found 'axis' as the name of a symmetry plane, expected a straight line along the stream of 2.0 degrees"),
            ({"outlets": []}, "found no curve 'farfield' in the domain and no 'outlets', expected one for the gas to leave by"),
            ({"inlets": []}, "expected one for the gas to enter by"),
            ({"outlets": [{"name": "outlet", "pressure": 1.2}]}, "found 1.2 as the 'pressure' of the outlet 'outlet', expected less than the 1.06443"),
            ({"cl": 0.5, "symmetry": []}, "found 'cl' with a domain without a curve 'farfield', expected 'alpha_deg'"),
            ({"cl": 0.5}, "found 'cl'"),
            ({"domain": closed}, "found no wall among the curves of the domain (axis, outlet, inlet)"),
            ({"domain": with_line, "outlets": [{"name": "line"}]}, "found 'line' as the name of an outlet"),
        ):
            line = self.refused("design", self.duct(**problem), "-o", "run", names=name)
            self.assertIn("problem.json, flow 1: ", line)
        no_lift = "with a domain without a curve 'farfield', expected drag, moment, mass_flow, total_pressure, pressure_loss or flow_angle"
        for problem, name in (({"objective": "lift"}, f"problem.json: found 'lift' {no_lift}"),
                              ({"constraints": [{"kind": "lift", "at_least": 0}]}, f"problem.json, constraint 1: found 'lift' {no_lift}")):  # fmt: skip
            self.refused("design", self.duct(**problem), "-o", "run", names=name)

    def test_a_section_that_crosses_itself_is_named(self):
        self.write("cross.json", json.dumps({"degree": 1, "upper": [-0.1, -0.1], "lower": [0.1, 0.1]}))
        problem = self.problem(airfoil="cross.json", symmetric=False, degree=1)
        self.refused("design", problem, "-o", "run", names="problem.json: found an airfoil as 'airfoil' that makes no domain: ")

    def test_how_small_the_first_step_is_does_not_end_the_search(self):
        figures = self.figures("design", self.problem(designer={"evaluations": 20, "trust": 1e-6}), "-o", "run", status=3)
        self.assertLess(figures["objective"], 0.9 * figures["start_objective"])

    def test_files_of_another_kind_are_named(self):
        flatback = (SOURCE / "examples/design/flatback.dat").read_text()
        self.write("section.dat", flatback)
        base = {key: value for key, value in PROBLEM.items() if key not in ("airfoil", "degree", "symmetric", "verify", "constraints")}
        for space, name in (
            ("section.dat", "as 'space', section.dat:1: found no JSON at column 1, expected a design space, a JSON object"),
            ({"domain": "section.dat", "deformations": [POINTS]}, "as 'domain', section.dat:1: found no JSON at column 1, expected a JSON object"),
        ):
            self.refused("design", self.write("problem.json", json.dumps({**base, "space": space})), "-o", "run", names=name)
        self.refused("mesh", self.write("a.json", "{\"loops\": [\n,]}"), "-o", "a.vtkhdf", names="a.json:2: found no JSON at column 1")

    def test_an_outline_that_ends_before_its_trailing_edge_is_said(self):
        naca = lambda x: 0.6 * (0.2969 * x**0.5 - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1015 * x**4)
        xs = [0.82 * (1 - k / 30) ** 2 for k in range(31)]
        points = [(x, naca(x)) for x in xs] + [(x, -naca(x)) for x in xs[-2::-1]]
        self.write("cut.dat", "cut\n" + "".join(f"{x:.6f} {y:.6f}\n" for x, y in points))
        outcome = self.succeed("mesh", "cut.dat", "--as-given", "spline", "-o", "cut.vtkhdf")
        self.assertRegex(outcome.stderr, r"cut\.dat: its ends are 0\.05\d+ chords apart, and a straight edge closes the outline there")
        flatback = SOURCE / "examples/design/flatback.dat"
        self.assertNotIn("straight edge", self.succeed("mesh", flatback, "--as-given", "spline", "-o", "flat.vtkhdf").stderr)

    def test_ducts_report_what_leaves_them(self):
        figures = self.figures("design", self.duct(), "-o", "run", status=3)
        self.assertAlmostEqual(figures["mass_flow"], -figures["objective"])
        problem = json.loads(self.path("problem.json").read_text())
        self.write("problem.json", json.dumps({**problem, "verify": [60]}))
        figures = self.figures("design", "problem.json", "-o", "fresh", status=3)
        fresh = figures["verified"][0]
        self.assertAlmostEqual(fresh["mass_flow"], figures["mass_flow"], delta=0.05 * figures["mass_flow"])
        self.assertAlmostEqual(fresh["total_pressure"], 1, delta=0.04)
        self.assertEqual("warning" in fresh, fresh["total_pressure"] > 1 + 1e-6)
        self.assertEqual("the total pressure at outlets" in figures.get("detail", ""), figures["total_pressure"] > 1 + 1e-6)
        self.succeed("design", "report", "fresh")
        self.assertIn("<th>total pressure</th>", self.path("fresh/report.html").read_text())

    def test_outputs_that_lead_to_an_input_are_refused(self):
        self.succeed("fit", "naca:2412", "-o", "shape.json")
        self.path("link.json").symlink_to("shape.json")
        self.path("hard.json").hardlink_to(self.path("shape.json"))
        for name in ("shape.json", "link.json", "hard.json"):
            self.refused("fit", "shape.json", "-o", name, names=f"-o: found '{name}', which is the input 'shape.json'")
            self.refused("polar", "shape.json", "--mach", 0.3, "--alpha", "0:1:1", "-o", name, names="which is the input 'shape.json'")
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "a.su2")
        self.path("b.su2").symlink_to("a.su2")
        self.refused("convert", "a.su2", "-o", "a.su2", "-o", "b.su2", names="found 'b.su2' twice")

    def test_problems_without_a_solution_end_with_a_sentence(self):
        opposite = [{"kind": "lift", "at_least": 0.5}, {"kind": "lift", "at_most": 0.1}]
        lifting = [{"mach": 0.5, "alpha_deg": 2}]
        for changes, status, sentence in (
            ({"constraints": opposite, "flow": lifting, "symmetric": False}, (1, 3), "no design is within all constraints"),
            ({"constraints": [{"kind": "thickness", "x": [0.3], "at_least": 0.5}]}, (1, 3), "violates 'thickness' most"),
            ({"flow": [{"mach": 0.8, "alpha_deg": 30}], "symmetric": False, "constraints": []}, (0, 1, 3), None),
            ({"flow": [{"mach": 1.2, "alpha_deg": 0}]}, (0, 3), None),
        ):  # fmt: skip
            outcome = self.run_program("design", self.problem(**changes, designer={"evaluations": 6}), "-o", "run", "--overwrite", "--json", "--quiet")
            self.assertIn(outcome.status, status, outcome)
            figures = outcome.json()
            if sentence:
                self.assertIn(sentence, figures["detail"])
            self.assertTrue(self.path("run/best.json").exists())
            self.assertEqual(outcome.stderr, "")

    def test_a_full_disk_is_said_and_the_run_goes_on_from_its_checkpoint(self):
        problem = self.problem(designer={"evaluations": 12})
        self.succeed("design", self.problem(designer={"evaluations": 5}), "-o", "run", "--quiet", status=3)
        before = self.path("run/checkpoint.json").read_bytes()
        outcome = self.run_program("design", problem, "-o", "run", "--resume", "--quiet", preexec_fn=limit_file_size(30_000))
        self.assertEqual(outcome.status, 2, outcome)
        self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
        self.assertEqual(self.path("run/checkpoint.json").read_bytes(), before)
        self.succeed("design", problem, "-o", "run", "--resume", "--quiet", status=3)
        self.refused("design", problem, "-o", "/dev/full", names="/dev/full")

    def test_a_killed_run_goes_on(self):
        problem = self.problem(designer={"evaluations": 30}, mesh={"points": 80})
        process = subprocess.Popen([harness.PROGRAM, "design", problem, "-o", "run", "--quiet"], cwd=self.directory,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
        deadline = time.monotonic() + 60
        while not self.path("run/checkpoint.json").exists() and time.monotonic() < deadline:
            time.sleep(0.02)
        time.sleep(0.5)
        process.send_signal(signal.SIGKILL)
        process.wait()
        resumed = self.run_program("design", problem, "-o", "run", "--resume", "--quiet", "--json").json()
        whole = self.run_program("design", problem, "-o", "whole", "--quiet", "--json").json()
        # Flows start cold once, so that last digits may differ.
        self.assertAlmostEqual(resumed["objective"], whole["objective"], delta=0.05 * whole["objective"])

    def test_elements_that_may_touch_end_no_search(self):
        """Whatever becomes of a design's mesh: the next one is evaluated."""
        elements = [{"name": "main", "airfoil": "naca:4412"},
                    {"name": "flap", "airfoil": "naca:4415", "placement": {"chord": 0.3, "rotation_deg": -10, "position": [1.005, -0.03]},
                     "variables": {"x": {"bounds": [0.9, 1.05]}, "y": {"bounds": [-0.06, 0.05]}}}]  # fmt: skip
        problem = {"elements": elements, "mesh": {"points": 32, "gradation": 1.5}, "flow": [{"mach": 0.2, "alpha_deg": 4}],
                   "objective": "lift", "designer": {"name": "cmaes", "evaluations": 40, "sigma": 0.02, "seed": 3}}  # fmt: skip
        figures = self.figures("design", self.write("problem.json", json.dumps(problem)), "-o", "run", status=3)
        self.assertEqual((figures["stopped"], figures["evaluations"]), ("evaluations", 40))
        with sqlite3.connect(f"file:{self.path('run')}/history.sqlite?mode=ro", uri=True) as history:
            failed = [detail for detail, in history.execute("select detail from evaluations where objective is null or objective > 1e300")]
        for detail in failed:
            self.assertNotEqual(detail, "")
