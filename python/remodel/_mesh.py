"""What the classes of the compiled part get in Python: arrays of the present mesh, pictures, bridges."""

import os
import tempfile

import numpy as np

from . import _bridges, _calls, _plot
from ._core import FlowResult, FrozenMesh, LayeredMesh, LayeredStep, Mesh, PotentialFlow, Step, Transfer, check
from ._errors import ArgumentError

_ARRAYS = {
    "points": "Coordinates of shape (n, 2), in chords: a read-only view.",
    "triangles": "Point indices of shape (m, 3), counter-clockwise: a read-only view.",
    "quads": "Quadrilaterals: point indices of shape (q, 4), counter-clockwise; a read-only view.",
    "boundaries": "By name: pairs of point indices of shape (k, 2), the domain on their left.",
    "vertex_ids": "Per point: the vertex's id, stable while it lives.",
    "vertex_keys": "Per point: a number that is never given to another vertex of this mesh.",
    "triangle_ids": "Per triangle: its id.",
    "birth": "Per triangle: the step that made it; 0 is generation.",
    "length_scale": "Per point: the length scale, in chords.",
    "curve": "Per point: the index of its curve, -1 in the interior.",
    "parameter": "Per point: t on that curve.",
    "region": "Per cell, triangles first: an index into region_names; empty where there is one region.",
    "region_names": "The names of regions.",
}


# Those that a mesh with layers has too.
_LAYERED_ARRAYS = ("points", "triangles", "quads", "boundaries", "vertex_keys", "length_scale", "curve", "parameter", "region", "region_names")


def _array(name):
    return property(lambda mesh: getattr(mesh.freeze(), name), doc=_ARRAYS[name])


def _draw(mesh, file, *, window=None, width=1600):
    """Writes a picture, .svg or .png. window: x0, y0, x1, y1 in chords."""
    mesh.freeze().draw(file, window=window, width=width)


def _svg(mesh):
    """What notebooks show: the mesh around its bodies."""
    frozen = mesh.freeze() if hasattr(mesh, "freeze") else mesh
    if len(frozen.triangles) + len(frozen.quads) == 0:
        return None
    with tempfile.TemporaryDirectory() as directory:
        file = os.path.join(directory, "mesh.svg")
        frozen.draw(file, window=_plot.close_window(frozen), width=720)
        with open(file, encoding="utf-8") as text:
            return text.read()


@_calls.python_call(place="str")
def _matrix(transfer, place="vertices"):
    """ride() as a sparse matrix of shape (after, before): scipy.sparse.csr_array, whose transpose is for adjoints."""
    from scipy.sparse import csr_array

    rows, columns, weights, after, before = transfer._entries(place)
    return csr_array((weights, (rows, columns)), shape=(after, before))


def _step_transfer(step):
    """Carries values from the mesh before the step to the mesh after it. Needs update(..., record=True)."""
    if step.before is None:
        raise ArgumentError("step: its arrays were not kept, expected update(..., record=True)")
    return Transfer(step.before, step.after)


class Validity:
    """Whether a frozen mesh is still valid with its points elsewhere: no triangle turns over, and no wall crosses itself
    or another, which triangles alone do not show. Of a mesh that is not valid itself (loops that touch, say) triangles
    are looked at alone."""

    def __init__(self, start):
        self._whole = check(start, delaunay=False).valid

    def broken(self, mesh):
        """The first rule that is broken, as text; empty if none is."""
        if self._whole:
            found = check(mesh, delaunay=False).violations
            return f"{found[0].rule}: {found[0].detail}" if found else ""
        a, b, c = (mesh.points[mesh.triangles[:, corner]] for corner in range(3))
        (ux, uy), (vx, vy) = (b - a).T, (c - a).T
        over = np.flatnonzero(~(ux * vy - uy * vx > 0.0))
        return f"orientation: triangle {over[0]} is clockwise or has no area" if len(over) else ""


def _check(mesh, *, min_angle=0.0, max_gradation=0.0, delaunay=True, delaunay_slack=None):
    return check(mesh, min_angle=min_angle, max_gradation=max_gradation, delaunay=delaunay, delaunay_slack=delaunay_slack)


def extend():
    for name in _ARRAYS:
        setattr(Mesh, name, _array(name))
    for name in _LAYERED_ARRAYS:
        setattr(LayeredMesh, name, _array(name))
    Mesh.draw = LayeredMesh.draw = _draw
    _check.__doc__ = check.__doc__
    FrozenMesh.check = _check
    for kind in (Mesh, LayeredMesh, FrozenMesh):
        kind.plot = _plot.plot_mesh
        kind.to_meshio = _bridges.to_meshio
        kind.to_pyvista = _bridges.to_pyvista
        kind._repr_svg_ = _svg
    Transfer.matrix = _matrix
    Step.transfer = LayeredStep.transfer = property(_step_transfer, doc=_step_transfer.__doc__)
    FlowResult.plot_cp = PotentialFlow.plot_cp = _plot.plot_cp
    Step.plot = LayeredStep.plot = _plot.plot_step
