"""Whatever is handed in: an exception, and an interpreter that goes on."""

import gc
import os
import pickle
import signal
import threading

import numpy as np
import pytest
import remodel
from conftest import same

OURS = (remodel.Error, TypeError, ValueError, OverflowError, MemoryError)
NASTY = [None, 0, -1, 2**70, 3.5, np.nan, np.inf, "", "\0", "../..", b"bytes", [], {}, object(), np.zeros(0), np.zeros((3, 3)), np.array(["a"]), np.array([np.nan]), np.zeros((2, 2), complex), lambda: 0]  # fmt: skip


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("value", NASTY, ids=lambda value: type(value).__name__)
def test_every_argument_of_every_call(mesh, value):
    calls = [
        lambda: remodel.Airfoil(value), lambda: remodel.Airfoil("naca:0012").with_degree(value), lambda: remodel.Airfoil(upper=value, lower=value),
        lambda: remodel.Domain(value), lambda: remodel.Domain.polygons({"a": value}), lambda: remodel.Domain.polygons(value),
        lambda: remodel.Domain.airfoils(value), lambda: remodel.Domain.from_json(value), lambda: remodel.generate(value),
        lambda: remodel.FrozenMesh(value, value, {}), lambda: remodel.FrozenMesh(value, mesh.triangles), lambda: remodel.import_mesh(value),
        lambda: remodel.Mesh(value), lambda: remodel.Mesh.load(value), lambda: remodel.read_frozen(value), lambda: remodel.check(value),
        lambda: mesh.update(value), lambda: mesh.update("naca:0013", method=value), lambda: mesh.update("naca:0013", strategy=value),
        lambda: mesh.update("naca:0013", boundary=value or "nobody"), lambda: mesh.save(value), lambda: mesh.freeze().save("x.vtu", {"a": value}),
        lambda: remodel.Transfer(mesh, value), lambda: remodel.Transfer(mesh, mesh).ride(value), lambda: remodel.LivingFlow().solve(value),
        lambda: remodel.solve_flow(mesh, mach=value, max_steps=1, alpha=1e9), lambda: remodel.PotentialSolver(value), lambda: remodel.CMAES(value, value),
        lambda: remodel.optimise(value, value), lambda: remodel.Mesh.__new__(remodel.Mesh).__setstate__(value),
    ]  # fmt: skip
    original = mesh.copy()
    for number, call in enumerate(calls):
        with pytest.raises(OURS):
            print(number, call())
    assert same(mesh, original)


def test_numbers_out_of_range(airfoil, mesh):
    for options in (dict(points=-2), dict(points=7), dict(points=2**40), dict(gradation=-1.0), dict(gradation=np.nan), dict(resolution=0.0), dict(min_angle=90), dict(min_angle=np.nan),
                    dict(max_gradation=-1), dict(farfield_radius=0.5), dict(farfield_radius=np.inf), dict(farfield_points=0), dict(max_vertices=-1)):  # fmt: skip
        with pytest.raises(OURS):
            remodel.generate(airfoil, **options)
    for distance in (-1.0, np.nan, np.inf):
        with pytest.raises(OURS):
            mesh.update(airfoil, distance=distance)
    for count in (-1, 0, 2**40):
        with pytest.raises(OURS):
            airfoil.coordinates(count)


def test_arrays_of_other_programs_that_are_no_mesh(mesh):
    points, triangles = mesh.points.copy(), mesh.triangles.astype(np.int64)
    wrong = [(points, triangles - 1), (points, triangles + 1), (points[:-1], triangles), (points * np.nan, triangles), (points, np.concatenate([triangles, [[0, len(points) // 2, len(points) - 1]]])), (points * 0, triangles), (points, triangles[:0])]
    for p, t in wrong:
        with pytest.raises(OURS):
            remodel.import_mesh(remodel.FrozenMesh(p, t, {}))
    with pytest.raises(remodel.ArgumentError):
        remodel.FrozenMesh(points, triangles, {"a": [[0, 10**9]]})
    broken = remodel.FrozenMesh(points, triangles[:, ::-1], {})
    assert not broken.check().valid and broken.check().violations


@pytest.mark.filterwarnings("ignore")
def test_damaged_pickles(mesh):
    seed = 5
    print("seed", seed)
    random = np.random.default_rng(seed)
    state, stopped, _ = mesh.__getstate__()
    for key in state:
        for value in (None, "x", -1, np.zeros(3), np.array([2**31], dtype=np.uint32)):
            damaged = {**state, key: value}
            if isinstance(state[key], np.ndarray) and isinstance(value, np.ndarray) and value.dtype == state[key].dtype and len(state[key]) == len(value):
                continue
            other = remodel.Mesh.__new__(remodel.Mesh)
            try:
                other.__setstate__((damaged, stopped))
            except (*OURS, RuntimeError):
                continue
            other.check()  # a number that another mesh may have
    text = pickle.dumps(mesh)
    for _ in range(20):
        bytes_ = bytearray(text)
        at = int(random.integers(len(state), len(text)))
        bytes_[at] ^= 0x40
        for key in ("triangle_links", "triangle_vertices", "vertex_stars", "free_vertices"):
            values = state[key].copy()
            if len(values) > 0:
                values[int(random.integers(len(values)))] ^= np.uint32(1 << int(random.integers(32)))
            other = remodel.Mesh.__new__(remodel.Mesh)
            try:
                other.__setstate__(({**state, key: values}, stopped))
            except OURS:
                continue
            other.check()


def test_objects_collected_in_odd_orders(airfoil):
    mesh = remodel.generate(airfoil, points=40)
    points, trial = mesh.points, mesh.trial(remodel.Airfoil("naca:0013"))
    trial.__enter__()
    step, inside = trial.step, mesh.points
    del mesh, trial  # the trial ends, then the mesh is gone
    gc.collect()
    assert np.isfinite(points).all() and np.isfinite(inside).all()
    assert step.triangles > 0 and len(step.changes.moved) > 0
    with pytest.raises(remodel.ArgumentError):
        step.after
    changes = step.changes
    del step
    gc.collect()
    assert len(changes.moved) > 0


def test_trials_out_of_order(mesh):
    trial = mesh.trial("naca:0013")
    with pytest.raises(remodel.ArgumentError):
        trial.keep()
    with pytest.raises(remodel.ArgumentError):
        trial.step
    with trial:
        with pytest.raises(remodel.Error):
            mesh.trial("naca:2412").__enter__()
        with pytest.raises(remodel.ArgumentError):
            trial.__enter__()
    trial.__exit__(None, None, None)
    with pytest.raises(remodel.ArgumentError):
        trial.keep()
    with pytest.raises(remodel.ArgumentError):
        trial.__enter__()
    assert mesh.check().valid


def test_a_signal_handler_that_uses_the_mesh_of_the_call_it_interrupts(airfoil):
    mesh = remodel.generate(airfoil, points=1000)
    seen = []

    def handler(*_):
        try:
            seen.append(len(mesh.points))
        except remodel.ArgumentError as error:
            seen.append(error)

    previous = signal.signal(signal.SIGALRM, handler)
    signal.setitimer(signal.ITIMER_REAL, 0.01, 0.01)
    try:
        for number in range(200):
            mesh.update(airfoil.with_design(airfoil.design * (1 + 0.1 * (number % 2))))
            if len(seen) > 20:
                break
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, previous)
    assert seen and mesh.check().valid


def test_threads_that_share_a_mesh_and_its_trials(mesh, designs):
    row, unexpected = designs(30, 0.005), []

    def work(number):
        for design in row:
            try:
                if number % 2:
                    with mesh.trial(design):
                        mesh.points.sum()
                else:
                    mesh.update(design)
                    mesh.copy(), mesh.check(), repr(mesh)
            except remodel.Error:
                pass  # another thread's trial is under way
            except BaseException as error:
                unexpected.append(error)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not unexpected and mesh.check().valid


def test_a_forked_process_goes_on_with_its_own_mesh(mesh, airfoil):
    child = os.fork()
    if child == 0:
        try:
            mesh.update(airfoil.with_design(airfoil.design * 1.05))
            os._exit(0 if mesh.check().valid else 1)
        finally:
            os._exit(2)
    assert os.waitpid(child, 0)[1] == 0
    assert mesh.steps == 0 and mesh.check().valid


def resident():
    """Bytes in memory."""
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_ten_thousand_designs_take_no_more_memory(airfoil):
    """Under the sanitizers, which keep what is freed, a tenth of them."""
    mesh = remodel.generate(airfoil, points=40)
    pair = [airfoil.with_design(airfoil.design * scale) for scale in (1.0, 1.002)]
    sanitized = "asan" in os.environ.get("LD_PRELOAD", "")

    def run(count):
        for number in range(count):
            step = mesh.update(pair[number % 2], record=number % 10 == 0)
            assert len(mesh.points) == len(mesh.vertex_ids) and step.triangles > 0

    run(500)
    before = resident()
    run(500 if sanitized else 9500)
    gc.collect()
    assert sanitized or resident() - before < 4 << 20


def test_hundreds_of_flows_with_gradients_take_no_more_memory(airfoil):
    """The growth of the last half: the factors of the first flows have found their room by then."""
    mesh, flow = remodel.generate(airfoil, points=40), remodel.LivingFlow()
    sanitized = "asan" in os.environ.get("LD_PRELOAD", "")

    def run(count):
        for number in range(count):
            mesh.update(airfoil.with_design(airfoil.design * (1.0 + 0.002 * (number % 7))))
            assert flow.solve(mesh, mach=0.4).converged
            assert np.isfinite(mesh.vjp(flow.gradients()["cd"]["points"])).all()
        gc.collect()
        return resident()

    half = run(10 if sanitized else 150)
    whole = run(10 if sanitized else 150)
    assert sanitized or whole - half < 8 << 20
