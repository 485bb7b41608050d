"""Components for OpenMDAO: an airfoil's coefficients to mesh coordinates, and these to lift and drag.

OpenMDAO is imported with this module, and nothing else is that remodel does not need. Connectivity is fixed, as
OpenMDAO's arrays are: where a design needs another one, compute() raises openmdao's AnalysisError (from
TopologyChanged), which line searches shorten their step for. `MeshComponent.renew()` takes the present design's mesh
as the new reference, for a problem that is set up again.
"""

import numpy as np
from openmdao.api import AnalysisError, ExplicitComponent

from ._core import LivingFlow
from ._errors import Error, TopologyChanged


class MeshComponent(ExplicitComponent):
    """Coefficients of an airfoil ('design', upper then lower) to 'points' of shape (n, 2).

    Options: mesh, the Mesh to begin with; airfoil, the Airfoil that it is of.
    """

    def initialize(self):
        self.options.declare("mesh")
        self.options.declare("airfoil")

    def setup(self):
        self.mesh = self.reference = self.options["mesh"].copy()
        design = self.options["airfoil"].design
        self.add_input("design", val=design)
        self.add_output("points", val=np.array(self.mesh.points))
        self.declare_partials("points", "design")

    def _follow(self, design):
        try:
            self.mesh = self.reference.at(self.options["airfoil"].with_design(design))
        except TopologyChanged as error:
            raise AnalysisError(str(error)) from error

    def renew(self):
        """The reference becomes the mesh of the present design."""
        self.reference = self.mesh

    def compute(self, inputs, outputs):
        self._follow(inputs["design"])
        outputs["points"] = self.mesh.points

    def compute_jacvec_product(self, inputs, d_inputs, d_outputs, mode):
        self._follow(inputs["design"])
        if "points" not in d_outputs or "design" not in d_inputs:
            return
        if mode == "fwd":
            d_outputs["points"] += self.mesh.jvp(d_inputs["design"])
        else:
            d_inputs["design"] += self.mesh.vjp(d_outputs["points"])


class FlowComponent(ExplicitComponent):
    """'points' of a MeshComponent's mesh, with 'mach' and 'alpha' (degrees), to 'cl', 'cd' and 'cm'.

    Options: geometry, the MeshComponent, whose mesh is solved on; solver, a LivingFlow.
    """

    def initialize(self):
        self.options.declare("geometry")
        self.options.declare("solver", default=None)
        self.options.declare("mach", default=0.5)
        self.options.declare("alpha", default=0.0)

    def setup(self):
        self.solver = self.options["solver"] or LivingFlow()
        self.gradients = None
        self.add_input("points", val=np.array(self.options["geometry"].options["mesh"].points))
        self.add_input("mach", val=self.options["mach"])
        self.add_input("alpha", val=self.options["alpha"])
        for name in ("cl", "cd", "cm"):
            self.add_output(name, val=0.0)
            self.declare_partials(name, ["points", "mach", "alpha"])

    def compute(self, inputs, outputs):
        self.gradients = None
        try:
            flow = self.solver.solve(self.options["geometry"].mesh, mach=float(np.ravel(inputs["mach"])[0]), alpha=float(np.ravel(inputs["alpha"])[0]))
        except Error as error:
            raise AnalysisError(str(error)) from error
        if not flow.converged:
            raise AnalysisError(flow.reason)
        outputs["cl"], outputs["cd"], outputs["cm"] = flow.cl, flow.cd, flow.cm

    def compute_partials(self, inputs, partials):
        if self.gradients is None:
            self.gradients = self.solver.gradients()
        for name in ("cl", "cd", "cm"):
            gradient = self.gradients[name]
            partials[name, "points"] = np.ravel(gradient["points"])[None, :]
            partials[name, "mach"] = gradient["mach"]
            partials[name, "alpha"] = gradient["alpha"]
