import sys
import types

import numpy as np
import pytest
import remodel


def test_nothing_is_imported_before_it_is_asked_for():
    import subprocess

    code = "import remodel, sys; print([m for m in ('matplotlib', 'scipy', 'meshio', 'pyvista', 'openmdao') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, check=True).stdout.strip() == "[]"


def test_meshio_there_and_back(mesh, tmp_path):
    pytest.importorskip("meshio")
    other = mesh.to_meshio({"height": mesh.points[:, 1], "birth": mesh.birth})
    assert np.array_equal(other.point_data["height"], mesh.points[:, 1])
    back = remodel.from_meshio(other)
    assert np.array_equal(back.points, mesh.points) and np.array_equal(back.triangles, mesh.triangles)
    for name, edges in mesh.boundaries.items():
        assert np.array_equal(back.boundaries[name], edges)
    assert remodel.import_mesh(back).check().valid


def test_meshio_reads_physical_names(mesh, tmp_path):
    meshio = pytest.importorskip("meshio")
    mesh.save(tmp_path / "m.msh")
    back = remodel.from_meshio(meshio.read(tmp_path / "m.msh"))
    assert {name: len(edges) for name, edges in back.boundaries.items()} == {name: len(edges) for name, edges in mesh.boundaries.items()}


def test_pyvista_gets_cells_points_and_fields(mesh, monkeypatch):
    """PyVista is not in Debian: a stand-in takes what its UnstructuredGrid takes."""

    class UnstructuredGrid:
        def __init__(self, cells, kinds, points):
            self.cells, self.kinds, self.points = cells, kinds, points
            self.point_data, self.cell_data = {}, {}

    monkeypatch.setitem(sys.modules, "pyvista", types.SimpleNamespace(UnstructuredGrid=UnstructuredGrid))
    grid = mesh.to_pyvista({"x": mesh.points[:, 0], "birth": mesh.birth})
    assert np.array_equal(grid.cells.reshape(-1, 4)[:, 1:], mesh.triangles) and np.all(grid.cells[::4] == 3)
    assert np.all(grid.kinds == 5) and grid.points.shape == (len(mesh.points), 3)
    assert "x" in grid.point_data and "birth" in grid.cell_data
