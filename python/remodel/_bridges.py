"""Meshes of meshio and PyVista. Neither is imported before one of these functions is called."""

import numpy as np

from ._core import FrozenMesh
from ._errors import ArgumentError


def to_meshio(mesh, fields=None):
    """The mesh as a meshio.Mesh: triangles, then the boundary as lines, with boundary names as cell sets.

    fields: values on points or triangles, by name.
    """
    import meshio

    points = np.column_stack([mesh.points, np.zeros(len(mesh.points))])
    cells = [("triangle", mesh.triangles.astype(np.int64))]
    sets = {}
    for name, edges in mesh.boundaries.items():
        sets[name] = [np.arange(0)] * len(cells) + [np.arange(len(edges))]
        cells.append(("line", edges.astype(np.int64)))
    sets = {name: parts + [np.arange(0)] * (len(cells) - len(parts)) for name, parts in sets.items()}
    result = meshio.Mesh(points, cells, cell_sets=sets)
    for name, values in (fields or {}).items():
        values = np.asarray(values)
        if len(values) == len(points):
            result.point_data[name] = values
        elif len(values) == len(mesh.triangles):
            shape = values.shape[1:]
            lines = [np.full((len(block), *shape), np.nan) for _, block in cells[1:]]
            result.cell_data[name] = [values, *lines]
        else:
            raise ArgumentError(f"{name}: found {len(values)} values, expected one a point or one a triangle")
    return result


def from_meshio(mesh):
    """The triangles of a meshio.Mesh as a FrozenMesh, with boundaries by cell set or physical name.

    Lines of no set are left out; import_mesh() names boundary edges that have no name.
    """
    triangles = [block.data for block in mesh.cells if block.type == "triangle"]
    if not triangles:
        raise ArgumentError("mesh: found no triangles, expected some")
    boundaries = {}
    names = {tag: name for name, (tag, dimension) in mesh.field_data.items() if dimension == 1}
    physical = mesh.cell_data.get("gmsh:physical")
    for index, block in enumerate(mesh.cells):
        if block.type != "line":
            continue
        for name, parts in mesh.cell_sets.items():
            if not name.startswith("gmsh:") and parts[index] is not None and len(parts[index]) > 0:
                boundaries.setdefault(name, []).append(block.data[np.asarray(parts[index], dtype=np.int64)])
        if physical is not None:
            for tag in np.unique(physical[index]):
                name = names.get(tag, str(tag))
                if name not in mesh.cell_sets:
                    boundaries.setdefault(name, []).append(block.data[physical[index] == tag])
    return FrozenMesh(mesh.points[:, :2], np.concatenate(triangles), {name: np.concatenate(parts) for name, parts in boundaries.items()})


def to_pyvista(mesh, fields=None):
    """The mesh as a pyvista.UnstructuredGrid of triangles, with fields by name."""
    import pyvista

    points = np.column_stack([mesh.points, np.zeros(len(mesh.points))])
    cells = np.column_stack([np.full(len(mesh.triangles), 3), mesh.triangles]).ravel()
    grid = pyvista.UnstructuredGrid(cells, np.full(len(mesh.triangles), 5), points)
    for name, values in (fields or {}).items():
        (grid.point_data if len(values) == len(points) else grid.cell_data)[name] = np.asarray(values)
    return grid

