#!/usr/bin/env python3
"""SU2 in the loop of `remodel optimise`: the drag of one design at a fixed lift.

    remodel optimise --from naca:0012 --evaluate './solve.py drag.cfg {mesh} {state} {result}' --time-limit 600 -o run

The state is SU2's restart file of the design before, carried over to this mesh, with two more columns, which SU2 does not
read: the angle of attack that it was found at, and the slope of lift by the angle. A design is a few runs of SU2, each from
the state that the one before left, at an angle that a secant makes of the lift before: at first only as far as the lift has to
be known for the next angle, then to the residual of the configuration. With `--snapshots 20` flow, angle and slope are combined
of those of several designs. Where a carried state leads nowhere, the design begins once more without it. The program is SU2_CFD
of the PATH, or the command in the variable SU2_CFD (`mpirun -n 4 SU2_CFD`, `srun -n 16 SU2_CFD`).
"""

import csv
import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

AREA = 0.08  # square chords: no airfoil with less is feasible
LIFT_ERROR = 1e-3
LIFT_TOLERANCE = 2e-5  # of the last run: a small part of LIFT_ERROR, so that drag is that of the lift asked for
FIRST_RESIDUALS = (3.0, 1.5)  # decades above the last one: runs that only find the angle
MOST_RUNS = 12


class Failure(Exception):
    """A sentence."""


class Missing(Failure):
    """There is no SU2."""


def setting(config, name):
    found = re.search(rf"^\s*{name}\s*=\s*(.*?)\s*$", config, re.MULTILINE)
    if not found:
        raise Failure(f"{name} is not in the configuration, which solve.py needs")
    return found.group(1)


def changed(config, **settings):
    """The configuration with other values, each option once: SU2 refuses one that appears twice."""
    for name, value in settings.items():
        config = re.sub(rf"^\s*{name}\s*=.*\n", "", config, flags=re.MULTILINE) + f"{name}= {value}\n"
    return config


def angle_of(state):
    """The angle of attack, in degrees, that a state was found at, and the slope of its lift."""
    with open(state) as lines:
        names, first = csv.reader([next(lines), next(lines)], skipinitialspace=True)
    return [float(first[names.index(name)]) for name in ("AoA", "CL_AoA")]


def write_state(restart, alpha, slope, state):
    """SU2's table of the flow with the angle of attack and the slope of lift as its last columns."""
    with open(restart) as lines, open(state, "w") as out:
        out.write(next(lines).rstrip() + ',"AoA","CL_AoA"\n')
        out.writelines(f"{line.rstrip()}, {alpha!r}, {slope!r}\n" for line in lines if line.strip())


def history(file):
    """The rows of SU2's history, its names without quotes and blanks."""
    with open(file) as lines:
        rows = list(csv.reader(lines, skipinitialspace=True))
    names = [name.strip().strip('"').strip() for name in rows[0]]
    return [dict(zip(names, map(float, row))) for row in rows[1:]]


class Case:
    """Runs of SU2 in the directory of one evaluation."""

    def __init__(self, config, mesh):
        self.config, self.directory = config, mesh.parent
        self.names = {"MESH_FILENAME": mesh.name, "MESH_FORMAT": "SU2", "SOLUTION_FILENAME": "start",
                      "RESTART_FILENAME": "restart", "CONV_FILENAME": "history"}
        self.last = float(setting(config, "CONV_RESIDUAL_MINVAL"))
        self.runs, self.iterations = 0, 0

    def start_from(self, state):
        (self.directory / "start.csv").write_bytes(state.read_bytes())

    def run(self, alpha, residual):
        """The last row of SU2's history at that angle, from start.csv where there is one, whose place the result takes."""
        start, restart, table = (self.directory / name for name in ("start.csv", "restart.csv", "history.csv"))
        settings = self.names | {"AOA": repr(alpha), "CONV_RESIDUAL_MINVAL": residual,
                                 "RESTART_SOL": "YES" if start.exists() else "NO"}
        (self.directory / "case.cfg").write_text(changed(self.config, **settings))
        for file in (restart, table):
            file.unlink(missing_ok=True)
        self.call()
        if not (restart.exists() and table.exists()):
            raise Failure(f"SU2_CFD left no {'history.csv' if restart.exists() else 'restart.csv'}: {self.log()}")
        rows = history(table)
        missing = {"rms[Rho]", "CL", "CD"} - set(rows[-1] if rows else ())
        if missing:
            raise Failure(f"history.csv has no {', '.join(sorted(missing))}")
        self.runs, self.iterations = self.runs + 1, self.iterations + len(rows)
        if not rows[-1]["rms[Rho]"] <= residual:
            raise Failure(f"not converged: rms[Rho] is {rows[-1]['rms[Rho]']} after {len(rows)} iterations")
        restart.replace(start)
        return rows[-1]

    def call(self):
        command = shlex.split(os.environ.get("SU2_CFD", "SU2_CFD"))
        try:
            with open(self.directory / "su2.log", "w") as log:
                status = subprocess.run([*command, "case.cfg"], cwd=self.directory, stdout=log, stderr=subprocess.STDOUT).returncode
        except (OSError, IndexError) as problem:
            raise Missing(f"{' '.join(command) or 'an empty command'} cannot be started ({problem}): expected SU2_CFD in the "
                          "PATH, or its command in the variable SU2_CFD") from None
        if status != 0:
            raise Failure(f"SU2_CFD ended with status {status}: {self.log()}")

    def log(self):
        return (self.directory / "su2.log").read_text(errors="replace")[-300:].strip()

    def at_lift(self, alpha, slope):
        """The last row, the angle and the slope: from a guess of the last two."""
        target = float(setting(self.config, "TARGET_CL"))
        residuals = [self.last + above for above in FIRST_RESIDUALS]
        before = None
        for run in range(MOST_RUNS):
            row = self.run(alpha, residuals[run] if run < len(residuals) else self.last)
            if before is not None and abs(alpha - before[0]) > 1e-3:
                secant = (row["CL"] - before[1]) / (alpha - before[0])
                if 1 / 3 < secant / slope < 3:  # otherwise lift is not yet known well enough
                    slope = secant
            miss = target - row["CL"]
            if run >= len(residuals) and abs(miss) <= LIFT_TOLERANCE:
                return row, alpha, slope
            before = (alpha, row["CL"])
            if run < len(residuals) or abs(miss) > LIFT_TOLERANCE:
                alpha += max(-2.0, min(2.0, miss / slope))
        raise Failure(f"no angle found: CL is {row['CL']} after {self.runs} runs")


def solve(case, state):
    """What Case.at_lift() gives, whether the state was of use, and whether it was tried in vain."""
    first = float(setting(case.config, "AOA")), float(setting(case.config, "DCL_DALPHA"))
    if not state.exists():
        return *case.at_lift(*first), True, False
    try:
        case.start_from(state)
        return *case.at_lift(*angle_of(state)), False, False
    except Missing:
        raise
    except Failure as problem:
        # The state of another shape is no solution of this one: where it leads nowhere, an undisturbed stream may.
        print(f"the warm start failed, now cold: {problem}", file=sys.stderr)
        (case.directory / "start.csv").unlink(missing_ok=True)
        return *case.at_lift(*first), True, True


def airfoil_area(mesh):
    """The area that the marker `airfoil` encloses, by its edges."""
    lines = iter(mesh.read_text().splitlines())
    points, edges = [], []
    for line in lines:
        if line.startswith("NPOIN="):
            points = [tuple(map(float, next(lines).split()[:2])) for _ in range(int(line.split("=")[1].split()[0]))]
        elif line.startswith("MARKER_TAG=") and line.split("=")[1].strip() == "airfoil":
            count = int(next(lines).split("=")[1])
            edges = [tuple(map(int, next(lines).split()[1:3])) for _ in range(count)]
    cross = (points[a][0] * points[b][1] - points[a][1] * points[b][0] for a, b in edges)
    return abs(sum(cross)) / 2


def main(config_file, mesh, state, result):
    config = Path(config_file).read_text()
    mesh, state = Path(mesh), Path(state)
    case = Case(config if config.endswith("\n") else config + "\n", mesh)
    row, alpha, slope, cold, retried = solve(case, state)
    write_state(case.directory / "start.csv", alpha, slope, state)
    lift_error = abs(row["CL"] - float(setting(config, "TARGET_CL")))
    area = airfoil_area(mesh)
    Path(result).write_text(json.dumps({
        "objective": 1e4 * row["CD"],  # drag counts
        "constraints": [lift_error - LIFT_ERROR, AREA - area],
        "outputs": {"cl": row["CL"], "cd": row["CD"], "area": area, "alpha": alpha, "slope": slope,
                    "iterations": case.iterations, "runs": case.runs, "warm": int(not cold), "retried": int(retried)},
    }))


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit("usage: solve.py CONFIG MESH STATE RESULT")
    try:
        main(*sys.argv[1:])
    except (Failure, OSError) as problem:
        sys.exit(f"solve.py: {problem}")
