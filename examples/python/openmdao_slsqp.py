"""Drag under OpenMDAO, at a lift of 0.3 or more: a section by ScipyOptimizeDriver, with total derivatives.

    python3 openmdao_slsqp.py

MeshComponent has the points of a design, FlowComponent their flow; OpenMDAO chains the derivatives of both.
"""

import openmdao.api as om

import remodel
from remodel.openmdao import FlowComponent, MeshComponent


def main(start="naca:0012", points=100, mach=0.75, alpha=2.0, iterations=15):
    geometry = MeshComponent(mesh=remodel.generate(start, points=points))
    problem = om.Problem()
    problem.model.add_subsystem("geometry", geometry, promotes=["design", "points"])
    problem.model.add_subsystem("flow", FlowComponent(geometry=geometry, mach=mach, alpha=alpha), promotes=["*"])
    design = remodel.Airfoil(start).design
    problem.model.add_design_var("design", lower=design - 0.02, upper=design + 0.02)
    problem.model.add_objective("cd", ref=1e-3)
    problem.driver = om.ScipyOptimizeDriver(optimizer="SLSQP", maxiter=iterations, tol=1e-4, disp=False)
    problem.model.add_constraint("cl", lower=0.3)
    problem.setup()
    problem.run_model()
    first = float(problem.get_val("cd")[0])
    problem.run_driver()
    drag, lift = float(problem.get_val("cd")[0]), float(problem.get_val("cl")[0])
    print(f"{1e4 * first:.1f} to {1e4 * drag:.1f} counts, CL {lift:.4f}")
    return first, drag, lift


if __name__ == "__main__":
    main()
