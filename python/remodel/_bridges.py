"""Meshes of meshio and PyVista, with the names of boundaries and regions. Neither is imported before one of these
functions is called."""

import warnings
from collections.abc import Mapping

import numpy as np

from . import _calls
from ._core import FrozenMesh
from ._errors import ArgumentError, ArgumentTypeError

_PHYSICAL = "gmsh:physical"
_BOUNDARY = "boundary:"  # then the name: pairs of points among PyVista's field data
_REGION, _REGION_NAMES = "region", "region_names"
_VTK_LINE, _VTK_TRIANGLE, _VTK_QUAD = 3, 5, 9


def _placed(mesh, fields):
    """The fields as arrays, each with whether it is on points."""
    result = {}
    if not isinstance(fields, (Mapping, type(None))):
        raise ArgumentTypeError(f"fields: found {_calls.shown(fields)}, expected a dict of values by name")
    for name, values in (fields or {}).items():
        values = np.asarray(values)
        if values.ndim == 0:
            raise ArgumentTypeError(f"{name}: found {_calls.shown(fields[name])}, expected an array of values")
        on_points = len(values) == len(mesh.points)
        if not on_points and len(values) != len(mesh.triangles) + len(mesh.quads):
            cell = "cell" if len(mesh.quads) else "triangle"
            raise ArgumentError(f"{name}: found {len(values)} values, expected one a point or one a {cell}")
        result[name] = on_points, values
    return result


def _flat(points, what):
    """x and y. Throws ArgumentError where z is not the same everywhere: it would be lost."""
    points = np.asarray(points, dtype=float)
    if points.shape[1] > 2 and np.ptp(points[:, 2]) > 0.0:
        raise ArgumentError(f"{what}: found z from {points[:, 2].min():.9g} to {points[:, 2].max():.9g}, expected a mesh in the plane of x and y")
    return points[:, :2]


def to_meshio(mesh, fields=None):
    """The mesh as a meshio.Mesh: triangles, a block for each region, quadrilaterals likewise, then the boundary as lines,
    a block for each name.

    Names are cell sets, and physical groups as Gmsh has them, which meshio writes to .msh (file_format='gmsh22'). fields:
    values on points or cells, by name.
    """
    import meshio

    points = np.column_stack([mesh.points, np.zeros(len(mesh.points))])
    blocks = []
    for kind, cells, first in (("triangle", mesh.triangles, 0), ("quad", mesh.quads, len(mesh.triangles))):
        if len(mesh.region):
            region = mesh.region[first : first + len(cells)]
            rows = [(name, np.flatnonzero(region == number)) for number, name in enumerate(mesh.region_names)]
        else:
            rows = [(None, np.arange(len(cells)))]
        blocks += [(kind, name, cells[row].astype(np.int64), first + row) for name, row in rows if len(row)]
    blocks += [("line", name, edges.astype(np.int64), None) for name, edges in mesh.boundaries.items()]
    names = [(1 if kind == "line" else 2, name) for kind, name, _, _ in blocks if name is not None]
    tags = {key: number + 1 for number, key in enumerate(dict.fromkeys(names))}

    sets = {}
    for index, (_, name, cells, _) in enumerate(blocks):
        if name is not None:
            sets.setdefault(name, [np.arange(0)] * len(blocks))[index] = np.arange(len(cells))
    cell_data = {}
    if tags:
        of_block = lambda kind, name: tags.get((1 if kind == "line" else 2, name), 0)
        cell_data[_PHYSICAL] = [np.full(len(cells), of_block(kind, name), dtype=np.int32) for kind, name, cells, _ in blocks]
        cell_data["gmsh:geometrical"] = [column.copy() for column in cell_data[_PHYSICAL]]
    result = meshio.Mesh(
        points, [(kind, cells) for kind, _, cells, _ in blocks], cell_sets=sets, cell_data=cell_data,
        field_data={name: np.array([tag, dimension]) for (dimension, name), tag in tags.items()})  # fmt: skip
    for name, (on_points, values) in _placed(mesh, fields).items():
        if on_points:
            result.point_data[name] = values
        else:
            empty = lambda cells: np.full((len(cells), *values.shape[1:]), np.nan)
            result.cell_data[name] = [empty(cells) if row is None else values[row] for _, _, cells, row in blocks]
    return result


def _split(cells):
    """Quadrilaterals as two triangles each."""
    return np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])


@_calls.python_call(split_quadrilaterals="bool")
def from_meshio(mesh, *, split_quadrilaterals=False):
    """The triangles and quadrilaterals of a meshio.Mesh as a FrozenMesh, with boundaries and regions by cell set or
    physical name.

    split_quadrilaterals: each quadrilateral becomes two triangles. Other cells than these, lines and vertices are
    refused. Lines of no set are left out, and so are points that no cell has, with a UserWarning; import_mesh() names
    boundary edges that have no name. Raises ArgumentError.
    """
    if not hasattr(mesh, "cells") or not hasattr(mesh, "cell_sets"):
        raise ArgumentTypeError(f"mesh: found an object of type {type(mesh).__name__}, expected a meshio.Mesh")
    triangles, quads, lines = [], [], []
    for index, block in enumerate(mesh.cells):
        data = np.asarray(block.data)
        if block.type == "triangle":
            triangles.append((index, data, 1))
        elif block.type == "quad" and split_quadrilaterals:
            triangles.append((index, _split(data), 2))
        elif block.type == "quad":
            quads.append((index, data, 1))
        elif block.type == "line":
            lines.append((index, data))
        elif block.type != "vertex":
            raise ArgumentError(f"mesh: found {len(data)} cells of type {block.type}, expected triangles, quadrilaterals and lines")
    if not triangles and not quads:
        raise ArgumentError("mesh: found no triangles, expected some")

    boundaries = {}
    for index, data in lines:
        for name, cells in _named(mesh, index, 1):
            boundaries.setdefault(name, []).append(data[cells])
    region, names, first = np.full(sum(len(cells) for _, cells, _ in triangles + quads), -1, dtype=np.int64), [], 0
    for index, _, copies in triangles + quads:
        count = len(mesh.cells[index].data)
        for name, cells in _named(mesh, index, 2):
            if name not in names:
                names.append(name)
            for copy in range(copies):
                region[first + copy * count + np.asarray(cells)] = names.index(name)
        first += copies * count
    if len(names) == 1 and region.min() == 0:
        names = []  # one region is none
    if names and region.min() < 0:
        region[region < 0], names = len(names), [*names, ""]
    regions = {"region": region, "region_names": names} if names else {}
    joined = {name: np.concatenate(parts) for name, parts in boundaries.items()}
    joined_cells = lambda parts, corners: np.concatenate([np.empty((0, corners), dtype=np.int64), *(cells for _, cells, _ in parts)])
    return _frozen("mesh", mesh.points, joined_cells(triangles, 3), joined_cells(quads, 4), joined, regions)


def _frozen(name, points, triangles, quads, boundaries, regions):
    """The FrozenMesh, without the points that no cell has (Gmsh keeps centres of arcs) and the edges at these."""
    points = _flat(points, name)
    rows = [triangles.ravel(), quads.ravel(), *(edges.ravel() for edges in boundaries.values())]
    indices = np.concatenate(rows).astype(np.int64)
    used = np.isin(np.arange(len(points)), np.concatenate(rows[:2]))
    if used.all() or indices.min() < 0 or indices.max() >= len(points):  # no such point: FrozenMesh says so
        return FrozenMesh(points, triangles, boundaries, quads=quads, **regions)
    warnings.warn(f"{name}: {np.count_nonzero(~used)} points that no cell has are left out", stacklevel=4)
    index = np.cumsum(used) - 1
    kept = {wall: edges[used[edges].all(axis=1)] for wall, edges in boundaries.items()}
    boundaries = {wall: index[edges] for wall, edges in kept.items() if len(edges)}
    return FrozenMesh(points[used], index[triangles], boundaries, quads=index[quads], **regions)


def _named(mesh, index, dimension):
    """The parts of one block of cells that have names: pairs of name and cells."""
    for name, parts in mesh.cell_sets.items():
        if not name.startswith("gmsh:") and parts[index] is not None and len(parts[index]) > 0:
            yield name, np.asarray(parts[index], dtype=np.int64)
    for key in (_PHYSICAL, "su2:tag", "medit:ref", "boundary" if dimension == 1 else _REGION):
        if key not in mesh.cell_data:
            continue
        names, column = _names_of_tags(mesh, key, dimension), np.asarray(mesh.cell_data[key][index])
        for tag in np.unique(column):
            name = names.get(int(tag), str(tag))
            if (int(tag) in names or dimension == 1) and name not in mesh.cell_sets and tag >= 0:
                yield name, np.flatnonzero(column == tag)
        return


def _names_of_tags(mesh, key, dimension):
    """The names of the numbers in a column of cells: Gmsh's physical names, those of this library's .vtu files, or what
    meshio makes of cell sets in files that have none, a column with the names joined by '-'."""
    listed = mesh.field_data.get(f"{key}_names")
    if listed is not None:
        return dict(enumerate(bytes(np.asarray(listed, dtype=np.uint8)).decode("utf-8", "replace").split("\0")[:-1]))
    names = {int(data[0]): name for name, data in mesh.field_data.items() if np.size(data) == 2 and int(data[1]) == dimension}
    if names or key not in (_PHYSICAL, "medit:ref"):
        return names
    for other, columns in mesh.cell_data.items():
        joined = other.split("-")
        if other.startswith("gmsh:") or other == key or not all(np.issubdtype(np.asarray(column).dtype, np.integer) for column in columns):
            continue
        sets, tags = np.concatenate(columns), np.concatenate(mesh.cell_data[key])
        if set(np.unique(sets)) - {-1} == set(range(len(joined))):
            return {int(tags[sets == number][0]): name for number, name in enumerate(joined)}
    return names


def to_pyvista(mesh, fields=None):
    """The mesh as a pyvista.UnstructuredGrid of triangles, then quadrilaterals, with fields by name.

    Boundaries are pairs of points among its field data, `boundary:` and their name; regions the cells' numbers `region`
    and the field data `region_names`. from_pyvista() reads them.
    """
    import pyvista

    points = np.column_stack([mesh.points, np.zeros(len(mesh.points))])
    counted = [np.column_stack([np.full(len(cells), cells.shape[1]), cells]).ravel() for cells in (mesh.triangles, mesh.quads)]
    kinds = np.repeat([_VTK_TRIANGLE, _VTK_QUAD], [len(mesh.triangles), len(mesh.quads)])
    grid = pyvista.UnstructuredGrid(np.concatenate(counted), kinds, points)
    for name, edges in mesh.boundaries.items():
        grid.field_data[_BOUNDARY + name] = edges.astype(np.int64)
    if len(mesh.region):
        grid.cell_data[_REGION] = np.asarray(mesh.region)
        grid.field_data[_REGION_NAMES] = np.array(mesh.region_names)
    for name, (on_points, values) in _placed(mesh, fields).items():
        if values.ndim == 2 and values.shape[1] == 2:  # VTK takes only arrays of three components for vectors
            values = np.column_stack([values, np.zeros(len(values))])
        (grid.point_data if on_points else grid.cell_data)[name] = values
    return grid


@_calls.python_call(split_quadrilaterals="bool")
def from_pyvista(grid, *, split_quadrilaterals=False):
    """The triangles and quadrilaterals of a pyvista.UnstructuredGrid as a FrozenMesh, with the boundaries and regions of
    to_pyvista().

    split_quadrilaterals and other cells as in from_meshio(). Raises ArgumentError.
    """
    if not hasattr(grid, "cells_dict"):
        raise ArgumentTypeError(f"grid: found an object of type {type(grid).__name__}, expected a pyvista.UnstructuredGrid")
    blocks = {int(kind): np.asarray(cells) for kind, cells in grid.cells_dict.items()}
    triangles = blocks.get(_VTK_TRIANGLE, np.empty((0, 3), dtype=np.int64))
    quads = blocks.get(_VTK_QUAD, np.empty((0, 4), dtype=np.int64))
    copies = 1
    if split_quadrilaterals:
        triangles, quads, copies = np.concatenate([triangles, _split(quads)]), quads[:0], 2
    for kind, cells in blocks.items():
        if kind not in (1, _VTK_LINE, _VTK_TRIANGLE, _VTK_QUAD):
            raise ArgumentError(f"grid: found {len(cells)} cells of VTK's type {kind}, expected triangles, quadrilaterals and lines")
    if len(triangles) + len(quads) == 0:
        raise ArgumentError("grid: found no triangles, expected some")
    boundaries = {name[len(_BOUNDARY) :]: np.asarray(grid.field_data[name]) for name in grid.field_data if name.startswith(_BOUNDARY)}
    regions = {}
    if _REGION_NAMES in grid.field_data and _REGION in grid.cell_data:
        kinds, region = np.asarray(grid.celltypes), np.asarray(grid.cell_data[_REGION])
        rows = [region[kinds == _VTK_TRIANGLE], np.tile(region[kinds == _VTK_QUAD], copies)]
        regions = {"region": np.concatenate(rows).astype(np.int64), "region_names": [str(name) for name in grid.field_data[_REGION_NAMES]]}
    return _frozen("grid", grid.points, triangles, quads, boundaries, regions)
