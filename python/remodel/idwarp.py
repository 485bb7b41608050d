"""IDWarp's USMesh by InteriorDisplacement, for programs that warp a mesh by its surface.

    from remodel.idwarp import USMesh

    mesh = USMesh(options={"gridFile": "wing.su2"})    # or USMesh(a_mesh)
    surface = mesh.getSurfaceCoordinates()
    mesh.setSurfaceCoordinates(surface + [0.0, 0.1, 0.0])
    mesh.warpMesh()
    grid = mesh.getSolverGrid()

The calls are IDWarp's, in its order and with its arrays: the grid flat (x, y, z of each point, z as in the file), the
surface of shape (n, 3). Surfaces may be flat where they are handed in. The method is IDWarp's, inverse-distance
weighting with rotations (E. Luke, E. Collins and E. Blades, J. Comput. Phys. 231, 2012), of edges, in the plane, and
linear: warpDeriv() and warpDerivFwd() are exact at every surface. Connectivity stays, so that triangles get worse with
the distance; where one turns over, or walls cross, warpMesh() raises TopologyChanged, and the grid is as it was. Mesh.update() goes on
from there. Grids with quadrilaterals, as layers on walls have them, are warped too: cells of a layer go with the wall.
"""

import os
import warnings

import numpy as np

from . import _calls
from ._core import FrozenMesh, InteriorDisplacement, LayeredMesh, Mesh, import_mesh, read_frozen
from ._errors import ArgumentError, ArgumentTypeError, TopologyChanged
from ._mesh import Validity

_FILE_OPTIONS = {"gridFile": None, "fileType": "CGNS", "specifiedSurfaces": None, "symmetrySurfaces": None, "symmetryPlanes": None, "restartFile": None}
# Of IDWarp's own method: they have no effect here, and a line says so where one is not what it is by default.
_METHOD_OPTIONS = {
    "aExp": 3.0, "bExp": 5.0, "LdefFact": 1.0, "alpha": 0.25, "errTol": 0.0005, "evalMode": "fast", "symmTol": 1e-6,
    "useRotations": True, "zeroCornerRotations": True, "cornerAngle": 30.0, "bucketSize": 8,
}  # fmt: skip
_NEAR = 1e-9  # of the grid's size: a point of a surface definition is a vertex of the grid


class USMesh:
    """Warps a mesh. options: a dict of IDWarp's options, or a Mesh, LayeredMesh or FrozenMesh. comm: of one process. debug: has no
    effect. surface: names of the boundaries that move, as the option specifiedSurfaces; unless given, all but
    `farfield`."""

    def __init__(self, options=None, comm=None, debug=False, *, surface=None):
        if comm is not None and not hasattr(comm, "size"):
            raise ArgumentTypeError(f"comm: found {_calls.shown(comm)}, expected a communicator of MPI, or None")
        if comm is not None and comm.size != 1:
            raise ArgumentError(f"comm: found {comm.size} processes, expected one: a mesh is whole in each process")
        mesh = options if isinstance(options, (Mesh, LayeredMesh, FrozenMesh)) else None
        self._options = {**_FILE_OPTIONS, **_METHOD_OPTIONS}
        for name, value in ({} if mesh is not None else self._dict(options)).items():
            self.setOption(name, value)
        self._refuse_symmetry()
        self._read(mesh)
        self._names = self._boundaries(surface if surface is not None else self.getOption("specifiedSurfaces"))
        self._vertices = self._derivative = None

    @staticmethod
    def _dict(options):
        if not isinstance(options, dict):
            raise ArgumentTypeError(f"options: found {_calls.shown(options)}, expected a dict of options, or a mesh")
        return options

    def getOption(self, name):
        """The value of an option."""
        if not isinstance(name, str) or name not in self._options:
            raise ArgumentError(f"name: found {_calls.shown(name)}, expected one of {', '.join(self._options)}")
        return self._options[name]

    def setOption(self, name, value):
        """Gives an option another value."""
        self.getOption(name)
        if name in _METHOD_OPTIONS and value != _METHOD_OPTIONS[name]:
            warnings.warn(f"{name}: has no effect, the exponents and weights here are fixed (remodel/displacement.h)", stacklevel=2)
        self._options[name] = value

    def _refuse_symmetry(self):
        if self.getOption("symmetrySurfaces"):
            raise ArgumentError("symmetrySurfaces: found some, expected none: points of a line of symmetry would leave it")
        for plane in self.getOption("symmetryPlanes") or []:
            normal = np.asarray(plane, dtype=float).reshape(2, 3)[1]
            if normal[0] != 0.0 or normal[1] != 0.0:
                raise ArgumentError("symmetryPlanes: found one across the plane of the mesh, expected none or that of the mesh")

    def _read(self, mesh):
        """The mesh that is warped, and the grid, whose points are in the file's order."""
        if mesh is None:
            file = self.getOption("gridFile")
            if file is None:
                raise ArgumentError("gridFile: not given, expected the name of a mesh file: .vtkhdf, .vtu, .msh or .su2")
            if not isinstance(file, (str, os.PathLike)):
                raise ArgumentTypeError(f"gridFile: found {_calls.shown(file)}, expected the name of a file")
            if os.path.splitext(file)[1].lower() == ".cgns":
                raise ArgumentError(f"gridFile: found {file}, expected .vtkhdf, .vtu, .msh or .su2 (meshio reads CGNS; USMesh(remodel.from_meshio(...)))")
            grid, alive = read_frozen(file), lambda: Mesh.load(file)
        elif isinstance(mesh, FrozenMesh):
            grid, alive = mesh, lambda: import_mesh(mesh)
        else:
            grid, alive = mesh.freeze(), mesh.copy
        self._grid = np.array(grid.points)
        self._mesh = grid if len(grid.quads) else alive()
        self._start = grid if len(grid.quads) else self._mesh.freeze()
        self._validity = Validity(self._start)
        self._size = float(np.ptp(self._grid, axis=0).max())
        self._external = None
        self._place_of = _matches(self._grid, self._start.points, 0.0)  # per point of the grid; -1 where no triangle has it
        self._points = np.array(self._start.points)

    def _boundaries(self, names):
        there = self._start.boundaries
        if names is None:
            return [name for name in there if name != "farfield"]
        if not isinstance(names, (list, tuple)) or not all(isinstance(name, str) for name in names):
            raise ArgumentTypeError(f"surface: found {_calls.shown(names)}, expected a list of names of boundaries")
        by_lower = {name.lower(): name for name in there}  # IDWarp lowers the names of families
        for name in names:
            if name not in there and name.lower() not in by_lower:
                raise ArgumentError(f"surface: found '{name}', expected one of {', '.join(there)}")
        return [name if name in there else by_lower[name.lower()] for name in names]

    def setSurfaceDefinition(self, pts, conn=None, faceSizes=None, cgnsBlockID=None):
        """The surface that moves: points of shape (n, 3), each at a boundary vertex of the grid. Points with one x and y
        (the two sides of a mesh one cell thick) are one vertex, which moves by their mean. conn, faceSizes: the cells
        between them, checked and not needed: the mesh knows its boundaries."""
        pts = _calls.reals("pts", pts)
        if pts.ndim != 2 or pts.shape[1] != 3:
            raise ArgumentError(f"pts: found an array of shape {pts.shape}, expected (n, 3)")
        boundary = np.unique(np.concatenate([edges.ravel() for edges in self._start.boundaries.values()]))
        found = _matches(pts[:, :2], self._start.points[boundary], _NEAR * self._size)
        if np.any(found < 0):
            lost = int(np.argmax(found < 0))
            raise ArgumentError(f"pts[{lost}]: found {pts[lost, 0]:.9g}, {pts[lost, 1]:.9g}, where the grid has no boundary vertex, expected one")
        if conn is not None:
            conn = _integers("conn", conn)
            if len(conn) and (conn.min() < 0 or conn.max() >= len(pts)):
                raise ArgumentError(f"conn: found {conn.min()} to {conn.max()}, expected 0 to {len(pts)} - 1")
            corners = None if faceSizes is None else int(np.sum(_integers("faceSizes", faceSizes)))
            if corners is not None and corners != len(conn):
                raise ArgumentError(f"faceSizes: found {corners} corners, expected {len(conn)}")
        self._define(boundary[found].astype(np.int64), pts)

    def _define(self, vertices, coordinates):
        self._vertices, self._first, self._wanted = vertices, np.array(coordinates), np.array(coordinates)
        self._shares = np.bincount(vertices, minlength=len(self._start.points))[vertices]
        moving = np.zeros(len(self._start.points), dtype=bool)
        moving[vertices] = True
        self._field = InteriorDisplacement(self._mesh, [name for name, edges in self._start.boundaries.items() if moving[edges].any()])

    def _set_internal_surface(self):
        if self._vertices is None:
            edges = [self._start.boundaries[name].ravel() for name in self._names]
            vertices = np.unique(np.concatenate(edges)).astype(np.int64) if edges else np.zeros(0, dtype=np.int64)
            self._define(vertices, self._solid(self._start.points[vertices]))

    def setExternalMeshIndices(self, ind):
        """The solver's grid: for each of its numbers the place in the flat grid of the file, from 0."""
        ind = np.asarray(ind)
        if ind.ndim != 1 or len(ind) and (ind.dtype.kind not in "iu" or ind.min() < 0 or ind.max() >= 3 * len(self._grid)):
            raise ArgumentError(f"ind: found {_calls.shown(ind)}, expected integers from 0 to {3 * len(self._grid)} - 1 in one dimension")
        self._external = ind.astype(np.int64)

    def getSurfaceCoordinates(self):
        """Where the points of the surface are to lie, of shape (n, 3)."""
        self._set_internal_surface()
        return self._wanted.copy()

    def setSurfaceCoordinates(self, coordinates):
        """coordinates: of shape (n, 3), or flat, in the order of getSurfaceCoordinates(). z stays as it is."""
        self._set_internal_surface()
        wanted = self._of_surface("coordinates", coordinates)
        if np.abs(wanted[:, 2] - self._first[:, 2]).max(initial=0.0) > _NEAR * self._size:
            raise ArgumentError("coordinates: found points at another z, expected them to move in the plane of the mesh")
        self._wanted = wanted.copy()

    def _of_surface(self, name, values):
        values = _calls.reals(name, values)
        shape = (len(self._vertices), 3)
        if values.shape not in (shape, (3 * len(self._vertices),)):
            raise ArgumentError(f"{name}: found an array of shape {values.shape}, expected {shape}")
        return values.reshape(shape)

    def _along(self, moved):
        """All points' displacements where those of the surface are these."""
        walls = np.zeros((len(self._start.points), 2))
        np.add.at(walls, self._vertices, moved[:, :2] / self._shares[:, None])
        return self._field.jvp(walls)

    def warpMesh(self):
        """Moves the grid. Raises TopologyChanged where a triangle would turn over or walls would cross."""
        self._set_internal_surface()
        points = self._start.points + self._along(self._wanted - self._first)
        broken = self._validity.broken(self._start.with_points(points))
        if broken:
            raise TopologyChanged(f"surface: the grid is not valid ({broken}), expected a surface nearer to the grid's own, or Mesh.update()")
        self._points = points

    def _solid(self, points):
        return np.column_stack([points, np.zeros(len(points))])

    def _common(self, values, unused):
        """Values of the mesh's points, of shape (n, 2), in the order of the file, flat."""
        result = self._solid(np.where(self._place_of[:, None] >= 0, values[self._place_of], unused))
        return result.ravel()

    def getCommonGrid(self):
        """The grid in the file's order, flat: x, y, z of each point."""
        return self._common(self._points, self._grid)

    def getWarpGrid(self):
        """The same: there is one order here besides the solver's."""
        return self.getCommonGrid()

    def getSolverGrid(self):
        """The grid in the solver's order (setExternalMeshIndices()), flat."""
        return self._to_solver(self.getCommonGrid())

    def _to_solver(self, values):
        return values if self._external is None else values[self._external]

    def warpDeriv(self, dXv, solverVec=True):
        """Derivatives by the grid (flat; in the solver's order unless told otherwise) become those by the surface:
        getdXs() has them."""
        self._set_internal_surface()
        dXv = _calls.reals("dXv", dXv).ravel()
        size = 3 * len(self._grid) if not solverVec or self._external is None else len(self._external)
        if dXv.size != size:
            raise ArgumentError(f"dXv: found {dXv.size} numbers, expected {size}")
        if solverVec and self._external is not None:
            common = np.zeros(3 * len(self._grid))
            np.add.at(common, self._external, dXv)
            dXv = common
        by_points = np.zeros((len(self._start.points), 2))
        there = self._place_of >= 0
        np.add.at(by_points, self._place_of[there], dXv.reshape(-1, 3)[there, :2])
        by_walls = self._field.vjp(by_points)
        self._derivative = self._solid(by_walls[self._vertices] / self._shares[:, None])

    def warpDerivFwd(self, dXs, solverVec=True):
        """How the grid moves (flat) with the surface, of shape (n, 3) or flat."""
        self._set_internal_surface()
        moved = self._common(self._along(self._of_surface("dXs", dXs)), 0.0)
        return self._to_solver(moved) if solverVec else moved

    def getdXs(self):
        """The result of the last warpDeriv(), of shape (n, 3)."""
        if self._derivative is None:
            raise ArgumentError("getdXs: called first, expected warpDeriv() before it")
        return self._derivative.copy()

    def verifyWarpDeriv(self, dXv=None, solverVec=True, dofStart=0, dofEnd=10, h=1e-6, randomSeed=314):
        """Compares warpDeriv() with differences of warpMesh(), numbers dofStart to dofEnd - 1 of the flat surface. Returns
        an array of shape (k, 3): the derivative, the difference, and how far they are apart, over the larger one."""
        for name, value in (("dofStart", dofStart), ("dofEnd", dofEnd), ("randomSeed", randomSeed)):
            if not isinstance(value, (int, np.integer)) or not 0 <= value < 2**32:
                raise ArgumentTypeError(f"{name}: found {_calls.shown(value)}, expected an integer from 0 to {2**32 - 1}")
        if not isinstance(solverVec, (bool, np.bool_)):
            raise ArgumentTypeError(f"solverVec: found {_calls.shown(solverVec)}, expected True or False")
        if not float(_calls.reals("h", h, ())) > 0.0:
            raise ArgumentError(f"h: found {h}, expected a step above 0")
        self._set_internal_surface()
        if dXv is None:
            size = 3 * len(self._grid) if not solverVec or self._external is None else len(self._external)
            dXv = np.random.RandomState(randomSeed).random_sample(size)
        kept = self._points, self._wanted, self._derivative
        try:
            self.warpDeriv(dXv, solverVec)
            exact, weights, rows = self._derivative.ravel(), np.asarray(dXv, dtype=float).ravel(), []
            for number in range(dofStart, min(dofEnd, exact.size)):
                grids = []
                for sign in (1.0, -1.0):
                    self._wanted = kept[1].copy()
                    if number % 3 < 2:  # z rests
                        self._wanted.reshape(-1)[number] += sign * h
                    self.warpMesh()
                    grids.append(self.getSolverGrid() if solverVec else self.getWarpGrid())
                difference = float(weights @ (grids[0] - grids[1])) / (2.0 * h)
                scale = max(abs(exact[number]), abs(difference))
                rows.append([exact[number], difference, abs(exact[number] - difference) / scale if scale > 0.0 else 0.0])
        finally:
            self._points, self._wanted, self._derivative = kept
        return np.array(rows).reshape(-1, 3)

    def writeGrid(self, fileName=None):
        """Writes the grid: .vtkhdf, .vtu, .msh or .su2."""
        if fileName is None:
            raise ArgumentError("fileName: not given, expected the name of a file")
        self._start.with_points(self._points).save(fileName)


def _integers(name, values):
    """A flat array. Throws ArgumentTypeError unless the values are integers."""
    values = np.asarray(values).ravel()
    if len(values) and values.dtype.kind not in "iu":
        raise ArgumentTypeError(f"{name}: found {_calls.shown(values)}, expected integers")
    return values


def _matches(points, among, distance):
    """For each point the number of one of `among` that is no farther than that, -1 where there is none."""
    if distance == 0.0:
        numbers = {place: number for number, place in enumerate(map(tuple, among.tolist()))}
        return np.array([numbers.get(place, -1) for place in map(tuple, points.tolist())], dtype=np.int64)
    order = np.argsort(among[:, 0], kind="stable")
    x, found = among[order, 0], np.full(len(points), -1, dtype=np.int64)
    for number, point in enumerate(points):
        low, high = np.searchsorted(x, point[0] - distance), np.searchsorted(x, point[0] + distance, side="right")
        near = order[low:high]
        if len(near):
            apart = np.hypot(*(among[near] - point).T)
            if apart.min() <= distance:
                found[number] = near[np.argmin(apart)]
    return found
