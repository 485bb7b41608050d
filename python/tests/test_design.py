import json
import os
import pickle

import numpy as np
import pytest
import remodel


def problem(**changes):
    return {"airfoil": "naca:0012", "degree": 4, "symmetric": True, "flow": [{"mach": 0.8}], "mesh": {"points": 40},
            "objective": "drag", "constraints": [{"kind": "area", "of_start": 1}],
            "designer": {"evaluations": 6, "bounds": 0.2, "trust": 0.02}, **changes}  # fmt: skip


def test_drag_falls_and_the_area_stays(tmp_path):
    seen = []
    result = remodel.design(problem(), directory=tmp_path / "run", callback=lambda row: seen.append(row["objective"]))
    assert result.evaluations == len(result.rows) == len(seen) == 6
    assert result.objective < 0.8 * result.start_objective
    assert result.constraints == {"area": 0.0} and result.stopped == "evaluations" and not result.converged
    assert result.designs.shape == (6, 5) and result.best_design.shape == (5,)
    assert np.isclose(result.column("cd").min(), result.objective, rtol=1e-12) and np.isclose(result.outputs["cd"], result.objective)
    assert "objective" in result._repr_html_()
    assert pickle.loads(pickle.dumps(result)).objective == result.objective
    page = result.report()
    assert page == tmp_path / "run" / "report.html" and "<svg" in page.read_text()
    # A search goes on, and is what one of as many designs is, to what its flows are converged to.
    longer = problem(designer={"evaluations": 8, "bounds": 0.2, "trust": 0.02})
    resumed = remodel.design(longer, directory=tmp_path / "run", resume=True)
    assert resumed.evaluations == 8 and np.isclose(resumed.objective, remodel.design(longer).objective, rtol=1e-7)


def test_a_file_is_as_good_as_a_dict(tmp_path):
    file = tmp_path / "problem.json"
    file.write_text(json.dumps(problem(designer={"evaluations": 2})))
    assert remodel.design(file).objective == remodel.design(problem(designer={"evaluations": 2})).objective


def test_a_section_of_ones_own_and_its_verification():
    airfoil = remodel.Airfoil("naca:0012", degree=4)
    result = remodel.design(problem(airfoil=airfoil, verify=[40], designer={"evaluations": 1}))
    assert np.allclose(result.best_design, airfoil.design[:5], atol=1e-12)
    (fresh,) = result.verified
    assert fresh["converged"] and np.isclose(fresh["cd"], result.objective, rtol=0.1)  # of half a mesh


def test_a_section_of_ones_own_and_one_by_name_have_the_degree_of_the_problem(tmp_path):
    own = remodel.Airfoil("rae2822", degree=7)
    own.save(tmp_path / "own.json")
    for airfoil in (own, "rae2822", os.fspath(tmp_path / "own.json")):
        for degree in (3, 9):
            asked = problem(airfoil=airfoil, degree=degree, symmetric=False, flow=[{"mach": 0.5}], designer={"evaluations": 1})
            assert remodel.design(asked).designs.shape == (1, 2 * degree + 2)
    without = {key: value for key, value in problem(airfoil=own, symmetric=False, flow=[{"mach": 0.5}], designer={"evaluations": 1}).items() if key != "degree"}
    for airfoil in (own, os.fspath(tmp_path / "own.json")):
        assert np.array_equal(remodel.design({**without, "airfoil": airfoil}).best_design, own.design)


def half_drag(flow):
    return 0.5 * flow.cd, {"cd": 0.5}


def test_functions_of_ones_own_are_those_of_the_library_where_they_are_the_same():
    def nose(design, domain):
        return 0.1 - design[0], [-1.0, 0.0, 0.0, 0.0, 0.0]

    constraints = [{"kind": "area", "of_start": 1}, {"design_function": nose}]
    own = remodel.design(problem(objective=half_drag, constraints=constraints))
    assert own.constraints == {"area": 0.0, "nose": 0.0}
    # At an incidence all flows are of whole sections.
    flow = [{"mach": 0.75, "alpha_deg": 1}]
    given = remodel.design(problem(flow=flow, objective=lambda flow: (flow.cd, {"cd": 1.0})))
    named = remodel.design(problem(flow=flow))
    assert np.array_equal(given.designs, named.designs) and given.objective == named.objective
    assert own.objective < 0.9 * own.start_objective


def test_derivatives_by_pressures_are_those_by_coefficients():
    """The mean pressure at given points, by its own derivatives: a slope along the first step of the search."""

    def mean_pressure(flow):
        n = len(flow.mesh.points)
        return float(np.mean(flow.pressure)), {"pressure": np.full(n, 1.0 / n)}

    wanted = problem(objective=mean_pressure, constraints=[], designer={"evaluations": 2, "bounds": 0.2, "trust": 1e-4})
    result = remodel.design(wanted)
    assert result.rows[1]["objective"] < result.rows[0]["objective"]


def test_what_a_function_raises_is_raised_and_a_failure_is_of_one_design():
    def fails(flow):
        raise ZeroDivisionError("of my own")

    with pytest.raises(ZeroDivisionError, match="of my own"):
        remodel.design(problem(objective=fails))
    with pytest.raises(remodel.ArgumentTypeError, match="derivatives"):
        remodel.design(problem(objective=lambda flow: flow.cd))
    calls = []

    def fails_once(flow):
        calls.append(flow.cd)
        if len(calls) == 2:
            raise remodel.EvaluationFailed("not this one")
        return flow.cd, {"cd": 1.0}

    result = remodel.design(problem(objective=fails_once))
    assert result.rows[1]["objective"] == np.inf or result.rows[1]["objective"] is None
    assert "not this one" in result.rows[1]["detail"] and result.evaluations == 6
    # CMA-ES needs no derivatives.
    cmaes = {"name": "cmaes", "evaluations": 3, "sigma": 0.005}
    assert remodel.design(problem(objective=lambda flow: flow.cd, designer=cmaes)).evaluations == 3


@pytest.mark.parametrize("error", [KeyError("no"), KeyboardInterrupt(), SystemExit(3), remodel.ArgumentError("of my own"), ZeroDivisionError("no"), remodel.EvaluationFailed("no")])
@pytest.mark.parametrize("later", [False, True])
def test_what_a_function_of_a_design_raises_is_raised_and_a_failure_is_of_one_design(error, later):
    starts = []

    def of_design(design, domain):
        starts.append(design)
        if not later or not np.array_equal(design, starts[0]):
            raise error
        return -1.0, np.zeros(len(design))

    asked = problem(constraints=[{"kind": "area", "of_start": 1}, {"design_function": of_design}])
    if later and isinstance(error, remodel.EvaluationFailed):
        result = remodel.design(asked)
        assert [row["detail"].partition(": ")[2] or row["detail"] for row in result.rows[1:]] == ["no"] * (len(result.rows) - 1)
        return
    with pytest.raises(type(error)) as raised:
        remodel.design(asked)
    assert raised.value is error or (isinstance(error, remodel.EvaluationFailed) and str(raised.value) == "no")


def test_a_run_is_gone_on_with_by_functions_of_its_names_alone(tmp_path):
    few, run = {"evaluations": 1, "bounds": 0.2, "trust": 0.02}, tmp_path / "run"
    remodel.design(problem(objective=lambda flow: (flow.cd, {"cd": 1.0}), designer=few), directory=run)
    for changes, place in (
        ({"objective": lambda flow: (flow.cl, {"cl": 1.0})}, "problem, objective: found a lambda with resume"),
        ({"constraints": [{"design_function": lambda design, domain: (-1.0, 0 * design)}]}, "problem, constraint 1, design_function: found a lambda"),
    ):
        with pytest.raises(remodel.ArgumentError, match=place):
            remodel.design(problem(**changes), directory=run, resume=True)
    named = [{"design_function": lambda design, domain: (-1.0, 0 * design), "name": "never"}]
    remodel.design(problem(constraints=named, designer=few), directory=tmp_path / "named")
    assert remodel.design(problem(constraints=named), directory=tmp_path / "named", resume=True).evaluations == 6
    remodel.design(problem(objective=half_drag, designer=few), directory=tmp_path / "half")
    assert remodel.design(problem(objective=half_drag), directory=tmp_path / "half", resume=True).evaluations == 6

    def other(flow):
        return flow.cl, {"cl": 1.0}

    with pytest.raises(remodel.ArgumentError, match="others: "):
        remodel.design(problem(objective=other), directory=tmp_path / "half", resume=True)


def test_ends_by_the_callback_and_by_what_it_raises():
    assert remodel.design(problem(), callback=lambda row: True).stopped == "interrupted"

    def raises(row):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        remodel.design(problem(), callback=raises)


def test_refusals_name_the_place(tmp_path):
    for changes, place in (
        ({"flow": [{"mach": 9.0}]}, "problem, flow 1"),
        ({"flow": [{"mach": 0.5, "transition": [0.1, 0.2]}]}, "problem, flow 1"),
        ({"objektive": "drag"}, "objektive"),
        ({"objective": "beauty"}, "beauty"),
        ({"constraints": [{"kind": "area", "of_start": 1}, {"flow_function": 3}]}, "constraint 2, flow_function"),
        ({"constraints": [{"flow_function": half_drag, "at_mots": 1}]}, "at_mots"),
        ({"constraints": [{"flow_function": half_drag, "kind": "drag"}]}, "constraint 1"),
        ({"constraints": [{"flow_function": half_drag}]}, "constraint 1"),
        ({"mesh": {"points": object()}}, "problem"),
        ({"airfoil": "none/such.dat"}, "none/such.dat"),
        ({"designer": {"trust": float("nan")}}, "trust"),
    ):
        with pytest.raises(remodel.Error, match=place):
            remodel.design(problem(**changes), directory=tmp_path / "none")
    assert not (tmp_path / "none").exists()
    for wrong in (3, None, [problem()]):
        with pytest.raises(remodel.ArgumentTypeError, match="problem"):
            remodel.design(wrong)
    with pytest.raises(remodel.FileError, match="missing.json"):
        remodel.design(tmp_path / "missing.json")
    with pytest.raises(remodel.ArgumentError, match="resume"):
        remodel.design(problem(), resume=True)
    with pytest.raises(remodel.ArgumentError, match="directory"):
        remodel.design(problem(designer={"evaluations": 1})).report()


def test_an_outline_as_it_is_given_is_deformed(tmp_path):
    box = {"kind": "box", "x": [-0.001, 1.001], "y": [-0.07, 0.07], "points": [4, 2], "hold": {"left": 1, "right": 1}}
    space = {"outline": "naca:0012", "deformations": [box]}
    given = {"space": space, "flow": [{"mach": 0.8}], "mesh": {"points": 40, "gradation": 1}, "objective": "drag",
             "constraints": [{"kind": "area", "of_start": 1}], "designer": {"evaluations": 5}}  # fmt: skip
    result = remodel.design(given)
    assert result.objective < 0.95 * result.start_objective and result.designs.shape == (5, 4)
    assert sorted(result.named) == ["airfoil.box[1,0].y", "airfoil.box[1,1].y", "airfoil.box[2,0].y", "airfoil.box[2,1].y"]
    # A design space is one file as well.
    file = tmp_path / "space.json"
    file.write_text(json.dumps(space))
    assert remodel.design({**given, "space": file}).objective == result.objective
    with pytest.raises(remodel.ArgumentError, match="deformation 1: found a box that holds no point of 'airfoil'"):
        remodel.design({**given, "space": {**space, "deformations": [{**box, "x": [2, 3]}]}})


def test_a_search_begins_with_a_design_of_another_run(tmp_path):
    before = remodel.design(problem(), directory=tmp_path / "before")
    again = problem(designer={"evaluations": 1})
    for design, expected in ((2, before.designs[1]), ("best", before.best_design)):
        result = remodel.design({**again, "start": {"history": tmp_path / "before", "design": design}}, directory=tmp_path / str(design))
        assert np.array_equal(result.designs[0], expected)
    for start in ("before", {"design": 1}, {"history": 3}, {"history": "before", "design": 0}, {"history": "before", "design": True}):
        with pytest.raises(remodel.ArgumentTypeError, match="problem, start: found"):
            remodel.design({**again, "start": start})
    with pytest.raises(remodel.ArgumentError, match="found no design 99"):
        remodel.design({**again, "start": {"history": tmp_path / "before", "design": 99}})


def test_a_search_goes_from_coarse_to_fine():
    result = remodel.design(problem(mesh={"points": [24, 40]}, designer={"evaluations": 3}))
    assert [stage["points"] for stage in result.stages] == [24, 40]
    assert result.stages[-1]["objective"] == result.objective
