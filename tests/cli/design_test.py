"""`remodel design`: a design falls in drag and keeps its constraints, on fresh meshes too; refusals. `flow --gradient`."""

import base64
import html
import json
import math
import re
import signal
import sqlite3
import subprocess
import time
from html.parser import HTMLParser
from xml.etree import ElementTree

import harness
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

    def limited(self, *arguments):
        """Figures of a search that is stopped by its number of designs."""
        figures = self.figures(*arguments, status=3)
        self.assertEqual((figures["stopped"], figures["converged"]), ("evaluations", False))
        return figures

    def test_drag_falls_and_the_area_stays(self):
        start = self.figures("flow", "naca:0012", "--points", 40, "--gradation", 0.8, "--cst-degree", 4, "--mach", 0.8)
        figures = self.limited("design", self.problem(), "-o", "run")
        self.assertLess(figures["objective"], 0.9 * figures["start_objective"])
        self.assertAlmostEqual(figures["start_objective"], start["cd"], delta=0.4 * start["cd"])  # half a mesh, another one
        self.assertEqual(figures["evaluations"], 5)
        best = figures["best"]
        self.assertEqual([-c for c in best["upper"]], best["lower"])
        self.assertTrue(figures["verified"][0]["converged"])
        self.assertLess(figures["verified"][0]["cd"], start["cd"])
        resumed = self.limited("design", self.problem(), "-o", "run", "--resume")
        self.assertEqual(resumed["best"], best)

    def test_two_fresh_meshes_say_what_the_finer_lacks(self):
        figures = self.limited("design", self.problem(verify=[80, 40], designer={"evaluations": 2}), "-o", "run")
        fine, coarse = figures["verified"]
        start = figures["verified_start"][1]  # on a mesh like the search's first one, which has the same flow
        self.assertAlmostEqual(start["cd"], figures["start_objective"], delta=1e-8)
        self.assertEqual([entry["points"] for entry in figures["verified_start"]], [80, 40])
        self.assertNotIn("error", coarse)
        self.assertGreater(fine["mach_max"], 1)  # so that errors are taken to fall with the edges' length
        self.assertEqual(fine["error"]["order"], 1)
        self.assertAlmostEqual(fine["error"]["cd"], max(fine["cd"] - coarse["cd"], -fine["cd"]), places=12)
        self.assertLess(fine["error"]["cd"], 0)
        self.succeed("design", "report", "run")
        self.assertIn(f"<td>{1e4 * fine['error']['cd']:.2f}</td>", self.path("run/report.html").read_text())

    def test_a_search_that_ends_by_itself_is_done_and_one_at_its_limit_is_not(self):
        """What is finished is written at the limit too, fresh meshes included, and the search goes on from there."""
        limited = self.limited("design", self.problem(designer={"evaluations": 2}), "-o", "run")
        self.assertTrue(limited["verified"][0]["converged"])
        for name in ("best.json", "last.vtkhdf", "fresh.json", "result.json", "checkpoint.json"):
            self.assertTrue(self.path(f"run/{name}").exists(), name)
        figures = self.figures("design", self.problem(designer={"evaluations": 100}), "-o", "run", "--resume")
        self.assertEqual((figures["stopped"], figures["converged"]), ("done", True))
        self.assertLess(figures["evaluations"], 100)
        whole = self.figures("design", self.problem(designer={"evaluations": 100}), "-o", "whole")
        self.assertEqual(whole["evaluations"], figures["evaluations"])

    def test_a_designer_that_there_is_not_is_refused_with_those_that_there_are(self):
        for name in ("slsqp", "mma", "SQP", ""):
            line = self.refused("design", self.problem(designer={"name": name}), "-o", "run", names="problem.json, designer: found")
            self.assertIn(f"found '{name}' as 'name', expected sqp, cmaes", line)

    def test_paths_lead_on_from_the_problem_file(self):
        """Not from the directory in which the program is, which may have another file of the name."""
        shape = json.dumps({key: value for key, value in self.figures("fit", "naca:0012", "--cst-degree", 4).items()
                            if key in ("degree", "upper", "lower")})
        self.path("problems/shapes").mkdir(parents=True)
        self.path("problems/shapes/a.json").write_text(shape)
        self.path("problems/plain").write_bytes(b"not an airfoil")
        self.path("elsewhere").mkdir()
        designer = {"evaluations": 1}
        contains = [{"kind": "contains", "airfoil": "shapes/a.json"}]
        for name, changes in (
            ("airfoil", {"airfoil": "shapes/a.json"}),
            ("absolute", {"airfoil": str(self.path("problems/shapes/a.json"))}),
            ("contains", {"constraints": contains}),
            ("target", {"airfoil": "naca:2412", "symmetric": False, "objective": "inverse", "target": "shapes/a.json", "constraints": []}),
            ("elements", {"elements": [{"name": "main", "airfoil": "shapes/a.json", "variables": {"coefficients": True}}]}),
        ):
            problem = {**PROBLEM, "designer": designer, "verify": [], **changes}
            if name == "elements":
                problem["constraints"] = []
                del problem["airfoil"], problem["symmetric"]
            self.path(f"problems/{name}.json").write_text(json.dumps(problem))
            self.succeed("design", f"problems/{name}.json", "-o", name, "--quiet", status=3)
        self.refused("design", self.problem(airfoil="shapes/a.json"), "-o", "run", names="problem.json: as 'airfoil', shapes/a.json: ")
        # A name alone is that of a file beside the problem, not of one beside the program.
        self.write("lonely", shape)
        self.write("problems/lonely.json", json.dumps({**PROBLEM, "airfoil": "lonely"}))
        self.refused("design", "problems/lonely.json", "-o", "run", names="found \"lonely\"")
        self.write("problems/plain.json", json.dumps({**PROBLEM, "airfoil": "plain"}))
        self.refused("design", "problems/plain.json", "-o", "run", names="problems/plain")

    def test_keys_of_no_use_are_refused(self):
        """Each with its place and what is of use there."""
        of_cmaes, of_gradients = "expected evaluations, sigma, seed, workers", "expected evaluations, bounds, trust"
        lift = [{"kind": "lift", "at_least": 0.1}]
        other = {"mach": 0.5, "weight": 0}
        for changes, place, name in (
            ({"designer": {"sigma": 0.1}}, ", designer", f"found the key 'sigma', which 'sqp' has no use for, {of_gradients}"),
            ({"designer": {"name": "cmaes", "trust": 0.1}}, ", designer", f"found the key 'trust', which 'cmaes' has no use for, {of_cmaes}"),
            ({"designer": {"name": "cmaes", "bounds": 0.1}}, ", designer", f"found the key 'bounds', which 'cmaes' has no use for, {of_cmaes}"),
            ({"flow": [{"mach": 0.8}, other]}, ", flow 2", "found 0 as 'weight' of a point that no constraint names, expected a number above 0"),
            ({"flow": [other], "constraints": lift}, "", "found 0 as 'weight' of each point of 'flow', expected a number above 0 of one"),
            ({"flow": [{"mach": 0.5, "cl": 0.2}], "constraints": lift}, ", constraint 1", "found 'lift' of a point whose 'cl' is given, expected"),
            ({"constraints": [], "constraint_tolerance": 0.1}, "", "found 'constraint_tolerance' without 'constraints', expected both or none"),
        ):
            line = self.refused("design", self.problem(**changes), "-o", "run", names=name)
            self.assertIn(f"problem.json{place}: found", line)
        self.refused("design", self.elements(designer={"evaluations": 1, "bounds": 0.1}), "-o", "run", names="flap.json, designer: found the key 'bounds'")
        problem = self.problem(flow=[{"mach": 0.8}, other], constraints=[{"kind": "lift", "point": 1, "at_least": 0}],
                               designer={"evaluations": 1}, verify=[])
        self.limited("design", problem, "-o", "run")  # a point for its constraint alone is of use

    def test_adodg_1_on_a_coarse_mesh(self):
        """NACA 0012 contained, Mach 0.85: half a mesh, page and film of the run."""
        problem = json.loads((SOURCE / "examples/design/adodg1_coarse.json").read_text())
        problem["designer"]["evaluations"] = 15
        problem["verify"] = []
        figures = self.limited("design", self.write("adodg1.json", json.dumps(problem)), "-o", "run")
        self.assertLess(figures["objective"], 0.5 * figures["start_objective"])
        self.assertGreater(figures["cold_equivalents"], 0)
        with sqlite3.connect(f"file:{self.path('run')}/history.sqlite?mode=ro", uri=True) as history:
            query = "select json_extract(outputs, '$.factorisations') from evaluations order by evaluation"
            factorisations = [count for count, in history.execute(query)]
        # The first flow is a cold one: what the others take is to be worth half a cold solve each at the most.
        self.assertLess(sum(factorisations), factorisations[0] * figures["flows"] / 2)
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

    def test_reports_and_films_refuse_damaged_designs(self):
        """A history whose designs have another number of numbers ends neither in a crash nor in an internal error."""
        self.succeed("design", self.problem(designer={"evaluations": 2}, verify=[]), "-o", "run", "--quiet", status=3)
        for text, found in (("[]", 0), (None, 0), ("[0.1,0.1,0.1]", 3)):
            history = sqlite3.connect(self.path("run/history.sqlite"))
            history.execute("update evaluations set coefficients = ? where evaluation = 2", (text,))
            history.commit()
            history.close()
            message = f"run/history.sqlite: evaluation 2: found a design of {found} numbers, expected 5"
            self.refused("design", "report", "run", names=message)
            self.refused("film", "run", "-o", "film.webp", names="run/history.sqlite")

    def test_refusals(self):
        for changes, name in (
            ({"speed": 1}, "problem.json: found the key 'speed', expected airfoil"),
            ({"objective": "beauty"}, "beauty"),
            ({"flow": []}, "flow"),
            ({"flow": [{"mach": 0}]}, "mach"),
            ({"constraints": [{"kind": "lift", "point": 1, "at_least": 0}]}, "point"),
            ({"airfoil": "naca:xyz"}, "problem.json: as 'airfoil', "),
            ({"flow": [{"mach": 1.2, "cl": 0.3}]}, "problem.json, flow 1: found 'cl' with a 'mach' above 1"),
            ({"mesh": {"points": 41}}, "problem.json, mesh: found 41 as 'points', expected an even number"),
            ({"degree": 4.7}, "problem.json: found 4.7 as 'degree', expected a whole number from 1 to 30"),
            ({"designer": {"evaluations": 2.5}}, "problem.json, designer: found 2.5 as 'evaluations'"),
            ({"designer": {"seed": -1}}, "problem.json, designer: found -1 as 'seed'"),
            ({"verify": [40, 0]}, "problem.json: found 0 as 'verify', expected a whole number from 8"),
            ({"verify": [41]}, "problem.json: found 41 in 'verify', expected even numbers"),
            ({"verify": 40}, "problem.json: expected an array as 'verify'"),
            ({"target": "naca2412"}, "problem.json: found 'target' with the objective 'drag', expected 'inverse'"),
            ({"symmetric": 1}, "problem.json: found 1 as 'symmetric'"),
            ({"airfoil": "rae2822"}, "problem.json: found an airfoil as 'airfoil' whose surfaces differ by 0.0"),
        ):
            self.refused("design", self.problem(**changes), "-o", "run", names=name)
        self.refused("design", self.write("a.json", "{"), "-o", "run", names="a.json")
        self.refused("design", self.write("a.json", '{"degree": 4, "degree": 5}'), "-o", "run", names='a.json:1: found the key "degree" a second time in one object at column 15, expected each key once')
        self.refused("design", self.write("a.json", '{"flow": [{"mach": 1,\n  "ma\\u0063h": 2}]}'), "-o", "run", names='a.json:2: found the key "mach" a second time in one object at column 3')
        self.refused("design", self.write("a.json", '{"a\\"b": 1, "a\\"b": 2}'), "-o", "run", names='at column 13, expected each key once')
        self.refused("design", self.write("a.json", "[" * 100000), "-o", "run", names="a.json:1: found more than 64 brackets inside each other at column 66, expected fewer")
        self.path("thesis").mkdir()
        self.path("thesis/chapter").write_text("1")
        self.refused("design", self.problem(), "-o", "thesis", names="thesis")


    def elements(self, points=32, evaluations=4, **changes):
        """The three elements of the example on a coarse mesh."""
        problem = json.loads((SOURCE / "examples/design/flap.json").read_text())
        problem["mesh"] = {"points": points, "gradation": 1.5}
        problem["constraints"] = [c for c in problem["constraints"] if c["kind"] != "drag"]  # a coarse mesh has drag of its own
        problem["designer"]["evaluations"] = evaluations
        problem["verify"] = [points]
        return self.write("flap.json", json.dumps({**problem, **changes}))

    def test_flap_and_slat_are_set_for_lift(self):
        """More lift within bounds, gaps and suction peaks; the best design is a domain file; page and film of the run."""
        figures = self.limited("design", self.elements(), "-o", "run")
        self.assertLess(figures["objective"], 1.02 * figures["start_objective"])  # minus the lift
        self.assertAlmostEqual(figures["cl"], -figures["objective"])
        for name, (low, high) in {"slat.rotation_deg": (15, 50), "flap.rotation_deg": (-45, -5), "flap.x": (0.94, 1.04)}.items():
            self.assertGreaterEqual(figures[name], low - 1e-9)
            self.assertLessEqual(figures[name], high + 1e-9)
        self.assertEqual([loop["curves"][0]["name"] for loop in figures["best"]["loops"]], ["slat", "main", "flap", "farfield"])
        self.assertEqual(figures["best"]["loops"][2]["placement"]["rotation_deg"], figures["flap.rotation_deg"])
        self.assertTrue(figures["verified"][0]["converged"])
        fresh = self.figures("mesh", "run/best.json", "-o", "best.vtkhdf")
        self.assertEqual(sorted(fresh["boundary"]), ["farfield", "flap", "main", "slat"])
        report = self.figures("design", "report", "run")
        self.assertEqual(report["objective"], figures["objective"])
        page = self.path("run/report.html").read_text()
        self.assertEqual(page.count("<polygon"), 6)
        self.assertIn("slat.rotation_deg", page)
        self.assertEqual(self.figures("film", "run", "-o", "film.webp", "--frames", 3)["frames"], 3)
        resumed = self.limited("design", self.elements(), "-o", "run", "--resume")
        self.assertEqual(resumed["best"], figures["best"])

    def test_names_of_elements_are_text_in_pages_and_pictures(self):
        nasty = "</script><script>alert(1)</script><img src=x onerror=alert(2)> & \"'`"
        text = self.path(self.elements(evaluations=1, verify=[])).read_text()
        self.write("nasty.json", text.replace('"flap"', json.dumps(nasty)))
        self.succeed("design", "nasty.json", "-o", "run", "--quiet", status=3)
        self.succeed("design", "report", "run")
        tags, words = [], []
        parser = HTMLParser()
        parser.handle_starttag = lambda tag, attributes: tags.append(tag)
        parser.handle_data = words.append
        page = self.path("run/report.html").read_text()
        parser.feed(page)
        self.assertNotIn("script", tags)
        self.assertEqual(page.count("<img"), page.count('<img alt="" src="data:image/'))
        self.assertIn(nasty + ".rotation_deg", words)
        pictures = re.findall(r"data:image/svg\+xml;base64,([^\"]+)", page)
        self.assertGreater(len(pictures), 2)
        for picture in pictures:
            tree = ElementTree.fromstring(base64.b64decode(picture))
            self.assertEqual([e.tag for e in tree.iter() if e.tag.endswith("script")], [])

    def test_lists_are_bounded(self):
        """Each is refused at once, whatever its length."""
        many = 100_000
        lift = {"kind": "lift", "at_least": 0.1}
        thickness = {"kind": "thickness", "x": [0.5] * 1000, "of_start": 0.9}
        changes = {
            "100000 entries in 'constraints', expected at most 1000": {"constraints": [lift] * many},
            "100000 entries in 'verify', expected at most 100": {"verify": [40] * many},
            "100000 entries in 'flow', expected at most 1000": {"flow": [{"mach": 0.5}] * many},
            "100000 entries in 'x', expected at most 1000": {"constraints": [{**thickness, "x": [0.5] * many}]},
            "expected at most 10000": {"constraints": [thickness] * 1000},
        }
        for name, change in changes.items():
            with self.subTest(name):
                begin = time.monotonic()
                self.refused("design", self.problem(**change), "-o", "run", names=name)
                self.assertLess(time.monotonic() - begin, 20)
        elements = [{"name": f"e{i}", "airfoil": "naca:0012"} for i in range(many)]
        problem = {key: value for key, value in PROBLEM.items() if key not in ("airfoil", "symmetric")}
        self.refused(
            "design", self.write("many.json", json.dumps({**problem, "elements": elements})), "-o", "run",
            names="100000 entries in 'elements', expected at most 20",
        )  # fmt: skip

    def test_refusals_of_elements(self):
        elements = json.loads(self.path(self.elements()).read_text())["elements"]

        def changed(index, **changes):
            return {"elements": [{**e, **changes} if i == index else e for i, e in enumerate(elements)], "constraints": []}

        suction = {"kind": "suction", "at_most": 5}
        for changes, name in (
            ({"airfoil": "naca:0012"}, "expected one of 'airfoil', 'elements' and 'space'"),
            ({"symmetric": True}, "found 'symmetric' with 'elements'"),
            ({"objective": "inverse", "target": "naca:0012"}, "found the objective 'inverse' with 'elements'"),
            ({"flow": [{"mach": 0.2, "cl": 1}]}, "found the objective 'lift' with 'cl'"),
            (changed(2, placement={"chord": 0.3, "position": [0.5, 0]}), "found 'elements' that make no domain: "),
            (changed(2, placement={"chord": 0.3, "position": [0.5]}), "element 3, placement: found [0.5] as 'position', expected [x, y]"),
            (changed(0, name="main"), "found two elements of the name 'main'"),
            (changed(0, variables={"z": {"bounds": [0, 1]}}), "element 1, variables: found the key 'z', expected coefficients, chord"),
            (changed(0, variables={"x": {"bounds": [1, 0]}}), "element 1, variables, x: found [1.0,0.0] as 'bounds'"),
            (changed(0, variables={"x": {"bounds": [0, 1]}}), "element 1, variables, x: found bounds that the start, -0.18, is not within"),
            ({"elements": [{**e, "variables": {}} for e in elements], "constraints": []}, "found no variable of any element"),
            ({"constraints": [{**suction, "element": "tail"}]}, "constraint 1: found 'tail', expected the name of an element"),
            ({"constraints": [{**suction, "at_least": 1}]}, "found the key 'at_least', which 'suction' has not"),
            ({"constraints": [{"kind": "gap", "between": ["slat"], "at_least": 0.01}]}, "expected the names of two elements"),
            ({"constraints": [{"kind": "area", "element": "main", "of_start": 1}]}, "found 'main' as 'element', whose coefficients are no variables"),
        ):
            self.refused("design", self.elements(**changes), "-o", "run", names="flap.json")
            self.refused("design", self.elements(**changes), "-o", "run", names=name)
        gap = [{"kind": "gap", "between": ["a", "b"], "at_least": 0.01}]
        self.refused("design", self.problem(constraints=gap), "-o", "run", names="found 'gap', expected it with 'elements' alone")

    def test_refusals_of_constraints(self):
        """One sentence with the file, the constraint's number and what was expected; nothing is left out in silence."""
        blunt_nose = {"degree": 2, "upper": [0.1, 0.1, 0.1], "lower": [-0.1, -0.1, -0.1], "e1": 0.6}
        for entry, name in (
            ({"kind": "leading_edge_radius", "at_least": -0.01}, "found -0.01 as 'at_least', expected 0.0 to 1.0"),
            ({"kind": "trailing_edge_angle", "at_least": 200}, "found 200.0 as 'at_least', expected 0.0 to 90.0"),
            ({"kind": "trailing_edge_angle", "of_start": 8}, "degrees, expected 90 at most"),
            ({"kind": "trailing_edge_angle", "at_least": "7"}, "found \"7\" as 'at_least', expected a number"),
            ({"kind": "trailing_edge_angle", "at_least": None}, "found null as 'at_least', expected a number"),
            ({"kind": "trailing_edge_angle", "at_leest": 7}, "found the key 'at_leest', expected kind"),
            ({"kind": "trailing_edge_angle", "at_most": 7}, "found the key 'at_most', which 'trailing_edge_angle' has not"),
            ({"kind": "leading_edge_radius", "at_least": 0.01, "x": [0]}, "found the key 'x', which"),
            ({"kind": "leading_edge_radius"}, "expected one of at_least and of_start"),
            ({"kind": "leading_edge_radius", "at_least": 0.01, "of_start": 1}, "expected one of at_least and of_start"),
            ({"kind": "area", "at_least": 0.01, "of_start": 1}, "expected one of at_least and of_start"),
            ({"kind": "thickness", "x": [], "at_least": 0.1}, "found no number in 'x'"),
            ({"kind": "tank", "x": [0.6, 0.2], "at_least": 0.01}, "expected two numbers, the front one first"),
            ({"kind": "box", "x": [0.2], "of_start": 0.9}, "expected two numbers, the front one first"),
            ({"kind": "camber", "x": [0.4]}, "found neither 'at_least' nor 'at_most'"),
            ({"kind": "camber", "x": [0.4], "at_most": 2}, "found 2.0 as 'at_most', expected -1.0 to 1.0"),
            ({"kind": "contains", "airfoil": "nope"}, "as 'airfoil', shape: found \"nope\""),
            ({"kind": "lift", "point": 0.7, "at_least": 0}, "found 0.7 as 'point', expected a whole number from 0 to 0"),
            ({"kind": "lift", "point": -1, "at_least": 0}, "found -1 as 'point'"),
            (3, "found number, expected an object"),
        ):
            constraints = [{"kind": "area", "of_start": 1}, entry]
            self.refused("design", self.problem(constraints=constraints), "-o", "run", names="problem.json, constraint 2: ")
            self.refused("design", self.problem(constraints=constraints), "-o", "run", names=name)
        self.write("nose.json", json.dumps(blunt_nose))
        constraints = [{"kind": "leading_edge_radius", "of_start": 1}]
        self.refused("design", self.problem(airfoil="nose.json", constraints=constraints, degree=2), "-o", "run",
                     names="constraint 1: found an airfoil of another class, expected one that is round in front")

    def test_angle_and_radius_are_kept(self):
        """With an angle of attack the domain of a symmetric section is whole."""
        constraints = [{"kind": "trailing_edge_angle", "at_least": 19}, {"kind": "leading_edge_radius", "of_start": 0.9}]
        problem = self.problem(constraints=constraints, flow=[{"mach": 0.7, "alpha_deg": 1}], verify=[])
        figures = self.limited("design", problem, "-o", "run")
        self.assertEqual(sorted(self.figures("check", "run/last.vtkhdf")["boundary"]), ["airfoil", "farfield"])
        start = self.figures("fit", "naca:0012", "--cst-degree", 4)["upper"]
        best = figures["best"]["upper"]
        self.assertGreater(2 * math.degrees(math.atan(best[-1])), 19 - 1e-6)
        self.assertGreater(best[0] ** 2, 0.9 * start[0] ** 2 * (1 - 1e-6))
        self.assertEqual([-c for c in best], figures["best"]["lower"])


    def rows(self, directory):
        file = self.path(directory) / "history.sqlite"
        if not file.exists():
            return []
        with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as history:
            return history.execute("select evaluation, coefficients, objective, constraints from evaluations").fetchall()

    def test_several_points_have_the_same_bits_on_any_number_of_threads(self):
        points = [{"mach": 0.8, "alpha_deg": 0}, {"mach": 0.75, "alpha_deg": 1, "weight": 0.5}]
        problem = self.problem(flow=points, verify=[])
        for threads in (1, 2):
            self.succeed("design", problem, "-o", f"run{threads}", "--threads", threads, "--quiet", status=3)
        self.assertEqual(len(self.rows("run1")), 5)
        self.assertEqual(self.rows("run1"), self.rows("run2"))

    def end_by_sigterm(self, problem, run, file, *options, after_a_design=False):
        """Status, figures, and the seconds from the signal to the end. It is sent once the run has this file, or also its
        progress a line."""
        progress = self.path("progress").open("w+")
        process = subprocess.Popen([harness.PROGRAM, "design", problem, "-o", run, "--json", *options],
                                   cwd=self.directory, stdout=subprocess.PIPE, stderr=progress)
        deadline = time.monotonic() + 120
        is_due = lambda: self.path(f"{run}/{file}").exists() and not (
            after_a_design and "objective" not in self.path("progress").read_text())
        while not is_due() and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.05)
        time.sleep(2)
        sent = time.monotonic()
        process.send_signal(signal.SIGTERM)
        try:
            out, _ = process.communicate(timeout=60)
        finally:
            process.kill()
            progress.close()
        return process.returncode, json.loads(out), time.monotonic() - sent

    def test_an_overwritten_run_leaves_no_numbers_of_its_own(self):
        self.succeed("design", self.problem(designer={"evaluations": 2}), "-o", "run", "--quiet", status=3)
        self.succeed("design", "report", "run")
        self.assertIn("On fresh meshes", self.path("run/report.html").read_text())
        self.assertIn("; 2 designs on a mesh", self.path("run/report.html").read_text())
        self.succeed("design", self.problem(designer={"evaluations": 1}, verify=[]), "-o", "run", "--quiet", "--overwrite", status=3)
        self.assertFalse(self.path("run/fresh.json").exists())
        self.assertFalse(self.path("run/report.html").exists())

    def test_a_page_has_fresh_meshes_of_its_best_design_alone(self):
        """A run that goes on without a verification has a better design than that of fresh.json."""
        self.succeed("design", self.problem(designer={"evaluations": 1}), "-o", "run", "--quiet", status=3)
        self.succeed("design", self.problem(designer={"evaluations": 5}, verify=[]), "-o", "run", "--quiet", "--resume", status=3)
        self.assertTrue(self.path("run/fresh.json").exists())
        self.succeed("design", "report", "run")
        self.assertNotIn("On fresh meshes", self.path("run/report.html").read_text())

    def test_an_unfinished_run_has_a_page(self):
        """A run that was killed has left no mesh of its last design."""
        self.succeed("design", self.problem(designer={"evaluations": 3}, verify=[]), "-o", "run", "--quiet", status=3)
        for name in ("last.vtkhdf", "best.json", "result.json"):
            self.path(f"run/{name}").unlink()
        self.assertEqual(self.figures("design", "report", "run")["designs"], 3)

    def test_interrupted_sessions_lose_no_design(self):
        """Each session ends within a flow, of which the meshes of M 0.85 give time enough."""
        problem = self.problem(mesh={"points": 100}, flow=[{"mach": 0.85, "alpha_deg": 0}], designer={"evaluations": 12}, verify=[])
        done = 0
        for session in range(3):
            options = ["--resume"] if session else []
            # The first one ends after a design; where that takes long, the others may end before the next one.
            status, figures, _ = self.end_by_sigterm(problem, "run", "first.vtkhdf", *options, after_a_design=not session)
            self.assertEqual(len(self.rows("run")), figures["evaluations"])
            self.assertGreaterEqual(figures["evaluations"], done)
            checkpoint = json.loads(self.path("run/checkpoint.json").read_text())
            self.assertEqual(checkpoint["evaluation"], figures["evaluations"])
            done = figures["evaluations"]
            if status == 0:
                break
        self.assertGreater(done, 0)
        self.succeed("design", "report", "run")

    def test_a_run_without_a_flow_has_not_converged(self):
        """No lift of 5 at M 0.5: no number stands for it, in figures and on the page."""
        problem = self.problem(symmetric=False, flow=[{"mach": 0.5, "cl": 5}], constraints=[])
        figures = self.figures("design", problem, "-o", "run", status=1)
        self.assertIs(figures["converged"], False)
        self.assertIsNone(figures["objective"])
        self.assertIsNone(figures["start_objective"])
        self.assertIn("no flow was found for any design", figures["detail"])
        report = self.figures("design", "report", "run")
        self.assertIsNone(report["objective"])
        page = self.path("run/report.html").read_text()
        self.assertIn("No best design: no flow was found for any design", page)
        self.assertNotIn("inf", page.split("<h2>Pressure</h2>")[0].split("</style>")[1])

    def test_a_run_without_a_feasible_design_says_why(self):
        constraints = [{"kind": "drag", "at_most": -1}, {"kind": "area", "of_start": 1}]
        problem = self.problem(constraints=constraints, designer={"evaluations": 2})
        figures = self.figures("design", problem, "-o", "run", status=3)
        self.assertIn("violates 'drag' most, by 1.0", figures["detail"])
        self.assertGreater(figures["constraints"]["drag"], 1)
        self.assertIs(figures["converged"], False)
        self.assertIn("violates 'drag' most", self.succeed("design", problem, "-o", "run", "--overwrite", status=3).stdout)
        self.succeed("design", "report", "run")
        page = self.path("run/report.html").read_text()
        self.assertTrue("violates 'drag' most" in html.unescape(page))
        self.assertIn("least violated", page)

    def test_figures_name_constraints_and_count_in_whole_numbers(self):
        figures = self.limited("design", self.problem(designer={"evaluations": 2}, verify=[]), "-o", "run")
        self.assertEqual(figures["constraints"], {"area": 0})
        for key in ("flows", "gradients", "connectivity", "factorisations", "replacements"):
            self.assertIsInstance(figures[key], int, key)
        self.assertEqual(self.figures("design", "report", "run")["constraints"], {"area": 0})

    def test_verification_says_which_constraints_are_violated(self):
        """Drag at most what the run's mesh has for the start: a mesh of fewer points has more."""
        start = self.limited("design", self.problem(designer={"evaluations": 1}, verify=[]), "-o", "start")["objective"]
        problem = self.problem(constraints=[{"kind": "drag", "at_most": start}], designer={"evaluations": 1}, verify=[16])
        figures = self.limited("design", problem, "-o", "run")
        fresh = figures["verified"][0]
        self.assertAlmostEqual(fresh["violated"]["drag"], fresh["cd"] - start)
        self.assertIn("violates 'drag' by", self.succeed("design", problem, "-o", "run", "--overwrite", status=3).stdout)
        self.succeed("design", "report", "run")
        self.assertIn("<td>drag by ", self.path("run/report.html").read_text())

    def test_constraints_have_a_tolerance(self):
        """`of_start` holds for the start, whatever rounding makes of it; and a tolerance of the problem's own."""
        problem = self.problem(designer={"evaluations": 1}, verify=[])
        figures = self.limited("design", problem, "-o", "run")
        self.assertEqual(figures["objective"], figures["start_objective"])
        constraints = [{"kind": "area", "of_start": 1.1}]
        figures = self.figures("design", self.problem(constraints=constraints, designer={"evaluations": 1}, verify=[]), "-o", "a", status=3)
        lack = figures["constraints"]["area"]
        wide = self.problem(constraints=constraints, constraint_tolerance=1.01 * lack, designer={"evaluations": 1}, verify=[])
        self.assertEqual(self.limited("design", wide, "-o", "b")["constraints"]["area"], 0)

    def test_the_objective_of_the_start_is_its_own(self):
        """CMA-ES does not evaluate the start."""
        figures = self.limited("design", self.problem(designer={"name": "cmaes", "evaluations": 2}, constraints=[], verify=[]), "-o", "run")
        self.assertIsNone(figures["start_objective"])

    def test_errors_of_syntax_have_a_place(self):
        for text, name in (
            ('{"degree": 4,\n "flow": [,]}', "a.json:2: found no JSON at column 11"),
            ("", "a.json:1: found no JSON at column 1"),
            ('{"degree": 1e999}', "a.json:1: found a number that is too large at column 17, expected one below 1.8e308"),
        ):
            self.refused("design", self.write("a.json", text), "-o", "run", names=name)

    def test_a_hard_flow_ends_when_it_is_told(self):
        """SIGTERM in the search's first flow, and in a flow of the verification: M 0.85 on 600 points would take long."""
        hard = {"flow": [{"mach": 0.85, "alpha_deg": 0}]}
        search = self.problem(**hard, mesh={"points": 600}, symmetric=False)
        status, figures, seconds = self.end_by_sigterm(search, "searching", "first.vtkhdf")
        self.assertEqual((status, figures["stopped"], figures["evaluations"]), (3, "interrupted", 0))
        self.assertLess(seconds, 30)
        verification = self.problem(**hard, degree=9, mesh={"points": 100}, designer={"evaluations": 1}, verify=[1200])
        status, figures, seconds = self.end_by_sigterm(verification, "verifying", "result.json")
        self.assertEqual((status, figures["stopped"], figures["evaluations"]), (3, "interrupted", 1))
        self.assertFalse(self.path("verifying/fresh.json").exists())
        self.assertLess(seconds, 30)


class Gradients(ProgramTest):
    def test_a_gradient_is_the_slope_of_two_flows(self):
        flow = ("--mach", 0.4, "--alpha", 1)
        base = {key: value for key, value in self.figures("fit", "naca:2412").items() if key in ("degree", "upper", "lower")}
        self.succeed("mesh", self.write("a.json", json.dumps(base)), "--points", 40, "-o", "a.vtkhdf")
        gradient = self.figures("flow", "a.vtkhdf", *flow, "--gradient")["gradient"]
        self.assertEqual((len(gradient["cl"]), len(gradient["others"]["cl"])), (12 + 1, 2 + 4 + 5 + 4))
        lifts = []
        for step in (1e-4, -1e-4):
            upper = [base["upper"][0] + step, *base["upper"][1:]]
            self.succeed("update", "a.vtkhdf", self.write("b.json", json.dumps({**base, "upper": upper})), "--strategy", "reference",
                         "-o", "b.vtkhdf")  # fmt: skip
            lifts.append(self.figures("flow", "b.vtkhdf", *flow)["cl"])
        self.assertAlmostEqual((lifts[0] - lifts[1]) / 2e-4, gradient["cl"][0], delta=1e-4)

    def test_a_mesh_without_curves_has_none(self):
        self.succeed("mesh", "naca:2412", "--points", 40, "-o", "mesh.su2")
        self.refused("flow", "mesh.su2", "--mach", 0.4, "--gradient", names="--gradient")
