"""Pictures by matplotlib, which is imported when the first one is made."""

import numpy as np

from . import _calls
from ._errors import ArgumentError, ArgumentTypeError

FATES = ("#e8ecef", "#f2c14e", "#d1495b")  # kept, moved, new


def close_window(mesh):
    """x0, y0, x1, y1 around everything but the largest boundary: where the bodies are."""
    corners = []
    for edges in mesh.boundaries.values():
        points = mesh.points[edges.ravel()]
        corners.append(np.concatenate([points.min(axis=0), points.max(axis=0)]))
    if not corners:
        corners = [np.concatenate([mesh.points.min(axis=0), mesh.points.max(axis=0)])]
    corners = np.array(corners)
    extents = (corners[:, 2:] - corners[:, :2]).max(axis=1)
    inner = corners[extents < extents.max()] if len(corners) > 1 and extents.min() < extents.max() else corners
    low, high = inner[:, :2].min(axis=0), inner[:, 2:].max(axis=0)
    margin = 0.15 * (high - low).max()
    return [float(v) for v in (low[0] - margin, low[1] - margin, high[0] + margin, high[1] + margin)]


def _require_axes(ax):
    if ax is not None and not hasattr(ax, "add_collection"):
        raise ArgumentTypeError(f"ax: found {_calls.shown(ax)}, expected axes of matplotlib or None")


def _axes(ax, mesh, window):
    _require_axes(ax)
    if ax is None:
        import matplotlib.pyplot as plt

        _, ax = plt.subplots(figsize=(8, 4.5))
    x0, y0, x1, y1 = _calls.reals("window", window, (4,)) if window is not None else close_window(mesh)
    ax.set(xlim=(x0, x1), ylim=(y0, y1), aspect="equal", xlabel="x", ylabel="y")
    return ax


def _halves(mesh):
    """Triangles to draw, quadrilaterals as two of them, and which cell each of them is of."""
    quads, count = mesh.quads, len(mesh.triangles)
    of_quads = count + np.arange(len(quads))
    return np.concatenate([mesh.triangles, quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]), np.concatenate([np.arange(count), of_quads, of_quads])


def _seen(mesh, ax):
    """The triangles (_halves) that are in the window: the others would only take time."""
    corners = mesh.points[_halves(mesh)[0]]
    low, high = corners.min(axis=1), corners.max(axis=1)
    (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
    return (high[:, 0] >= x0) & (low[:, 0] <= x1) & (high[:, 1] >= y0) & (low[:, 1] <= y1)


def _edges(mesh, seen):
    """Each edge of the cells of these triangles once, as points of shape (k, 2, 2)."""
    cells = np.unique(_halves(mesh)[1][seen])
    triangles = mesh.triangles[cells[cells < len(mesh.triangles)]].astype(np.int64)
    quads = mesh.quads[cells[cells >= len(mesh.triangles)] - len(mesh.triangles)].astype(np.int64)
    sides = [part[:, [k, (k + 1) % part.shape[1]]] for part in (triangles, quads) for k in range(part.shape[1])]
    pairs = np.sort(np.concatenate(sides), axis=1)
    codes = np.unique(pairs[:, 0] * len(mesh.points) + pairs[:, 1])
    return mesh.points[np.column_stack([codes // len(mesh.points), codes % len(mesh.points)])]


def _add_lines(ax, segments, **style):
    from matplotlib.collections import LineCollection

    ax.add_collection(LineCollection(segments, **style), autolim=False)


def _add_boundaries(ax, mesh, **style):
    for edges in mesh.boundaries.values():
        _add_lines(ax, mesh.points[edges], **{"colors": "#1d3557", "linewidths": 1.2, **style})


def _add_colors(ax, mesh, color, seen, cmap):
    values = _calls.reals("color", color)
    triangles, cells = _halves(mesh)
    if values.ndim != 1 or len(values) not in (len(mesh.points), len(mesh.triangles) + len(mesh.quads)):
        raise ArgumentError(f"color: found shape {values.shape}, expected one value a point or one a triangle")
    x, y = mesh.points.T
    if len(values) == len(mesh.points):
        return ax.tripcolor(x, y, triangles[seen], values, shading="gouraud", cmap=cmap)
    return ax.tripcolor(x, y, triangles[seen], facecolors=values[cells[seen]], cmap=cmap)


@_calls.python_call(edges="bool")
def plot_mesh(mesh, color=None, ax=None, *, window=None, cmap="viridis", label=None, edges=None):
    """Draws the mesh with matplotlib and returns the axes.

    color: values of shape (n,) at points, smooth, or of shape (m,) on cells; or 'age', 'length_scale'.
    window: x0, y0, x1, y1; unless given, where the bodies are. label: of the colour bar, drawn if there is one.
    edges: whether triangles have edges; unless given, where there is no color.
    """
    mesh = mesh.freeze() if hasattr(mesh, "freeze") else mesh
    ax = _axes(ax, mesh, window)
    seen = _seen(mesh, ax)
    if isinstance(color, str):
        if color not in ("age", "length_scale"):
            raise ArgumentError(f"color: found '{color}', expected values, 'age' or 'length_scale'")
        color = mesh.birth.max(initial=0) - mesh.birth.astype(float) if color == "age" else np.log(mesh.length_scale)
    if color is not None:
        mapped = _add_colors(ax, mesh, color, seen, cmap)
        if label is not None:
            ax.figure.colorbar(mapped, ax=ax, label=label)
    if edges or (edges is None and color is None):
        _add_lines(ax, _edges(mesh, seen), colors="#5b7083", linewidths=0.4)
    _add_boundaries(ax, mesh)
    return ax


def plot_step(step, ax=None, *, window=None):
    """Draws what a step did, with matplotlib: kept triangles are pale, moved ones yellow, new ones red."""
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    mesh, fates = step.after, step.fates
    ax = _axes(ax, mesh, window)
    seen = _seen(mesh, ax)
    x, y = mesh.points.T
    triangles, cells = _halves(mesh)
    ax.tripcolor(x, y, triangles[seen], facecolors=fates[cells[seen]].astype(float), cmap=ListedColormap(FATES), vmin=0, vmax=2)
    _add_lines(ax, _edges(mesh, seen), colors="#8d99a6", linewidths=0.3)
    _add_boundaries(ax, mesh)
    counts = np.bincount(fates, minlength=3)
    names = [f"{name}: {count}" for name, count in zip(("kept", "moved", "new"), counts)]
    ax.legend(handles=[Patch(facecolor=color, edgecolor="#8d99a6", label=name) for color, name in zip(FATES, names)], loc="upper right")
    return ax


def _new_axes(ax):
    _require_axes(ax)
    if ax is None:
        import matplotlib.pyplot as plt

        _, ax = plt.subplots(figsize=(8, 4.5))
    return ax


def plot_history(result, ax=None):
    ax = _new_axes(ax)
    evaluation, objective = result.column("evaluation"), result.column("objective")
    ax.plot(evaluation, np.where(np.isfinite(objective), objective, np.nan), ".", color="#8d99a6", markersize=3, label="objective")
    ax.plot(evaluation, result.column("best_objective"), color="#d1495b", label="best so far")
    if np.nanmin(objective) > 0:
        ax.set_yscale("log")
    ax.set(xlabel="evaluation", ylabel="objective")
    ax.legend()
    return ax


def plot_cp(flow, ax=None):
    """Draws the pressure coefficients along the walls over x, negative ones upwards, with matplotlib."""
    ax = _new_axes(ax)
    if hasattr(flow, "mesh"):
        cp = flow.cp
        walls = {name: np.unique(edges) for name, edges in flow.mesh.boundaries.items() if name in flow.bodies}
        lines = {name: (flow.mesh.points[wall, 0], cp[wall]) for name, wall in walls.items()}
    else:
        lines = {name: (body["points"][:, 0], body["cp"]) for name, body in flow.bodies.items()}
    for name, (x, cp) in lines.items():
        ax.plot(x, cp, ".", markersize=4, label=name)
    if not ax.yaxis_inverted():
        ax.invert_yaxis()
    ax.set(xlabel="x", ylabel="pressure coefficient")
    ax.legend()
    return ax
