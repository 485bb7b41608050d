"""sweep(): flows around many sections at many conditions, on living meshes."""

import json
import os
import tempfile
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from . import _calls
from ._core import Airfoil, _sweep, _sweep_page
from ._design import _plain, _text_of
from ._errors import ArgumentError, ArgumentTypeError

_SOURCE = "problem"  # what messages call a problem that is no file


class SweepResult(SimpleNamespace):
    """What a sweep found. Arrays have a value for each flow, ordered by section, Mach number, Reynolds number and value:
    section (an index of names and airfoils), mach, reynolds, asked (the angle or the lift), alpha, cl, cd, cm,
    cd_pressure, cd_friction, y_plus_max, converged (bool). NaN is what there is none of. Lists likewise: status, reason,
    warnings_of.

    With surface_stations: x (stations), cp and, with friction, cf, of shape (flows, 2 * stations): the upper surface from
    nose to trailing edge, then the lower one.

    names, airfoils (None: there is no such section), model, planned, found, not_found, flow_seconds,
    cold_seconds_estimate (as many flows at the mean time of those found cold), stopped, warnings, directory (None: it was
    a temporary one).
    """

    COLUMNS = ("section", "mach", "reynolds", "asked", "alpha", "cl", "cd", "cm", "cd_pressure", "cd_friction",
               "y_plus_max", "converged", "status", "reason")  # fmt: skip

    @property
    def columns(self):
        """A dict of the columns, as pandas.DataFrame() takes it."""
        return {name: getattr(self, name) for name in self.COLUMNS}

    def outlines(self, count=100):
        """The sections at the flows' rows: y of the upper surface at `count` stations from nose to trailing edge, then of
        the lower one, of shape (flows, 2 * count). NaN where there is no section."""
        if not isinstance(count, int) or not 2 <= count <= 100000:
            raise ArgumentError(f"count: found {_calls.shown(count)}, expected 2 to 100000")
        of_each = np.full((len(self.airfoils), 2 * count), np.nan)
        for row, airfoil in zip(of_each, self.airfoils):
            if airfoil is not None:
                heights = airfoil.coordinates(2 * count - 1)[:, 1]  # the nose is in the middle
                row[:] = [*heights[count - 1 :: -1], *heights[count - 1 :]]
        return of_each[self.section]

    def report(self, file=None):
        """Writes the page of the sweep; returns its path. file: in the sweep's directory, unless given."""
        if self.directory is None:
            raise ArgumentError("directory: the sweep had none, expected sweep(problem, directory=...) for a report")
        page = Path(self.directory) / "report.html" if file is None else Path(file)
        _sweep_page(self.directory, page)
        return page

    def __len__(self):
        return len(self.section)

    def __repr__(self):
        return f"SweepResult(flows={len(self)}, found={self.found}, sections={len(self.names)}, stopped={self.stopped!r})"


@_calls.python_call(directory="path", threads="int", resume="bool")
def sweep(problem, *, directory=None, resume=False, threads=0, callback=None):
    """Finds the flows around many sections at many conditions. Returns a SweepResult.

    problem: a dict with the keys of a sweep's file (docs/sweep.md), or the path of one. In a dict an entry of 'sections'
    may be an Airfoil.

    directory: keeps what is found, for resume=True and extensions, with table.csv and table.h5; a temporary one unless
    given. callback: called when a chain of sections is done, with a dict of flows, done and found; True ends the sweep.
    Ctrl-C ends it in order. threads: chains at the same time, 0 for all cores; the result does not depend on it. Raises
    ArgumentError, FileError, FormatError.
    """
    if callback is not None and not callable(callback):
        raise ArgumentTypeError(f"callback: found {_calls.shown(callback)}, expected a function of a dict")
    if not 0 <= threads <= 1024:
        raise ArgumentError(f"threads: found {threads}, expected 0 to 1024")
    if isinstance(problem, (str, os.PathLike)):
        parts = (_text_of(problem), os.fspath(problem))
    elif isinstance(problem, dict):
        parts = (_text(problem), _SOURCE)
    else:
        raise ArgumentTypeError(f"problem: found {_calls.shown(problem)}, expected a dict or the path of a sweep's file")
    if directory is not None:
        return _result(_sweep(*parts, directory, resume, threads, callback), os.fspath(directory))
    if resume:
        raise ArgumentError("resume: found without a directory, expected that of the sweep")
    with tempfile.TemporaryDirectory() as scratch:
        return _result(_sweep(*parts, scratch, False, threads, callback), None)


def _result(figures, directory):
    figures["converged"] = figures["converged"] == 1
    return SweepResult(**figures, directory=directory)


def _coefficients(airfoil):
    return {"degree": airfoil.degree, "upper": airfoil.upper.tolist(), "lower": airfoil.lower.tolist(), "e1": airfoil.e1,
            "e2": airfoil.e2, "te_upper": airfoil.te_upper, "te_lower": airfoil.te_lower}  # fmt: skip


def _text(problem):
    problem = dict(problem)
    sections = problem.get("sections")
    if isinstance(sections, (list, tuple)):
        problem["sections"] = [
            {"name": f"airfoil {i + 1}", "airfoil": _coefficients(entry)} if isinstance(entry, Airfoil) else entry
            for i, entry in enumerate(sections)
        ]
    try:
        return json.dumps(problem, default=_plain, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise ArgumentTypeError(f"problem: {error}, expected what a sweep's file may have, or an Airfoil as a section") from None
