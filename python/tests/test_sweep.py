"""sweep(): many sections at many conditions, as arrays."""

import pickle

import numpy as np
import pytest

import remodel

MESH = {"points": 40, "farfield_radius": 10, "gradation": 1}
PROBLEM = {"sections": ["naca:0012", "naca:2412"], "degree": 5,
           "conditions": {"mach": 0.4, "alpha_deg": [0, 2]}, "mesh": MESH, "surface_stations": 11}  # fmt: skip


def test_flows_are_those_of_the_solver():
    result = remodel.sweep(PROBLEM)
    assert len(result) == result.found == 4 and result.converged.all() and result.directory is None
    np.testing.assert_array_equal(result.section, [0, 0, 1, 1])
    np.testing.assert_array_equal(result.alpha, [0, 2, 0, 2])
    mesh = remodel.generate("naca:0012", points=40, farfield_radius=10, gradation=1)
    flow = remodel.solve_flow(mesh, mach=0.4, alpha=2)
    assert abs(result.cl[1] - flow.cl) < 1e-6
    assert result.cp.shape == (4, 22) and result.x.shape == (11,)
    lift = np.trapz(result.cp[:, 11:] - result.cp[:, :11], result.x, axis=1)
    np.testing.assert_allclose(lift, result.cl, atol=0.03)
    assert set(result.columns) == set(result.COLUMNS)
    assert pickle.loads(pickle.dumps(result)).cl.tolist() == result.cl.tolist()


def test_sections_may_be_airfoils_and_their_outlines_come_with_the_rows():
    airfoil = remodel.Airfoil("rae2822")
    result = remodel.sweep(PROBLEM | {"sections": [airfoil, "naca:0012"]})
    assert result.names == ["airfoil 1", "naca:0012"]
    np.testing.assert_array_equal(result.airfoils[0].design, airfoil.design)
    outlines = result.outlines(51)
    assert outlines.shape == (4, 102)
    np.testing.assert_array_equal(outlines[0], outlines[1])
    thickness = outlines[:, :51] - outlines[:, 51:]
    assert abs(thickness[0].max() - airfoil.thickness) < 1e-3 and abs(thickness[2].max() - 0.12) < 1e-3
    assert (np.abs(thickness[:, [0, -1]]) < 1e-12).all()


def test_rows_without_a_flow_have_what_was_asked_for_and_nothing_else(tmp_path):
    lifts = remodel.sweep(PROBLEM | {"sections": ["naca:0012"], "conditions": {"mach": 0.5, "cl": [1, 3]}}, directory=tmp_path / "s")
    np.testing.assert_array_equal(lifts.asked, [1, 3])
    np.testing.assert_array_equal(lifts.converged, [True, False])
    of_a_flow = ("alpha", "cl", "cd", "cm", "cd_pressure", "cd_friction")
    assert all(np.isfinite(getattr(lifts, name)[0]) and np.isnan(getattr(lifts, name)[1]) for name in of_a_flow)
    assert np.isnan(lifts.y_plus_max).all()
    header, _, last = (tmp_path / "s" / "table.csv").read_text().splitlines()
    row = dict(zip(header.split(","), last.split(",")))
    assert row["asked"] == "3" and not any(row[name] for name in ("alpha_deg", "cl", "cd", "cm", "cd_pressure", "cd_friction", "y_plus_max"))
    crossing = remodel.Airfoil(upper=[-0.1, 0.1], lower=[0.1, -0.1])
    angles = remodel.sweep(PROBLEM | {"sections": [crossing, "naca:0012"], "conditions": {"mach": 0.5, "alpha_deg": [0, 2]}})
    np.testing.assert_array_equal(angles.alpha, [0, 2, 0, 2])  # which were given
    assert np.isnan(angles.cl[:2]).all() and np.isfinite(angles.cl[2:]).all() and angles.status[0] == "refused"


def test_a_directory_is_gone_on_with_and_extended(tmp_path):
    seen = []
    first = remodel.sweep(PROBLEM | {"chain": 1}, directory=tmp_path / "s", threads=1, callback=lambda figures: seen.append(figures) or True)
    assert first.stopped == "interrupted" and len(first) < 4 and seen[0]["flows"] == 4
    more = PROBLEM | {"chain": 1, "conditions": {"mach": 0.4, "alpha_deg": [0, 1, 2]}}
    whole = remodel.sweep(more, directory=tmp_path / "s", resume=True)
    assert whole.stopped == "done" and len(whole) == 6
    assert whole.cl[0] == first.cl[0]
    assert "A sweep of 2 sections" in whole.report().read_text()


def test_what_raises_ends_the_sweep():
    def raises(figures):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        remodel.sweep(PROBLEM, callback=raises)


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: remodel.sweep(7), "problem: found 7"),
        (lambda: remodel.sweep({}), "problem: the key 'conditions' is missing"),
        (lambda: remodel.sweep(PROBLEM | {"sections": [np.nan]}), "problem['sections'][0]: found nan"),
        (lambda: remodel.sweep(PROBLEM | {"sections": []}), "found no sections"),
        (lambda: remodel.sweep(PROBLEM, threads=-1), "threads: found -1"),
        (lambda: remodel.sweep(PROBLEM, resume=True), "resume: found without a directory"),
        (lambda: remodel.sweep("none.json"), "none.json"),
        (lambda: remodel.sweep(PROBLEM, callback=3), "callback: found 3"),
        (lambda: remodel.sweep(PROBLEM).report(), "directory: the sweep had none"),
        (lambda: remodel.sweep(PROBLEM).outlines(1), "count: found 1"),
    ],
)
def test_misuse_is_answered(call, message):
    with pytest.raises(remodel.Error) as caught:
        call()
    assert message in str(caught.value)
