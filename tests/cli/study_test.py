"""`remodel study` in small: its tables, kills, interrupts, resuming, MPI ranks, full disks."""

import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import time

import harness
from bad_input_test import limit_file_size
from crash_test import DiskTest
from ranks import UnderMpirun

KEYS = (
    "options jobs done before cells scenarios replays evaluations invalid_meshes recoveries stopped_replays "
    "core_seconds seconds stopped directory"
)
TABLES = ("airfoils", "scenarios", "fresh", "replays", "blocks", "comparisons")
TIMES = {"seconds", "remodel_ms_mean", "generate_ms_mean", "speedup"}
# A study with two values of each list, in about a second.
SMALL = (
    "--pairs", "50/1,100/2", "--sigmas", "0.05,0.25", "--distances", "1,2", "--evaluations", 60, "--compare-every", 20,
)  # fmt: skip
# A study of more than a core second on a fast machine, long enough to be killed in.
LONGER = (
    "--pairs", "50/1,100/2", "--sigmas", "0.05,0.25", "--distances", "1", "--evaluations", 2500, "--compare-every", 20,
)  # fmt: skip
# A study that would take hours.
ENDLESS = ("--pairs", "50/1", "--sigmas", "0.25", "--evaluations", 10000000, "--compare-every", 0)


class StudyTest(DiskTest):
    def study(self, directory, *more):
        return ("study", "-o", directory, "--quiet", *more)

    def tables(self, directory):
        """Every row but its times."""
        connection = sqlite3.connect(self.path(directory) / "study.sqlite")
        try:
            result = {}
            for table in TABLES:
                columns = [row[1] for row in connection.execute(f"pragma table_info({table})")]
                names = ", ".join(name for name in columns if name not in TIMES)
                result[table] = sorted(connection.execute(f"select {names} from {table}").fetchall(), key=repr)
            return result
        finally:
            connection.close()

    def count(self, directory, table):
        connection = sqlite3.connect(self.path(directory) / "study.sqlite")
        try:
            return connection.execute(f"select count(*) from {table}").fetchone()[0]
        finally:
            connection.close()

    def wait_for_rows(self, directory, table, process):
        deadline = time.monotonic() + 240
        while time.monotonic() < deadline:
            try:
                if self.count(directory, table) > 0:
                    return
            except sqlite3.OperationalError:
                pass
            if process.poll() is not None:
                break
            time.sleep(0.02)
        process.kill()
        self.fail(f"no rows in {table}: exit status {process.returncode}, {process.communicate()}")


class Studies(StudyTest):
    def test_short_study(self):
        figures = self.figures(*self.study("s", *SMALL))
        self.assertKeys(figures, KEYS)
        self.assertEqual(figures["stopped"], "done")
        self.assertEqual((figures["scenarios"], figures["replays"], figures["cells"]), (2, 16, 16))
        self.assertEqual(figures["jobs"], 2 + 4 + 16)
        self.assertEqual(figures["done"], figures["jobs"])
        self.assertEqual(figures["evaluations"], 16 * 60)
        self.assertEqual(figures["invalid_meshes"], 0)
        self.assertEqual([path.name for path in self.path("s").iterdir()], ["study.sqlite"])
        for table, rows in (("scenarios", 2), ("fresh", 4 * 3), ("replays", 16), ("comparisons", 16 * 3)):
            self.assertEqual(self.count("s", table), rows, table)
        rows = self.tables("s")["replays"]
        self.assertEqual({row[5] for row in rows}, {"chain", "renew"})

    def test_any_number_of_threads(self):
        self.succeed(*self.study("one", *SMALL, "--threads", 1))
        self.succeed(*self.study("three", *SMALL, "--threads", 3))
        self.assertEqual(self.tables("one"), self.tables("three"))

    def test_progress(self):
        self.assertEqual(self.succeed(*self.study("a", *SMALL)).stderr, "")
        outcome = self.succeed("study", "-o", "b", *SMALL)
        self.assertIn("options: {", outcome.stderr)
        self.assertIn("22/22 jobs", outcome.stderr)
        self.assertIn("s left", outcome.stderr)

    def test_sqlite3_reads_it(self):
        if shutil.which("sqlite3") is None:
            self.skipTest("needs sqlite3")
        self.succeed(*self.study("s", *SMALL))
        count = subprocess.run(
            ["sqlite3", "-readonly", str(self.path("s/study.sqlite")), "select count(*) from blocks"],
            capture_output=True, check=True,
        )  # fmt: skip
        self.assertEqual(count.stdout.strip(), b"960")

    def test_study_grows(self):
        self.succeed(*self.study("s", *SMALL, "--strategy", "chain"))
        # A second start without --resume is refused.
        self.refused(*self.study("s", *SMALL), names="s: holds a study")
        figures = self.figures(*self.study("s", "--resume", "--strategy", "renew", "--scenarios", 2))
        self.assertEqual(figures["before"], 2 + 4 + 8)
        self.assertEqual(figures["scenarios"], 4)
        self.succeed(*self.study("whole", *SMALL, "--scenarios", 2))
        self.assertEqual(self.tables("s"), self.tables("whole"))
        self.refused(*self.study("s", "--resume", "--evaluations", 61), names="evaluations")
        self.refused(*self.study("s", "--resume", "--pairs", "50/1"), names="pairs")
        self.assertEqual(self.figures(*self.study("s", "--resume"))["before"], figures["jobs"])

    def test_interrupt_keeps_what_is_finished(self):
        process = self.start(*self.study("s", *ENDLESS, "--json"))
        self.wait_for("s/study.sqlite")
        process.send_signal(signal.SIGINT)
        message = process.communicate(timeout=60)[1]
        self.assertEqual(process.returncode, 3, message)
        self.assertEqual(message, b"")

    def test_time_limit(self):
        figures = self.figures(*self.study("s", *LONGER, "--threads", 1, "--time-limit", 0.2), status=3)
        self.assertEqual(figures["stopped"], "interrupted")
        self.assertLess(figures["done"], figures["jobs"])
        self.succeed(*self.study("s", "--resume"))
        self.succeed(*self.study("whole", *LONGER))
        self.assertEqual(self.tables("s"), self.tables("whole"))

    def test_one_process_a_directory(self):
        first = self.start(*self.study("s", *ENDLESS))
        try:
            self.wait_for("s/study.sqlite")
            time.sleep(0.2)
            outcome = self.run_program(*self.study("s", "--resume"))
            self.assertEqual(outcome.status, 2, outcome)
            self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
            self.assertIn("s: is in use by another run", outcome.stderr)
        finally:
            first.kill()
            first.communicate()

    def test_killed_ten_times(self):
        self.succeed(*self.study("whole", *LONGER))
        dice = random.Random(7)
        for _ in range(10):
            there = self.path("s/study.sqlite").exists()
            process = self.start(*self.study("s", *(("--resume",) if there else LONGER)))
            time.sleep(dice.uniform(0.0, 0.3))
            process.kill()
            process.communicate()
        there = self.path("s/study.sqlite").exists()
        self.succeed(*self.study("s", *(("--resume",) if there else LONGER)))
        self.assertEqual(self.tables("s"), self.tables("whole"))
        self.assertEqual([path.name for path in self.path("s").iterdir()], ["study.sqlite"])


class RankTest(UnderMpirun, StudyTest):
    def setUp(self):
        super().setUp()
        self.require_ranks(*self.study("probe", *SMALL, "--time-limit", 0.001))

    def mpirun(self, ranks, options, directory, *more):
        process = self.start_ranks(ranks, options, *self.study(directory, *more))
        return process, process.communicate(timeout=120)[1]


class Ranks(RankTest):
    def test_any_number_of_ranks(self):
        self.succeed(*self.study("whole", *SMALL))
        for ranks in (1, 2, 4):
            process, message = self.mpirun(ranks, (), str(ranks), *SMALL)
            self.assertEqual(process.returncode, 0, message)
            self.assertEqual(self.tables(str(ranks)), self.tables("whole"), f"{ranks} ranks")

    def test_work_of_a_killed_rank_is_done_again(self):
        process = self.start_ranks(
            3, ("--enable-recovery",), *self.study("s", *LONGER, "--scenarios", 2, "--rank-timeout", 3, "--json")
        )
        self.wait_for_rows("s", "fresh", process)
        self.kill_rank(process, 2)
        stdout, message = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, message)
        self.assertEqual(json.loads(stdout)["stopped"], "done")
        self.succeed(*self.study("whole", *LONGER, "--scenarios", 2))
        self.assertEqual(self.tables("s"), self.tables("whole"))

    def test_where_a_kill_ends_all_the_study_is_resumed(self):
        process = self.start_ranks(3, (), *self.study("s", *LONGER))
        self.wait_for_rows("s", "fresh", process)
        self.kill_rank(process, 1)
        process.communicate(timeout=120)
        self.assertNotEqual(process.returncode, 0)
        process, message = self.mpirun(2, (), "s", "--resume")
        self.assertEqual(process.returncode, 0, message)
        self.succeed(*self.study("whole", *LONGER))
        self.assertEqual(self.tables("s"), self.tables("whole"))

    def test_bad_input_is_refused_once(self):
        process, message = self.mpirun(3, (), "s", "--sigmas", "-1")
        self.assertEqual(process.returncode, 2, message)
        self.assertEqual(message.count(b"error: --sigmas"), 1, message)
        message = self.mpirun(3, ("--enable-recovery",), "s", "--sigmas", "-1")[1]
        self.assertEqual(message.count(b"error: --sigmas"), 1, message)
        self.write("taken", "")
        process, message = self.mpirun(3, (), "taken", *SMALL)
        self.assertEqual(process.returncode, 2, message)
        self.assertEqual(message.count(b"remodel: error:"), 1, message)


class Disks(StudyTest):
    def test_no_room_for_the_start(self):
        self.refused(*self.study("s", *SMALL), names="s/", preexec_fn=limit_file_size(2048))
        self.mount("size=16k")
        self.fill()
        self.refused(*self.study("disk/s", *SMALL), names="disk/s")

    def test_a_disk_that_fills_up(self):
        self.succeed(*self.study("whole", *LONGER))
        self.mount("size=2m")
        self.fill(left=750_000)
        outcome = self.run_program(*self.study("disk/s", *LONGER))
        self.assertEqual(outcome.status, 2, outcome)
        self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
        self.assertIn("disk/s/study.sqlite", outcome.stderr)
        # Resuming on a disk with free space works.
        shutil.copytree(self.path("disk/s"), self.path("moved"))
        self.assertGreater(self.figures(*self.study("moved", "--resume"))["before"], 0)
        self.assertEqual(self.tables("moved"), self.tables("whole"))

    def test_read_only_directory(self):
        self.mount("size=4m")
        self.succeed(*self.study("disk/s", *SMALL))
        if subprocess.run(["mount", "-o", "remount,ro", str(self.path("disk"))], capture_output=True).returncode != 0:
            self.skipTest("needs the right to mount a read-only file system")
        self.refused(*self.study("disk/new", *SMALL), names="disk/new")
        self.refused(*self.study("disk/s", "--resume", "--scenarios", 2), names="disk/s")
