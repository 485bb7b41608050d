"""Someone else's solver in the loop: `remodel optimise --evaluate`, and the example of SU2 with a stand-in for SU2_CFD that
refuses what SU2 8.0.1 refuses (su2_stand_in.py)."""

import json
import os
import shutil
import sqlite3
import stat
import subprocess
import sys
import time
from pathlib import Path

import harness
from harness import SOURCE, ProgramTest

# Leaves x, y and a linear function as the state, and says what it found there.
RIDER = """import json, os, sys
mesh, design, state, result = sys.argv[1:5]
lines = iter(open(mesh).read().splitlines())
points = next([tuple(map(float, next(lines).split()[:2])) for _ in range(int(line.split("=")[1]))]
              for line in lines if line.startswith("NPOIN="))
linear = lambda p: 1 + 2 * p[0] - 3 * p[1]
outputs = {"warm": int(os.path.exists(state)), "points": len(points)}
if outputs["warm"]:
    rows = [list(map(float, line.split(","))) for line in open(state).read().splitlines()[1:]]
    assert [(int(row[0]), row[1], row[2]) for row in rows] == [(i, *p) for i, p in enumerate(points)]
    off = sorted(abs(row[3] - linear(p)) for row, p in zip(rows, points))
    outputs.update(median=off[len(off) // 2], largest=off[-1])
    assert all(abs(row[4] - 7) < 1e-13 for row in rows)
open(state, "w").write('"PointID","x","y","Linear","Seven"\\n' + "".join(
    f"{i}, {x!r}, {y!r}, {linear((x, y))!r}, 7\\n" for i, (x, y) in enumerate(points)))
json.dump({"objective": sum(a * a for a in json.load(open(design))), "outputs": outputs}, open(result, "w"))
"""

# A solver whose state is an affine function of the design, and says how far from it its start was.
AFFINE = """import json, os, sys
mesh, design, state, result = sys.argv[1:5]
points = next(int(line.split("=")[1]) for line in open(mesh) if line.startswith("NPOIN="))
d = json.load(open(design))
exact = [1 + sum((1 + (i + k) % 3) * a for k, a in enumerate(d)) for i in range(points)]
outputs = {"warm": int(os.path.exists(state))}
if outputs["warm"]:
    found = [float(line.split(",")[1]) for line in open(state).read().splitlines()[1:]]
    outputs["off"] = max(abs(a - b) for a, b in zip(found, exact))
open(state, "w").write('"PointID","Affine"\\n' + "".join(f"{i}, {a!r}\\n" for i, a in enumerate(exact)))
json.dump({"objective": d[0] ** 2, "outputs": outputs}, open(result, "w"))
"""

STAND_IN = SOURCE / "tests/cli/su2_stand_in.py"


class Loop(ProgramTest):
    def optimise(self, directory, command, *options, evaluations=20, sigma=0.005, points=40, status=0):
        return self.figures(
            "optimise", "--from", "naca:0012", "--evaluate", command, "--points", points, "--sigma", sigma,
            "--evaluations", evaluations, "--quiet", "-o", directory, *options, status=status)

    def rows(self, directory, query):
        with sqlite3.connect(self.path(directory) / "history.sqlite") as history:
            return history.execute(query).fetchall()

    def outputs(self, directory):
        return [json.loads(text) for text, in self.rows(directory, "select outputs from evaluations")]


class SolverInTheLoop(Loop):
    def test_states_ride_to_the_mesh_of_the_next_design(self):
        self.write("rider.py", RIDER)
        command = "python3 rider.py '{mesh}' {design} \"{state}\" {result}"
        figures = self.optimise("a run", command)
        self.assertEqual(figures["failed_evaluations"], 0, figures["detail"])
        outputs = self.outputs("a run")
        self.assertEqual([row["warm"] for row in outputs], [0] + [1] * 19)
        for row in outputs[1:]:
            self.assertLess(row["median"], 1e-13)  # what has not moved, and what is new, is exact
            self.assertLess(row["largest"], 0.2)  # what moved along has kept its value
        self.assertFalse((self.path("a run") / "evaluations").exists())

    def test_binary_states_and_other_meshes(self):
        self.write("binary.py", """import json, struct, sys
mesh, native, state, result = sys.argv[1:5]
assert open(native, "rb").read(4) == b"\\x89HDF"
points = next(int(line.split("=")[1]) for line in open(mesh) if line.startswith("NPOIN="))
try: found = struct.unpack_from("<5i", open(state, "rb").read())
except FileNotFoundError: found = None
assert found in (None, (535532, 1, points, 0, 0))
open(state, "wb").write(struct.pack("<5i", 535532, 1, points, 0, 0) + b"Density".ljust(33, b"\\0") + struct.pack(f"<{points}d", *[1.0] * points))
json.dump({"objective": 1, "outputs": {"warm": int(found is not None)}}, open(result, "w"))
""")
        self.optimise("run", "python3 binary.py {mesh} {mesh.vtkhdf} {state.dat} {result}", "--workers", 2, evaluations=10)
        self.assertEqual(sum(row["warm"] for row in self.outputs("run")), 8)  # but each worker's first

    def test_resumed_runs_have_the_states_they_stopped_with(self):
        self.write("rider.py", RIDER)
        command = "python3 rider.py {mesh} {design} {state} {result}"
        self.optimise("whole", command)
        self.optimise("parts", command, evaluations=7)
        self.optimise("parts", command, "--resume", evaluations=20)
        query = "select coefficients, objective, outputs from evaluations"
        self.assertEqual(self.rows("whole", query), self.rows("parts", query))

    def test_earlier_states_of_one_connectivity_are_combined(self):
        self.write("affine.py", AFFINE)
        command = "python3 affine.py {mesh} {design} {state} {result}"
        held = {"sigma": 1e-4, "evaluations": 30}
        self.optimise("last", command, "--strategy", "reference", **held)
        self.optimise("combined", command, "--strategy", "reference", "--snapshots", 20, **held)
        last, combined = self.outputs("last"), self.outputs("combined")
        self.assertNotIn("state_snapshots", last[-1])
        self.assertEqual([row["state_snapshots"] for row in combined], [min(i, 20) for i in range(30)])
        for i in range(2, 14):  # the nearest one of several, and some of the way from there
            self.assertLess(combined[i]["state_misfit"], 1)
        for before, now in zip(last[14:], combined[14:]):  # thirteen designs span all twelve parameters
            self.assertLess(now["state_misfit"], 1e-2)
            self.assertLess(now["off"], before["off"] / 20)

    def test_a_replacement_ends_what_is_combined(self):
        self.write("affine.py", AFFINE)
        command = "python3 affine.py {mesh} {design} {state} {result}"
        self.optimise("run", command, "--snapshots", 5, sigma=0.02)
        steps = self.rows("run", "select connected, triangles_before, triangles, outputs from evaluations")
        same = [before == connected == after for connected, before, after, _ in steps]
        self.assertIn(False, same[1:])
        for now, outputs in zip(same, [json.loads(row[3]) for row in steps]):
            if not now:
                self.assertEqual(outputs["state_snapshots"], 0)

    def test_resumed_runs_combine_the_same_states(self):
        self.write("affine.py", AFFINE)
        command = "python3 affine.py {mesh} {design} {state} {result}"
        options = ("--strategy", "reference", "--snapshots", 4)
        self.optimise("whole", command, *options, evaluations=12, sigma=1e-4)
        self.optimise("parts", command, *options, evaluations=7, sigma=1e-4)
        self.optimise("parts", command, *options, "--resume", evaluations=12, sigma=1e-4)
        query = "select coefficients, objective, outputs from evaluations"
        self.assertEqual(self.rows("whole", query), self.rows("parts", query))
        self.refused("optimise", "--from", "naca:0012", "--evaluate", command, "--points", 40, "--sigma", 1e-4, "--strategy",
                     "reference", "--resume", "--evaluations", 20, "-o", "parts", names="options")

    def test_failures_are_infeasible_designs_and_leave_their_directory(self):
        self.write("fails.sh", """case "$3" in */000002/*) sleep 60 & wait;; */000004/*) echo no licence >&2; exit 3;;
*/000006/*) echo 'nothing of the kind' > "$2";; esac
echo '{"objective": 1}' > "$3"
""")
        figures = self.optimise("run", "sh fails.sh {mesh} {state} {result}", "--time-limit", 0.5, evaluations=8)
        self.assertEqual(figures["failed_evaluations"], 3)
        self.assertEqual(
            sorted(path.name for path in (self.path("run") / "evaluations").iterdir()), ["000002", "000004", "000006"])
        self.assertIn("no licence", (self.path("run") / "evaluations/000004/errors").read_text())
        details = [detail for detail, in self.rows("run", "select detail from evaluations order by evaluation")]
        self.assertIn("time limit of 0.5 seconds", details[1])
        self.assertIn("ended with status 3: no licence", details[3])
        self.assertIn("state.csv", details[5])
        self.optimise("run", "echo '{\"objective\": 1}'; true {directory}", "--overwrite", "--keep-evaluations", "all",
                      evaluations=3)
        self.assertEqual(len(list((self.path("run") / "evaluations").iterdir())), 3)

    def test_files_that_no_format_has_are_refused(self):
        run = ["optimise", "--from", "naca:0012", "--points", 40, "-o", "run", "--evaluate"]
        self.refused(*run, "true {mesh.xyz}", names=".xyz")
        self.refused(*run, "true {state} {state.dat}", names="state")
        self.refused(*run, "true {mesh} {results}", names="found {results}, expected one of {mesh}, {design}, {state}, {result}")
        for near in ("{mehs}", "{dsign}", "{state.cvs}", "{cases}", "{meshes}"):
            self.refused(*run, "true {mesh} " + near, names=f"found {near}, expected one of")
        awk = "echo '{\"objective\": 1}' | awk '{print}'; : {mesh} {name_of} {a,b}"
        self.assertEqual(self.optimise("awk", awk, evaluations=2)["failed_evaluations"], 0)
        shell = "value=1; echo \"{\\\"objective\\\": ${value}}\" | awk '{print $1, $2}'; true {mesh}"
        self.assertEqual(self.optimise("shell", shell, evaluations=2)["failed_evaluations"], 0)

    def test_a_run_whose_evaluations_all_failed_says_so(self):
        outcome = self.succeed("optimise", "--from", "naca:0012", "--points", 40, "--evaluations", 3, "--quiet", "-o", "run",
                               "--evaluate", "no-such-program {mesh}", status=1)
        self.assertIn("all 3 evaluations failed", outcome.stderr)
        self.assertIn("no-such-program", outcome.stderr)

    def test_threads_do_not_take_one_anothers_directories(self):
        self.write("constant.sh", "echo '{\"objective\": 1}' > \"$1\"\n")
        for name, threads in (("alone", 1), ("together", 2)):
            figures = self.optimise(name, "sh constant.sh {result}", "--workers", 2, "--threads", threads,
                                    evaluations=600, sigma=0.02, points=20)
            self.assertEqual(figures["failed_evaluations"], 0, figures["detail"])
        query = "select coefficients, objective, triangles from evaluations order by evaluation"
        self.assertEqual(self.rows("alone", query), self.rows("together", query))

    def test_states_ride_to_meshes_that_a_strategy_generated(self):
        self.write("rider.py", RIDER)
        figures = self.optimise("run", "python3 rider.py {mesh} {design} {state} {result}", "--strategy", "regenerate",
                                evaluations=40, sigma=0.02)
        self.assertEqual(figures["failed_evaluations"], 0, figures["detail"])
        self.assertGreater(figures["refreshes"], 0)
        self.assertEqual([row["warm"] for row in self.outputs("run")], [0] + [1] * 39)

    def test_a_solver_that_outlived_its_run_does_not_answer_for_the_next(self):
        self.write("slow.sh", """if [ -e second ]; then
  echo > written; while [ ! -e orphan ]; do sleep 0.01; done; [ -e "$1" ] || echo '{"objective": 222}' > "$1"; exit
fi
echo > first; while [ ! -e written ]; do sleep 0.01; done
echo '{"objective": 111}' > "$1"; echo > orphan
""")
        run = ["optimise", "--from", "naca:0012", "--points", "40", "--evaluations", "1", "--quiet", "-o", "run", "--evaluate",
               "sh slow.sh {result}"]
        killed = subprocess.Popen([harness.PROGRAM, *run], cwd=self.directory, stderr=subprocess.DEVNULL)
        while not self.path("first").exists():
            time.sleep(0.01)
        killed.kill()
        killed.wait()
        self.write("second", "")
        self.assertEqual(self.figures(*run, "--resume")["objective"], 222)
        self.assertFalse((self.path("run") / "evaluations").exists())


class Su2(Loop):
    def copy_example(self):
        shutil.copytree(SOURCE / "examples/su2", self.directory, dirs_exist_ok=True)

    def install_su2(self):
        self.write("SU2_CFD", STAND_IN.read_bytes())
        self.path("SU2_CFD").chmod(stat.S_IRWXU)
        before = os.environ["PATH"]
        os.environ["PATH"] = f"{self.directory}{os.pathsep}{before}"
        self.addCleanup(os.environ.__setitem__, "PATH", before)

    def test_the_example_starts_from_the_design_before(self):
        self.copy_example()
        self.install_su2()
        figures = self.optimise("run", "./solve.py drag.cfg {mesh} {state} {result}", "--time-limit", 60,
                                "--keep-evaluations", "all", evaluations=6)
        self.assertEqual(figures["failed_evaluations"], 0, figures["detail"])
        outputs = self.outputs("run")
        for row in outputs:
            self.assertAlmostEqual(row["cd"], row["area"] ** 2 + 0.01 * 0.5**2, delta=1e-5)
            self.assertAlmostEqual(row["cl"], 0.5, delta=2e-5)
            self.assertAlmostEqual(row["cl"], 3 * row["area"] + 0.11 * row["alpha"] + 0.002 * row["alpha"] ** 2, delta=1e-6)
            self.assertAlmostEqual(row["slope"], 0.11 + 0.004 * row["alpha"], delta=0.003)
        self.assertEqual([row["warm"] for row in outputs], [0] + [1] * 5)
        self.assertEqual([row["retried"] for row in outputs], [0] * 6)
        self.assertLess(max(row["iterations"] for row in outputs[1:]), outputs[0]["iterations"])
        for i, row in enumerate(outputs):  # each design begins at the angle and with the slope of the one before
            state = (self.path("run") / f"evaluations/{i + 1:06}/state.csv").read_text().splitlines()
            self.assertEqual(state[0].split(",")[-2:], ['"AoA"', '"CL_AoA"'])
            self.assertEqual([float(word) for word in state[1].split(",")[-2:]], [row["alpha"], row["slope"]])

    def test_driving_the_angle_from_outside_costs_less_than_the_fixed_lift_of_su2(self):
        """The same designs, warm: at least a third less, by the stand-in, whose fixed lift goes as that of SU2 does."""
        self.copy_example()
        self.install_su2()
        self.write("fixed.py", """import json, re, shutil, subprocess, sys
from pathlib import Path
mesh, state, result = map(Path, sys.argv[1:])
config = Path("drag.cfg").read_text().replace("FIXED_CL_MODE= NO", "FIXED_CL_MODE= YES\\nUPDATE_AOA_ITER_LIMIT= 100")
warm = state.exists()
if warm: shutil.copy(state, mesh.parent / "start.csv")
(mesh.parent / "case.cfg").write_text(config + f\"\"\"MESH_FILENAME= mesh.su2
RESTART_SOL= {'YES' if warm else 'NO'}
SOLUTION_FILENAME= start
RESTART_FILENAME= restart
CONV_FILENAME= history
\"\"\")
subprocess.run(["SU2_CFD", "case.cfg"], cwd=mesh.parent, check=True, stdout=subprocess.DEVNULL)
shutil.copy(mesh.parent / "restart.csv", state)
rows = (mesh.parent / "history.csv").read_text().splitlines()
result.write_text(json.dumps({"objective": 1e4 * float(rows[-1].split(",")[2]), "outputs": {"iterations": len(rows) - 1}}))
""")
        totals = []
        for name, command in (("ours", "./solve.py drag.cfg {mesh} {state} {result}"), ("su2", "python3 fixed.py {mesh} {state} {result}")):
            figures = self.optimise(name, command, evaluations=4)
            self.assertEqual(figures["failed_evaluations"], 0, figures["detail"])
            totals.append(sum(row["iterations"] for row in self.outputs(name)[1:]))
        self.assertLess(totals[0], 0.67 * totals[1])

    def test_a_state_that_leads_nowhere_is_left(self):
        self.copy_example()
        self.install_su2()
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "mesh.su2")
        points = int(next(line for line in self.path("mesh.su2").read_text().splitlines() if line.startswith("NPOIN")).split("=")[1])
        head = '"PointID","x","y","Density","Momentum_x","Momentum_y","Energy","AoA","CL_AoA"'
        self.write("state.csv", head + "\n" + "".join(f"{i}, 0, 0, 1, 0, 0, 1, 2.0, 0.1\n" for i in range(points)))
        done = subprocess.run(["./solve.py", "drag.cfg", "mesh.su2", "state.csv", "result.json"], cwd=self.directory,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the warm start failed, now cold: SU2_CFD ended with status 1", done.stderr)
        outputs = json.loads(self.path("result.json").read_text())["outputs"]
        self.assertEqual((outputs["warm"], outputs["retried"]), (0, 1))

    def test_without_a_solver_the_examples_say_so_in_a_sentence(self):
        self.copy_example()
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "mesh.su2")
        shutil.copytree(SOURCE / "examples/openfoam", self.path("foam"))
        self.path("case").mkdir()
        self.write("not_executable", "")
        environment = {**os.environ, "PATH": "/nowhere"}
        environment.pop("SU2_CFD", None)
        python = sys.executable
        su2 = [python, "solve.py", "drag.cfg", "mesh.su2", "state.csv", "result.json"]
        for command, added, part in ((su2, {}, "SU2_CFD cannot be started"),
                                     (su2, {"SU2_CFD": "./not_executable -n 4"}, "not_executable -n 4 cannot be started"),
                                     (su2, {"SU2_CFD": ""}, "cannot be started"),
                                     ([python, "foam/solve.py", "case", "result.json"], {}, "rhoSimpleFoam cannot be started")):
            done = subprocess.run(command, cwd=self.directory, env={**environment, **added}, capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, "^solve.py: .*" + part)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertFalse(self.path("result.json").exists())
        done = subprocess.run([python, "solve.py", "no.cfg", "mesh.su2", "state.csv", "result.json"], cwd=self.directory,
                              capture_output=True, text=True)
        self.assertRegex(done.stderr, "^solve.py: .*no.cfg")
        self.write("short.cfg", self.path("drag.cfg").read_text().replace("TARGET_CL= 0.5\n", ""))
        done = subprocess.run([python, "solve.py", "short.cfg", "mesh.su2", "state.csv", "result.json"], cwd=self.directory,
                              env={**environment, "SU2_CFD": f"{python} {STAND_IN}"}, capture_output=True, text=True)
        self.assertEqual(done.stderr, "solve.py: TARGET_CL is not in the configuration, which solve.py needs\n")

    def test_the_stand_in_refuses_what_su2_refuses(self):
        """Otherwise the tests above would pass cases that the program refuses."""
        self.copy_example()
        self.succeed("mesh", "naca:0012", "--points", 40, "-o", "mesh.su2")
        good = self.path("drag.cfg").read_text() + (
            "MESH_FILENAME= mesh.su2\nRESTART_SOL= NO\nSOLUTION_FILENAME= start\nRESTART_FILENAME= restart\nCONV_FILENAME= history\n")

        def status(text):
            self.write("case.cfg", text)
            done = subprocess.run([sys.executable, STAND_IN, "case.cfg"], cwd=self.directory, capture_output=True, text=True)
            self.assertEqual(done.stderr, "")
            return done.returncode, done.stdout

        self.assertEqual(status(good)[0], 0)
        for old, new, part in (("SOLVER= EULER\n", "", "SOLVER must be"),
                               ("MACH_NUMBER= 0.73", "MACH= 0.73", "invalid option name"),
                               ("AOA= 2.0", "AOA= 2.0\nAOA= 3.0", "appears twice"),
                               ("AOA= 2.0", "AOA= two", "improper option value"),
                               ("AOA= 2.0", "AOA 2.0", "no = sign"),
                               ("AOA= 2.0", "AOA=", "no value assigned"),
                               ("ITER= 5000", "ITER= 5e3", "unsigned long"),
                               ("MUSCL_FLOW= YES", "MUSCL_FLOW= TRUE", "bool"),
                               ("SLOPE_LIMITER_FLOW= NONE", "SLOPE_LIMITER_FLOW= VAN_ALBADA", "invalid option value"),
                               ("CONV_NUM_METHOD_FLOW= ROE", "CONV_NUM_METHOD_FLOW= ROE2", "invalid option value"),
                               ("MARKER_EULER= ( airfoil )", "MARKER_EULER= ( wing )", "definition for marker airfoil"),
                               ("MARKER_PLOTTING= ( airfoil )", "MARKER_PLOTTING= ( wing )", "no marker wing"),
                               ("RMS_RES", "RMS_REST", "does not exist"),
                               ("= mesh.su2", "= other.su2", "Error opening"),
                               ("RESTART_SOL= NO", "RESTART_SOL= YES", "not found")):
            self.assertIn(old, good)
            code, text = status(good.replace(old, new, 1))
            self.assertEqual(code, 1, new)
            self.assertIn(part, text)
        restart = self.path("restart.csv").read_text()
        warm = good.replace("RESTART_SOL= NO", "RESTART_SOL= YES")
        self.write("start.csv", restart)
        self.assertEqual(status(warm)[0], 0)
        self.write("start.csv", restart.rsplit("\n", 2)[0] + "\n")
        self.assertIn("does not match the mesh", status(warm)[1])
        self.write("start.csv", restart.replace("Momentum_x", "Velocity_x"))
        self.assertIn("other columns", status(warm)[1])

    def test_the_table_of_iterations(self):
        self.write("SU2_CFD", STAND_IN.read_bytes())
        self.path("SU2_CFD").chmod(stat.S_IRWXU)
        table = [sys.executable, SOURCE / "scripts/su2-table", "--program", harness.PROGRAM, "--points", "40", "--designs", "3",
                 "--cases", "0.5:1e-3"]
        done = subprocess.run([*table, "--su2", self.path("SU2_CFD")], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        heads = [head.strip() for head in lines[-4].replace("\\|", "").split("|")[1:-1]]
        self.assertEqual(heads, ["Mach", "sigma of each coefficient", "scheme", "dCL", "cold", "fresh", "living", "snapshots"])
        rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines[-2:]]
        self.assertEqual([row[2] for row in rows], ["ROE", "JST"])
        for row in rows:
            self.assertTrue(1e-6 < float(row[3]) < 0.01, row)  # three times the change of area
            cold, fresh, living, combined = (int(cell.split("(")[0]) for cell in row[4:])
            self.assertLess(combined, fresh)
            self.assertLess(living, fresh)
            self.assertLess(fresh, cold)
        unknown = subprocess.run([*table, "--schemes", "HLL"], capture_output=True, text=True)
        self.assertEqual(unknown.returncode, 2)
        self.assertIn("found HLL, expected ROE or JST", unknown.stderr)
        skipped = subprocess.run([*table, "--su2", "no-such-program"], capture_output=True, text=True)
        self.assertEqual((skipped.returncode, skipped.stdout), (77, ""))
        self.assertIn("skipped: no-such-program is not found", skipped.stderr)

    def test_the_job_file_goes_on_where_the_job_before_ended(self):
        self.copy_example()
        shutil.copy(SOURCE / "examples/solver.slurm", self.directory)
        # srun, as far as the job file uses it: the command with its ranks, of which the stand-in needs one.
        self.write("srun", """#!/bin/sh
test "$1 $2" = "--exact -n" || exit 9
echo "$3" >> "$RANKS_SEEN"
shift 3
exec "$@"
""")
        self.write("SU2_CFD", STAND_IN.read_bytes())
        for name in ("srun", "SU2_CFD"):
            self.path(name).chmod(stat.S_IRWXU)
        self.path("remodel").symlink_to(Path(harness.PROGRAM).resolve())
        job = {**os.environ, "PATH": f"{self.directory}{os.pathsep}{os.environ['PATH']}", "SLURM_NTASKS": "8", "RANKS": "4",
               "SLURM_SUBMIT_DIR": str(self.directory), "RANKS_SEEN": str(self.path("ranks"))}
        job.pop("SU2_CFD", None)
        for evaluations in (2, 4):
            done = subprocess.run(["bash", "solver.slurm"], cwd=self.directory, env={**job, "EVALUATIONS": str(evaluations)},
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
        ranks = self.path("ranks").read_text().split()  # of several runs of SU2 for each design
        self.assertEqual(set(ranks), {"4"})
        self.assertGreater(len(ranks), 4)
        outputs = self.outputs("run")
        self.assertEqual(len(outputs), 4)
        self.assertGreater(sum(row["warm"] for row in outputs), 1)
        self.assertEqual({worker for worker, in self.rows("run", "select worker from evaluations")}, {1, 2})
        small = subprocess.run(["bash", "solver.slurm"], cwd=self.directory, env={**job, "SLURM_NTASKS": "3"},
                               capture_output=True, text=True)
        self.assertEqual(small.returncode, 2)
        self.assertIn("expected 4 or more", small.stderr)

    def test_the_example_with_su2_itself(self):
        if shutil.which("SU2_CFD") is None:
            self.skipTest("SU2_CFD is not in the PATH")
        self.copy_example()
        figures = self.optimise("run", "./solve.py drag.cfg {mesh} {state} {result}", "--time-limit", 500, evaluations=2)
        self.assertEqual(figures["failed_evaluations"], 0, figures["detail"])
        self.assertEqual([row["warm"] for row in self.outputs("run")], [0, 1])
