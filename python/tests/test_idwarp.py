"""IDWarp's own sequence of calls (its tests/test_USMesh.py), on meshes of the plane."""

import numpy as np
import pytest
import remodel
from remodel.idwarp import USMesh


@pytest.fixture
def file(mesh, tmp_path):
    mesh.save(tmp_path / "grid.su2")
    return tmp_path / "grid.su2"


def moved_by(kind, x):
    angle = np.radians(10.0)
    turn = np.array([[np.cos(angle), -np.sin(angle), 0.0], [np.sin(angle), np.cos(angle), 0.0], [0.0, 0.0, 1.0]])
    bump = np.column_stack([0 * x[:, 0], 0.01 * np.sin(np.pi * np.sqrt(np.clip(x[:, 0], 0, 1))) ** 3 * (x[:, 1] > 0), 0 * x[:, 0]])
    return {"plunge": x + [0.0, 0.1, 0.0], "pitch": x @ turn.T, "inflate": x * [1.1, 1.2, 1.3], "shear": x + 0.05 * np.column_stack([x[:, 1], 0 * x[:, 0], 0 * x[:, 0]]), "bump": x + bump}[kind]


@pytest.mark.parametrize("kind", ["plunge", "pitch", "inflate", "shear", "bump"])
@pytest.mark.parametrize("points", [60, 200])
def test_eval_warp(tmp_path, kind, points):
    remodel.generate("naca:0012", points=points).save(tmp_path / "grid.su2")
    options = {"gridFile": str(tmp_path / "grid.su2"), "fileType": "CGNS", "aExp": 3.0, "bExp": 5.0, "LdefFact": 1.0, "alpha": 0.25, "errTol": 0.0005, "evalMode": "fast", "symmTol": 1e-6, "useRotations": True, "bucketSize": 8}
    mesh = USMesh(options=options)
    first = mesh.getSurfaceCoordinates()
    common = mesh.getCommonGrid()
    mesh.setSurfaceCoordinates(moved_by(kind, first))
    mesh.warpMesh()
    warped = mesh.getWarpGrid().reshape(-1, 3)
    frozen = remodel.read_frozen(tmp_path / "grid.su2")
    there = frozen.with_points(warped[:, :2])
    assert there.check(delaunay=False).valid and there.check().min_angle_deg > 10.0
    assert np.array_equal(common.reshape(-1, 3)[:, :2], frozen.points)
    wall = np.unique(frozen.boundaries["airfoil"])
    assert np.allclose(warped[wall, :2], moved_by(kind, first)[:, :2], atol=1e-14)
    assert np.array_equal(warped[np.unique(frozen.boundaries["farfield"]), :2], frozen.points[np.unique(frozen.boundaries["farfield"])])
    weights = np.linspace(0.0, 1.0, len(common))
    mesh.warpDeriv(weights, solverVec=False)
    by_surface = mesh.getdXs()
    assert by_surface.shape == first.shape and np.all(by_surface[:, 2] == 0)
    forward = mesh.warpDerivFwd(np.ones(first.size), solverVec=False)
    assert np.isclose(by_surface.sum(), weights @ forward, rtol=1e-12)
    rows = mesh.verifyWarpDeriv(weights, solverVec=False, dofStart=0, dofEnd=9)
    assert rows.shape == (9, 3) and np.all(rows[:, 2] < 1e-6) and np.any(rows[:, 0] != 0)
    assert np.array_equal(mesh.getWarpGrid().reshape(-1, 3), warped) and np.array_equal(mesh.getdXs(), by_surface)
    mesh.writeGrid(str(tmp_path / "out.su2"))
    assert np.allclose(remodel.read_frozen(tmp_path / "out.su2").points, warped[:, :2], atol=1e-14)


def test_a_surface_and_an_order_of_the_solvers_own(mesh):
    """A mesh one cell thick: every vertex of the plane is two points of the surface, in an order of its own."""
    warp = USMesh(mesh)
    ring = mesh.boundaries["airfoil"][:, 0]
    plane = mesh.points[ring]
    pts = np.concatenate([np.column_stack([plane, 0 * plane[:, 0]]), np.column_stack([plane, 0 * plane[:, 0] + 1.0])])
    n = len(ring)
    conn = np.array([[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)])
    warp.setSurfaceDefinition(pts, conn, np.full(n, 4))
    order = np.random.default_rng(1).permutation(3 * len(mesh.points))[:500]
    warp.setExternalMeshIndices(order)
    assert np.array_equal(warp.getSurfaceCoordinates(), pts)
    warp.setSurfaceCoordinates((pts + [0.0, 0.05, 0.0]).ravel())
    warp.warpMesh()
    grid = warp.getSolverGrid()
    assert grid.shape == (500,) and np.array_equal(grid, warp.getWarpGrid()[order])
    assert np.allclose(warp.getWarpGrid().reshape(-1, 3)[ring, 1], plane[:, 1] + 0.05)
    weights, step = np.random.default_rng(3).standard_normal(500), np.random.default_rng(4).standard_normal(pts.shape)
    warp.warpDeriv(weights)
    assert np.isclose(np.sum(warp.getdXs() * step), weights @ warp.warpDerivFwd(step), rtol=1e-11)
    assert np.all(warp.verifyWarpDeriv(dofEnd=6)[:, 2] < 1e-6)


def test_parts_of_the_surface_and_names(tmp_path):
    elements = [{"name": "main", "airfoil": remodel.Airfoil("naca:0012")}, {"name": "flap", "airfoil": remodel.Airfoil("naca:0012"), "chord": 0.3, "rotation": -20, "position": (1.05, -0.05)}]
    mesh = remodel.generate(remodel.Domain.airfoils(elements, points=60), gradation=1.5)
    warp = USMesh(mesh, surface=["flap"])
    warp.setSurfaceCoordinates(warp.getSurfaceCoordinates() + [0.01, -0.01, 0.0])
    warp.warpMesh()
    moved = np.any(warp.getWarpGrid().reshape(-1, 3)[:, :2] != mesh.points, axis=1)
    assert not moved[np.unique(mesh.boundaries["main"])].any() and moved[np.unique(mesh.boundaries["flap"])].all()
    mesh.save(tmp_path / "m.su2")
    by_option = USMesh(options={"gridFile": str(tmp_path / "m.su2"), "specifiedSurfaces": ["FLAP"]})
    assert len(by_option.getSurfaceCoordinates()) == len(warp.getSurfaceCoordinates())


def test_what_cannot_be_warped_is_refused_and_leaves_the_grid(mesh, file):
    warp = USMesh(options={"gridFile": str(file)})
    surface, grid = warp.getSurfaceCoordinates(), warp.getSolverGrid()
    with pytest.raises(remodel.ArgumentError, match="getdXs"):
        warp.getdXs()
    warp.setSurfaceCoordinates(surface * [1.0, -1.0, 1.0])
    with pytest.raises(remodel.TopologyChanged, match="^surface: the grid is not valid"):
        warp.warpMesh()
    flat = surface * [1.0, 1.0, 1.0]
    flat[surface[:, 1] > 0.03, 1] = -0.08  # the upper surface crosses the lower one
    warp.setSurfaceCoordinates(flat)
    with pytest.raises(remodel.TopologyChanged, match="^surface: the grid is not valid"):
        warp.warpMesh()
    assert np.array_equal(warp.getSolverGrid(), grid)
    for call in (
        lambda: warp.setSurfaceCoordinates(surface[:-1]), lambda: warp.setSurfaceCoordinates(surface + 1j), lambda: warp.setSurfaceCoordinates(surface * np.nan),
        lambda: warp.setSurfaceCoordinates(surface + [0, 0, 1]), lambda: warp.warpDeriv(grid[:-1]), lambda: warp.warpDerivFwd(grid),
        lambda: warp.setSurfaceDefinition(surface + 0.5), lambda: warp.setExternalMeshIndices([-1]), lambda: warp.writeGrid(), lambda: warp.setOption("nothing", 1),
        lambda: USMesh(), lambda: USMesh(options={}), lambda: USMesh(options={"gridFile": "a.cgns"}), lambda: USMesh(mesh, surface=["nobody"]),
        lambda: USMesh(options={"gridFile": str(file), "symmetryPlanes": [[[0, 0, 0], [0, 1, 0]]]}), lambda: USMesh(mesh, comm=type("Comm", (), {"size": 2})()),
    ):  # fmt: skip
        with pytest.raises(remodel.ArgumentError):
            call()
    USMesh(options={"gridFile": str(file), "symmetryPlanes": [[[0, 0, 0], [0, 0, 1]]]})
    with pytest.warns(UserWarning, match="aExp: has no effect"):
        USMesh(options={"gridFile": str(file), "aExp": 2.0})


@pytest.mark.parametrize("kind", ["plunge", "pitch", "inflate", "shear", "bump"])
def test_layers_on_walls_go_with_them(tmp_path, kind):
    mesh = remodel.generate_layered("naca:0012", reynolds=1e6, growth=1.4)
    mesh.freeze().save(tmp_path / "grid.su2")
    for warp in (USMesh(options={"gridFile": str(tmp_path / "grid.su2")}), USMesh(mesh)):
        first = warp.getSurfaceCoordinates()
        warp.setSurfaceCoordinates(0.5 * (first + moved_by(kind, first)))
        warp.warpMesh()
        frozen = mesh.freeze()
        there = frozen.with_points(warp.getWarpGrid().reshape(-1, 3)[:, :2])
        assert len(there.quads) == len(frozen.quads) and there.check(delaunay=False).valid
        before, after = (first_heights(m) for m in (frozen, there))
        assert np.all(np.abs(after / before - 1.0) < (0.01 if kind in ("plunge", "pitch") else 0.15))
        weights = np.random.default_rng(5).standard_normal(3 * len(frozen.points))
        step = np.random.default_rng(6).standard_normal(first.shape)
        warp.warpDeriv(weights)
        assert np.isclose(np.sum(warp.getdXs() * step), weights @ warp.warpDerivFwd(step), rtol=1e-10)


def first_heights(mesh):
    """The distance of the second points of the columns on the airfoil from their feet."""
    wall, p = np.unique(mesh.boundaries["airfoil"]), mesh.points
    on_wall = np.zeros(len(p), dtype=bool)
    on_wall[wall] = True
    sides = np.concatenate([mesh.quads[:, [k, (k + 1) % 4]] for k in range(4)])
    up = sides[on_wall[sides[:, 0]] & ~on_wall[sides[:, 1]]]
    return np.hypot(*(p[up[:, 1]] - p[up[:, 0]]).T)
