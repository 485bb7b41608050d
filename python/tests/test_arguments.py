"""Every call says which argument is wrong and what was found there; nothing is lost on the way."""

import inspect
import warnings

import numpy as np
import pytest
import remodel

FILE = "never-written.vtu"


def array_calls(mesh, airfoil):
    """Calls that take arrays, by the name of the argument, with what it should be."""
    points, triangles = np.array(mesh.points), np.array(mesh.triangles)
    field, transfer = remodel.InteriorDisplacement(mesh), remodel.Transfer(mesh, mesh)
    square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    return [
        ("design", airfoil.design, airfoil.with_design),
        ("upper", airfoil.upper, lambda v: remodel.Airfoil(upper=v, lower=airfoil.lower)),
        ("lower", airfoil.lower, lambda v: remodel.Airfoil(upper=airfoil.upper, lower=v)),
        ("outer['a']", square, lambda v: remodel.Domain.polygons({"a": v})),
        ("holes['b']", square / 4 + 1, lambda v: remodel.Domain.polygons({"a": square}, {"b": v})),
        ("elements[0]['position']", np.zeros(2), lambda v: remodel.Domain.airfoils([{"name": "a", "airfoil": airfoil, "position": tuple(v)}])),
        ("points", points, lambda v: remodel.FrozenMesh(v, triangles)),
        ("points", points, mesh.freeze().with_points),
        ("direction", airfoil.design, mesh.jvp),
        ("by_points", points, mesh.vjp),
        ("walls", points * 0, field.jvp),
        ("by_points", points, field.vjp),
        ("values", points, transfer.ride),
        ("values", points[:, 0], transfer.remap),
        ("fields['f']", points[:, 0], lambda v: mesh.freeze().save(FILE, {"f": v})),
        ("x0", np.zeros(3), lambda v: remodel.CMAES(v, 0.1)),
        ("solutions[0]", np.zeros(3), lambda v: remodel.CMAES(np.zeros(3), 0.1).tell([v], [1.0])),
    ]


def spoiled(values, value):
    """A value that is not to be had somewhere, and where."""
    result = np.array(values, dtype=type(value) if isinstance(value, complex) else float)
    index = tuple(n // 2 for n in result.shape)
    result[index] = value
    return result, ", ".join(map(str, index))


def test_complex_numbers_are_refused_by_name(mesh, airfoil):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name, right, call in array_calls(mesh, airfoil):
            for wrong in (spoiled(right, 1j)[0], right + 0j, (right + 1e-30j).tolist(), (right + 0j).astype(object)):
                with pytest.raises(remodel.ArgumentError) as raised:
                    call(wrong)
                assert str(raised.value).startswith(name.split("[")[0]) and "complex" in str(raised.value), (name, raised.value)


def test_what_is_not_finite_is_refused_by_name_and_index(mesh, airfoil):
    for name, right, call in array_calls(mesh, airfoil):
        for value in (np.nan, np.inf, -np.inf):
            wrong, index = spoiled(right, value)
            with pytest.raises(remodel.ArgumentError) as raised:
                call(wrong)
            assert str(raised.value) == f"{name}[{index}]: found {value}, expected a finite number", name
            with pytest.raises(remodel.ArgumentError):
                call(wrong.tolist())


def number_calls(mesh, airfoil):
    """Calls with an argument that is one number."""
    flow = {name: (lambda v, name=name: remodel.solve_flow(mesh, **{name: v})) for name in ("mach", "alpha", "cl", "reference_length", "tolerance", "memory_mb")}
    made = {name: (lambda v, name=name: remodel.generate(airfoil, **{name: v})) for name in ("gradation", "resolution", "min_angle", "max_gradation", "farfield_radius", "refine_angle")}
    step = {name: (lambda v, name=name: mesh.update(airfoil, **{name: v})) for name in ("distance", "delaunay_slack")}
    rest = {
        "e1": lambda v: remodel.Airfoil(upper=airfoil.upper, lower=airfoil.lower, e1=v),
        "te_upper": lambda v: remodel.Airfoil(upper=airfoil.upper, lower=airfoil.lower, te_upper=v),
        "lift": lambda v: remodel.PotentialSolver(mesh).alpha_for(v),
        "sigma0": lambda v: remodel.CMAES(airfoil.design, v),
        "sigma": lambda v: remodel.optimise(airfoil, airfoil, sigma=v),
    }
    return {**flow, **made, **step, **rest}


def test_single_numbers_too(mesh, airfoil):
    before = np.array(mesh.points)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name, call in number_calls(mesh, airfoil).items():
            for value in (np.nan, np.inf, 1j, np.complex128(0.3 + 1e-20j), np.float32(np.nan), np.array(np.nan), np.array([0.3 + 0j])):
                with pytest.raises(remodel.ArgumentError) as raised:
                    call(value)
                assert str(raised.value).startswith(name), (name, value, raised.value)
            for value in ("0.3", None if name not in ("cl", "gradation") else "x", [0.3, 0.4], {}):
                with pytest.raises(remodel.ArgumentTypeError) as raised:
                    call(value)
                assert str(raised.value).startswith(f"{name}: found ") and "expected a number" in str(raised.value), raised.value
    assert np.array_equal(mesh.points, before)


def test_a_wrong_type_is_named_in_one_short_line(mesh, airfoil):
    rows = np.random.default_rng(0).random((400, 2))
    cases = {
        "shape": [lambda: remodel.generate(rows), lambda: mesh.update(rows), lambda: mesh.at(7), lambda: remodel.Domain(rows), lambda: remodel.Airfoil(rows)],
        "points": [lambda: remodel.generate(airfoil, points="200"), lambda: remodel.generate(airfoil, points=200.5), lambda: remodel.FrozenMesh("x", mesh.triangles)],
        "triangles": [lambda: remodel.FrozenMesh(mesh.points, mesh.triangles + 0.5), lambda: remodel.FrozenMesh(mesh.points, "x"), lambda: remodel.FrozenMesh(mesh.points, mesh.points)],
        "mesh": [lambda: remodel.check(rows), lambda: remodel.LivingFlow().solve(rows), lambda: remodel.solve_flow("m.su2"), lambda: remodel.PotentialSolver(None), lambda: remodel.InteriorDisplacement(rows)],
        "design": [lambda: airfoil.with_design("x"), lambda: airfoil.with_design(None), lambda: airfoil.with_design({"a": 1})],
        "strategy": [lambda: mesh.update(airfoil, strategy=3)],
        "record": [lambda: mesh.update(airfoil, record=rows)],
        "file": [lambda: mesh.save(rows), lambda: remodel.read_frozen(3)],
        "inlets": [lambda: remodel.LivingFlow(inlets=rows)],
        "elements[1]": [lambda: remodel.Domain.airfoils([{"name": "a", "airfoil": airfoil}, rows])],
        "elements[0]['chord']": [lambda: remodel.Domain.airfoils([{"name": "a", "airfoil": airfoil, "chord": "x"}])],
        "objective": [lambda: remodel.optimise(airfoil, rows)],
        "conserved": [lambda: remodel.Transfer(mesh, mesh).remap(rows, conserved=[0, 1])],
        "grid": [lambda: remodel.from_pyvista(rows)],
    }
    for name, calls in cases.items():
        for number, call in enumerate(calls):
            with pytest.raises(remodel.ArgumentError) as raised:
                call()
            text = str(raised.value)
            assert text.startswith(f"{name}: found ") and "expected " in text and len(text) < 250 and "\n" not in text, (name, number, text)


def test_strings_and_dates_are_no_numbers(mesh, airfoil):
    """NumPy would make some of them."""
    for name, right, call in array_calls(mesh, airfoil):
        if name == "elements[0]['position']":
            continue
        for wrong in (np.full(right.shape, "0.5"), np.full(right.shape, "0.5").tolist(), np.full(right.shape, "2020", dtype="datetime64[Y]"), "0.5", None, {"a": 1.0}):
            if wrong is None and name in ("upper", "lower"):
                continue  # which may be left out
            with pytest.raises(remodel.ArgumentTypeError) as raised:
                call(wrong)
            assert "expected an array of numbers" in str(raised.value), (name, wrong, raised.value)


def test_classes_that_calls_return_are_not_made_by_hand():
    for kind in (remodel.Mesh, remodel.Step, remodel.Changes, remodel.Trial, remodel.FlowResult, remodel.CheckResult, remodel.Violation, remodel.PotentialFlow):
        with pytest.raises(remodel.ArgumentTypeError, match=f"^{kind.__name__}: has no constructor"):
            kind()


def test_options_have_pythons_names_in_messages(mesh, airfoil):
    for name, call in {
        "min_angle": lambda: remodel.generate(airfoil, min_angle=50.0), "refine_angle": lambda: remodel.generate(airfoil, refine_angle=50.0),
        "delaunay_slack": lambda: mesh.update(airfoil, delaunay_slack=-1.0), "distance": lambda: mesh.update(airfoil, distance=-1.0),
        "alpha": lambda: remodel.solve_flow(mesh, alpha=100.0), "sigma0": lambda: remodel.CMAES([0.0], -1.0), "popsize": lambda: remodel.CMAES([0.0], 1.0, popsize=2),
        "degree": lambda: remodel.Airfoil("naca:0012", degree=50),
    }.items():  # fmt: skip
        with pytest.raises(remodel.ArgumentError) as raised:
            call()
        assert str(raised.value).startswith(f"{name}:"), raised.value


def test_missing_and_unknown_arguments_are_ours_too(mesh, airfoil):
    for call in (lambda: remodel.generate(), lambda: mesh.update(), lambda: mesh.update(airfoil, nothing=1), lambda: mesh.vjp(1, 2, 3, 4), lambda: remodel.Airfoil("naca:0012", 5, 6), lambda: remodel.optimise(airfoil)):
        with pytest.raises(remodel.ArgumentTypeError):
            call()


def test_every_call_has_a_signature():
    for name in remodel.__all__:
        thing = getattr(remodel, name)
        if inspect.isclass(thing):
            for member, call in vars(thing).items():
                if not member.startswith("_") and callable(call) and not inspect.isclass(call):
                    assert inspect.signature(call) is not None, f"{name}.{member}"
        elif callable(thing):
            assert inspect.signature(thing) is not None, name
    assert str(inspect.signature(remodel.Airfoil)) == "(shape=None, degree=None, *, upper=None, lower=None, e1=0.5, e2=1.0, te_upper=0.0, te_lower=0.0, close_trailing_edge=False)"
    assert list(inspect.signature(remodel.Mesh.update).parameters)[:2] == ["self", "shape"]


def test_an_objective_that_answers_in_complex_numbers_ends_the_run(airfoil):
    for answer in (lambda *_: 1 + 1e-20j, lambda *_: np.complex128(1.0), lambda *_: {"objective": 1.0, "constraints": [1j]}, lambda *_: {"objective": 1.0, "outputs": {"a": 1j}}):
        with pytest.raises(remodel.ArgumentError, match="complex"):
            remodel.optimise(airfoil, answer, points=40, evaluations=5)


def test_numbers_of_numpy_and_lists_are_taken(mesh, airfoil):
    assert remodel.generate(airfoil, points=np.int64(40), gradation=np.float32(1.0)).stopped == "done"
    assert airfoil.with_design(airfoil.design.tolist()) == airfoil == airfoil.with_design(tuple(airfoil.design))
    assert np.array_equal(mesh.jvp(np.ones(12, dtype=np.float32)), mesh.jvp([1] * 12))
    assert remodel.FrozenMesh(mesh.points.tolist(), mesh.triangles.tolist()).check().triangles == len(mesh)
