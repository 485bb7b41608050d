"""Runs of `remodel optimise` in small: results, the history, interrupts and resuming."""

import json
import os
import pty
import shutil
import signal
import sqlite3
import subprocess
import time

import harness
from harness import ProgramTest

KEYS = (
    "evaluations infeasible_samples full_adjustments objective max_error preserved_percent lost_mean triangles_mean "
    "generated_triangles_mean surplus_percent remodel_ms_mean generate_ms_mean speedup min_angle_deg invalid_meshes "
    "recoveries seconds"
)
FILES = {"history.sqlite", "best.json", "result.json", "first.vtkhdf", "middle.vtkhdf", "last.vtkhdf"}


class Runs(ProgramTest):
    def arguments(self, evaluations, directory="run", *more):
        return (
            "optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 50, "--seed", 1,
            "--evaluations", evaluations, "-o", directory, *more,
        )

    def rows(self, directory, query):
        connection = sqlite3.connect(f"file:{self.path(directory)}/history.sqlite?mode=ro", uri=True)
        try:
            return connection.execute(query).fetchall()
        finally:
            connection.close()

    def designs(self, directory):
        return self.rows(directory, "select evaluation, coefficients, objective, triangles, preserved from evaluations")

    def test_short_run(self):
        figures = self.figures(*self.arguments(200, "run", "--compare-every", 20, "--quiet"))
        self.assertKeys(figures, KEYS)
        self.assertEqual(figures["evaluations"], 200)
        self.assertEqual(figures["invalid_meshes"], 0)
        self.assertGreaterEqual(figures["min_angle_deg"], 30 * (1 - 1e-9))
        self.assertGreater(figures["preserved_percent"], 50)
        self.assertAlmostEqual(
            figures["speedup"], figures["generate_ms_mean"] / figures["remodel_ms_mean"], delta=1e-9 * figures["speedup"]
        )
        self.assertLessEqual(FILES, {path.name for path in self.path("run").iterdir()})
        self.assertEqual(len(self.rows("run", "select * from evaluations")), 200)
        for mesh in ("first", "middle", "last"):
            self.assertTrue(self.figures("check", f"run/{mesh}.vtkhdf")["valid"])
        design = json.loads(self.path("run/best.json").read_text())
        self.assertEqual(self.figures("fit", "run/best.json")["upper"], design["upper"])

    def test_without_comparisons_the_figures_are_null(self):
        figures = self.figures(*self.arguments(20))
        for key in ("generated_triangles_mean", "surplus_percent", "generate_ms_mean", "speedup"):
            self.assertIsNone(figures[key])

    def test_same_seed_same_run(self):
        for directory in ("a", "b"):
            self.succeed(*self.arguments(100, directory))
        self.assertEqual(self.designs("a"), self.designs("b"))
        self.assertEqual(self.path("a/last.vtkhdf").read_bytes(), self.path("b/last.vtkhdf").read_bytes())

    def test_strategies_and_workers(self):
        for strategy, workers in (("chain", 1), ("renew", 1), ("hub", 1), ("pool", 11), ("regenerate", 1), ("hub", 3)):
            given = () if workers in (1, 11) else ("--workers", workers)
            directory = f"{strategy}-{workers}"
            figures = self.figures(*self.arguments(44, directory, "--strategy", strategy, *given, "--compare-every", 11))
            self.assertEqual(figures["invalid_meshes"], 0)
            self.assertEqual(figures["options"]["strategy"], strategy)
            self.assertEqual(figures["workers"], workers)
            used = self.rows(directory, "select distinct worker from evaluations order by worker")
            self.assertEqual([worker for worker, in used], list(range(1, workers + 1)))
            designs = self.rows(directory, "select coefficients from evaluations")
            self.assertEqual(designs, self.rows("chain-1", "select coefficients from evaluations"))

    def test_threads_change_nothing(self):
        for threads in (1, 2, 4):
            self.succeed(*self.arguments(60, f"on{threads}", "--workers", 3, "--threads", threads))
            self.assertEqual(self.designs("on1"), self.designs(f"on{threads}"))
            self.assertEqual(self.path("on1/last.vtkhdf").read_bytes(), self.path(f"on{threads}/last.vtkhdf").read_bytes())

    def test_repeat_reports_the_median(self):
        figures = self.figures(*self.arguments(20, "run", "--repeat", 3, "--compare-every", 5))
        self.assertEqual(figures["evaluations"], 20)
        self.assertGreater(figures["speedup"], 0)

    def test_sqlite3_reads_the_history(self):
        if shutil.which("sqlite3") is None:
            self.skipTest("needs sqlite3")
        self.succeed(*self.arguments(50, "run", "--compare-every", 10))
        history = str(self.path("run/history.sqlite"))
        count = subprocess.run(
            ["sqlite3", "-readonly", history, "select count(*) from evaluations"], capture_output=True, check=True
        )
        self.assertEqual(count.stdout.strip(), b"50")
        table = subprocess.run([harness.SOURCE / "scripts" / "history-table", history], capture_output=True, check=True)
        self.assertEqual(len(table.stdout.splitlines()), 12)  # two lines of heading, ten rows

    def test_quiet_and_plain_lines(self):
        self.assertEqual(self.succeed(*self.arguments(20, "a", "--quiet")).stderr, "")
        outcome = self.succeed(*self.arguments(20, "b"))
        self.assertIn("options: {", outcome.stderr)
        self.assertIn("20/20", outcome.stderr)
        self.assertNotIn("\r", outcome.stderr)

    def test_progress_bar_on_a_terminal(self):
        master, slave = pty.openpty()
        process = subprocess.Popen(
            [harness.PROGRAM, *map(str, self.arguments(20))], cwd=self.directory, stderr=slave,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
        )
        os.close(slave)
        shown = b""
        while True:
            try:
                part = os.read(master, 4096)
            except OSError:
                break
            if not part:
                break
            shown += part
        os.close(master)
        self.assertEqual(process.wait(60), 0)
        self.assertIn(b"\r[####################] 20/20", shown)

    def interrupt(self, directory):
        process = subprocess.Popen(
            [harness.PROGRAM, *map(str, self.arguments(1000000, directory, "--json"))], cwd=self.directory,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        )
        deadline = time.monotonic() + 60
        while not self.path(directory, "first.vtkhdf").exists() and time.monotonic() < deadline:
            time.sleep(0.02)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        stdout, _ = process.communicate(timeout=120)
        return process.returncode, json.loads(stdout)

    def path(self, *names):
        return self.directory.joinpath(*names)

    def test_interrupt_keeps_the_run(self):
        status, figures = self.interrupt("run")
        self.assertEqual(status, 3)
        self.assertEqual(figures["stopped"], "interrupted")
        done = figures["evaluations"]
        self.assertGreater(done, 0)
        self.assertEqual(len(self.designs("run")), done)
        self.assertTrue(self.figures("check", "run/last.vtkhdf")["valid"])

        # Not started over by mistake, and resumed to what a run without an interrupt would have been.
        self.refused(*self.arguments(done + 50), names="run")
        resumed = self.figures(*self.arguments(done + 50, "run", "--resume"))
        self.assertEqual(resumed["evaluations"], done + 50)
        self.succeed(*self.arguments(done + 50, "whole"))
        self.assertEqual(self.designs("run"), self.designs("whole"))
        self.assertEqual(self.path("run/last.vtkhdf").read_bytes(), self.path("whole/last.vtkhdf").read_bytes())

    def test_finished_run_can_be_extended(self):
        self.succeed(*self.arguments(60))
        self.succeed(*self.arguments(100, "run", "--resume"))
        self.succeed(*self.arguments(100, "whole"))
        self.assertEqual(self.designs("run"), self.designs("whole"))

    def test_resume_with_other_options_is_refused(self):
        self.succeed(*self.arguments(20))
        self.refused(*self.arguments(40, "run", "--resume", "--sigma", 0.25), names="sigma")
