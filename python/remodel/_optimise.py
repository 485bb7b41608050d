"""optimise(): the library's own loop around living meshes."""

import tempfile
import warnings
from types import SimpleNamespace

import numpy as np

from . import _calls, _plot
from ._core import Airfoil, _optimise
from ._errors import ArgumentError, ArgumentTypeError


class OptimiseResult(SimpleNamespace):
    """The figures of a run: objective, best (an Airfoil), best_design, evaluations, preserved_percent, stopped, ...

    rows: a dict for each evaluation. `result.column(name)` is one figure of all of them.
    """

    @_calls.python_call(name="str")
    def column(self, name):
        """One figure of all evaluations as an array, say 'objective'; None becomes NaN."""
        if self.rows and name not in self.rows[0]:
            raise ArgumentError(f"name: found {name!r}, expected a figure of an evaluation, as 'objective' or 'triangles'")
        return np.array([np.nan if row[name] is None else row[name] for row in self.rows])

    def plot_history(self, ax=None):
        """Draws the objective and the best so far over evaluations, with matplotlib; returns the axes."""
        return _plot.plot_history(self, ax)

    def __repr__(self):
        return f"OptimiseResult(evaluations={self.evaluations}, objective={self.objective:.6g}, stopped={self.stopped!r})"


@_calls.python_call(directory="path", points="int", sigma="float", seed="int", evaluations="int", tolerance="float",
                    strategy="str", workers="int", threads="int", resume="bool", overwrite="bool")  # fmt: skip
def optimise(start, objective, *, directory=None, points=200, sigma=0.05, seed=1, evaluations=9000, tolerance=0.0,
             strategy="renew", workers=0, threads=None, resume=False, overwrite=False, layers=None, callback=None):  # fmt: skip
    """Searches an airfoil by CMA-ES; one living mesh follows the designs. Returns an OptimiseResult.

    objective: an Airfoil to be interpolated (the paper's case), or a function of (design, mesh, step): the
    coefficients as an array, the design's mesh (FrozenMesh) and a dict of what the step did. It returns a number,
    the smaller the better, or a dict: objective, constraints (satisfied at most 0), outputs. It may raise
    EvaluationFailed for a design; any other exception ends the run and is raised here.

    callback: called after each evaluation with a dict of its figures; True ends the run. directory: keeps history,
    meshes and checkpoints, for resume=True. Whether a function is that of the run is told by its name alone: a lambda is
    refused. A UserWarning says where no design has an objective. Ctrl-C ends the run with a checkpoint. strategy: 'renew',
    'chain', 'pool', 'hub', 'morph', 'reference' or 'regenerate'. layers: a dict of what generate_layered() is given, of reynolds,
    model, first_height, thickness, growth, spacing, wake and wake_angle; then the meshes have layers on their walls, `points` says
    nothing, and the counts of rows are of triangles outside them. threads: all cores for an Airfoil, one for a function, unless given. Raises
    ArgumentError, FileError, FormatError.
    """
    if not isinstance(start, Airfoil):
        start = Airfoil(start)
    if not (isinstance(objective, Airfoil) or callable(objective)):
        raise ArgumentTypeError(f"objective: found {_calls.shown(objective)}, expected an Airfoil or a function of (design, mesh, step)")
    if callback is not None and not callable(callback):
        raise ArgumentTypeError(f"callback: found {_calls.shown(callback)}, expected a function of a dict")
    for name, value, most in (("points", points, 2**31), ("seed", seed, 2**64), ("evaluations", evaluations, 2**63), ("workers", workers, 2**31), ("threads", threads or 0, 2**31)):
        if not 0 <= value < most:
            raise ArgumentError(f"{name}: found {value}, expected 0 to {most - 1}")
    if resume and directory is None:
        raise ArgumentError("resume: found without a directory, expected that of the run")
    if threads is None:
        threads = 0 if isinstance(objective, Airfoil) else 1
    if not isinstance(objective, Airfoil):
        name = _calls.name_of_function("objective", objective, None, resume)
        objective = _real(objective)
        objective.__name__ = name
    layers = None if layers is None else _layers(layers)
    options = (points, sigma, seed, evaluations, tolerance, strategy, workers, threads, resume, overwrite, callback, layers)
    if directory is not None:
        return _result(_optimise(start, objective, directory, *options))
    with tempfile.TemporaryDirectory() as scratch:
        return _result(_optimise(start, objective, scratch, *options))


def _result(figures):
    result = OptimiseResult(**figures)
    if result.rows and not np.isfinite(result.objective):
        details = [row["detail"] for row in result.rows if row["detail"]]
        why = f"; the first: {details[0]}" if details else ""
        warnings.warn(f"objective: no design of {len(result.rows)} has one that is a finite number{why}", stacklevel=4)
    return result


_LAYERS = {"reynolds": None, "model": "sa", "first_height": None, "thickness": None, "growth": 1.2, "spacing": 1.0, "wake": None, "wake_angle": 0.0}


def _layers(given):
    if not isinstance(given, dict):
        raise ArgumentTypeError(f"layers: found {_calls.shown(given)}, expected a dict")
    for name, value in given.items():
        if name not in _LAYERS:
            raise ArgumentError(f"layers: found {name!r}, expected one of {', '.join(_LAYERS)}")
        if name == "model" and not isinstance(value, str):
            raise ArgumentTypeError(f"layers: found {_calls.shown(value)} for model, expected a string")
        if value is None and _LAYERS[name] is not None:
            raise ArgumentTypeError(f"layers: found None for {name}, expected a number")
        if name != "model" and value is not None and (isinstance(value, bool) or not isinstance(value, (int, float))):
            raise ArgumentTypeError(f"layers: found {_calls.shown(value)} for {name}, expected a number")
        _calls.finite(f"layers: {name}", value)
    return tuple({**_LAYERS, **given}.values())


def _is_number(answer):
    try:
        return np.iscomplexobj(answer) or float(answer) is not None
    except (TypeError, ValueError):
        return False


def _real(objective):
    """The same function; what is complex in its answer raises, where half of it would be lost."""

    def asked(*args):
        answer = objective(*args)
        if not isinstance(answer, dict) and (isinstance(answer, (str, bytes)) or not _is_number(answer)):
            raise ArgumentTypeError(f"objective: returned {_calls.shown(answer)}, expected a number, or a dict with one")
        numbers = answer.items() if isinstance(answer, dict) else [("objective", answer)]
        for name, value in numbers:
            values = value.values() if isinstance(value, dict) else value
            if np.iscomplexobj(list(values) if isinstance(value, dict) else values):
                raise ArgumentError(f"{name}: found the complex {value!r}, expected real numbers")
        return answer

    return asked
