"""Derivatives by the points of a mesh, which know their mesh."""

import numpy as np

from ._errors import ArgumentError


class PointGradient(np.ndarray):
    """An array of shape (n, 2) with the mesh whose points it is by, a FrozenMesh: Mesh.vjp() refuses that of another
    mesh. Sums and multiples know it too; those of two meshes are refused. np.asarray() leaves it out."""

    mesh = None

    def __array_finalize__(self, source):
        self.mesh = getattr(source, "mesh", None)

    def __array_ufunc__(self, function, method, *inputs, out=None, **options):
        mesh = _common_mesh([value.mesh for value in inputs if isinstance(value, PointGradient)])
        plain = [np.asarray(value) if isinstance(value, PointGradient) else value for value in inputs]
        if out is not None:
            options["out"] = tuple(np.asarray(value) if isinstance(value, PointGradient) else value for value in out)
        result = getattr(function, method)(*plain, **options)
        if out is not None and isinstance(out[0], PointGradient):
            out[0].mesh = mesh
            return out[0]
        return of_mesh(result, mesh) if isinstance(result, np.ndarray) else result

    def __reduce__(self):
        return of_mesh, (np.array(self), self.mesh)


def _common_mesh(meshes):
    known = [mesh for mesh in meshes if mesh is not None]
    for other in known[1:]:
        same = other is known[0] or np.array_equal(other.points, known[0].points) and np.array_equal(other.triangles, known[0].triangles) and np.array_equal(other.quads, known[0].quads)
        if not same:
            raise ArgumentError("gradient: found derivatives by the points of two meshes, expected those of one")
    return known[0] if known else None


def of_mesh(values, mesh):
    """The array as one that knows its mesh."""
    result = values.view(PointGradient)
    result.mesh = mesh
    return result
