"""A function of a flow of one's own, with its exact gradient by the shape: how steep the pressure rises.

    python3 own_function.py

J is the mean over the upper surface, behind the thickest place, of the squared pressure coefficient. LivingFlow.gradients()
takes its derivatives by the flow's pressures and gives those by all points; Mesh.vjp() makes derivatives by the
section's coefficients of them. A difference along one coefficient shows that they fit.
"""

import numpy as np

import remodel

CONDITION = {"mach": 0.5, "alpha": 1.0}


def function_of(flow, mesh):
    """J, and its derivatives by the pressures at fixed points."""
    behind = np.flatnonzero((mesh.curve == 0) & (mesh.parameter > 0) & (mesh.parameter < 0.3))  # of the upper surface
    dynamic = 0.5 * CONDITION["mach"] ** 2  # density and speed of sound of the stream are 1
    cp = flow.cp[behind]
    by_pressure = np.zeros(len(mesh.points))
    by_pressure[behind] = 2 * cp / dynamic / len(behind)
    return np.mean(cp**2), {"pressure": by_pressure}


def main(points=60, coefficient=2, step=1e-5):
    airfoil = remodel.Airfoil("naca:2412", degree=4)
    mesh = remodel.generate(airfoil, points=points)
    solver = remodel.LivingFlow(tolerance=1e-12)
    value, by_flow = function_of(solver.solve(mesh, **CONDITION), mesh)
    gradient = np.asarray(mesh.vjp(solver.gradients({"J": by_flow})["J"]["points"]))
    along = []
    for sign in (-1, 1):
        design = airfoil.design.copy()
        design[coefficient] += sign * step
        moved = mesh.at(airfoil.with_design(design))  # the same connectivity
        along.append(function_of(solver.solve(moved, **CONDITION), moved)[0])
    difference = (along[1] - along[0]) / (2 * step)
    print(f"J {value:.6f}, by coefficient {coefficient}: {gradient[coefficient]:.8f}, by differences {difference:.8f}")
    return value, gradient[coefficient], difference


if __name__ == "__main__":
    main()
