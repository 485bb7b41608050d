#!/usr/bin/env python3
"""OpenFOAM in the loop of `remodel optimise`: drag over lift of one design, with walls that slip, by rhoSimpleFoam.

    remodel optimise --from naca:0012 --evaluate './solve.py {case} {result}' --time-limit 600 -o run

The case has its mesh and, from the second design on, the fields of the design before as its time 0. This program adds
system, constant, and at first the fields of `start`, which are also what it begins with again where the fields of the
design before lead nowhere. Drag without friction and shocks is an error of the mesh and the
scheme: it keeps the example short, not true.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
AREA = 0.08  # square chords: no airfoil with less is feasible


def environment():
    """Debian's programs find their settings by these."""
    found = dict(os.environ)
    found.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")
    return found


def converged(case):
    """Runs rhoSimpleFoam; its log, and what went wrong, or nothing."""
    file = case / "rhoSimpleFoam.log"
    try:
        with open(file, "w") as log:
            ended = subprocess.run(["rhoSimpleFoam", "-case", case], stdout=log, stderr=subprocess.STDOUT, env=environment())
    except OSError as problem:
        sys.exit(f"solve.py: rhoSimpleFoam cannot be started ({problem}): expected it in the PATH (Debian's package openfoam)")
    text = file.read_text(errors="replace")
    if ended.returncode != 0:
        return text, f"rhoSimpleFoam ended with status {ended.returncode}: {text[-300:]}"
    if "solution converged" not in text:
        return text, f"not converged after {iterations(text)} iterations"
    return text, None


def iterations(log):
    return len(re.findall(r"^Time = ", log, re.M))


def complete(case):
    """What a case needs besides its mesh; true where it has fields to start from."""
    for name in ("constant", "system"):
        shutil.copytree(HERE / name, case / name, dirs_exist_ok=True)
    warm = (case / "0").exists()
    if not warm:
        shutil.copytree(HERE / "start", case / "0")
    return warm


def begin_again(case):
    """Takes away what a run left, and the fields that it began with."""
    for found in list(case.iterdir()):
        if found.is_dir() and (found.name == "postProcessing" or re.fullmatch(r"[0-9.e+-]+", found.name)):
            shutil.rmtree(found)
    (case / "rhoSimpleFoam.log").rename(case / "rhoSimpleFoam.warm.log")
    shutil.copytree(HERE / "start", case / "0")


def coefficients(case):
    """The last row of the function object `forces`."""
    file = next((case / "postProcessing/forces").glob("*/coefficient.dat"))
    lines = file.read_text().splitlines()
    names = next(line for line in reversed(lines) if line.startswith("# Time")).lstrip("# ").split()
    return dict(zip(names, map(float, lines[-1].split())))


def airfoil_area(case):
    """The area that the patch `airfoil` encloses, by the lower edges of its faces."""
    mesh = case / "constant/polyMesh"
    numbers = lambda text: [float(word) for word in text.split()]
    points = [numbers(row) for row in re.findall(r"^\(([^()]+)\)$", (mesh / "points").read_text(), re.M)]
    faces = re.findall(r"^\d\(([\d ]+)\)$", (mesh / "faces").read_text(), re.M)
    entry = re.search(r"\bairfoil\s*{[^}]*nFaces\s+(\d+);\s*startFace\s+(\d+);", (mesh / "boundary").read_text())
    count, first = map(int, entry.groups())
    total = 0.0
    for face in faces[first:first + count]:
        a, b = (points[int(i)] for i in face.split()[:2])
        total += a[0] * b[1] - a[1] * b[0]
    return abs(total) / 2


def main(case, result):
    case = Path(case)
    warm = complete(case)
    log, problem = converged(case)
    retried = warm and problem is not None
    if retried:
        # Fields of another shape are no solution of this one: where they lead nowhere, uniform ones may.
        print(f"the warm start failed, now cold: {problem}", file=sys.stderr)
        begin_again(case)
        log, problem = converged(case)
    if problem:
        sys.exit(problem)
    last = coefficients(case)
    area = airfoil_area(case)
    Path(result).write_text(json.dumps({
        "objective": last["Cd"] / last["Cl"] if last["Cl"] > 0 else 1e3,
        "constraints": [AREA - area],
        "outputs": {"cl": last["Cl"], "cd": last["Cd"], "area": area, "iterations": iterations(log),
                    "warm": int(warm and not retried), "retried": int(retried)},
    }))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: solve.py CASE RESULT")
    main(*sys.argv[1:])
