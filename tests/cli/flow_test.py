"""`remodel flow`: keys of the contract, flows that agree with each other, refusals."""

import json
import math
import os
import pty
import subprocess
import threading

import harness
from harness import SOURCE, ProgramTest, read_terminal

KEYS = "cl cd cm alpha_deg mach converged residual newton_steps factorisations krylov_iterations seconds warm"


class Flows(ProgramTest):
    def test_keys_and_values(self):
        figures = self.figures("flow", "naca:0012", "--points", 60, "--mach", 0.5, "--alpha", 1.25)
        self.assertKeys(figures, KEYS + " status bodies history memory_mb solver gmres_iterations triangles vertices model")
        self.assertTrue(figures["converged"])
        self.assertEqual(figures["warm"], "cold")
        self.assertLessEqual(figures["residual"], 1e-10)
        self.assertAlmostEqual(figures["cl"], 0.18, delta=0.03)
        self.assertEqual(len(figures["bodies"]), 1)
        self.assertAlmostEqual(figures["entropy_drag"], figures["cd"], delta=1e-4)  # there is no other

    def test_potential_flow_knows_the_mach_number(self):
        shape = ("flow", "naca:0012", "--points", 60, "--alpha", 1.25)
        slow, fast, faster = (self.figures(*shape, "--model", "potential", "--mach", mach) for mach in (0.01, 0.5, 0.8))
        self.assertAlmostEqual(fast["cl_by_pressure"], 0.1803, delta=0.006)  # of Euler's equations
        self.assertAlmostEqual(fast["cl"] / slow["cl"], (1 - 0.5**2) ** -0.5, delta=1e-3)
        self.assertEqual([f["supersonic"] for f in (slow, fast, faster)], [False, False, True])

    def test_a_mesh_file_has_the_flow_of_its_shape(self):
        self.succeed("mesh", "naca:2412", "--points", 40, "-o", "mesh.vtkhdf", "-o", "mesh.su2")
        shape = self.figures("flow", "naca:2412", "--points", 40, "--mach", 0.4)
        for name in ("mesh.vtkhdf", "mesh.su2"):
            mesh = self.figures("flow", name, "--mach", 0.4)
            self.assertAlmostEqual(mesh["cl"], shape["cl"], delta=1e-9)

    def test_the_angle_for_a_lift(self):
        figures = self.figures("flow", "naca:2412", "--points", 40, "--mach", 0.4, "--cl", 0.6)
        self.assertAlmostEqual(figures["cl"], 0.6, delta=1e-8)
        again = self.figures("flow", "naca:2412", "--points", 40, "--mach", 0.4, "--alpha", figures["alpha_deg"])
        self.assertAlmostEqual(again["cl"], 0.6, delta=1e-7)

    def test_fields_are_written_beside_the_mesh(self):
        self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.4, "-o", "flow.vtu", "-o", "flow.vtkhdf")
        text = self.path("flow.vtu").read_text(errors="replace")
        for name in ("density", "velocity", "pressure", "mach", "cp", "entropy"):
            self.assertIn(f'Name="{name}"', text)
        self.succeed("convert", "flow.vtkhdf", "-o", "again.vtu")
        self.assertIn('Name="mach"', self.path("again.vtu").read_text(errors="replace"))

    def test_a_flow_that_is_not_found_says_so(self):
        outcome = self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.6, "--max-steps", 2, "--json", status=3)
        figures = outcome.json()
        self.assertFalse(figures["converged"])
        self.assertEqual(figures["status"], "step-limit")
        self.assertIn("no flow was found", outcome.stderr)
        self.assertIn("expected 1e-10", outcome.stderr)  # the tolerance, not that of a stage

    def test_figures_of_no_flow_are_marked(self):
        shape = ("flow", "naca:0012", "--points", 40, "--mach", 0.6)
        lines = self.succeed(*shape, "--max-steps", 2, status=3).stdout.splitlines()
        end = next(i for i, line in enumerate(lines) if line.startswith("not converged"))
        for label in ("CL", "CD", "CM"):
            place = next(i for i, line in enumerate(lines) if line.split()[0] == label)
            self.assertGreater(place, end)
            self.assertTrue(lines[place].endswith("(not converged)"), lines[place])
        self.assertNotIn("not converged", self.succeed(*shape).stdout)

    def test_the_reference_length_leaves_the_flow_alone(self):
        shape = ("flow", "naca:2412", "--points", 60, "--mach", 0.7, "--alpha", 1)
        one, half = self.figures(*shape), self.figures(*shape, "--reference-length", 0.5)
        self.assertEqual(half["history"], one["history"])
        self.assertAlmostEqual(half["cl"], 2 * one["cl"], delta=1e-14)
        self.assertAlmostEqual(half["cm"], 4 * one["cm"], delta=1e-14)

    def test_moving_a_section_changes_nothing_and_turning_it_turns_the_stream(self):
        gradient = self.figures("flow", "naca:0012", "--points", 100, "--mach", 0.5, "--alpha", 1.25, "--gradient")["gradient"]
        others, by_angle = gradient["others"], gradient["names"].index("alpha_deg")
        lift = dict(zip(others["names"], others["cl"]))
        self.assertAlmostEqual(lift["airfoil.rotation_deg"], -gradient["cl"][by_angle], delta=1e-3)
        for place in ("airfoil.x", "airfoil.y"):
            self.assertAlmostEqual(lift[place], 0, delta=0.03, msg=place)

    def test_strong_shocks_are_not_looked_for_from_potential_flow(self):
        for mach, origin in ((0.75, "potential"), (0.76, "undisturbed")):
            flow = self.figures("flow", "naca:0012", "--points", 60, "--mach", mach)
            self.assertEqual((flow["converged"], flow["origin"]), (True, origin))

    def test_gradients_have_names(self):
        shape = ("flow", "naca:2412", "--points", 40, "--mach", 0.4, "--gradient")
        gradient = self.figures(*shape, "--alpha", 1)["gradient"]
        self.assertEqual(gradient["names"][:2], ["airfoil.upper[0]", "airfoil.upper[1]"])
        self.assertEqual(gradient["names"][6], "airfoil.lower[0]")
        self.assertEqual(gradient["names"][12:], ["alpha_deg"])
        self.assertIn("farfield.radius", gradient["others"]["names"])
        for key in ("cl", "cd", "cm"):
            self.assertEqual(len(gradient[key]), len(gradient["names"]))
            self.assertEqual(len(gradient["others"][key]), len(gradient["others"]["names"]))
            self.assertIn(key, gradient["mach"])
        held = self.figures(*shape, "--cl", 0.3)["gradient"]
        self.assertEqual(held["names"][12:], ["cl"])
        self.assertAlmostEqual(held["cl"][12], 1, delta=1e-9)
        self.assertEqual(len(held["alpha_deg"]), 13)
        text = self.succeed(*shape, "--cl", 0.3).stdout
        for label in ("gradients by", "gradient of CL", "gradient of CD", "gradient of CM", "gradient of the angle"):
            self.assertIn(label, text)

    def test_a_format_without_fields_says_so(self):
        outcome = self.succeed("flow", "naca:0012", "--mach", 0.4, "-o", "a.su2", "-o", "a.vtu")
        self.assertEqual(outcome.stderr, "remodel: a.su2: the flow left out, for which the format has no place\n")
        outcome = self.succeed("flow", "naca:0012", "--points", 40, "--model", "potential", "-o", "a.su2")
        self.assertEqual(outcome.stderr, "remodel: a.su2: the flow left out, for which the format has no place\n")

    def test_drag_that_a_mesh_makes_is_warned_of(self):
        shape = ("flow", "naca:0012", "--alpha", 1, "--mach")
        warned = self.succeed(*shape, 0.3, "--points", 40, "--json")
        self.assertIn("counts is made by mesh and scheme", warned.stderr)
        self.assertEqual(["without friction and shocks there is none" in w for w in warned.json()["warnings"]], [True])
        self.assertEqual(self.succeed(*shape, 0.3).stderr, "")
        shock = self.figures(*shape, 0.85, "--points", 40)
        self.assertGreater(shock["cd"], 0.01)
        self.assertEqual(shock["warnings"], [])  # there may be drag

    def test_slow_streams_have_the_lift_of_potential_flow(self):
        shape = ("flow", "naca:0012", "--points", 100, "--alpha", 2)
        potential = self.figures(*shape, "--model", "potential")["cl"]
        for mach in (0.01, 0.1):
            figures = self.figures(*shape, "--mach", mach)
            self.assertAlmostEqual(figures["cl"] / potential, (1 - mach**2) ** -0.5, delta=0.06)
            self.assertLess(figures["newton_steps"], 20)

    def test_estimates_of_errors(self):
        shape = ("flow", "naca:2412", "--mach", 0.4, "--alpha", 1)
        figures = self.figures(*shape, "--points", 60, "--error")
        error, fine = figures["error"], self.figures(*shape, "--points", 240, "--gradation", 4.8)
        self.assertKeys(error, "cl cd cm alpha_deg order finer")
        self.assertAlmostEqual(error["cl"], fine["cl"] - figures["cl"], delta=0.4 * abs(fine["cl"] - figures["cl"]))
        self.assertAlmostEqual(error["cd"], fine["cd"] - figures["cd"], delta=0.4 * abs(fine["cd"] - figures["cd"]))
        self.assertEqual(error["order"], 2)
        self.assertIn("CL lacks about", self.succeed(*shape, "--points", 60, "--error").stdout)
        round_body = {"loops": [{"role": role, "curves": [{"name": name, "stations": 24, "shape": {
            "kind": "arc", "centre": [0, 0], "radius": radius, "start": 0, "sweep": 6.283185307179586}}]}
            for role, name, radius in (("outer", "farfield", 10), ("hole", "body", 0.5))]}  # fmt: skip
        self.write("round.json", json.dumps(round_body))
        error = self.figures("flow", "round.json", "--mach", 0.2, "--error")["error"]
        self.assertEqual((error["cl"], error["cm"], error["finer"]["cl"]), (None, None, None))
        self.succeed("mesh", "naca:2412", "--points", 40, "-o", "a.su2")
        self.refused("flow", "a.su2", "--mach", 0.4, "--error", names="expected a shape or a native mesh")

    def test_each_step_is_shown_on_a_terminal(self):
        ours, theirs = pty.openpty()
        shown = []
        reader = threading.Thread(target=lambda: shown.append(read_terminal(ours)))
        reader.start()
        command = [harness.PROGRAM, "flow", "naca:0012", "--points", "200", "--mach", "0.4", "--json"]
        result = subprocess.run(command, cwd=self.directory, stdout=subprocess.PIPE, stderr=theirs, timeout=60)
        os.close(theirs)
        reader.join()
        text = shown[0].decode()
        self.assertEqual(text.count("\r" + "step "), json.loads(result.stdout)["newton_steps"])
        self.assertIn("step 1  residual ", text)
        self.assertTrue(text.endswith("\r\x1b[K\r"), text)

    def test_every_process_finds_the_same_bits(self):
        # 200 points: a matrix so large that MUMPS, left to itself, would choose an ordering that is drawn at random.
        shape = ("flow", "naca:2412", "--points", 200, "--mach", 0.5, "--alpha", 1)
        first, second = (self.figures(*shape) for _ in range(2))
        for key in ("cl", "cd", "cm", "residual", "history"):
            self.assertEqual(first[key], second[key], key)

    def test_little_memory_makes_it_gmres(self):
        shape = ("flow", "naca:2412", "--points", 60, "--mach", 0.5, "--alpha", 1)
        whole, little = self.figures(*shape, "--solver", "lu"), self.figures(*shape, "--solver", "lu", "--memory", 4)
        self.assertEqual([f["solver"] for f in (whole, little)], ["lu", "gmres"])
        self.assertEqual(whole["gmres_iterations"], 0)
        self.assertGreater(little["gmres_iterations"], 0)
        self.assertGreater(whole["memory_mb"], 4)
        self.assertLessEqual(little["memory_mb"], 4)
        self.assertAlmostEqual(little["cl"], whole["cl"], delta=1e-9)
        self.assertIn("linear solver", str(self.succeed(*shape, "--memory", 4)))
        none = self.figures(*shape, "--memory", 1, status=3)
        self.assertEqual((none["converged"], none["status"]), (False, "memory"))

    def test_nothing_is_written_without_a_flow(self):
        self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.6, "--max-steps", 2, "-o", "flow.vtu", status=3)
        self.assertEqual(self.files(), {})
        outcome = self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.6, "--max-steps", 2, "-o", "flow.vtu",
                               "--history", "h.csv", status=3)
        self.assertIn("nothing was written but residuals to h.csv", outcome.stderr)
        self.assertEqual(list(self.files()), ["h.csv"])


class Ducts(ProgramTest):
    # A duct four long and one high, in squares of two triangles.
    def duct(self):
        along, across = 16, 4
        at = lambda i, j: i * (across + 1) + j
        points = [(4.0 * i / along, j / across) for i in range(along + 1) for j in range(across + 1)]
        triangles, sides = [], {"floor": [], "roof": [], "in": [], "out": []}
        for i in range(along):
            sides["floor"].append((at(i, 0), at(i + 1, 0)))
            sides["roof"].append((at(i + 1, across), at(i, across)))
            for j in range(across):
                triangles += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
        for j in range(across):
            sides["in"].append((at(0, j + 1), at(0, j)))
            sides["out"].append((at(along, j), at(along, j + 1)))
        text = f"NDIME= 2\nNELEM= {len(triangles)}\n"
        text += "".join(f"5 {a} {b} {c} {k}\n" for k, (a, b, c) in enumerate(triangles))
        text += f"NPOIN= {len(points)}\n" + "".join(f"{x} {y} {k}\n" for k, (x, y) in enumerate(points))
        text += f"NMARK= {len(sides)}\n"
        for name, edges in sides.items():
            text += f"MARKER_TAG= {name}\nMARKER_ELEMS= {len(edges)}\n" + "".join(f"3 {a} {b}\n" for a, b in edges)
        return self.write("duct.su2", text)

    def test_gas_flows_from_inlet_to_outlet(self):
        flow = self.figures("flow", self.duct(), "--mach", 0.3, "--inlet", "in", "--outlet", "out")
        self.assertTrue(flow["converged"])
        self.assertEqual([opening["name"] for opening in flow["openings"]], ["in", "out"])
        self.assertAlmostEqual(flow["openings"][0]["mass_flow"], 0.3, delta=1e-8)
        self.assertAlmostEqual(flow["openings"][1]["mass_flow"], -0.3, delta=1e-8)
        self.assertEqual(sorted(body["name"] for body in flow["bodies"]), ["floor", "roof"])
        self.assertNotIn("entropy_drag", flow)

    def test_a_symmetry_plane_is_no_body(self):
        flow = self.figures("flow", self.duct(), "--mach", 0.3, "--inlet", "in", "--outlet", "out", "--symmetry", "roof")
        self.assertTrue(flow["converged"])
        self.assertAlmostEqual(flow["openings"][0]["mass_flow"], 0.3, delta=1e-8)
        self.assertEqual([body["name"] for body in flow["bodies"]], ["floor"])

    def test_a_row_of_blades_turns_the_flow_in_every_format(self):
        passage = SOURCE / "examples/domains/cascade.json"
        given = ("--mach", 0.5, "--alpha", 40, "--inlet", "inlet", "--inlet-angle", 40, "--outlet", "outlet", "--pressure", 1.07)
        flow = self.figures("flow", passage, *given, "--cp-plot", "cp.svg")
        self.assertTrue(flow["converged"])
        self.assertEqual([body["name"] for body in flow["bodies"]], ["blade"])
        enters, leaves = flow["openings"]
        self.assertAlmostEqual(enters["mass_flow"], -leaves["mass_flow"], delta=1e-9)
        self.assertAlmostEqual(enters["flow_angle_deg"], 40, delta=0.01)
        self.assertLess(leaves["flow_angle_deg"], 25)
        self.assertAlmostEqual(leaves["total_pressure"], 1, delta=1e-3)
        self.succeed("mesh", passage, "-o", "row.vtkhdf")
        self.assertEqual(self.figures("flow", "row.vtkhdf", *given)["cl"], flow["cl"])
        said = self.succeed("convert", "row.vtkhdf", "-o", "row.su2", "-o", "row.vtu").stderr
        self.assertEqual([line.split(":")[1].strip() for line in said.splitlines() if "periodic" in line], ["row.su2"])
        self.assertEqual(self.figures("flow", "row.vtu", *given)["cl"], flow["cl"])
        self.assertEqual(self.figures("flow", "row.su2", *given, "--periodic", "below,above")["cl"], flow["cl"])
        for options, message in (
            (given[:4], "the wall 'inlet' meets a periodic boundary"),
            ((*given, "--periodic", "below"), "--periodic: found 'below', expected the names of two boundaries"),
            ((*given, "--periodic", "below,blade"), "found 'below' named alone"),
            ((*given[:4], "--inlet-angle", 40), "--inlet-angle: given without --inlet"),
            ((*given[:6], "--inlet-angle", 95, *given[8:]), "found gas to enter by 'inlet' at 95 degrees"),
            ((*given[:6], "--inlet-angle", 200), "--inlet-angle"),
        ):  # fmt: skip
            self.refused("flow", "row.vtkhdf", *options, names=message)
        self.refused("flow", "row.vtkhdf", "--model", "potential", "--periodic", "below,above", names="--periodic")

    def test_the_history_is_a_table_or_a_plot(self):
        duct = self.duct()
        flow = self.figures("flow", duct, "--mach", 0.3, "--inlet", "in", "--outlet", "out", "--total-pressure", 1.02,
                            "--history", "history.csv")
        rows = self.path("history.csv").read_text().splitlines()
        self.assertEqual(rows[0], "step,residual")
        self.assertEqual([float(row.split(",")[1]) for row in rows[1:]], flow["history"])
        self.succeed("flow", duct, "--mach", 0.3, "--inlet", "in", "--outlet", "out", "--history", "history.svg")
        self.assertIn("<svg", self.path("history.svg").read_text())

    def test_refusals(self):
        duct = self.duct()
        self.refused("flow", duct, "--mach", 0.3, names="duct.su2")
        self.refused("flow", duct, "--mach", 0.3, "--inlet", "in", names="duct.su2")
        self.refused("flow", duct, "--mach", 0.3, "--inlet", "in", "--outlet", "exit", names="duct.su2")
        self.refused("flow", duct, "--mach", 0.3, "--inlet", "in", "--outlet", "in", names="in")
        self.refused("flow", duct, "--mach", 0.3, "--inlet", "in", "--outlet", "out", "--symmetry", "mirror",
                     names="mirror")
        self.refused("flow", duct, "--mach", 0.3, "--inlet", "in", "--outlet", "out", "--symmetry", "roof",
                     "--alpha", 2, names="roof")
        self.refused("flow", duct, "--model", "potential", "--symmetry", "roof", names="--symmetry")
        self.refused("flow", duct, "--mach", 0.3, "--total-pressure", 2, names="--total-pressure")
        self.refused("flow", duct, "--mach", 0.3, "--pressure", 2, names="--pressure")
        self.refused("flow", duct, "--model", "potential", "--inlet", "in", names="--inlet")
        self.refused("flow", duct, "--mach", 0.3, "--inlet", "in", "--outlet", "out", "--history", "h.txt",
                     names="h.txt")
        self.refused("flow", duct, "--mach", 0.3, "--inlet", "in", "--outlet", "out", "--pressure", 1.07,
                     names="pressure: found 1.07")


class Series(ProgramTest):
    def designs(self):
        designs = []
        base = self.figures("fit", "naca:0012")
        for i in range(4):
            designs.append({"degree": base["degree"],
                            "upper": [c + 1e-3 * i for c in base["upper"]],
                            "lower": [c - 5e-4 * i for c in base["lower"]]})
        return designs

    def test_each_design_has_its_flow(self):
        designs = self.designs()
        self.write("designs.json", json.dumps(designs))
        series = self.figures("flow", "naca:0012", "--points", 60, "--mach", 0.5, "--series", "designs.json",
                              "--compare", "rival")
        self.assertEqual(len(series["designs"]), len(designs))
        for entry in series["designs"]:
            self.assertKeys(entry, KEYS + " full_adjustment rival_seconds")
            self.assertTrue(entry["converged"])
            self.assertAlmostEqual(entry["cl"], entry["rival_cl"], delta=5e-3)
        self.assertEqual([entry["warm"] for entry in series["designs"][:3]], ["cold", "refactored", "carried"])

    def test_a_design_without_a_mesh_does_not_end_the_row(self):
        designs = self.designs()
        designs[1]["upper"], designs[1]["lower"] = designs[1]["lower"], designs[1]["upper"]  # they cross
        self.write("designs.json", json.dumps(designs))
        series = self.figures("flow", "naca:0012", "--points", 60, "--mach", 0.5, "--series", "designs.json", status=1)
        self.assertEqual([entry["converged"] for entry in series["designs"]], [True, False, True, True])
        self.assertEqual(series["designs"][1]["status"], "refused")
        self.assertNotEqual(series["designs"][1]["detail"], "")
        self.assertEqual(series["not_converged"], 1)
        text = self.succeed("flow", "naca:0012", "--points", 60, "--mach", 0.5, "--series", "designs.json", status=1).stdout
        self.assertRegex(text, "design 2 +refused: .*cross")

    def test_refusals(self):
        self.refused("flow", "naca:0012", "--mach", 0.5, "--series", self.write("a.json", "{"), names="a.json")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--series", self.write("b.json", "{}"), names="b.json")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--series", self.write("c.json", "[]"), names="c.json")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--series", self.write("d.json", "[{\"upper\": 1}]"),
                     names="d.json, airfoil 1")


def arc(name, radius, stations, centre=(0, 0), start=0.0):
    return {"name": name, "stations": stations, "shape": {"kind": "arc", "centre": list(centre), "radius": radius,
                                                          "start": start, "sweep": 6.283185307179586}}


def polygon(name, points, stations):
    return {"name": name, "stations": stations, "shape": {"kind": "polyline", "points": points}}


# Stations a tenth of the chord apart at the trailing edge, as in reports of the 1920s.
UPPER = """1 0  .9 .01816  .8 .04081  .7 .06326  .6 .08267  .5 .09739  .4 .10646  .3 .1083  .25 .10438  .2 .09671
.15 .08493  .1 .06841  .075 .05796  .05 .04554  .025 .03005  .0125 .01999  0 0"""
LOWER = """.0125 -.01157  .025 -.01352  .05 -.0137  .075 -.01204  .1 -.00963  .15 -.00413  .2 .00117  .25 .00558  .3 .00873
.4 .01115  .5 .01232  .6 .01229  .7 .0107  .8 .0076  .9 .00362  1 0"""


class Warnings(ProgramTest):
    """Flows that are no answers say so."""

    def domain(self, name, *holes, **others):
        loops = [{"role": "outer", "curves": [arc("farfield", 20, 40)]}]
        loops += [{"role": "hole", "curves": curves} for curves in holes]
        loops += others.get("loops", [])
        return self.write(name, json.dumps({"loops": loops}))

    def warnings(self, *arguments, status=0):
        """Those of the JSON object, which are the lines of standard error too."""
        outcome = self.succeed("flow", *arguments, "--json", status=status)
        figures = outcome.json()
        self.assertEqual(outcome.stderr.splitlines(), [f"remodel: {arguments[0]}: {text}" for text in figures["warnings"]])
        self.assertEqual(figures["lift_determined"], not any("not determined" in text for text in figures["warnings"]))
        return [text for text in figures["warnings"] if "made by mesh and scheme" not in text]  # of coarse meshes

    def test_ordinary_flows_have_none(self):
        for model in (["--mach", 0.4], ["--model", "potential"], ["--model", "potential", "--mach", 0.4]):
            for points in (50, 100):
                self.assertEqual(self.warnings("naca:2412", "--points", points, "--alpha", 4, *model), [])

    def test_lift_without_an_edge_is_not_determined(self):
        self.domain("strut.json", [arc("strut", 0.7, 60, start=0.1)])
        for model in (["--mach", 0.3], ["--model", "potential"]):
            warnings = self.warnings("strut.json", *model)
            self.assertEqual(["the lift of 'strut' is not determined" in text for text in warnings], [True])
            text = self.succeed("flow", "strut.json", *model).stdout
            self.assertRegex(text, r"(?m)^CL +not determined$")
            figures = self.succeed("flow", "strut.json", *model, "--json").json()
            self.assertEqual([figures[key] for key in ("cl", "cm")] + [body[key] for body in figures["bodies"] for key in ("cl", "cm")], [None] * 4)
            self.assertIsInstance(figures["cd"], float)
            self.succeed("mesh", "strut.json", "-o", "strut.su2")
            self.assertIn("'strut'", self.warnings("strut.su2", *model)[0])
        # Nothing goes around it upstream above Mach 1. (One step: this is not about flows that are found.)
        counts = [len(self.succeed("flow", "strut.json", "--mach", mach, "--max-steps", 1, "--json", status=3).json()["warnings"])
                  for mach in (0.9, 1.5)]
        self.assertEqual(counts, [1, 0])

    def test_the_one_body_without_an_edge_is_named(self):
        wedge = polygon("wedge", [[0, -0.15], [0, 0.15], [1, 0], [0, -0.15]], 60)
        self.domain("two.json", [wedge], [arc("wheel", 0.3, 40, centre=(-2, 0))])
        for model in (["--mach", 0.3], ["--model", "potential"]):
            warnings = [text for text in self.warnings("two.json", *model) if "not determined" in text]
            self.assertEqual(["the lift of 'wheel'" in text for text in warnings], [True], warnings)

    def test_a_blunt_base_is_an_edge_and_a_round_end_is_none(self):
        half = [(0.5 - 0.5 * math.cos(math.pi * i / 30), 0.06 * math.sin(math.pi * i / 30)) for i in range(31)]
        ellipse = half + [(x, -y) for x, y in reversed(half[1:-1])] + half[:1]
        blunt = [[x, y] for x, y in ellipse if x < 0.995]
        first = next(i for i, (x, y) in enumerate(blunt) if y < 0)
        blunt = blunt[first:-1] + blunt[:first] + [blunt[first]]
        self.domain("blunt.json", [polygon("section", blunt, 120)])
        self.assertEqual(self.warnings("blunt.json", "--mach", 0.4, "--alpha", 2), [])
        self.domain("round.json", [polygon("section", [list(point) for point in ellipse], 120)])
        # (One step: there may be no steady flow.)
        for model, status in ((["--mach", 0.4, "--max-steps", 1], 3), (["--model", "potential"], 0)):
            outcome = self.succeed("flow", "round.json", *model, "--alpha", 2, "--json", status=status)
            self.assertIn("'section' is not determined", outcome.json()["warnings"][0])

    def test_an_edge_that_faces_the_stream_is_no_trailing_edge(self):
        turned = [[-0.8, 0.0]] + [[0.2 * math.cos(t), 0.2 * math.sin(t)]
                                  for t in (math.pi * (0.5 - i / 24) for i in range(25))] + [[-0.8, 0.0]]
        self.domain("drop.json", [polygon("drop", turned, 100)])
        for model in (["--mach", 0.3], ["--model", "potential"]):
            self.assertIn("'drop' is not determined", self.warnings("drop.json", *model, "--alpha", 2)[0])

    def test_without_a_body_there_is_no_flow(self):
        sail = {"role": "internal", "open": True, "curves": [polygon("sail", [[-0.5, 0], [0, 0.08], [0.5, 0]], 30)]}
        self.domain("sail.json", loops=[sail])
        self.domain("nothing.json")
        for name in ("sail.json", "nothing.json"):
            self.refused("flow", name, "--mach", 0.3, names="found no wall among the boundaries")
            self.refused("flow", name, "--model", "potential", "-o", "a.vtu", names="found no boundary but the far field")

    def test_a_coarse_edge_carries_its_condition(self):
        points = [float(word) for word in f"{UPPER} {LOWER}".split()]
        rows = [f"{x:.5f} {y:.5f}" for x, y in zip(points[::2], points[1::2])]
        self.write("coarse.dat", "33 stations as of old reports\n" + "\n".join(rows) + "\n")
        for shape in ("spline", "polyline"):
            lifts = [self.figures("flow", "coarse.dat", "--as-given", shape, "--model", "potential", "--alpha", 2,
                                  "--resolution", resolution)["cl"] for resolution in (1, 2, 4, 8)]
            for lift in lifts:
                self.assertAlmostEqual(lift, 0.807, delta=0.03 * 0.807)

    def test_meshes_too_coarse_and_pressures_too_low_are_warned_of(self):
        shape = ("naca:2412", "--model", "potential", "--alpha", 2)
        self.assertIn("too coarse", self.warnings(*shape, "--points", 8)[0])
        self.assertIn("sonic speed", self.warnings(*shape, "--points", 100, "--mach", 0.8)[0])

    def test_a_row_says_each_once(self):
        base = self.figures("fit", "naca:0012")
        self.write("designs.json", json.dumps([{key: base[key] for key in ("degree", "upper", "lower")}] * 3))
        outcome = self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.09, "--series", "designs.json", "--json")
        self.assertEqual(len(outcome.stderr.splitlines()), 1)
        self.assertEqual(len(outcome.json()["warnings"]), 1)
        self.assertEqual([len(design["warnings"]) for design in outcome.json()["designs"]], [1, 1, 1])


class Refusals(ProgramTest):
    def test_conditions(self):
        self.refused("flow", "naca:0012", names="--mach")
        self.refused("flow", "naca:0012", "--mach", 0, names="--mach")
        self.refused("flow", "naca:0012", "--mach", 5, names="--mach")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--alpha", 100, names="--alpha")
        self.refused("flow", "naca:0012", "--mach", 1.2, "--cl", 0.3, names="mach")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--reference", "1", names="--reference")
        self.refused("flow", "naca:0012", "--mach", 0.5, "--compare", "cold", names="--compare")

    def test_a_mesh_without_a_far_field(self):
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "mesh.su2")
        self.refused("flow", "mesh.su2", "--mach", 0.5, "--farfield", "outer", names="mesh.su2")
        self.refused("flow", "mesh.su2", "naca:0012", "--mach", 0.5, names="mesh.su2")
        self.refused("flow", "mesh.su2", "--mach", 0.5, "--farfield", "airfoil", names="mesh.su2: the far field bounds a hole")

    def test_options_that_would_have_no_effect(self):
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "mesh.su2")
        for option in (["--points", 60], ["--name", "wing"], ["--as-given", "spline"], ["--gradation", 2],
                       ["--close-trailing-edge"]):
            self.refused("flow", "mesh.su2", "--mach", 0.5, *option, names=option[0] + ": given with a mesh")
        for option in (["--gradient"], ["--tolerance", 1e-8], ["--memory", 100], ["--solver", "lu"], ["--limiter", 5],
                       ["--max-steps", 9], ["--pressure", 0.9]):
            self.refused("flow", "naca:0012", "--model", "potential", *option,
                         names=option[0] + ": given with --model potential")

    def test_two_outputs_are_two_files(self):
        shape = ("flow", "naca:0012", "--points", 40, "--mach", 0.4)
        self.refused(*shape, "--cp-plot", "a.svg", "--history", "./a.svg", names="--history: found './a.svg'")
        self.refused(*shape, "-o", "a.vtu", "-o", "./a.vtu", names="-o")

    def test_a_mesh_with_a_clockwise_triangle(self):
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "mesh.su2")
        lines = self.path("mesh.su2").read_text().splitlines()
        row = next(i for i, line in enumerate(lines) if line.startswith("NELEM")) + 1 + 5
        kind, a, b, c, *rest = lines[row].split()
        lines[row] = " ".join([kind, b, a, c, *rest])
        self.write("turned.su2", "\n".join(lines) + "\n")
        self.refused("flow", "turned.su2", "--mach", 0.5, names="triangle 5")
