"""Drag at a given lift by SciPy's SLSQP, with exact gradients: a transonic section loses its shock.

    python3 drag_at_fixed_lift.py

The area may not fall. Each design's mesh is the morph of the first one (strategy="reference"), so that the objective is
smooth and Mesh.vjp() has the derivative of the very way that the mesh goes.
"""

import numpy as np
from scipy.optimize import minimize

import remodel


class Section:
    """The drag of a section at a given lift, and its derivatives; the mesh and the flow live on."""

    def __init__(self, start, points, **condition):
        self.start = remodel.Airfoil(start)
        self.mesh = remodel.generate(self.start, points=points)
        self.flow, self.condition = remodel.LivingFlow(), condition
        self.flows, self.known = 0, None

    def drag(self, design):
        """(counts of drag, derivatives). A section that cannot be meshed, or has no flow, counts a lot."""
        if self.known is not None and np.array_equal(self.known[0], design):
            return self.known[1:]
        try:
            self.mesh.update(self.start.with_design(design), strategy="reference")
        except remodel.GeometryError:
            return 1e4, np.zeros(len(design))
        result = self.flow.solve(self.mesh, **self.condition)
        self.flows += 1
        if not result.converged:
            return 1e4, np.zeros(len(design))
        gradient = self.mesh.vjp(self.flow.gradients()["cd"]["points"])
        self.known = np.array(design), 1e4 * result.cd, 1e4 * np.asarray(gradient)
        return self.known[1:]

    def area(self, design):
        """In percent of the start's: of a polygon through 200 points, which is linear in the design."""
        return 100 * self._area(design) / self._area(self.start.design)

    def _area(self, design):
        x, y = self.start.with_design(design).coordinates(201).T
        return 0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])

    def area_slope(self, design):
        unit = np.eye(len(design))
        return np.array([self.area(design + e) - self.area(design) for e in unit])


def main(start="naca:0012", points=100, mach=0.75, cl=0.3, evaluations=30):
    section = Section(start, points, mach=mach, cl=cl)
    design = section.start.design
    first, _ = section.drag(design)
    result = minimize(
        section.drag, design, jac=True, method="SLSQP", options={"maxiter": evaluations, "ftol": 1e-2},
        bounds=[(c - 0.1, c + 0.1) for c in design],
        constraints={"type": "ineq", "fun": lambda d: section.area(d) - 100, "jac": section.area_slope},
    )  # fmt: skip
    print(f"{first:.1f} to {result.fun:.1f} counts in {section.flows} flows, area {section.area(result.x):.2f} %")
    return first, result.fun, section.flows, section.area(result.x)


if __name__ == "__main__":
    main()
