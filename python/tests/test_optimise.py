import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest
import remodel


def quadratic(x):
    return float(np.sum((np.asarray(x) - np.arange(len(x))) ** 2))


def test_cmaes_finds_a_minimum_by_ask_and_tell():
    es = remodel.CMAES(np.zeros(5), 0.5, seed=3, maxfevals=5000)
    while not es.stop():
        X = es.ask()
        assert len(X) == es.popsize == 8
        es.tell(X, [quadratic(x) for x in X])
    assert np.allclose(es.result.xbest, np.arange(5), atol=1e-6)
    assert es.result.fbest == quadratic(es.result.xbest)
    assert es.result.evaluations == es.countevals <= 5008
    assert es.countiter == es.countevals // 8


def test_cmaes_goes_on_from_a_pickle():
    es = remodel.CMAES([0.0, 1.0], 0.1)
    es.tell(X := es.ask(), [quadratic(x) for x in X])
    other = pickle.loads(pickle.dumps(es))
    assert np.array_equal(es.ask(), other.ask())


def test_cmaes_refuses_what_it_cannot_use():
    for start, sigma in (([], 0.1), ([np.nan], 0.1), ([0.0], -1.0), ([0.0], np.inf), (np.zeros((2, 2)), 0.1)):
        with pytest.raises(remodel.ArgumentError):
            remodel.CMAES(start, sigma)
    es = remodel.CMAES([0.0, 0.0], 0.1)
    with pytest.raises(remodel.ArgumentError):
        es.tell(es.ask(), [1.0])
    with pytest.raises(remodel.ArgumentError):
        es.tell([[1.0, 2.0, 3.0]], [1.0])
    with pytest.raises(remodel.ArgumentError):
        es.ask(-1)


def test_the_papers_run_comes_nearer_to_its_target(airfoil, tmp_path):
    seen = []
    result = remodel.optimise(airfoil, remodel.Airfoil("rae2822"), directory=tmp_path / "run", points=60, evaluations=150, callback=lambda row: seen.append(row["objective"]))
    assert result.evaluations == len(result.rows) == len(seen) == 150 and result.stopped == "done"
    assert result.objective == min(seen) == result.column("objective").min() < seen[0]
    assert isinstance(result.best, remodel.Airfoil) and np.array_equal(result.best.design, result.best_design)
    assert remodel.Mesh.load(tmp_path / "run" / "last.vtkhdf").check().valid
    with pytest.raises(remodel.Error):
        remodel.optimise(airfoil, airfoil, directory=tmp_path / "run", points=60, evaluations=2)


def thin(design, mesh, step):
    area = -sum(np.cross(*mesh.points[edge]) for edge in mesh.boundaries["airfoil"]) / 2
    return {"objective": area, "constraints": [0.05 - area], "outputs": {"area": area, "kept": step["preserved_percent"]}}


def test_an_objective_in_python_sees_the_mesh(airfoil):
    result = remodel.optimise(airfoil, thin, points=40, evaluations=60)
    assert abs(result.outputs["area"]) == abs(result.objective) and result.evaluations == 60
    assert all(row["constraints"] for row in result.rows)


def test_what_an_objective_raises_ends_the_run(airfoil):
    calls = []

    def broken(design, mesh, step):
        calls.append(1)
        return undefined_name  # noqa: F821

    with pytest.raises(NameError):
        remodel.optimise(airfoil, broken, points=40, evaluations=50)
    assert len(calls) == 1
    for wrong in (lambda *_: "text", lambda *_: {"goal": 1.0}, lambda *_: {"constraints": 3}):
        with pytest.raises((ValueError, KeyError, RuntimeError, TypeError)):
            remodel.optimise(airfoil, wrong, points=40, evaluations=5)


def test_an_evaluation_that_failed_is_a_row(airfoil):
    def half(design, mesh, step):
        if len(failed) < 5:
            failed.append(1)
            raise remodel.EvaluationFailed("flow: not found")
        return float(design[0])

    failed = []
    result = remodel.optimise(airfoil, half, points=40, evaluations=20)
    assert result.failed_evaluations == 5 and np.isinf(result.column("objective")).sum() == 5


def test_a_run_is_gone_on_with_by_a_function_of_its_name_alone(airfoil, tmp_path):
    def first(design, mesh, step):
        return float(design[0])

    def other(design, mesh, step):
        return float(design[1])

    options = dict(directory=tmp_path / "run", points=40)
    remodel.optimise(airfoil, first, evaluations=5, **options)
    assert remodel.optimise(airfoil, first, evaluations=9, resume=True, **options).evaluations == 9
    for function, message in ((other, "others: function"), (lambda *_: 1.0, "^objective: found a lambda with resume")):
        with pytest.raises(remodel.ArgumentError, match=message):
            remodel.optimise(airfoil, function, evaluations=12, resume=True, **options)


def test_a_run_without_an_objective_says_so(airfoil):
    with pytest.warns(UserWarning, match="^objective: no design of 5 has one that is a finite number; the first: .*finite"):
        result = remodel.optimise(airfoil, lambda *_: float("nan"), points=40, evaluations=5)
    assert not np.isfinite(result.objective) and result.failed_evaluations == 5


def test_a_callback_ends_the_run(airfoil):
    assert remodel.optimise(airfoil, remodel.Airfoil("rae2822"), points=40, evaluations=500, callback=lambda row: row["evaluation"] >= 20).stopped == "interrupted"

    def raising(row):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        remodel.optimise(airfoil, remodel.Airfoil("rae2822"), points=40, evaluations=500, callback=raising)


def test_ctrl_c_ends_a_run_that_can_be_resumed(airfoil, tmp_path):
    started = []

    def press(row):
        if row["evaluation"] == 30:
            started.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

    options = dict(directory=tmp_path / "run", points=60)
    with pytest.raises(KeyboardInterrupt):
        remodel.optimise(airfoil, remodel.Airfoil("rae2822"), evaluations=10**6, callback=press, **options)
    assert threading.active_count() == 1
    result = remodel.optimise(airfoil, remodel.Airfoil("rae2822"), evaluations=60, resume=True, **options)
    assert result.evaluations == 60
