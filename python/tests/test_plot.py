import numpy as np
import pytest
import remodel

plt = pytest.importorskip("matplotlib.pyplot")


@pytest.fixture(autouse=True)
def closed_figures():
    yield
    plt.close("all")


def colors_of(ax):
    """The colours of a figure's pixels, as rows of a set."""
    ax.figure.canvas.draw()
    return np.unique(np.asarray(ax.figure.canvas.buffer_rgba())[..., :3].reshape(-1, 3), axis=0)


def test_a_mesh_is_drawn_where_its_bodies_are(mesh):
    ax = mesh.plot()
    assert ax.get_xlim()[0] > -1 and ax.get_xlim()[1] < 2
    lines = sum(len(collection.get_segments()) for collection in ax.collections)
    assert lines > len(mesh.boundaries["airfoil"])
    assert len(colors_of(ax)) > 10
    whole = mesh.plot(window=(-26, -26, 27, 26))
    assert sum(len(c.get_segments()) for c in whole.collections) > lines


def test_values_colour_points_and_triangles(mesh):
    _, ax = plt.subplots()
    assert mesh.plot(color=mesh.points[:, 1], ax=ax, label="y") is ax
    assert len(colors_of(mesh.plot(color=mesh.birth.astype(float) + np.arange(len(mesh))))) > 50
    mesh.plot(color="age"), mesh.plot(color="length_scale")
    for wrong in ([1.0], "no such colouring", np.zeros((len(mesh), 2))):
        with pytest.raises(remodel.ArgumentError):
            mesh.plot(color=wrong)


def test_a_step_shows_what_it_kept(mesh):
    step = mesh.update("naca:2412")
    ax = step.plot()
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels == [f"{name}: {count}" for name, count in zip(("kept", "moved", "new"), np.bincount(step.fates, minlength=3))]
    mesh.update("naca:0012")
    with pytest.raises(remodel.ArgumentError):
        step.plot()


def test_histories_and_pressures(mesh, airfoil):
    result = remodel.optimise(airfoil, remodel.Airfoil("rae2822"), points=40, evaluations=30)
    assert len(result.plot_history().lines[0].get_xdata()) == 30
    flow = remodel.PotentialSolver(mesh).at(3.0)
    ax = flow.plot_cp()
    assert ax.yaxis_inverted() and len(ax.lines[0].get_xdata()) == len(flow.bodies["airfoil"]["cp"])
    euler = remodel.solve_flow(mesh, mach=0.3, alpha=3.0)
    x, cp = euler.plot_cp().lines[0].get_data()
    assert len(x) == len(np.unique(mesh.boundaries["airfoil"])) and cp.min() < -0.5


def test_notebooks_show_a_picture(mesh):
    text = mesh._repr_svg_()
    assert text.startswith("<?xml") and "<svg" in text and len(text) < 3_000_000
    assert mesh.freeze()._repr_svg_() == text
