"""Each argument of each public call, taken from the signatures, with values that it is not for: no crash, and no other
exception than ours. What a call takes all the same is no matter here."""

import inspect
import sys

import numpy as np
import pytest
import remodel
from remodel.idwarp import USMesh

WRONG = [
    None, -1, 2**70, -2.5, np.nan, 1j, "", "x", "\0", b"bytes", [], [1], ["a"], {}, {"a": 1}, {1: 2}, object(), (1, 2, 3, 4),
    np.zeros(0), np.zeros((3, 3)), np.array(["a"]), np.zeros((2, 2), complex), np.zeros(3, ">f8"), np.array([None, 1]), range(3), {1.0, 2.0},
]  # fmt: skip
# Of other libraries, which have their own exceptions.
FOREIGN = {("to_pyvista", "fields"), ("to_meshio", "fields")} if "pyvista" not in sys.modules else set()
# An option that makes a long call short.
SHORT = {"optimise": {"points": 40, "evaluations": 3}, "generate_layered": {"reynolds": 5000.0, "model": "laminar", "spacing": 6.0, "growth": 1.6}}
# A number that is none for these is a search of its own.
SLOW = {"optimise", "design", "sweep"}


class Things:
    """A value of its own for each class and for each name of an argument that has no default."""

    def __init__(self):
        airfoil, mesh = remodel.Airfoil("naca:0012"), remodel.generate("naca:0012", points=40)
        layered, flow = remodel.generate_layered(airfoil, **SHORT["generate_layered"]), remodel.LivingFlow()
        friction = remodel.LivingFlow(model="laminar").solve(layered, mach=0.3, reynolds=5000.0)
        flow.solve(mesh, mach=0.3)
        step, domain, warp = mesh.copy().update("naca:0013", record=True), remodel.Domain(airfoil), USMesh(mesh)
        warp.getSurfaceCoordinates()
        self.of_class = {
            "Airfoil": lambda: airfoil, "Domain": lambda: domain, "Mesh": mesh.copy, "FrozenMesh": mesh.freeze, "LayeredMesh": layered.copy,
            "LivingFlow": lambda: flow, "FlowResult": lambda: friction, "Step": lambda: step, "Transfer": lambda: step.transfer,
            "PotentialSolver": lambda: remodel.PotentialSolver(mesh), "PotentialFlow": lambda: remodel.PotentialSolver(mesh).at(2.0),
            "InteriorDisplacement": lambda: remodel.InteriorDisplacement(mesh), "CMAES": lambda: remodel.CMAES([0.0] * 3, 0.1), "USMesh": lambda: warp,
        }  # fmt: skip
        self.of_name = {
            "shape": airfoil, "design": airfoil.design, "direction": airfoil.design, "by_points": np.array(mesh.points), "mesh": mesh, "walls": mesh.points * 0,
            "values": np.zeros(len(mesh.points)), "file": "out.vtu", "text": domain.to_json(), "coefficients": domain.coefficients, "x0": [0.0] * 3,
            "sigma0": 0.1, "solutions": [[0.0] * 3], "function_values": [1.0], "before": mesh, "after": mesh, "places": [0.5], "alpha": 1.0, "lift": 0.2,
            "start": airfoil, "objective": airfoil, "problem": {}, "points": np.array(mesh.points), "triangles": np.array(mesh.triangles),
            "outer": {"a": [[0, 0], [4, 0], [4, 4], [0, 4]]}, "elements": [{"name": "a", "airfoil": airfoil}],
        }  # fmt: skip


@pytest.fixture(scope="module")
def things():
    return Things()


def calls():
    """The public functions, and the methods with their classes."""
    for name in remodel.__all__:
        thing = getattr(remodel, name)
        if not inspect.isclass(thing):
            yield name, None, thing
        elif not issubclass(thing, (Exception, np.ndarray)):
            yield from ((member, name, call) for member, call in vars(thing).items() if not member.startswith("_") and callable(getattr(call, "__func__", call)) and not isinstance(call, property))
    yield from ((member, "USMesh", call) for member, call in vars(USMesh).items() if not member.startswith("_") and callable(call) and not isinstance(call, staticmethod))
    yield "USMesh", None, USMesh
    yield from ((name, None, getattr(remodel, name)) for name in ("Airfoil", "Domain", "FrozenMesh", "LivingFlow", "Transfer", "PotentialSolver", "InteriorDisplacement", "CMAES"))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name, owner, call", [pytest.param(*each, id=f"{each[1] or ''}.{each[0]}") for each in calls()])
def test_wrong_values_raise_ours_or_are_taken(things, name, owner, call, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    if owner is not None and owner not in things.of_class:
        pytest.skip(f"objects of {owner} hold figures alone")
    is_static = isinstance(call, staticmethod)
    function = call.__func__ if is_static else call
    try:
        parameters = list(inspect.signature(function).parameters.values())
    except (TypeError, ValueError):
        pytest.skip("no signature")
    own = [] if owner is None or is_static else [things.of_class[owner]]
    parameters = [each for each in parameters[len(own) :] if each.kind in (each.POSITIONAL_OR_KEYWORD, each.KEYWORD_ONLY)]
    usual = {each.name: things.of_name.get(each.name) for each in parameters if each.default is each.empty} | (SHORT.get(name, {}) if owner is None else {})
    for each in parameters:
        if (name, each.name) in FOREIGN or name in SLOW and each.name not in ("problem", "start", "objective", "points", "callback", "threads", "strategy"):
            continue
        for number, value in enumerate(WRONG):
            try:
                function(*(make() for make in own), **{**usual, each.name: value})
            except remodel.Error as error:
                assert "\n" not in str(error) and len(str(error)) < 500, (each.name, number, error)
            except BaseException as error:
                pytest.fail(f"{each.name} = {value!r}: {type(error).__name__}: {error}")
