import sys
import types

import numpy as np
import pytest
import remodel


@pytest.fixture
def mesh(airfoil):
    return remodel.generate(airfoil, points=40)


def test_points_follow_as_jvp_says(mesh, airfoil, designs):
    direction = designs(1)[0].design - airfoil.design
    moved = mesh.jvp(direction)
    h = 1e-4
    ahead, behind = (mesh.at(airfoil.with_design(airfoil.design + s * direction)) for s in (h, -h))
    assert np.array_equal(ahead.triangles, mesh.triangles)
    assert moved.shape == mesh.points.shape and np.any(moved != 0)
    assert np.allclose((ahead.points - behind.points) / (2 * h), moved, atol=1e-10)


def test_vjp_is_jvp_transposed(mesh, designs, airfoil):
    direction = designs(1)[0].design - airfoil.design
    weights = np.random.default_rng(2).standard_normal(mesh.points.shape)
    assert np.isclose(np.sum(weights * mesh.jvp(direction)), mesh.vjp(weights) @ direction, rtol=1e-12)
    for wrong in (direction[:-1], [[1.0]]):
        with pytest.raises(remodel.ArgumentError):
            mesh.jvp(wrong)
    with pytest.raises(remodel.ArgumentError):
        mesh.vjp(weights[:-1])


def test_gradients_of_a_flow_agree_with_flows(mesh, airfoil, designs):
    direction = designs(1)[0].design - airfoil.design
    solver = remodel.LivingFlow(tolerance=1e-12)
    with pytest.raises(remodel.ArgumentError):
        solver.gradients()
    solver.solve(mesh, mach=0.4, alpha=1.0)
    gradients = solver.gradients()
    h = 1e-3
    ahead, behind = (remodel.solve_flow(mesh.at(airfoil.with_design(airfoil.design + s * direction)), mach=0.4, alpha=1.0, tolerance=1e-12) for s in (h, -h))
    for name in ("cl", "cd", "cm"):
        difference = (getattr(ahead, name) - getattr(behind, name)) / (2 * h)
        assert np.isclose(mesh.vjp(gradients[name]["points"]) @ direction, difference, rtol=1e-3, atol=1e-6), name


def test_connectivity_that_has_to_change_raises(mesh):
    with pytest.raises(remodel.TopologyChanged):
        mesh.at("rae2822")


def test_idwarps_calls(mesh):
    from remodel.idwarp import USMesh

    warp = USMesh(mesh)
    surface = warp.getSurfaceCoordinates()
    grid = warp.getSolverGrid()
    assert grid.shape == (3 * len(mesh.points),) and len(surface) >= 40
    warp.setSurfaceCoordinates(surface * [1.0, 1.001, 1.0])
    warp.warpMesh()
    moved = warp.getSolverGrid() - grid
    assert np.any(moved != 0) and np.count_nonzero(moved.reshape(-1, 3).any(axis=1)) <= len(surface)
    with pytest.raises(remodel.ArgumentError):
        warp.getdXs()
    weights = np.random.default_rng(3).standard_normal(len(grid))
    warp.warpDeriv(weights)
    step = np.random.default_rng(4).standard_normal(surface.shape)
    assert np.isclose(np.sum(warp.getdXs() * step), weights @ warp.warpDerivFwd(step))
    after = warp.getSolverGrid()
    warp.setSurfaceCoordinates(surface * [1.0, 4.0, 1.0])
    with pytest.raises(remodel.TopologyChanged):
        warp.warpMesh()
    assert np.array_equal(warp.getSolverGrid(), after)
    with pytest.raises(remodel.ArgumentError):
        warp.setSurfaceCoordinates(surface[:-1])


class Options(dict):
    def declare(self, name, default=None):
        self.setdefault(name, default)


class ExplicitComponent:
    """What the components use of OpenMDAO's, which is not in Debian."""

    def __init__(self, **options):
        self.options, self.inputs, self.outputs, self.partials = Options(), {}, {}, set()
        self.initialize()
        self.options.update(options)

    def add_input(self, name, val):
        self.inputs[name] = np.atleast_1d(np.array(val, dtype=float))

    def add_output(self, name, val):
        self.outputs[name] = np.atleast_1d(np.array(val, dtype=float))

    def declare_partials(self, of, wrt):
        self.partials.add((of, tuple(np.atleast_1d(wrt))))


def test_openmdao_components(mesh, airfoil, designs, monkeypatch):
    api = types.SimpleNamespace(ExplicitComponent=ExplicitComponent, AnalysisError=type("AnalysisError", (Exception,), {}))
    monkeypatch.setitem(sys.modules, "openmdao", types.ModuleType("openmdao"))
    monkeypatch.setitem(sys.modules, "openmdao.api", api)
    monkeypatch.delitem(sys.modules, "remodel.openmdao", raising=False)
    from remodel.openmdao import FlowComponent, MeshComponent

    geometry = MeshComponent(mesh=mesh, airfoil=airfoil)
    geometry.setup()
    flow = FlowComponent(geometry=geometry, solver=remodel.LivingFlow(tolerance=1e-12), mach=0.4, alpha=1.0)
    flow.setup()

    def lift(design):
        geometry.inputs["design"] = design
        geometry.compute(geometry.inputs, geometry.outputs)
        flow.inputs["points"] = geometry.outputs["points"]
        flow.compute(flow.inputs, flow.outputs)
        return flow.outputs["cl"]

    direction, h = designs(1)[0].design - airfoil.design, 1e-3
    difference = (lift(airfoil.design + h * direction) - lift(airfoil.design - h * direction)) / (2 * h)
    lift(airfoil.design)
    partials = {}
    flow.compute_partials(flow.inputs, partials)
    d_points = {"points": partials["cl", "points"].reshape(-1, 2)}
    reverse, forward = {"design": np.zeros(12)}, {"points": np.zeros_like(mesh.points)}
    geometry.compute_jacvec_product(geometry.inputs, reverse, d_points, "rev")
    geometry.compute_jacvec_product(geometry.inputs, {"design": direction}, forward, "fwd")
    assert np.isclose(reverse["design"] @ direction, difference, rtol=1e-3)
    assert np.isclose(np.sum(forward["points"] * d_points["points"]), difference, rtol=1e-3)
    with pytest.raises(api.AnalysisError):
        lift(remodel.Airfoil("rae2822").design)
