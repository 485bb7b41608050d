"""A polar: lift, drag and moment over angles of attack, each flow from the last one.

    python3 polar.py [SECTION]
"""

import sys

import numpy as np

import remodel


def main(section="naca:2412", angles=np.arange(-2.0, 8.1, 2.0), points=200, mach=0.3):
    mesh = remodel.generate(section, points=points)
    flow = remodel.LivingFlow(tolerance=1e-8)
    rows = []
    for alpha in angles:
        result = flow.solve(mesh, mach=mach, alpha=float(alpha))
        if not result.converged:
            print(f"{alpha:6.2f} degrees: {result.reason}")
            break
        rows.append((alpha, result.cl, result.cd, result.cm))
        print(f"{alpha:6.2f} degrees  CL {result.cl:7.4f}  CD {result.cd:.5f}  CM {result.cm:7.4f}  {result.start}")
    return np.array(rows)


if __name__ == "__main__":
    main(*sys.argv[1:2])
