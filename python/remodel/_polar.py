"""polar(): rows of flows over angles of attack or lifts, on one mesh."""

import warnings
from types import SimpleNamespace

import numpy as np

from . import _calls
from ._core import LivingFlow, _polars
from ._errors import ArgumentError


class PolarCurve(SimpleNamespace):
    """A row of flows at one Mach number. Arrays have a value for each flow, ascending: alpha, cl, cd, cm, cd_pressure,
    cd_friction, y_plus_max, converged and asked (bool; not asked: in between, where a halved step led). NaN is what there is
    none of. Lists likewise: status, reason (why there is no flow), warnings_of.

    bodies: for each wall by its name a dict of such arrays. cl_max and alpha_of_cl_max are of the largest lift found;
    cl_max_passed: flows with less lift were found at larger angles. warnings, mach.
    """

    COLUMNS = ("alpha", "cl", "cd", "cm", "cd_pressure", "cd_friction", "y_plus_max", "converged", "asked", "status", "reason")

    @property
    def columns(self):
        """A dict of the columns, as pandas.DataFrame() takes it."""
        return {name: getattr(self, name) for name in self.COLUMNS}

    def __len__(self):
        return len(self.alpha)

    def __repr__(self):
        return f"PolarCurve(mach={self.mach:.6g}, flows={len(self)}, found={int(self.converged.sum())}, cl_max={self.cl_max:.6g})"


@_calls.python_call(model="str", reynolds="float", reference_length="float", tolerance="float", max_steps="int",
                    memory_mb="float", halvings="int", misses="int")  # fmt: skip
def polar(mesh, *, mach=0.5, alpha=None, cl=None, model="euler", reynolds=0.0, transition=None, wall_temperature=None,
          reference=(0.25, 0.0), reference_length=1.0, farfield="farfield", tolerance=1e-10, max_steps=200,
          memory_mb=4096.0, halvings=3, misses=2):  # fmt: skip
    """Rows of flows over angles of attack, or lift coefficients, each found from the last one, past the largest lift as far as
    steady flows are found. Returns a PolarCurve, or, where `mach` is a sequence, a list of them.

    mesh: a Mesh, LayeredMesh or FrozenMesh; it stays as it is. alpha: degrees; or cl: lifts that angles are found for; both
    ascend. A row begins at the value that is nearest to 0. Where a flow is not found, the step from the last one is halved
    so many times (halvings); misses: so many values in a row without a flow end the row in that direction. All else as
    solve_flow() has it. A UserWarning says what has to be known of each row. Raises ArgumentError; Ctrl-C ends it.
    """
    if (alpha is None) == (cl is None):
        raise ArgumentError(f"alpha: {'not given' if alpha is None else 'given with cl'}, expected angles or lifts")
    asked = "cl" if alpha is None else "alpha"
    row = _calls.reals(asked, cl if alpha is None else alpha).ravel().tolist()
    if not row or any(after <= before for before, after in zip(row, row[1:])):
        raise ArgumentError(f"{asked}: found {'no value' if not row else 'values that do not ascend'}, expected one or more, each above the one before")
    machs = np.atleast_1d(_calls.reals("mach", mach)).tolist()
    for name, value, low, high in (("halvings", halvings, 0, 20), ("misses", misses, 1, 1000)):
        if not low <= value <= high:
            raise ArgumentError(f"{name}: found {value}, expected {low} to {high}")
    solver = LivingFlow(farfield=farfield, tolerance=tolerance, max_steps=max_steps, memory_mb=memory_mb, model=model)
    curves = [PolarCurve(**curve) for curve in _polars(mesh, solver, machs, row if cl is None else [], row if alpha is None else [],
                                                       tuple(reference), reference_length, reynolds, transition, wall_temperature, halvings, misses)]  # fmt: skip
    for curve in curves:
        for warning in curve.warnings:
            warnings.warn(f"M {curve.mach:.6g}: {warning}", stacklevel=3)
    return curves[0] if np.ndim(mach) == 0 else curves
