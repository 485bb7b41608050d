import json
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
from pathlib import Path

import numpy as np
import pytest
import remodel
from conftest import interrupt_inside

SOURCE = Path(os.environ.get("REMODEL_PYTHON_TEST_SOURCE", Path(__file__).resolve().parents[2]))


@pytest.fixture(scope="module")
def flowing():
    airfoil = remodel.Airfoil("naca:0012")
    return airfoil, remodel.generate(airfoil, points=60)


def test_a_flow_has_coefficients_and_fields(flowing):
    _, mesh = flowing
    flow = remodel.solve_flow(mesh, mach=0.5, alpha=1.25)
    assert flow.converged and flow.status == "converged" and flow.reason == ""
    assert 0.1 < flow.cl < 0.25 and abs(flow.cd) < 0.01
    assert abs(flow.bodies["airfoil"]["cl"] - flow.cl) < 1e-14
    for values in (flow.density, flow.pressure, flow.velocity_x, flow.cp, flow.local_mach, flow.entropy):
        assert values.shape == (len(mesh.points),) and np.all(np.isfinite(values))
    assert not flow.density.flags.writeable and flow.history[-1] <= 1e-10
    assert np.array_equal(flow.mesh.points, mesh.points)


def test_a_far_field_may_have_several_parts(flowing):
    _, mesh = flowing
    edges = mesh.boundaries["farfield"]
    walls = {"airfoil": mesh.boundaries["airfoil"], "front": edges[:20], "back": edges[20:]}
    parts = remodel.FrozenMesh(mesh.points, mesh.triangles, walls)
    whole = remodel.solve_flow(mesh, mach=0.5, alpha=1.25)
    solver = remodel.LivingFlow(farfield=["front", "back"])
    for flow in (remodel.solve_flow(parts, mach=0.5, alpha=1.25, farfield=("front", "back")),
                 pickle.loads(pickle.dumps(solver)).solve(parts, mach=0.5, alpha=1.25)):  # fmt: skip
        assert list(flow.bodies) == ["airfoil"] and abs(flow.cl - whole.cl) < 1e-9
    potential = remodel.PotentialSolver(parts, farfield=["back", "front"])
    lift = remodel.PotentialSolver(mesh).at(2.0).lift
    assert abs(pickle.loads(pickle.dumps(potential)).at(2.0).lift - lift) < 1e-9
    with pytest.raises(remodel.ArgumentError, match="a far field of the name 'sky'"):
        remodel.solve_flow(parts, mach=0.5, farfield=["front", "back", "sky"])


def test_a_living_flow_goes_on_over_steps(flowing):
    airfoil, mesh = flowing
    mesh, solver = mesh.copy(), remodel.LivingFlow()
    for scale in (1.0, 1.01, 1.02):
        mesh.update(airfoil.with_design(airfoil.design * scale))
        flow = solver.solve(mesh, mach=0.5, alpha=1.25)
        cold = remodel.solve_flow(mesh, mach=0.5, alpha=1.25)
        assert flow.converged and abs(flow.cl - cold.cl) < 1e-7
    assert flow.start != "cold"
    solver.forget()
    cold = solver.solve(mesh, mach=0.5, alpha=1.25)
    assert (cold.start, cold.origin) == ("cold", "potential")
    assert cold.entropy_drag == pytest.approx(cold.cd, abs=1e-4)


def test_little_memory_makes_it_gmres(flowing):
    whole = remodel.solve_flow(flowing[1], mach=0.5, alpha=1.25, solver="lu")
    little = remodel.solve_flow(flowing[1], mach=0.5, alpha=1.25, solver="lu", memory_mb=0.5 * whole.memory_mb)
    assert (whole.solver, little.solver) == ("lu", "gmres") and whole.gmres_iterations == 0
    assert little.converged and little.gmres_iterations > 0 and little.memory_mb <= 0.5 * whole.memory_mb
    assert abs(little.cl - whole.cl) < 1e-9
    with pytest.raises(remodel.ArgumentError, match="found 'cholesky', expected 'lu', 'gmres' or None"):
        remodel.solve_flow(flowing[1], mach=0.5, solver="cholesky")


def test_the_angle_of_a_lift_is_found(flowing):
    flow = remodel.solve_flow(flowing[1], mach=0.5, cl=0.3)
    assert abs(flow.cl - 0.3) < 1e-8 and flow.alpha > 1


def test_potential_flow(flowing):
    _, mesh = flowing
    solver = remodel.PotentialSolver(mesh)
    flow = solver.at(2.0)
    assert abs(flow.lift - 2 * np.pi * np.radians(2.0)) < 0.04
    assert abs(solver.alpha_for(flow.lift) - 2.0) < 1e-9
    wall = flow.bodies["airfoil"]
    assert np.allclose(mesh.points[wall["vertices"]], wall["points"])
    assert flow.velocity.shape == (len(mesh.points), 2) and flow.cp.max() < 1.1


def test_lift_without_an_edge_is_warned_of(flowing):
    far = {"name": "farfield", "stations": 32, "shape": {"kind": "arc", "centre": [0, 0], "radius": 20, "start": 0,
                                                         "sweep": 2 * np.pi}}
    wheel = {"name": "wheel", "stations": 40, "shape": {"kind": "arc", "centre": [0, 0], "radius": 0.5, "start": 0.1,
                                                        "sweep": 2 * np.pi}}
    loops = [{"role": "outer", "curves": [far]}, {"role": "hole", "curves": [wheel]}]
    mesh = remodel.generate(remodel.Domain.from_json(json.dumps({"loops": loops})))
    for flow in (remodel.LivingFlow().solve(mesh, mach=0.3), remodel.PotentialSolver(mesh).at(0.0)):
        assert not flow.lift_determined
        assert sum("'wheel' is not determined" in text for text in flow.warnings) == 1
        again = pickle.loads(pickle.dumps(flow))
        assert again.warnings == flow.warnings and not again.lift_determined
        for found in (flow, again):
            lift = ("cl", "cm") if hasattr(flow, "cl") else ("lift", "lift_by_pressure", "moment")
            body = found.bodies["wheel"]
            assert all(np.isnan([getattr(found, name) for name in lift]))
            assert all(np.isnan([body[name] for name in (("cl", "cm") if hasattr(flow, "cl") else ("lift", "moment"))]))
        assert abs(flow.cd if hasattr(flow, "cd") else flow.drag_by_pressure) < 0.5
    section = flowing[1]
    for flow in (remodel.LivingFlow().solve(section, mach=0.3), remodel.PotentialSolver(section).at(2.0)):
        assert not any("not determined" in text for text in flow.warnings) and flow.lift_determined


def test_potential_flow_knows_the_mach_number(flowing):
    solver = remodel.PotentialSolver(flowing[1])
    slow, fast = solver.at(2.0), solver.at(2.0, mach=0.5)
    assert abs(fast.lift / slow.lift - (1 - 0.5**2) ** -0.5) < 1e-12
    assert fast.cp.min() < slow.cp.min() and not fast.supersonic and solver.at(2.0, mach=0.8).supersonic
    assert abs(solver.alpha_for(fast.lift, mach=0.5) - 2.0) < 1e-9


def test_a_row_of_blades_is_found_by_its_mesh_or_by_names():
    passage = remodel.Domain.from_json((SOURCE / "examples/domains/cascade.json").read_text())
    mesh = remodel.generate(passage)
    given = dict(mach=0.5, alpha=40.0, inlets={"inlet": (1.0, 1.0, 40.0)}, outlets={"outlet": 1.07})
    flow = remodel.solve_flow(mesh, **given)
    assert flow.converged
    assert flow.flow_angles["inlet"] == pytest.approx(40.0, abs=0.01)
    assert flow.flow_angles["outlet"] < 25.0
    assert flow.total_pressures["outlet"] == pytest.approx(1.0, abs=1e-3)
    frozen = mesh.freeze()
    arrays = remodel.FrozenMesh(frozen.points, frozen.triangles, frozen.boundaries)
    solver = remodel.LivingFlow(
        inlets=given["inlets"], outlets=given["outlets"], periodic=[("below", "above")]
    )
    again = pickle.loads(pickle.dumps(solver)).solve(arrays, mach=0.5, alpha=40.0)
    assert again.cl == pytest.approx(flow.cl, rel=1e-9)
    with pytest.raises(remodel.ArgumentError, match="found 1 numbers for 'inlet'"):
        remodel.LivingFlow(inlets={"inlet": (1.0,)}, outlets={"outlet": 1.0})


def test_a_duct_takes_in_what_it_lets_out():
    line = lambda name, a, b, n: {"name": name, "shape": {"kind": "line", "from": a, "to": b}, "stations": n}
    a, b, c, d = [0, 0], [4, 0], [4, 1], [0, 1]
    sides = [line("in", d, a, 4), line("floor", a, b, 16), line("out", b, c, 4), line("roof", c, d, 16)]
    duct = remodel.Domain.from_json(json.dumps({"loops": [{"role": "outer", "curves": sides}]}))
    mesh = remodel.generate(duct)
    openings = dict(inlets={"in": (1.0, 1.0)}, outlets={"out": 1.0})
    for flow in (remodel.solve_flow(mesh, mach=0.3, **openings), remodel.LivingFlow(**openings).solve(mesh, mach=0.3)):
        assert flow.converged and abs(flow.openings["in"] - 0.3) < 1e-7 and abs(flow.openings["out"] + 0.3) < 1e-7
    with pytest.raises(remodel.ArgumentError, match="total pressure"):
        remodel.solve_flow(mesh, mach=0.3, inlets={"in": (-1.0, 1.0)}, outlets={"out": 1.0})


def test_conditions_out_of_range_are_errors(flowing):
    _, mesh = flowing
    for wrong in (dict(mach=-1), dict(mach=np.nan), dict(alpha=1e9), dict(farfield="nobody"), dict(tolerance=1.0), dict(reference_length=0.0)):
        with pytest.raises(remodel.ArgumentError):
            remodel.solve_flow(mesh, **wrong)
    with pytest.raises(remodel.ArgumentError):
        remodel.PotentialSolver(mesh).at(1000.0)


def test_a_limit_is_in_the_result(flowing):
    flow = remodel.solve_flow(flowing[1], mach=0.5, max_steps=1)
    assert not flow.converged and flow.status == "step-limit" and flow.reason


def test_ctrl_c_ends_a_flow():
    mesh = remodel.generate("naca:0012", points=100, gradation=3)
    timer = threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(100):
            remodel.solve_flow(mesh, mach=0.5, alpha=1.25)
    timer.join()


def test_ctrl_c_does_not_wait_for_a_factorisation(flowing):
    _, small = flowing
    mesh, solver = remodel.generate("naca:0012", points=400), remodel.LivingFlow()
    for call in (lambda: remodel.solve_flow(mesh, mach=0.5), lambda: solver.solve(mesh, mach=0.5)):
        interrupt_inside(call)
    assert mesh.check().valid and mesh.update("naca:0013").triangles == len(mesh)
    flow = solver.solve(small, mach=0.5, alpha=1.25)  # after what was left behind
    assert flow.converged and abs(flow.cl - remodel.LivingFlow().solve(small, mach=0.5, alpha=1.25).cl) < 1e-10


def test_a_flow_that_was_interrupted_is_not_the_last_one():
    mesh, solver = remodel.generate("naca:0012", points=400), remodel.LivingFlow()
    interrupt_inside(lambda: solver.solve(mesh, mach=0.5))
    with pytest.raises(remodel.ArgumentError, match="no flow was found yet"):
        solver.gradients()


def test_a_fork_and_the_end_of_the_process_wait_for_what_was_left_behind():
    script = """
        import os
        import remodel
        from conftest import interrupt_inside

        mesh, small = (remodel.generate("naca:0012", points=n) for n in (400, 60))
        interrupt_inside(lambda: remodel.solve_flow(mesh))
        if os.fork() == 0:
            os._exit(0 if remodel._core._left_behind() == 0 and remodel.solve_flow(small).converged else 1)
        assert os.wait()[1] == 0
        solver = remodel.LivingFlow()
        interrupt_inside(lambda: solver.solve(mesh))
        del solver, mesh
    """
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([os.path.dirname(__file__), os.environ.get("PYTHONPATH", "")])}
    run = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], env=environment, capture_output=True, text=True)
    assert run.returncode == 0 and run.stderr == "", run.stderr
