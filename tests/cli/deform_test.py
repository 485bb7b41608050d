"""`remodel design` of outlines and domains as they are given: boxes, bumps and points of curves; refusals."""

import copy
import json

from harness import SOURCE, ProgramTest

DUCT = {
    "loops": [
        {
            "role": "outer",
            "curves": [
                {"name": "axis", "shape": {"kind": "line", "from": [0, 0], "to": [3, 0]}, "stations": 16},
                {"name": "outlet", "shape": {"kind": "line", "from": [3, 0], "to": [3, 0.5]}, "stations": 4},
                {"name": "wall", "shape": {"kind": "spline", "points": [[3, 0.5], [2.5, 0.48], [2, 0.44], [1.5, 0.41], [1, 0.44], [0.5, 0.48], [0, 0.5]]}, "stations": 20},
                {"name": "turn", "shape": {"kind": "arc", "centre": [0, 0.4], "radius": 0.1, "start": 1.5707963267948966, "sweep": 1.5707963267948966}, "stations": 4},
                {"name": "inlet", "shape": {"kind": "line", "from": [-0.1, 0.4], "to": [-0.1, 0]}, "stations": 4},
                {"name": "axis", "shape": {"kind": "line", "from": [-0.1, 0], "to": [0, 0]}, "stations": 1},
            ],
        }
    ]
}
BOX = {"kind": "box", "x": [-0.001, 1.001], "y": [-0.07, 0.07], "points": [5, 2], "hold": {"left": 1, "right": 1}}
BUMPS = {"kind": "bumps", "surface": "upper", "x": [0.2, 0.5, 0.8], "width": 3}
POINTS = {"kind": "points", "on": "wall", "points": [2, 3, 4], "bounds": [-0.03, 0.03]}


class Deformations(ProgramTest):
    def problem(self, *deformations, **changes):
        problem = {
            "space": {"outline": "naca:0012", "deformations": list(deformations or [BOX])},
            "mesh": {"points": 40, "gradation": 1},
            "flow": [{"mach": 0.8}],
            "objective": "drag",
            "constraints": [{"kind": "area", "of_start": 1}],
            "designer": {"evaluations": 5},
            "verify": [40],
        }
        return self.write("problem.json", json.dumps({**problem, **changes}))

    def duct(self, *deformations, domain=None, **changes):
        self.write("duct.json", json.dumps(domain or DUCT))
        self.write("space.json", json.dumps({"domain": "duct.json", "deformations": list(deformations or [POINTS])}))
        return self.write("problem.json", json.dumps({
            "space": "space.json",
            "flow": [{"mach": 0.3, "inlets": [{"name": "inlet"}], "outlets": [{"name": "outlet", "pressure": 0.75}], "symmetry": ["axis"]}],
            "objective": "mass_flow",
            "designer": {"evaluations": 6},
            **changes,
        }))  # fmt: skip

    def test_how_small_the_first_box_is_does_not_end_the_search(self):
        """A scale of 1e-6 makes the first box so small that the model cannot promise anything in it."""
        bumps = {**BUMPS, "bounds": [-0.02, 0.02], "scale": 1e-6}
        figures = self.figures("design", self.problem(bumps, constraints=[], flow=[{"mach": 0.5, "alpha_deg": 1}], verify=[]),
                               "-o", "run", status=3)  # fmt: skip
        self.assertEqual(figures["evaluations"], 5)
        self.assertLess(figures["objective"], 0.998 * figures["start_objective"])

    def test_points_of_an_outline_are_said_and_an_odd_number_of_stations_is_taken(self):
        points = {"kind": "points", "points": [9], "bounds": [-0.001, 0.001]}
        outcome = self.run_program("design", self.problem(points, mesh={"points": 41, "gradation": 1}, verify=[],
                                                          designer={"evaluations": 1}), "-o", "run")  # fmt: skip
        self.assertRegex(outcome.stderr, r"deformation 1: points count from the trailing edge along the upper side: 9 lies at 0\.9")

    def test_a_name_of_several_loops_is_no_name(self):
        hole = lambda x: {"role": "hole", "curves": [{"name": "body", "stations": 20, "shape": {"kind": "spline", "points": [
            [x + 0.2, 0], [x + 0.1, 0.05], [x, 0], [x + 0.1, -0.05], [x + 0.2, 0]]}}]}  # fmt: skip
        far = {"role": "outer", "curves": [{"name": "farfield", "stations": 30,
                                            "shape": {"kind": "arc", "centre": [0, 0], "radius": 20, "start": 0, "sweep": 6.283185307179586}}]}
        self.write("two.json", json.dumps({"loops": [far, hole(0), hole(1)]}))
        space = {"domain": "two.json", "deformations": [{"kind": "points", "on": "body", "points": [1]}]}
        box = {"kind": "box", "on": "body", "x": [-0.1, 1.3], "y": [-0.1, 0.1], "points": [3, 2]}
        space["deformations"] = [box]
        self.refused("design", self.problem(space=space, mesh={}, constraints=[{"kind": "area", "at_least": 0.001, "element": "body"}]),
                     "-o", "run", names="the name of curves of several loops that move")  # fmt: skip

    def test_a_box_lowers_drag_and_goes_on(self):
        figures = self.figures("design", self.problem(), "-o", "run", status=3)
        self.assertLess(figures["objective"], 0.9 * figures["start_objective"])
        self.assertEqual(figures["constraints"], {"area": 0})
        self.assertIn("airfoil.box[1,0].y", figures)
        self.assertTrue(figures["verified"][0]["converged"])
        resumed = self.figures("design", self.problem(designer={"evaluations": 7}), "-o", "run", "--resume", status=3)
        self.assertEqual(resumed["evaluations"], 7)
        self.assertLessEqual(resumed["objective"], figures["objective"])
        # The best design is a domain, which other commands take.
        self.assertTrue(self.figures("mesh", "run/best.json", "-o", "best.vtkhdf")["triangles"])
        self.assertEqual(self.figures("design", "report", "run")["designs"], 7)
        self.assertIn("<polygon", self.path("run/report.html").read_text())
        self.assertEqual(self.figures("film", "run", "-o", "film.webp", "--frames", 3)["frames"], 3)

    def test_nothing_moved_is_the_outline_as_given(self):
        """The start of a search is the domain of `mesh --as-given`."""
        self.write("flat.dat", (SOURCE / "examples/design/flatback.dat").read_bytes())
        box = {**BOX, "x": [-0.001, 0.9], "y": [-0.08, 0.08], "hold": {"left": 1, "right": 2}}
        space = {"outline": "flat.dat", "deformations": [box]}
        self.figures("design", self.problem(space=space, mesh={}, designer={"evaluations": 1}, verify=[]), "-o", "run", status=3)
        start = self.figures("mesh", "run/best.json", "-o", "start.vtkhdf")
        given = self.figures("mesh", "flat.dat", "--as-given", "spline", "-o", "given.vtkhdf")
        for key in ("vertices", "triangles", "min_angle_deg"):
            self.assertEqual(start[key], given[key], key)

    def test_bumps_by_cmaes(self):
        figures = self.figures("design", self.problem(BUMPS, {**BUMPS, "surface": "lower"}, designer={"name": "cmaes", "evaluations": 8, "sigma": 0.002}, verify=[]), "-o", "run", status=3)
        self.assertIn("airfoil.lower[0.5]", figures)
        self.assertEqual(figures["evaluations"], 8)

    def test_a_throat_is_widened_by_points_of_its_wall(self):
        figures = self.figures("design", self.duct(), "-o", "run")
        self.assertTrue(figures["converged"])  # the mesh holds its connectivity
        self.assertLess(figures["objective"], 1.005 * figures["start_objective"])  # made large: below 0
        self.assertGreater(figures["wall[3].y"], 0.005)
        page = self.figures("design", "report", "run")
        self.assertEqual(page["objective"], figures["objective"])

    def test_an_airfoil_in_a_tunnel_is_deformed_as_a_spline(self):
        """A domain file's airfoil has coefficients and no points: a spline takes its place."""
        corners = {"floor": (-2, -1), "outlet": (3, -1), "roof": (3, 1), "inlet": (-2, 1)}
        ends = list(corners.values())
        walls = [{"name": name, "stations": 12, "shape": {"kind": "line", "from": ends[i], "to": ends[(i + 1) % 4]}} for i, name in enumerate(corners)]
        tunnel = {"loops": [{"role": "outer", "curves": walls}, {"airfoil": "naca:2412", "name": "wing", "stations": 40}]}
        flow = [{"mach": 0.3, "alpha_deg": 0, "inlets": [{"name": "inlet"}], "outlets": [{"name": "outlet", "pressure": 0.98}]}]
        bumps = {"kind": "bumps", "on": "wing", "surface": "upper", "x": [0.3, 0.6], "bounds": [-0.02, 0.02]}
        problem = self.duct(bumps, domain=tunnel, flow=flow, objective="mass_flow", mesh={}, verify=[],
                            designer={"evaluations": 6})  # fmt: skip
        outcome = self.run_program("design", problem, "-o", "run", "--json")
        self.assertIn("deformation 1: the airfoil 'wing' is a spline through points of its own", outcome.stderr)
        figures = json.loads(outcome.stdout)
        self.assertLess(figures["objective"], figures["start_objective"])  # made large: below 0
        self.assertNotEqual(figures["wing.upper[0.3]"], 0)

    def test_examples_run(self):
        for name, points in (("ffd", 50), ("bumps", 40), ("nozzle", 60), ("ramp", 80)):
            problem = json.loads((SOURCE / f"examples/design/{name}.json").read_text())
            problem["mesh"] = {"points": points, "gradation": 1}
            problem["designer"]["evaluations"], problem["verify"] = 4, []
            if isinstance(problem["space"], str):
                problem["space"] = json.loads((SOURCE / "examples/design" / problem["space"]).read_text())
            for key, folder in (("domain", "domains"), ("outline", "design")):
                if ":" not in problem["space"].get(key, ":"):
                    problem["space"][key] = str(SOURCE / "examples" / folder / problem["space"][key].removeprefix("../domains/"))
            figures = self.figures("design", self.write("small.json", json.dumps(problem)), "-o", name, status=3)
            self.assertLess(figures["objective"], figures["start_objective"], name)

    def test_refusals_of_spaces(self):
        for space, message in (
            ({"outline": "naca:0012"}, "problem.json, space: the key 'deformations' is missing"),
            ({"outline": "naca:0012", "deformations": []}, "problem.json, space: found no deformation, expected one or more"),
            ({"deformations": [BOX]}, "problem.json, space: expected one of 'outline' and 'domain'"),
            ({"outline": "nothing.dat", "deformations": [BOX]}, "problem.json, space: as 'outline', nothing.dat: "),
            ({"outline": "naca:xyz", "deformations": [BOX]}, "problem.json, space: as 'outline', "),
            ({"outline": "naca:0012", "curve": "circle", "deformations": [BOX]}, "space: found 'circle' as 'curve', expected spline or polyline"),
            ({"outline": "naca:0012", "speed": 1, "deformations": [BOX]}, "space: found the key 'speed', expected outline, curve, domain, deformations"),
            ("nothing.json", "problem.json: as 'space', nothing.json: "),
            (3, "problem.json, space: found number, expected an object"),
        ):  # fmt: skip
            self.refused("design", self.problem(space=space), "-o", "run", names=message)
        self.write("space.json", '{"outline": "naca:0012", "outline": "naca:0012"}')
        self.refused("design", self.problem(space="space.json"), "-o", "run", names="space.json:1: found the key \"outline\" a second time")
        for key, value in (("degree", 5), ("symmetric", True), ("target", "naca:0012")):
            self.refused("design", self.problem(**{key: value}), "-o", "run", names=f"problem.json: found '{key}' with 'space', expected 'airfoil'")
        self.refused("design", self.problem(airfoil="naca:0012"), "-o", "run", names="problem.json: expected one of 'airfoil', 'elements' and 'space'")

    def test_refusals_of_deformations(self):
        def changed(of, **changes):
            return {**copy.deepcopy(of), **changes}

        place = "problem.json, space, deformation 1"
        for deformation, message in (
            (changed(BOX, kind="cube"), "found 'cube' as 'kind', expected box, bumps or points"),
            (changed(BOX, width=1), "found the key 'width', expected kind, on, x, y, points, hold, move, bounds, scale"),
            (changed(BOX, on="wing"), "found 'wing' as 'on', expected airfoil, farfield"),
            (changed(BOX, on="farfield"), "found the arc 'farfield' as 'on', expected splines, polylines or lines"),
            (changed(BOX, x=[1, 0]), "found [1.0,0.0] as 'x', expected two numbers, the lower one first"),
            (changed(BOX, x=[1, 1]), "found [1.0,1.0] as 'x', expected the left side, then the right one"),
            (changed(BOX, points=[5]), "expected two numbers as 'points', of columns and of rows"),
            (changed(BOX, points=[1, 2]), "found 1 as 'points', expected a whole number from 2 to 30"),
            (changed(BOX, hold={"left": 5}), "found 'hold' of all control points, expected less"),
            (changed(BOX, hold={"front": 1}), "hold: found the key 'front', expected left, right, bottom, top"),
            (changed(BOX, move="z"), "found 'z' as 'move', expected y, x or xy"),
            (changed(BOX, x=[2, 3]), "found a box that holds no point of 'airfoil'"),
            (changed(BOX, x=[0.5, 1.1], hold={"right": 1}), "found 'airfoil' entering the box through its left side near"),
            (changed(BOX, y=[-0.03, 0.03]), "found 'airfoil' entering the box through its"),
            (changed(BOX, bounds=[0.1, 0.2]), "found [0.1,0.2] as 'bounds', expected two numbers around 0, where the start is"),
            (changed(BOX, scale=0), "found 0.0 as 'scale', expected 1e-06 to 1000000.0"),
            (changed(BUMPS, surface="left"), "found 'left' as 'surface', expected upper or lower"),
            (changed(BUMPS, x=[]), "found no number in 'x', expected one or more"),
            (changed(BUMPS, x=[1]), "found 1.0 as 'x', expected 0.001 to 0.999"),
            (changed(BUMPS, x=[0.5, 0.5]), "found the variable 'airfoil.upper[0.5] (deformation 1)' twice"),
            (changed(BUMPS, width=0.5), "found 0.5 as 'width', expected 1.0 to 20.0"),
            (changed(POINTS, on="farfield"), "found the arc 'farfield' as 'on'"),
        ):  # fmt: skip
            if message.endswith("twice"):
                deformation = {**deformation, "x": [0.5, 0.5, 0.5]}
            line = self.refused("design", self.problem(deformation), "-o", "run", names=message)
            self.assertIn(place, line)

    def test_several_loops_have_their_constraints_by_name(self):
        """Two flat backs in one far field, each of a box of its own."""
        outline = (SOURCE / "examples/design/flatback.dat").read_text().splitlines()[1:]
        points = [[float(x) for x in line.split()] for line in outline][::4]
        shape = {"kind": "spline", "points": points}
        base = {"kind": "line", "from": points[-1], "to": points[0]}
        parts = [
            {"role": "hole", "placement": placement, "curves": [{"name": name, "shape": shape, "stations": 40}, {"name": name, "shape": base, "stations": 1}]}
            for name, placement in (("main", {}), ("flap", {"chord": 0.3, "rotation_deg": -15, "position": [1.05, -0.02]}))
        ]
        circle = {"kind": "arc", "centre": [0, 0], "radius": 20, "start": 0, "sweep": 6.283185307179586}
        farfield = {"role": "outer", "curves": [{"name": "farfield", "shape": circle, "stations": 30}]}
        self.write("two.json", json.dumps({"loops": [*parts, farfield]}))
        box = {**BOX, "x": [-0.001, 0.95], "y": [-0.1, 0.1], "hold": {"left": 1, "right": 2}, "bounds": [-0.03, 0.03]}
        space = {"domain": "two.json", "deformations": [{**box, "on": "flap"}, {**box, "on": "main"}]}
        areas = [{"kind": "area", "element": name, "of_start": 1} for name in ("main", "flap")]
        changes = {"space": space, "mesh": {"gradation": 1.2}, "flow": [{"mach": 0.2, "alpha_deg": 2}], "objective": "lift", "verify": []}
        figures = self.figures("design", self.problem(**changes, constraints=areas, designer={"evaluations": 4}), "-o", "run", status=3)
        self.assertLess(figures["objective"], 1.02 * figures["start_objective"])  # made large: below 0
        self.assertEqual(figures["constraints"], {"area (constraint 1)": 0, "area (constraint 2)": 0})
        self.refused("design", self.problem(**changes, constraints=[{"kind": "area", "of_start": 1}]), "-o", "other", names="constraint 1: the key 'element' is missing")

    def test_refusals_of_ducts(self):
        point = json.loads(self.path(self.duct()).read_text())["flow"][0]
        for changes, message in (
            ({"flow": [{**point, "inlets": []}]}, "flow 1: found no curve 'farfield' in the domain and no 'inlets', expected one for the gas to enter by"),
            ({"flow": [{**point, "outlets": [{"name": "exit"}]}]}, "flow 1: found 'exit' as the name of an outlet, expected that of curves of the domain"),
            ({"flow": [{**point, "outlets": [{"name": "inlet"}]}]}, "flow 1: found 'inlet' as the name of an outlet, expected another name for each boundary"),
            ({"flow": [{**point, "outlets": [{"name": "outlet", "presure": 1}]}]}, "flow 1, outlet 1: found the key 'presure', expected name, pressure"),
            ({"flow": [{**point, "mach": 1.5}]}, "flow 1: found 'inlets' with a 'mach' of 1 or more, expected less"),
            ({"constraints": [{"kind": "suction", "at_most": 3}]}, "constraint 1: found 'suction' with inlets or outlets, expected a far field alone"),
            ({"constraints": [{"kind": "tank", "x": [0.1, 0.2], "at_least": 3}]}, "constraint 1: found 'tank' with 'space', expected area, thickness, or one of flows"),
            ({"constraints": [{"kind": "thickness", "x": [4], "at_least": 0.1}]}, "constraint 1: found 4.0 in 'x', where the loop has no thickness"),
            ({"constraints": [{"kind": "area", "element": "roof", "at_least": 0.1}]}, "constraint 1: found 'roof' as 'element', expected"),
            ({"objective": "inverse"}, "problem.json: found the objective 'inverse' with 'space', expected 'airfoil'"),
        ):  # fmt: skip
            self.refused("design", self.duct(**changes), "-o", "run", names=message)
        cascade = json.loads((SOURCE / "examples/domains/cascade.json").read_text())
        wall = {"kind": "points", "on": "below", "points": [3], "bounds": [-0.01, 0.01]}
        flow = [{"mach": 0.3, "inlets": [{"name": "inlet", "angle_deg": 40}], "outlets": [{"name": "outlet"}]}]
        self.refused("design", self.duct(wall, domain=cascade, flow=flow), "-o", "run", names="found the periodic curve 'below' as 'on'")
        self.refused("design", self.duct(mesh={"farfield_radius": 9}), "-o", "run", names="found 'farfield_radius' in 'mesh' with a 'domain'")
        self.refused("design", self.duct(designer={"bounds": 0.1}), "-o", "run", names="designer: found the key 'bounds', which deformations have of their own")
        for deformation, message in (
            ({**POINTS, "on": "axis"}, "found 'axis' as 'on', expected the name of a spline or polyline"),
            ({**POINTS, "points": [7]}, "found 7 in 'points', expected whole numbers from 0 to 6, the points of 'wall'"),
            ({**POINTS, "points": [6]}, "found the variable 'wall[6].y', which moves the point [0.0,0.5], where an arc or a section ends"),
            ({**BUMPS, "on": "wall"}, "found 'wall' as 'on', expected the name of all curves of one closed loop"),
            ({key: value for key, value in POINTS.items() if key != "on"}, "the key 'on' is missing"),
        ):  # fmt: skip
            line = self.refused("design", self.duct(deformation), "-o", "run", names=message)
            self.assertIn("deformation 1", line)
        # Openings are of such domains alone.
        self.refused("design", self.write("plain.json", json.dumps({
            "airfoil": "naca:0012", "flow": [{"mach": 0.5, "outlets": [{"name": "outlet"}]}], "objective": "drag",
        })), "-o", "run", names="plain.json, flow 1: found 'inlets', 'outlets' or 'symmetry', expected them with 'space'")  # fmt: skip
        self.refused("design", self.problem(objective="mass_flow"), "-o", "run", names="flow 1: found 'mass_flow' without 'outlets', expected one or more")
