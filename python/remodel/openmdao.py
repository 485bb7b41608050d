"""Components for OpenMDAO: an airfoil's coefficients to mesh coordinates, and these to lift and drag.

OpenMDAO is imported with this module, and nothing else is that remodel does not need. Connectivity is fixed, as
OpenMDAO's arrays are: the points of a design are those of the first mesh, its interior moved along with the walls
(InteriorDisplacement), which is linear in the coefficients. What cannot be computed (triangles that turn over or walls
that cross far from the first design, a flow that is not found) raises openmdao's AnalysisError. Drivers that do not catch it, as
ScipyOptimizeDriver, end with it: give the design variables bounds, or take pyOptSparseDriver. `MeshComponent.renew()`
makes a mesh for the present design, for a problem that is set up again.
"""

import numpy as np
from openmdao.api import AnalysisError, ExplicitComponent

from ._core import InteriorDisplacement, LivingFlow
from ._errors import ArgumentError, Error
from ._mesh import Validity

_RECIPE = "; bound the design variables, or take a driver that catches AnalysisError, as pyOptSparseDriver"


class MeshComponent(ExplicitComponent):
    """Coefficients of an airfoil ('design', upper then lower) to 'points' of shape (n, 2).

    Options: mesh, the Mesh to begin with; boundary, the airfoil's name where the mesh has several; airfoil, the Airfoil
    that 'design' begins with, unless given that of the mesh.
    """

    def initialize(self):
        self.options.declare("mesh")
        self.options.declare("airfoil", default=None)
        self.options.declare("boundary", default="")

    def setup(self):
        self._refer_to(self.options["mesh"].copy())
        airfoil = self.options["airfoil"]
        if airfoil is not None and (airfoil.degree != self._airfoil.degree or airfoil.with_design(self._base) != self._airfoil):
            raise ArgumentError("airfoil: is not the mesh's with other coefficients, expected the same degree, exponents and trailing edge")
        self.add_input("design", val=self._base if airfoil is None else airfoil.design)
        self.add_output("points", val=np.array(self.reference.points))
        self.declare_partials("points", "design")

    def _refer_to(self, mesh):
        boundary = self.options["boundary"]
        self.reference, self._frozen = mesh, mesh.freeze()
        self._validity = Validity(self._frozen)
        self._airfoil = mesh.domain.airfoil(boundary)
        self._base = self._airfoil.design
        names = None if not boundary else [boundary]
        self._interior = InteriorDisplacement(mesh, names)

    def renew(self):
        """The mesh of the option becomes that of the present design, remodelled: set the problem up again."""
        mesh = self.reference.copy()
        mesh.update(self._airfoil.with_design(self._present), boundary=self.options["boundary"])
        self.options["mesh"] = mesh

    def _moved(self, direction):
        return self._interior.jvp(self.reference.jvp(direction, self.options["boundary"], interior="still"))

    def compute(self, inputs, outputs):
        self._present = np.array(inputs["design"])
        points = self.reference.points + self._moved(self._present - self._base)
        broken = self._validity.broken(self._frozen.with_points(points))
        if broken:
            raise AnalysisError(f"design: its mesh is not valid ({broken}), expected a design nearer to the mesh's own" + _RECIPE)
        outputs["points"] = points

    def compute_jacvec_product(self, inputs, d_inputs, d_outputs, mode):
        if "points" not in d_outputs or "design" not in d_inputs:
            return
        if mode == "fwd":
            d_outputs["points"] += self._moved(d_inputs["design"])
        else:
            by_walls = self._interior.vjp(d_outputs["points"])
            d_inputs["design"] += self.reference.vjp(by_walls, self.options["boundary"], interior="still")


class FlowComponent(ExplicitComponent):
    """The 'points' of a mesh, of shape (n, 2), with 'mach' and 'alpha' (degrees), to 'cl', 'cd' and 'cm'.

    Options: mesh, a Mesh or FrozenMesh whose triangles and boundaries the points have, or geometry, the MeshComponent
    that they come from; solver, a LivingFlow; mach and alpha to begin with. Partials are those of the discrete flow, by
    its adjoint: of all points, whatever component moves them.
    """

    def initialize(self):
        self.options.declare("mesh", default=None)
        self.options.declare("geometry", default=None)
        self.options.declare("solver", default=None)
        self.options.declare("mach", default=0.5)
        self.options.declare("alpha", default=0.0)

    def setup(self):
        mesh, geometry = self.options["mesh"], self.options["geometry"]
        if mesh is None and geometry is None:
            raise ArgumentError("mesh: not given, expected a mesh or the component that its points come from")
        mesh = geometry.options["mesh"] if mesh is None else mesh
        self.frozen = mesh.freeze() if hasattr(mesh, "freeze") else mesh
        self._validity = Validity(self.frozen)
        self.solver = self.options["solver"] or LivingFlow(tolerance=1e-12)
        self._solved = self._gradients = None
        self.add_input("points", val=np.array(self.frozen.points))
        self.add_input("mach", val=self.options["mach"])
        self.add_input("alpha", val=self.options["alpha"])
        for name in ("cl", "cd", "cm"):
            self.add_output(name, val=0.0)
            self.declare_partials(name, ["points", "mach", "alpha"])

    def _solve(self, inputs):
        """The flow at these inputs, found unless it was the last one."""
        points = np.array(inputs["points"])
        conditions = {name: float(np.ravel(inputs[name])[0]) for name in ("mach", "alpha")}
        if self._solved is not None:
            before, at, flow = self._solved
            if at == conditions and np.array_equal(before, points):
                return flow
        self._solved = self._gradients = None
        try:
            mesh = self.frozen.with_points(points)
            broken = self._validity.broken(mesh)
            if broken:
                raise AnalysisError(f"points: the mesh is not valid ({broken}), expected points nearer to its own" + _RECIPE)
            flow = self.solver.solve(mesh, **conditions)
        except Error as error:
            raise AnalysisError(str(error) + _RECIPE) from error
        if not flow.converged:
            raise AnalysisError(f"flow: {flow.reason}" + _RECIPE)
        if not flow.lift_determined:
            raise AnalysisError("flow: the lift is not determined: a body has no edge that the flow leaves from")
        self._solved = points, conditions, flow
        return flow

    def compute(self, inputs, outputs):
        flow = self._solve(inputs)
        outputs["cl"], outputs["cd"], outputs["cm"] = flow.cl, flow.cd, flow.cm

    def _gradients_of(self, flow):
        """Of that flow, or nothing where the solver, which others may use too, has found another one since."""
        gradients = self.solver.gradients()
        return gradients if gradients["cl"]["points"].mesh is flow.mesh else None

    def compute_partials(self, inputs, partials):
        flow = self._solve(inputs)
        if self._gradients is None:
            self._gradients = self._gradients_of(flow)
        if self._gradients is None:
            self._solved = None
            self._gradients = self._gradients_of(self._solve(inputs))
        for name in ("cl", "cd", "cm"):
            gradient = self._gradients[name]
            partials[name, "points"] = np.ravel(gradient["points"])[None, :]
            partials[name, "mach"] = gradient["mach"]
            partials[name, "alpha"] = gradient["alpha"]
