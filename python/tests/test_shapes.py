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


def test_an_airfoil_has_the_degree_that_is_asked_for(tmp_path):
    """Of the catalogue, files of coefficients and a given section too: exactly above their own degree."""
    own = remodel.Airfoil("rae2822")
    own.save(tmp_path / "own.json")
    assert own.degree == 5 and remodel.Airfoil(tmp_path / "own.json") == own
    for shape in ("rae2822", tmp_path / "own.json"):
        for degree, off in ((3, 3e-3), (5, 1e-15), (8, 1e-15)):
            other = remodel.Airfoil(shape, degree=degree)
            assert other.degree == degree and len(other.design) == 2 * degree + 2 and other == own.with_degree(degree)
            assert abs(other.coordinates() - own.coordinates()).max() < off
    with pytest.raises(remodel.ArgumentError, match="^degree: given with coefficients"):
        remodel.Airfoil(upper=own.upper, lower=own.lower, degree=3)
    for call in (lambda: remodel.Airfoil("rae2822", degree=13), lambda: own.with_degree(0)):
        with pytest.raises(remodel.ArgumentError, match="^degree: found"):
            call()


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


def rows(airfoil, chord, x, y):
    return "\n".join(f"{x + chord * px:.8f} {y + chord * py:.8f}" for px, py in airfoil.coordinates(61))


def test_a_domain_is_made_of_any_file_that_the_program_takes(airfoil, tmp_path):
    two = tmp_path / "two.dat"
    two.write_text("two\n" + rows(airfoil, 2.0, 0.0, 0.0) + "\n999.0 999.0\n" + rows(airfoil, 0.6, 2.04, -0.06))
    with pytest.warns(UserWarning, match="has 2 elements") as said:
        domain = remodel.Domain(two, points=60)
    assert {warning.filename for warning in said} == {__file__}  # the user's line, not one of the package
    assert list(domain.loops) == ["two", "two_2", "farfield"]
    assert abs(domain.loops["two_2"][:, 0].min() - 2.04) < 1e-4
    far = tmp_path / "far.dat"
    far.write_text("far\n" + rows(airfoil, 3.0, 5.0, 1.0))
    with pytest.warns(UserWarning, match="scaled to 1"):
        moved = remodel.Domain(far, as_given="polyline")
    with pytest.warns(UserWarning, match="longest chord is 3"):
        kept = remodel.Domain(far, as_given="polyline", keep_coordinates=True)
    assert abs(moved.loops["airfoil"][:, 0].min()) < 1e-6 and abs(kept.loops["airfoil"][:, 0].min() - 5) < 1e-6
    assert len(moved.loops["airfoil"]) == 60  # the file's points are the vertices
    graph = tmp_path / "square.poly"
    graph.write_text("4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n")
    assert abs(remodel.generate(graph).check().area - 1) < 1e-12
    with pytest.raises(remodel.ArgumentError, match="as_given: given for"):
        remodel.Domain(graph, as_given="spline")
    with pytest.raises(remodel.ArgumentError, match="as_given: found 'circle'"):
        remodel.Domain(far, as_given="circle")
    with pytest.raises(remodel.ArgumentError, match="keep_coordinates: given for Airfoil"):
        remodel.Domain(airfoil, keep_coordinates=True)


def test_a_trailing_edge_is_closed_where_asked_to(tmp_path):
    blunt = remodel.Airfoil("naca:2412")
    points = blunt.coordinates(81)
    points[:, 1] += 0.004 * points[:, 0] * np.where(np.arange(81) < 40, 1, -1)
    (tmp_path / "blunt.dat").write_text("blunt\n" + "\n".join(f"{x:.8f} {y:.8f}" for x, y in points))
    kept = remodel.Airfoil(tmp_path / "blunt.dat")
    assert abs(kept.te_upper - kept.te_lower - 0.008) < 1e-6
    closed = remodel.Airfoil(tmp_path / "blunt.dat", close_trailing_edge=True)
    assert closed.te_upper == closed.te_lower


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


def test_options_that_a_shape_has_no_use_for_are_refused(airfoil, tmp_path):
    section, whole, graph, coefficients = (tmp_path / name for name in ("one.dat", "whole.json", "square.poly", "own.json"))
    section.write_text("one\n" + rows(airfoil, 1.0, 0.0, 0.0))
    domain = remodel.Domain(airfoil, points=60, turning_share=0.1)
    whole.write_text(domain.to_json())
    graph.write_text("4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n")
    airfoil.save(coefficients)
    of_airfoils = {"points": 60, "farfield_radius": 20.0, "farfield_points": 40, "turning_share": 0.1}
    all_options = {**of_airfoils, "degree": 6, "crossings": "refuse", "join": 1e-10}
    for shape, more, used in (
        (domain, {}, ()), (airfoil, {}, of_airfoils), (coefficients, {}, of_airfoils), ("naca:0012", {}, [*of_airfoils, "degree"]),
        ("rae2822", {}, [*of_airfoils, "degree"]), (section, {}, [*of_airfoils, "degree"]),
        (section, {"as_given": "polyline"}, ["farfield_radius", "farfield_points"]), (whole, {}, ["join"]), (graph, {}, ["crossings", "join"]),
    ):  # fmt: skip
        for option, value in all_options.items():
            if option in used:
                remodel.Domain(shape, **more, **{option: value})
                continue
            with pytest.raises(remodel.ArgumentError, match=f"^{option}: given for .*, expected "):
                remodel.Domain(shape, **more, **{option: value})
    assert remodel.Domain("rae2822", degree=7).airfoil().degree == 7


def test_a_mesh_follows_to_any_file_that_it_could_be_made_of(airfoil, tmp_path):
    """update(), trial() and at() take what generate() takes: a section takes the place of the mesh's own."""
    one, blunt, two, whole, graph = (tmp_path / name for name in ("one.dat", "blunt.dat", "two.dat", "whole.json", "square.poly"))
    section = remodel.Airfoil("naca:2412")
    one.write_text("one\n" + rows(section, 1.0, 0.0, 0.0))
    mesh = remodel.generate(airfoil, points=60)
    by_file, by_airfoil = mesh.copy(), mesh.copy()
    by_file.update(one), by_airfoil.update(remodel.Airfoil(one))
    assert by_file.domain == by_airfoil.domain and np.array_equal(by_file.points, by_airfoil.points)
    with mesh.trial(str(one)) as trial:
        assert trial.step.triangles == len(by_file)
    assert np.array_equal(by_file.at(one).points, by_file.points)
    section.save(tmp_path / "one.json")
    by_file.update(tmp_path / "one.json")
    assert by_file.domain.airfoil() == section
    blunt.write_text("blunt\n" + rows(section, 2.0, 5.0, 0.0))
    with pytest.warns(UserWarning, match="blunt.dat"):
        by_file.update(blunt, boundary="airfoil")
    two.write_text("two\n" + rows(airfoil, 1.0, 0.0, 0.0) + "\n999.0 999.0\n" + rows(airfoil, 0.3, 1.02, -0.03))
    with pytest.warns(UserWarning, match="has 2 elements"):
        elements = remodel.Domain(two, points=80, farfield_radius=10)
        pair = remodel.generate(elements)
    with pytest.warns(UserWarning, match="has 2 elements"):
        assert pair.update(two).triangles == len(pair) and pair.domain.loops.keys() == elements.loops.keys()
    assert all(np.allclose(pair.domain.loops[name], elements.loops[name], atol=1e-3) for name in ("two", "two_2"))
    whole.write_text(by_airfoil.domain.to_json())
    mesh.update(whole)
    assert mesh.domain == by_airfoil.domain
    graph.write_text("4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n")
    assert abs(mesh.update(graph).triangles - len(remodel.generate(graph))) < 20
    for wrong, match in ((two, "^boundary: given with .*two.dat', a whole domain"), ("-", "^shape: found '-'"), (3, "^shape: found int"), (tmp_path / "none.dat", "none.dat: cannot be read")):
        with pytest.raises(remodel.Error, match=match):
            remodel.generate(airfoil, points=40).update(wrong, boundary="airfoil")


def test_layers_follow_to_the_section_of_a_file(airfoil, tmp_path):
    file = tmp_path / "one.dat"
    file.write_text("one\n" + rows(remodel.Airfoil("naca:1312"), 1.0, 0.0, 0.0))
    mesh = remodel.generate_layered(airfoil, reynolds=1000.0, model="laminar", spacing=6.0)
    expected = mesh.copy()
    mesh.update(file), expected.update(remodel.Airfoil(file))
    assert np.array_equal(mesh.freeze().points, expected.freeze().points)
    file.write_text("two\n" + rows(airfoil, 1.0, 0.0, 0.0) + "\n999.0 999.0\n" + rows(airfoil, 0.3, 1.02, -0.03))
    with pytest.raises(remodel.ArgumentError, match="^shape: found .*, a file of 2 elements, expected one section"):
        mesh.update(file)
