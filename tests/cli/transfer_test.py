"""Values carried from mesh to mesh: `remodel transfer`, `remodel update` with fields and states, SU2's restart files
by readers of their own, and ids that name one vertex for good."""

import math
import re
import struct
import xml.etree.ElementTree

from harness import ProgramTest

NAMES = ["x", "y", "Density", "Momentum_x", "Momentum_y", "Energy"]


def ascii_restart(points, rows, names=NAMES):
    lines = [",".join(f'"{name}"' for name in ["PointID", *names])]
    for i, row in enumerate(rows):
        lines.append(", ".join([str(i), *(f"{value:.15e}" for value in row)]))
    return "\n".join(lines) + "\n"


def binary_restart(rows, names=NAMES):
    header = struct.pack("<5i", 535532, len(names), len(rows), 0, 0)
    texts = b"".join(name.encode().ljust(33, b"\0") for name in names)
    return header + texts + b"".join(struct.pack(f"<{len(names)}d", *row) for row in rows)


def read_ascii(text):
    lines = text.splitlines()
    names = [name.strip('"') for name in lines[0].split(",")]
    rows = [[float(value) for value in line.split(",")] for line in lines[1:]]
    assert names[0] == "PointID" and [row[0] for row in rows] == list(range(len(rows)))
    return names[1:], [row[1:] for row in rows]


def read_binary(content):
    magic, columns, points, zero, null = struct.unpack_from("<5i", content)
    assert (magic, zero, null) == (535532, 0, 0)
    names = [content[20 + 33 * k : 53 + 33 * k].split(b"\0")[0].decode() for k in range(columns)]
    values = struct.unpack_from(f"<{columns * points}d", content, 20 + 33 * columns)
    assert len(content) == 20 + 33 * columns + 8 * columns * points
    return names, [list(values[i * columns : (i + 1) * columns]) for i in range(points)]


def su2_points(text):
    lines = iter(text.splitlines())
    count = next(int(line.split("=")[1]) for line in lines if line.startswith("NPOIN="))
    return [tuple(map(float, next(lines).split()[:2])) for _ in range(count)]


def vtu_array(file, name, kind=float):
    for array in xml.etree.ElementTree.parse(file).iter("DataArray"):
        if array.get("Name") == name:
            return [kind(word) for word in array.text.split()]
    raise AssertionError(f"{file} has no array {name}")


def gas(x, y):
    density = 1.0 + 0.1 * math.tanh(x) + 0.05 * math.tanh(y)
    u, v, pressure = 0.5 + 0.1 * math.tanh(y), 0.1 * math.tanh(x), 0.7 + 0.1 * math.tanh(x * y)
    return [x, y, density, density * u, density * v, pressure / 0.4 + 0.5 * density * (u * u + v * v)]


class States(ProgramTest):
    def meshes(self):
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "a.vtkhdf", "-o", "a.su2")
        points = su2_points(self.path("a.su2").read_text())
        rows = [gas(*point) for point in points]
        self.write("a.csv", ascii_restart(points, rows))
        self.write("a.dat", binary_restart(rows))
        return points, rows

    def test_rows_are_those_of_the_new_mesh_in_its_order(self):
        _, rows = self.meshes()
        outputs = ["-o", "b.su2", "-o", "b.vtkhdf", "--state-out", "b.dat"]
        figures = self.figures("update", "a.vtkhdf", "naca:2412", "--state", "a.dat", *outputs)
        self.assertKeys(figures, "points carried interpolated outside integral_before integral_after")
        points = su2_points(self.path("b.su2").read_text())
        names, found = read_binary(self.path("b.dat").read_bytes())
        self.assertEqual(names, NAMES)
        self.assertEqual([tuple(row[:2]) for row in found], points)
        self.assertEqual(figures["points"], len(points))
        self.assertEqual(figures["carried"] + figures["interpolated"], len(points))
        # Whatever stands where it stood has the bits that it had.
        old = {tuple(row[:2]): row for row in rows}
        stayed = [row for row in found if tuple(row[:2]) in old]
        self.assertGreater(len(stayed), len(points) // 2)
        for row in stayed:
            self.assertEqual(row, old[tuple(row[:2])])
        self.succeed("transfer", "a.vtkhdf", "b.vtkhdf", "--state", "a.dat", "--state-out", "c.dat")
        self.assertEqual(self.path("c.dat").read_bytes(), self.path("b.dat").read_bytes())

    def test_ascii_and_binary_hold_the_same(self):
        self.meshes()
        self.succeed("update", "a.vtkhdf", "naca:2412", "--state", "a.dat", "--state-out", "b.dat", "-o", "b.su2")
        self.succeed("update", "a.vtkhdf", "naca:2412", "--state", "a.dat", "--state-out", "b.csv")
        text = self.path("b.csv").read_text()
        self.assertEqual(read_ascii(text), read_binary(self.path("b.dat").read_bytes()))
        self.assertTrue(text.startswith('"PointID","x","y","Density",'))
        numbers = re.findall(r"-?\d\.\d+e[+-]\d\d+", text)
        self.assertEqual(len(numbers), 6 * len(text.splitlines()) - 6)
        self.assertTrue(all(len(number.lstrip("-").split("e")[0]) == 18 for number in numbers))

    def test_conservative_states_keep_their_integrals_and_bounds(self):
        _, rows = self.meshes()
        states = ["--state", "a.csv", "--state-out", "b.dat"]
        figures = self.figures("update", "a.vtkhdf", "naca:2412", *states, "--conservative")
        swept, rounding = figures["swept"], 1e-12 * abs(figures["integral_before"]["Energy"])
        self.assertGreater(swept["area_gained"], 0)
        for name in NAMES[2:]:
            before, after = figures["integral_before"][name], figures["integral_after"][name]
            self.assertAlmostEqual(after, before + swept["gained"][name] - swept["lost"][name], delta=rounding)
        _, found = read_binary(self.path("b.dat").read_bytes())
        for k in range(2, 6):
            old = [row[k] for row in rows]
            self.assertGreaterEqual(min(row[k] for row in found), min(old) - 1e-12)
            self.assertLessEqual(max(row[k] for row in found), max(old) + 1e-12)

    def test_meshes_without_keys_are_matched_by_places(self):
        _, rows = self.meshes()
        self.succeed("update", "a.vtkhdf", "naca:2412", "-o", "b.su2")
        figures = self.figures("transfer", "a.su2", "b.su2", "--state", "a.csv", "--state-out", "b.csv")
        self.assertGreater(figures["carried"], len(rows) // 2)
        # The file's own order, whatever an import makes of it.
        outputs = ["-o", "c.su2", "--state-out", "c.dat"]
        self.succeed("update", "a.su2", "naca:0012", "--boundary", "airfoil", "--state", "a.dat", *outputs)
        points = su2_points(self.path("c.su2").read_text())
        _, found = read_binary(self.path("c.dat").read_bytes())
        old = {tuple(row[:2]): row for row in rows}
        for point, row in zip(points, found, strict=True):
            if point in old:
                self.assertEqual(row, old[point])

    def test_a_state_of_another_mesh_is_refused(self):
        points, rows = self.meshes()
        update = ("update", "a.vtkhdf", "naca:2412", "--state", "other.csv", "--state-out", "b.csv")
        # As many points, of which one is elsewhere; then numbers of six digits, as SU2 may write them.
        moved = [[*rows[0]], *rows[1:7], [rows[7][0], rows[7][1] + 1e-3, *rows[7][2:]], *rows[8:]]
        self.write("other.csv", ascii_restart(points, moved))
        self.assertIn("in the row of point 7, expected", self.refused(*update, names="other.csv: found y = "))
        self.write("other.csv", ascii_restart(points, list(reversed(rows))))
        self.refused(*update, names="the file is of another mesh")
        self.refused("transfer", "a.vtkhdf", "a.su2", *update[3:], names="other.csv: found x = ")
        self.write("other.csv", ascii_restart(points, [[float(f"{value:.5e}") for value in row] for row in rows]))
        self.succeed(*update)
        # Without coordinates nothing can be said.
        self.write("other.csv", ascii_restart(points, [row[2:] for row in reversed(rows)], NAMES[2:]))
        self.succeed(*update)

    def test_bad_states_are_refused(self):
        points, rows = self.meshes()
        self.write("short.csv", ascii_restart(points, rows[:-1]))
        self.write("cut.dat", binary_restart(rows)[:-1])
        self.write("order.csv", ascii_restart(points, rows).replace("\n1, ", "\n7, ", 1))
        self.write("nan.csv", ascii_restart(points, [[float("nan")] * 6] + rows[1:]))
        self.write("wide.csv", ascii_restart(points, [[*rows[0], 1.0], *rows[1:]]))
        self.write("text.csv", "a mesh\n")
        update = ["update", "a.vtkhdf", "naca:2412", "-o", "b.su2", "--state-out", "b.csv"]
        for place in ("short.csv", "cut.dat", "order.csv:3", "nan.csv:2", "wide.csv:2", "text.csv:1", "none.csv"):
            with self.subTest(place):
                self.refused(*update, "--state", place.split(":")[0], names=place)
        self.refused(*update, names="--state")
        self.refused("update", "a.vtkhdf", "naca:2412", "--state", "a.csv", "--state-out", "b.txt", names="b.txt")
        self.path("directory.csv").mkdir()
        for out, names in (("b.txt", "b.txt"), ("directory.csv", "is a directory"), ("none/b.csv", "none")):
            self.refused(*update[:-1], out, "--state", "a.csv", names=names)
        self.write("long.csv", ascii_restart(points, rows).replace("Density", "D" * 33, 1))
        self.refused(*update, "--state", "long.csv", names="1 to 32 characters")
        self.refused("transfer", "a.vtkhdf", "a.vtkhdf", "-o", "c.vtu", names="no fields")
        self.refused("transfer", "a.vtkhdf", "a.vtkhdf", "--state", "a.csv", names="--state")
        thinner = [*update[:2], "naca:0006", "--method", "general", *update[3:], "--state", "a.csv"]
        self.refused(*thinner, "--outside", "refuse", names="beyond the old domain")


class Fields(ProgramTest):
    def test_fields_of_a_mesh_are_carried_by_updates_in_every_format(self):
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "a.vtkhdf")
        self.succeed("flow", "a.vtkhdf", "--model", "potential", "--alpha", 2, "-o", "flow.vtkhdf", "-o", "flow.vtu")
        figures = self.figures("update", "flow.vtkhdf", "naca:1412", "-o", "b.vtu", "-o", "b.vtkhdf", "-o", "b.msh")
        self.assertGreater(len(figures["fields"]), 0)
        name = figures["fields"][0]
        values, old = vtu_array(self.path("b.vtu"), name), vtu_array(self.path("flow.vtu"), name)
        self.assertLessEqual(max(values), max(old) + 1e-12)
        self.assertGreaterEqual(min(values), min(old) - 1e-12)
        for end in ("vtkhdf", "msh"):
            self.succeed("convert", f"b.{end}", "-o", f"{end}.vtu")
            self.assertEqual(vtu_array(self.path(f"{end}.vtu"), name), values)
        again = self.figures("transfer", "flow.vtkhdf", "b.vtkhdf", "-o", "c.vtu", "--conservative")
        self.assertEqual(again["fields"], figures["fields"])


class Keys(ProgramTest):
    def test_a_key_names_one_vertex_over_steps_files_and_regenerations(self):
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "0.vtkhdf")
        shapes = ["naca:2412", "naca:0018", "naca:4415", "naca:0008", "naca:2412", "naca:0012"]
        interior = {}
        for i, shape in enumerate(shapes, start=1):
            method = ["--method", "general"] if i % 2 else []
            outputs = [word for end in ("vtkhdf", "vtu", "msh") for word in ("-o", f"{i}.{end}")]
            self.succeed("update", f"{i - 1}.vtkhdf", shape, *method, *outputs)
            points = vtu_array(self.path(f"{i}.vtu"), "Points")
            keys = vtu_array(self.path(f"{i}.vtu"), "vertex_key", int)
            curves = vtu_array(self.path(f"{i}.vtu"), "curve", int)
            self.assertEqual(len(set(keys)), len(keys))
            for k, key in enumerate(keys):
                if curves[k] < 0:
                    place = (points[3 * k], points[3 * k + 1])
                    self.assertEqual(interior.setdefault(key, place), place)
            self.succeed("convert", f"{i}.msh", "-o", "again.vtu")
            self.assertEqual(vtu_array(self.path("again.vtu"), "vertex_key", int), keys)
        # Ids come again: what an id alone says of a vertex is not enough.
        self.assertLess(len({key & 0xFFFFFFFF for key in interior}), len(interior))

    # A mesh that lives in files alone is imported at every step.
    def test_a_key_names_one_vertex_over_steps_through_files_of_other_programs(self):
        for end in ("vtu", "msh"):
            self.succeed("mesh", "naca:0012", "--points", 40, "-o", f"0.{end}")
            interior, kept = {}, 0
            for i, shape in enumerate(["naca:2412", "naca:2410", "naca:0014"], start=1):
                self.succeed("update", f"{i - 1}.{end}", shape, "--boundary", "airfoil", "-o", f"{i}.{end}")
                self.succeed("convert", f"{i}.{end}", "-o", "now.vtu")
                points = vtu_array(self.path("now.vtu"), "Points")
                boundary = self.boundary_points("now.vtu")
                for k, key in enumerate(vtu_array(self.path("now.vtu"), "vertex_key", int)):
                    if k in boundary:
                        continue
                    place = (points[3 * k], points[3 * k + 1])
                    kept += key in interior
                    self.assertEqual(interior.setdefault(key, place), place)
            self.assertGreater(kept, 100)

    def boundary_points(self, name):
        corners = vtu_array(self.path(name), "connectivity", int)
        offsets = vtu_array(self.path(name), "offsets", int)
        ends = zip([0, *offsets], offsets)
        return {v for begin, end in ends if end - begin == 2 for v in corners[begin:end]}
