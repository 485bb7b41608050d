"""A sweep of airfoils as a small table: a line a section, its coefficients, then lift, drag and moment of each flow.

    remodel sweep examples/sweep/thousand.json -o thousand
    python3 examples/sweep/condense.py thousand/table.h5 python/notebooks/thousand.csv

Sections of which a flow was not found are left out.
"""

import json
import sys

import h5py
import numpy as np


def main(file, table):
    with h5py.File(file) as store:
        airfoils = [json.loads(text) if text else None for text in store["sections/airfoil"][:]]
        section, alpha = store["flows/section"][:], store["flows/alpha_deg"][:]
        good = store["flows/converged"][:] == 1
        values = np.column_stack([store[f"flows/{name}"][:] for name in ("cl", "cd", "cm")])
    angles = np.unique(alpha[good])
    lines = []
    for i, airfoil in enumerate(airfoils):
        mine = good & (section == i)
        if mine.sum() != len(angles):
            continue
        flows = values[mine][np.argsort(alpha[mine])]
        lines.append(np.concatenate([airfoil["upper"], airfoil["lower"], flows.ravel()]))
    sides = [f"{side}{k}" for side in ("upper", "lower") for k in range(len(airfoil["upper"]))]
    names = sides + [f"{name}_{angle:g}" for angle in angles for name in ("cl", "cd", "cm")]
    np.savetxt(table, lines, fmt="%.6g", delimiter=",", header=",".join(names), comments="")
    print(f"{len(lines)} of {len(airfoils)} sections")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
