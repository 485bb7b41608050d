"""Nothing of a file is lost in silence: what a mesh has no place for is kept, or said in one line; what differs by
rounding is joined, and that is said; every format of one mesh gets the same answer of `check`."""

import json
import math
from pathlib import Path

from harness import ProgramTest, main

CASES = Path(__file__).resolve().parents[1] / "cases"

BOXES = """FFD_NBOX= 1
FFD_NLEVEL= 1
FFD_TAG= BOX
FFD_LEVEL= 0
FFD_DEGREE_I= 2
FFD_DEGREE_J= 1
FFD_PARENTS= 0
FFD_CHILDREN= 0
FFD_CORNER_POINTS= 4
-0.1 -0.2
1.1 -0.2
1.1 0.2
-0.1 0.2
FFD_CONTROL_POINTS= 0
"""
SURFACE = "FFD_SURFACE_POINTS= 2\nairfoil 0 0.5 0.25 0.0\nairfoil 1 0.5 0.5 0.0\n"

QUAD_MSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
5
1 1 2 1 1 1 2
2 1 2 1 1 2 3
3 1 2 1 1 3 4
4 1 2 1 1 4 1
5 3 2 2 1 1 2 3 4
$EndElements
"""


def square_msh(coordinates, names, elements):
    """Gmsh 2.2: the unit square of two triangles; coordinates makes (x, y, z) of (x, y)."""
    points = [coordinates(x, y) for x, y in [(0, 0), (1, 0), (1, 1), (0, 1)]]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names, "$EndPhysicalNames"]
    lines += ["$Nodes", "4", *(f"{i + 1} {x} {y} {z}" for i, (x, y, z) in enumerate(points)), "$EndNodes"]
    lines += ["$Elements", str(len(elements)), *(f"{i + 1} {e}" for i, e in enumerate(elements)), "$EndElements"]
    return "\n".join(lines) + "\n"


SQUARE = ["1 2 1 1 1 2", "1 2 1 1 2 3", "1 2 1 1 3 4", "1 2 1 1 4 1", "2 2 2 1 1 2 3", "2 2 2 1 1 3 4"]
NAMES = ['1 1 "wall"', '2 2 "fluid"']


def plane(x, y):
    return (x, y, 0)


class Test(ProgramTest):
    def warned(self, *arguments, names, status=0):
        """The figures of a command that says one thing in a line and in warnings[]."""
        outcome = self.succeed(*arguments, "--json", status=status)
        figures = outcome.json()
        self.assertEqual([f"remodel: {sentence}" for sentence in figures["warnings"]], outcome.stderr.splitlines())
        for name in [names] if isinstance(names, str) else names:
            self.assertEqual(sum(name in sentence for sentence in figures["warnings"]), 1, figures["warnings"])
        return figures

    def quiet(self, *arguments):
        outcome = self.succeed(*arguments, "--json")
        self.assertEqual((outcome.json()["warnings"], outcome.stderr), ([], ""))
        return outcome.json()


class Rounding(Test):
    def test_walls_that_differ_by_rounding_are_joined_and_said(self):
        figures = self.warned("mesh", CASES / "party_wall.poly", "-o", "m.vtkhdf",
                              names=["point 8 at (412012.250000003, 5712000.5) with point 5 at (412012.25, 5712000.5)"])
        self.assertEqual(figures["stopped"], "done")
        self.assertEqual(figures["input"]["joined"], 2)
        self.assertAlmostEqual(figures["input"]["joined_distance"], 3.03e-9, delta=1e-10)
        self.assertLess(figures["triangles"], 2000)
        self.assertEqual(self.succeed("check", "m.vtkhdf").status, 0)

    def test_an_outline_that_closes_but_for_rounding_is_closed(self):
        figures = self.warned("mesh", CASES / "circle_closed_by_rounding.poly", "-o", "m.vtkhdf", names="point 36 at")
        self.assertEqual((figures["input"]["joined"], figures["stopped"]), (1, "done"))
        self.refused("mesh", CASES / "circle_closed_by_rounding.poly", "--join", "0", "-o", "n.vtkhdf",
                     names="open at (5, 1), 4.44e-16 away from the point at (5, 0.9999999999999996)")

    def test_a_point_beside_a_wall_by_rounding_is_on_it(self):
        beside = math.nextafter(5712000.5, 0)
        text = ("6 2 0 0\n0 411960.25 5712000.5\n1 412080.25 5712000.5\n2 412080.25 5712050.5\n3 411960.25 5712050.5\n"
                f"4 412000.25 {beside!r}\n5 412000.25 5712030.5\n5 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n4 4 5\n0\n")
        figures = self.warned("mesh", self.write("t.poly", text), "-o", "m.vtkhdf", names="beside it")
        self.assertEqual((figures["input"]["points_on_segments"], figures["stopped"]), (1, "done"))

    def test_a_narrow_channel_is_no_rounding(self):
        text = ("8 2 0 0\n0 0 0\n1 3 0\n2 3 1\n3 0 1\n4 1 0.3\n5 1.001 0.3\n6 1.001 0.7\n7 1 0.7\n8 0\n"
                "0 0 1\n1 1 2\n2 2 3\n3 3 0\n4 4 5\n5 5 6\n6 6 7\n7 7 4\n0\n")
        figures = self.quiet("mesh", self.write("channel.poly", text), "-o", "m.vtkhdf")
        self.assertEqual((figures["input"]["joined"], figures["stopped"]), (0, "done"))

    def test_a_limit_names_the_place_where_triangles_pile_up(self):
        text = ("8 2 0 0\n0 0 0\n1 2 0\n2 2 1\n3 0 1\n4 0.5 0.00001\n5 1.5 0.00001\n6 1.5 0.5\n7 0.5 0.5\n8 1\n"
                "0 0 1 1\n1 1 2 1\n2 2 3 1\n3 3 0 1\n4 4 5 2\n5 5 6 2\n6 6 7 2\n7 7 4 2\n1\n0 1 0.2\n")
        figures = self.warned("mesh", self.write("slit.poly", text), "--max-vertices", "3000", "-o", "m.vtkhdf",
                              names="the limit of 3000 vertices ended refinement", status=3)
        self.assertRegex(figures["warnings"][0], r'the walls "[12]" and "[12]" are \S+ apart')

    def domain(self, end):
        box = [[0, 0], [2, 0], [2, 1], [0, 1], [0, 0]]
        crack = {"role": "internal", "open": True, "curves": [
            {"name": "crack", "shape": {"kind": "polyline", "points": [end, [1, 0.5]]}, "stations": 4}]}
        outer = {"role": "outer", "curves": [
            {"name": "wall", "shape": {"kind": "polyline", "points": box}, "stations": 8}]}
        return self.write("d.json", json.dumps({"loops": [outer, crack]}))

    def test_an_end_of_a_chain_that_misses_a_station_by_rounding_is_joined(self):
        exact = self.quiet("mesh", self.domain([1, 0]), "-o", "exact.vtkhdf")
        figures = self.warned("mesh", self.domain([1, 3e-16]), "-o", "m.vtkhdf", names="was joined with it")
        self.assertEqual(figures["triangles"], exact["triangles"])
        self.assertEqual(self.succeed("check", "m.vtkhdf").status, 0)

    def test_an_end_beside_a_wall_without_a_station_is_refused_by_both_places(self):
        self.refused("mesh", self.domain([1.1, 3e-16]), "-o", "m.vtkhdf", names="(1.1, 3e-16)")


class OneRule(Test):
    def test_loops_that_touch_are_valid_in_every_format(self):
        self.succeed("mesh", CASES / "islands_that_touch.poly", "-o", "m.vtkhdf", "-o", "m.su2", "-o", "m.msh",
                     "-o", "m.vtu")
        self.succeed("convert", "m.vtkhdf", "-o", "m22.msh", "--msh-version", "2.2")
        for name in ("m.vtkhdf", "m.su2", "m.msh", "m22.msh", "m.vtu"):
            figures = self.warned("check", name, names="loops of the boundary touch in 1 point")
            self.assertTrue(figures["valid"], name)
            self.assertEqual(figures["touching_points"], 1)

    def test_many_loops_that_touch_are_valid_in_every_format(self):
        # A chequerboard of holes, which touch at their corners.
        corners, segments, holes = [(-1, -1), (6, -1), (6, 6), (-1, 6)], [(0, 1), (1, 2), (2, 3), (3, 0)], []
        for i in range(5):
            for j in range(5):
                if (i + j) % 2:
                    continue
                first = len(corners)
                corners += [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                segments += [(first + k, first + (k + 1) % 4) for k in range(4)]
                holes.append((i + 0.5, j + 0.5))
        lines = [f"{len(corners)} 2 0 0", *(f"{i} {x} {y}" for i, (x, y) in enumerate(corners)), f"{len(segments)} 0"]
        lines += [f"{i} {a} {b}" for i, (a, b) in enumerate(segments)]
        lines += [str(len(holes)), *(f"{i} {x} {y}" for i, (x, y) in enumerate(holes))]
        self.write("board.poly", "\n".join(lines) + "\n")
        self.succeed("mesh", "board.poly", "-o", "m.vtkhdf", "-o", "m.su2", "-o", "m.msh", "-o", "m.vtu")
        for name in ("m.vtkhdf", "m.su2", "m.msh", "m.vtu"):
            self.assertEqual(self.figures("check", name)["touching_points"], 16, name)

    def test_a_mesh_that_a_limit_ended_is_valid_but_below_its_quality(self):
        self.succeed("mesh", "naca:0012", "--max-vertices", "300", "-o", "m.vtkhdf", "-o", "m.su2", "-o", "m.vtu",
                     status=3)
        figures = self.warned("check", "m.vtkhdf", names="refinement ended at a limit (vertex-budget)")
        self.assertTrue(figures["valid"])
        self.assertGreater(figures["beyond_bounds"], 0)
        for name in ("m.su2", "m.vtu"):
            self.assertTrue(self.figures("check", name)["valid"], name)
        for name in ("m.vtkhdf", "m.su2", "m.vtu"):
            asked = self.figures("check", name, "--min-angle", "30", status=1)
            self.assertIn("angle", {violation["rule"] for violation in asked["violations"]}, name)


class Losses(Test):
    def test_regions_of_a_graph_are_names_of_parts(self):
        figures = self.warned("mesh", CASES / "two_materials.poly", "-o", "m.vtkhdf", "-o", "m.msh", "-o", "m.vtu",
                              names="the area bounds of 1 region are left out")
        for name in ("m.vtkhdf", "m.msh", "m.vtu"):
            regions = self.figures("check", name)["regions"]
            self.assertEqual(set(regions), {"11", "12"}, name)
            self.assertEqual(sum(regions.values()), figures["triangles"])

    def test_regions_that_find_no_place_are_said(self):
        text = (CASES / "two_materials.poly").read_text().replace("2\n0 1 1 11 0.2", "4\n7 9 9 5\n8 1.5 1 6\n0 1 1 11")
        figures = self.warned("mesh", self.write("r.poly", text), "-o", "m.vtkhdf",
                              names=["region '5' at (9, 9) lies outside", "region '11' at (1, 1) lies in one part with"])
        self.assertEqual(set(self.figures("check", "m.vtkhdf")["regions"]), {"6", "12"}, figures)

    def test_a_missing_node_file_is_called_missing(self):
        self.refused("mesh", CASES / "without_node.poly", "-o", "m.vtkhdf", names="without_node.node: is missing")

    def test_data_of_points_in_a_graph_are_said_to_be_left_out(self):
        text = "4 2 1 1\n0 0 0 7.5 2\n1 1 0 7.5 2\n2 1 1 7.5 2\n3 0 1 7.5 2\n4 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n0\n"
        self.warned("mesh", self.write("a.poly", text), names="attributes and markers of points are left out")

    def test_boxes_of_su2_are_kept(self):
        self.succeed("mesh", "naca:0012", "--points", "40", "-o", "plain.su2")
        plain = self.path("plain.su2").read_text()
        self.write("a.su2", plain + BOXES + SURFACE)
        self.quiet("convert", "a.su2", "-o", "b.su2", "-o", "b.vtkhdf")
        self.assertIn("\n" + BOXES + SURFACE, self.path("b.su2").read_text())
        self.quiet("convert", "b.vtkhdf", "-o", "c.su2")
        self.assertEqual(self.path("c.su2").read_text(), self.path("b.su2").read_text())
        self.warned("convert", "a.su2", "-o", "d.msh", names="FFD boxes are left out")
        self.warned("update", "a.su2", "rae2822", "--boundary", "airfoil", "-o", "e.su2", "-o", "e.vtkhdf",
                    names="2 surface points of FFD boxes")
        self.assertIn(BOXES + "FFD_SURFACE_POINTS= 0\n", self.path("e.su2").read_text())
        self.quiet("update", "e.vtkhdf", "naca:0012", "--boundary", "airfoil", "-o", "f.su2")
        self.assertIn(BOXES + "FFD_SURFACE_POINTS= 0\n", self.path("f.su2").read_text())
        self.assertEqual(self.succeed("check", "f.su2").status, 0)

    def test_boxes_go_through_batches_and_searches(self):
        self.succeed("mesh", "naca:0012", "--points", "40", "-o", "plain.su2")
        self.write("a.su2", self.path("plain.su2").read_text() + BOXES + "FFD_SURFACE_POINTS= 0\n")
        self.warned("batch", "a.su2", "rae2822", "naca:2412", "--boundary", "airfoil", "-o", "designs", "--meshes",
                    "su2,vtkhdf,msh", names="designs/*.msh: FFD boxes are left out")  # fmt: skip
        for file in ("001.su2", "002.su2"):
            self.assertIn(BOXES, self.path(f"designs/{file}").read_text())
        self.quiet("convert", "designs/002.vtkhdf", "-o", "b.su2")
        self.assertIn(BOXES, self.path("b.su2").read_text())
        count = "grep -c 'FFD_TAG= BOX' {mesh} | sed 's/.*/{ \"objective\": &, \"outputs\": { \"boxes\": & } }/'"
        self.succeed("optimise", "--mesh", "a.su2", "--boundary", "airfoil", "--evaluate", count, "--evaluations", 3, "--quiet",
                     "-o", "run")  # fmt: skip
        self.assertEqual(json.loads(self.path("run/result.json").read_text())["outputs"]["boxes"], 1)
        self.quiet("convert", "run/last.vtkhdf", "-o", "c.su2")
        self.assertIn(BOXES, self.path("c.su2").read_text())

    def test_other_sections_of_su2_are_said_to_be_left_out(self):
        self.succeed("mesh", "naca:0012", "--points", "40", "-o", "plain.su2")
        self.write("a.su2", self.path("plain.su2").read_text() + "NPERIODIC= 1\nPERIODIC_INDEX= 0\n0 0 0\n")
        self.warned("check", "a.su2", names="left out: 'NPERIODIC' and 'PERIODIC_INDEX'")

    def test_a_second_physical_group_is_said_to_be_left_out(self):
        # Gmsh 2.2 lists an element once for each of its groups.
        twice = SQUARE + ["1 2 3 1 1 2", "2 2 4 1 1 2 3"]
        self.write("a.msh", square_msh(plane, NAMES + ['1 3 "inlet"', '2 4 "porous"'], twice))
        figures = self.warned("check", "a.msh", names="has the first one's name; left out there: 'inlet' and 'porous'")
        self.assertEqual((figures["triangles"], figures["boundary"]), (2, {"wall": 4}))

    def test_groups_without_elements_are_said_to_be_left_out(self):
        self.write("a.msh", square_msh(plane, NAMES + ['1 9 "nothing"', '0 1 "corner"'], SQUARE))
        self.warned("check", "a.msh", names="'corner' and 'nothing'")

    def test_a_mesh_in_another_plane_is_read_and_said(self):
        for coordinates, sentence in [
            (lambda x, y: (x, 2, y), "in the plane y = 2: its x and z are taken for x and y"),
            (lambda x, y: (3, x, y), "in the plane x = 3: its y and z are taken for x and y"),
            (lambda x, y: (x, y, 4), "in the plane z = 4, which is left out"),
        ]:
            self.write("a.msh", square_msh(coordinates, NAMES, SQUARE))
            self.assertEqual(self.warned("check", "a.msh", names=sentence)["area"], 1.0)
        self.quiet("convert", self.write("b.msh", square_msh(plane, NAMES, SQUARE)), "-o", "b.vtu")
        # The same in a .vtu file: the last of its points are x y z of the plane.
        flat = self.path("b.vtu").read_text()
        self.write("c.vtu", flat.replace("1 0 0\n1 1 0\n0 1 0\n", "1 0 0\n1 0 1\n0 0 1\n"))
        self.warned("check", "c.vtu", names="in the plane y = 0")
        self.write("d.vtu", flat.replace("1 0 0\n1 1 0\n0 1 0\n", "1 0 0\n1 1 1\n0 1 0\n"))
        self.refused("check", "d.vtu", names="z = 1 found at point 2")

    def test_quadrilaterals_are_read_and_cells_of_second_order_refused_with_what_to_do(self):
        figures = self.quiet("check", self.write("q.msh", QUAD_MSH))
        self.assertEqual((figures["triangles"], figures["quadrilaterals"], figures["cells"]), (0, 1, 1))
        self.refused("check", self.write("r.msh", QUAD_MSH.replace("5 3 ", "5 16 ")), names="(Gmsh: SetOrder 1)")


if __name__ == "__main__":
    main()
