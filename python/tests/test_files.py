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


@pytest.mark.parametrize("name", ["m.vtu", "m.msh", "m.vtkhdf"])
def test_vectors_and_stray_points(mesh, tmp_path, name):
    more = remodel.FrozenMesh(np.vstack([mesh.points, [[9.0, 9.0]]]), mesh.triangles, mesh.boundaries)
    fields = {"u": 2.0 * more.points, "c": np.arange(len(mesh.triangles), dtype=float)}
    more.save(tmp_path / name, fields=fields)
    assert np.array_equal(remodel.read_frozen(tmp_path / name).points, mesh.points)
    found = remodel.read_fields(tmp_path / name)
    assert np.array_equal(found["u"], 2.0 * mesh.points) and np.array_equal(found["c"], fields["c"])


def test_another_programs_mesh_comes_alive(mesh, designs, tmp_path):
    mesh.save(tmp_path / "m.su2")
    loaded = remodel.Mesh.load(tmp_path / "m.su2")
    arrays = remodel.import_mesh(remodel.FrozenMesh(mesh.points, mesh.triangles, mesh.boundaries))
    for one in (loaded, arrays):
        assert len(one) == len(mesh)
        step = one.update(designs(1)[0], boundary="airfoil")
        assert step.preserved > 0 and one.check().valid


def test_a_mesh_with_coefficients_is_made_of_another_programs(mesh, airfoil):
    imported = remodel.import_mesh(remodel.FrozenMesh(mesh.points, mesh.triangles, mesh.boundaries))
    weights = np.ones(mesh.points.shape)
    imported.update(airfoil, boundary="airfoil")
    with pytest.raises(remodel.ArgumentError, match=r"names 0 airfoils by coefficients, expected one: an imported mesh has polygons, and coefficients after update\(Domain\(airfoil\)\)$"):
        imported.vjp(weights[: len(imported.points)], "airfoil")
    imported.update(remodel.Domain(airfoil, points=60))
    assert imported.vjp(np.ones(imported.points.shape), "airfoil").shape == (12,)


def test_each_kind_of_mesh_says_who_reads_the_other(mesh, airfoil, tmp_path):
    layered = remodel.generate_layered(airfoil, reynolds=1000.0, model="laminar", spacing=6.0)
    mesh.save(tmp_path / "m.vtkhdf"), layered.save(tmp_path / "l.vtkhdf"), mesh.save(tmp_path / "m.su2")
    with pytest.raises(remodel.FormatError, match=r"l.vtkhdf: found a mesh with layers, expected one without: LayeredMesh.load\(\) reads it$"):
        remodel.Mesh.load(tmp_path / "l.vtkhdf")
    for other in ("m.vtkhdf", "m.su2"):
        with pytest.raises(remodel.FormatError, match=rf"{other}: found no layers, expected a native mesh with them: Mesh.load\(\) reads others$"):
            remodel.LayeredMesh.load(tmp_path / other)
    for read in (remodel.read_fields, remodel.Mesh.load, remodel.LayeredMesh.load):
        for name in ("none.su2", "none.vtkhdf"):
            if read is not remodel.LayeredMesh.load or name == "none.vtkhdf":
                with pytest.raises(remodel.FileError, match=f"{name}"):
                    read(tmp_path / name)


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
