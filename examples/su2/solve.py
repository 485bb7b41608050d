#!/usr/bin/env python3
"""SU2 in the loop of `remodel optimise`: the drag of one design at a fixed lift.

    remodel optimise --from naca:0012 --evaluate './solve.py drag.cfg {mesh} {state} {result}' --time-limit 600 -o run

The state is SU2's restart file of the design before, carried over to this mesh; what SU2 leaves takes its place, with the
angle of attack as one more column, which SU2 does not read: the next design begins at that angle. With `--snapshots 20` flow
and angle are combined of those of several designs. The program is SU2_CFD of the PATH, or the command in the variable SU2_CFD (`mpirun -n 4 SU2_CFD`, `srun -n 16 SU2_CFD`).
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


def setting(config, name):
    return re.search(rf"^\s*{name}\s*=\s*(.*?)\s*$", config, re.MULTILINE).group(1)


def alpha_of(state):
    """The angle of attack, in degrees, that a state was found at."""
    with open(state) as lines:
        names, first = csv.reader([next(lines), next(lines)], skipinitialspace=True)
    return float(first[names.index("AoA")])


def write_state(restart, alpha, state):
    """SU2's table of the flow with the angle of attack as its last column."""
    with open(restart) as lines, open(state, "w") as out:
        out.write(next(lines).rstrip() + ',"AoA"\n')
        out.writelines(f"{line.rstrip()}, {alpha!r}\n" for line in lines)


def configuration(config, mesh, state):
    """The case's configuration and its names of files: SU2 adds .csv to those of restart files itself."""
    warm = "YES" if state.exists() else "NO"
    if state.exists():
        config = re.sub(r"^\s*AOA\s*=.*$", f"AOA= {alpha_of(state)!r}", config, flags=re.MULTILINE)
    return config + f"""
MESH_FILENAME= {mesh.name}
MESH_FORMAT= SU2
RESTART_SOL= {warm}
SOLUTION_FILENAME= {state.stem}
RESTART_FILENAME= restart
CONV_FILENAME= history
"""


def history(file):
    """The rows of SU2's history, its names without quotes and blanks."""
    with open(file) as lines:
        rows = list(csv.reader(lines, skipinitialspace=True))
    names = [name.strip().strip('"').strip() for name in rows[0]]
    return [dict(zip(names, map(float, row))) for row in rows[1:]]


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
    directory = mesh.parent
    warm = state.exists()
    (directory / "case.cfg").write_text(configuration(config, mesh, state))
    command = shlex.split(os.environ.get("SU2_CFD", "SU2_CFD"))
    with open(directory / "su2.log", "w") as log:
        status = subprocess.run([*command, "case.cfg"], cwd=directory, stdout=log, stderr=subprocess.STDOUT).returncode
    if status != 0:
        sys.exit(f"SU2_CFD ended with status {status}: {(directory / 'su2.log').read_text()[-200:]}")
    rows = history(directory / "history.csv")
    last = rows[-1]
    if last["rms[Rho]"] > float(setting(config, "CONV_RESIDUAL_MINVAL")):
        sys.exit(f"not converged: rms[Rho] is {last['rms[Rho]']} after {len(rows)} iterations")
    write_state(directory / "restart.csv", last["AoA"], state)
    lift_error = abs(last["CL"] - float(setting(config, "TARGET_CL")))
    area = airfoil_area(mesh)
    Path(result).write_text(json.dumps({
        "objective": 1e4 * last["CD"],  # drag counts
        "constraints": [lift_error - LIFT_ERROR, AREA - area],
        "outputs": {"cl": last["CL"], "cd": last["CD"], "area": area, "alpha": last["AoA"], "iterations": len(rows),
                    "warm": int(warm)},
    }))


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit("usage: solve.py CONFIG MESH STATE RESULT")
    main(*sys.argv[1:])
