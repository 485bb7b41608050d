"""Where outputs go: files are replaced as a whole, devices and FIFOs are written, links to them are refused. No test
comes near a device of the machine: those here are made below a temporary directory."""

import os
import socket
import stat
import subprocess
import threading
import time
from pathlib import Path

import harness
from harness import ProgramTest

NULL, FULL = (1, 3), (1, 7)  # Linux's numbers of /dev/null and /dev/full


class Places(ProgramTest):
    def setUp(self):
        super().setUp()
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "a.vtkhdf")

    def doors(self, place):
        """Every command that writes a file, with its output `place` plus the extension that it needs."""
        for extension in ("vtkhdf", "su2", "msh", "vtu"):
            yield f"{place}.{extension}", ("mesh", "naca:0012", "--points", 50, "-o", f"{place}.{extension}")
        yield f"{place}.vtkhdf", ("update", "a.vtkhdf", "rae2822", "-o", f"{place}.vtkhdf")
        yield f"{place}.vtu", ("convert", "a.vtkhdf", "-o", f"{place}.vtu")
        yield f"{place}.json", ("fit", "naca:0012", "-o", f"{place}.json")
        for extension in ("svg", "png"):
            yield f"{place}.{extension}", ("draw", "a.vtkhdf", "-o", f"{place}.{extension}")
        yield f"{place}.svg", ("flow", "a.vtkhdf", "--model", "potential", "--cp-plot", f"{place}.svg")
        yield f"{place}.vtu", ("flow", "a.vtkhdf", "--model", "potential", "-o", f"{place}.vtu")

    def run_of_designs(self):
        self.succeed("optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 50, "--evaluations", 5,
                     "--quiet", "-o", "run")  # fmt: skip

    def device(self, name, numbers):
        try:
            os.mknod(self.path(name), stat.S_IFCHR | 0o600, os.makedev(*numbers))
            os.close(os.open(self.path(name), os.O_WRONLY))
        except OSError:
            self.skipTest("needs the right to make device nodes")
        return name

    def refused_link(self, target, kind):
        """A link, and a link to a link, to what is no regular file: refused, and the target is what it was."""
        before = os.lstat(self.path(target))
        os.symlink(target, self.path("first"))
        for name, command in self.doors("out"):
            os.symlink("first", self.path(name))
            with self.subTest(command):
                line = self.refused(*command, names=f"{name}: is a link to something that is {kind}, expected a file")
                self.assertNotIn("\\", line)
            after = os.lstat(self.path(target))
            self.assertEqual((after.st_mode, after.st_ino, after.st_rdev), (before.st_mode, before.st_ino, before.st_rdev))
            self.path(name).unlink()

    def test_links_to_fifos(self):
        os.mkfifo(self.path("fifo"))
        self.refused_link("fifo", "a FIFO")

    def test_links_to_devices(self):
        self.refused_link(self.device("null", NULL), "a device")

    def test_links_to_directories(self):
        self.path("directory").mkdir()
        self.refused_link("directory", "a directory")

    def test_links_to_sockets_and_sockets(self):
        with socket.socket(socket.AF_UNIX) as server:
            server.bind(os.fspath(self.path("out.su2")))
            self.refused("mesh", "naca:0012", "--points", 50, "-o", "out.su2", names="out.su2: is a socket, expected a file")
            os.symlink("out.su2", self.path("link.su2"))
            self.refused("mesh", "naca:0012", "--points", 50, "-o", "link.su2", names="link.su2: is a link to something that is a socket")

    def read_from(self, fifo):
        """What comes out of a FIFO, once the thread has ended."""
        parts = []
        reader = threading.Thread(target=lambda: parts.append(self.path(fifo).read_bytes()), daemon=True)
        reader.start()
        return reader, parts

    def test_fifos_are_written_to(self):
        for name, command in self.doors("out"):
            with self.subTest(command):
                self.succeed(*command)
                expected = self.path(name).read_bytes()
                self.path(name).unlink()
                os.mkfifo(self.path(name))
                reader, parts = self.read_from(name)
                self.succeed(*command)
                reader.join(60)
                self.assertTrue(stat.S_ISFIFO(os.lstat(self.path(name)).st_mode))
                self.assertEqual(parts[0], expected)
                self.path(name).unlink()

    def test_a_film_goes_through_a_fifo(self):
        self.run_of_designs()
        size = self.figures("film", "run", "-o", "a.webp", "--frames", 3)["bytes"]
        os.mkfifo(self.path("b.webp"))
        reader, parts = self.read_from("b.webp")
        self.assertEqual(self.figures("film", "run", "-o", "b.webp", "--frames", 3)["bytes"], size)
        reader.join(60)
        self.assertEqual(parts, [self.path("a.webp").read_bytes()])

    def test_devices_are_written_to(self):
        self.device("out.su2", NULL)
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "out.su2")
        self.assertTrue(stat.S_ISCHR(os.lstat(self.path("out.su2")).st_mode))
        self.device("full.su2", FULL)
        self.refused("mesh", "naca:0012", "--points", 50, "-o", "full.su2", names="full.su2: cannot be written: No space left")
        self.assertTrue(stat.S_ISCHR(os.lstat(self.path("full.su2")).st_mode))

    def test_streams_have_no_extension(self):
        for name in ("/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):
            self.refused("mesh", "naca:0012", "--points", 50, "-o", name, names=name)
        os.symlink("/dev/stdout", self.path("out.su2"))
        self.refused("mesh", "naca:0012", "--points", 50, "-o", "out.su2", names="out.su2: is a link to something that is a FIFO")

    def test_links_to_files_stay_and_their_targets_are_replaced(self):
        for name, command in self.doors("out"):
            with self.subTest(command):
                self.path("far").mkdir(exist_ok=True)
                self.write("far/target", "old")
                self.path("far/target").chmod(0o640)
                os.symlink("far/target", self.path("first"))
                os.symlink("first", self.path(name))
                self.succeed(*command)
                self.assertTrue(self.path(name).is_symlink() and self.path("first").is_symlink())
                self.assertGreater(self.path("far/target").stat().st_size, 100)
                self.assertEqual(self.path("far/target").stat().st_mode & 0o777, 0o640)
                self.assertEqual(os.listdir(self.path("far")), ["target"])
                for link in (name, "first"):
                    self.path(link).unlink()

    def test_a_link_that_leads_to_no_file_yet_makes_one(self):
        os.symlink("new.su2", self.path("out.su2"))
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "out.su2")
        self.assertTrue(self.path("out.su2").is_symlink() and self.path("new.su2").is_file())

    def test_links_in_a_circle_are_refused(self):
        os.symlink("b.su2", self.path("a.su2"))
        os.symlink("a.su2", self.path("b.su2"))
        self.refused("mesh", "naca:0012", "--points", 50, "-o", "a.su2", names="a.su2: cannot be written: Too many levels")

    def test_other_hard_links_keep_the_old_content(self):
        self.write("out.su2", "old")
        os.link(self.path("out.su2"), self.path("other.su2"))
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "out.su2")
        self.assertEqual(self.path("other.su2").read_text(), "old")

    def test_a_file_that_is_not_ours_is_refused(self):
        if os.geteuid() != 0:
            self.skipTest("needs root, who can become somebody else")
        nobody = 65534
        self.directory.chmod(0o777)
        self.write("out.su2", "precious")
        program = self.path("remodel")
        program.write_bytes(Path(harness.PROGRAM).read_bytes())
        program.chmod(0o755)
        process = subprocess.run(
            [program, "mesh", "naca:0012", "--points", "50", "-o", "out.su2"], cwd=self.directory, capture_output=True,
            text=True, preexec_fn=lambda: (os.setgroups([]), os.setgid(nobody), os.setuid(nobody)), check=False,
        )  # fmt: skip
        self.assertEqual((process.returncode, process.stdout), (2, ""), process.stderr)
        self.assertIn("out.su2: cannot be written: Permission denied", process.stderr)
        self.assertEqual(self.path("out.su2").read_text(), "precious")

    def test_a_replaced_file_keeps_its_owner(self):
        if os.geteuid() != 0:
            self.skipTest("needs root, who writes files of others")
        self.write("out.su2", "old")
        os.chown(self.path("out.su2"), 65534, 65534)
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "out.su2")
        found = self.path("out.su2").stat()
        self.assertEqual((found.st_uid, found.st_gid), (65534, 65534))

    def test_histories_that_are_no_files_are_refused_at_once(self):
        self.run_of_designs()
        self.path("run/history.sqlite").unlink()
        os.mkfifo(self.path("fifo"))
        os.symlink("../fifo", self.path("run/history.sqlite"))
        begin = time.monotonic()
        self.refused("film", "run", "-o", "a.webp", names="history.sqlite")
        self.refused("optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 50, "--evaluations", 9,
                     "--quiet", "-o", "run", "--resume", names="history.sqlite")  # fmt: skip
        self.assertLess(time.monotonic() - begin, 60)
        self.assertTrue(stat.S_ISFIFO(os.lstat(self.path("fifo")).st_mode))

    def test_a_run_directory_may_be_a_link(self):
        self.path("far").mkdir()
        os.symlink("far", self.path("run"))
        self.run_of_designs()
        self.assertTrue(self.path("run").is_symlink())
        self.assertTrue(self.path("far/best.json").is_file())

    def test_a_linked_mesh_of_openfoam_is_refused(self):
        self.path("case/constant").mkdir(parents=True)
        self.path("mesh").mkdir()
        self.write("mesh/points", "precious")
        os.symlink("../../mesh", self.path("case/constant/polyMesh"))
        self.refused("mesh", "naca:0012", "--points", 50, "-o", "case/case.foam", names="polyMesh: is a link, expected a directory")
