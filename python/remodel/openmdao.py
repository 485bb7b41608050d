"""Components for OpenMDAO. SectionComponent: an airfoil's coefficients to lift, drag and sizes, with or without friction.
MeshComponent and FlowComponent: the same in two, for geometry of other components, without friction.

OpenMDAO is imported with this module, and nothing else is that remodel does not need. SectionComponent owns its mesh,
whose connectivity changes where it must. That of the pair is fixed, as OpenMDAO's arrays are: the points of a design are
those of the first mesh, by whatever strategy it was made, its interior moved along with the walls (InteriorDisplacement),
which is linear in the coefficients. What cannot be computed (triangles that turn over or walls that cross far from the
first design, a flow that is not found) raises openmdao's AnalysisError. Drivers that do not catch it, as
ScipyOptimizeDriver, end with it: give the design variables bounds, or take pyOptSparseDriver. `MeshComponent.renew()`
makes a mesh for the present design, for a problem that is set up again.
"""

import os

import numpy as np
from openmdao.api import AnalysisError, ExplicitComponent

from . import _calls
from ._core import Airfoil, FrozenMesh, InteriorDisplacement, LivingFlow, Mesh, generate, generate_layered
from ._errors import ArgumentError, ArgumentTypeError, Error
from ._mesh import Validity

_STRATEGIES = ("chain", "renew", "morph", "reference")
_RECIPE = "; bound the design variables, or take a driver that catches AnalysisError, as pyOptSparseDriver"


def _require_type(name, value, kinds, expected):
    if not isinstance(value, kinds):
        raise ArgumentTypeError(f"{name}: found {_calls.shown(value)}, expected {expected}")


def _require(flow):
    if not flow.converged:
        raise AnalysisError(f"flow: {flow.reason}" + _RECIPE)
    if not flow.lift_determined:
        raise AnalysisError("flow: the lift is not determined: a body has no edge that the flow leaves from")


def _refuse_complex(component):
    if component.under_complex_step:
        raise ArgumentError("step: found a complex one, expected differences of real numbers (method='fd')")


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
        _require_type("mesh", self.options["mesh"], Mesh, "a Mesh")
        self._refer_to(self.options["mesh"].copy())
        airfoil = self.options["airfoil"]
        _require_type("airfoil", airfoil, (Airfoil, type(None)), "an Airfoil or None")
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
        _refuse_complex(self)
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
        _require_type("geometry", geometry, (MeshComponent, type(None)), "a MeshComponent or None")
        _require_type("solver", self.options["solver"], (LivingFlow, type(None)), "a LivingFlow or None")
        mesh = geometry.options["mesh"] if mesh is None else mesh
        _require_type("mesh", mesh, (Mesh, FrozenMesh), "a Mesh or FrozenMesh")
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
        _require(flow)
        self._solved = points, conditions, flow
        return flow

    def compute(self, inputs, outputs):
        _refuse_complex(self)
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


class SectionComponent(ExplicitComponent):
    """An airfoil's coefficients ('design', upper then lower) and the stream to the flow's coefficients and sizes.

    Inputs: design; mach; alpha (degrees), or lift, the coefficient that the angle is found for; with friction reynolds, by
    the chord. Outputs: cl (where alpha is given), alpha (where lift is), cd, cm, with friction cd_pressure; area (square
    chords); with thickness_at thickness, at those stations.

    Options: airfoil, the one to begin with, or its name; model, 'euler', 'laminar' or 'sa'; mach, alpha, lift, reynolds to
    begin with; transition, places of both sides (model 'sa'); thickness_at, x of stations; mesh, a dict of what generate()
    or, with friction, generate_layered() takes; strategy, of Mesh.update(); tolerance of flows.

    The mesh and the flow live from design to design, and partials are those of the way that the mesh goes from where it is.
    By 'reference' each design's mesh is the morph of the first one, so that outputs are smooth; where no morph is good
    enough, triangles are replaced and outputs jump by the mesh's error. By 'chain', 'renew' and 'morph' the walls of the mesh
    at hand move, and it depends on the designs before. Differences that OpenMDAO takes are tried on the mesh at hand, which is
    then what it was; AnalysisError where one would replace triangles.

    `flows` counts searches. AnalysisError: surfaces that cross, no mesh, no flow.
    """

    def initialize(self):
        declare = self.options.declare
        declare("airfoil", default="naca:0012")
        declare("model", default="euler")
        declare("mach", default=0.5)
        declare("alpha", default=0.0)
        declare("lift", default=None)
        declare("reynolds", default=None)
        declare("transition", default=None)
        declare("thickness_at", default=())
        declare("mesh", default=None)
        declare("strategy", default="reference")
        declare("tolerance", default=1e-10)

    def setup(self):
        given = self.options["airfoil"]
        _require_type("airfoil", given, (Airfoil, str, os.PathLike), "an Airfoil, or its name or file")
        self.start = given if isinstance(given, Airfoil) else Airfoil(given)
        self._has_friction = self.options["model"] != "euler"
        reynolds = self.options["reynolds"]
        if self._has_friction != (reynolds is not None):
            raise ArgumentError(f"reynolds: found {reynolds!r} with the model {self.options['model']!r}, expected it with friction alone")
        self._strategy = self.options["strategy"]
        _require_type("strategy", self._strategy, str, "its name")
        if self._strategy not in _STRATEGIES:
            raise ArgumentError(f"strategy: found {self._strategy!r}, expected one of {', '.join(_STRATEGIES)}")
        self.mesh = self._mesh_of_start(reynolds)
        self.mesh.update(self.start, strategy=self._strategy)  # from now on vjp() goes its way
        self._design = self.start.design  # that the mesh has
        self.solver = LivingFlow(model=self.options["model"], tolerance=self.options["tolerance"])
        self._solved = self._gradients = None
        self.flows = 0  # that were looked for
        self._geometry = _Sizes(self.start, self.options["thickness_at"])

        self._condition = "alpha" if self.options["lift"] is None else "lift"
        self._stream = ["mach", self._condition, *(["reynolds"] if self._has_friction else [])]
        self.add_input("design", val=self.start.design)
        for name in self._stream:
            self.add_input(name, val=self.options[name])
        self._of_flow = ["cl" if self._condition == "alpha" else "alpha", "cd", "cm", *(["cd_pressure"] if self._has_friction else [])]
        for name in self._of_flow:
            self.add_output(name, val=0.0)
            self.declare_partials(name, ["design", *self._stream])
        for name, values in self._geometry.at(self.start).items():
            self.add_output(name, val=values)
            self.declare_partials(name, "design")

    def _mesh_of_start(self, reynolds):
        _require_type("mesh", self.options["mesh"], (dict, type(None)), "a dict of what generate() takes, or None")
        options = dict(self.options["mesh"] or {})
        if not self._has_friction:
            return generate(self.start, **options)
        return generate_layered(self.start, reynolds=float(np.ravel(reynolds)[0]), model=self.options["model"], **options)

    def _flow(self, design, airfoil, conditions):
        """The flow on the mesh, which follows to the design, or for a difference is lent to it."""
        self.flows += 1
        if np.array_equal(design, self._design):
            return self.solver.solve(self.mesh, **conditions)
        if self.under_finite_difference:
            with self.mesh.trial(airfoil, strategy=self._strategy) as trial:
                self._require_way(trial.step)
                return self.solver.solve(self.mesh, **conditions)
        self.mesh.update(airfoil, strategy=self._strategy)
        self._design = design
        return self.solver.solve(self.mesh, **conditions)

    def _require_way(self, step):
        """Differences are of what partials are of: the mesh goes with its triangles, its interior by the strategy."""
        held = step.held if self._strategy == "reference" else step.full_adjustment and not step.morphed
        if not (held and getattr(step, "same_columns", True)):
            raise AnalysisError(f"design: a difference this large replaces triangles (strategy '{self._strategy}'), expected a smaller step")

    def _solve(self, inputs):
        """The flow at these inputs, found unless it was the last one."""
        at = {name: np.array(inputs[name], dtype=float) for name in ("design", *self._stream)}
        if self._solved is not None and all(np.array_equal(at[name], self._solved[0][name]) for name in at):
            return self._solved[1]
        self._solved = self._gradients = None
        airfoil = self.start.with_design(at["design"])
        if not airfoil.feasible:
            raise AnalysisError("design: its surfaces cross" + _RECIPE)
        conditions = {name: float(np.ravel(at[name])[0]) for name in self._stream}
        if self._condition == "lift":
            conditions["cl"] = conditions.pop("lift")
        if self.options["transition"] is not None:
            conditions["transition"] = self.options["transition"]
        try:
            flow = self._flow(at["design"], airfoil, conditions)
        except Error as error:
            raise AnalysisError(str(error) + _RECIPE) from error
        _require(flow)
        if not self.under_finite_difference:
            self._solved = at, flow
        return flow

    def compute(self, inputs, outputs):
        _refuse_complex(self)
        flow = self._solve(inputs)
        for name in self._of_flow:
            outputs[name] = getattr(flow, name)
        for name, values in self._geometry.at(self.start.with_design(np.array(inputs["design"], dtype=float))).items():
            outputs[name] = values

    def compute_partials(self, inputs, partials):
        self._solve(inputs)
        if self._gradients is None:
            gradients = self.solver.gradients()
            self._gradients = {name: (gradients[name], self.mesh.vjp(gradients[name]["points"])) for name in self._of_flow}
        for name, (gradient, by_design) in self._gradients.items():
            partials[name, "design"] = np.asarray(by_design)[None, :]
            for condition in self._stream:
                partials[name, condition] = gradient["cl" if condition == "lift" else condition]
        for name, slope in self._geometry.slopes.items():
            partials[name, "design"] = slope


class _Sizes:
    """The area of a section and its thickness at stations: both are linear in the coefficients."""

    _POINTS = 2001

    def __init__(self, start, stations):
        self._stations = np.atleast_1d(_calls.reals("thickness_at", stations))
        if not ((self._stations > 0) & (self._stations < 1)).all():
            raise ArgumentError(f"thickness_at: found {self._stations.tolist()}, expected numbers above 0 and below 1")
        base, unit = self.at(start), np.eye(len(start.design))
        self.slopes = {name: np.column_stack([self.at(start.with_design(start.design + e))[name] - values for e in unit])
                       for name, values in base.items()}  # fmt: skip

    def at(self, airfoil):
        points = airfoil.coordinates(self._POINTS)
        x, y = points.T
        sizes = {"area": np.atleast_1d(0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))}
        if len(self._stations):
            nose = self._POINTS // 2
            upper = np.interp(self._stations, x[nose::-1], y[nose::-1])
            sizes["thickness"] = upper - np.interp(self._stations, x[nose:], y[nose:])
        return sizes
