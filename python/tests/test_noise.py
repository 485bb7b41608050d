"""Noise along a line of designs."""

import numpy as np
import pytest
import remodel

LINE = dict(points=20, count=7, spacing=1e-3)


def edges(design, mesh, step):
    """The length of all edges: it depends on the mesh alone."""
    corners = mesh.points[mesh.triangles]
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).sum()


def cube(design, mesh, step):
    return (1 + design.sum()) ** 3


def test_values_that_depend_on_the_design_alone_have_no_noise_and_the_functions_slope(airfoil):
    direction = np.zeros(airfoil.design.size)
    direction[0] = 2.0
    found = remodel.noise(airfoil, cube, direction=direction, **LINE)
    assert found.names == ["objective"] and found.stopped == "done" and len(found.places) == 7
    middle = found.hub.values["objective"][3]
    assert middle == pytest.approx((1 + airfoil.design.sum()) ** 3, rel=1e-14)
    for way in (found.fresh, found.living, found.hub, found.reference):
        assert way.rms["objective"] < 1e-12 * abs(middle) + 1e-15
        assert way.slope["objective"] == pytest.approx(3 * middle ** (2 / 3), rel=1e-8)
        assert way.failures == [] and way.adjoint == {}


def test_meshes_of_one_connectivity_are_smoother_than_fresh_ones(airfoil):
    found = remodel.noise(airfoil, edges, **LINE)
    for way in (found.hub, found.reference):
        assert way.rms["objective"] < 1e-2 * found.fresh.rms["objective"]


def test_the_slope_of_a_flow_is_that_of_the_adjoint():
    found = remodel.noise("naca:0012", mach=0.4, alpha=1.0, points=20, count=5, spacing=1e-5, degree=2)
    assert found.names == ["cl", "cd"]
    for name in found.names:
        assert found.reference.slope[name] == pytest.approx(found.reference.adjoint[name], rel=1e-4, abs=1e-7)


def test_a_design_that_fails_is_left_out_and_what_a_function_raises_is_raised(airfoil):
    def fails(design, mesh, step):
        if abs(design.sum() - airfoil.design.sum()) < 1e-9:
            raise remodel.EvaluationFailed("no licence")
        return cube(design, mesh, step)

    found = remodel.noise(airfoil, fails, **LINE)
    assert np.isnan(found.fresh.values["objective"]).tolist() == [i == 3 for i in range(7)]
    assert "no licence" in found.fresh.failures[0] and found.fresh.rms["objective"] < 1e-12
    nothing = remodel.noise(airfoil, lambda design, mesh, step: float("nan"), **LINE)
    assert np.isnan(nothing.hub.rms["objective"]) and len(nothing.hub.failures) == 7

    def stops(design, mesh, step):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        remodel.noise(airfoil, stops, **LINE)


def test_what_is_no_line_is_refused(airfoil):
    for wrong, name in (
        (dict(), "mach"),
        (dict(objective=cube, mach=0.4), "mach"),
        (dict(objective=3), "objective"),
        (dict(objective=cube, direction=[1.0, 0.0]), "direction"),
        (dict(objective=cube, direction=np.zeros(airfoil.design.size)), "direction"),
        (dict(objective=cube, spacing=0.0), "spacing"),
        (dict(objective=cube, spacing=1.0), "spacing"),
        (dict(objective=cube, count=4), "count"),
        (dict(objective=cube, degree=0), "degree"),
        (dict(mach=9.0, points=20), "mach"),
    ):
        with pytest.raises(remodel.ArgumentError, match=name):
            remodel.noise(airfoil, **wrong)
