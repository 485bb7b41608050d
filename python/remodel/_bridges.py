"""Meshes of meshio and PyVista, with the names of boundaries and regions. Neither is imported before one of these
functions is called."""

import numpy as np

from ._core import FrozenMesh
from ._errors import ArgumentError, ArgumentTypeError

_PHYSICAL = "gmsh:physical"
_BOUNDARY = "boundary:"  # then the name: pairs of points among PyVista's field data
_REGION, _REGION_NAMES = "region", "region_names"
_VTK_LINE, _VTK_TRIANGLE = 3, 5


def _placed(mesh, fields):
    """The fields as arrays, each with whether it is on points."""
    result = {}
    for name, values in (fields or {}).items():
        values = np.asarray(values)
        on_points = len(values) == len(mesh.points)
        if not on_points and len(values) != len(mesh.triangles):
            raise ArgumentError(f"{name}: found {len(values)} values, expected one a point or one a triangle")
        result[name] = on_points, values
    return result


def _flat(points, what):
    """x and y. Throws ArgumentError where z is not the same everywhere: it would be lost."""
    points = np.asarray(points, dtype=float)
    if points.shape[1] > 2 and np.ptp(points[:, 2]) > 0.0:
        raise ArgumentError(f"{what}: found z from {points[:, 2].min():.9g} to {points[:, 2].max():.9g}, expected a mesh in the plane of x and y")
    return points[:, :2]


def to_meshio(mesh, fields=None):
    """The mesh as a meshio.Mesh: triangles, a block for each region, then the boundary as lines, a block for each name.

    Names are cell sets, and physical groups as Gmsh has them, which meshio writes to .msh (file_format='gmsh22'). fields:
    values on points or triangles, by name.
    """
    import meshio

    points = np.column_stack([mesh.points, np.zeros(len(mesh.points))])
    triangles = mesh.triangles.astype(np.int64)
    if len(mesh.region):
        rows = [(name, np.flatnonzero(mesh.region == number)) for number, name in enumerate(mesh.region_names)]
    else:
        rows = [(None, np.arange(len(triangles)))]
    blocks = [("triangle", name, triangles[row], row) for name, row in rows if len(row)]
    blocks += [("line", name, edges.astype(np.int64), None) for name, edges in mesh.boundaries.items()]
    names = [(2 if kind == "triangle" else 1, name) for kind, name, _, _ in blocks if name is not None]
    tags = {key: number + 1 for number, key in enumerate(dict.fromkeys(names))}

    sets = {}
    for index, (_, name, cells, _) in enumerate(blocks):
        if name is not None:
            sets.setdefault(name, [np.arange(0)] * len(blocks))[index] = np.arange(len(cells))
    cell_data = {}
    if tags:
        of_block = lambda kind, name: tags.get((2 if kind == "triangle" else 1, name), 0)
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


def from_meshio(mesh, *, split_quadrilaterals=False):
    """The triangles of a meshio.Mesh as a FrozenMesh, with boundaries and regions by cell set or physical name.

    split_quadrilaterals: each becomes two triangles; otherwise they are refused, as other cells than triangles, lines
    and vertices are. Lines of no set are left out; import_mesh() names boundary edges that have no name. Raises
    ArgumentError.
    """
    if not hasattr(mesh, "cells") or not hasattr(mesh, "cell_sets"):
        raise ArgumentTypeError(f"mesh: found an object of type {type(mesh).__name__}, expected a meshio.Mesh")
    triangles, lines, rows = [], [], 0
    for index, block in enumerate(mesh.cells):
        data = np.asarray(block.data)
        if block.type == "triangle" or block.type == "quad" and split_quadrilaterals:
            copies = 1 if block.type == "triangle" else 2
            triangles.append((index, data if copies == 1 else _split(data), copies, rows))
            rows += copies * len(data)
        elif block.type == "line":
            lines.append((index, data))
        elif block.type != "vertex":
            hint = " (split_quadrilaterals=True makes two triangles of each)" if block.type == "quad" else ""
            raise ArgumentError(f"mesh: found {len(data)} cells of type {block.type}, expected triangles and lines{hint}")
    if not triangles:
        raise ArgumentError("mesh: found no triangles, expected some")

    boundaries = {}
    for index, data in lines:
        for name, cells in _named(mesh, index, 1):
            boundaries.setdefault(name, []).append(data[cells])
    region, names = np.full(rows, -1, dtype=np.int64), []
    for index, _, copies, first in triangles:
        count = len(mesh.cells[index].data)
        for name, cells in _named(mesh, index, 2):
            if name not in names:
                names.append(name)
            for copy in range(copies):
                region[first + copy * count + np.asarray(cells)] = names.index(name)
    if len(names) == 1 and region.min() == 0:
        names = []  # one region is none
    if names and region.min() < 0:
        region[region < 0], names = len(names), [*names, ""]
    regions = {"region": region, "region_names": names} if names else {}
    joined = {name: np.concatenate(parts) for name, parts in boundaries.items()}
    return FrozenMesh(_flat(mesh.points, "mesh"), np.concatenate([cells for _, cells, _, _ in triangles]), joined, **regions)


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
    """The mesh as a pyvista.UnstructuredGrid of triangles, with fields by name.

    Boundaries are pairs of points among its field data, `boundary:` and their name; regions the cells' numbers `region`
    and the field data `region_names`. from_pyvista() reads them.
    """
    import pyvista

    points = np.column_stack([mesh.points, np.zeros(len(mesh.points))])
    cells = np.column_stack([np.full(len(mesh.triangles), 3), mesh.triangles]).ravel()
    grid = pyvista.UnstructuredGrid(cells, np.full(len(mesh.triangles), _VTK_TRIANGLE), points)
    for name, edges in mesh.boundaries.items():
        grid.field_data[_BOUNDARY + name] = edges.astype(np.int64)
    if len(mesh.region):
        grid.cell_data[_REGION] = np.asarray(mesh.region)
        grid.field_data[_REGION_NAMES] = np.array(mesh.region_names)
    for name, (on_points, values) in _placed(mesh, fields).items():
        (grid.point_data if on_points else grid.cell_data)[name] = values
    return grid


def from_pyvista(grid, *, split_quadrilaterals=False):
    """The triangles of a pyvista.UnstructuredGrid as a FrozenMesh, with the boundaries and regions of to_pyvista().

    Quadrilaterals and other cells as in from_meshio(). Raises ArgumentError.
    """
    if not hasattr(grid, "cells_dict"):
        raise ArgumentTypeError(f"grid: found an object of type {type(grid).__name__}, expected a pyvista.UnstructuredGrid")
    blocks = {int(kind): np.asarray(cells) for kind, cells in grid.cells_dict.items()}
    triangles = [blocks[_VTK_TRIANGLE]] if _VTK_TRIANGLE in blocks else []
    quadrilaterals = blocks.get(9)
    if quadrilaterals is not None and split_quadrilaterals:
        triangles.append(_split(quadrilaterals))
    for kind, cells in blocks.items():
        if kind not in (1, _VTK_LINE, _VTK_TRIANGLE) and not (kind == 9 and split_quadrilaterals):
            hint = " (split_quadrilaterals=True makes two triangles of each)" if kind == 9 else ""
            raise ArgumentError(f"grid: found {len(cells)} cells of VTK's type {kind}, expected triangles and lines{hint}")
    if not triangles:
        raise ArgumentError("grid: found no triangles, expected some")
    boundaries = {name[len(_BOUNDARY) :]: np.asarray(grid.field_data[name]) for name in grid.field_data if name.startswith(_BOUNDARY)}
    regions = {}
    if _REGION_NAMES in grid.field_data and _REGION in grid.cell_data:
        kinds, region = np.asarray(grid.celltypes), np.asarray(grid.cell_data[_REGION])
        rows = [region[kinds == _VTK_TRIANGLE]] + [np.tile(region[kinds == 9], 2)] * (quadrilaterals is not None)
        regions = {"region": np.concatenate(rows).astype(np.int64), "region_names": [str(name) for name in grid.field_data[_REGION_NAMES]]}
    return FrozenMesh(_flat(grid.points, "grid"), np.concatenate(triangles), boundaries, **regions)
