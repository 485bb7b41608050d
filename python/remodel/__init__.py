"""Meshes that live while an optimiser changes the shape inside them.

    import remodel

    airfoil = remodel.Airfoil("rae2822")
    mesh = remodel.generate(airfoil, points=200)
    step = mesh.update(airfoil.with_design(airfoil.design * 1.01))
    print(step.preserved_percent, mesh.points.shape, mesh.check().valid)

Shapes: Airfoil, Domain, catalogue(). Meshes: generate(), import_mesh(), Mesh, FrozenMesh, check(). Steps:
Mesh.update() returns a Step, Mesh.trial() tries a design. Layers on walls: generate_layered(), LayeredMesh. Values carried from mesh to mesh: Transfer. Flow:
solve_flow(), LivingFlow, PotentialSolver. Optimisers: design(), optimise(), CMAES. Many flows: polar(), sweep().
How smooth an objective is: noise().

Lengths are in chords and angles in degrees. Every mesh is constrained Delaunay; a step keeps what it can. Bad
input raises an Error: ArgumentError, FileError, FormatError or GeometryError, with the place and what was
expected; a limit that was reached is in the result. Ctrl-C ends long calls within a tenth of a second
and leaves meshes valid; only reading and writing files end first. A flow inside a factorisation, check() and an
import go on in the background with nobody waiting for them: the next call of that LivingFlow waits for the
factorisation to end, as a fork and the end of the process do (there a second Ctrl-C ends the wait).

The method is that of the paper "Two-Dimensional Quality-Mesh Remodelling for Engineering Design Optimisation".
"""

from . import _calls, _core

_calls.extend(_core)

from ._bridges import from_meshio, from_pyvista
from ._core import (
    Airfoil,
    Changes,
    CheckResult,
    Domain,
    FlowResult,
    FrozenMesh,
    InteriorDisplacement,
    LayeredChanges,
    LayeredMesh,
    LayeredStep,
    LayeredTrial,
    LivingFlow,
    Mesh,
    PotentialFlow,
    PotentialSolver,
    Step,
    Transfer,
    Trial,
    Violation,
    __version__,
    catalogue,
    check,
    generate,
    generate_layered,
    import_mesh,
    read_fields,
    read_frozen,
    solve_flow,
)
from ._design import DesignResult, design
from ._designers import CMAES
from ._errors import ArgumentError, ArgumentTypeError, Error, EvaluationFailed, FileError, FormatError, GeometryError, TopologyChanged
from ._gradients import PointGradient
from ._mesh import extend as _extend
from ._noise import NoiseResult, noise
from ._optimise import OptimiseResult, optimise
from ._polar import PolarCurve, polar
from ._sweep import SweepResult, sweep

_extend()

__all__ = [
    "Airfoil", "ArgumentError", "ArgumentTypeError", "CMAES", "Changes", "CheckResult", "DesignResult", "Domain", "Error",
    "EvaluationFailed", "FileError", "FlowResult", "FormatError", "FrozenMesh", "GeometryError",
    "InteriorDisplacement", "LayeredChanges", "LayeredMesh", "LayeredStep", "LayeredTrial", "LivingFlow", "Mesh", "NoiseResult", "OptimiseResult", "PointGradient", "PolarCurve", "PotentialFlow",
    "PotentialSolver", "Step", "SweepResult", "TopologyChanged", "Transfer", "Trial", "Violation", "__version__", "catalogue",
    "check", "design", "from_meshio", "from_pyvista", "generate", "generate_layered", "import_mesh", "noise", "optimise", "polar", "read_fields", "read_frozen",
    "solve_flow", "sweep",
]  # fmt: skip

for _name in __all__:
    if getattr(_core, _name, None) is globals()[_name] and not _name.startswith("__"):
        globals()[_name].__module__ = "remodel"
del _name
