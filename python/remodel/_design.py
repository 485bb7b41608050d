"""design(): sections designed by flows and their exact gradients, on one living mesh."""

import html
import json
import os
import tempfile
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from . import _calls, _plot
from ._core import Airfoil, _design, _design_page
from ._errors import ArgumentError, ArgumentTypeError, FileError, FormatError

_SOURCE = "problem"  # what messages call a problem that is no file


class DesignResult(SimpleNamespace):
    """What a search found: objective and start_objective (None without a flow), best_design (an array), best (a dict as
    best.json has it), converged, stopped, detail, constraints (by how much each is violated, 0 within the tolerance),
    outputs (cl, cd, ... of the best design), stages (a dict for each mesh, where there are several), verified and
    verified_start (flows of the best and of the first design on fresh meshes, a dict each), evaluations, flows,
    gradients, cold_equivalents, warnings, directory (None: it was a temporary one).

    rows: a dict for each design. `result.column(name)` is one figure, or one output, of all of them.
    """

    @_calls.python_call(name="str")
    def column(self, name):
        """One figure or output of all designs as an array, say 'objective' or 'cd'; None becomes NaN."""
        values = [row[name] if name in row else row["outputs"].get(name) for row in self.rows]
        if values and all(value is None for value in values) and not any(name in row for row in self.rows):
            raise ArgumentError(f"name: found {name!r}, expected a figure or an output of a design")
        return np.array([np.nan if value is None else value for value in values])

    @property
    def designs(self):
        """All designs, of shape (n, k)."""
        return np.array([row["coefficients"] for row in self.rows])

    def report(self, file=None):
        """Writes the page of the run, with sections, pressures and costs; returns its path. file: in the run's directory,
        unless given. It finds the flows of the first and the best design once more."""
        if self.directory is None:
            raise ArgumentError("directory: the run had none, expected design(problem, directory=...) for a report")
        page = Path(self.directory) / "report.html" if file is None else Path(file)
        _design_page(self.directory, page)
        return page

    def plot_history(self, ax=None):
        """Draws the objective and the best so far over designs, with matplotlib; returns the axes."""
        return _plot.plot_history(self, ax)

    def _repr_html_(self):
        rows = {"objective": self.objective, "of the start": self.start_objective, **self.outputs,
                "designs": self.evaluations, "stopped": self.stopped, "converged": self.converged,
                **{f"constraint {name}": "kept" if value == 0 else f"violated by {value:.3g}" for name, value in self.constraints.items()}}  # fmt: skip
        cells = (f"<tr><th>{html.escape(str(name))}</th><td>{html.escape(f'{value:.6g}' if isinstance(value, float) else str(value))}</td></tr>"
                 for name, value in rows.items())  # fmt: skip
        return f"<table>{''.join(cells)}</table>"

    def __repr__(self):
        objective = "None" if self.objective is None else f"{self.objective:.6g}"
        return f"DesignResult(evaluations={self.evaluations}, objective={objective}, stopped={self.stopped!r})"


@_calls.python_call(directory="path", threads="int", resume="bool", overwrite="bool")
def design(problem, *, directory=None, resume=False, overwrite=False, threads=0, callback=None):
    """Searches the section of least drag, or another objective, by flows and their gradients. Returns a DesignResult.

    problem: a dict with the keys of a problem file (docs/design.md), or the path of one. In a dict 'airfoil' and
    'target' may be an Airfoil ('airfoil' gets the 'degree' of the problem, if it has one). 'objective' may be a function of
    a flow, made small; an entry of 'constraints' may have 'flow_function', a function of the flow of 'point', with at_least
    or at_most, or 'design_function', a function of the design, which is to be at most 0; and a 'name'.

    A function of a flow gets a FlowResult, with its mesh. A function of a design gets the design, an array, and its
    Domain. Each returns a value, or a pair: the value and its derivatives. Those of a flow are a dict with any of cl, cd,
    cm, cd_pressure (by those coefficients) and points, pressure, density, velocity_x, velocity_y, mach (by those values, at
    fixed coefficients); those of a design are an array. The designer 'sqp' needs derivatives. A function may raise
    EvaluationFailed for a design (that of a function of a design at the start is raised here, since nobody then knows how
    many constraints it is); any other exception ends the run and is raised here.

    directory: keeps history, meshes and checkpoints, for resume=True; a temporary one unless given. Whether a function
    is that of the run is told by its name alone ('name', or its own): a lambda without one is refused. callback: called
    after each design with a dict of its figures; True ends the run. Ctrl-C ends it with a checkpoint. threads: flows of
    points at the same time, 0 for all cores; the result does not depend on it. Raises ArgumentError, FileError,
    FormatError.
    """
    if callback is not None and not callable(callback):
        raise ArgumentTypeError(f"callback: found {_calls.shown(callback)}, expected a function of a dict")
    if not 0 <= threads < 2**31:
        raise ArgumentError(f"threads: found {threads}, expected 0 to {2**31 - 1}")
    if resume and overwrite:
        raise ArgumentError("overwrite: found with resume, expected one of them")
    if isinstance(problem, (str, os.PathLike)):
        parts = (_text_of(problem), os.fspath(problem), None, None, [], None, None)
    elif isinstance(problem, dict):
        parts = _parts_of(problem, resume)
    else:
        raise ArgumentTypeError(f"problem: found {_calls.shown(problem)}, expected a dict or the path of a problem file")
    if directory is not None:
        return DesignResult(**_design(*parts, directory, resume, overwrite, threads, callback), directory=os.fspath(directory))
    if resume:
        raise ArgumentError("resume: found without a directory, expected that of the run")
    with tempfile.TemporaryDirectory() as scratch:
        return DesignResult(**_design(*parts, scratch, False, False, threads, callback), directory=None)


def _text_of(file):
    try:
        return Path(file).read_text()
    except OSError as error:
        raise FileError(f"{os.fspath(file)}: cannot be read: {error.strerror}, expected a problem file") from None
    except UnicodeDecodeError:
        raise FormatError(f"{os.fspath(file)}: found no text, expected a design problem") from None
    except ValueError as error:  # a null in the name
        raise FileError(f"{os.fspath(file)!r}: {error}, expected the name of a file") from None


def _parts_of(problem, resume):
    """The problem as text, with placeholders for what no text has, and what stands there."""
    problem = dict(problem)
    start = _start_of(problem.pop("start", None))
    airfoils = []
    for key in ("airfoil", "target"):
        given = problem.get(key)
        airfoils.append(_of_degree(given, problem.get("degree") if key == "airfoil" else None) if isinstance(given, Airfoil) else None)
        if isinstance(given, Airfoil):
            problem[key] = "naca:0012"
    designer = problem.get("designer")
    needs_gradient = not (isinstance(designer, dict) and designer.get("name") == "cmaes")
    functions = []
    if callable(problem.get("objective")):
        call = problem["objective"]
        name = _calls.name_of_function(f"{_SOURCE}, objective", call, None, resume)
        functions.append((None, False, _of_flow(call, name, needs_gradient), name))
        problem["objective"] = "drag"
    if isinstance(problem.get("constraints"), (list, tuple)):
        problem["constraints"] = [_entry_of(entry, i, functions, needs_gradient, resume) for i, entry in enumerate(problem["constraints"])]
    try:
        text = json.dumps(problem, default=_plain, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise ArgumentTypeError(f"problem: {error}, expected what a problem file may have, or an Airfoil or a function where docs say so") from None
    return text, _SOURCE, *airfoils, functions, *start


def _of_degree(airfoil, degree):
    """With the degree of the problem, where it has one: what is none is refused with the rest of the text."""
    given = isinstance(degree, (int, np.integer)) and not isinstance(degree, bool) and 1 <= degree <= 30
    return airfoil.with_degree(int(degree)) if given else airfoil


def _start_of(given):
    """The run that a search begins with a design of, and its number: None for the best one."""
    if given is None:
        return None, None
    if not isinstance(given, dict) or "history" not in given or set(given) - {"history", "design"}:
        raise ArgumentTypeError(f"{_SOURCE}, start: found {_calls.shown(given)}, expected a dict with 'history' and perhaps 'design'")
    if not isinstance(given["history"], (str, os.PathLike)):
        raise ArgumentTypeError(f"{_SOURCE}, start: found {_calls.shown(given['history'])} as 'history', expected a path")
    number = given.get("design", "best")
    if number == "best":
        return given["history"], None
    if isinstance(number, bool) or not isinstance(number, (int, np.integer)) or number < 1:
        raise ArgumentTypeError(f"{_SOURCE}, start: found {_calls.shown(number)} as 'design', expected a number from 1 or 'best'")
    return given["history"], int(number)


def _plain(value):
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"found {_calls.shown(value)}")


def _entry_of(entry, index, functions, needs_gradient, resume):
    if not isinstance(entry, dict):
        return entry
    place = f"{_SOURCE}, constraint {index + 1}"
    own = [key for key in ("flow_function", "design_function") if key in entry]
    if not own:
        return entry
    if len(own) == 2 or "kind" in entry:
        raise ArgumentError(f"{place}: found several of kind, flow_function and design_function, expected one of them")
    key, call = own[0], entry[own[0]]
    if not callable(call):
        raise ArgumentTypeError(f"{place}, {key}: found {_calls.shown(call)}, expected a function")
    name = _calls.name_of_function(f"{place}, {key}", call, entry.get("name"), resume)
    if not isinstance(name, str) or not name:
        raise ArgumentTypeError(f"{place}, name: found {_calls.shown(name)}, expected a text")
    known = ("flow_function", "at_least", "at_most", "point", "name") if key == "flow_function" else ("design_function", "name")
    for other in entry:
        if other not in known:
            raise ArgumentError(f"{place}: found the key {other!r}, expected {', '.join(known)}")
    is_of_design = key == "design_function"
    wrapped = _of_design(call, name, needs_gradient) if is_of_design else _of_flow(call, name, needs_gradient)
    functions.append((index, is_of_design, wrapped, name))
    if is_of_design:
        return {"kind": "drag", "at_most": 0}
    return {"kind": "drag", **{limit: entry[limit] for limit in ("at_least", "at_most", "point") if limit in entry}}


def _value_and_slope(answer, name, needs_gradient):
    """(value, derivatives or None) of what a function has returned."""
    value, slope = answer if isinstance(answer, tuple) and len(answer) == 2 else (answer, None)
    if isinstance(value, (str, bytes, complex, np.complexfloating)) or np.ndim(value) != 0 or value is None:
        raise ArgumentTypeError(f"{name}: returned {_calls.shown(answer)}, expected a number, or a pair of a number and its derivatives")
    if slope is None and needs_gradient:
        raise ArgumentTypeError(f"{name}: returned no derivatives, which the designer 'sqp' needs, expected a pair of a number and its derivatives")
    _calls.finite(f"{name}, value", float(value))
    _calls.finite(f"{name}, gradient", slope)
    return float(value), slope


def _of_flow(call, name, needs_gradient):
    def asked(flow):
        value, slope = _value_and_slope(call(flow), name, needs_gradient)
        if slope is not None and not isinstance(slope, dict):
            raise ArgumentTypeError(f"{name}, gradient: found {_calls.shown(slope)}, expected a dict")
        return value, slope or {}

    return asked


def _of_design(call, name, needs_gradient):
    def asked(design, domain):
        answers = call(design, domain)
        answers = answers if isinstance(answers, list) else [answers]
        pairs = [_value_and_slope(answer, name, needs_gradient) for answer in answers]
        return [(value, np.zeros(len(design)) if slope is None else np.asarray(slope, dtype=float)) for value, slope in pairs]

    return asked
