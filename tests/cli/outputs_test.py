"""Results of successful commands: the keys of the contract, and small versions of the acceptance commands."""

import fcntl
import json
import math
import os
import pty
import re
import shutil
import signal
import struct
import subprocess
import termios
import time

import harness
import shapes
from harness import ProgramTest, shared_file

MESH_KEYS = (
    "triangles vertices boundary steiner_boundary_vertices min_angle_deg max_radius_edge max_gradation seconds stopped"
)
UPDATE_KEYS = (
    "triangles_before triangles preserved preserved_percent moved inserted removed full_adjustment method seconds strategy reason "
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


VTU_WITH_FIELDS = """<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="2">
<PointData>
<DataArray type="Float64" Name="mach" format="ascii">0.5 0.75 1 1.25</DataArray>
<DataArray type="Float32" Name="holes" format="ascii">0.5 nan 1 1.25</DataArray>
<DataArray type="Int32" Name="rank" format="ascii">0 0 0 0</DataArray>
</PointData>
<CellData><DataArray type="Float64" Name="shock" NumberOfComponents="2" format="ascii">1 2 3 4</DataArray></CellData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 1 0 0 1 0</DataArray></Points>
<Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 0 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3 6</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5 5</DataArray>
</Cells></Piece></UnstructuredGrid></VTKFile>
"""


class Fields(ProgramTest):
    def test_are_carried_from_format_to_format_and_named(self):
        self.write("a.vtu", VTU_WITH_FIELDS)
        figures = self.figures("convert", "a.vtu", "-o", "b.vtkhdf", "-o", "b.msh", "-o", "b.su2")
        self.assertEqual(figures["fields"], ["mach", "shock"])
        self.assertEqual(figures["fields_left_out"], ["holes"])
        for name in ("b.vtkhdf", "b.msh"):
            figures = self.figures("convert", name, "-o", "c.vtu")
            self.assertEqual(figures["fields"], ["mach", "shock"], name)
            self.assertNotIn("fields_left_out", figures)
            self.assertIn("0.5\n0.75\n1\n1.25\n", self.path("c.vtu").read_text())
        self.assertNotIn("fields", self.figures("convert", "b.su2", "-o", "c.vtu"))

    def test_are_drawn_by_name(self):
        self.write("a.vtu", VTU_WITH_FIELDS)
        for name, options in (("a.svg", ["--color", "mach", "--iso", 3]), ("b.svg", ["--field", "shock"]),
                              ("c.svg", ["--field", "mach", "--range", "0:1"]), ("d.svg", [])):  # fmt: skip
            figures = self.figures("draw", "a.vtu", "-o", name, *options)
            self.assertEqual(figures.get("field"), {"a.svg": "mach", "b.svg": "shock", "c.svg": "mach"}.get(name))
        self.assertEqual(len({self.path(f"{letter}.svg").read_bytes() for letter in "abcd"}), 4)
        self.succeed("draw", "a.vtu", "-o", "a.png", "--field", "mach", "--window=0.2,0.2,0.4,0.4")

    def test_that_are_not_there_or_cannot_be_drawn_are_refused(self):
        self.write("a.vtu", VTU_WITH_FIELDS)
        for options, names in (
            (["--field", "p"], "no field 'p' found, expected one of 'holes', 'mach', 'shock'"),
            (["--field", "holes"], "field 'holes': nan found at number 1 of the vertices, finite values expected"),
            (["--field", "mach", "--color", "cp"], "--field: found with --color, expected one of them"),
            (["--iso", "3"], "--iso: found without a field"),
            (["--range", "0:1"], "--range: found without a field"),
            (["--field", "mach", "--range", "1:0"], "--range: found '1:0', expected A < B"),
            (["--field", "mach", "--range", "1"], "--range: found '1', expected two numbers A:B"),
            (["--field", "shock", "--iso", "3"], "one on vertices expected"),
        ):
            with self.subTest(options):
                self.refused("draw", "a.vtu", "-o", "a.svg", *options, names=names)


class Flows(ProgramTest):
    def test_potential_flow_has_its_lift_fields_and_plot(self):
        figures = self.figures("flow", "naca:0012", "--model", "potential", "--alpha", 4, "--points", 100, "-o", "a.vtkhdf",
                               "-o", "a.vtu", "--cp-plot", "cp.svg")  # fmt: skip
        self.assertKeys(figures, "model triangles vertices cl cd cm cl_by_pressure alpha_deg mach converged bodies seconds")
        self.assertAlmostEqual(figures["cl"], 0.4826, delta=0.02 * 0.4826)
        self.assertEqual([body["name"] for body in figures["bodies"]], ["airfoil"])
        self.assertEqual(figures["written"], ["a.vtkhdf", "a.vtu", "cp.svg"])
        self.assertIn("</svg>", self.path("cp.svg").read_text())
        self.succeed("draw", "a.vtu", "-o", "cp.png", "--color", "cp", "--iso", 20)
        self.succeed("update", "a.vtkhdf", "rae2822", "-o", "b.vtkhdf")  # the mesh lives on
        again = self.figures("flow", "a.vtu", "--model", "potential", "--alpha", 4)
        self.assertEqual(again["cl"], figures["cl"])

    def test_potential_flow_finds_the_angle_of_a_lift_and_several_bodies(self):
        figures = self.figures("flow", "naca:2412", "naca:0012", "--place", "1,0,0,0", "--place", "0.3,-20,1.02,-0.03",
                               "--points", 60, "--model", "potential", "--cl", 1.5)  # fmt: skip
        self.assertAlmostEqual(figures["cl"], 1.5, delta=1e-9)
        self.assertEqual(len(figures["bodies"]), 2)

    def test_potential_flow_refuses_what_has_none(self):
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "a.su2")
        for arguments, names in (
            (["a.su2"], "--mach: not given"),
            (["a.su2", "--model", "potential", "--farfield", "rim"], "a.su2: 'farfield' found around the domain"),
            (["a.su2", "naca:0012", "--model", "potential"], "a.su2: holds a mesh, expected it alone"),
            (["a.su2", "--model", "potential", "--alpha", "91"], "--alpha"),
            (["a.su2", "--model", "potential", "--cl", "9"], "lift: 9.000000 found"),
            (["a.su2", "--model", "potential", "--mach", "1.2"], "mach: 1.200000 found"),
            (["a.su2", "--model", "potential", "--cp-plot", "cp.pdf"], "cp.pdf: found extension '.pdf'"),
        ):
            with self.subTest(arguments):
                self.refused("flow", *arguments, names=names)


class Interrupts(ProgramTest):
    def interrupted(self, *arguments):
        process = subprocess.Popen(
            [harness.PROGRAM, *map(str, arguments)], cwd=self.directory, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=60)
        return process.returncode, stderr.decode()

    def test_end_with_status_3(self):
        status, _ = self.interrupted("mesh", "rae2822", "--points", 3000, "--gradation", 60, "--repeat", 1000)
        self.assertEqual(status, 3)
        self.succeed("mesh", "rae2822", "--points", 700, "--gradation", 14, "-o", "a.vtkhdf")
        status, _ = self.interrupted("update", "a.vtkhdf", "naca:0012", "--repeat", 10000, "-o", "b.vtkhdf")
        self.assertEqual(status, 3)
        self.assertFalse(self.path("b.vtkhdf").exists())

    # The mesh that comes before a flow, and the samples that come before a run, take seconds here.
    def test_end_with_status_3_before_the_work_itself(self):
        flow = ("flow", "naca:0012", "--mach", 0.5, "--points", 12000, "--gradation", 240)
        status, stderr = self.interrupted(*flow)
        self.assertEqual((status, stderr), (3, "remodel: interrupted\n"))
        began = time.monotonic()
        run = ("optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 8000, "--gradation", 160, "-o", "run")
        status, stderr = self.interrupted(*run)
        self.assertEqual(status, 3, stderr)
        self.assertLess(time.monotonic() - began, 10)
        self.assertFalse(self.path("run").exists())

    # A terminal writes ^C: what comes next stands in a line of its own.
    def test_leave_a_clean_line_on_a_terminal(self):
        ours, terminal = pty.openpty()
        with subprocess.Popen([harness.PROGRAM, "soak", "--steps", "100000"], stdin=terminal, stdout=terminal,
                              stderr=terminal, start_new_session=True, cwd=self.directory,
                              preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0)) as process:
            os.close(terminal)
            time.sleep(0.5)
            os.write(ours, b"\x03")
            shown = harness.read_terminal(ours)
        self.assertEqual(process.returncode, 3, shown)
        self.assertIn(b"^C\r\x1b[K", shown)

    # Reading from a pipe that nobody writes to.
    def test_end_with_status_3_where_nothing_looks_for_them(self):
        os.mkfifo(self.path("pipe.su2"))
        status, stderr = self.interrupted("check", "pipe.su2")
        self.assertEqual(status, 3, stderr)
        self.assertEqual(stderr, "remodel: interrupted\n")


class Help(ProgramTest):
    def test_every_subcommand_names_units_and_defaults(self):
        for command in ("mesh", "update", "check", "fit", "optimise", "draw", "film", "convert", "shapes"):
            text = self.succeed(command, "--help").stdout
            self.assertIn("--json", text)
        text = self.succeed("mesh", "--help").stdout
        for words in ("DEGREES=30", "I=200", "G=I/50", "CHORDS=25", "degrees", "chords"):
            self.assertIn(words, text)
        self.assertIn("Exit status", self.succeed("--help").stdout)

    def test_help_fits_the_screen(self):
        overview = self.succeed("--help").stdout
        for command in ("", "mesh", "update", "batch", "check", "fit", "optimise", "draw", "film", "convert", "shapes"):
            text = self.succeed("help", *command.split()).stdout
            self.assertEqual(text, self.succeed(*command.split(), "--help").stdout)
            self.assertLessEqual(max(map(len, text.splitlines())), 100, text)
            self.assertEqual("Exit status" in text, text == overview)

    def test_help_fits_a_narrow_terminal(self):
        for command in ("mesh", "update", "film", "optimise"):
            ours, terminal = pty.openpty()
            fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 60, 0, 0))
            with subprocess.Popen([harness.PROGRAM, command, "--help"], stdout=terminal) as process:
                os.close(terminal)
                shown = harness.read_terminal(ours)
            self.assertEqual(process.returncode, 0)
            self.assertLessEqual(max(map(len, shown.decode().split("\r\n"))), 60, shown)

    def test_version(self):
        self.assertRegex(self.succeed("--version").stdout, r"^\d+\.\d+\.\d+\n$")


class Names(ProgramTest):
    def test_airfoils_have_the_markers_they_are_given(self):
        pair = ("mesh", "naca:0012", "naca:2412", "--place", "1,0,0,0", "--place", "0.5,-10,1.2,-0.1", "--points", 60)
        self.succeed(*pair, "--name", "wing", "--name", "flap", "-o", "two.su2")
        self.assertEqual(set(self.figures("check", "two.su2")["boundary"]), {"wing", "flap", "farfield"})
        self.succeed(*pair, "--name", "wing", "-o", "two.su2")
        self.assertEqual(set(self.figures("check", "two.su2")["boundary"]), {"wing", "naca2412", "farfield"})
        self.succeed("mesh", "naca:0012", "--points", 60, "--name", "blade", "-o", "one.vtkhdf")
        self.assertEqual(set(self.figures("check", "one.vtkhdf")["boundary"]), {"blade", "farfield"})
        self.succeed("update", "one.vtkhdf", "naca:0013", "-o", "one.su2")
        self.assertEqual(set(self.figures("check", "one.su2")["boundary"]), {"blade", "farfield"})
        for names in (("wing", "wing"), ("farfield",), ("a", "b", "c")):
            self.refused(*pair, "-o", "x.su2", *(word for name in names for word in ("--name", name)), names="--name")


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

    # A thousand times the points do not fit into the mesh's budget of vertices.
    def test_losses_are_said_on_standard_error(self):
        self.figures("mesh", "rae2822", "--points", 50, "--gradation", 1, "--max-vertices", 2000, "-o", "a.vtkhdf")
        outcome = self.run_program("update", "a.vtkhdf", "rae2822", "--points", 2000, "-o", "b.vtkhdf", "--json")
        self.assertEqual(outcome.status, 3, outcome)
        self.assertTrue(outcome.json()["regenerated"])
        self.assertIn("remodel: a.vtkhdf: generated afresh", outcome.stderr)
        self.assertTrue(self.path("b.vtkhdf").exists())

    def test_a_mesh_that_would_have_to_be_generated_afresh_is_refused_if_asked_for(self):
        self.figures("mesh", "rae2822", "--points", 50, "--gradation", 1, "--max-vertices", 2000, "-o", "a.vtkhdf")
        outcome = self.run_program(
            "update", "a.vtkhdf", "rae2822", "--points", 2000, "--no-regenerate", "-o", "b.vtkhdf", "--json"
        )
        self.assertEqual(outcome.status, 1, outcome)
        figures = outcome.json()
        self.assertTrue(figures["abandoned"])
        self.assertEqual(figures["triangles"], figures["triangles_before"])
        self.assertIn("refinement stopped: vertex-budget", outcome.stderr)
        self.assertFalse(self.path("b.vtkhdf").exists())

    def test_more_than_half_lost_is_said_on_standard_error(self):
        self.succeed("mesh", "rae2822", "--points", 400, "--gradation", 4, "-o", "a.vtkhdf")
        outcome = self.succeed("update", "a.vtkhdf", "rae2822", "--points", 60, "-o", "b.vtkhdf")
        self.assertIn("triangles were not preserved", outcome.stderr)
        outcome = self.succeed("update", "b.vtkhdf", "naca:0012", "-o", "c.vtkhdf")
        self.assertEqual(outcome.stderr, "")

    # Every vertex of a morph may move, and all its triangles stay joined: that is said too.
    def test_a_morph_says_how_many_triangles_have_moved(self):
        self.succeed("mesh", "naca:0012", "--points", 50, "--farfield-radius", 2, "-o", "a.vtkhdf")
        outcome = self.succeed("update", "a.vtkhdf", "naca:4424", "--strategy", "morph", "-o", "b.vtkhdf", "--json")
        self.assertLess(outcome.json()["preserved_percent"], 50)
        self.assertRegex(outcome.stderr, r"\d+ of \d+ triangles were not preserved, as their vertices moved; \d+ of")

    # Long diagonals of thin cells: Delaunay triangles take the places of nearly all, before the step.
    def test_a_mesh_that_is_not_delaunay_loses_triangles_in_its_import(self):
        rows, columns = 12, 12
        points = [(i + 0.6 * j, 0.3 * j) for j in range(rows + 1) for i in range(columns + 1)]
        at = lambda i, j: j * (columns + 1) + i
        cells = [(i, j) for j in range(rows) for i in range(columns) if not (4 <= i < 7 and 4 <= j < 7)]
        triangles = [t for i, j in cells for t in ((at(i, j), at(i + 1, j), at(i + 1, j + 1)),
                                                   (at(i, j), at(i + 1, j + 1), at(i, j + 1)))]
        edges = {}
        for t in triangles:
            for a, b in zip(t, t[1:] + t[:1]):
                edges[tuple(sorted((a, b)))] = None if tuple(sorted((a, b))) in edges else (a, b)
        boundary = [e for e in edges.values() if e]
        inner = lambda v: 4 <= v % (columns + 1) <= 7 and 4 <= v // (columns + 1) <= 7
        markers = {"hole": [e for e in boundary if inner(e[0]) and inner(e[1])]}
        markers["outer"] = [e for e in boundary if e not in markers["hole"]]
        text = f"NDIME= 2\nNELEM= {len(triangles)}\n" + "".join(f"5 {a} {b} {c}\n" for a, b, c in triangles)
        text += f"NPOIN= {len(points)}\n" + "".join(f"{x} {y}\n" for x, y in points) + f"NMARK= {len(markers)}\n"
        for name, found in markers.items():
            text += f"MARKER_TAG= {name}\nMARKER_ELEMS= {len(found)}\n" + "".join(f"3 {a} {b}\n" for a, b in found)
        self.write("sheared.su2", text)
        for output in ("b.su2", "sheared.su2"):  # in the file's own place too
            outcome = self.run_program("update", "sheared.su2", "naca:0012", "--boundary", "hole", "-o", output, "--json")
            self.assertEqual(outcome.status, 0, outcome)
            self.assertGreater(outcome.json()["import"]["non_delaunay_edges"], 0)
            self.assertRegex(outcome.stderr, r"sheared.su2: \d+ of \d+ triangles of the file are not in the new mesh")

    def test_the_specialised_method_is_never_replaced_by_another(self):
        self.mesh(points=50)
        update = ("update", "a.vtkhdf", "rae2822", "--points", 60, "-o", "b.vtkhdf")
        self.refused(*update, "--method", "specialised", names="specialised needs two domains that correspond one to one")
        self.assertEqual(self.figures(*update)["method"], "general")

    # `renew` keeps triangles up to `keep` times H: what `check` measures and tests is what the mesh promises.
    def test_check_measures_what_the_mesh_promises(self):
        self.succeed("mesh", "naca:0012", "--points", 100, "--gradation", 1, "-o", "a.vtkhdf")
        largest = 0.0
        for shape in ("rae2822", "naca:2412", "naca:4412", "rae2822", "naca:0012"):
            updated = self.figures("update", "a.vtkhdf", shape, "-o", "a.vtkhdf")
            self.assertGreater(updated["keep"], 1)
            checked = self.figures("check", "a.vtkhdf")
            self.assertTrue(checked["valid"])
            self.assertAlmostEqual(checked["max_gradation"], updated["max_gradation"], delta=TINY)
            self.assertLessEqual(checked["max_gradation"], 1 + TINY)
            largest = max(largest, checked["max_gradation"])
        self.assertGreater(largest * updated["keep"], 1)  # some triangle is beyond H alone
        self.assertIn("keep H", self.succeed("check", "a.vtkhdf").stdout)

    def test_no_line_of_the_report_is_there_twice(self):
        self.mesh(points=50)
        self.succeed("convert", "a.vtkhdf", "-o", "a.su2")
        for arguments in (("a.vtkhdf", "rae2822"), ("a.su2", "rae2822", "--boundary", "airfoil")):
            lines = self.succeed("update", *arguments, "-o", "b.vtkhdf").stdout.splitlines()
            labels = [re.split("  +", line)[0] for line in lines]
            self.assertEqual(sorted(set(labels)), sorted(labels))

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

    def test_picture_of_fates(self):
        self.succeed("mesh", "naca:0012", "--points", 100, "-o", "a.vtkhdf")
        self.succeed("update", "a.vtkhdf", "rae2822", "-o", "b.vtkhdf")
        self.succeed("draw", "b.vtkhdf", "-o", "b.svg", "--color", "fate", "--since", "a.vtkhdf")
        self.succeed("draw", "a.vtkhdf", "-o", "a.svg", "--color", "fate", "--since", "a.vtkhdf")
        glowing = b"rgb(87.0"  # what is new
        self.assertGreater(self.path("b.svg").read_bytes().count(glowing), self.path("a.svg").read_bytes().count(glowing))


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
        # A pin: a round head on a wire, around which polynomials of every degree swing.
        stations = [0.5 * (1.0 - math.cos(math.pi * i / 80)) for i in range(81)]
        surface = [(x, 2e-6 * math.sqrt(x) * (1.0 - x) + 0.03 * math.sqrt(x / 0.15) * max(0.0, 1.0 - x / 0.15) ** 2)
                   for x in stations]
        points = surface[::-1] + [(x, -y) for x, y in surface[1:]]
        self.write("pin.dat", "pin\n" + "".join(f"{x:.8f} {y:.8f}\n" for x, y in points))
        figures = self.figures("fit", "pin.dat", status=1)
        self.assertFalse(figures["surfaces_apart"])

    def test_catalogue(self):
        entries = self.figures("shapes")["shapes"]
        self.assertEqual(len(entries), 10)
        for entry in entries:
            figures = self.figures("fit", entry["name"])
            self.assertEqual(figures["degree"], entry["degree"])
            self.assertEqual(figures["max_error"], entry["max_error"])
