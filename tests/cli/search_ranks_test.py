"""`remodel optimise` and `remodel design` under mpirun: the same rows for any number of ranks, lost ranks, refusals."""

import json
import sqlite3
import time

from harness import ProgramTest
from ranks import UnderMpirun

TIMES = {"remodel_seconds", "generate_seconds"}
POINTS = {
    "airfoil": "naca:0012", "degree": 4, "mesh": {"points": 40},
    "flow": [{"mach": 0.4, "cl": 0.2}, {"mach": 0.5, "cl": 0.3}, {"mach": 0.6, "alpha_deg": 1}],
    "objective": "drag", "constraints": [{"kind": "area", "of_start": 1}],
    "designer": {"evaluations": 4, "trust": 0.01, "bounds": 0.1},
}  # fmt: skip
CANDIDATES = POINTS | {"flow": [{"mach": 0.5, "alpha_deg": 1}],
                       "designer": {"name": "cmaes", "evaluations": 24, "sigma": 0.005, "workers": 3}}  # fmt: skip


class SearchTest(UnderMpirun, ProgramTest):
    def search(self, directory, *more):
        return ("optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 50, "--evaluations", 60, "-o", directory, *more)

    def program(self, directory, seconds, *more):
        self.write("solve.sh", f"sleep {seconds}; echo '{{\"objective\": '$(wc -c < \"$1\")'}}'")
        return ("optimise", "--from", "naca:0012", "--evaluate", "sh solve.sh {mesh}", "--points", 30, "--workers", 4,
                "--evaluations", 24, "-o", directory, *more)  # fmt: skip

    def rows(self, directory):
        directory = str(directory)
        connection = sqlite3.connect(f"file:{self.path(directory)}/history.sqlite?mode=ro", uri=True)
        try:
            connection.row_factory = sqlite3.Row
            rows = [dict(row) for row in connection.execute("select * from evaluations")]
        finally:
            connection.close()
        for row in rows:
            outputs = json.loads(row["outputs"] or "{}")
            row["outputs"] = {k: v for k, v in outputs.items() if "seconds" not in k}
            for name in TIMES:
                del row[name]
        return rows

    def on_ranks(self, ranks, *command, options=(), status=0):
        process = self.start_ranks(ranks, options, *command)
        message = process.communicate(timeout=240)[1]
        self.assertEqual(process.returncode, status, message)
        return message


class Searches(SearchTest):
    def setUp(self):
        super().setUp()
        self.require_ranks(*self.search("probe", "--workers", 2))

    def test_candidates_on_living_meshes(self):
        for name, more in (("renew", ()), ("hub", ("--strategy", "hub")), ("regenerate", ("--strategy", "regenerate"))):
            self.succeed(*self.search(f"{name}-threads", "--workers", 3, *more))
            expected = self.rows(f"{name}-threads")
            for ranks in (1, 2, 4):
                directory = f"{name}-{ranks}"
                self.on_ranks(ranks, *self.search(directory, "--workers", 3, *more))
                self.assertEqual(self.rows(directory), expected, directory)

    def test_candidates_of_a_program(self):
        self.succeed(*self.program("threads", 0))
        for ranks in (2, 4):
            self.on_ranks(ranks, *self.program(ranks, 0))
            self.assertEqual(self.rows(ranks), self.rows("threads"), f"{ranks} ranks")

    def test_candidates_by_flows(self):
        self.write("problem.json", json.dumps(CANDIDATES))
        self.run_program("design", "problem.json", "-o", "threads")
        expected = self.rows("threads")
        self.assertEqual({row["worker"] for row in expected}, {1, 2, 3})
        for ranks in (2, 4):
            self.on_ranks(ranks, "design", "problem.json", "-o", ranks, status=3)
            self.assertEqual(self.rows(ranks), expected, f"{ranks} ranks")

    def test_points_of_a_design(self):
        self.write("problem.json", json.dumps(POINTS))
        self.run_program("design", "problem.json", "-o", "threads")
        expected = self.rows("threads")
        self.assertEqual(len(expected), 4)
        for ranks in (1, 2, 4):
            self.on_ranks(ranks, "design", "problem.json", "-o", ranks, status=3)
            self.assertEqual(self.rows(ranks), expected, f"{ranks} ranks")

    def test_a_killed_rank_costs_nothing_but_its_design(self):
        self.succeed(*self.program("whole", 0))
        process = self.start_ranks(3, ("--enable-recovery",), *self.program("d", 0.3, "--rank-timeout", 2))
        deadline = time.monotonic() + 60
        while not list(self.path(".").glob("d/evaluations/rank-2/running-*")) and time.monotonic() < deadline:
            time.sleep(0.005)
        self.kill_rank(process, 2)
        message = process.communicate(timeout=240)[1]
        self.assertEqual(process.returncode, 0, message)
        self.assertIn(b"rank 2 has been silent", message)
        expected = self.rows("whole")
        self.assertEqual(self.rows("d"), expected)

    def test_a_search_that_is_killed_goes_on_with_other_ranks(self):
        self.succeed(*self.program("whole", 0))
        process = self.start_ranks(2, (), *self.program("d", 0.2, "--checkpoint-every", 4))
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            if self.path("d/history.sqlite").exists() and len(self.rows("d")) >= 8:
                break
            time.sleep(0.02)
        self.kill_rank(process, 0)
        process.communicate(timeout=240)
        self.on_ranks(3, *self.program("d", 0, "--resume"))
        self.assertEqual(self.rows("d"), self.rows("whole"))

    def test_what_ranks_cannot_share_is_refused_once(self):
        message = self.on_ranks(3, *self.search("d"), status=2)
        self.assertEqual(message.count(b"remodel: error:"), 1, message)
        self.assertIn(b"--workers: found 1 with 3 MPI ranks, expected 2 or more", message)
        self.write("problem.json", json.dumps(POINTS | {"flow": POINTS["flow"][:1]}))
        message = self.on_ranks(2, "design", "problem.json", "-o", "d", status=2)
        self.assertIn(b"found one point of flow and one living mesh", message)
        self.assertFalse(self.path("d").exists())
