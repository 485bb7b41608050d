"""The components, under a stand-in of OpenMDAO's base class, and under OpenMDAO itself where it can be imported."""

import importlib
import importlib.util
import sys
import types

import numpy as np
import pytest
import remodel


STRATEGIES = ("chain", "renew", "morph", "reference")


class Options(dict):
    def declare(self, name, default=None):
        self.setdefault(name, default)


class ExplicitComponent:
    """What the components use of OpenMDAO's, which is not in Debian."""

    under_finite_difference = under_complex_step = False

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


@pytest.fixture
def api(monkeypatch):
    api = types.SimpleNamespace(ExplicitComponent=ExplicitComponent, AnalysisError=type("AnalysisError", (Exception,), {}))
    monkeypatch.setitem(sys.modules, "openmdao", types.ModuleType("openmdao"))
    monkeypatch.setitem(sys.modules, "openmdao.api", api)
    monkeypatch.delitem(sys.modules, "remodel.openmdao", raising=False)
    yield types.SimpleNamespace(AnalysisError=api.AnalysisError, components=importlib.import_module("remodel.openmdao"))
    sys.modules.pop("remodel.openmdao", None)


@pytest.fixture(autouse=True)
def room(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # OpenMDAO writes a directory for each problem


@pytest.fixture
def mesh(airfoil):
    return remodel.generate(airfoil, points=40)


def flow_of(api, **options):
    component = api.components.FlowComponent(mach=0.4, alpha=1.0, **options)
    component.setup()
    return component


def value(component, name, **inputs):
    component.inputs.update(inputs)
    component.compute(component.inputs, component.outputs)
    return float(np.ravel(component.outputs[name])[0])


def test_outputs_depend_on_the_points_that_are_handed_in(api, mesh):
    """Points of any other component: there need be no MeshComponent."""
    flow = flow_of(api, mesh=mesh)
    points, random = np.array(mesh.points), np.random.default_rng(1)
    base = value(flow, "cl", points=points)
    assert abs(base - remodel.solve_flow(mesh, mach=0.4, alpha=1.0).cl) < 1e-9
    turned = points @ np.array([[1.0, -0.02], [0.02, 1.0]])
    assert abs(value(flow, "cl", points=turned) - base) > 0.01
    flow.compute(flow.inputs | {"points": points}, flow.outputs)
    partials = {}
    flow.compute_partials(flow.inputs | {"points": points}, partials)  # the inputs decide, not what was computed last
    direction, h = random.standard_normal(points.shape) * 1e-3, 1e-3
    for name in ("cl", "cd", "cm"):
        by = {k: value(flow, name, points=points + k * h * direction) for k in (-2, -1, 1, 2)}
        difference = (8 * (by[1] - by[-1]) - (by[2] - by[-2])) / (12 * h)
        assert np.isclose(np.sum(partials[name, "points"] * direction.ravel()), difference, rtol=1e-5, atol=1e-9), name


def test_partials_are_those_of_the_inputs_although_the_solver_is_shared(api, mesh):
    solver = remodel.LivingFlow(tolerance=1e-12)
    one, other = flow_of(api, mesh=mesh, solver=solver), flow_of(api, mesh=mesh, solver=solver)
    value(one, "cl", alpha=np.array([1.0]))
    value(other, "cl", alpha=np.array([3.0]))
    partials, alone = {}, {}
    one.compute_partials(one.inputs, partials)
    separate = flow_of(api, mesh=mesh)
    separate.compute_partials(separate.inputs, alone)
    for key in alone:
        assert np.allclose(partials[key], alone[key], rtol=1e-6, atol=1e-9), key


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_coefficients_to_lift(api, mesh, airfoil, designs, strategy):
    """Of a mesh that steps of any strategy have made: held by its reference or not."""
    mesh.update(designs(2)[1], strategy=strategy)
    mesh.update(airfoil, strategy=strategy)
    geometry = api.components.MeshComponent(mesh=mesh, airfoil=airfoil)
    geometry.setup()
    flow = flow_of(api, geometry=geometry)

    def lift(design):
        value(geometry, "points", design=design)
        return value(flow, "cl", points=geometry.outputs["points"])

    direction, h = designs(1)[0].design - airfoil.design, 1e-3
    difference = (lift(airfoil.design + h * direction) - lift(airfoil.design - h * direction)) / (2 * h)
    lift(airfoil.design)
    partials = {}
    flow.compute_partials(flow.inputs, partials)
    d_points = {"points": partials["cl", "points"].reshape(-1, 2)}
    reverse, forward = {"design": np.zeros(12)}, {"points": np.zeros_like(mesh.points)}
    geometry.compute_jacvec_product(geometry.inputs, reverse, d_points, "rev")
    geometry.compute_jacvec_product(geometry.inputs, {"design": direction}, forward, "fwd")
    assert np.isclose(reverse["design"] @ direction, difference, rtol=1e-5)
    assert np.isclose(np.sum(forward["points"] * d_points["points"]), difference, rtol=1e-5)


def test_connectivity_is_held_for_other_sections_and_failures_say_what_to_do(api, mesh, airfoil):
    geometry = api.components.MeshComponent(mesh=mesh)
    geometry.setup()
    for name in ("naca:2412", "naca:4412", "naca:0018"):
        value(geometry, "points", design=remodel.Airfoil(name).design)
        there = mesh.freeze().with_points(geometry.outputs["points"])
        assert there.check(delaunay=False).valid and there.check().min_angle_deg > 10.0
        wall = mesh.boundaries["airfoil"][:, 0]
        outline = airfoil.with_design(remodel.Airfoil(name).design).coordinates(20001)
        assert max(np.hypot(*(outline - point).T).min() for point in there.points[wall]) < 2e-4
    with pytest.raises(api.AnalysisError, match="^design: its mesh is not valid.*bound the design variables"):
        value(geometry, "points", design=-airfoil.design)
    value(geometry, "points", design=remodel.Airfoil("naca:2412").design)
    geometry.renew()
    assert geometry.options["mesh"].check().valid
    geometry.setup()
    assert np.array_equal(geometry.inputs["design"], remodel.Airfoil("naca:2412").design)
    flow = flow_of(api, mesh=mesh)
    for wrong in (dict(points=-np.array(mesh.points)[:, ::-1]), dict(mach=np.array([-1.0]))):
        with pytest.raises(api.AnalysisError, match="bound the design variables"):
            value(flow_of(api, mesh=mesh), "cl", **wrong)
    with pytest.raises(remodel.ArgumentError, match="^airfoil: "):
        api.components.MeshComponent(mesh=mesh, airfoil=remodel.Airfoil("naca:0012", degree=7)).setup()
    with pytest.raises(remodel.ArgumentError, match="^mesh: "):
        api.components.FlowComponent().setup()
    assert flow is not None


@pytest.mark.skipif(importlib.util.find_spec("openmdao") is None, reason="no OpenMDAO")
@pytest.mark.parametrize("strategy", STRATEGIES)
def test_check_partials_of_openmdao_itself(airfoil, strategy):
    import openmdao.api as om
    from remodel.openmdao import FlowComponent, MeshComponent

    mesh = remodel.generate(airfoil, points=20, farfield_radius=10, farfield_points=12)
    mesh.update(airfoil.with_design(1.05 * airfoil.design), strategy=strategy)
    problem = om.Problem()
    geometry = problem.model.add_subsystem("geometry", MeshComponent(mesh=mesh), promotes_inputs=["design"])
    problem.model.add_subsystem("flow", FlowComponent(geometry=geometry, mach=0.4, alpha=2.0), promotes_inputs=["alpha", "mach"], promotes_outputs=["cl", "cd", "cm"])
    problem.model.connect("geometry.points", "flow.points")
    problem.setup()
    problem.run_model()
    for component, rows in problem.check_partials(out_stream=None, method="fd", form="central", step=1e-5).items():
        for (of, wrt), row in rows.items():
            assert row["abs error"].forward is None or row["abs error"].forward < 1e-5 * max(1.0, np.abs(row["J_fd"]).max()), (component, of, wrt)
    totals = problem.check_totals(of=["cl", "cd", "cm"], wrt=["design", "alpha", "mach"], out_stream=None, form="central", step=1e-5)
    for key, row in totals.items():
        assert np.allclose(row["J_fwd"] if "J_fwd" in row else row["J_rev"], row["J_fd"], rtol=1e-5, atol=1e-6), key


FLOWS = {
    "euler": {"mach": 0.4, "alpha": 1.0, "mesh": {"points": 40}},
    "laminar": {"model": "laminar", "mach": 0.4, "alpha": 1.0, "reynolds": 1000.0, "mesh": {"spacing": 6.0, "growth": 1.5}},
}


def designs_on_the_way(start):
    """From NACA 2412 towards RAE 2822: the start, far, so that triangles are replaced, and near that, so that none are."""
    far = remodel.Airfoil("rae2822", degree=start.degree).design
    return [(1 - part) * start.design + part * far for part in (0.0, 0.5, 0.51)]


def require_small(rows):
    for key, row in rows.items():
        exact = row["J_fwd"] if row.get("J_fwd") is not None else row["J_rev"]
        assert np.abs(exact - row["J_fd"]).max() < 1e-5 * max(1.0, np.abs(row["J_fd"]).max()), key


@pytest.mark.skipif(importlib.util.find_spec("openmdao") is None, reason="no OpenMDAO")
@pytest.mark.parametrize("strategy", STRATEGIES)
@pytest.mark.parametrize(
    "options",
    [
        FLOWS["euler"] | {"thickness_at": (0.3, 0.7)},
        {"mach": 0.4, "lift": 0.2, "mesh": {"points": 40}},
        FLOWS["laminar"],
        {"model": "sa", "mach": 0.4, "alpha": 1.0, "reynolds": 3e6, "mesh": {"spacing": 6.0}, "tolerance": 1e-10},
    ],
    ids=["euler", "lift", "laminar", "sa"],
)
def test_check_partials_and_totals_of_sections(options, strategy):
    import openmdao.api as om
    from remodel.openmdao import SectionComponent

    problem = om.Problem()
    section = SectionComponent(airfoil="naca:2412", strategy=strategy, **({"tolerance": 1e-12} | options))
    problem.model.add_subsystem("section", section, promotes=["*"])
    problem.setup()
    problem.run_model()
    first = section.mesh.freeze()
    for design in designs_on_the_way(section.start):
        problem.set_val("design", design)
        problem.run_model()
    last = section.mesh.freeze()
    assert not np.array_equal(last.triangles, first.triangles)
    for rows in problem.check_partials(out_stream=None, method="fd", form="central", step=1e-5).values():
        require_small(rows)
    wrt = ["design", "mach", "alpha" if "alpha" in options else "lift"]
    require_small(problem.check_totals(of=["cd", "cm", "area"], wrt=wrt, out_stream=None, form="central", step=1e-5))
    assert np.array_equal(section.mesh.points, last.points)  # differences were taken on a mesh that was lent


@pytest.mark.skipif(importlib.util.find_spec("openmdao") is None, reason="no OpenMDAO")
def test_slsqp_of_openmdao_ends_by_itself(airfoil):
    import openmdao.api as om
    from remodel.openmdao import FlowComponent, MeshComponent

    problem = om.Problem()
    geometry = problem.model.add_subsystem("geometry", MeshComponent(mesh=remodel.generate(airfoil, points=40)), promotes_inputs=["design"])
    problem.model.add_subsystem("flow", FlowComponent(geometry=geometry, mach=0.7, alpha=1.0), promotes_inputs=["alpha", "mach"], promotes_outputs=["cl", "cd", "cm"])
    problem.model.connect("geometry.points", "flow.points")
    problem.driver = om.ScipyOptimizeDriver(optimizer="SLSQP", tol=1e-6, maxiter=10, disp=False)
    problem.model.add_design_var("design", lower=airfoil.design - 0.01, upper=airfoil.design + 0.01)
    problem.model.add_design_var("alpha", lower=-2, upper=5)
    problem.model.add_objective("cd", scaler=100.0)
    problem.model.add_constraint("cl", equals=0.3)
    problem.setup()
    problem.run_model()
    problem.run_driver()
    assert abs(problem.get_val("cl")[0] - 0.3) < 1e-4


def section_of(api, **options):
    component = api.components.SectionComponent(**options)
    component.setup()
    return component


def partials_of(component):
    partials = {}
    component.compute_partials(component.inputs, partials)
    return partials


@pytest.mark.parametrize(
    "options",
    [
        {"airfoil": "naca:2412", "mach": 0.4, "alpha": 1.0, "mesh": {"points": 40}, "thickness_at": (0.3, 0.7)},
        {"airfoil": "naca:0012", "mach": 0.4, "lift": 0.2, "mesh": {"points": 40}},
        {"airfoil": "naca:0012", "model": "laminar", "mach": 0.4, "alpha": 1.0, "reynolds": 1000.0,
         "mesh": {"spacing": 6.0, "growth": 1.5}},
    ],
)  # fmt: skip
def test_a_section_has_the_partials_of_the_way_that_its_mesh_goes(api, options):
    section = section_of(api, tolerance=1e-12, **options)
    design = section.inputs["design"].copy()
    outputs = [name for name in ("cl", "alpha", "cd", "cm", "cd_pressure", "area", "thickness") if name in section.outputs]
    section.compute(section.inputs | {"design": design + 0.003}, section.outputs)  # the morph is no longer the first mesh
    base = {"design": design + 0.002}
    section.compute(section.inputs | base, section.outputs)
    section.inputs.update(base)
    partials = partials_of(section)
    random, h = np.random.default_rng(3), 1e-4
    for wrt in ("design", "mach", section._condition):
        direction = random.standard_normal(section.inputs[wrt].shape)
        by = {}
        for k in (-2, -1, 1, 2):
            section.compute(section.inputs | {wrt: section.inputs[wrt] + k * h * direction}, section.outputs)
            by[k] = {name: section.outputs[name].copy() if hasattr(section.outputs[name], "copy") else section.outputs[name] for name in outputs}
        for name in outputs:
            difference = (8 * (np.atleast_1d(by[1][name]) - by[-1][name]) - (np.atleast_1d(by[2][name]) - by[-2][name])) / (12 * h)
            if (name, wrt) not in partials:
                assert np.allclose(difference, 0), (name, wrt)
                continue
            slope = np.atleast_2d(partials[name, wrt]) @ direction
            assert np.allclose(slope, difference, rtol=1e-5, atol=1e-7), (name, wrt, slope, difference)


@pytest.mark.parametrize("model", FLOWS)
@pytest.mark.parametrize("strategy", STRATEGIES)
def test_partials_of_every_strategy_are_those_of_its_steps(api, strategy, model):
    """Wherever the mesh has come to, by steps of a driver's own and by differences that OpenMDAO says it takes."""
    section = section_of(api, airfoil="naca:2412", strategy=strategy, tolerance=1e-12, **FLOWS[model])
    h, replaced = 1e-4, 0
    for design in designs_on_the_way(section.start):
        before = section.mesh.freeze()
        section.inputs["design"] = design
        section.compute(section.inputs, section.outputs)
        replaced += not np.array_equal(before.triangles, section.mesh.triangles)
        partials, points, steps = partials_of(section), section.mesh.points, section.mesh.steps
        direction = np.random.default_rng(5).standard_normal(len(design))
        for section.under_finite_difference in (True, False):
            by = {}
            for k in (-2, -1, 1, 2):
                section.compute(section.inputs | {"design": design + k * h * direction}, section.outputs)
                by[k] = {name: float(section.outputs[name]) for name in ("cl", "cd", "cm")}
            for name in ("cl", "cd", "cm"):
                difference = (8 * (by[1][name] - by[-1][name]) - (by[2][name] - by[-2][name])) / (12 * h)
                slope = float(np.ravel(partials[name, "design"]) @ direction)
                assert abs(slope - difference) < 1e-5 * max(1.0, abs(difference)), (name, slope, difference)
            if section.under_finite_difference:  # the mesh was lent, and is what it was
                assert np.array_equal(section.mesh.points, points) and section.mesh.steps == steps
    assert replaced  # some of these partials are on a mesh whose triangles were replaced


def test_a_stream_alone_moves_no_mesh_and_large_differences_are_refused(api):
    section = section_of(api, airfoil="naca:2412", strategy="chain", **FLOWS["euler"])
    section.compute(section.inputs, section.outputs)
    steps, points = section.mesh.steps, section.mesh.points
    section.compute(section.inputs | {"mach": np.array([0.41])}, section.outputs)
    assert section.mesh.steps == steps
    section.under_finite_difference = True
    far = designs_on_the_way(section.start)[1]
    with pytest.raises(api.AnalysisError, match=r"^design: a difference this large replaces triangles \(strategy 'chain'\), expected a smaller step$"):
        section.compute(section.inputs | {"design": far}, section.outputs)
    assert np.array_equal(section.mesh.points, points)
    section.under_finite_difference = False
    section.compute(section.inputs | {"design": far}, section.outputs)  # a design may


def test_complex_steps_are_refused(api, mesh):
    for component in (section_of(api, **FLOWS["euler"]), flow_of(api, mesh=mesh), api.components.MeshComponent(mesh=mesh)):
        component.setup()
        component.under_complex_step = True
        with pytest.raises(remodel.ArgumentError, match="^step: found a complex one, expected differences of real numbers"):
            component.compute(component.inputs, component.outputs)


def test_a_section_goes_far_and_says_what_has_no_flow(api):
    section = section_of(api, airfoil="naca:0012", mach=0.4, alpha=1.0, mesh={"points": 40})
    far = remodel.Airfoil("rae2822", degree=section.start.degree)
    for part in (0.5, 1.0):  # no morph of the first mesh may be good enough: triangles are replaced
        design = (1 - part) * section.start.design + part * far.design
        section.compute(section.inputs | {"design": design}, section.outputs)
    fresh = remodel.generate(section.start.with_design(far.design), points=40)
    assert abs(section.outputs["cl"] - remodel.solve_flow(fresh, mach=0.4, alpha=1.0).cl) < 0.03
    with pytest.raises(api.AnalysisError, match="its surfaces cross; bound the design"):
        section.compute(section.inputs | {"design": -section.start.design}, section.outputs)
    section.compute(section.inputs, section.outputs)  # and goes on


def test_sections_refuse_what_does_not_fit(api):
    for options, message in (({"reynolds": 1e6}, "reynolds: found 1000000.0 with the model 'euler'"),
                             ({"model": "sa"}, "reynolds: found None with the model 'sa'"),
                             ({"strategy": "pool"}, "strategy: found 'pool', expected one of chain, renew, morph, reference"),
                             ({"thickness_at": (0.5, 1.0)}, "thickness_at: found")):  # fmt: skip
        with pytest.raises(remodel.ArgumentError, match=message):
            section_of(api, mesh={"points": 40}, **options)
