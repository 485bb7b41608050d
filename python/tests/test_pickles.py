"""Whatever a user holds leaves the process whole, and goes on as a copy does."""

import concurrent.futures
import multiprocessing
import pickle

import numpy as np
import pytest
import remodel
from conftest import same

STRATEGIES = ["chain", "renew", "morph", "reference"]


def through(thing):
    return pickle.loads(pickle.dumps(thing))


def bytes_of(mesh, file):
    mesh.save(file)
    return file.read_bytes()


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_a_pickled_mesh_goes_on_as_a_copy_does(mesh, designs, strategy, tmp_path):
    row = designs(12, 0.006)
    for design in row[:6]:
        mesh.update(design, strategy=strategy)
    pickled, copied = through(mesh), mesh.copy()
    assert bytes_of(pickled, tmp_path / "a.vtkhdf") == bytes_of(mesh, tmp_path / "b.vtkhdf")  # all that it knows is there
    assert pickled.held == mesh.held and pickled.delaunay_slack == mesh.delaunay_slack
    for number, design in enumerate(row[6:]):
        for each in (pickled, copied):
            each.update(design, strategy=STRATEGIES[number % 4])
            assert each.check().valid
        assert same(pickled, copied)


def test_meshes_held_by_a_reference_are_valid_on_every_way(airfoil, designs, tmp_path):
    mesh, slack = remodel.generate(airfoil, points=60), False
    for design in designs(20, 0.006):
        step = mesh.update(design, strategy="reference", record=True)
        mesh.save(tmp_path / "m.vtkhdf")
        assert mesh.held == step.held and mesh.delaunay_slack == (20.0 if step.held else 0.0)
        for each in (mesh, through(mesh), mesh.copy(), remodel.Mesh.load(tmp_path / "m.vtkhdf"), mesh.freeze(), through(mesh.freeze()), step.after, through(step).after):
            assert each.check().valid, each
        assert remodel.check(mesh).valid and remodel.check(mesh.freeze()).valid
        slack = slack or not remodel.check(mesh, delaunay_slack=0.0).valid
    assert slack  # there was something to be forgiven
    mesh.update(designs(1)[0])
    assert not mesh.held and mesh.delaunay_slack == 0.0 and mesh.check().delaunay


def test_a_slack_of_ones_own_decides(airfoil, designs):
    for design in designs(10, 0.006):
        mesh = remodel.generate(airfoil, points=60)
        mesh.update(design, strategy="reference", delaunay_slack=0.0)
        assert mesh.check().delaunay and mesh.delaunay_slack == 0.0
    with pytest.raises(remodel.ArgumentError, match="^delaunay_slack: "):
        mesh.update(design, strategy="reference", delaunay_slack=61.0)


def test_earlier_pickles_are_read(mesh, designs):
    """They had no reference."""
    state, stopped, _ = mesh.__getstate__()
    assert "reference_coordinates" not in state
    mesh.update(designs(1)[0], strategy="reference")
    held, *_ = mesh.__getstate__()
    old = {key: value for key, value in held.items() if not key.startswith("reference_") and key != "delaunay_slack_deg"}
    other = remodel.Mesh.__new__(remodel.Mesh)
    other.__setstate__((old, stopped))
    assert not other.held and np.array_equal(other.points, mesh.points)


def test_results_are_whole(mesh, airfoil, designs):
    design = designs(1)[0]
    solver = remodel.LivingFlow()
    flow = solver.solve(mesh, mach=0.4, alpha=1.0)
    flow.remark = "kept"
    other = through(flow)
    assert (other.cl, other.cd, other.cm, other.status, other.start, other.solver, other.remark) == (flow.cl, flow.cd, flow.cm, "converged", "cold", flow.solver, "kept")
    assert other.bodies == flow.bodies and np.array_equal(other.cp, flow.cp) and np.array_equal(other.history, flow.history)
    assert np.array_equal(other.mesh.points, mesh.points) and list(other.mesh.boundaries) == list(mesh.boundaries)
    gradient = through(solver.gradients())["cd"]["points"]
    assert np.array_equal(mesh.vjp(gradient), mesh.vjp(solver.gradients()["cd"]["points"]))
    assert abs(through(solver).solve(mesh, mach=0.4, alpha=1.0).cl - flow.cl) < 1e-9

    potential = remodel.PotentialSolver(mesh)
    at = potential.at(2.0)
    assert np.array_equal(through(at).velocity, at.velocity) and np.array_equal(through(at).bodies["airfoil"]["cp"], at.bodies["airfoil"]["cp"])
    assert through(potential).at(2.0).lift == at.lift

    check = mesh.check()
    assert repr(through(check)) == repr(check) and through(check).boundary == check.boundary and through(check).area == check.area
    broken = remodel.FrozenMesh(mesh.points, mesh.triangles[:, ::-1]).check()
    assert [repr(v) for v in through(broken).violations] == [repr(v) for v in broken.violations]

    step = mesh.update(remodel.Airfoil("naca:2412"), record=True)
    again = through(step)
    assert repr(again) == repr(step) and np.array_equal(again.fates, step.fates) and np.array_equal(again.changes.born, step.changes.born)
    assert np.array_equal(again.transfer.ride(again.before.points[:, 0]), step.transfer.ride(step.before.points[:, 0]))
    carry = through(step.transfer)
    assert np.array_equal(carry.ride(step.before.points), step.transfer.ride(step.before.points)) and carry.outside == step.transfer.outside
    bare = through(mesh.update(design))
    assert bare.before is None and bare.triangles == len(mesh)
    with pytest.raises(remodel.ArgumentError, match="record=True"):
        bare.after

    field = remodel.InteriorDisplacement(mesh)
    walls = mesh.jvp(design.design)
    assert np.array_equal(through(field).jvp(walls), field.jvp(walls))
    assert through(remodel.generate) is remodel.generate and through(remodel.Airfoil) is remodel.Airfoil


def test_damaged_records_raise(mesh):
    frozen = mesh.freeze()
    state = frozen.__getstate__()
    nothing = remodel.FrozenMesh.__new__(remodel.FrozenMesh)
    for at in range(len(state)):
        for wrong in (None, "x", b"123", b"\xff" * 24, [1], 99.0):
            try:
                nothing.__setstate__((*state[:at], wrong, *state[at + 1 :]))
            except (remodel.FormatError, TypeError, RuntimeError):
                continue
            remodel.check(nothing)  # values that another mesh may have
            nothing = remodel.FrozenMesh.__new__(remodel.FrozenMesh)
    with pytest.raises(remodel.FormatError):
        nothing.__setstate__(state[:-1])
    flow = remodel.solve_flow(mesh, mach=0.4, max_steps=1)
    record, attributes = flow.__getstate__()
    for wrong in ((record[:-1], attributes), ((*record[:-1], b""), attributes), ((9, *record[1:]), attributes), (record, None), ()):
        with pytest.raises(remodel.FormatError):
            remodel.FlowResult.__new__(remodel.FlowResult).__setstate__(wrong)


def evaluate(design):
    """A design in a process of its own: everything that it made comes back."""
    airfoil = remodel.Airfoil("naca:0012")
    mesh = remodel.generate(airfoil, points=40)
    step = mesh.update(airfoil.with_design(design), strategy="reference", record=True)
    return mesh, step, remodel.solve_flow(mesh, mach=0.4, alpha=1.0), mesh.check()


@pytest.mark.parametrize("start", ["fork", "spawn"])
def test_a_process_pool_returns_what_it_made(airfoil, designs, start):
    row = [design.design for design in designs(4)]
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(start)) as pool:
        results = list(pool.map(evaluate, row))
    for design, (mesh, step, flow, check) in zip(row, results):
        here, _, flow_here, _ = evaluate(design)
        assert same(mesh, here) and check.valid and step.held and flow.cl == flow_here.cl
        assert np.array_equal(step.after.points, flow.mesh.points)
