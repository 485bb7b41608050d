import pickle

import numpy as np
import pytest
import remodel


def test_an_airfoil_comes_from_a_name_arrays_and_files(tmp_path):
    by_name = remodel.Airfoil("rae2822")
    by_arrays = remodel.Airfoil(upper=by_name.upper, lower=by_name.lower)
    assert by_arrays == by_name
    by_name.save(tmp_path / "a.json")
    assert remodel.Airfoil(tmp_path / "a.json") == by_name
    points = remodel.Airfoil("naca:2412").coordinates(101)
    (tmp_path / "naca.dat").write_text("NACA 2412\n" + "\n".join(f"{x:.8f} {y:.8f}" for x, y in points))
    assert abs(remodel.Airfoil(tmp_path / "naca.dat").thickness - 0.12) < 1e-3
    assert "rae2822" in remodel.catalogue()


def test_an_airfoil_has_the_figures_of_its_section(airfoil):
    assert abs(airfoil.thickness - 0.12) < 1e-3 and abs(airfoil.thickness_at - 0.3) < 0.01
    assert abs(airfoil.camber) < 1e-6
    points = airfoil.coordinates(101)
    assert points.shape == (101, 2)
    assert np.array_equal(points[0], [1, 0]) and np.array_equal(points[50], [0, 0])
    assert np.all(points[1:50, 1] > 0)


def test_designs_go_round(airfoil):
    other = airfoil.with_design(airfoil.design * 1.1)
    assert np.array_equal(other.design, airfoil.design * 1.1)
    assert other.thickness > airfoil.thickness
    assert pickle.loads(pickle.dumps(other)) == other
    other.upper[:] = 7  # a copy
    assert np.array_equal(other.design, airfoil.design * 1.1)


def test_crossing_surfaces_are_not_feasible():
    assert remodel.Airfoil("naca:0012").feasible
    assert not remodel.Airfoil(upper=[-0.1, 0.1], lower=[0.1, -0.1]).feasible


def test_domains_are_polygons_airfoils_and_files(airfoil, tmp_path):
    square = np.array([[0, 0], [4, 0], [4, 4], [0, 4]])
    domain = remodel.Domain.polygons({"outside": square}, {"hole": square / 4 + 1})
    assert set(domain.loops) == {"outside", "hole"}
    (tmp_path / "d.json").write_text(domain.to_json())
    assert remodel.Domain(tmp_path / "d.json") == domain
    assert remodel.Domain.from_json(domain.to_json()) == domain
    assert pickle.loads(pickle.dumps(domain)) == domain
    assert abs(remodel.generate(domain).check().area - 15.0) < 1e-12
    two = remodel.Domain.airfoils([{"name": "main", "airfoil": airfoil}, {"name": "flap", "airfoil": airfoil, "chord": 0.3, "rotation": -20, "position": (1.02, -0.03)}], points=60)
    assert set(two.loops) == {"main", "flap", "farfield"}


def test_bad_shapes_are_errors_with_their_place(tmp_path):
    with pytest.raises(remodel.ArgumentError):
        remodel.Airfoil("no such section")
    with pytest.raises(remodel.FileError) as missing:
        remodel.Airfoil(tmp_path / "missing.dat")
    assert "missing.dat" in missing.value.place
    (tmp_path / "bad.json").write_text('{"upper": 3}')
    with pytest.raises(remodel.FormatError) as bad:
        remodel.Airfoil(tmp_path / "bad.json")
    assert "bad.json" in bad.value.place and bad.value.expected
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    with pytest.raises(remodel.GeometryError):
        remodel.Domain.polygons({"bow": [[0, 0], [1, 1], [1, 0], [0, 1]]})
    with pytest.raises(remodel.ArgumentError):
        remodel.Domain.polygons({"flat": np.zeros((4, 3))})
    with pytest.raises(remodel.GeometryError):
        remodel.Domain.polygons({"a": square, "b": square})
