"""Kinds of misuse, over the whole package: each is answered by one of our exceptions, which names what is wrong."""

import importlib
import importlib.util
import os
import sys
import threading

import numpy as np
import pytest
import remodel
from conftest import same
from remodel.idwarp import USMesh

Argument, Type, File, Format = remodel.ArgumentError, remodel.ArgumentTypeError, remodel.FileError, remodel.FormatError
Geometry, Topology = remodel.GeometryError, remodel.TopologyChanged


class Tensor:
    """As a tensor with gradients is: an array that refuses to be one."""

    def __array__(self, *_, **__):
        raise RuntimeError("call detach() first")


class Room:
    """What most cases begin with."""

    def __init__(self):
        self.airfoil = remodel.Airfoil("naca:0012")
        self.mesh = remodel.generate(self.airfoil, points=40)
        self.other = remodel.generate("naca:2412", points=60)
        self.points, self.triangles = np.array(self.mesh.points), np.array(self.mesh.triangles)
        self.flow = remodel.LivingFlow()
        self.result = self.flow.solve(self.mesh, mach=0.3)
        self.gradient = self.flow.gradients()["cd"]["points"]
        self.layered = remodel.generate_layered(self.airfoil, reynolds=5000.0, model="laminar", spacing=6.0, growth=1.6)
        self.transfer = remodel.Transfer(self.mesh, self.mesh)
        self.meshio = pytest.importorskip("meshio")

    def solve(self, **conditions):
        return remodel.LivingFlow().solve(self.mesh, **conditions)

    def design(self, **changes):
        flow = [{"mach": 0.3, "alpha_deg": 1.0}]
        return remodel.design({"airfoil": "naca:0012", "mesh": {"points": 40}, "flow": flow, "objective": "drag", **changes})

    def sweep(self, **changes):
        return remodel.sweep({"sections": ["naca:0012"], "conditions": {"mach": [0.3], "alpha_deg": [0.0]}, **changes})

    def optimise(self, objective, **options):
        return remodel.optimise(self.airfoil, objective, points=40, evaluations=5, **options)

    def stale(self):
        mesh = self.mesh.copy()
        step = mesh.update("naca:0013")
        mesh.update("naca:0014")
        return step

    def turned(self):
        warp = USMesh(self.mesh)
        warp.setSurfaceCoordinates(warp.getSurfaceCoordinates() * [-1, 1, 1])
        warp.warpMesh()

    def surface(self, **options):
        warp = USMesh(self.mesh)
        warp.setSurfaceDefinition(warp.getSurfaceCoordinates(), **options)


@pytest.fixture(scope="module")
def room():
    return Room()


# What is done wrongly, the exception, and words of its message, the argument first.
CASES = {
    # Numbers and arrays.
    "strings for coefficients": (lambda r: r.airfoil.with_design(["0.1"] * 12), Type, "design: found a list of 12, expected an array of numbers"),
    "too few coefficients": (lambda r: r.airfoil.with_design(np.zeros(3)), Argument, "design: found 3 numbers, expected 12"),
    "coefficients in two dimensions": (lambda r: r.airfoil.with_design(np.zeros((2, 6))), Argument, "design: found an array of 2 dimensions"),
    "an array of objects": (lambda r: r.airfoil.with_design(np.array([object()] * 12)), Type, "design: found an array of shape (12,) and type object"),
    "complex numbers among objects": (lambda r: r.airfoil.with_design(np.array([1j] * 12, dtype=object)), Argument, "design[0]: found the complex number 1j"),
    "a tensor with gradients": (lambda r: r.airfoil.with_design(Tensor()), Type, "design: found an object of type Tensor (call detach() first)"),
    "a ragged list": (lambda r: r.airfoil.with_design([[1.0], [1.0, 2.0]]), Type, "design: found a list of 2"),
    "a generator": (lambda r: r.airfoil.with_design(x for x in range(12)), Type, "design: found an object of type generator"),
    "a string for a number": (lambda r: remodel.solve_flow(r.mesh, mach="0.3"), Type, "mach: found '0.3' of type str, expected a number"),
    "a number without an end": (lambda r: r.solve(alpha=float("inf")), Argument, "alpha: found inf, expected a finite number"),
    # Shapes and domains.
    "surfaces of two lengths": (lambda r: remodel.Airfoil(upper=[0.1] * 6, lower=[0.1] * 5), Argument, "upper, lower: found 6 and 5"),
    "a degree below its least": (lambda r: remodel.Airfoil("naca:0012", -1), Argument, "degree: found -1, expected 2 to 12"),
    "a file of coordinates that is not there": (lambda r: remodel.Airfoil("nothing.dat"), File, "nothing.dat: cannot be read"),
    "half a number of points": (lambda r: r.airfoil.coordinates(3.5), Type, "n: found 3.5 of type float, expected an integer"),
    "surfaces that cross": (lambda r: remodel.generate(r.airfoil.with_design(-r.airfoil.design)), Geometry, "the airfoil's surfaces touch or cross"),
    "a polygon that crosses itself": (lambda r: remodel.generate(remodel.Domain.polygons({"a": [[0, 0], [1, 1], [1, 0], [0, 1]]})), Geometry, "touch or cross"),
    "polygons in a list": (lambda r: remodel.Domain.polygons([[0, 0], [1, 1], [2, 0]]), Type, "outer: found a list of 3, expected a dict"),
    "a polygon without a name": (lambda r: remodel.Domain.polygons({1: [[0, 0], [1, 0], [1, 1]]}), Type, "outer: found int, expected names"),
    "an element without an airfoil": (lambda r: remodel.Domain.airfoils([{"name": "a"}]), Argument, "elements[0]: found no 'airfoil'"),
    "half a text of a domain": (lambda r: remodel.Domain.from_json("{"), Format, "text:1: found no JSON"),
    "another domain's coefficients": (lambda r: remodel.Domain("naca:0012").with_coefficients(np.zeros(2)), Argument, "found 2"),
    "an airfoil that the domain has not": (lambda r: remodel.Domain("naca:0012").airfoil("wing"), Argument, "'wing'"),
    "no airfoil's name for a domain": (lambda r: remodel.Domain("whale"), Argument, 'shape: found "whale"'),
    # Meshes.
    "a negative size": (lambda r: remodel.generate(r.airfoil, points=-5), Argument, "points: found -5, expected an even number from 8"),
    "a mesh for a shape": (lambda r: remodel.generate(r.mesh), Type, "shape: found Mesh, expected an Airfoil, a Domain"),
    "an unknown strategy": (lambda r: r.mesh.update(r.airfoil, strategy="fast"), Argument, "strategy: found 'fast', expected one of chain, renew"),
    "an unknown boundary": (lambda r: r.mesh.update(r.airfoil, boundary="wing"), Argument, "'wing'"),
    "an argument without its name": (lambda r: r.mesh.update(r.airfoil, "renew"), Type, "update: too many positional arguments"),
    "a method of another class": (lambda r: remodel.Mesh.update(r.airfoil, r.airfoil), Type, "self: found an object of type Airfoil, expected a Mesh"),
    "derivatives of another mesh": (lambda r: r.other.vjp(r.gradient), Argument, "by_points: is of a flow on a mesh with other triangles"),
    "derivatives of too few points": (lambda r: r.mesh.vjp(np.zeros((3, 2))), Argument, "by_points: found 3, expected"),
    "a direction of too few numbers": (lambda r: r.mesh.jvp(np.zeros(3)), Argument, "direction: found 3 numbers, expected 12"),
    "displacements of too few points": (lambda r: remodel.InteriorDisplacement(r.mesh).jvp(np.zeros((3, 2))), Argument, "walls: found 3"),
    "a boundary for a list of them": (lambda r: remodel.InteriorDisplacement(r.mesh, "airfoil"), Type, "moving: found 'airfoil' of type str, expected a list"),
    "None for a mesh that moves": (lambda r: remodel.InteriorDisplacement(None), Type, "mesh: found NoneType, expected a Mesh"),
    "a method of nothing": (lambda r: remodel.Mesh.copy(None), Type, "self: found None"),
    "a trial outside its block": (lambda r: r.mesh.trial("naca:0012").step, Argument, "trial: has not begun"),
    "a trial kept outside its block": (lambda r: r.mesh.trial("naca:0012").keep(), Argument, "trial: is over or has not begun"),
    "the arrays of a step that is over": (lambda r: r.stale().after, Argument, "step: its mesh has changed since"),
    "a transfer of a step without arrays": (lambda r: r.stale().transfer, Argument, "step: its arrays were not kept"),
    "values of another mesh to carry": (lambda r: r.transfer.ride(np.zeros(3)), Argument, "values: found 3"),
    "no values to remap": (lambda r: r.mesh.copy().update("naca:0013", record=True).transfer.remap([]), Argument, "values: found 0, expected 1 for each of"),
    "values of another mesh to remap": (lambda r: r.mesh.copy().update("naca:0013", record=True).transfer.remap(np.zeros(5), "triangles"), Argument, "values: found 5"),
    "a component that is not there to conserve": (lambda r: r.transfer.remap(r.points, conserved="ab"), Type, "conserved: found 'ab' of type str, expected 4 numbers"),
    "indices below zero": (lambda r: remodel.FrozenMesh(r.points, r.triangles.astype(int) - 1), Argument, "triangles: row"),
    "indices past the end": (lambda r: remodel.FrozenMesh(r.points, r.triangles + 1), Argument, "triangles: row"),
    "flat triangles": (lambda r: remodel.FrozenMesh(r.points, r.triangles.ravel()), Argument, "triangles: found an array of shape"),
    "points in space": (lambda r: remodel.FrozenMesh(np.zeros((3, 3)), [[0, 1, 2]]), Argument, "points: expected an array of shape (n, 2)"),
    "a number for each triangle but one": (lambda r: r.mesh.freeze().save("never.vtu", {"a": np.zeros(3)}), Argument, "field 'a': 3 values found"),
    "an object that __new__ made": (lambda r: remodel.Airfoil.__new__(remodel.Airfoil).design, Argument, "object: was made by __new__ alone"),
    "a mesh that __new__ made": (lambda r: remodel.Mesh.__new__(remodel.Mesh).update("naca:0012"), Argument, "object: found one of another type"),
    "layers that __new__ made": (lambda r: remodel.LayeredMesh.__new__(remodel.LayeredMesh).update("naca:0012"), Argument, "object: "),
    # Layers.
    "layers for a negative Reynolds number": (lambda r: remodel.generate_layered("naca:0012", reynolds=-1.0), Argument, "reynolds: found -1"),
    "layers that nothing sizes": (lambda r: remodel.generate_layered("naca:0012"), Argument, "reynolds: not given"),
    "layers that shrink": (lambda r: remodel.generate_layered("naca:0012", reynolds=1e6, growth=0.5), Argument, "growth: found 0.5"),
    "a layer of no thickness": (lambda r: remodel.generate_layered("naca:0012", reynolds=1e6, thickness=-1.0), Argument, "thickness: found -1"),
    "walls that are numbers": (lambda r: remodel.generate_layered("naca:0012", reynolds=1e6, walls=[1]), Type, "walls[0]: found 1 of type int, expected a string"),
    "a trial of layers without a shape": (lambda r: r.layered.trial(), Type, "trial: missing a required argument: 'shape'"),
    "derivatives of a mesh without its layers": (lambda r: r.layered.vjp(r.points), Argument, "by_points: found"),
    # Flows.
    "gradients before a flow": (lambda r: remodel.LivingFlow().gradients(), Argument, "gradients: no flow was found yet"),
    "a function by a field that no flow has": (lambda r: r.flow.gradients({"a": {"colour": 1.0}}), Argument, "functions, a: found 'colour'"),
    "a column for a row": (lambda r: r.flow.gradients({"a": {"pressure": np.ones((len(r.mesh.points), 1))}}), Argument, "functions, a, pressure: found an array of shape ("),
    "functions in a list": (lambda r: r.flow.gradients(["cd"]), Type, "functions: found a list of 1, expected a dict"),
    "a model that is not there": (lambda r: remodel.LivingFlow(model="les"), Argument, "model: found 'les'"),
    "a tolerance below zero": (lambda r: remodel.LivingFlow(tolerance=-1.0).solve(r.mesh), Argument, "tolerance: found -1"),
    "no steps": (lambda r: remodel.LivingFlow(max_steps=0).solve(r.mesh), Argument, "max_steps: found 0"),
    "a Mach number below zero": (lambda r: r.solve(mach=-0.5), Argument, "mach: found -0.5, expected 0.01 to 3"),
    "a Reynolds number without friction": (lambda r: r.solve(reynolds=1e6), Argument, "reynolds: given with the model euler"),
    "friction without a Reynolds number": (lambda r: remodel.LivingFlow(model="laminar").solve(r.layered), Argument, "reynolds: found 0, expected 1 to 1e10"),
    "the length of nothing": (lambda r: r.solve(reference_length=0.0), Argument, "reference_length: found 0"),
    "one coordinate for a point": (lambda r: r.solve(reference=[0.25]), Type, "reference: found a list of 1, expected 2 numbers"),
    "one number for an inlet": (lambda r: remodel.LivingFlow(inlets={"in": 3.0}), Type, "inlets['in']: found 3.0 of type float, expected a list, each part a number"),
    "a text for an outlet": (lambda r: remodel.LivingFlow(outlets={"out": "low"}), Type, "outlets['out']: found 'low' of type str, expected a number"),
    "a far field that the mesh has not": (lambda r: remodel.LivingFlow(farfield="sky").solve(r.mesh), Argument, "'sky'"),
    "a file's name for a mesh": (lambda r: remodel.LivingFlow().solve("mesh.su2"), Type, "mesh: found str, expected a Mesh"),
    "a boundary layer without friction": (lambda r: r.result.boundary_layer(), Argument, "flow: found no friction"),
    "potential flow past sound": (lambda r: remodel.PotentialSolver(r.mesh).at(2.0, mach=2.0), Argument, "mach: "),
    # Files.
    "a directory that is not there": (lambda r: r.mesh.save("no/such/mesh.su2"), File, "no/such/mesh.su2: cannot be written"),
    "a directory that is read alone": (lambda r: r.airfoil.save("/proc/airfoil.json"), File, "/proc/airfoil.json: cannot be written"),
    "a format that is not written": (lambda r: r.mesh.save("mesh.stl"), Argument, "mesh.stl: extension '.stl' found"),
    "noise for a mesh": (lambda r: remodel.Mesh.load(__file__.replace("test_misuse.py", "conftest.py")), Argument, "extension '.py'"),
    "a window of two numbers": (lambda r: r.mesh.plot(window=[0, 1]), Argument, "window: found an array of shape (2,)"),
    # Searches and sweeps.
    "a problem of another type": (lambda r: remodel.design(3), Type, "problem: found 3 of type int"),
    "a problem's file that is not there": (lambda r: remodel.design("none.json"), File, "none.json: cannot be read"),
    "a problem that contains itself": (lambda r: (lambda d: (d.update(mesh=d), remodel.design(d)))({"airfoil": "naca:0012"}), Argument, "problem"),
    "a key that no problem has": (lambda r: r.design(colour=1), Format, "found the key 'colour'"),
    "a constraint of no kind": (lambda r: r.design(constraints=[{"kind": "beauty"}]), Argument, "problem, constraint 1: found 'beauty'"),
    "a function that is none": (lambda r: r.design(constraints=[{"flow_function": 3, "at_most": 1}]), Type, "constraint 1, flow_function: found 3"),
    "a function without derivatives": (lambda r: r.design(objective=lambda flow: flow.cd), Type, "returned no derivatives"),
    "a function that answers with a text": (lambda r: r.design(objective=lambda flow: "low"), Type, "expected a number"),
    "a search of another space": (lambda r: r.design(space={"file": "nothing.json"}), remodel.Error, ""),
    "deformation of a curve that is not there": (lambda r: remodel.design({"space": {"domain": "naca:0012", "boxes": []}, "flow": [{"mach": 0.3, "alpha_deg": 1.0}]}), remodel.Error, "problem"),
    "to resume nothing": (lambda r: remodel.design({"airfoil": "naca:0012"}, resume=True), Argument, "resume: found without a directory"),
    "yes for True": (lambda r: remodel.design({"airfoil": "naca:0012"}, resume="yes"), Type, "resume: found 'yes' of type str, expected True or False"),
    "a sweep of no sections": (lambda r: r.sweep(sections=[]), Format, "sections"),
    "a sweep without conditions": (lambda r: remodel.sweep({"sections": ["naca:0012"]}), Format, "problem: the key 'conditions' is missing"),
    "more threads than there may be": (lambda r: remodel.sweep({}, threads=99999), Argument, "threads: found 99999"),
    "an objective that answers with a list": (lambda r: r.optimise(lambda *_: [1.0, 2.0]), Type, "objective: returned a list of 2"),
    "an objective that answers with another key": (lambda r: r.optimise(lambda *_: {"cost": 1.0}), Argument, "objective: returned the key 'cost'"),
    "a callback that is none": (lambda r: r.optimise(r.airfoil, callback=3), Type, "callback: found 3"),
    "a run's directory that is a file": (lambda r: r.optimise(r.airfoil, directory=__file__), File, "cannot make the directory"),
    "a figure that no evaluation has": (lambda r: r.optimise(r.airfoil).column("cost"), Argument, "name: found 'cost'"),
    "values of no samples": (lambda r: remodel.CMAES([0.0] * 3, 0.1).tell([[0.0] * 3], []), Argument, "tell: found 1 solutions and 0 values"),
    "one value for all samples": (lambda r: remodel.CMAES([0.0] * 3, 0.1).tell([[0.0] * 3], 1.0), Type, "function_values: found 1.0"),
    "more samples than memory has": (lambda r: remodel.CMAES([0.0] * 3, 0.1).ask(2**70), Argument, "number: found 1180591620717411303424 of type int, expected 1 to 1000000"),
    "samples of another size": (lambda r: remodel.CMAES([0.0] * 3, 0.1).tell([[0.0] * 2], [1.0]), Argument, "solutions: "),
    # IDWarp's calls.
    "no file to warp": (lambda r: USMesh({}), Argument, "gridFile: not given"),
    "an option that IDWarp has not": (lambda r: USMesh({"colour": 1}), Argument, "name: found 'colour' of type str"),
    "one name for a list of surfaces": (lambda r: USMesh(r.mesh, surface="airfoil"), Type, "surface: found 'airfoil' of type str, expected a list"),
    "a communicator that is none": (lambda r: USMesh(r.mesh, comm=3), Type, "comm: found 3"),
    "a surface elsewhere": (lambda r: USMesh(r.mesh).setSurfaceDefinition(np.ones((3, 3))), Argument, "pts[0]: found 1, 1, where the grid has no boundary vertex"),
    "faces by half numbers": (lambda r: r.surface(conn=[0.5], faceSizes=[1]), Type, "conn: found an array of shape (1,) and type float64, expected integers"),
    "derivatives before warpDeriv": (lambda r: USMesh(r.mesh).getdXs(), Argument, "getdXs: called first, expected warpDeriv()"),
    "a step of nothing": (lambda r: USMesh(r.mesh).verifyWarpDeriv(h=0.0), Argument, "h: found 0.0"),
    "a surface turned inside out": (lambda r: r.turned(), Topology, "surface: the grid is not valid"),
    # Bridges.
    "a mesh of another library": (lambda r: remodel.from_meshio(r.mesh), Type, "mesh: found an object of type Mesh, expected a meshio.Mesh"),
    "cells of space": (lambda r: remodel.from_meshio(r.meshio.Mesh(np.eye(4, 3), [("tetra", [[0, 1, 2, 3]])])), Argument, "cells of type tetra"),
    "a mesh out of its plane": (lambda r: remodel.from_meshio(r.meshio.Mesh(np.eye(3), [("triangle", [[0, 1, 2]])])), Argument, "mesh: found z from 0 to 1"),
    "cells of points that are not there": (lambda r: remodel.from_meshio(r.meshio.Mesh(np.eye(3, 2), [("triangle", [[0, 1, 9]])])), Argument, "triangles: row 0: found 9"),
    "a text for a choice": (lambda r: remodel.from_meshio(r.meshio.Mesh(np.eye(3, 2), []), split_quadrilaterals="no"), Type, "split_quadrilaterals: found 'no'"),
    "fields in a list": (lambda r: r.mesh.to_meshio([1.0]), Type, "fields: found a list of 1, expected a dict"),
    "one number for a field": (lambda r: r.mesh.to_meshio({"a": 1.0}), Type, "a: found 1.0 of type float, expected an array"),
    "no grid": (lambda r: remodel.from_pyvista(None), Type, "grid: found an object of type NoneType"),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_misuse_is_answered_by_name(room, name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    call, kind, words = CASES[name]
    before = room.mesh.copy()
    with pytest.raises(remodel.Error) as raised:
        call(room)
    text = str(raised.value)
    assert isinstance(raised.value, kind) and words in text and "\n" not in text and len(text) < 400, (type(raised.value), text)
    assert same(room.mesh, before) and not list(tmp_path.iterdir())


def test_arrays_in_any_layout_are_taken_as_they_are_meant(room):
    mesh, airfoil = room.mesh, room.airfoil
    wide = np.zeros((len(room.points), 4))
    wide[:, ::2] = room.points
    for points in (wide[:, ::2], room.points.astype(">f8"), np.asfortranarray(room.points), room.points.astype(object), np.ma.array(room.points)):
        for triangles in (room.triangles.astype(">i8"), np.asfortranarray(room.triangles), room.triangles.astype(np.int16), room.triangles.tolist()):
            frozen = remodel.FrozenMesh(points, triangles)
            assert np.array_equal(frozen.points, room.points) and np.array_equal(frozen.triangles, room.triangles)
        assert np.array_equal(mesh.vjp(points), mesh.vjp(room.points))
    for design in (airfoil.design.astype(">f8"), np.repeat(airfoil.design, 2)[::2], airfoil.design[::-1][::-1], airfoil.design.astype(object)):
        assert airfoil.with_design(design) == airfoil
    masked = np.ma.array(airfoil.design, mask=[True] + [False] * 11)
    assert airfoil.with_design(masked.filled(0.1)).design[0] == 0.1


def test_views_outlive_what_they_are_of_and_are_not_written():
    mesh = remodel.generate("naca:0012", points=40)
    points, total = mesh.points, mesh.points.sum()
    with pytest.raises(ValueError):
        points[0, 0] = 1.0
    mesh.update("naca:2412")
    del mesh
    assert points.sum() == total


def test_a_flow_that_threads_and_forks_share(room):
    flow, unexpected, found = remodel.LivingFlow(), [], []

    def work():
        for mach in (0.3, 0.31, 0.32):
            try:
                found.append(flow.solve(room.mesh, mach=mach).converged)
                flow.gradients()
            except remodel.Error:
                pass
            except BaseException as error:
                unexpected.append(error)

    threads = [threading.Thread(target=work) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not unexpected and len(found) == 9 and all(found)
    child = os.fork()
    if child == 0:
        try:
            os._exit(0 if flow.solve(room.mesh, mach=0.3).converged else 1)
        finally:
            os._exit(2)
    assert os.waitpid(child, 0)[1] == 0


def test_what_is_no_pickle_of_ours_is_refused():
    for kind in (remodel.Airfoil, remodel.Domain, remodel.FrozenMesh, remodel.FlowResult, remodel.LayeredMesh):
        for state in (None, 3, (), ("x",), ({},), {"a": 1}):
            with pytest.raises((remodel.Error, TypeError, ValueError)):
                kind.__new__(kind).__setstate__(state)


OPENMDAO = importlib.util.find_spec("openmdao") is not None

COMPONENTS = {
    "no mesh for the points": (lambda c: c.FlowComponent(), Argument, "mesh: not given"),
    "a mesh that is none": (lambda c: c.MeshComponent(mesh=3), Type, "mesh: found 3"),
    "another airfoil than the mesh's": (lambda c: c.MeshComponent(mesh=remodel.generate("naca:0012", points=40), airfoil=remodel.Airfoil("naca:0012", 3)), Argument, "airfoil: is not the mesh's"),
    "a Reynolds number without friction": (lambda c: c.SectionComponent(reynolds=1e6), Argument, "reynolds: found 1000000.0 with the model 'euler'"),
    "friction without a Reynolds number": (lambda c: c.SectionComponent(model="sa"), Argument, "reynolds: found None with the model 'sa'"),
    "a station past the section": (lambda c: c.SectionComponent(thickness_at=[1.5], mesh={"points": 40}), Argument, "thickness_at: found [1.5]"),
    "a station that is a text": (lambda c: c.SectionComponent(thickness_at="nose", mesh={"points": 40}), Type, "thickness_at: found 'nose'"),
    "an option that no mesh has": (lambda c: c.SectionComponent(mesh={"colour": 1}), Type, "colour"),
    "a list for the options of a mesh": (lambda c: c.SectionComponent(mesh=[40]), Type, "mesh: found a list of 1, expected a dict"),
    "a strategy that no step has": (lambda c: c.SectionComponent(strategy="hub", mesh={"points": 40}), Argument, "strategy: found 'hub', expected one of chain"),
    "a number for a strategy": (lambda c: c.SectionComponent(strategy=2, mesh={"points": 40}), Type, "strategy: found 2"),
    "no airfoil": (lambda c: c.SectionComponent(airfoil=3), Type, "airfoil: found 3"),
    "a solver that is none": (lambda c: c.FlowComponent(mesh=remodel.generate("naca:0012", points=40), solver="lu"), Type, "solver: found 'lu'"),
}  # fmt: skip


@pytest.mark.skipif(OPENMDAO, reason="under OpenMDAO itself its problems set components up")
@pytest.mark.parametrize("name", COMPONENTS)
def test_misuse_of_components_is_answered_when_they_are_set_up(name, monkeypatch):
    from test_openmdao import ExplicitComponent

    api = type(sys)("openmdao.api")
    api.ExplicitComponent, api.AnalysisError = ExplicitComponent, type("AnalysisError", (Exception,), {})
    monkeypatch.setitem(sys.modules, "openmdao", type(sys)("openmdao"))
    monkeypatch.setitem(sys.modules, "openmdao.api", api)
    monkeypatch.delitem(sys.modules, "remodel.openmdao", raising=False)
    try:
        components = importlib.import_module("remodel.openmdao")
        make, kind, words = COMPONENTS[name]
        with pytest.raises(remodel.Error) as raised:
            make(components).setup()
        assert isinstance(raised.value, kind) and words in str(raised.value), (type(raised.value), str(raised.value))
    finally:
        sys.modules.pop("remodel.openmdao", None)
