"""optimise(): the library's own loop around living meshes."""

import tempfile
from types import SimpleNamespace

import numpy as np

from . import _plot
from ._core import Airfoil, _optimise


class OptimiseResult(SimpleNamespace):
    """The figures of a run: objective, best (an Airfoil), best_design, evaluations, preserved_percent, stopped, ...

    rows: a dict for each evaluation. `result.column(name)` is one figure of all of them.
    """

    def column(self, name):
        """One figure of all evaluations as an array, say 'objective'; None becomes NaN."""
        return np.array([np.nan if row[name] is None else row[name] for row in self.rows])

    def plot_history(self, ax=None):
        """Draws the objective and the best so far over evaluations, with matplotlib; returns the axes."""
        return _plot.plot_history(self, ax)

    def __repr__(self):
        return f"OptimiseResult(evaluations={self.evaluations}, objective={self.objective:.6g}, stopped={self.stopped!r})"


def optimise(start, objective, *, directory=None, points=200, sigma=0.05, seed=1, evaluations=9000, tolerance=0.0,
             strategy="renew", workers=0, threads=None, resume=False, overwrite=False, callback=None):  # fmt: skip
    """Searches an airfoil by CMA-ES; one living mesh follows the designs. Returns an OptimiseResult.

    objective: an Airfoil to be interpolated (the paper's case), or a function of (design, mesh, step): the
    coefficients as an array, the design's mesh (FrozenMesh) and a dict of what the step did. It returns a number,
    the smaller the better, or a dict: objective, constraints (satisfied at most 0), outputs. It may raise
    EvaluationFailed for a design; any other exception ends the run and is raised here.

    callback: called after each evaluation with a dict of its figures; True ends the run. directory: keeps history,
    meshes and checkpoints, for resume=True. Ctrl-C ends the run with a checkpoint. strategy: 'renew', 'chain',
    'pool', 'hub' or 'regenerate'. threads: all cores for an Airfoil, one for a function, unless given. Raises
    ArgumentError, FileError, FormatError.
    """
    if not isinstance(start, Airfoil):
        start = Airfoil(start)
    if not (isinstance(objective, Airfoil) or callable(objective)):
        raise TypeError("objective: expected an Airfoil or a function of (design, mesh, step)")
    if callback is not None and not callable(callback):
        raise TypeError("callback: expected a function of a dict")
    if threads is None:
        threads = 0 if isinstance(objective, Airfoil) else 1
    options = (points, sigma, seed, evaluations, tolerance, strategy, workers, threads, resume, overwrite, callback)
    if directory is not None:
        return OptimiseResult(**_optimise(start, objective, directory, *options))
    with tempfile.TemporaryDirectory() as scratch:
        return OptimiseResult(**_optimise(start, objective, scratch, *options))
