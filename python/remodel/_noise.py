"""noise(): how smooth an objective is along a line of designs, by the way of making their meshes."""

from types import SimpleNamespace

from . import _calls
from ._core import Airfoil, _noise
from ._errors import ArgumentError, ArgumentTypeError
from ._optimise import _real

WAYS = ("fresh", "living", "hub", "reference")


class NoiseResult(SimpleNamespace):
    """Values along a line of designs, on meshes that were made in four ways: fresh (generated each), living (one living
    mesh, from the first design to the last), hub (copies of the mesh of the design in the middle, remodelled) and reference
    (morphs of that mesh, which keep its connectivity).

    Each of these has dicts by the names of values, 'cl' and 'cd' of flows, 'objective' of a function: values (an array,
    NaN where a design has none), rms (of what is left when a polynomial is taken away), slope (of that, in the middle),
    slope_error (its standard deviation), step (of central differences with the least error), step_error (that error) and
    adjoint (the exact slope on that mesh; only of flows). failures says why designs have no value. NaN: too few have.

    names, places (of designs on the line, around 0), stopped ('done', or what ended it).
    """

    def __repr__(self):
        parts = [f"{way}={getattr(self, way).rms}" for way in WAYS]
        return f"NoiseResult({', '.join(parts)}, stopped={self.stopped!r})"


@_calls.python_call(mach="float", alpha="float", spacing="float", count="int", degree="int", points="int", tolerance="float")  # fmt: skip
def noise(shape, objective=None, *, mach=None, alpha=0.0, direction=None, spacing=1e-3, count=21, degree=3, points=200,
          tolerance=1e-12):  # fmt: skip
    """Evaluates designs along a line around an airfoil, on meshes made in four ways. Returns a NoiseResult: it says whether
    finite differences can be used, and with which step.

    shape: an Airfoil, or what Airfoil() takes. mach: the values are CL and CD of compressible flow, at `alpha` degrees and
    with the residual `tolerance`. objective, in its place: a function of (design, mesh, step) as optimise() calls it; step
    is that of no change. EvaluationFailed is the failure of one design; any other exception is raised here.

    direction: in the shape's coefficients, upper surface first, of any length but 0; all of the upper surface unless given.
    spacing: between designs, in coefficients. count: designs, the shape in their middle. degree: of the polynomial that is
    smooth enough. points: stations on the airfoil. Raises ArgumentError, FileError, FormatError.
    """
    if not isinstance(shape, Airfoil):
        shape = Airfoil(shape)
    if (mach is None) == (objective is None):
        raise ArgumentError(f"mach: {'not given' if mach is None else 'given with an objective'}, expected a Mach number or an objective")
    if objective is not None:
        if not callable(objective):
            raise ArgumentTypeError(f"objective: found {_calls.shown(objective)}, expected a function of (design, mesh, step)")
        name = getattr(objective, "__name__", type(objective).__name__)
        objective = _real(objective)
        objective.__name__ = name
    for name, value, least, most in (("count", count, 3, 10000), ("degree", degree, 1, 20), ("points", points, 8, 2**20)):
        if not least <= value <= most:
            raise ArgumentError(f"{name}: found {value}, expected {least} to {most}")
    direction = [] if direction is None else list(_calls.reals("direction", direction).ravel())
    figures = _noise(shape, objective, 0.0 if mach is None else mach, alpha, tolerance, points, direction, spacing, count, degree)
    for way in WAYS:
        figures[way] = SimpleNamespace(**figures[way])
    return NoiseResult(**figures)
