"""Runs of `remodel optimise` in small: results, the history, interrupts and resuming."""

import fcntl
import json
import os
import pty
import shutil
import signal
import sqlite3
import struct
import subprocess
import termios
import time

import harness
from harness import ProgramTest

KEYS = (
    "evaluations infeasible_samples full_adjustments objective max_error preserved_percent lost_mean connectivity_percent "
    "connectivity_kept_steps changed_triangles_mean triangles_mean "
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

    def test_tolerance_ends_the_run(self):
        figures = self.figures(*self.arguments(9000, "run", "--tolerance", 1e-6))
        self.assertEqual(figures["stopped"], "done")
        self.assertLessEqual(figures["objective"], 1e-6)
        self.assertLess(figures["evaluations"], 9000)
        self.assertNotEqual(self.path("run/middle.vtkhdf").read_bytes(), self.path("run/last.vtkhdf").read_bytes())

    def test_film_of_a_run(self):
        self.succeed(*self.arguments(60))
        for name in ("a.webp", "b.webp"):
            figures = self.figures("film", "run", "-o", name, "--frames", 10, "--width", 300)
            self.assertEqual(figures["frames"], 10)
        film = self.path("a.webp").read_bytes()
        self.assertEqual((film[:4], film[8:12]), (b"RIFF", b"WEBP"))
        self.assertEqual(film.count(b"ANMF"), 10)
        self.assertEqual(film, self.path("b.webp").read_bytes())
        self.assertEqual(self.figures("film", "run", "-o", "c.webp", "--frames", 100, "--width", 100)["frames"], 61)

    def test_a_mesh_with_slack_in_its_angles_holds_its_connectivity(self):
        held = {}
        for angle in (30, 32):
            self.succeed("mesh", "naca:0012", "--refine-angle", angle, "-o", "reference.vtkhdf")
            figures = self.figures("update", "reference.vtkhdf", "naca:0013", "--strategy", "reference", "-o", "new.vtkhdf")
            self.assertTrue(self.figures("check", "new.vtkhdf")["valid"])
            held[angle] = figures["held"], figures["connectivity_percent"] == 100.0
        self.assertEqual(held, {30: (False, False), 32: (True, True)})

    def test_film_of_an_imported_mesh_and_of_a_hub(self):
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "start.su2")
        self.succeed("optimise", "--mesh", "start.su2", "--boundary", "airfoil", "--to", "rae2822", "--evaluations", 30, "-o", "imported")
        self.succeed(*self.arguments(30, "hub", "--strategy", "hub"))
        for run in ("imported", "hub"):
            self.assertEqual(self.figures("film", run, "-o", f"{run}.webp", "--frames", 5, "--width", 200)["frames"], 5)

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
        for strategy, workers in (("chain", 1), ("renew", 1), ("morph", 1), ("reference", 1), ("hub", 1), ("pool", 11), ("regenerate", 1), ("hub", 3)):
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

    def test_morphs_do_not_heap_up_vertices_of_the_boundary(self):
        # A search that once made 491 beside the design's 200, and then half of its triangles anew in every step.
        figures = self.figures(
            "optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 200, "--sigma", 0.01, "--seed", 3,
            "--strategy", "morph", "--evaluations", 800, "--compare-every", 100, "--quiet", "-o", "run")
        self.assertEqual(figures["invalid_meshes"], 0)
        rows = self.rows("run", "select triangles - connected, triangles_before - connected from evaluations")
        changed = sorted(born + gone for born, gone in rows)
        self.assertLess(changed[len(changed) // 2], 200)
        self.assertLess(self.figures("check", "run/last.vtkhdf")["boundary"]["airfoil"], 300)

    def test_evaluator_of_ones_own(self):
        self.write("thin.py", """
import json, sys
design = json.load(open(sys.argv[2]))
edges = next(line for line in open(sys.argv[1]) if line.startswith("NELEM="))
if design[0] > 0.2: sys.exit("too blunt")
print(json.dumps({"objective": sum(a * a for a in design), "constraints": [0.1 - design[0]],
                  "outputs": {"triangles": int(edges[6:])}}))
""")
        figures = self.figures(
            "optimise", "--from", "naca:0012", "--evaluator", "python3 thin.py", "--points", 50, "--evaluations", 40,
            "--quiet", "-o", "run",
        )
        rows = self.rows("run", "select objective, constraints, outputs, triangles, coefficients, detail from evaluations")
        self.assertEqual(len(rows), 40)
        best = float("inf")
        for objective, constraints, outputs, triangles, coefficients, detail in rows:
            design = json.loads(coefficients)
            if design[0] > 0.2:
                self.assertEqual((objective, constraints, outputs), (float("inf"), None, None))
                self.assertIn("too blunt", detail)
                continue
            self.assertEqual(objective, sum(a * a for a in design))
            self.assertEqual(json.loads(outputs), {"triangles": triangles})
            if json.loads(constraints)[0] <= 0:
                best = min(best, objective)
        self.assertEqual(figures["objective"], best)
        self.assertEqual(figures["failed_evaluations"], sum(row[0] == float("inf") for row in rows))
        self.assertGreater(figures["failed_evaluations"], 0)
        self.assertIsNone(figures["max_error"])
        self.assertEqual(figures["best"]["upper"] + figures["best"]["lower"], min(
            (json.loads(row[4]) for row in rows if row[0] == best)))
        self.refused(
            "optimise", "--from", "naca:0012", "--to", "rae2822", "--evaluate", "true", "-o", "x", names="--evaluate"
        )

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

        # A second start without --resume or --overwrite is refused; the resumed run equals one without an
        # interrupt.
        self.refused(*self.arguments(done + 50), names="run")
        resumed = self.figures(*self.arguments(done + 50, "run", "--resume"))
        self.assertEqual(resumed["evaluations"], done + 50)
        self.succeed(*self.arguments(done + 50, "whole"))
        self.assertEqual(self.designs("run"), self.designs("whole"))
        self.assertEqual(self.path("run/last.vtkhdf").read_bytes(), self.path("whole/last.vtkhdf").read_bytes())

    def test_progress_stays_in_its_line_of_a_narrow_terminal(self):
        ours, terminal = pty.openpty()
        fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 50, 0, 0))
        with subprocess.Popen(
            [harness.PROGRAM, *map(str, self.arguments(20000, "run"))], cwd=self.directory, stderr=terminal,
            stdout=subprocess.DEVNULL,
        ) as process:
            os.close(terminal)
            shown = harness.read_terminal(ours)
        self.assertEqual(process.returncode, 0, shown)
        heading, *lines = shown.decode().removesuffix("\r\n").split("\r\n")
        self.assertTrue(heading.startswith("options: "), heading)
        self.assertEqual(len(lines), 1, shown)
        states = [state.removesuffix("\x1b[K") for state in lines[0].split("\r") if state]
        self.assertGreater(len(states), 1)
        self.assertLess(max(map(len, states)), 50)
        self.assertTrue(all(state.startswith("[") for state in states), states)

    def test_finished_run_can_be_extended(self):
        self.succeed(*self.arguments(60))
        self.succeed(*self.arguments(100, "run", "--resume"))
        self.succeed(*self.arguments(100, "whole"))
        self.assertEqual(self.designs("run"), self.designs("whole"))

    def test_a_finished_run_is_replaced_only_where_asked_for(self):
        self.succeed(*self.arguments(60))
        before = self.path("run", "history.sqlite").read_bytes()
        refusal = self.refused(*self.arguments(10), names="60 evaluations")
        for option in ("--overwrite", "--resume"):
            self.assertIn(option, refusal)
        self.refused(*self.arguments(10, "run", "--overwrite", "--resume"), names="--overwrite")
        self.assertEqual(self.path("run", "history.sqlite").read_bytes(), before)
        self.succeed(*self.arguments(10, "run", "--overwrite"))
        self.assertEqual(len(self.designs("run")), 10)
        self.path("run", "checkpoint.json").unlink()
        self.refused(*self.arguments(20), names="without its checkpoint")
        self.assertEqual(len(self.designs("run")), 10)

    def test_resume_with_other_options_is_refused(self):
        self.succeed(*self.arguments(20))
        self.refused(*self.arguments(40, "run", "--resume", "--sigma", 0.25), names="sigma")
