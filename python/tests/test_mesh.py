import copy
import gc
import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest
import remodel
from conftest import interrupt_inside, same


def test_a_generated_mesh_is_valid(mesh):
    check = mesh.check()
    assert check and check.valid and check.delaunay and not check.violations
    assert len(mesh) == len(mesh.triangles) == check.triangles
    assert mesh.min_angle >= 30 and mesh.max_gradation <= 1
    assert mesh.stopped == "done"
    assert len(mesh.boundaries["airfoil"]) >= 60
    assert mesh.triangles.max() == len(mesh.points) - 1


def test_a_limit_is_in_the_result_and_a_warning(airfoil):
    with pytest.warns(UserWarning, match="^max_vertices, 150, ended refinement, the mesh is valid but below its quality"):
        assert remodel.generate(airfoil, points=60, max_vertices=150).stopped == "vertex-budget"


def test_arrays_are_views_of_one_memory_and_read_only(mesh):
    points = mesh.points
    assert np.shares_memory(points, mesh.points) and np.shares_memory(points, mesh.freeze().points)
    assert not points.flags.owndata
    for array in (points, mesh.triangles, mesh.vertex_ids, mesh.birth, *mesh.boundaries.values()):
        assert not array.flags.writeable
        with pytest.raises(ValueError):
            array.flags.writeable = True
        with pytest.raises(ValueError):
            array[0] = 0


def test_views_outlive_steps_and_the_mesh_itself(mesh, designs):
    points, before = mesh.points, mesh.points.copy()
    triangles, joined = mesh.triangles, mesh.triangles.copy()
    for design in designs(20, 0.01):
        mesh.update(design)
    assert not np.shares_memory(points, mesh.points)
    del mesh
    gc.collect()
    ballast = [np.random.random((len(before), 2)) for _ in range(50)]
    assert np.array_equal(points, before) and np.array_equal(triangles, joined), len(ballast)


def test_a_step_counts_what_it_did(mesh, designs):
    for design in designs(20):
        before = mesh.freeze()
        step = mesh.update(design, record=True)
        after = mesh.freeze()
        assert step.triangles_before == len(before.triangles) and step.triangles == len(after.triangles)
        keys = lambda m: set(m.vertex_keys.tolist())
        assert set(step.changes.inserted.tolist()) == keys(after) - keys(before)
        assert set(step.changes.removed.tolist()) == keys(before) - keys(after)
        assert step.full_adjustment == step.changes.same_connectivity or not step.full_adjustment
        assert 0 <= step.preserved_percent <= step.connectivity_percent <= 100
        fates = np.bincount(step.fates, minlength=3)
        assert fates.sum() == step.triangles and fates[0] == step.preserved
        assert fates[2] == len(step.changes.born)
    assert mesh.check().valid


def test_the_same_designs_make_the_same_mesh(airfoil, designs):
    row = designs(10, 0.01)
    meshes = [remodel.generate(airfoil, points=60) for _ in range(2)]
    for mesh in meshes:
        for design in row:
            mesh.update(design)
    assert same(*meshes)


def test_a_step_from_one_domain_to_another():
    square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    domain = lambda x: remodel.Domain.polygons({"outside": square}, {"hole": square / 4 + x})
    mesh = remodel.generate(domain(1.0))
    step = mesh.update(domain(1.01))
    assert step.preserved > 0 and mesh.check().valid
    assert mesh.domain == domain(1.01)


def test_elements_are_named_where_there_are_several(airfoil, designs):
    elements = [{"name": "main", "airfoil": airfoil}, {"name": "flap", "airfoil": airfoil, "chord": 0.3, "rotation": -20, "position": (1.02, -0.03)}]
    mesh = remodel.generate(remodel.Domain.airfoils(elements, points=60), gradation=1.5)
    with pytest.raises(remodel.ArgumentError):
        mesh.update(airfoil)
    flap = designs(1)[0]
    mesh.update(flap, boundary="flap")
    elements[1]["airfoil"] = flap
    assert mesh.domain == remodel.Domain.airfoils(elements, points=60)
    assert mesh.check().valid


def test_a_trial_returns_to_the_last_bit(mesh, designs):
    original = mesh.copy()
    for design in designs(5, 0.01):
        with mesh.trial(design) as trial:
            assert trial.step.triangles == len(mesh)
            assert mesh.domain != original.domain
            assert mesh.copy().check().valid
            with pytest.raises(remodel.Error):
                mesh.update(design)
        assert same(mesh, original)
    with pytest.raises(ZeroDivisionError):
        with mesh.trial(design):
            raise ZeroDivisionError
    assert same(mesh, original)
    with mesh.trial(design) as trial:
        trial.keep()
    assert not same(mesh, original) and mesh.check().valid
    other = original.copy()
    other.update(design)
    assert same(mesh, other)


def test_copies_and_pickles_go_on_to_the_same_mesh(mesh, designs):
    for design in designs(3, 0.01):
        mesh.update(design)
    twins = [mesh.copy(), copy.copy(mesh), copy.deepcopy(mesh), pickle.loads(pickle.dumps(mesh))]
    for design in designs(5, 0.01):
        for one in (mesh, *twins):
            one.update(design)
    for twin in twins:
        assert same(mesh, twin)


def test_a_refused_design_leaves_the_mesh_as_it_was(mesh, airfoil):
    original = mesh.copy()
    with pytest.raises(remodel.GeometryError) as refused:
        mesh.update(airfoil.with_design(-airfoil.design))
    assert refused.value.place and isinstance(refused.value, ValueError)
    assert same(mesh, original)
    mesh.update(airfoil.with_design(airfoil.design * 1.01))
    assert mesh.check().valid


def test_meshes_in_threads_and_a_mesh_that_threads_share(airfoil, designs):
    row = designs(20, 0.005)
    expected = remodel.generate(airfoil, points=60)
    for design in row:
        expected.update(design)
    # Designs of its own for each thread: a step to the design that the mesh has already is not counted.
    rows = [[airfoil.with_design(design.design * (1 + 0.001 * number)) for design in row] for number in range(4)]
    own, shared, failures = [], remodel.generate(airfoil, points=60), []

    def work(others):
        try:
            mesh = remodel.generate(airfoil, points=60)
            for design, other in zip(row, others):
                mesh.update(design)
                shared.update(other)
                assert len(shared.points) > 0
            own.append(mesh)
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=work, args=(others,)) for others in rows]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures
    assert all(same(mesh, expected) for mesh in own)
    assert shared.steps == 80 and shared.check().valid


def test_ctrl_c_ends_a_long_call(airfoil):
    timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        while time.monotonic() < started + 60:
            remodel.generate(airfoil, points=3000, gradation=12)
    timer.join()


def test_ctrl_c_does_not_wait_for_the_validator_and_imports(airfoil):
    mesh = remodel.generate(airfoil, points=3000, gradation=12)
    for call in (mesh.check, lambda: remodel.check(mesh), lambda: remodel.import_mesh(mesh.freeze())):
        interrupt_inside(lambda: [call() for _ in range(1000)])
        mesh.update(airfoil)  # while its arrays are still being looked at
        assert mesh.check().valid


def test_values_ride_along_and_the_matrix_says_the_same(mesh, designs):
    linear = lambda m: np.column_stack([np.ones(len(m.points)), m.points @ [0.3, -0.7]])
    for design in designs(3, 0.01):
        before = linear(mesh)
        step = mesh.update(design, record=True)
        rode = step.transfer.ride(before)
        assert np.array_equal(rode[:, 0], np.ones(len(mesh.points)))
        pytest.importorskip("scipy")
        matrix = step.transfer.matrix()
        assert matrix.shape == (len(mesh.points), len(before))
        assert np.allclose(matrix @ before, rode, atol=1e-12)
