"""Layers on walls, and flows with friction."""

import json
import pickle

import numpy as np
import pytest

import remodel

COARSE = dict(spacing=4.0, growth=1.5, farfield_points=30)


def laminar_mesh(shape="naca:0012"):
    return remodel.generate_layered(shape, reynolds=5000.0, model="laminar", **COARSE)


def changed(airfoil, by):
    design = np.array(airfoil.design)
    design[1] += by
    return airfoil.with_design(design)


def test_a_layer_is_of_convex_quadrilaterals_on_the_wall():
    mesh = laminar_mesh()
    frozen = mesh.freeze()
    assert mesh.check().valid
    assert len(frozen.quads) > 0 and mesh.layer_cells >= len(frozen.quads)
    assert mesh.cells == len(frozen.quads) + len(frozen.triangles)
    corners = frozen.points[frozen.quads]
    for i in range(4):
        a, b, c = corners[:, i], corners[:, (i + 1) % 4], corners[:, (i + 2) % 4]
        assert np.all(np.cross(b - a, c - b) > 0.0)
    turbulent = remodel.generate_layered("naca:0012", reynolds=6e6, **COARSE)
    assert turbulent.first_height < 0.1 * mesh.first_height


def test_an_update_keeps_the_layers_connectivity():
    airfoil = remodel.Airfoil("naca:0012")
    mesh = remodel.generate_layered(airfoil, reynolds=5000.0, model="laminar", **COARSE)
    before = mesh.freeze()
    copy = mesh.copy()
    for strategy in ("renew", "morph", "reference"):
        step = mesh.update(changed(airfoil, 0.005), strategy=strategy)
        assert step.same_columns and step.connectivity_percent > 99.0
        assert mesh.check().valid
        assert np.array_equal(mesh.freeze().quads, before.quads)
    assert np.array_equal(copy.freeze().points, before.points)
    assert not np.array_equal(mesh.freeze().points, before.points)


def test_a_trial_leaves_the_mesh_as_it_was():
    airfoil = remodel.Airfoil("naca:0012")
    mesh = remodel.generate_layered(airfoil, reynolds=5000.0, model="laminar", **COARSE)
    before, state = mesh.points, pickle.dumps(mesh)
    with mesh.trial(changed(airfoil, 0.01)) as trial:
        assert trial.step.same_columns and not np.array_equal(mesh.points, before)
    assert np.array_equal(mesh.points, before) and pickle.dumps(mesh) == state
    with pytest.raises(remodel.ArgumentError, match="is over"):
        trial.keep()
    with pytest.raises(remodel.GeometryError), mesh.trial(airfoil.with_design(-np.array(airfoil.design))):
        pass
    assert pickle.dumps(mesh) == state
    with mesh.trial(changed(airfoil, 0.01)) as trial:
        trial.keep()
    assert not np.array_equal(mesh.points, before)
    with pytest.raises(remodel.ArgumentError, match="entered before"), trial:
        pass


def test_a_step_says_what_it_changed():
    airfoil = remodel.Airfoil("naca:0012")
    mesh = remodel.generate_layered(airfoil, reynolds=5000.0, model="laminar", **COARSE)
    step = mesh.update(changed(airfoil, 0.02), strategy="morph", record=True)
    assert (step.cells, step.cells_before) == (len(mesh), step.before.quads.shape[0] + step.before.triangles.shape[0])
    then, now = dict(zip(step.before.vertex_keys, map(tuple, step.before.points))), dict(zip(mesh.vertex_keys, map(tuple, mesh.points)))
    changes = step.changes
    assert set(changes.inserted) == now.keys() - then.keys() and set(changes.removed) == then.keys() - now.keys()
    assert set(changes.moved) == {key for key in now.keys() & then.keys() if now[key] != then[key]}
    assert changes.layer_born == changes.layer_gone == 0 or not changes.same_connectivity
    fates = step.fates
    assert len(fates) == len(mesh) and (fates == 0).sum() == step.preserved
    assert (fates < 2).sum() == step.connected
    x = step.transfer.ride(step.before.points[:, 0].copy())
    assert x.shape == (len(mesh.points),)
    assert step.after.check(delaunay=False).valid and remodel.check(step, delaunay=False).valid
    again = pickle.loads(pickle.dumps(step))
    assert np.array_equal(again.changes.moved, changes.moved) and np.array_equal(again.after.quads, mesh.quads)
    assert step.plot(ax=pytest.importorskip("matplotlib.pyplot").subplots()[1]) is not None
    bare = mesh.update(airfoil)
    with pytest.raises(remodel.ArgumentError, match="record=True"):
        bare.fates
    assert "LayeredStep(" in repr(bare) and "LayeredMesh(" in repr(mesh)
    assert mesh.steps == 2 and mesh.min_angle >= 30.0 - 1e-9 and mesh.gradation == 8.0
    for name in ("length_scale", "curve", "parameter"):
        assert getattr(mesh, name).shape == (len(mesh.points),)


def test_a_mesh_at_another_design_is_joined_as_it_is():
    airfoil = remodel.Airfoil("naca:0012")
    mesh = remodel.generate_layered(airfoil, reynolds=5000.0, model="laminar", **COARSE)
    mesh.update(airfoil, strategy="reference")
    near = mesh.at(changed(airfoil, 1e-3))
    assert np.array_equal(near.quads, mesh.quads) and np.array_equal(near.triangles, mesh.triangles)
    assert near.check().valid and not np.array_equal(near.points, mesh.points)
    with pytest.raises(remodel.TopologyChanged):
        mesh.at(remodel.Domain(airfoil, points=100))


def test_a_run_has_layers(tmp_path):
    layers = dict(reynolds=5000.0, model="laminar", growth=1.5, spacing=4.0, wake=0.5, wake_angle=2)
    seen = []

    def objective(design, mesh, step):
        seen.append((len(mesh.quads), mesh.check(delaunay=False).valid))
        return float(np.sum(design**2))

    result = remodel.optimise("naca:0012", objective, layers=layers, evaluations=12, strategy="morph", directory=tmp_path / "run")
    assert result.failed_evaluations == 0 and len(seen) == 12 and all(quads > 0 and valid for quads, valid in seen)
    last = remodel.LayeredMesh.load(tmp_path / "run" / "last.vtkhdf")
    assert last.check().valid and len(last.quads) == seen[-1][0] and len(last.boundaries["wake"]) > 10
    target = remodel.optimise("naca:0012", remodel.Airfoil("rae2822"), layers=layers, evaluations=12)
    assert target.invalid_meshes == 0
    for wrong, match in ((dict(reynolds="a"), "reynolds"), (dict(re=1.0), "'re'"), ({}, "reynolds"), (dict(layers, spacing=-1.0), "spacing")):
        with pytest.raises(remodel.ArgumentError, match=match):
            remodel.optimise("naca:0012", objective, layers=wrong, evaluations=2)


def test_directions_of_a_design_are_differences_of_meshes():
    airfoil = remodel.Airfoil("naca:0012")
    mesh = remodel.generate_layered(airfoil, reynolds=5000.0, model="laminar", **COARSE)
    direction = np.zeros(len(airfoil.design))
    direction[1] = 1.0
    moved = mesh.jvp(direction)
    weights = np.random.default_rng(1).normal(size=moved.shape)
    assert np.isclose((weights * moved).sum(), mesh.vjp(weights) @ direction, rtol=1e-9)
    layer, ends = np.unique(mesh.quads), []
    for step in (1e-4, -1e-4):
        with mesh.trial(changed(airfoil, step)):
            ends.append(mesh.points[layer])
    assert np.abs(moved[layer]).max() > 0.1
    assert np.abs((ends[0] - ends[1]) / 2e-4 - moved[layer]).max() < 1e-5
    with pytest.raises(remodel.ArgumentError, match="direction: found 2 numbers"):
        mesh.jvp([1.0, 2.0])


def duct(height):
    def line(name, start, end, stations):
        return {"name": name, "shape": {"kind": "line", "from": start, "to": end}, "stations": stations}

    bulge = {"kind": "spline", "points": [[0, 0], [0.8, 0.01], [1.5, height], [2.2, 0.01], [3, 0]]}
    curves = [{"name": "floor", "shape": bulge, "stations": 60}, line("outlet", [3, 0], [3, 1], 5),
              line("roof", [3, 1], [0, 1], 40), line("inlet", [0, 1], [0, 0], 5)]
    return remodel.Domain.from_json(json.dumps({"loops": [{"role": "outer", "curves": curves}]}))


def test_walls_of_a_duct_end_at_its_openings():
    mesh = remodel.generate_layered(duct(0.1), reynolds=1000.0, model="laminar")
    assert mesh.check().valid and mesh.columns == 61 + 41
    again = pickle.loads(pickle.dumps(mesh))
    assert np.array_equal(again.points, mesh.points)
    step = mesh.update(duct(0.101))
    assert step.same_columns and mesh.check().valid
    assert remodel.generate_layered(duct(0.1), reynolds=1000.0, model="laminar", walls=["roof"]).columns == 41
    options = dict(inlets={"inlet": (1.0, 1.0)}, outlets={"outlet": 0.98})
    flow = remodel.solve_flow(mesh, model="laminar", mach=0.1, reynolds=100.0, **options)
    assert flow.converged and np.all(flow.velocity_x[mesh.points[:, 1] == 1.0] == 0)


def test_it_is_drawn_and_handed_on_as_any_mesh(tmp_path):
    mesh = laminar_mesh()
    assert len(mesh.quads) + len(mesh.triangles) == mesh.cells and "airfoil" in mesh.boundaries
    mesh.draw(tmp_path / "mesh.png", width=300)
    assert (tmp_path / "mesh.png").stat().st_size > 1000
    assert mesh._repr_svg_().startswith("<?xml") or "<svg" in mesh._repr_svg_()
    axes = pytest.importorskip("matplotlib.pyplot").subplots()[1]
    assert mesh.plot(ax=axes) is axes
    assert "airfoil" in mesh.domain.to_json()


def test_files_keep_a_layered_mesh_to_the_bit(tmp_path):
    mesh = laminar_mesh()
    mesh.save(tmp_path / "layered.vtkhdf")
    loaded = remodel.LayeredMesh.load(tmp_path / "layered.vtkhdf")
    assert np.array_equal(loaded.freeze().points, mesh.freeze().points)
    for each in (mesh, loaded):
        each.update("naca:1412")
    assert np.array_equal(loaded.freeze().points, mesh.freeze().points)
    assert np.array_equal(pickle.loads(pickle.dumps(mesh.freeze())).quads, mesh.freeze().quads)


def test_a_flow_with_friction_outlives_its_mesh():
    airfoil = remodel.Airfoil("naca:0012")
    mesh = remodel.generate_layered(airfoil, reynolds=5000.0, model="laminar", **COARSE)
    living = remodel.LivingFlow(model="laminar", tolerance=1e-9)
    conditions = dict(mach=0.5, alpha=1.0, reynolds=5000.0)
    first = living.solve(mesh, **conditions)
    assert first.converged and first.model == "laminar" and first.reynolds == pytest.approx(5000.0)
    assert first.cd == pytest.approx(first.cd_pressure + first.cd_friction)
    assert first.cf.shape == first.density.shape and first.cf.max() > 0.0 and first.y_plus_max > 0.0
    assert first.viscosity_ratio is None
    mesh.update(changed(airfoil, 0.005))
    second = living.solve(mesh, **conditions)
    cold = remodel.solve_flow(mesh, model="laminar", tolerance=1e-9, **conditions)
    assert second.start != "cold" and cold.start == "cold"
    assert second.cl == pytest.approx(cold.cl, abs=1e-6) and second.cd == pytest.approx(cold.cd, abs=1e-7)
    layer = second.boundary_layer()
    assert set(layer["wall"]) == {"airfoil"} and np.array_equal(layer["cf"], second.cf[layer["vertex"]])
    middle = np.abs(second.mesh.points[layer["vertex"], 0] - 0.3) < 0.1
    assert (layer["displacement_thickness"][middle] > 2 * layer["momentum_thickness"][middle]).all()
    profiles = second.profiles([0.5])
    assert len(profiles) == 2 and {p["wall"] for p in profiles} == {"airfoil"}
    assert all(abs(p["speed"][0]) < 1e-15 and p["speed"].max() > 1.0 and (np.diff(p["height"]) > 0.0).all() for p in profiles)
    with pytest.raises(remodel.ArgumentError, match="places"):
        second.profiles([2.0])
    with pytest.raises(remodel.ArgumentError, match="friction"):
        remodel.solve_flow(remodel.generate("naca:0012", points=60), mach=0.5).boundary_layer()
    gradients = living.gradients()
    assert gradients["cd"]["points"].shape == mesh.freeze().points.shape
    # By the airfoil's coefficients, through the columns: against flows of designs beside this one.
    by_design = mesh.vjp(gradients["cd"]["points"])
    assert by_design.shape == airfoil.design.shape
    drags = []
    for step in (-2e-5, 2e-5):
        beside = mesh.copy()
        assert beside.update(changed(airfoil, 0.005 + step)).full_adjustment
        drags.append(living.solve(beside, **conditions).cd)
    assert by_design[1] == pytest.approx((drags[1] - drags[0]) / 4e-5, rel=1e-3)
    # Friction falls as the Reynolds number grows.
    assert gradients["cd"]["reynolds"] < 0.0
    again = pickle.loads(pickle.dumps(second))
    assert again.cd_friction == second.cd_friction and np.array_equal(again.cf, second.cf)
    assert pickle.loads(pickle.dumps(living)).solve(mesh, **conditions).converged


def test_heat_passes_walls_with_a_temperature():
    mesh = remodel.generate_layered("naca:0012", reynolds=5000.0, model="laminar", **COARSE)
    conditions = dict(mach=0.5, reynolds=5000.0)
    living = remodel.LivingFlow(model="laminar")
    without = living.solve(mesh, **conditions)
    assert without.wall_temperature is None and without.heat is None and without.ch is None
    assert np.isnan(without.boundary_layer()["ch"]).all()
    flow = living.solve(mesh, wall_temperature=1.2, **conditions)
    assert flow.converged and flow.wall_temperature == 1.2 and flow.heat < 0.0
    layer = flow.boundary_layer()
    assert np.array_equal(layer["ch"], flow.ch[layer["vertex"]])
    warmth = 1.4 * flow.pressure / flow.density
    assert warmth[layer["vertex"]] == pytest.approx(1.2)
    assert pickle.loads(pickle.dumps(flow)).heat == flow.heat
    for bad in (0.0, -1.0, float("nan")):
        with pytest.raises(remodel.ArgumentError):
            living.solve(mesh, wall_temperature=bad, **conditions)
    with pytest.raises(remodel.ArgumentError, match="wall_temperature"):
        remodel.solve_flow(remodel.generate("naca:0012", points=60), mach=0.5, wall_temperature=1.2)


def test_a_pickled_mesh_goes_on_as_a_copy_does(tmp_path):
    airfoil = remodel.Airfoil("naca:0012", degree=3)
    mesh = remodel.generate_layered(airfoil, reynolds=5000.0, model="laminar", **COARSE)
    step = mesh.update(changed(airfoil, 0.004))
    assert pickle.loads(pickle.dumps(step)).preserved_percent == step.preserved_percent
    pickled, copied = pickle.loads(pickle.dumps(mesh)), mesh.copy()
    for each, name in ((pickled, "a.vtkhdf"), (copied, "b.vtkhdf")):
        each.update(changed(airfoil, 0.008))
        each.save(tmp_path / name)
    assert (tmp_path / "a.vtkhdf").read_bytes() == (tmp_path / "b.vtkhdf").read_bytes()
    make, arguments, state = mesh.__reduce_ex__(2)[:3]
    del state["walls"]
    with pytest.raises(remodel.FormatError, match="'walls' is missing"):
        make(*arguments).__setstate__(state)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: remodel.generate_layered("naca:0012"), "reynolds: not given"),
        (lambda: remodel.generate_layered("naca:0012", reynolds=6e6, model="euler"), "model: found 'euler'"),
        (lambda: remodel.generate_layered("naca:0012", reynolds=6e6, growth=9.0), "growth"),
        (lambda: remodel.generate_layered("naca:0012", reynolds=6e6, spacing=0.0), "spacing"),
        (lambda: remodel.generate_layered("naca:0012", reynolds=6e6, wake=0.0), "wake: found 0"),
        (lambda: remodel.generate_layered("naca:0012", reynolds=6e6, wake=1.0, wake_angle=95), "wake_angle: found 95"),
        (lambda: remodel.generate_layered("naca:0012", reynolds=6e6, wake_angle=5), "wake_angle: given without wake"),
        (lambda: remodel.optimise("naca:0012", remodel.Airfoil("rae2822"), layers={"reynolds": 1e6, "growth": None}), "None for growth"),
        (lambda: remodel.generate_layered("naca:0012", reynolds=6e6, walls=["none"]), "none"),
        (lambda: remodel.generate_layered("naca:0012", reynolds=float("nan")), "reynolds: found nan"),
        (lambda: remodel.LivingFlow(model="les"), "model: found 'les'"),
        (lambda: remodel.solve_flow(laminar_mesh(), model="laminar", mach=0.5), "reynolds: found 0"),
    ],
)
def test_misuse_is_answered_by_one_of_our_exceptions(call, message):
    with pytest.raises(remodel.Error, match=message):
        call()


def test_a_layer_is_by_the_reference_length(tmp_path):
    section = remodel.Airfoil("rae2822")
    (tmp_path / "big.dat").write_text("big\n" + "\n".join(f"{10 + 250 * x:.6f} {5 + 250 * y:.6f}" for x, y in section.coordinates(121)))
    with pytest.warns(UserWarning, match="longest chord"):
        domain = remodel.Domain(tmp_path / "big.dat", points=150, keep_coordinates=True)
    small = remodel.generate_layered(section, reynolds=2000, model="laminar", growth=1.3)
    big = remodel.generate_layered(domain, reynolds=2000, model="laminar", growth=1.3, reference_length=250)
    assert abs(big.first_height / small.first_height - 250) < 1e-6
    assert abs(big.thickness / small.thickness - 250) < 5
    with pytest.raises(remodel.ArgumentError, match="reference_length"):
        remodel.generate_layered(section, reynolds=2000, reference_length=0)


def test_cells_that_lie_on_each_other_are_refused():
    mesh = remodel.generate("naca:2412", points=60).freeze()
    doubled = remodel.FrozenMesh(mesh.points, np.r_[mesh.triangles, mesh.triangles[:1]], mesh.boundaries)
    with pytest.raises(remodel.ArgumentError, match="lie on each other"):
        remodel.solve_flow(doubled, mach=0.5)
