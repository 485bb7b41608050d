import numpy as np
import pytest
import remodel
from conftest import same


def test_a_native_file_goes_on_to_the_same_mesh(mesh, designs, tmp_path):
    row = designs(6, 0.01)
    for design in row[:3]:
        mesh.update(design)
    mesh.save(tmp_path / "m.vtkhdf")
    other = remodel.Mesh.load(tmp_path / "m.vtkhdf")
    for design in row[3:]:
        mesh.update(design)
        other.update(design)
    assert same(mesh, other)


@pytest.mark.parametrize("name", ["m.vtu", "m.msh", "m.su2", "m.vtkhdf"])
def test_arrays_come_back_from_every_format(mesh, tmp_path, name):
    mesh.freeze().save(tmp_path / name)
    read = remodel.read_frozen(str(tmp_path / name))
    assert np.array_equal(read.points, mesh.points) and np.array_equal(read.triangles, mesh.triangles)
    assert set(read.boundaries) == {"airfoil", "farfield"}


def test_another_programs_mesh_comes_alive(mesh, designs, tmp_path):
    mesh.save(tmp_path / "m.su2")
    loaded = remodel.Mesh.load(tmp_path / "m.su2")
    arrays = remodel.import_mesh(remodel.FrozenMesh(mesh.points, mesh.triangles, mesh.boundaries))
    for one in (loaded, arrays):
        assert len(one) == len(mesh)
        step = one.update(designs(1)[0], boundary="airfoil")
        assert step.preserved > 0 and one.check().valid


def test_fields_go_with_the_mesh(mesh, tmp_path):
    fields = {"height": mesh.points[:, 1], "number": np.arange(len(mesh.triangles), dtype=float), "place": mesh.points}
    mesh.freeze().save(tmp_path / "m.vtu", fields)
    read = remodel.read_fields(tmp_path / "m.vtu")
    for name, values in fields.items():
        assert np.array_equal(read[name], values), name


def test_bad_files_are_errors_that_name_them(mesh, tmp_path):
    with pytest.raises(remodel.FileError) as error:
        remodel.Mesh.load(tmp_path / "none.vtkhdf")
    assert "none.vtkhdf" in str(error.value) and isinstance(error.value, OSError)
    (tmp_path / "bad.su2").write_text("NDIME= 3\n")
    with pytest.raises(remodel.FormatError) as error:
        remodel.Mesh.load(tmp_path / "bad.su2")
    assert "bad.su2" in error.value.place
    with pytest.raises(remodel.ArgumentError):
        mesh.save(tmp_path / "m.unknown")
    with pytest.raises(remodel.FileError):
        mesh.save(tmp_path / "no" / "m.su2")
    with pytest.raises(remodel.Error):
        mesh.freeze().save(tmp_path / "m.vtu", {"short": [1.0, 2.0]})
    assert list(tmp_path.iterdir()) == [tmp_path / "bad.su2"]
