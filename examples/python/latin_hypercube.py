"""A Latin hypercube of sections and conditions into one array file.

    python3 latin_hypercube.py [FILE.npz]

remodel.sweep() orders the sections so that neighbours are alike, and finds each flow from the one before.
"""

import sys

import numpy as np

import remodel


def main(file="flows.npz", sections=30, conditions=4, points=100):
    result = remodel.sweep({
        "sections": [{"samples": sections, "around": "rae2822", "range": 0.02, "method": "latin-hypercube"}],
        "degree": 5,
        "conditions": {"samples": conditions, "mach": [0.2, 0.5], "alpha_deg": [0, 4], "method": "latin-hypercube"},
        "mesh": {"points": points},
        "surface_stations": 50,
    })  # fmt: skip
    np.savez(file, outlines=result.outlines(50), cp=result.cp, x=result.x, mach=result.mach, alpha=result.alpha,
             cl=result.cl, cd=result.cd, cm=result.cm, converged=result.converged)  # fmt: skip
    print(f"{result.found} of {result.planned} flows in {file}")
    return result


if __name__ == "__main__":
    main(*sys.argv[1:2])
