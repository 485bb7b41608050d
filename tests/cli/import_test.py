"""Meshes of other programs: `update --boundary` and `optimise --mesh`. The fixtures are the program's own meshes, in
formats that do not record their origin."""

import sqlite3

from harness import ProgramTest, shared_file

TINY = 1e-8
IMPORT_KEYS = (
    "min_angle_deg promised_angle_deg refine_angle_deg gradation turned_triangles duplicate_triangles unused_points unnamed_edges "
    "non_delaunay_edges flipped_edges"
)


def read_su2(path):
    """Points, triangles and markers{name: edges} of a file as we write it."""
    points, triangles, markers = [], [], {}
    lines = iter(path.read_text().splitlines())
    for line in lines:
        key, _, value = line.partition("=")
        if key == "NELEM":
            triangles = [tuple(map(int, next(lines).split()[1:4])) for _ in range(int(value))]
        elif key == "NPOIN":
            points = [tuple(next(lines).split()[:2]) for _ in range(int(value.split()[0]))]
        elif key == "MARKER_TAG":
            count = int(next(lines).partition("=")[2])
            markers[value.strip()] = [tuple(map(int, next(lines).split()[1:3])) for _ in range(count)]
    return points, triangles, markers


def corners(path):
    """Every triangle by the text of its coordinates."""
    points, triangles, _ = read_su2(path)
    return {frozenset(points[v] for v in triangle) for triangle in triangles}


class Imports(ProgramTest):
    def test_overlapping_physical_surfaces_of_version_2_2_are_one(self):
        self.make()
        self.succeed("convert", "a.su2", "-o", "a.msh", "--msh-version", 2.2)
        head, elements = self.path("a.msh").read_text().split("$Elements\n")
        elements, tail = elements.split("$EndElements")
        rows = elements.splitlines()[1:]
        triangles = [row.split() for row in rows if row.split()[1] == "2"]
        # Gmsh lists a triangle once for each physical surface that it is in.
        again = [" ".join([str(len(rows) + 1 + i), *row[1:3], "77", *row[4:]]) for i, row in enumerate(triangles[:30])]
        rows += again
        self.write("twice.msh", f"{head}$Elements\n{len(rows)}\n" + "\n".join(rows) + f"\n$EndElements{tail}")
        figures = self.figures("update", "twice.msh", "naca:0013", "--boundary", "airfoil", "-o", "b.vtkhdf")
        self.assertEqual(figures["import"]["duplicate_triangles"], 30)
        self.assertTrue(self.figures("check", "b.vtkhdf")["valid"])
        once = self.figures("update", "a.msh", "naca:0013", "--boundary", "airfoil", "-o", "c.vtkhdf")
        self.assertEqual(figures["triangles"], once["triangles"])

    def make(self, name="a.su2", *more):
        self.succeed("mesh", "naca:0012", "--points", 60, "--min-angle", 22, "--gradation", 1, *more, "-o", name)
        return self.path(name)

    def check_update(self, before, figures, after):
        """Checks the properties of every update of a foreign mesh that is written as .su2."""
        self.assertKeys(figures["import"], IMPORT_KEYS)
        self.assertEqual(figures["stopped"], "done")
        self.assertFalse(figures["regenerated"])
        # A removed triangle may be created again identically.
        self.assertGreaterEqual(len(corners(before) & corners(after)), figures["preserved"])
        self.assertEqual(figures["kept"]["triangles"] + figures["changed"]["triangles"], figures["triangles"])
        checked = self.figures("check", after)
        self.assertTrue(checked["valid"])
        self.assertTrue(checked["delaunay"])
        self.assertGreaterEqual(checked["min_angle_deg"], figures["import"]["min_angle_deg"] * (1 - TINY))
        self.assertGreaterEqual(figures["min_angle_deg"], figures["import"]["min_angle_deg"] * (1 - TINY))
        if not figures["full_adjustment"]:
            self.assertGreaterEqual(figures["changed"]["min_angle_deg"], 30 * (1 - TINY))
        self.assertEqual(list(read_su2(before)[2]), list(read_su2(after)[2]))

    def test_only_what_is_near_the_change_changes(self):
        before = self.make()
        figures = self.figures("update", before, "rae2822", "--boundary", "airfoil", "--method", "general", "-o", "b.su2")
        self.assertEqual(figures["method"], "general")
        self.check_update(before, figures, self.path("b.su2"))
        figures = self.figures("update", before, "rae2822", "--boundary", "airfoil", "-o", "c.su2")
        self.assertEqual(figures["method"], "specialised")
        self.check_update(before, figures, self.path("c.su2"))
        self.assertEqual(len(read_su2(self.path("c.su2"))[2]["farfield"]), 50)

    def test_the_same_airfoil_moves_nothing_far(self):
        before = self.make()
        figures = self.figures("update", before, "naca:0012", "--boundary", "airfoil", "-o", "b.su2")
        self.check_update(before, figures, self.path("b.su2"))
        points, _, markers = read_su2(before)
        moved, _, new_markers = read_su2(self.path("b.su2"))
        if len(markers["airfoil"]) == len(new_markers["airfoil"]):
            distances = [
                min(abs(float(points[a][0]) - float(moved[b][0])) + abs(float(points[a][1]) - float(moved[b][1]))
                    for b, _ in new_markers["airfoil"])
                for a, _ in markers["airfoil"]
            ]
            self.assertLess(max(distances), 1e-9)

    def test_every_format_gives_the_same_mesh(self):
        self.make("a.msh", "-o", "a.su2", "-o", "a.vtu")
        self.succeed("convert", "a.su2", "-o", "a22.msh", "--msh-version", "2.2")
        self.succeed("convert", "a.su2", "-o", "bare.vtkhdf")
        for name in ("a.su2", "a.msh", "a22.msh", "a.vtu", "bare.vtkhdf"):
            self.succeed("update", name, "rae2822", "--boundary", "airfoil", "-o", f"from-{name}.su2")
        expected = self.path("from-a.su2.su2").read_bytes()
        for name in ("a.msh", "a22.msh", "a.vtu", "bare.vtkhdf"):
            self.assertEqual(self.path(f"from-{name}.su2").read_bytes(), expected, name)

    def test_a_native_file_goes_on(self):
        self.make()
        self.succeed("update", "a.su2", "rae2822", "--boundary", "airfoil", "-o", "b.vtkhdf", "-o", "b.su2")
        for name, boundary in (("c", ()), ("d", ("--boundary", "airfoil"))):
            figures = self.figures("update", "b.vtkhdf", "naca:2412", *boundary, "-o", f"{name}.vtkhdf", "-o", f"{name}.su2")
            self.assertNotIn("import", figures)
            self.assertGreaterEqual(len(corners(self.path("b.su2")) & corners(self.path(f"{name}.su2"))), figures["preserved"])
            self.assertGreaterEqual(figures["changed"]["min_angle_deg"], 30 * (1 - TINY))
            self.assertTrue(self.figures("check", f"{name}.vtkhdf")["valid"])
        self.assertEqual(self.path("c.su2").read_bytes(), self.path("d.su2").read_bytes())

    def test_the_number_of_points_can_be_another(self):
        before = self.make()
        figures = self.figures(
            "update", before, "rae2822", "--boundary", "airfoil", "--points", 90, "-o", "b.su2", "-o", "b.vtkhdf"
        )
        self.check_update(before, figures, self.path("b.su2"))
        self.assertGreaterEqual(len(read_su2(self.path("b.su2"))[2]["airfoil"]), 90)

    def test_triangles_that_are_not_delaunay(self):
        before = self.make()
        text = before.read_text().splitlines()
        points, triangles, _ = read_su2(before)
        across = {}
        for i, (a, b, c) in enumerate(triangles):
            for edge, apex in (((a, b), c), ((b, c), a), ((c, a), b)):
                across[edge] = (i, apex)
        where = [tuple(map(float, p)) for p in points]

        def area(a, b, c):
            (ax, ay), (bx, by), (cx, cy) = where[a], where[b], where[c]
            return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)

        flipped, used = 0, set()
        for (a, b), (i, c) in list(across.items()):
            if (b, a) not in across or not used.isdisjoint({i, across[b, a][0]}):
                continue
            j, d = across[b, a]
            if min(area(a, d, c), area(d, b, c)) < 0.3 * min(area(a, b, c), area(b, a, d)):
                continue
            text[2 + i], text[2 + j] = f"5 {a} {d} {c} {i}", f"5 {d} {b} {c} {j}"
            used |= {i, j}
            flipped += 1
        self.assertGreater(flipped, 20)
        bad = self.path(self.write("bad.su2", "\n".join(text) + "\n"))
        for how in ("flip", "keep"):
            figures = self.figures(
                "update", bad, "rae2822", "--boundary", "airfoil", "--non-delaunay", how, "-o", f"{how}.su2",
                "-o", f"{how}.vtkhdf",
            )
            self.assertTrue(self.figures("check", f"{how}.vtkhdf")["valid"])
            self.assertEqual(self.figures("check", f"{how}.su2")["min_angle_deg"], figures["min_angle_deg"])
            self.assertGreater(figures["import"]["non_delaunay_edges"], 20)
            checked = self.figures("check", f"{how}.su2")
            self.assertTrue(checked["valid"])
            self.assertEqual(checked["delaunay"], how == "flip")
            self.assertGreaterEqual(checked["min_angle_deg"], figures["import"]["min_angle_deg"] * (1 - TINY))
        self.assertGreater(
            len(corners(bad) & corners(self.path("keep.su2"))), len(corners(bad) & corners(self.path("flip.su2")))
        )

    def test_the_same_every_time(self):
        self.make()
        for name in ("b", "c"):
            self.succeed("update", "a.su2", "e376", "--boundary", "airfoil", "-o", f"{name}.vtkhdf", "-o", f"{name}.su2")
        for extension in ("vtkhdf", "su2"):
            self.assertEqual(
                self.path(f"b.{extension}").read_bytes(), self.path(f"c.{extension}").read_bytes(), extension
            )

    def test_refusals(self):
        self.make("a.su2", "-o", "a.vtkhdf")
        update = ("update", "a.su2", "rae2822", "-o", "b.su2")
        self.refused(*update, names="--boundary: not given, the airfoil's name in a.su2 expected")
        self.refused(*update, "--boundary", "wing", names="a.su2: no boundary 'wing' found, one of 'airfoil', 'farfield'")
        self.refused(*update, "--boundary", "farfield", names="a.su2: boundary 'farfield' surrounds the mesh")
        self.refused(*update, "--boundary", "airfoil", "--points", 61, names="--points")
        self.refused(*update, "--boundary", "airfoil", "--refine-angle", 34, names="--refine-angle")
        self.refused("update", "a.vtkhdf", "rae2822", "--refine-angle", 25, "-o", "b.su2", names="--refine-angle: given for")
        text = self.path("a.su2").read_text()
        lines = text.splitlines()
        lines[5] = "9 0 1 2 3 3"
        self.write("quads.su2", "\n".join(lines) + "\n")
        self.refused("update", "quads.su2", "rae2822", "--boundary", "airfoil", "-o", "b.su2", names="quads.su2: 1 quadrilateral found, which")
        corners = lines[4].split()
        apex = next(v for v in map(str, range(3, 99)) if v not in corners[1:4])
        lines[5] = " ".join([*corners[:3], apex, "3"])
        self.write("twice.su2", "\n".join(lines) + "\n")
        self.refused("update", "twice.su2", "rae2822", "--boundary", "airfoil", "-o", "b.su2", names=" overlap: both have the edge of points")

    # Refinement works to 30 degrees there too: to the mesh's own angle it would spread through all of it.
    def test_a_mesh_of_larger_angles_is_not_worn_out(self):
        self.succeed("mesh", "naca:0012", "--points", 100, "--min-angle", 32.5, "-o", "good.su2")
        for shape in ("naca:0013", "rae2822"):
            outcome = self.run_program("update", "good.su2", shape, "--boundary", "airfoil", "-o", "b.su2", "--json")
            self.assertEqual((outcome.status, outcome.stderr), (0, ""))
            figures = outcome.json()
            self.assertGreater(figures["import"]["min_angle_deg"], 32.4)
            self.assertEqual(figures["import"]["refine_angle_deg"], 30)
            self.assertFalse(figures["regenerated"])
            self.assertGreater(figures["preserved_percent"], 60)
            self.assertGreaterEqual(figures["min_angle_deg"], 30 * (1 - TINY))

    def test_the_shared_mesh(self):
        mesh, shape = shared_file(self, "meshes/mesh_NACA0012_inv.su2"), shared_file(self, "airfoils/rae2822.dat")
        figures = self.figures("update", mesh, shape, "--boundary", "airfoil", "-o", "new.su2", "-o", "new.vtkhdf")
        self.assertGreater(figures["preserved_percent"], 90)
        checked = self.figures("check", "new.su2")
        self.assertTrue(checked["valid"])
        self.assertEqual(list(read_su2(self.path("new.su2"))[2]), ["airfoil", "farfield"])
        self.assertGreaterEqual(checked["min_angle_deg"], self.figures("check", mesh)["min_angle_deg"])
        self.assertTrue(self.figures("check", "new.vtkhdf")["valid"])
        # The program's numbers are the shortest that are exact; the file's are compared as values.
        def values(path):
            points, triangles, _ = read_su2(path)
            return {frozenset(tuple(map(float, points[v])) for v in triangle) for triangle in triangles}

        self.succeed("convert", mesh, "-o", "copy.su2")
        self.assertEqual(len(values(self.path("copy.su2")) & values(self.path("new.su2"))), figures["preserved"])


class Runs(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed("mesh", "naca:0012", "--points", 60, "--min-angle", 25, "-o", "a.su2")

    def arguments(self, evaluations, directory, *more):
        return (
            "optimise", "--mesh", "a.su2", "--boundary", "airfoil", "--to", "rae2822", "--sigma", 0.01,
            "--evaluations", evaluations, "-o", directory, "--quiet", *more,
        )

    def designs(self, directory):
        with sqlite3.connect(f"file:{self.path(directory)}/history.sqlite?mode=ro", uri=True) as connection:
            return connection.execute("select evaluation, coefficients, triangles, preserved from evaluations").fetchall()

    def test_a_mesh_is_fitted_and_goes_on(self):
        figures = self.figures(*self.arguments(120, "run", "--compare-every", 30))
        self.assertLess(figures["fit"]["max_error"], 1e-3)
        self.assertGreater(figures["start"]["preserved_percent"], 80)
        self.assertEqual(figures["evaluations"], 120)
        self.assertEqual(figures["invalid_meshes"], 0)
        self.assertGreaterEqual(figures["min_angle_deg"], figures["import"]["min_angle_deg"] * (1 - TINY))
        self.assertEqual(figures["kept"]["triangles"] + figures["changed"]["triangles"],
                         self.figures("check", "run/last.vtkhdf")["triangles"])
        for mesh in ("first", "middle", "last"):
            self.assertTrue(self.figures("check", f"run/{mesh}.vtkhdf")["valid"])

    def test_resuming_gives_the_run_that_was_not_interrupted(self):
        self.succeed(*self.arguments(80, "whole"))
        self.succeed(*self.arguments(30, "parts"))
        self.succeed(*self.arguments(80, "parts", "--resume"))
        self.assertEqual(self.designs("parts"), self.designs("whole"))
        self.assertEqual(self.path("parts/last.vtkhdf").read_bytes(), self.path("whole/last.vtkhdf").read_bytes())
        self.succeed("mesh", "naca:0012", "--points", 60, "--min-angle", 26, "-o", "a.su2")
        self.refused(*self.arguments(90, "parts", "--resume"), names="start_mesh")

    def test_a_native_mesh_starts_too(self):
        self.succeed("mesh", "naca:0012", "--points", 60, "-o", "n.vtkhdf")
        figures = self.figures("optimise", "--mesh", "n.vtkhdf", "--to", "rae2822", "--evaluations", 20, "-o", "run")
        self.assertEqual(figures["fit"]["max_error"], 0)
        self.assertEqual(figures["start"]["preserved_percent"], 100)

    def test_options_that_do_not_go_together(self):
        self.refused(*self.arguments(10, "run", "--from", "naca:0012"), names="--mesh: given with --from")
        self.refused(*self.arguments(10, "run", "--min-angle", 30), names="--min-angle: given with --mesh")
        self.refused("optimise", "--to", "rae2822", "-o", "run", names="--from: not given")
        self.refused("optimise", "--from", "naca:0012", "--boundary", "airfoil", "--to", "rae2822", "-o", "run",
                     names="--boundary: given without --mesh")
