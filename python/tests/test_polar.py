"""Rows of flows over angles and lifts."""

import numpy as np
import pytest
import remodel


@pytest.fixture(scope="module")
def mesh():
    return remodel.generate("naca:2412", points=40, farfield_radius=10)


def test_a_row_has_the_flows_of_its_angles(mesh):
    row = remodel.polar(mesh, mach=0.4, alpha=[0, 2, 4])
    assert len(row) == 3 and row.converged.all() and row.asked.all() and row.mach == 0.4
    for i, alpha in enumerate(row.alpha):
        flow = remodel.solve_flow(mesh, mach=0.4, alpha=alpha)
        assert (row.cl[i], row.cd[i], row.cm[i]) == pytest.approx((flow.cl, flow.cd, flow.cm), abs=1e-8)
    assert row.cl_max == row.cl[2] and not row.cl_max_passed and row.alpha_of_cl_max == 4
    assert set(row.columns) >= {"alpha", "cl", "status"}
    assert np.array_equal(row.bodies["airfoil"]["cl"], row.cl)


def test_lifts_and_several_mach_numbers(mesh):
    rows = remodel.polar(mesh, mach=[0.3, 0.4], cl=np.array([0.2, 0.4]))
    assert [row.mach for row in rows] == [0.3, 0.4]
    for row in rows:
        assert row.cl == pytest.approx([0.2, 0.4], abs=1e-8) and row.alpha[0] < row.alpha[1]


def test_a_row_of_friction_has_its_figures():
    layered = remodel.generate_layered("naca:0012", reynolds=1e3, model="laminar", spacing=3.0, farfield_radius=10, farfield_points=20)
    row = remodel.polar(layered, mach=0.3, alpha=[0.0, 1.0], model="laminar", reynolds=1e3)
    assert row.converged.all() and (row.cd_friction > row.cd_pressure).all() and np.isfinite(row.y_plus_max).all()
    assert np.allclose(row.cd, row.cd_pressure + row.cd_friction)


def test_a_flow_that_is_not_found_says_why(mesh):
    row = remodel.polar(mesh, mach=0.4, alpha=[0, 2, 4], max_steps=1, halvings=0, misses=1)
    assert not row.converged.any() and np.isnan(row.cl).all()
    assert row.status[0] == "step_limit" or row.reason[0]
    assert row.status[2] == "not-looked-for" and np.isnan(row.cl_max)


def test_what_is_no_row_is_refused(mesh):
    for wrong, name in (
        (dict(), "alpha"),
        (dict(alpha=[0], cl=[0.1]), "alpha"),
        (dict(alpha=[2, 1]), "alpha"),
        (dict(alpha=["x"]), "alpha"),
        (dict(cl=[]), "cl"),
        (dict(alpha=[0], mach=9.0), "mach"),
        (dict(alpha=[0], misses=0), "misses"),
        (dict(alpha=[0], model="rans"), "model"),
        (dict(alpha=[0], reynolds=1e6), "reynolds"),
    ):
        with pytest.raises(remodel.ArgumentError, match=name):
            remodel.polar(mesh, **wrong)
