"""Design problems with friction that are mistakes, or cannot be solved: each gets one sentence, and nothing is lost."""

import copy
import json
import sqlite3

from deform_test import DUCT, POINTS
from harness import ProgramTest

POINT = {"mach": 0.5, "alpha_deg": 1, "model": "laminar", "reynolds": 500}
LAYERS = {"first_height": 0.006, "growth": 1.5, "thickness": 0.1}
PROBLEM = {
    "airfoil": "naca:0012",
    "degree": 3,
    "mesh": {"points": 150, "gradation": 2, "farfield_radius": 8, "layers": LAYERS},
    "flow": [POINT],
    "objective": "drag",
    "constraints": [{"kind": "area", "of_start": 1}],
    "designer": {"evaluations": 3},
    "verify": [],
}
TURBULENT = {**POINT, "model": "sa", "reynolds": 1e6}


def flow(*points, **changes):
    return {"flow": [{**point, **changes} for point in points or (POINT,)]}


def mesh(**changes):
    return {"mesh": {**PROBLEM["mesh"], **changes}}


REFUSED = (
    (flow(TURBULENT, transition=[0.3, 1.5]), "flow 1: found 1.5 as 'transition', expected 0.0 to 1.0"),
    (flow(TURBULENT, transition=[0.3]), "flow 1: found 1 numbers as 'transition', expected two"),
    (flow(transition=[0.3, 0.5]), "flow 1: found 'transition' with the model \"laminar\", expected \"sa\""),
    (flow(TURBULENT, reynolds=1e12), "flow 1: found 1000000000000.0 as 'reynolds', expected 1.0 to 10000000000.0"),
    (flow(reynolds=0.5), "flow 1: found 0.5 as 'reynolds'"),
    ({"flow": [{"mach": 0.5, "model": "sa"}]}, "reynolds"),
    ({"flow": [{"mach": 0.5, "reynolds": 500}]}, "flow 1: found 'reynolds' without a model with friction"),
    (flow(model="k-omega"), "model"),
    (flow(modle="sa"), "found the key 'modle'"),
    (flow(POINT, {"mach": 0.5}), "flow 2: found the model \"euler\" beside points of another kind, expected friction at all points or at none"),
    (flow(mach=1.2, cl=0.5), "found 'cl' with a 'mach' above 1, expected 'alpha_deg'"),
    (flow(wall_temperature=1.1), "found the key 'wall_temperature'"),
    ({**flow({"mach": 0.5}), **mesh(layers=LAYERS)}, "mesh: found 'layers' without friction"),
    ({**flow({"mach": 0.5}), "mesh": {"points": 40}, "objective": "friction_drag"}, "found 'friction_drag' without friction"),
    ({"constraints": [{"kind": "frictiondrag", "at_most": 1}]}, "constraint 1: found 'frictiondrag' as 'kind', expected "),
    (mesh(points=40), "mesh: found 40 as 'points' with friction, expected 150 or more; 300 are usual"),
    (mesh(layers={**LAYERS, "first_height": -1}), "mesh: found 'layers' that no walls can have: first layer height: found -1"),
    (mesh(layers={**LAYERS, "growth": 9}), "mesh: found 'layers' that no walls can have: growth: found 9"),
    (mesh(layers={**LAYERS, "height": 1}), "found the key 'height'"),
    (mesh(farfield_radius=1.5), "mesh: found 1.5 as 'farfield_radius'"),
    ({"objective": "inverse"}, "target"),
    ({"target": "naca:2412"}, "found 'target' with the objective 'drag', expected 'inverse'"),
    ({**flow(cl=0.3), "objective": "lift"}, "found the objective 'lift' with 'cl', expected 'alpha_deg' alone"),
    ({"constraints": [{"kind": "lift", "at_least": 0.1, "point": 1}]}, "constraint 1: found 1 as 'point', expected a whole number from 0 to 0"),
)  # fmt: skip


class HardFriction(ProgramTest):
    def problem(self, **changes):
        return self.write("problem.json", json.dumps({**PROBLEM, **changes}))

    def test_mistakes_are_named_when_the_problem_is_read(self):
        for changes, name in REFUSED:
            with self.subTest(changes):
                self.assertIn("problem.json", self.refused("design", self.problem(**changes), "-o", "run", names=name))
                self.assertFalse(self.path("run").exists())

    def test_walls_without_a_layer_are_named(self):
        flat = {"degree": 2, "upper": [0.1, 0.1, 0.1], "lower": [0.1, 0.1, 0.1]}
        self.write("flat.json", json.dumps(flat))
        self.refused("design", self.problem(degree=2, objective="inverse", target="flat.json"), "-o", "run",
                     names="problem.json: found a 'target' that has no layer")  # fmt: skip
        self.write("duct.json", json.dumps(DUCT))
        problem = {key: value for key, value in PROBLEM.items() if key not in ("airfoil", "degree", "constraints", "mesh")}
        ends = {"inlets": [{"name": "inlet"}], "outlets": [{"name": "outlet", "pressure": 0.75}]}
        leaning = copy.deepcopy(DUCT)
        curves = leaning["loops"][0]["curves"]
        at = next(i for i, curve in enumerate(curves) if curve["name"] == "inlet")
        line = lambda a, b: {"name": "inlet", "shape": {"kind": "line", "from": a, "to": b}, "stations": 4}
        curves[at : at + 1] = [line([-0.1, 0.4], [-0.3, 0.3]), line([-0.3, 0.3], [-0.1, 0])]
        self.write("leaning.json", json.dumps(leaning))
        for domain, point, name in (("duct.json", {}, "expected"),
                                    ("leaning.json", ends, "found 'layers' that no walls can have: layers: found an angle of")):  # fmt: skip
            text = {**problem, "space": {"domain": domain, "deformations": [POINTS]}, **flow(**point)}
            self.refused("design", self.write("problem.json", json.dumps(text)), "-o", "run", names=name)

    def test_a_duct_is_designed_with_friction(self):
        self.write("duct.json", json.dumps(DUCT))
        problem = {key: value for key, value in PROBLEM.items() if key not in ("airfoil", "degree", "constraints", "mesh")}
        ends = {"inlets": [{"name": "inlet"}], "outlets": [{"name": "outlet", "pressure": 0.75}]}
        text = {**problem, "space": {"domain": "duct.json", "deformations": [POINTS]}, "objective": "mass_flow", **flow(**ends),
                "mesh": {"points": 150, "gradation": 4}, "verify": []}  # fmt: skip
        figures = self.figures("design", self.write("problem.json", json.dumps(text)), "-o", "run")
        self.assertLess(figures["objective"], 1.02 * figures["start_objective"])  # made large: below 0

    def test_searches_without_a_solution_end_with_a_sentence(self):
        for changes, sentence in (
            ({"constraints": [{"kind": "lift", "at_least": 0.5}, {"kind": "lift", "at_most": 0.1}]}, "no design is within all constraints"),
            ({"constraints": [{"kind": "friction_drag", "at_most": -1}]}, "violates 'friction_drag' most"),
            ({"constraints": [{"kind": "area", "at_least": 0.3}]}, "violates 'area' most"),
            ({"constraints": [{"kind": "suction", "at_most": 0.1}]}, "violates 'suction' most"),
            (flow(mach=1.2), None),
            (flow(alpha_deg=30), None),
            (flow(reynolds=1), None),
        ):  # fmt: skip
            with self.subTest(changes):
                outcome = self.run_program("design", self.problem(**changes), "-o", "run", "--overwrite", "--json", "--quiet")
                self.assertIn(outcome.status, (0, 1, 3), outcome)
                self.assertEqual(outcome.stderr, "")
                figures = outcome.json()
                if sentence:
                    self.assertIn(sentence, figures["detail"])
                else:
                    self.assertLess(figures["objective"], figures["start_objective"])
                self.assertTrue(self.path("run/best.json").exists())

    def test_a_search_without_any_flow_says_what_to_do(self):
        """No lift of 5, whose flow is looked for by way of smaller lifts."""
        problem = self.problem(**flow(cl=5), constraints=[], designer={"evaluations": 1})
        figures = self.figures("design", problem, "-o", "run", status=3)
        self.assertIsNone(figures["objective"])
        self.assertIn("no flow was found for any design: begin with a section, conditions and points for which", figures["detail"])
        with sqlite3.connect(f"file:{self.path('run')}/history.sqlite?mode=ro", uri=True) as history:
            rows = list(history.execute("select detail from evaluations"))
        self.assertEqual(len(rows), 1)
        self.assertIn("no flow was found", rows[0][0])

    def test_a_start_that_is_thrown_away_is_kept_in_the_history(self):
        """The first design has no lift, so that drag over lift has no value: the search begins beside it."""
        problem = self.problem(objective="lift_over_drag", **flow(alpha_deg=-0.02), constraints=[], designer={"evaluations": 6, "trust": 0.02})
        figures = self.figures("design", problem, "-o", "run", status=3)
        self.assertIsNone(figures["start_objective"])
        self.assertGreater(figures["objective"], 0)
        with sqlite3.connect(f"file:{self.path('run')}/history.sqlite?mode=ro", uri=True) as history:
            first, = history.execute("select detail from evaluations where evaluation = 1").fetchone()
        self.assertIn("the lift is not positive", first)
