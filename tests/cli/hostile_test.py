"""Files and names that were made to do harm: each ends soon, in one short line, and nothing is read on that is out of its
range."""

import json
import os
import resource
import signal
import sqlite3
import subprocess
import time

import harness
from harness import ProgramTest

SQUARE = {
    "role": "outer",
    "curves": [{"name": "wall", "shape": {"kind": "polyline", "points": [[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]]}, "stations": 4}],
}
NUL_NAME = "a\0b\x1b[31m\n"


def fnv(text):
    result = 0xCBF29CE484222325
    for byte in text.encode():
        result = (result ^ byte) * 0x100000001B3 % 2**64
    return f"{result:016x}"


class Domains(ProgramTest):
    def refuse(self, loops, names, seconds=20):
        begin = time.monotonic()
        line = self.refused("mesh", self.write("domain.json", json.dumps({"loops": loops})), "-o", "a.su2", names=names)
        self.assertLess(time.monotonic() - begin, seconds)
        self.assertLess(len(line), 1200)
        return line

    def test_a_hundred_thousand_empty_loops_are_refused_in_linear_time(self):
        def seconds(count):
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            self.refuse([SQUARE] + [{"role": "hole", "curves": []}] * count, "domain.json: loop 1: found 0 points")
            return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before

        few, many = seconds(50_000), seconds(200_000)
        self.assertLess(many, 8 * few + 0.5)  # 16 times where it is quadratic

    def test_errors_of_domains_name_the_file_and_the_place(self):
        crossing = json.loads(json.dumps(SQUARE))
        crossing["curves"][0]["shape"]["points"] = [[0, 0], [1, 1], [1, 0], [0, 1], [0, 0]]
        self.refuse([crossing], 'domain.json: the sides that begin at loop 0, curve "wall", t = ')
        for command in (("flow", "domain.json", "--mach", 0.3), ("mesh", "domain.json", "-o", "b.vtkhdf")):
            self.refused(*command, names="domain.json: ")
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "mesh.vtkhdf")
        self.refused("update", "mesh.vtkhdf", "domain.json", "-o", "b.vtkhdf", names="domain.json: the sides")
        inner = json.loads(json.dumps(SQUARE))
        self.refuse([SQUARE, inner], "domain.json: ")
        ends = {"role": "outer", "curves": [
            {"name": "a", "shape": {"kind": "line", "from": [0, 0], "to": [1, 0]}, "stations": 2},
            {"name": "b", "shape": {"kind": "line", "from": [2, 0], "to": [0, 1]}, "stations": 2}]}  # fmt: skip
        self.refuse([ends], 'domain.json: loop 0, curve "a" ends at (1, 0), expected the beginning of the loop')
        named = {"role": "hole", "curves": [{"name": "a", "shape": {"kind": "airfoil", "shape": "nowhere"}, "stations": 40}]}
        self.refuse([SQUARE, named], 'domain.json: loops[1].curves[0].shape.shape: ')
        self.write("bad.poly", "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n3 0\n1 1 2\n2 2 3\n3 3 4\n0\n")
        self.refused("mesh", "bad.poly", "-o", "a.su2", names="bad.poly")

    def test_control_characters_of_names_are_escaped_and_long_names_shortened(self):
        curves = [{**SQUARE["curves"][0], "name": NUL_NAME}]
        crossing = [[0, 0], [1, 1], [1, 0], [0, 1], [0, 0]]
        curves[0]["shape"] = {"kind": "polyline", "points": crossing}
        line = self.refuse([{"role": "outer", "curves": curves}], "a\\x00b\\x1b[31m\\n")
        self.assertIn("touch or cross", line)
        curves[0]["name"] = "x" * 10_000_000
        line = self.refuse([{"role": "outer", "curves": curves}], "xxx...xxx")
        self.assertIn("touch or cross", line)
        curves[0]["name"] = "x y " * 2_500_000
        self.assertIn("touch or cross", self.refuse([{"role": "outer", "curves": curves}], "x y x y"))
        self.refuse([{**SQUARE, NUL_NAME: 1}], "\\u0000b")

    def test_tabs_are_shown_as_tabs(self):
        self.write("bad.poly", "4 2 0 0\n1 0 0\n2 x\ty 0\n")
        self.refused("mesh", "bad.poly", "-o", "a.su2", names="bad.poly:3")
        self.write("bad.dat", "NACA\n1.0 0.0\n0.5 0.1\tlower\tside\n0 0\n")
        self.refused("fit", "bad.dat", names="0.5 0.1\\tlower\\tside")

    def test_arguments_of_any_length_have_short_messages(self):
        for arguments in (("frob" * 30_000,), ("mesh", "x" * 100_000), ("mesh", "naca:" + "1" * 100_000),
                          ("mesh", "naca:0012", "--points", "9" * 100_000), ("check", "y/" * 40_000 + "a.su2"),
                          ("mesh", "naca:0012", "-o", "z" * 5000 + ".su2"), ("fit", "a\tb\x1b[2J.dat"),
                          ("optimise", "--from", "naca:0012", "--to", "rae2822", "-o", "r/" * 5000),
                          ("update", "u" * 5000 + ".vtkhdf", "naca:0012"), ("design", "d" * 5000, "-o", "run"),
                          ("film", "f" * 5000, "-o", "a.webp"), ("mesh", "naca:0012", "--" + "o" * 100_000)):  # fmt: skip
            with self.subTest(arguments[0][:20]):
                line = self.refused(*arguments, names="")
                self.assertLess(len(line), 1200)
                self.assertNotIn("filesystem error", line)
                self.assertNotIn("\x1b", line)


class Meshes(ProgramTest):
    """A hundred thousand names of each kind are read in linear time: minutes where each is compared with all others."""

    MANY = 100_000
    POINTS = "0 0 0\n1 0 1\n1 1 2\n0 1 3\n"

    def linear(self, name, content, many, *command):
        """The command on the file of content(count), of `many` and of a quarter of that: four times the time, not 16."""
        seconds = []
        for count in (many // 4, many):
            self.write(name, content(count))
            before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            outcome = self.run_program(*command)
            self.assertIn(outcome.status, (0, 1), outcome)
            seconds.append(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)
        self.assertLess(seconds[1], 8 * seconds[0] + 0.5)

    def test_markers_of_su2(self):
        def text(count):
            markers = "".join(f"MARKER_TAG= m{i}\nMARKER_ELEMS= 0\n" for i in range(count))
            return (
                f"NDIME= 2\nNELEM= 2\n5 0 1 2 0\n5 0 2 3 1\nNPOIN= 4\n{self.POINTS}NMARK= {count + 1}\n{markers}"
                "MARKER_TAG= wall\nMARKER_ELEMS= 4\n3 0 1\n3 1 2\n3 2 3\n3 3 0\n"
            )

        self.linear("a.su2", text, self.MANY, "check", "a.su2")
        for extension in ("su2", "msh", "vtu", "vtkhdf"):
            with self.subTest(extension):
                self.linear("a.su2", text, self.MANY, "convert", "a.su2", "-o", f"b.{extension}")
                self.assertIn(self.run_program("check", f"b.{extension}").status, (0, 1))

    def test_physical_names_and_fields_of_gmsh(self):
        field = '$NodeData\n1\n"f{}"\n1\n0\n3\n0\n1\n4\n1 1\n2 1\n3 1\n4 1\n$EndNodeData\n'

        def text(count):
            names = "".join(f'1 {i + 1} "m{i}"\n' for i in range(count))
            return (
                f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{count}\n{names}$EndPhysicalNames\n$Nodes\n4\n"
                "1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n6\n1 1 2 1 1 1 2\n2 1 2 2 1 2 3\n3 1 2 3 1 3 4\n"
                "4 1 2 4 1 4 1\n5 2 2 1 1 1 2 3\n6 2 2 1 1 1 3 4\n$EndElements\n" + "".join(map(field.format, range(count // 5)))
            )

        self.linear("a.msh", text, self.MANY, "check", "a.msh")
        self.linear("a.msh", text, self.MANY, "convert", "a.msh", "-o", "b.vtu")

    def test_arrays_of_vtk(self):
        array = '<DataArray type="Float64" Name="f{}" format="ascii">0 0 0 0</DataArray>\n'

        def text(count):
            return (
                '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>\n'
                '<Piece NumberOfPoints="4" NumberOfCells="2"><PointData>\n' + "".join(map(array.format, range(count))) +
                '</PointData><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 1 0 0 1 0'
                '</DataArray></Points><Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 0 2 3</DataArray>'
                '<DataArray type="Int64" Name="offsets" format="ascii">3 6</DataArray>'
                '<DataArray type="UInt8" Name="types" format="ascii">5 5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>'
            )

        self.linear("a.vtu", text, 20_000, "convert", "a.vtu", "-o", "b.vtu")


class Runs(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed(*self.arguments())

    def arguments(self, *more):
        return ("optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 50, "--evaluations", 20,
                "--checkpoint-every", 10, "--quiet", "-o", "run", *more)  # fmt: skip

    def forge(self, change):
        """The checkpoint with something else in it, sealed again."""
        content = json.loads(self.path("run/checkpoint.json").read_text())
        designer = json.loads(content["designer"])
        change(content, designer)
        content["designer"] = json.dumps(designer)
        del content["checksum"]
        dump = lambda: json.dumps(content, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
        content["checksum"] = fnv(dump())
        self.write("run/checkpoint.json", dump())

    def test_a_sealed_checkpoint_goes_on(self):
        self.forge(lambda content, designer: None)
        self.succeed(*self.arguments("--resume"))

    def test_forged_checkpoints_are_refused_by_what_is_out_of_range(self):
        good = self.path("run/checkpoint.json").read_bytes()

        def change(place, key, value):
            return lambda content, designer: place(content, designer).__setitem__(key, value)

        whole = lambda content, _: content
        designer = lambda _, designer: designer
        workers = lambda content, _: content["workers"]
        worker = lambda content, _: content["workers"]["each"][0]
        for place, key, value, found in (
            (whole, "refused", -1, "-1"), (whole, "refused", 1e300, "1e+300"), (whole, "refused", 0.5, "0.5"),
            (whole, "evaluation", -20, "-20"), (whole, "seconds", -5.0, "-5.0"), (whole, "seconds", 1e200, "1e+200"),
            (whole, "seconds", "5", '"5"'), (workers, "last", -1, "-1"), (worker, "full_adjustments", -3, "-3"),
            (worker, "evaluated", -3, "-3"), (worker, "row", -3, "-3"), (designer, "sigma", -1.0, "-1.0"),
            (designer, "sigma", 5e200, "5e+200"), (designer, "generation", -1, "-1"), (designer, "population", 1e300, "1e+300"),
        ):  # fmt: skip
            with self.subTest(f"{key} {value}"):
                self.write("run/checkpoint.json", good)
                self.forge(change(place, key, value))
                line = self.refused(*self.arguments("--resume"), names="run/checkpoint.json")
                self.assertIn(f"{key}: found {found}, expected a ", line)

    def test_rows_out_of_range_are_refused(self):
        good = self.path("run/history.sqlite").read_bytes()
        for change, names in (
            ("triangles = -1", "triangles: found -1"), ("preserved_percent = 5e20", "preserved_percent: found 5e+20"),
            ("worker = 0", "worker: found 0"), ("min_angle_deg = 5e20", "min_angle_deg: found 5e+20"),
            ("remodel_seconds = -1", "remodel_seconds: found -1"),
        ):  # fmt: skip
            with self.subTest(change):
                self.write("run/history.sqlite", good)
                connection = sqlite3.connect(self.path("run/history.sqlite"))
                connection.execute(f"update evaluations set {change} where evaluation = 7")
                connection.commit()
                connection.close()
                line = self.refused("film", "run", "-o", "a.webp", names="run/history.sqlite: evaluation 7: ")
                self.assertIn(names, line)


class Limits(ProgramTest):
    def limited(self, megabytes, *arguments):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))

        return self.run_program(*arguments, preexec_fn=limit)

    def test_pictures_and_films_without_memory_say_so(self):
        """Wherever memory ends: one sentence, and no film."""
        self.succeed("optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 50, "--evaluations", 5,
                     "--quiet", "-o", "run")  # fmt: skip
        commands = (("film", "run", "-o", "a.webp", "--frames", 3, "--width", 8000), ("draw", "run/last.vtkhdf", "-o", "a.png", "--width", 8000))
        if self.limited(8192, "shapes").status != 0:
            self.skipTest("needs a program that runs within limits of memory")  # the address sanitizer's does not
        ended = set()
        for command in commands:
            for megabytes in (120, 150, 200, 260, 330, 420, 520, 650):
                with self.subTest(f"{command[0]}, {megabytes} MB"):
                    outcome = self.limited(megabytes, *command)
                    if outcome.status in (126, 127):
                        continue  # the program could not be loaded
                    self.assertIn(outcome.status, (0, 2, 3), outcome)
                    ended.add(outcome.status)
                    if outcome.status != 0:
                        self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
                        self.assertIn("memory", outcome.stderr)
                        self.assertFalse(self.path(command[3]).exists())
                    else:
                        self.path(command[3]).unlink()
        self.assertIn(3, ended)

    def test_films_too_high_for_webp_are_refused(self):
        self.succeed("optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 50, "--evaluations", 5,
                     "--quiet", "-o", "run")  # fmt: skip
        self.refused("film", "run", "-o", "a.webp", "--width", 8000, "--window", "0,-1,1,1", names="at most 16383 expected")

    def test_an_interrupt_ends_a_large_mesh_at_once(self):
        """After so many seconds of processor time, far from the end of a mesh of ten million vertices. What is left to do
        takes a small part of what was done: it took twice as long."""
        for spent in (1.0, 3.0):
            with self.subTest(spent):
                process = subprocess.Popen(
                    [harness.PROGRAM, "mesh", "naca:0012", "--points", "20000", "--json"], cwd=self.directory,
                    stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                )  # fmt: skip
                self.addCleanup(process.kill)
                deadline = time.monotonic() + 200
                while self.processor_seconds(process.pid) < spent:
                    self.assertLess(time.monotonic(), deadline)
                    time.sleep(0.01)
                before = self.processor_seconds(process.pid)
                process.send_signal(signal.SIGINT)
                _, _, usage = os.wait4(process.pid, 0)
                out = process.stdout.read()
                for pipe in (process.stdout, process.stderr):
                    pipe.close()
                process.returncode = 0
                self.assertEqual(json.loads(out)["stopped"], "interrupted")
                self.assertLess(usage.ru_utime + usage.ru_stime - before, 0.5 * before)

    @staticmethod
    def processor_seconds(process):
        with open(f"/proc/{process}/stat") as file:
            fields = file.read().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def test_a_closed_terminal_ends_a_run_in_order(self):
        for name, signals, ends in (("hung", "", True), ("nohup", "trap '' HUP; ", False)):
            process = subprocess.Popen(
                ["sh", "-c", f"{signals}exec \"$@\"", "sh", harness.PROGRAM, "optimise", "--from", "naca:0012", "--to",
                 "rae2822", "--points", "50", "--evaluations", "1000000", "--quiet", "-o", name],
                cwd=self.directory, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            )  # fmt: skip
            deadline = time.monotonic() + 60
            while not self.path(f"{name}/checkpoint.json").exists():
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.05)
            time.sleep(0.5)
            process.send_signal(signal.SIGHUP)
            if not ends:
                time.sleep(1)
                self.assertIsNone(process.poll())
                process.send_signal(signal.SIGINT)
            out, errors = process.communicate(timeout=60)
            self.assertEqual((process.returncode, errors), (3, b""))
            self.assertIn(b"interrupted", out)
            content = json.loads(self.path(f"{name}/checkpoint.json").read_text())
            self.assertGreater(content["evaluation"], 0)
            rows = sqlite3.connect(self.path(f"{name}/history.sqlite")).execute("select count(*) from evaluations").fetchone()
            self.assertEqual(rows[0], content["evaluation"])

    def test_a_hang_up_ends_what_does_not_look_for_it(self):
        os.mkfifo(self.path("pipe.su2"))
        process = subprocess.Popen([harness.PROGRAM, "check", "pipe.su2"], cwd=self.directory, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)  # fmt: skip
        time.sleep(0.5)
        process.send_signal(signal.SIGHUP)
        _, errors = process.communicate(timeout=60)
        self.assertEqual((process.returncode, errors), (3, b"remodel: interrupted\n"))
