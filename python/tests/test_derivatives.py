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


@pytest.mark.parametrize("strategy", ["reference", "renew"])
def test_the_derivative_of_a_step_that_holds_the_mesh(airfoil, designs, strategy):
    """interior='own' is the derivative of update(strategy='reference'), where that moves the interior too."""
    mesh = remodel.generate(airfoil, points=40)
    mesh.update(airfoil.with_design(airfoil.design * 1.03), strategy=strategy)
    base, direction, h = mesh.domain.airfoil().design, designs(1)[0].design - airfoil.design, 1e-3
    ends = []
    for sign in (1.0, -1.0):
        ends.append(mesh.copy())
        step = ends[-1].update(airfoil.with_design(base + sign * h * direction), strategy="reference", record=True)
        assert step.changes.same_connectivity
    difference = (ends[0].points - ends[1].points) / (2 * h)
    assert not mesh.held or strategy == "reference"
    how = "own" if strategy == "reference" else "along"
    moved = mesh.jvp(direction, interior=how)
    assert np.allclose(moved, difference, atol=1e-9) and not np.allclose(mesh.jvp(direction, interior="still"), difference, atol=1e-4)
    weights = np.random.default_rng(2).standard_normal(mesh.points.shape)
    assert np.isclose(np.sum(weights * moved), mesh.vjp(weights, interior=how) @ direction, rtol=1e-11)
    with pytest.raises(remodel.ArgumentError, match="^interior: found 'x'"):
        mesh.jvp(direction, interior="x")


@pytest.mark.parametrize("strategy", ["chain", "renew", "morph", "reference"])
@pytest.mark.parametrize("layers", [False, True])
def test_the_own_way_of_a_mesh_is_that_of_the_next_small_step(airfoil, designs, strategy, layers):
    """By every strategy, wherever the mesh has come to: also where the last step replaced triangles."""
    mesh = remodel.generate_layered(airfoil, reynolds=1000.0, model="laminar", spacing=6.0, growth=1.5) if layers else remodel.generate(airfoil, points=40)
    direction, h = designs(1)[0].design - airfoil.design, 1e-4
    for section in (airfoil.with_design(1.03 * airfoil.design), remodel.Airfoil("rae2822")):
        mesh.update(section, strategy=strategy)
        ends = []
        for sign in (1.0, -1.0):
            with mesh.trial(airfoil.with_design(section.design + sign * h * direction), strategy=strategy) as trial:
                assert trial.step.changes.same_connectivity and (strategy != "reference" or trial.step.held)
                ends.append(np.array(mesh.points))
        moved, difference = mesh.jvp(direction), (ends[0] - ends[1]) / (2 * h)
        assert np.allclose(moved, difference, atol=1e-6)
        if not layers:  # points of columns move along by every strategy
            assert np.any(moved[np.asarray(mesh.curve) < 0]) == (strategy == "reference")
        weights = np.random.default_rng(2).standard_normal(moved.shape)
        assert np.isclose(np.sum(weights * moved), mesh.vjp(weights) @ direction, rtol=1e-6)


@pytest.mark.parametrize("layers", [False, True])
def test_a_held_mesh_is_at_another_design_where_the_reference_has_it(layers):
    """A change of rounding moves nothing but by rounding, and differences by at() are vjp()'s."""
    random = np.random.default_rng(0)
    first = remodel.Airfoil("naca:2412", degree=4)
    second = first.with_design(first.design + (0.002 if layers else 0.01) * random.standard_normal(10))
    direction, h = random.standard_normal(10), 1e-5
    mesh = remodel.generate_layered(first, reynolds=1000.0, model="laminar", spacing=6.0, growth=1.5) if layers else remodel.generate(first, points=80)
    points = (lambda m: np.array(m.freeze().points)) if layers else (lambda m: np.array(m.points))
    assert mesh.update(second, strategy="reference").held
    assert abs(points(mesh.at(second.with_design(second.design + 1e-12))) - points(mesh)).max() < 1e-10
    stepped, at = mesh.copy(), mesh.at(second.with_design(second.design * 1.001))
    stepped.update(second.with_design(second.design * 1.001), strategy="reference")
    assert np.array_equal(points(at), points(stepped))
    ahead, behind = (points(mesh.at(second.with_design(second.design + s * direction))) for s in (h, -h))
    weights = random.standard_normal(ahead.shape)
    assert np.isclose(np.sum(weights * (ahead - behind)) / (2 * h), mesh.vjp(weights) @ direction, rtol=1e-5)
    assert np.allclose(at.jvp(direction), stepped.jvp(direction), atol=1e-9)  # it goes on in the same way


def test_gradients_of_another_mesh_are_refused(mesh, airfoil):
    solver = remodel.LivingFlow()
    solver.solve(mesh, mach=0.4, alpha=1.0)
    gradient = solver.gradients()["cd"]["points"]
    expected = mesh.vjp(np.array(gradient))
    for same_mesh in (mesh, mesh.copy(), mesh.freeze() and mesh):
        assert np.array_equal(same_mesh.vjp(gradient), expected)
    assert np.allclose(mesh.vjp(2.0 * gradient - gradient / 2), 1.5 * expected)
    other = mesh.at(airfoil.with_design(airfoil.design * 1.001))
    moved, kept = mesh.copy(), mesh.copy()
    moved.update(airfoil.with_design(airfoil.design * 1.001))
    kept.update(remodel.Airfoil("naca:2412"))
    for wrong in (other, moved):
        for stale in (gradient, -gradient, 3 * gradient + 1, gradient.copy()):
            with pytest.raises(remodel.ArgumentError, match="^by_points: is of a flow on this mesh at another design"):
                wrong.vjp(stale)
    with pytest.raises(remodel.ArgumentError, match="^by_points"):
        kept.vjp(gradient)
    with mesh.trial(airfoil.with_design(airfoil.design * 1.01)):
        with pytest.raises(remodel.ArgumentError, match="^by_points"):
            mesh.vjp(gradient)
    assert np.array_equal(mesh.vjp(gradient), expected)
    solver.solve(other, mach=0.4, alpha=1.0)
    with pytest.raises(remodel.ArgumentError, match="two meshes"):
        gradient + solver.gradients()["cd"]["points"]
    assert other.vjp(np.asarray(gradient)) is not None  # an array that knows nothing is the caller's own affair


def test_a_flow_that_was_not_found_has_no_gradients(mesh):
    """Not those of the flow before, which is what the solver goes on from."""
    solver = remodel.LivingFlow()
    first = solver.solve(mesh, mach=0.5, alpha=1.0)
    expected = solver.gradients()["cl"]["mach"]
    assert not solver.solve(mesh, mach=0.5, cl=6.0).converged
    with pytest.raises(remodel.ArgumentError, match=r"^gradients: the last flow was not found \(.*\), expected one$"):
        solver.gradients()
    assert np.isclose(solver.solve(mesh, mach=0.5, alpha=1.0).cl, first.cl, rtol=1e-7)
    assert np.isclose(solver.gradients()["cl"]["mach"], expected, rtol=1e-5)
    solver.forget()
    with pytest.raises(remodel.ArgumentError, match="^gradients: no flow was found yet"):
        solver.gradients()


def test_conditions_that_are_refused_leave_the_gradients_of_the_last_flow(mesh, airfoil):
    solver = remodel.LivingFlow()
    solver.solve(mesh, mach=0.4, alpha=1.0)
    first = solver.gradients()["cl"]["points"]
    other = mesh.at(airfoil.with_design(airfoil.design * 1.001))
    with pytest.raises(remodel.ArgumentError):
        solver.solve(other, mach=-1.0)
    again = solver.gradients()["cl"]["points"]
    assert np.allclose(again, first, atol=1e-8) and mesh.vjp(again) is not None


def test_a_living_flow_takes_what_the_package_gives(mesh, airfoil, designs):
    solver, expected = remodel.LivingFlow(), remodel.solve_flow(mesh, mach=0.4, alpha=1.0).cl
    foreign = remodel.FrozenMesh(mesh.points, mesh.triangles, mesh.boundaries)
    for given in (mesh, mesh.freeze(), foreign, mesh.freeze().with_points(mesh.points), remodel.import_mesh(foreign)):
        assert abs(solver.solve(given, mach=0.4, alpha=1.0).cl - expected) < 1e-8
    step = mesh.update(designs(1)[0], record=True)
    flow = solver.solve(step, mach=0.4, alpha=1.0)
    assert abs(flow.cl - remodel.solve_flow(mesh, mach=0.4, alpha=1.0).cl) < 1e-8 and np.array_equal(flow.mesh.points, mesh.points)
    seen = []

    def objective(design, frozen, step):
        seen.append(solver.solve(frozen, mach=0.4, alpha=1.0))
        return seen[-1].cd

    remodel.optimise(airfoil, objective, points=40, evaluations=5, sigma=0.01)
    assert len(seen) >= 4 and all(flow.converged for flow in seen) and seen[-1].start != "cold"


def test_the_interior_goes_along_with_the_walls(mesh):
    field, wall = remodel.InteriorDisplacement(mesh), np.unique(mesh.boundaries["airfoil"])
    walls = np.zeros_like(mesh.points)
    walls[wall] = [0.0, 0.1]
    moved = field.jvp(walls)
    assert np.array_equal(moved[wall], walls[wall]) and np.all(moved[np.unique(mesh.boundaries["farfield"])] == 0)
    assert mesh.freeze().with_points(mesh.points + moved).check(delaunay=False).valid
    weights = np.random.default_rng(2).standard_normal(mesh.points.shape)
    assert np.isclose(np.sum(weights * moved), np.sum(field.vjp(weights) * walls), rtol=1e-12)
    outside = np.zeros_like(walls)
    outside[mesh.boundaries["farfield"][0, 0]] = 1.0
    with pytest.raises(remodel.ArgumentError, match="^walls: moves point"):
        field.jvp(outside)
    assert np.any(remodel.InteriorDisplacement(mesh, ["farfield"]).jvp(outside) != 0)
    with pytest.raises(remodel.ArgumentError, match="^moving: found 'nobody'"):
        remodel.InteriorDisplacement(mesh, ["nobody"])
    assert len(field) == len(mesh.points)


@pytest.mark.parametrize("interior", ["still", "along"])
def test_derivatives_by_all_that_a_domain_has(airfoil, interior):
    """Placements, polygons and airfoils alike, against the same mesh at other numbers."""
    elements = [{"name": "main", "airfoil": airfoil}, {"name": "flap", "airfoil": airfoil, "chord": 0.3, "rotation": -20, "position": (1.05, -0.05)}]
    square = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
    for domain in (remodel.Domain.airfoils(elements, points=60), remodel.Domain.polygons({"outside": square}, {"hole": square / 4 + 1.5})):
        mesh = remodel.generate(domain, gradation=1.5)
        numbers, random, h = domain.coefficients, np.random.default_rng(5), 1e-6
        assert domain.with_coefficients(numbers) == domain
        direction = random.standard_normal(len(numbers)) * (numbers != 0)  # edges stay closed
        moved = mesh.jvp(direction, of="domain", interior=interior)
        wall = np.unique(np.concatenate(list(mesh.boundaries.values())))
        ends = [mesh.at(domain.with_coefficients(numbers + s * h * direction)).points for s in (1.0, -1.0)]
        assert np.allclose(moved[wall], (ends[0] - ends[1])[wall] / (2 * h), atol=1e-7) and np.any(moved[wall] != 0)
        weights = random.standard_normal(mesh.points.shape)
        assert np.isclose(np.sum(weights * moved), mesh.vjp(weights, of="domain", interior=interior) @ direction, rtol=1e-10)
    with pytest.raises(remodel.ArgumentError, match="^of: "):
        mesh.jvp(direction, of="curve")
    with pytest.raises(remodel.ArgumentError):
        domain.with_coefficients(numbers[:-1])
