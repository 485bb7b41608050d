import pickle
import sys
import types

import numpy as np
import pytest
import remodel


def test_nothing_is_imported_before_it_is_asked_for():
    import subprocess

    code = "import remodel, sys; print([m for m in ('matplotlib', 'scipy', 'meshio', 'pyvista', 'openmdao') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, check=True).stdout.strip() == "[]"


def two_regions():
    """A square whose halves are materials, with an inner line between them."""
    points = np.array([[0.0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [0, 1]])
    triangles = np.array([[0, 1, 4], [0, 4, 5], [1, 2, 3], [1, 3, 4]])
    boundaries = {"left": [[5, 0]], "floor": [[0, 1], [1, 2]], "right": [[2, 3]], "roof": [[3, 4], [4, 5]], "between": [[1, 4]]}
    return remodel.FrozenMesh(points, triangles, boundaries, region=[0, 0, 1, 1], region_names=["water", "oil"])


def named(mesh):
    """What has a name, by places: boundaries' edges, and regions' triangles."""
    places = lambda cells: sorted(sorted(map(tuple, np.round(mesh.points[cell], 12).tolist())) for cell in cells)
    boundaries = {name: places(edges) for name, edges in mesh.boundaries.items()}
    return boundaries, {name: places(mesh.triangles[mesh.region == number]) for number, name in enumerate(mesh.region_names)}


def test_meshio_there_and_back(mesh):
    pytest.importorskip("meshio")
    other = mesh.to_meshio({"height": mesh.points[:, 1], "birth": mesh.birth})
    assert np.array_equal(other.point_data["height"], mesh.points[:, 1])
    assert np.array_equal(other.cell_data["birth"][0], mesh.birth)
    back = remodel.from_meshio(other)
    assert np.array_equal(back.points, mesh.points) and np.array_equal(back.triangles, mesh.triangles)
    for name, edges in mesh.boundaries.items():
        assert np.array_equal(back.boundaries[name], edges)
    assert remodel.import_mesh(back).check().valid
    with pytest.raises(remodel.ArgumentError, match="^height: found 3 values"):
        mesh.to_meshio({"height": [1.0, 2.0, 3.0]})


def test_points_that_no_cell_has_are_left_out(mesh):
    meshio = pytest.importorskip("meshio")
    theirs = mesh.to_meshio()
    points = np.vstack([[[9.0, 9.0, 0.0]], theirs.points, [[8.0, 8.0, 0.0]]])
    cells = [(block.type, block.data + 1) for block in theirs.cells]
    more = meshio.Mesh(points, cells, cell_sets=theirs.cell_sets, cell_data=theirs.cell_data, field_data=theirs.field_data)
    with pytest.warns(UserWarning, match="2 points that no cell has"):
        back = remodel.from_meshio(more)
    whole = remodel.from_meshio(theirs)
    assert np.array_equal(back.points, whole.points) and np.array_equal(back.triangles, whole.triangles)
    assert named(back) == named(whole)
    beyond = meshio.Mesh(points, [("triangle", [[0, 1, 10**6]])])
    with pytest.raises(remodel.ArgumentError):
        remodel.from_meshio(beyond)


def test_meshio_keeps_regions(mesh):
    pytest.importorskip("meshio")
    regions = two_regions()
    back = remodel.from_meshio(regions.to_meshio({"number": np.arange(4.0)}))
    assert named(back) == named(regions) and len(named(back)[1]) == 2
    assert len(remodel.from_meshio(mesh.to_meshio()).region) == 0


@pytest.mark.parametrize("kind", ["ours", "regions"])
def test_names_pass_through_files_of_either_program(mesh, tmp_path, kind):
    meshio = pytest.importorskip("meshio")
    frozen = mesh.freeze() if kind == "ours" else two_regions()
    for name in ("ours.msh", "ours.vtu"):
        frozen.save(tmp_path / name)
        assert named(remodel.from_meshio(meshio.read(tmp_path / name))) == named(frozen), name
    frozen.to_meshio().write(tmp_path / "theirs.msh", file_format="gmsh22", binary=False)
    assert named(remodel.read_frozen(tmp_path / "theirs.msh")) == named(frozen)
    for name in ("theirs.msh", "theirs.vtu", "theirs.vtk"):
        if name != "theirs.msh":
            frozen.to_meshio().write(tmp_path / name)
        assert named(remodel.from_meshio(meshio.read(tmp_path / name))) == named(frozen), name


def mixed_mesh():
    """A square of two triangles beside one of a quadrilateral, which is another region."""
    points = [[0.0, 0], [1, 0], [2, 0], [2, 1], [1, 1], [0, 1]]
    boundaries = {"wall": [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 0]]}
    return remodel.FrozenMesh(
        points, [[0, 1, 4], [0, 4, 5]], boundaries, quads=[[1, 2, 3, 4]], region=[0, 0, 1], region_names=["air", "layer"])


def test_quadrilaterals_there_and_back(pyvista, tmp_path):
    mesh = mixed_mesh()
    assert mesh.quads.shape == (1, 4) and not mesh.quads.flags.writeable
    assert mesh.check().valid and mesh.check().quadrilaterals == 1 and mesh.check().area == 2.0
    backs = [remodel.from_pyvista(mesh.to_pyvista({"number": np.arange(3.0)})), pickle.loads(pickle.dumps(mesh))]
    for name in ("m.vtu", "m.msh", "m.vtkhdf"):
        mesh.save(tmp_path / name)
        backs.append(remodel.read_frozen(tmp_path / name))
    try:
        backs.append(remodel.from_meshio(mesh.to_meshio({"number": np.arange(3.0)})))
    except ImportError:
        pass
    for back in backs:
        assert np.array_equal(back.quads, mesh.quads) and np.array_equal(back.triangles, mesh.triangles)
        assert np.array_equal(back.region, mesh.region) and back.region_names == mesh.region_names
    with pytest.raises(remodel.ArgumentError, match="^number: found 2 values, expected one a point or one a cell"):
        mesh.to_pyvista({"number": [1.0, 2.0]})
    with pytest.raises(remodel.ArgumentError, match="^quads: row 0: found 9"):
        remodel.FrozenMesh(mesh.points, np.empty((0, 3), dtype=int), quads=[[0, 1, 2, 9]])


def test_quadrilaterals_do_not_live_on_unless_asked_for():
    with pytest.raises(remodel.GeometryError, match="1 quadrilateral found, which a remodelling would dissolve"):
        remodel.import_mesh(mixed_mesh())
    living = remodel.import_mesh(mixed_mesh(), dissolve_layers=True)
    assert len(living.triangles) == 4 and len(living.quads) == 0 and living.check().valid


def test_other_cells_are_refused_or_split():
    meshio = pytest.importorskip("meshio")
    points = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]])
    cells = [("quad", [[0, 1, 2, 3]]), ("triangle", [[1, 4, 5], [1, 5, 2]]), ("vertex", [[0]])]
    mixed = meshio.Mesh(points, cells, cell_sets={"left": [np.array([0]), np.arange(0), np.arange(0)], "right": [np.arange(0), np.array([0, 1]), np.arange(0)]})
    kept = remodel.from_meshio(mixed)
    assert kept.quads.tolist() == [[0, 1, 2, 3]] and kept.triangles.tolist() == [[1, 4, 5], [1, 5, 2]]
    assert [kept.region_names[i] for i in kept.region] == ["right", "right", "left"]
    split = remodel.from_meshio(mixed, split_quadrilaterals=True)
    assert split.check().area == 2.0 and split.region_names == ["left", "right"] and np.bincount(split.region).tolist() == [2, 2]
    with pytest.raises(remodel.ArgumentError, match="type tetra"):
        remodel.from_meshio(meshio.Mesh(points, [("triangle", [[0, 1, 2]]), ("tetra", [[0, 1, 2, 3]])]))
    with pytest.raises(remodel.ArgumentError, match="found z from 0 to 2"):
        remodel.from_meshio(meshio.Mesh(points[:, [0, 2, 1]] * 2, [("triangle", [[0, 1, 2]])]))


class UnstructuredGrid:
    """PyVista is not in Debian: a stand-in takes what its UnstructuredGrid takes, and gives it back."""

    def __init__(self, cells, kinds, points):
        self.cells, self.celltypes, self.points = cells, kinds, points
        self.point_data, self.cell_data, self.field_data = {}, {}, {}

    @property
    def cells_dict(self):
        found, at = {}, 0
        for kind in self.celltypes:
            size = self.cells[at]
            found.setdefault(kind, []).append(self.cells[at + 1 : at + 1 + size])
            at += size + 1
        return {kind: np.array(cells) for kind, cells in found.items()}


@pytest.fixture
def pyvista(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyvista", types.SimpleNamespace(UnstructuredGrid=UnstructuredGrid))


def test_pyvista_gets_cells_points_and_fields(mesh, pyvista):
    grid = mesh.to_pyvista({"x": mesh.points[:, 0], "birth": mesh.birth, "u": mesh.points})
    assert np.array_equal(grid.cells.reshape(-1, 4)[:, 1:], mesh.triangles) and np.all(grid.cells[::4] == 3)
    assert np.all(grid.celltypes == 5) and grid.points.shape == (len(mesh.points), 3)
    assert "x" in grid.point_data and "birth" in grid.cell_data
    assert np.array_equal(grid.point_data["u"], grid.points)  # vectors of the plane have three components


def test_pyvista_keeps_names_and_regions(mesh, pyvista):
    for frozen in (mesh.freeze(), two_regions()):
        assert named(remodel.from_pyvista(frozen.to_pyvista())) == named(frozen)
    cells = np.array([4, 0, 1, 4, 5, 3, 1, 2, 3, 3, 1, 3, 4])
    grid = UnstructuredGrid(cells, np.array([9, 5, 5]), np.column_stack([two_regions().points, np.zeros(6)]))
    assert remodel.from_pyvista(grid).quads.tolist() == [[0, 1, 4, 5]]
    assert remodel.from_pyvista(grid, split_quadrilaterals=True).check().area == 2.0
    with pytest.raises(remodel.ArgumentError, match="VTK's type 10"):
        remodel.from_pyvista(UnstructuredGrid(np.array([4, 0, 1, 2, 3, 3, 0, 1, 2]), np.array([10, 5]), grid.points))
