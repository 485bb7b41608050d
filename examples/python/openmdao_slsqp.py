"""Drag at fixed lift under OpenMDAO: a section by ScipyOptimizeDriver, with exact total derivatives.

    python3 openmdao_slsqp.py [euler|laminar|sa]

SectionComponent owns the mesh and the flow, which live from design to design. The area may not fall.
"""

import sys

import openmdao.api as om

import remodel
from remodel.openmdao import SectionComponent

CASES = {
    "euler": {"mach": 0.75, "lift": 0.3, "mesh": {"points": 100}},
    "laminar": {"model": "laminar", "mach": 0.5, "lift": 0.1, "reynolds": 5000.0, "mesh": {"spacing": 4.0, "growth": 1.5}},
    "sa": {"model": "sa", "mach": 0.73, "lift": 0.5, "reynolds": 6.5e6, "mesh": {"spacing": 2.0}},
}


def main(case="euler", start="naca:0012", iterations=30, bound=None, **changes):
    section = SectionComponent(airfoil=start, **(CASES[case] | changes))
    problem = om.Problem()
    problem.model.add_subsystem("section", section, promotes=["*"])
    design = remodel.Airfoil(start).design
    bound = bound or (0.1 if case == "euler" else 0.03)
    problem.model.add_design_var("design", lower=design - bound, upper=design + bound)
    problem.driver = om.ScipyOptimizeDriver(optimizer="SLSQP", maxiter=iterations, tol=1e-5, disp=False)
    problem.setup()
    problem.run_model()
    first, area = float(problem.get_val("cd")[0]), float(problem.get_val("area")[0])
    problem.model.add_objective("cd", ref=first)
    problem.model.add_constraint("area", lower=area, ref=area)
    problem.setup()
    problem.run_driver()
    last, flows = float(problem.get_val("cd")[0]), section.flows
    print(f"{1e4 * first:.1f} to {1e4 * last:.1f} counts in {flows} flows, area {100 * float(problem.get_val('area')[0]) / area:.2f} %")
    return first, last, flows, float(problem.get_val("area")[0]) / area


if __name__ == "__main__":
    main(*sys.argv[1:2])
