"""Commands that are killed, run out of disk space or find damaged files: nothing half written is left."""

import json
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import time

import harness
from bad_input_test import limit_file_size
from harness import ProgramTest


class CrashTest(ProgramTest):
    def run_arguments(self, evaluations, directory="run", *more, sigma=0.25):
        return (
            "optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 50, "--sigma", sigma,
            "--evaluations", evaluations, "--checkpoint-every", 10, "--quiet", "-o", directory, *more,
        )  # fmt: skip

    def start(self, *arguments):
        return subprocess.Popen(
            [harness.PROGRAM, *map(str, arguments)], cwd=self.directory, stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
        )  # fmt: skip

    def wait_for(self, name):
        deadline = time.monotonic() + 60
        while not self.path(name).exists():
            self.assertLess(time.monotonic(), deadline, f"no {name}")
            time.sleep(0.01)

    def rows(self, directory):
        connection = sqlite3.connect(f"file:{self.path(directory)}/history.sqlite?mode=ro", uri=True)
        try:
            return connection.execute(
                "select evaluation, generation, coefficients, objective, best_objective, sigma, triangles, preserved, "
                "min_angle_deg, detail from evaluations order by evaluation"
            ).fetchall()
        finally:
            connection.close()


class Kills(CrashTest):
    def test_killed_runs_end_like_others(self):
        """A few of the kills of scripts/kill-test."""
        subprocess.run(
            [harness.SOURCE / "scripts" / "kill-test", "6", "5", "500"],
            env={**os.environ, "REMODEL": harness.PROGRAM}, stdin=subprocess.DEVNULL, check=True, timeout=300,
        )  # fmt: skip

    def test_a_transaction_of_a_killed_run_is_taken_back(self):
        self.succeed(*self.run_arguments(20))
        # A writer that dies with its journal on the disk and half of its pages written.
        writer = (
            "import os, signal, sqlite3\n"
            "c = sqlite3.connect('run/history.sqlite', isolation_level=None)\n"
            "c.execute('pragma cache_size = 1')\n"
            "c.execute('pragma cache_spill = 1')\n"
            "c.execute('begin')\n"
            "c.execute('update evaluations set detail = hex(randomblob(5000))')\n"
            "os.kill(os.getpid(), signal.SIGKILL)\n"
        )
        subprocess.run([sys.executable, "-c", writer], cwd=self.directory, check=False)
        self.assertTrue(self.path("run/history.sqlite-journal").exists())
        self.succeed(*self.run_arguments(40, "run", "--resume"))
        self.succeed(*self.run_arguments(40, "whole"))
        self.assertEqual(self.rows("run"), self.rows("whole"))

    def test_what_a_killed_run_left_half_written_is_removed(self):
        self.succeed(*self.run_arguments(20))
        self.write("run/.checkpoint-a.vtkhdf.123.4.tmp", "half")
        self.write("run/.result.json.123.5.tmp", "half")
        self.write("run/.notes.txt.1.2.tmp", "not the program's")
        self.path("run/.remodel-start").mkdir()
        self.succeed(*self.run_arguments(20, "run", "--resume"))
        hidden = [path.name for path in self.path("run").iterdir() if path.name.startswith(".")]
        self.assertEqual(hidden, [".notes.txt.1.2.tmp"])

    def test_a_run_killed_at_its_start_can_be_started_again(self):
        self.path("run/.remodel-start").mkdir(parents=True)
        self.write("run/.remodel-start/.first.vtkhdf.1.0.tmp", "half")
        self.succeed(*self.run_arguments(10))
        self.assertFalse(self.path("run/.remodel-start").exists())


class OneProcessADirectory(CrashTest):
    def test_the_second_is_refused(self):
        first = self.start(*self.run_arguments(1000000))
        try:
            self.wait_for("run/checkpoint.json")
            for more in ((), ("--resume",)):
                outcome = self.run_program(*self.run_arguments(1000000, "run", *more))
                self.assertEqual(outcome.status, 2, outcome)
                self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
                self.assertIn("run: is in use by another run", outcome.stderr)
        finally:
            first.send_signal(signal.SIGINT)
            message = first.communicate(timeout=60)[1]
        self.assertEqual(first.returncode, 3, message)
        self.assertEqual(message, b"")

    def test_the_lock_ends_with_a_killed_process(self):
        first = self.start(*self.run_arguments(1000000))
        self.wait_for("run/checkpoint.json")
        first.kill()
        first.communicate()
        self.succeed(*self.run_arguments(10, "run", "--resume"))


class Damage(CrashTest):
    """Damaged files of a run are refused in one sentence, and nothing is written."""

    def setUp(self):
        super().setUp()
        self.succeed(*self.run_arguments(30))
        self.mesh = "run/" + json.loads(self.path("run/checkpoint.json").read_text())["meshes"][0]["file"]

    def refused_or_the_same(self, name, damaged, whole):
        """True if the damage was refused; otherwise it is in unused bytes."""
        good = self.path(name).read_bytes()
        self.write(name, bytes(damaged))
        before = self.files()
        outcome = self.run_program(*self.run_arguments(30, "run", "--resume"))
        if outcome.status == 2:
            self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
            self.assertIn("run", outcome.stderr)
            self.assertEqual(self.files(), before)
        else:
            self.assertEqual(outcome.status, 0, outcome)
            self.assertEqual(self.rows("run"), whole)
        self.write(name, good)
        return outcome.status == 2

    def every_region(self, name, regions, may_pass=False):
        whole = self.rows("run")
        content = self.path(name).read_bytes()
        step = max(1, len(content) // regions)
        refused = 0
        for at in range(0, len(content), step):
            for damaged in (
                content[:at] + bytes([content[at] ^ 0x11]) + content[at + 1 :],
                content[:at] + bytes(len(content[at : at + step])) + content[at + step :],
                content[:at],
            ):
                if damaged == content:
                    continue
                with self.subTest(f"{name} at {at}"):
                    this = self.refused_or_the_same(name, damaged, whole)
                    refused += this
                    self.assertTrue(this or may_pass)
        self.assertGreater(refused, regions)

    def test_checkpoint(self):
        self.every_region("run/checkpoint.json", 40)

    def test_mesh_of_the_checkpoint(self):
        self.every_region(self.mesh, 30)

    def test_history(self):
        self.every_region("run/history.sqlite", 30, may_pass=True)

    def test_a_number_in_the_history(self):
        connection = sqlite3.connect(self.path("run/history.sqlite"))
        connection.execute("update evaluations set sigma = sigma * 1.0000001 where evaluation = 7")
        connection.commit()
        connection.close()
        self.refused(*self.run_arguments(30, "run", "--resume"), names="history.sqlite")

    def test_missing_files(self):
        for name in ("run/checkpoint.json", self.mesh, "run/history.sqlite"):
            with self.subTest(name):
                content = self.path(name).read_bytes()
                self.path(name).unlink()
                self.refused(*self.run_arguments(30, "run", "--resume"), names="run")
                self.write(name, content)


class DiskTest(CrashTest):
    def mount(self, *options):
        disk = self.path("disk")
        disk.mkdir(exist_ok=True)
        mounted = subprocess.run(
            ["mount", "-t", "tmpfs", "-o", ",".join(options), "tmpfs", str(disk)], capture_output=True, check=False
        )
        if mounted.returncode != 0:
            self.skipTest("needs the right to mount a small tmpfs")
        self.addCleanup(subprocess.run, ["umount", "-l", str(disk)], capture_output=True, check=False)

    def fill(self, left=0):
        with open(self.path("disk/filler"), "wb", buffering=0) as filler:
            try:
                while filler.write(bytes(4096)) > 0:
                    pass
            except OSError:
                filler.truncate(max(0, filler.tell() - left))

    def commands(self, directory):
        """Every command that writes a file, with outputs in the directory."""
        for extension in ("vtkhdf", "su2", "msh", "vtu"):
            target = f"{directory}/old.{extension}"
            yield "mesh", "naca:0012", "--points", 100, "-o", target
            yield "update", "a.vtkhdf", "rae2822", "-o", target
            yield "convert", "a.vtkhdf", "-o", target
        for extension in ("svg", "png"):
            yield "draw", "a.vtkhdf", "-o", f"{directory}/old.{extension}"
        yield "fit", "naca:0012", "-o", f"{directory}/old.json"

    def old_outputs(self, directory):
        for extension in ("vtkhdf", "su2", "msh", "vtu", "svg", "png", "json"):
            self.write(f"{directory}/old.{extension}", f"an old {extension} file")
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "a.vtkhdf")


class FullDisk(DiskTest):
    def test_every_command_keeps_the_old_file(self):
        self.mount("size=64k")
        self.old_outputs("disk")
        self.fill()
        for command in self.commands("disk"):
            with self.subTest(" ".join(map(str, command))):
                self.refused(*command, names="disk/old.")

    def test_every_command_keeps_the_old_file_at_a_limit_of_file_sizes(self):
        self.path("disk").mkdir()
        self.old_outputs("disk")
        for command in self.commands("disk"):
            with self.subTest(" ".join(map(str, command))):
                self.refused(*command, names="disk/old.", preexec_fn=limit_file_size(16))

    def test_update_in_place(self):
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "a.vtkhdf")
        self.refused("update", "a.vtkhdf", "rae2822", "-o", "a.vtkhdf", names="a.vtkhdf", preexec_fn=limit_file_size(9999))

    def test_a_run_that_cannot_start_leaves_a_finished_one(self):
        self.mount("size=2m")
        self.succeed(*self.run_arguments(30, "disk/run"))
        self.fill(left=8192)
        self.refused(*self.run_arguments(40, "disk/run"), names="disk/run")
        self.refused(*self.run_arguments(40, "disk/run", sigma=0.1), names="disk/run")

    def test_a_run_that_cannot_go_on_can_be_resumed(self):
        self.succeed(*self.run_arguments(600, "whole"))
        for left in (0, 4096, 50000, 150000):
            with self.subTest(f"{left} bytes left"):
                self.mount("size=3m")
                self.succeed(*self.run_arguments(30, "disk/run"))
                self.fill(left)
                kept = self.path("disk/run/last.vtkhdf").read_bytes()
                outcome = self.run_program(*self.run_arguments(600, "disk/run", "--resume"))
                self.assertEqual(outcome.status, 2, outcome)
                self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
                self.assertIn("disk/run", outcome.stderr)
                self.assertEqual([p for p in self.path("disk/run").iterdir() if p.name.startswith(".")], [])
                self.assertEqual(self.path("disk/run/last.vtkhdf").read_bytes(), kept)
                # Resuming on a disk with free space works.
                shutil.rmtree(self.path("moved"), ignore_errors=True)
                shutil.copytree(self.path("disk/run"), self.path("moved"))
                self.succeed(*self.run_arguments(600, "moved", "--resume"))
                self.assertEqual(self.rows("moved"), self.rows("whole"))
                for name in ("last.vtkhdf", "best.json"):
                    self.assertEqual(self.path(f"moved/{name}").read_bytes(), self.path(f"whole/{name}").read_bytes())
                subprocess.run(["umount", "-l", str(self.path("disk"))], check=True)


class ReadOnlyDirectory(DiskTest):
    def make_read_only(self):
        if subprocess.run(["mount", "-o", "remount,ro", str(self.path("disk"))], capture_output=True).returncode != 0:
            self.skipTest("needs the right to mount a read-only file system")

    def test_every_command_keeps_the_old_file(self):
        self.mount("size=2m")
        self.old_outputs("disk")
        self.make_read_only()
        for command in self.commands("disk"):
            with self.subTest(" ".join(map(str, command))):
                self.refused(*command, names="disk")

    def test_runs(self):
        self.mount("size=2m")
        self.succeed(*self.run_arguments(30, "disk/run"))
        self.make_read_only()
        self.refused(*self.run_arguments(30, "disk/new"), names="disk")
        self.refused(*self.run_arguments(30, "disk/run"), names="disk/run")
        self.refused(*self.run_arguments(60, "disk/run", "--resume"), names="disk/run")
