"""A polar: lift, drag and moment over angles of attack, each flow from the last one, past the largest lift.

    python3 polar.py [SECTION]
"""

import sys

import numpy as np

import remodel


def main(section="naca:2412", angles=np.arange(-2.0, 8.1, 2.0), points=200, mach=0.3):
    mesh = remodel.generate(section, points=points)
    row = remodel.polar(mesh, mach=mach, alpha=angles, tolerance=1e-8)
    for alpha, cl, cd, cm, why in zip(row.alpha, row.cl, row.cd, row.cm, row.reason):
        print(f"{alpha:6.2f} degrees: {why}" if why else f"{alpha:6.2f} degrees  CL {cl:7.4f}  CD {cd:.5f}  CM {cm:7.4f}")
    return np.column_stack([row.alpha, row.cl, row.cd, row.cm])


if __name__ == "__main__":
    main(*sys.argv[1:2])
