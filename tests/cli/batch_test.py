"""`remodel batch`: designs that are all known before, and what becomes of the files of the batch before."""

import fcntl
import json
import os

import shapes
from harness import ProgramTest


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
        given = self.figures("batch", "a.vtkhdf", *self.SHAPES, "-o", "out", "--order", "given", "--overwrite")
        self.assertEqual([design["position"] for design in given["designs"]], [1, 2, 3, 4, 5, 6])
        self.assertLess(nearest["lost_mean"], given["lost_mean"])
        self.assertEqual([path.name for path in self.path("out").iterdir()], ["report.json"])

    def test_a_batch_is_replaced_only_where_asked_for(self):
        self.succeed("batch", "a.vtkhdf", *self.SHAPES[:3], "-o", "out", "--meshes", "su2")
        self.write("out/notes.txt", "of the user")
        before = self.path("out/report.json").read_bytes()
        again = ("batch", "a.vtkhdf", *self.SHAPES[:2], "-o", "out", "--meshes", "vtkhdf")
        self.assertIn("--overwrite", self.refused(*again, names="out"))
        self.assertEqual(self.path("out/report.json").read_bytes(), before)
        self.succeed(*again, "--overwrite")
        self.assertEqual(sorted(path.name for path in self.path("out").iterdir()),
                         ["001.vtkhdf", "002.vtkhdf", "notes.txt", "report.json"])

    def names_in(self, directory):
        return sorted(path.name for path in self.path(directory).iterdir())

    def test_overwriting_takes_what_a_batch_wrote_alone(self):
        batch = ("batch", "a.vtkhdf", "naca:0013", "naca:0014", "-o", "out", "--meshes")
        self.assertEqual(self.figures(*batch, "su2,vtkhdf")["files"],
                         ["001.su2", "001.vtkhdf", "002.su2", "002.vtkhdf"])
        self.write("out/2024.msh", "of the user")
        self.write("out/001.vtu", "of the user")
        outcome = self.succeed(*batch, "su2", "--overwrite")
        self.assertEqual(self.names_in("out"), ["001.su2", "001.vtu", "002.su2", "2024.msh", "report.json"])
        self.assertEqual(self.path("out/2024.msh").read_text(), "of the user")
        for name in ("001.vtu", "2024.msh"):
            self.assertIn(f"out/{name}: left as it is", outcome.stderr)
        # What it would write over is not its own.
        self.refused(*batch, "vtu", "--overwrite", names="holds 001.vtu")
        self.assertEqual(self.path("out/001.vtu").read_text(), "of the user")
        # As a batch that was killed leaves it, and as older programs wrote it.
        for record in ({"designs": [], "files": ["001.su2", "002.su2", "../a.vtkhdf"], "finished": False},
                       {"designs": [{"meshes": ["001.su2"]}, {"meshes": ["002.su2"]}]}):
            self.write("out/report.json", json.dumps(record))
            self.succeed(*batch, "su2", "--overwrite")
            self.assertTrue(self.path("a.vtkhdf").exists())
        for report in ("{}", "of the user"):
            self.write("out/report.json", report)
            self.refused(*batch, "su2", "--overwrite", names="report.json")

    def test_a_batch_does_not_write_into_a_run(self):
        self.succeed("optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 50, "--evaluations", 5, "-o", "run")
        before = sorted(path.name for path in self.path("run").iterdir())
        for more in ((), ("--overwrite",)):
            self.refused("batch", "a.vtkhdf", "rae2822", "-o", "run", *more, names="of a run")
        self.assertEqual(sorted(path.name for path in self.path("run").iterdir()), before)

    def test_fits_of_files_are_reported(self):
        self.write("open.dat", shapes.selig())
        figures = self.figures("batch", "a.vtkhdf", "rae2822", "open.dat", "-o", "out")
        self.assertEqual([fit["shape"] for fit in figures["fits"]], ["open.dat"])

    def test_meshes_in_several_formats(self):
        figures = self.figures("batch", "a.vtkhdf", *self.SHAPES[:2], "-o", "out", "--meshes", "su2,vtkhdf")
        self.assertEqual([design["meshes"] for design in figures["designs"]],
                         [["001.su2", "001.vtkhdf"], ["002.su2", "002.vtkhdf"]])
        for design in figures["designs"]:
            for mesh in design["meshes"]:
                self.assertEqual(self.figures("check", f"out/{mesh}")["triangles"], design["triangles"])
        self.refused("batch", "a.vtkhdf", "rae2822", "-o", "new", "--meshes", "su2,stl", names="--meshes")

    def test_a_directory_that_another_process_writes_to(self):
        self.path("out").mkdir()
        directory = os.open(self.path("out"), os.O_RDONLY)
        try:
            fcntl.flock(directory, fcntl.LOCK_EX)
            self.refused("batch", "a.vtkhdf", "rae2822", "-o", "out", names="in use")
        finally:
            os.close(directory)

    def test_a_mesh_of_another_program(self):
        self.succeed("convert", "a.vtkhdf", "-o", "a.su2")
        figures = self.figures("batch", "a.su2", "naca:2412", "naca:0013", "--boundary", "airfoil", "-o", "out")
        self.assertEqual([design["position"] for design in figures["designs"]], [2, 1])
        self.assertEqual(figures["invalid_meshes"], 0)
