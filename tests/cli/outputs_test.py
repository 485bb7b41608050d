"""What the program answers when all is well: the keys of its contract, and the acceptance commands in small."""

import json
import math
import shutil
import subprocess

import shapes
from harness import SOURCE, ProgramTest, shared_file

MESH_KEYS = (
    "triangles vertices boundary steiner_boundary_vertices min_angle_deg max_radius_edge max_gradation seconds stopped"
)
UPDATE_KEYS = (
    "triangles_before triangles preserved preserved_percent moved inserted removed full_adjustment method seconds "
    "min_angle_deg max_gradation"
)
CHECK_KEYS = "valid violations triangles vertices min_angle_deg delaunay boundary area"
FIT_KEYS = "degree upper lower max_error rms_error thickness camber"
FORMATS = ("vtkhdf", "su2", "msh", "vtu")
TINY = 1e-9  # the relative tolerance that the validator has too


class Meshes(ProgramTest):
    def check_quality(self, figures):
        self.assertEqual(figures["stopped"], "done")
        self.assertGreaterEqual(figures["min_angle_deg"], 30 * (1 - TINY))
        self.assertLessEqual(figures["max_gradation"], 1 + TINY)
        self.assertLessEqual(figures["max_radius_edge"], 1 + TINY)

    def test_keys_and_quality(self):
        figures = self.figures("mesh", "naca:0012", "--points", 50)
        self.assertKeys(figures, MESH_KEYS)
        self.check_quality(figures)
        self.assertGreaterEqual(figures["boundary"]["airfoil"], 50)
        self.assertEqual(figures["boundary"]["farfield"], 50)
        self.assertEqual(figures["options"]["gradation"], 1.0)

    def test_triangle_counts(self):
        self.assertTrue(900 <= self.figures("mesh", "rae2822", "--points", 50)["triangles"] <= 1600)
        self.assertTrue(1600 <= self.figures("mesh", "rae2822", "--points", 100)["triangles"] <= 2400)
        self.assertAlmostEqual(self.figures("mesh", "rae2822")["triangles"], 4656, delta=0.05 * 4656)

    def test_every_catalogue_airfoil(self):
        for entry in self.figures("shapes")["shapes"]:
            with self.subTest(entry["name"]):
                self.check_quality(self.figures("mesh", entry["name"]))

    def test_coordinate_files(self):
        for name, text in (("selig.dat", shapes.selig()), ("lednicer.dat", shapes.lednicer())):
            for ending in ("\n", "\r\n"):
                with self.subTest(f"{name} {ending!r}"):
                    self.write(name, text.replace("\n", ending))
                    self.check_quality(self.figures("mesh", name, "--points", 50))

    def test_shared_airfoil_files(self):
        directory = shared_file(self, "airfoils")
        for file in sorted(directory.glob("*.dat")):
            with self.subTest(file.name):
                self.check_quality(self.figures("mesh", file))

    def test_outputs_are_the_same_every_time(self):
        for name in ("a", "b"):
            self.path(name).mkdir()
            self.succeed("mesh", "rae2822", *[word for f in FORMATS for word in ("-o", f"{name}/m.{f}")])
        for format in FORMATS:
            self.assertEqual(
                self.path(f"a/m.{format}").read_bytes(), self.path(f"b/m.{format}").read_bytes(), format
            )

    def test_vertex_budget_ends_with_status_3_and_keeps_the_mesh(self):
        figures = self.figures("mesh", "rae2822", "--max-vertices", 600, "-o", "a.vtkhdf", status=3)
        self.assertEqual(figures["stopped"], "vertex-budget")
        self.assertTrue(self.path("a.vtkhdf").exists())

    def test_repeat_changes_nothing_but_the_time(self):
        once = self.figures("mesh", "rae2822", "--points", 50)
        thrice = self.figures("mesh", "rae2822", "--points", 50, "--repeat", 3)
        for figures in (once, thrice):
            self.assertGreater(figures.pop("seconds"), 0)
        self.assertEqual(once, thrice)

    def test_readable_report(self):
        outcome = self.succeed("mesh", "rae2822", "--points", 50, "-o", "a.su2")
        self.assertEqual(outcome.stderr, "")
        for words in ("triangles", "degrees", "seconds", "a.su2", "50 points"):
            self.assertIn(words, outcome.stdout)

    def test_gmsh_reads_what_we_write(self):
        if shutil.which("gmsh") is None:
            self.skipTest("needs gmsh")
        for version in ("4.1", "2.2"):
            figures = self.figures("mesh", "rae2822", "--points", 50, "--msh-version", version, "-o", "a.msh")
            process = subprocess.run(
                ["gmsh", "-0", str(self.path("a.msh")), "-o", str(self.path("b.msh")), "-format", "msh22", "-save_all"],
                capture_output=True, text=True, check=False,
            )
            self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
            self.assertNotIn("Error", process.stdout + process.stderr)
            self.assertIn(f"{figures['vertices']} nodes", process.stdout)


class Help(ProgramTest):
    def test_every_subcommand_names_units_and_defaults(self):
        for command in ("mesh", "update", "check", "fit", "optimise", "draw", "convert", "shapes"):
            text = self.succeed(command, "--help").stdout
            self.assertIn("--json", text)
        text = self.succeed("mesh", "--help").stdout
        for words in ("DEGREES=30", "I=200", "G=I/50", "CHORDS=25", "degrees", "chords"):
            self.assertIn(words, text)
        self.assertIn("Exit status", self.succeed("--help").stdout)

    def test_version(self):
        self.assertRegex(self.succeed("--version").stdout, r"^\d+\.\d+\.\d+\n$")


class Batches(ProgramTest):
    SHAPES = ("rae2822", "naca:0014", "naca:2412", "naca:0013", "naca:0012", "naca:4412")

    def setUp(self):
        super().setUp()
        self.succeed("mesh", "naca:0012", "--points", 100, "-o", "a.vtkhdf")

    def test_meshes_and_report(self):
        figures = self.figures("batch", "a.vtkhdf", *self.SHAPES, "-o", "out", "--meshes", "vtkhdf")
        self.assertEqual(figures, json.loads(self.path("out/report.json").read_text()))
        designs = figures["designs"]
        self.assertEqual([design["shape"] for design in designs], list(self.SHAPES))
        # From NACA 0012 to itself, and then in small steps.
        in_order = sorted(designs, key=lambda design: design["position"])
        reached = [design["shape"] for design in in_order]
        self.assertEqual(reached, ["naca:0012", "naca:0013", "naca:0014", "naca:2412", "naca:4412", "rae2822"])
        self.assertEqual(figures["lost_mean"], sum(design["lost"] for design in designs) / 6)
        for design in designs:
            checked = self.figures("check", f"out/{design['mesh']}")
            self.assertTrue(checked["valid"])
            self.assertEqual(checked["triangles"], design["triangles"])
        for before, after in zip(in_order, in_order[1:]):
            self.assertEqual(after["triangles_before"], before["triangles"])

    def test_the_given_order_loses_more(self):
        nearest = self.figures("batch", "a.vtkhdf", *self.SHAPES, "-o", "out")
        given = self.figures("batch", "a.vtkhdf", *self.SHAPES, "-o", "out", "--order", "given")
        self.assertEqual([design["position"] for design in given["designs"]], [1, 2, 3, 4, 5, 6])
        self.assertLess(nearest["lost_mean"], given["lost_mean"])
        self.assertEqual([path.name for path in self.path("out").iterdir()], ["report.json"])

    def test_a_mesh_of_another_program(self):
        self.succeed("convert", "a.vtkhdf", "-o", "a.su2")
        figures = self.figures("batch", "a.su2", "naca:2412", "naca:0013", "--boundary", "airfoil", "-o", "out")
        self.assertEqual([design["position"] for design in figures["designs"]], [2, 1])
        self.assertEqual(figures["invalid_meshes"], 0)


class Updates(ProgramTest):
    def mesh(self, shape="naca:0012", points=200):
        self.succeed("mesh", shape, "--points", points, "-o", "a.vtkhdf")

    def scaled(self, factor):
        figures = self.figures("fit", "naca:0012", "-o", "a.json")
        design = json.loads(self.path("a.json").read_text())
        self.assertEqual(design["upper"], figures["upper"])
        for surface in ("upper", "lower"):
            design[surface] = [factor * value for value in design[surface]]
        self.write("scaled.json", json.dumps(design))
        return "scaled.json"

    def check_valid(self, name):
        self.assertEqual(self.figures("check", name)["violations"], [])

    def test_slightly_changed_design_is_a_full_adjustment(self):
        self.mesh()
        before = self.figures("check", "a.vtkhdf")
        figures = self.figures("update", "a.vtkhdf", self.scaled(1.001), "-o", "b.vtkhdf")
        self.assertKeys(figures, UPDATE_KEYS)
        self.assertTrue(figures["full_adjustment"])
        self.assertEqual(figures["inserted"], 0)
        self.assertEqual(figures["removed"], 0)
        self.assertEqual(figures["triangles"], before["triangles"])
        self.assertEqual(figures["method"], "specialised")
        self.assertGreater(figures["preserved_percent"], 88)
        self.assertGreaterEqual(figures["min_angle_deg"], 30 * (1 - TINY))
        self.check_valid("b.vtkhdf")

    def test_same_design_changes_nothing(self):
        self.mesh("rae2822", 100)
        figures = self.figures("update", "a.vtkhdf", "rae2822", "-o", "b.vtkhdf")
        self.assertEqual(figures["preserved"], figures["triangles_before"])
        self.assertEqual(figures["moved"], 0)
        self.assertEqual(figures["preserved_percent"], 100)

    def test_one_step_to_another_airfoil_by_both_methods(self):
        self.mesh()
        for method in ("specialised", "general"):
            with self.subTest(method):
                name = f"{method}.vtkhdf"
                figures = self.figures("update", "a.vtkhdf", "rae2822", "--method", method, "-o", name)
                self.assertEqual(figures["method"], method)
                self.assertGreaterEqual(figures["min_angle_deg"], 30 * (1 - TINY))
                self.assertLessEqual(figures["max_gradation"], 1 + TINY)
                self.assertFalse(figures["regenerated"])
                self.check_valid(name)

    def test_there_and_back_again(self):
        self.mesh(points=100)
        self.succeed("update", "a.vtkhdf", "e376", "-o", "b.vtkhdf")
        self.succeed("update", "b.vtkhdf", "naca:0012", "-o", "c.vtkhdf")
        for name in ("b.vtkhdf", "c.vtkhdf"):
            self.check_valid(name)

    def test_through_a_file_gives_the_same_bytes(self):
        """A copy of a native mesh goes on to the same mesh as the original."""
        self.mesh(points=100)
        self.succeed("convert", "a.vtkhdf", "-o", "copy.vtkhdf")
        self.assertEqual(self.path("a.vtkhdf").read_bytes(), self.path("copy.vtkhdf").read_bytes())
        self.succeed("update", "a.vtkhdf", "rae2822", "-o", "b.vtkhdf", "--repeat", 2)
        self.succeed("update", "copy.vtkhdf", "rae2822", "-o", "c.vtkhdf")
        self.assertEqual(self.path("b.vtkhdf").read_bytes(), self.path("c.vtkhdf").read_bytes())

    def test_open_trailing_edge(self):
        self.mesh(points=100)
        design = json.loads(self.path(self.scaled(1.0)).read_text())
        design.update(te_upper=0.002, te_lower=-0.002)
        self.write("open.json", json.dumps(design))
        self.succeed("update", "a.vtkhdf", "open.json", "-o", "b.vtkhdf")
        self.check_valid("b.vtkhdf")
        self.succeed("update", "b.vtkhdf", "rae2822", "-o", "c.vtkhdf")
        self.check_valid("c.vtkhdf")

    def test_every_pair_of_the_catalogue(self):
        names = [entry["name"] for entry in self.figures("shapes")["shapes"]]
        for a in names:
            self.succeed("mesh", a, "-o", f"{a}.vtkhdf")
        for a in names:
            for b in names:
                if a != b:
                    with self.subTest(f"{a} to {b}"):
                        figures = self.figures("update", f"{a}.vtkhdf", b, "-o", "b.vtkhdf")
                        self.assertGreaterEqual(figures["min_angle_deg"], 30 * (1 - TINY))
                        self.check_valid("b.vtkhdf")


class Checks(ProgramTest):
    def setUp(self):
        super().setUp()
        outputs = [word for format in FORMATS for word in ("-o", f"a.{format}")]
        self.mesh = self.figures("mesh", "rae2822", "--points", 50, *outputs)

    def test_every_format_is_valid_and_the_same(self):
        for format in FORMATS:
            with self.subTest(format):
                figures = self.figures("check", f"a.{format}", "--min-angle", 30)
                self.assertKeys(figures, CHECK_KEYS)
                self.assertTrue(figures["valid"])
                self.assertTrue(figures["delaunay"])
                self.assertEqual(figures["violations"], [])
                for key in ("triangles", "vertices", "boundary"):
                    self.assertEqual(figures[key], self.mesh[key])
                self.assertAlmostEqual(figures["min_angle_deg"], self.mesh["min_angle_deg"], places=6)
                self.assertTrue(0.99 * math.pi * 625 < figures["area"] < math.pi * 625)

    def test_msh_2_2_is_valid(self):
        self.succeed("convert", "a.vtkhdf", "-o", "b.msh", "--msh-version", "2.2")
        self.assertEqual(self.figures("check", "b.msh")["boundary"], self.mesh["boundary"])

    def test_invalid_mesh_ends_with_status_1_and_names_the_rule(self):
        figures = self.figures("check", "a.su2", "--min-angle", 50, status=1)
        self.assertFalse(figures["valid"])
        for key in ("rule", "ids", "detail"):
            self.assertIn(key, figures["violations"][0])
        self.assertEqual(figures["violations"][0]["rule"], "angle")

    def test_inverted_triangle_is_found(self):
        lines = self.path("a.su2").read_text().splitlines()
        first = next(i for i, line in enumerate(lines) if line.startswith("NELEM")) + 1
        words = lines[first].split()
        words[1], words[2] = words[2], words[1]
        lines[first] = " ".join(words)
        self.write("b.su2", "\n".join(lines) + "\n")
        rules = {violation["rule"] for violation in self.figures("check", "b.su2", status=1)["violations"]}
        self.assertIn("orientation", rules)

    def test_conversions_keep_the_mesh(self):
        for source in FORMATS:
            for target in FORMATS:
                with self.subTest(f"{source} to {target}"):
                    self.succeed("convert", f"a.{source}", "-o", f"b.{target}")
                    figures = self.figures("check", f"b.{target}")
                    for key in ("triangles", "vertices", "boundary"):
                        self.assertEqual(figures[key], self.mesh[key])

    def test_mesh_of_another_program(self):
        foreign = shared_file(self, "meshes/mesh_NACA0012_inv.su2")
        figures = self.figures("check", foreign)
        self.assertEqual((figures["vertices"], figures["triangles"]), (5233, 10216))
        self.assertEqual(figures["boundary"], {"airfoil": 200, "farfield": 50})
        self.assertTrue(figures["delaunay"])
        self.assertAlmostEqual(figures["min_angle_deg"], 20.03, delta=0.01)

    def test_pictures(self):
        for arguments in (
            ("a.vtkhdf", "-o", "a.svg"),
            ("a.vtkhdf", "-o", "a.png", "--window=-0.1,-0.2,1.1,0.2", "--color", "length-scale"),
            ("a.vtkhdf", "-o", "b.png", "--window", "-0.1,-0.2,1.1,0.2", "--color", "age", "--width", 400),
            ("a.su2", "-o", "c.png"),
        ):
            self.succeed("draw", *arguments)
        self.assertIn(b"<svg", self.path("a.svg").read_bytes()[:400])
        for name in ("a.png", "b.png", "c.png"):
            self.assertTrue(self.path(name).read_bytes().startswith(b"\x89PNG"))
        self.refused("draw", "a.su2", "-o", "d.png", "--color", "age", names="")


class Fits(ProgramTest):
    def test_keys(self):
        figures = self.figures("fit", "naca:2412", "-o", "a.json")
        self.assertKeys(figures, FIT_KEYS)
        self.assertEqual(figures["degree"], 5)
        self.assertEqual(len(figures["upper"]), 6)
        self.assertAlmostEqual(figures["thickness"]["value"], 0.12, delta=0.002)
        self.assertAlmostEqual(figures["thickness"]["at"], 0.3, delta=0.03)
        self.assertAlmostEqual(figures["camber"]["value"], 0.02, delta=0.001)
        self.assertLess(figures["max_error"], 1e-3)
        self.assertLessEqual(figures["rms_error"], figures["max_error"])

    def test_written_coefficients_are_a_shape(self):
        fitted = self.figures("fit", "naca:23012", "--cst-degree", 8, "-o", "a.json")
        again = self.figures("fit", "a.json")
        for key in ("degree", "upper", "lower"):
            self.assertEqual(fitted[key], again[key])
        direct = self.figures("mesh", "naca:23012", "--cst-degree", 8, "--points", 50)
        through = self.figures("mesh", "a.json", "--points", 50)
        self.assertEqual(direct["triangles"], through["triangles"])

    def test_fit_that_crosses_itself_ends_with_status_1(self):
        file = shared_file(self, "airfoils/e376.dat")
        figures = self.figures("fit", file, "--cst-degree", 3, status=1)
        self.assertFalse(figures["surfaces_apart"])

    def test_catalogue(self):
        entries = self.figures("shapes")["shapes"]
        self.assertEqual(len(entries), 10)
        for entry in entries:
            figures = self.figures("fit", entry["name"])
            self.assertEqual(figures["degree"], entry["degree"])
            self.assertEqual(figures["max_error"], entry["max_error"])


class Example(ProgramTest):
    def test_readme_shows_the_compiled_example(self):
        example = (SOURCE / "examples" / "example.cpp").read_text()
        begin = example.index("int main()")
        self.assertIn(example[begin:].strip(), (SOURCE / "README.md").read_text())
