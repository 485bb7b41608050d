"""`remodel design` that begins with a design of another run, and that goes from coarse to fine meshes."""

import json
import shutil
import sqlite3

from deform_test import DUCT, POINTS
from design_test import PROBLEM
from harness import ProgramTest


class RestartTest(ProgramTest):
    def problem(self, name="problem.json", **changes):
        return self.write(name, json.dumps({**PROBLEM, "verify": [], **changes}))

    def rows(self, directory):
        with sqlite3.connect(f"file:{self.path(directory)}/history.sqlite?mode=ro", uri=True) as history:
            query = "select coefficients, objective, outputs from evaluations order by evaluation"
            return [(json.loads(design), objective, json.loads(outputs)) for design, objective, outputs in history.execute(query)]


class Restarts(RestartTest):
    def setUp(self):
        super().setUp()
        self.succeed("design", self.problem(), "-o", "before", "--quiet", status=3)
        self.designs = [row[0] for row in self.rows("before")]

    def first_design(self, directory):
        return self.rows(directory)[0][0]

    def test_any_design_of_a_run_is_a_start(self):
        best = min(self.rows("before"), key=lambda row: row[1])
        one = {"evaluations": 1}
        for name, start, design in (("key", {"history": "before/history.sqlite", "design": 3}, self.designs[2]),
                                    ("best", {"history": "before", "design": "best"}, best[0]),
                                    ("short", {"history": "before"}, best[0])):  # fmt: skip
            problem = self.problem(start=start, designer=one, mesh={"points": 60})
            figures = self.figures("design", problem, "-o", name, status=3)
            self.assertEqual(self.first_design(name), design)
            self.assertEqual(figures["start_objective"], self.rows(name)[0][1])
        self.succeed("design", self.problem(designer=one), "-o", "option", "--start", "before:3", "--quiet", status=3)
        self.assertEqual(self.first_design("option"), self.designs[2])
        self.succeed("design", self.problem(designer=one), "-o", "option_best", "--start", "before", "--quiet", status=3)
        self.assertEqual(self.first_design("option_best"), best[0])
        # A path in the file leads on from there, one on the command line from where the program is.
        self.path("deeper").mkdir()
        self.problem("deeper/problem.json", start={"history": "../before", "design": 2}, designer=one)
        self.succeed("design", "deeper/problem.json", "-o", "deep", "--quiet", status=3)
        self.assertEqual(self.first_design("deep"), self.designs[1])

    def test_such_a_run_has_its_page_its_film_and_goes_on(self):
        problem = self.problem(start={"history": "before", "design": 3}, designer={"evaluations": 2})
        first = self.figures("design", problem, "-o", "run", status=3)
        self.assertEqual(self.figures("design", "report", "run")["designs"], 2)
        self.assertEqual(self.figures("film", "run", "-o", "film.webp", "--frames", 2)["frames"], 2)
        problem = self.problem(start={"history": "before", "design": 3}, designer={"evaluations": 4})
        again = self.figures("design", problem, "-o", "run", "--resume", status=3)
        self.assertEqual((again["evaluations"], again["start_objective"]), (4, first["start_objective"]))
        other = self.problem(start={"history": "before", "design": 2}, designer={"evaluations": 6})
        self.refused("design", other, "-o", "run", "--resume", names="found others: ")

    def test_other_designs_are_refused(self):
        self.write("duct.json", json.dumps(DUCT))
        self.write("space.json", json.dumps({"domain": "duct.json", "deformations": [POINTS]}))
        duct = {key: value for key, value in PROBLEM.items() if key not in ("airfoil", "degree", "symmetric", "constraints", "mesh", "verify")}
        flow = [{"mach": 0.3, "inlets": [{"name": "inlet"}], "outlets": [{"name": "outlet", "pressure": 0.75}], "symmetry": ["axis"]}]
        self.write("duct_problem.json", json.dumps({**duct, "space": "space.json", "flow": flow, "objective": "mass_flow", "designer": {"evaluations": 1}}))
        self.succeed("design", "duct_problem.json", "-o", "duct", "--quiet", status=3)
        self.succeed("optimise", "--from", "naca:0012", "--to", "naca:2412", "--points", 40, "--evaluations", 2, "-o", "other", "--quiet")
        for start, name in (
            ({"history": "before", "design": 6}, "problem.json, start (before): found no design 6, expected 1 to 5"),
            ({"history": "nothing"}, "problem.json, start (nothing): nothing/history.sqlite: "),
            ({"history": "other"}, "found no run of `remodel design`"),
            ({"history": "duct"}, "found a design of 3 numbers, expected 5, as many as this problem has variables"),
            ({"design": 3}, "problem.json, start: the key 'history' is missing"),
            ({"history": "before", "design": 0}, "problem.json, start: found 0 as 'design', expected a whole number from 1"),
            ({"history": "before", "number": 1}, "found the key 'number', expected history, design"),
            ("before", "problem.json, start: found string, expected an object"),
        ):
            self.refused("design", self.problem(start=start), "-o", "run", names=name)
        self.refused("design", self.problem(degree=3), "-o", "run", "--start", "before", names="found a design of 5 numbers, expected 4")
        # As many numbers, of another shape.
        problem = {**json.loads(self.path("duct_problem.json").read_text()), "start": {"history": "duct", "design": 1}}
        line = {**POINTS, "points": [1, 2, 3]}
        self.write("space.json", json.dumps({"domain": "duct.json", "deformations": [line]}))
        moved = json.loads(json.dumps(DUCT))
        moved["loops"][0]["curves"][2]["shape"]["points"][2][1] = 0.45
        self.write("duct.json", json.dumps(moved))
        self.write("other.json", json.dumps(problem))
        self.refused("design", "other.json", "-o", "run", names="found a design that is another shape by the variables of this problem")
        for text in ("before:x", ":3", "before:"):
            self.refused("design", self.problem(), "-o", "run", "--start", text, names=f"--start: found '{text}'")


class Stages(RestartTest):
    COARSE_TO_FINE = {"points": [24, 40]}

    def test_each_mesh_begins_with_the_best_design_of_the_one_before(self):
        problem = self.problem(mesh=self.COARSE_TO_FINE, designer={"evaluations": 6, "bounds": 0.2}, verify=[40])
        figures = self.figures("design", problem, "-o", "run", status=3)
        coarse, fine = figures["stages"]
        self.assertEqual((coarse["points"], fine["points"]), (24, 40))
        self.assertEqual(fine["objective"], figures["objective"])
        self.assertLess(coarse["triangles"], fine["triangles"])
        best = min(self.rows("run/stage-1"), key=lambda row: row[1])[0]
        self.assertEqual(self.rows("run")[0][0], best)
        self.assertEqual(figures["verified"][0]["points"], 40)
        self.assertEqual(json.loads(self.path("run/stages.json").read_text()), figures["stages"])
        self.succeed("design", "report", "run")
        self.assertIn("From coarse to fine", self.path("run/report.html").read_text())
        again = self.figures("design", problem, "-o", "run", "--resume", status=3)
        self.assertEqual(again["best"], figures["best"])

    def test_a_run_that_stopped_between_two_meshes_goes_on(self):
        """As one that was killed: the second mesh's files are not there yet, or in part."""
        problem = self.problem(mesh=self.COARSE_TO_FINE, designer={"evaluations": 4})
        whole = self.figures("design", problem, "-o", "whole", status=3)
        shutil.copytree(self.path("whole"), self.path("cut"))
        for file in self.path("cut").iterdir():
            if file.is_file():
                file.unlink()
        again = self.figures("design", problem, "-o", "cut", "--resume", status=3)
        self.assertEqual(again["best"], whole["best"])
        self.refused("design", problem, "-o", "cut", names="cut: holds a")
        # More designs than before are those of the finest mesh.
        more = self.problem(mesh=self.COARSE_TO_FINE, designer={"evaluations": 6})
        again = self.figures("design", more, "-o", "cut", "--resume", status=3)
        self.assertEqual([stage["evaluations"] for stage in again["stages"]], [4, 6])

    def test_an_overwritten_run_leaves_no_mesh_of_its_own(self):
        problem = self.problem(mesh={"points": [24, 32, 40]}, designer={"evaluations": 1})
        self.succeed("design", problem, "-o", "run", "--quiet", status=3)
        self.assertTrue(self.path("run/stage-2/history.sqlite").exists())
        two = self.problem(mesh=self.COARSE_TO_FINE, designer={"evaluations": 1})
        self.assertEqual(len(self.figures("design", two, "-o", "run", "--overwrite", status=3)["stages"]), 2)
        self.assertFalse(self.path("run/stage-2").exists())
        self.succeed("design", self.problem(designer={"evaluations": 1}), "-o", "run", "--quiet", "--overwrite", status=3)
        self.assertFalse(self.path("run/stage-1").exists())
        self.assertFalse(self.path("run/stages.json").exists())

    def test_meshes_go_from_coarse_to_fine(self):
        for points, name in (([40, 24], "found [40,24] as 'points', expected meshes from coarse to fine"),
                             ([], "found no number in 'points'"), ([24, 41], "found 41 as 'points', expected an even number"),
                             ([24, "40"], "found \"40\" as 'points'"), (list(range(8, 40, 2)), "found 16 entries in 'points', expected at most 10")):  # fmt: skip
            self.refused("design", self.problem(mesh={"points": points}), "-o", "run", names=name)
