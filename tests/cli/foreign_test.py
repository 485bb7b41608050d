"""What programs beside ours write and read: points that no cell uses, vectors, keys, names with blanks, a far field of several parts."""

import json
import unittest

import shapes
from airfoils_test import blunt
from harness import ProgramTest
from import_test import read_su2
from transfer_test import ascii_restart, gas, read_ascii, su2_points, vtu_array

# A wall and a tunnel around it, with blanks in their names.
TUNNEL = {"loops": [
    {"role": "outer", "curves": [{"name": "tunnel wall", "shape": {"kind": "polyline",
     "points": [[-2, -2], [3, -2], [3, 2], [-2, 2], [-2, -2]]}, "stations": 24}]},
    {"role": "hole", "curves": [{"name": "body", "shape": {"kind": "arc", "centre": [0.5, 0], "radius": 0.5, "start": 0,
                                                           "sweep": 6.283185307179586}, "stations": 24}]}]}  # fmt: skip


def with_stray_points(text):
    """An .su2 file with a point before all others and one behind them, which no cell uses."""
    lines, result, section = text.splitlines(), [], None
    for line in lines:
        key, equals, value = line.partition("=")
        if equals:
            section = key
            if key == "NPOIN":
                count = int(value)
                result += [f"NPOIN= {count + 2}", "5 5"]
                continue
            if key == "NMARK":
                result.append("6 6")
            result.append(line)
            continue
        words = line.split()
        if section == "NPOIN":
            words = words[:2]
        elif words and words[0] != "%":
            corners = {"3": 2, "5": 3, "9": 4}[words[0]]
            words = [words[0], *(str(int(v) + 1) for v in words[1 : 1 + corners])]
        result.append(" ".join(words))
    return "\n".join(result) + "\n"


class StrayPoints(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "a.su2", "-o", "a.msh")
        self.write("stray.su2", with_stray_points(self.path("a.su2").read_text()))
        text = self.path("a.msh").read_text()
        count = len(su2_points(self.path("a.su2").read_text()))
        head = f"$Nodes\n1 {count} 1 {count}\n2 1 0 {count}\n"
        self.assertIn(head, text)
        more = f"$Nodes\n2 {count + 1} 1 {count + 1}\n0 1 0 1\n{count + 1}\n0.5 0 0\n2 1 0 {count}\n"
        self.write("stray.msh", text.replace(head, more))

    def assertSaid(self, outcome, sentence):
        self.assertIn(sentence, outcome.stderr)
        self.assertEqual(outcome.stderr.count(sentence), 1, outcome)

    def test_flows_are_found_and_the_points_counted(self):
        flow = ("--mach", 0.4, "--alpha", 1, "--json")
        expected = self.succeed("flow", "a.su2", *flow).json()
        for file, sentence in (("stray.su2", "stray.su2: 2 points that no cell uses are left out"),
                               ("stray.msh", "stray.msh: a point that no cell uses is left out")):  # fmt: skip
            outcome = self.succeed("flow", file, *flow)
            self.assertSaid(outcome, sentence)
            self.assertEqual([outcome.json()[key] for key in ("cl", "cd", "cm")], [expected[key] for key in ("cl", "cd", "cm")])
            check = self.succeed("check", file, "--json")
            self.assertTrue(check.json()["valid"])
            self.assertEqual(check.json()["unused_points"], 2 if file == "stray.su2" else 1)
            self.assertSaid(check, sentence)
            update = self.succeed("update", file, "naca:0013", "--boundary", "airfoil", "-o", "b.su2", "--json")
            self.assertEqual(update.json()["import"]["unused_points"], check.json()["unused_points"])
        self.assertTrue(self.figures("flow", "stray.msh", "--model", "potential")["lift_determined"])

    def test_the_mesh_without_them_is_written(self):
        for file in ("stray.su2", "stray.msh"):
            self.succeed("convert", file, "-o", "back.su2")
            self.assertEqual(read_su2(self.path("back.su2")), read_su2(self.path("a.su2")))

    def test_states_have_a_row_for_each_point_of_the_file(self):
        points = su2_points(self.path("stray.su2").read_text())
        self.write("stray.csv", ascii_restart(points, [gas(*p) for p in points]))
        self.write("a.csv", ascii_restart(points[1:-1], [gas(*p) for p in points[1:-1]]))
        self.succeed("update", "a.su2", "naca:0013", "--boundary", "airfoil", "-o", "new.su2")
        for name in ("a", "stray"):
            self.succeed("transfer", f"{name}.su2", "new.su2", "--state", f"{name}.csv", "--state-out", f"{name}_new.csv")
        self.assertEqual(self.path("stray_new.csv").read_bytes(), self.path("a_new.csv").read_bytes())
        self.assertEqual(len(read_ascii(self.path("a_new.csv").read_text())[1]), len(su2_points(self.path("new.su2").read_text())))


class Vectors(ProgramTest):
    def test_velocities_have_three_components_and_come_back_as_they_were(self):
        self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.4, "-o", "a.vtu", "-o", "a.vtkhdf", "-o", "a.msh")
        text = self.path("a.vtu").read_text()
        self.assertRegex(text, 'Name="velocity" NumberOfComponents="3"')
        self.assertNotIn('NumberOfComponents="2"', text)
        velocity = vtu_array(self.path("a.vtu"), "velocity")
        self.assertEqual(set(velocity[2::3]), {0.0})
        self.assertGreater(len(set(velocity[1::3])), 10)
        for file in ("a.vtu", "a.vtkhdf", "a.msh"):
            self.succeed("convert", file, "-o", "again.vtu")
            self.assertEqual(vtu_array(self.path("again.vtu"), "velocity"), velocity, file)
            self.assertIn('remodel_components="2"', self.path("again.vtu").read_text(), file)

    def test_meshio_sees_vectors(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("needs python3-meshio, which is not installed")
        self.succeed("flow", "naca:0012", "--points", 40, "--mach", 0.4, "-o", "a.vtu", "-o", "a.msh")
        for name in ("a.vtu", "a.msh"):
            velocity = meshio.read(self.path(name)).point_data["velocity"]
            self.assertEqual(velocity.shape[1], 3)
            self.assertEqual(abs(velocity[:, 2]).max(), 0)


class Keys(ProgramTest):
    def test_layered_meshes_have_them_in_every_format_that_holds_them(self):
        layers = ("--layers", "--reynolds", 6e6, "--max-spacing", 0.05)
        for cells in ("quads", "triangles"):
            outputs = [word for end in ("msh", "vtu", "vtkhdf") for word in ("-o", f"a.{end}")]
            self.succeed("mesh", "naca:0012", *layers, "--layer-cells", cells, *outputs)
            self.succeed("mesh", "naca:0012", *layers, "--layer-cells", cells, "--msh-version", "2.2", "-o", "old.msh")
            keys = vtu_array(self.path("a.vtu"), "vertex_key", int)
            self.assertEqual(len(set(keys)), len(keys))
            self.assertGreater(max(keys), 2**63)
            self.assertIn('"vertex_key"', self.path("a.msh").read_text())
            for file in ("a.msh", "old.msh", "a.vtkhdf"):
                self.succeed("convert", file, "-o", "b.vtu")
                self.assertEqual(vtu_array(self.path("b.vtu"), "vertex_key", int), keys, file)


class Names(ProgramTest):
    def test_blanks_are_underscores_where_they_have_to_be(self):
        self.write("d.json", json.dumps(TUNNEL))
        outcome = self.succeed("mesh", "d.json", "-o", "a.su2", "-o", "a.msh", "-o", "case.foam")
        self.assertEqual(outcome.stderr.splitlines(), [
            f"remodel: {file}: boundary 'tunnel wall' is called 'tunnel_wall' there: names of the format have no blanks"
            for file in ("a.su2", "case.foam")])
        self.assertEqual(set(self.figures("check", "a.su2")["boundary"]), {"tunnel_wall", "body"})
        self.assertEqual(set(self.figures("check", "a.msh")["boundary"]), {"tunnel wall", "body"})
        self.assertIn("tunnel_wall", self.path("constant/polyMesh/boundary").read_text())

    def test_two_names_that_would_be_one_are_refused(self):
        domain = json.loads(json.dumps(TUNNEL))
        domain["loops"][1]["curves"][0]["name"] = "tunnel_wall"
        self.write("d.json", json.dumps(domain))
        for file in ("a.su2", "case.foam"):
            names = f"{file}: boundaries 'tunnel wall' and 'tunnel_wall' found, which would both be 'tunnel_wall'"
            self.refused("mesh", "d.json", "-o", file, names=names)


class FarFields(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "a.su2")
        head, tail = self.path("a.su2").read_text().split("MARKER_TAG= farfield\n")
        count, *edges = tail.splitlines()
        edges, rest = edges[:50], edges[50:]
        self.assertTrue(count.endswith("= 50") and len(edges) == 50)
        parts = [("inflow", edges[:20]), ("far out", edges[20:35]), ("sides", edges[35:])]
        text = head.replace("NMARK= 2", "NMARK= 4")
        for name, lines in parts:
            text += f"MARKER_TAG= {name}\nMARKER_ELEMS= {len(lines)}\n" + "".join(line + "\n" for line in lines)
        self.write("parts.su2", text + "\n".join(rest) + "\n")
        self.far = [word for name in ("inflow", "far out", "sides") for word in ("--farfield", name)]

    def test_a_far_field_of_several_parts_is_one(self):
        for model in ([], ["--model", "potential"]):
            flow = ("--mach", 0.4, "--alpha", 2, *model)
            whole = self.figures("flow", "a.su2", *flow)
            parts = self.figures("flow", "parts.su2", *flow, *self.far, *([] if model else ["--cp-plot", "cp.svg"]))
            self.assertEqual([body["name"] for body in parts["bodies"]], ["airfoil"])
            for key in ("cl", "cm") if model else ("cl", "cd", "cm"):
                self.assertAlmostEqual(parts[key], whole[key], delta=1e-9)
        row = self.figures("polar", "parts.su2", "--mach", 0.4, "--alpha", "2:2:1", *self.far)
        self.assertAlmostEqual(row["points"][0]["cl"], self.figures("flow", "a.su2", "--mach", 0.4, "--alpha", 2)["cl"], delta=1e-8)

    def test_refusals(self):
        flow = ("flow", "parts.su2", "--mach", 0.4)
        self.refused(*flow, *self.far[:4], "--farfield", "sky", names="expected a far field of the name 'sky'")
        self.refused(*flow, *self.far, "--farfield", "inflow", names="'inflow'")
        self.refused(*flow, *self.far[:4], "--outlet", "sides", "--farfield", "sky", names="expected a far field of the name 'sky'")
        potential = (*flow, "--model", "potential")
        self.refused(*potential, *self.far, "--farfield", "sky", names="a far field of the name 'sky' expected")
        self.refused(*potential, *self.far[:4], names="a far field apart from all walls expected")


class Options(ProgramTest):
    """What would have no effect is refused."""

    def test_of_formats_that_are_not_written(self):
        self.succeed("mesh", "naca:0012", "--points", 20, "-o", "a.vtkhdf")
        for command in (("mesh", "naca:0012", "--points", 20), ("convert", "a.vtkhdf"), ("update", "a.vtkhdf", "naca:0013")):
            self.refused(*command, "--msh-version", "2.2", "-o", "b.vtu", names="--msh-version: given without a .msh file")
            self.refused(*command, "--inner-markers", "-o", "b.vtu", names="--inner-markers: given without a .su2 file")
        self.refused("flow", "naca:0012", "--mach", 0.4, "--msh-version", "2.2", names="--msh-version")
        self.refused("batch", "a.vtkhdf", "naca:0013", "-o", "out", "--inner-markers", names="--inner-markers")
        self.succeed("convert", "a.vtkhdf", "--msh-version", "2.2", "-o", "b.vtu", "-o", "b.msh")

    def test_of_layers_that_are_not_there(self):
        self.succeed("mesh", "naca:0012", "--points", 20, "-o", "a.vtkhdf")
        cells = ("--layer-cells", "triangles")
        self.refused("mesh", "naca:0012", *cells, "-o", "b.vtu", names="--layer-cells: given without --layers")
        self.refused("batch", "a.vtkhdf", "naca:0013", *cells, "-o", "out", names="--layer-cells: given for 'a.vtkhdf'")
        search = ("optimise", "--from", "naca:0012", "--to", "naca:0013", "--evaluations", 3, "-o", "run")
        program = ("optimise", "--from", "naca:0012", "--evaluate", "true", "--evaluations", 3, "-o", "run")
        self.refused(*program, *cells, names="--layer-cells: given without layers")
        self.refused(*search, *cells, "--layers", "--reynolds", 1e6, names="--layer-cells: given without --evaluate")

    def test_of_coordinate_files_for_names(self):
        close = "--close-trailing-edge"
        self.succeed("mesh", "naca:0012", "--points", 20, "-o", "a.vtkhdf")
        self.succeed("fit", "naca:0012", "-o", "a.json")
        for shape in ("naca:0012", "rae2822", "a.json"):
            named = f"{close}: given for '{shape}', expected for coordinate files"
            self.refused("mesh", shape, close, "-o", "b.vtu", names=named)
            self.refused("fit", shape, close, names=named)
            self.refused("update", "a.vtkhdf", shape, close, names=named)
            self.refused("flow", shape, close, "--mach", 0.4, names=named)
            self.refused("polar", shape, close, "--mach", 0.4, "--alpha", "0:1:1", names=named)
            self.refused("batch", "a.vtkhdf", shape, close, "-o", "out", names=named)
            self.refused("optimise", "--from", shape, "--to", "naca:0013", close, "-o", "run", names=named)
            self.refused("noise", shape, "--mach", 0.4, close, names=named)
        self.write("blunt.dat", shapes.text_of(blunt(0.02)))
        self.succeed("mesh", "blunt.dat", "naca:0012", "--place", "1,0,0,0", "--place", "1,0,0,2", "--points", 20, close, "-o", "b.vtu")

    def test_of_strategies_that_are_not_chosen(self):
        self.succeed("mesh", "naca:0012", "--points", 20, "-o", "a.vtkhdf", "-o", "a.su2")
        update = ("update", "a.vtkhdf", "naca:0013")
        self.refused(*update, "--strategy", "chain", "--keep", 1.2, names="--keep: given with the strategy chain")
        self.refused(*update, "--delaunay-slack", 10, names="--delaunay-slack: given with the strategy renew, expected reference")
        self.refused("update", "a.su2", "naca:0013", "--boundary", "airfoil", "--keep", 1.2, names="--keep: given for 'a.su2'")
        self.refused("batch", "a.vtkhdf", "naca:0013", "-o", "out", "--strategy", "chain", "--keep", 1.2, names="--keep")
        search = ("optimise", "--from", "naca:0012", "--to", "naca:0013", "--points", 20, "--evaluations", 3, "--quiet", "-o", "run")
        for strategy in ("chain", "regenerate"):
            self.refused(*search, "--strategy", strategy, "--keep", 1.2, names="--keep: given with the strategy chain")
        self.refused(*search, "--delaunay-slack", 10, names="--delaunay-slack")
        self.succeed(*update, "--strategy", "reference", "--delaunay-slack", 10, "--keep", 1.3, "-o", "b.vtkhdf")
        self.succeed(*search, "--strategy", "morph", "--keep", 1.3)


if __name__ == "__main__":
    unittest.main()
