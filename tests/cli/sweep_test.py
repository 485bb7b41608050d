"""`remodel sweep`: flows around many sections at many conditions, in one table."""

import csv
import io
import json
import os
import signal
import subprocess
import time
import unittest

import harness
from crash_test import DiskTest
from harness import ProgramTest
from ranks import UnderMpirun

SMALL = {"points": 40, "farfield_radius": 10, "gradation": 1}
SWEEP = {"sections": [{"samples": 8, "around": "naca:0012", "range": 0.01}],
         "degree": 4, "conditions": {"mach": [0.3, 0.4], "alpha_deg": "0:2:1"},
         "mesh": SMALL, "surface_stations": 11, "chain": 2}


class SweepTest(ProgramTest):
    def sweep_file(self, **changes):
        self.write("s.json", json.dumps(SWEEP | changes))
        return "s.json"

    def rows(self, directory):
        return list(csv.DictReader(io.StringIO(self.path(f"{directory}/table.csv").read_text())))

    def tables(self, directory):
        return [self.path(f"{directory}/table{end}").read_bytes() for end in (".csv", ".h5")]


class Sweeps(SweepTest):
    def test_keys_and_rows(self):
        figures = self.figures("sweep", self.sweep_file(), "-o", "d")
        self.assertKeys(figures, "sweep sections chains planned flows found not_found flow_seconds mesh_seconds "
                                 "cold_seconds_estimate seconds stopped refused directory written warnings")
        self.assertEqual((figures["flows"], figures["found"], figures["chains"]), (48, 48, 4))
        rows = self.rows("d")
        self.assertEqual([(int(r["section"]), float(r["mach"]), float(r["asked"])) for r in rows],
                         [(s, m, a) for s in range(8) for m in (0.3, 0.4) for a in (0, 1, 2)])
        # A degree has a lift of 2 pi^2 / 180 / sqrt(1 - M^2) by Prandtl and Glauert, and a little more by thickness.
        for low, high in zip(rows[0::3], rows[1::3]):
            slope = float(high["cl"]) - float(low["cl"])
            expected = 0.10966 / (1 - float(low["mach"]) ** 2) ** 0.5
            self.assertGreater(slope, 0.9 * expected)
            self.assertLess(slope, 1.25 * expected)

    def test_the_column_store_has_the_same_flows(self):
        try:
            import h5py
            import numpy
        except ImportError:
            self.skipTest("needs h5py")
        self.succeed("sweep", self.sweep_file(), "-o", "d")
        rows = self.rows("d")
        with h5py.File(self.path("d/table.h5")) as file:
            self.assertEqual(file.attrs["format"], b"remodel sweep 1" if isinstance(file.attrs["format"], bytes)
                             else "remodel sweep 1")
            for name in ("mach", "alpha_deg", "cl", "cd", "cm", "residual"):
                self.assertEqual(file[f"flows/{name}"][:].tolist(), [float(r[name]) for r in rows])
            self.assertTrue(file["flows/converged"][:].all())
            self.assertEqual(file["sections/upper"].shape, (8, 11))
            self.assertEqual(file["surface/cp"].shape, (48, 22))
            # The lift is the pressure's: at 0 degrees the difference of both sides over x.
            first = numpy.array([float(r["alpha_deg"]) == 0 for r in rows])
            x, cp = file["surface/x"][:], file["surface/cp"][:]
            lifts = numpy.trapezoid(cp[:, 11:] - cp[:, :11], x, axis=1) if hasattr(numpy, "trapezoid") else \
                numpy.trapz(cp[:, 11:] - cp[:, :11], x, axis=1)
            numpy.testing.assert_allclose(lifts[first], file["flows/cl"][:][first], atol=0.02)
            self.assertEqual(json.loads(file["sweep"][0])["points"], 40)

    def test_fields_on_request(self):
        self.succeed("sweep", self.sweep_file(fields=True, conditions={"mach": 0.3, "alpha_deg": [0, 1.5]}), "-o", "d")
        names = sorted(path.name for path in self.path("d/fields").iterdir())
        self.assertEqual(names, [f"{s:06d}_M0.3_{a}.vtu" for s in range(8) for a in ("0", "1.5")])
        self.succeed("draw", "d/fields/000003_M0.3_1.5.vtu", "-o", "mach.png", "--color", "mach")
        self.refused("sweep", self.sweep_file(fields=False), "-o", "d", "--resume", names="fields")

    def test_threads_and_an_order_change_no_flow_beyond_its_mesh(self):
        self.succeed("sweep", self.sweep_file(), "-o", "a", "--threads", 1)
        self.succeed("sweep", "s.json", "-o", "b", "--threads", 3)
        self.assertEqual(self.tables("a"), self.tables("b"))
        self.succeed("sweep", self.sweep_file(order="random", chain=8), "-o", "c")
        for one, other in zip(self.rows("a"), self.rows("c")):
            self.assertAlmostEqual(float(one["cl"]), float(other["cl"]), delta=0.02)

    def test_what_is_killed_or_interrupted_is_gone_on_with_to_the_same_table(self):
        self.sweep_file(sections=[{"samples": 60, "around": "naca:0012", "range": 0.01}])
        self.succeed("sweep", "s.json", "-o", "whole")
        for name, number in (("killed", signal.SIGKILL), ("ended", signal.SIGINT)):
            process = subprocess.Popen([harness.PROGRAM, "sweep", "s.json", "-o", name, "--json"],
                                       cwd=self.path("."), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            deadline = time.monotonic() + 60
            while not list(self.path(".").glob(f"{name}/chains/*.cbor")) and time.monotonic() < deadline:
                time.sleep(0.005)
            process.send_signal(number)
            output = process.communicate(timeout=60)[0]
            done = len(list(self.path(name).glob("chains/*.cbor")))
            self.assertGreater(done, 0)
            if number == signal.SIGINT and process.returncode != 0:
                self.assertEqual(process.returncode, 3)
                self.assertEqual(json.loads(output)["stopped"], "interrupted")
            self.succeed("sweep", "s.json", "-o", name, "--resume")
            self.assertEqual(self.tables(name), self.tables("whole"))

    def test_a_finished_sweep_is_extended(self):
        self.succeed("sweep", self.sweep_file(), "-o", "d")
        before = self.rows("d")
        self.sweep_file(sections=[*SWEEP["sections"], "naca:2412"],
                        conditions={"mach": [0.3, 0.4], "alpha_deg": "0:3:1"})
        figures = self.figures("sweep", "s.json", "-o", "d", "--resume")
        self.assertEqual(figures["flows"], 9 * 2 * 4)
        after = {(r["shape"], r["mach"], r["asked"]): r for r in self.rows("d")}
        for row in before:
            self.assertEqual(after[row["shape"], row["mach"], row["asked"]], row)

    def test_files_that_are_no_sections_are_rows_that_say_so(self):
        self.path("sections").mkdir()
        self.write("sections/poem.dat", "a poem\nof two lines\n")
        self.succeed("fit", "naca:0012", "-o", "sections/good.json")
        self.sweep_file(sections=[{"directory": "sections"}], conditions={"mach": 0.3, "alpha_deg": 0})
        figures = self.figures("sweep", "s.json", "-o", "d", status=1)
        self.assertEqual([r["section"] for r in figures["refused"]], ["sections/poem.dat"])
        rows = self.rows("d")
        self.assertEqual([(r["shape"], r["status"]) for r in rows],
                         [("sections/good.json", "converged"), ("sections/poem.dat", "refused")])
        self.assertIn("poem.dat", rows[1]["reason"])
        self.assertEqual(rows[1]["cl"], "")

    def test_designs_of_a_run_are_sections(self):
        self.write("p.json", json.dumps({
            "airfoil": "naca:0012", "degree": 2, "symmetric": True, "mesh": {"points": 40, "farfield_radius": 10},
            "flow": [{"mach": 0.7, "alpha_deg": 0}], "objective": "drag",
            "constraints": [{"kind": "area", "of_start": 1}], "designer": {"evaluations": 4}}))
        self.succeed("design", "p.json", "-o", "run", status=3)  # it has four designs and no more
        figures = self.figures("sweep", self.sweep_file(sections=[{"designs": "run"}], conditions={"mach": 0.7, "cl": 0.1}),
                               "-o", "d")
        self.assertGreater(figures["sections"], 1)
        self.assertEqual(self.rows("d")[0]["shape"], "run#1")
        for row in self.rows("d"):
            self.assertAlmostEqual(float(row["cl"]), 0.1, delta=1e-6)

    def test_the_page(self):
        self.write("poem.dat", "a poem\nof two lines\n")
        self.succeed("sweep", self.sweep_file(sections=["naca:0012", "naca:2412", "poem.dat"]), "-o", "d", status=1)
        figures = self.figures("sweep", "report", "d")
        self.assertKeys(figures, "sweep sections planned flows found not_found with_warnings flow_seconds "
                                 "cold_seconds_estimate written")
        self.assertEqual((figures["found"], figures["not_found"]), (12, 6))
        page = self.path("d/report.html").read_text()
        for text in ("A sweep of 3 sections", "most lift", "naca:2412", "Polars", "poem.dat", "refused: 6"):
            self.assertIn(text, page)
        self.assertNotIn("http", page.replace("http://www.w3.org", ""))
        self.refused("sweep", "report", "none", names="none")


class Ranks(UnderMpirun, SweepTest):
    def setUp(self):
        super().setUp()
        self.require_ranks("sweep", self.sweep_file(sections=["naca:0012"]), "-o", "probe")
        self.sweep_file(sections=[{"samples": 40, "around": "naca:0012", "range": 0.01}])
        self.succeed("sweep", "s.json", "-o", "whole")

    def test_any_number_of_ranks_makes_one_table(self):
        for ranks in (1, 2, 4):
            process = self.start_ranks(ranks, (), "sweep", "s.json", "-o", ranks)
            message = process.communicate(timeout=120)[1]
            self.assertEqual(process.returncode, 0, message)
            self.assertEqual(self.tables(ranks), self.tables("whole"), f"{ranks} ranks")

    def test_work_of_a_killed_rank_is_done_again(self):
        process = self.start_ranks(3, ("--enable-recovery",), "sweep", "s.json", "-o", "d", "--rank-timeout", 3)
        deadline = time.monotonic() + 60
        while not list(self.path(".").glob("d/chains/*.cbor")) and time.monotonic() < deadline:
            time.sleep(0.005)
        self.kill_rank(process, 2)
        message = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 0, message)
        self.assertEqual(self.tables("d"), self.tables("whole"))

    def test_what_is_wrong_is_said_once(self):
        process = self.start_ranks(3, (), "sweep", "none.json", "-o", "d")
        message = process.communicate(timeout=120)[1]
        self.assertEqual(process.returncode, 2, message)
        self.assertEqual(message.count(b"remodel: error:"), 1, message)


class Disks(SweepTest, DiskTest):
    def test_a_disk_that_fills_up(self):
        self.sweep_file(sections=[{"samples": 40, "around": "naca:0012", "range": 0.01}])
        self.succeed("sweep", "s.json", "-o", "whole")
        self.mount("size=1m")
        self.fill(left=60_000)
        outcome = self.run_program("sweep", "s.json", "-o", "disk/s")
        self.assertEqual(outcome.status, 2, outcome)
        self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
        self.assertIn("disk/s/", outcome.stderr)
        self.assertFalse(list(self.path("disk/s").rglob("*.tmp")))
        self.path("disk/filler").unlink()
        self.succeed("sweep", "s.json", "-o", "disk/s", "--resume")
        self.assertEqual(self.tables("disk/s"), self.tables("whole"))

    def test_no_room_for_the_start(self):
        self.sweep_file()
        self.mount("size=16k")
        self.fill()
        self.refused("sweep", "s.json", "-o", "disk/s", names="disk/s")


class Refusals(SweepTest):
    def test_of_files_and_places(self):
        self.refused("sweep", names="SWEEP")
        self.refused("sweep", "none.json", "-o", "d", names="none.json")
        self.refused("sweep", self.sweep_file(sections=["naca:99999999"]), "-o", "d", names="section 1")
        self.refused("sweep", self.sweep_file(sections=["none.dat"]), "-o", "d", names="none.dat")
        self.refused("sweep", self.sweep_file(sections=[{"directory": "none"}]), "-o", "d", names="none")
        self.refused("sweep", self.sweep_file(colour="red"), "-o", "d", names="colour")
        self.assertFalse(self.path("d").exists())
        self.refused("sweep", self.sweep_file(), "-o", "d", "--resume", names="d/sweep.json")
        self.assertFalse(self.path("d").exists())
        self.path("full").mkdir()
        self.write("full/notes.txt", "mine")
        self.refused("sweep", "s.json", "-o", "full", names="full")
        self.assertEqual(os.listdir(self.path("full")), ["notes.txt"])

    def test_of_damaged_directories(self):
        self.succeed("sweep", self.sweep_file(), "-o", "d")
        self.refused("sweep", "s.json", "-o", "d", names="holds a sweep")
        self.refused("sweep", self.sweep_file(mesh=SMALL | {"points": 60}), "-o", "d", "--resume", names="points")
        self.sweep_file()
        tables = self.tables("d")
        file = self.path("d/chains/000002.cbor")
        good = file.read_bytes()
        for bad in (b"", good[:-20], b"\x00" * 50, good[:100] + b"\xff" + good[101:]):
            file.write_bytes(bad)
            self.refused("sweep", "s.json", "-o", "d", "--resume", names="d/chains/000002.cbor: is damaged")
        file.unlink()
        self.succeed("sweep", "s.json", "-o", "d", "--resume")
        self.assertEqual(self.tables("d"), tables)
        self.path("d/sweep.json").write_text(self.path("d/sweep.json").read_text().replace('"rows"', '"raws"'))
        self.refused("sweep", "s.json", "-o", "d", "--resume", names="d/sweep.json")


if __name__ == "__main__":
    unittest.main()
