"""A facade with the call names of IDWarp's USMesh, for programs that warp a mesh by its surface.

Coordinates are of shape (n, 3), with z = 0. Here the interior rests and surface vertices move alone, as far as the
mesh stays valid, Delaunay and of its quality; where connectivity would have to change warpMesh() raises
TopologyChanged, and the mesh is as it was.
"""

import numpy as np

from ._core import FrozenMesh, check
from ._errors import ArgumentError, TopologyChanged


class USMesh:
    """Warps a Mesh. surface: names of the boundaries that move; unless given, all but `farfield`."""

    def __init__(self, mesh, surface=None):
        self._start = mesh.freeze()
        self._angle = min(mesh.min_angle, 30.0)
        boundaries = self._start.boundaries
        names = [name for name in boundaries if name != "farfield"] if surface is None else list(surface)
        for name in names:
            if name not in boundaries:
                raise ArgumentError(f"surface: found '{name}', expected one of {', '.join(boundaries)}")
        self._surface = np.unique(np.concatenate([boundaries[name].ravel() for name in names])).astype(np.int64)
        self._points = np.array(self._start.points)
        self._wanted = self._points[self._surface]
        self._derivative = None

    def getSurfaceCoordinates(self):
        """Where the surface's vertices are to lie."""
        return self._solid(self._wanted)

    def setSurfaceCoordinates(self, coordinates):
        """coordinates: of shape (n, 3), in the order of getSurfaceCoordinates()."""
        coordinates = np.asarray(coordinates, dtype=float)
        if coordinates.shape != (len(self._surface), 3):
            raise ArgumentError(f"coordinates: found shape {coordinates.shape}, expected ({len(self._surface)}, 3)")
        if not np.all(np.isfinite(coordinates)):
            raise ArgumentError("coordinates: found what is not finite, expected numbers")
        self._wanted = coordinates[:, :2].copy()

    def warpMesh(self):
        """Moves the vertices. Raises TopologyChanged where no valid mesh has this connectivity."""
        points = self._points.copy()
        points[self._surface] = self._wanted
        warped = FrozenMesh(points, self._start.triangles, self._start.boundaries)
        result = check(warped, min_angle=self._angle)
        if not result.valid:
            violation = result.violations[0]
            raise TopologyChanged(f"{violation.rule}: {violation.detail}, expected a design that keeps the connectivity")
        self._points = points

    def getSolverGrid(self):
        """All coordinates, flat: x, y, z of each vertex."""
        return self._solid(self._points).ravel()

    def warpDeriv(self, dXv, solverVec=True):
        """Derivatives by all coordinates (flat) become those by the surface's: getdXs() has them."""
        dXv = np.asarray(dXv, dtype=float)
        if dXv.size != 3 * len(self._points):
            raise ArgumentError(f"dXv: found {dXv.size} numbers, expected {3 * len(self._points)}")
        self._derivative = dXv.reshape(-1, 3)[self._surface] * [1.0, 1.0, 0.0]

    def warpDerivFwd(self, dXs, solverVec=True):
        """How all coordinates (flat) move with the surface's, of shape (n, 3)."""
        dXs = np.asarray(dXs, dtype=float)
        if dXs.shape != (len(self._surface), 3):
            raise ArgumentError(f"dXs: found shape {dXs.shape}, expected ({len(self._surface)}, 3)")
        moved = np.zeros((len(self._points), 3))
        moved[self._surface] = dXs * [1.0, 1.0, 0.0]
        return moved.ravel()

    def getdXs(self):
        """The result of the last warpDeriv(), of shape (n, 3)."""
        if self._derivative is None:
            raise ArgumentError("getdXs: called first, expected warpDeriv() before it")
        return self._derivative

    @staticmethod
    def _solid(points):
        return np.column_stack([points, np.zeros(len(points))])
