"""OpenFOAM: the mesh of a case by the rules of its user guide, time directories carried along, and where OpenFOAM is
installed its own programs on both."""

import json
import math
import os
import re
import shutil
import sqlite3
import subprocess

import shapes
from harness import SOURCE, ProgramTest

HEADER = "FoamFile\n{{\n version 2.0;\n format {};\n class {};\n object {};\n}}\n"


def entries(text):
    """The rows of a file's only list."""
    count, rows = re.search(r"^(\d+)\n\(\n(.*)^\)", text, re.M | re.S).groups()
    rows = rows.splitlines()
    assert len(rows) == int(count)
    return rows


def numbers(row):
    return [float(word) for word in re.sub(r"[^(]*\(|\)", "", row).split()]


class FoamMesh:
    def __init__(self, case):
        read = lambda name: (case / "constant/polyMesh" / name).read_text()
        self.points = [numbers(row) for row in entries(read("points"))]
        self.faces = [list(map(int, numbers(row))) for row in entries(read("faces"))]
        self.owner = list(map(int, entries(read("owner"))))
        self.neighbour = list(map(int, entries(read("neighbour"))))
        self.patches = {
            name: (kind, int(count), int(start)) for name, kind, count, start in re.findall(
                r"(\w+)\s*{\s*type\s+(\w+);\s*nFaces\s+(\d+);\s*startFace\s+(\d+);", read("boundary"))}
        self.cells = max(self.owner) + 1

    def area_vector(self, face):
        corners = [self.points[i] for i in self.faces[face]]
        total = [0.0, 0.0, 0.0]
        for a, b in zip(corners, corners[1:] + corners[:1]):
            for k in range(3):
                total[k] += 0.5 * (a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
        return total

    def centres(self):
        """Of cells, by the triangles at z = 0."""
        _, count, start = self.patches["front"]
        return [[sum(self.points[i][k] for i in self.faces[f]) / 3 for k in (0, 1)] for f in range(start, start + count)]


def field(name, cells, values, airfoil):
    """A scalar field, linear in cells; the airfoil's value is one a face."""
    listed = lambda numbers: f"nonuniform List<scalar> {len(numbers)} ({' '.join(map(repr, numbers))})"
    return HEADER.format("ascii", "volScalarField", name) + f"""dimensions [0 0 0 1 0 0 0];
internalField {listed(values)};
boundaryField {{ airfoil {{ type calculated; value {listed(airfoil)}; }}
  farfield {{ type fixedValue; value uniform 293; }} /* nonuniform }} */ "front|back" {{ type empty; }} }}
"""


# Leaves a field that is an affine function of the design, in cells and on the airfoil's faces, and says how far from it its
# start was.
AFFINE = """import json, re, sys
from pathlib import Path
case, design, result = Path(sys.argv[1]), json.loads(Path(sys.argv[2]).read_text()), sys.argv[3]
boundary = (case / "constant/polyMesh/boundary").read_text()
count = lambda patch: int(re.search(patch + r"\\s*{[^}]*nFaces\\s+(\\d+)", boundary).group(1))
exact = [[300 + sum((1 + (i + k) % 3) * a for k, a in enumerate(design)) for i in range(count(patch))]
         for patch in ("front", "airfoil")]
listed = lambda values: f"nonuniform List<scalar> {len(values)} ({' '.join(map(repr, values))})"
header = "FoamFile { version 2.0; format ascii; class volScalarField; object T; } dimensions [0 0 0 1 0 0 0];"
outputs = {}
if (case / "0/T").exists():
    lists = re.findall(r"List<scalar>\\s*\\d+\\s*\\(([^)]*)\\)", (case / "0/T").read_text())
    found = [list(map(float, text.split())) for text in lists]
    assert [len(values) for values in found] == [len(values) for values in exact]
    outputs["off"] = max(abs(a - b) for x, y in zip(found, exact) for a, b in zip(x, y))
(case / "100").mkdir()
(case / "100/T").write_text(f"{header} internalField {listed(exact[0])}; boundaryField {{ airfoil {{ type calculated; "
                            f"value {listed(exact[1])}; }} farfield {{ type fixedValue; value uniform 293; }} }}")
Path(result).write_text(json.dumps({"objective": design[0] ** 2, "outputs": outputs}))
"""


class Files(ProgramTest):
    def test_earlier_fields_of_one_connectivity_are_combined(self):
        self.write("affine.py", AFFINE)
        self.figures("optimise", "--from", "naca:0012", "--evaluate", "python3 affine.py {case} {design} {result}", "--points",
                     40, "--sigma", 1e-4, "--strategy", "reference", "--snapshots", 20, "--evaluations", 22, "--quiet", "-o",
                     "run")
        with sqlite3.connect(self.path("run") / "history.sqlite") as history:
            rows = [json.loads(row) for row, in history.execute("select outputs from evaluations order by evaluation")]
        self.assertEqual([row["state_snapshots"] for row in rows], [min(i, 20) for i in range(22)])
        early, late = [row["off"] for row in rows[1:4]], [row["off"] for row in rows[15:]]
        self.assertLess(max(late), min(early) / 20)

    def mesh(self, points=60):
        self.succeed("mesh", "naca:0012", "--points", points, "-o", "old.vtkhdf")
        self.path("case").mkdir()
        self.succeed("convert", "old.vtkhdf", "-o", "case/case.foam")
        return FoamMesh(self.path("case"))

    def test_the_mesh_keeps_openfoams_rules(self):
        mesh = self.mesh()
        checked = self.figures("check", "old.vtkhdf")
        self.assertEqual(mesh.cells, checked["triangles"])
        self.assertEqual(len(mesh.points), 2 * checked["vertices"])
        inner = len(mesh.neighbour)
        order = list(zip(mesh.owner, mesh.neighbour))
        self.assertEqual(order, sorted(set(order)))  # upper triangular
        self.assertTrue(all(a < b for a, b in order))
        self.assertEqual({name: kind for name, (kind, _, _) in mesh.patches.items()},
                         {"airfoil": "wall", "farfield": "patch", "front": "empty", "back": "empty"})
        at = inner
        for name, (_, count, start) in mesh.patches.items():
            self.assertEqual(start, at)
            at += count
            if name in checked["boundary"]:
                self.assertEqual(count, checked["boundary"][name])
        self.assertEqual(at, len(mesh.faces))
        # Each cell is closed, of area vectors out of it, and lies on the inner side of each of its faces.
        sums = [[0.0] * 3 for _ in range(mesh.cells)]
        volume = [0.0] * mesh.cells
        for f in range(len(mesh.faces)):
            vector = mesh.area_vector(f)
            corner = mesh.points[mesh.faces[f][0]]
            sides = [(mesh.owner[f], 1)] + ([(mesh.neighbour[f], -1)] if f < inner else [])
            for cell, sign in sides:
                for k in range(3):
                    sums[cell][k] += sign * vector[k]
                    volume[cell] += sign * vector[k] * corner[k] / 3
        self.assertLess(max(abs(x) for row in sums for x in row), 1e-9)
        self.assertGreater(min(volume), 0)
        self.assertAlmostEqual(sum(volume), checked["area"], delta=1e-6)

    def test_quadrilaterals_are_hexahedra(self):
        text, triangles, quads = shapes.layered(around=20, layers=3, rings=3)
        self.write("q.su2", text)
        self.path("case").mkdir()
        self.succeed("convert", "q.su2", "-o", "case/case.foam")
        mesh = FoamMesh(self.path("case"))
        self.assertEqual(mesh.cells, triangles + quads)
        faces = [0] * mesh.cells
        sums = [[0.0] * 3 for _ in range(mesh.cells)]
        for f in range(len(mesh.faces)):
            sides = [(mesh.owner[f], 1)] + ([(mesh.neighbour[f], -1)] if f < len(mesh.neighbour) else [])
            for cell, sign in sides:
                faces[cell] += 1
                for k in range(3):
                    sums[cell][k] += sign * mesh.area_vector(f)[k]
        self.assertEqual(faces, [5] * triangles + [6] * quads)
        self.assertLess(max(abs(x) for row in sums for x in row), 1e-9)
        # Fields have a value for each.
        self.path("case/200").mkdir()
        wall = mesh.patches["airfoil"][1]
        self.write("case/200/T", field("T", mesh.cells, [float(i) for i in range(mesh.cells)], [1.0] * wall))
        self.succeed("transfer", "q.su2", "q.su2", "--state", "case/200", "--state-out", "again")
        values = re.findall(r"List<scalar>\s+\d+\s+\((.*?)\)", self.path("again/T").read_text(), re.S)[0]
        self.assertEqual(list(map(float, values.split())), [float(i) for i in range(mesh.cells)])

    def test_a_time_directory_rides_along(self):
        linear = lambda p: 300 + 0.1 * p[0] - 0.2 * p[1]
        mesh = self.mesh()
        _, faces, _ = mesh.patches["airfoil"]
        self.path("case/200").mkdir()
        self.write("case/200/T", field("T", mesh.cells, [linear(c) for c in mesh.centres()], [291.5] * faces))
        self.write("case/200/phi", HEADER.format("ascii", "surfaceScalarField", "phi"))
        self.path("new").mkdir()
        figures = self.figures("update", "old.vtkhdf", "naca:0013", "-o", "new/case.foam", "--state", "case/200",
                               "--state-out", "new/0")
        self.assertEqual((figures["fields"], figures["fields_left_out"]), (["T"], ["phi"]))
        after = FoamMesh(self.path("new"))
        text = self.path("new/0/T").read_text()
        cells, airfoil = re.findall(r"List<scalar>\s+\d+\s+\((.*?)\)", text, re.S)
        values = list(map(float, cells.split()))
        self.assertEqual(len(values), after.cells)
        off = sorted(abs(v - linear(c)) for v, c in zip(values, after.centres()))
        self.assertLess(off[len(off) // 2], 1e-10)
        self.assertLess(off[-1], 0.05)
        self.assertEqual(list(map(float, airfoil.split())), [291.5] * after.patches["airfoil"][1])
        self.assertIn("/* nonuniform } */", text)

    def test_conservative_fields_come_with_their_balance(self):
        mesh = self.mesh()
        _, faces, _ = mesh.patches["airfoil"]
        self.path("case/200").mkdir()
        self.write("case/200/T", field("T", mesh.cells, [300 + c[0] for c in mesh.centres()], [291.5] * faces))
        vectors = " ".join(f"({1 + c[1]} {c[0]} 0)" for c in mesh.centres())
        self.write("case/200/U", HEADER.format("ascii", "volVectorField", "U") +
                   f"internalField nonuniform List<vector> {mesh.cells} ({vectors});\nboundaryField {{ }}\n")
        figures = self.figures("update", "old.vtkhdf", "naca:2412", "-o", "new.vtkhdf", "--state", "case/200",
                               "--state-out", "0", "--conservative")
        swept = figures["swept"]
        self.assertGreater(swept["area_gained"], 0)
        before, after = figures["integral_before"], figures["integral_after"]
        self.assertEqual((len(before["U"]), set(swept["gained"])), (3, {"T", "U.0", "U.1", "U.2"}))
        for name, old, new in [("T", before["T"], after["T"]), ("U.0", before["U"][0], after["U"][0])]:
            balance = old + swept["gained"][name] - swept["lost"][name]
            self.assertAlmostEqual(new, balance, delta=1e-11 * abs(before["T"]))
        # Without, the integrals alone, as of SU2's states.
        figures = self.figures("update", "old.vtkhdf", "naca:2412", "--state", "case/200", "--state-out", "1")
        self.assertNotIn("swept", figures)
        self.assertEqual(figures["integral_before"], before)

    def test_files_that_are_not_whole_are_refused(self):
        mesh = self.mesh()
        self.path("200").mkdir()
        update = ("update", "old.vtkhdf", "naca:0013", "--state", "200", "--state-out", "0")
        good = field("T", mesh.cells, [1.0] * mesh.cells, [1.0] * mesh.patches["airfoil"][1])
        self.write("200/T", good)
        for text, found in (("", "an empty file"), (good[:40], "a header without a class"),
                            (good[:good.index("boundaryField")], "expected boundaryField"),
                            (good[:-10], "the end of the file"), (good[:good.index(";\nboundary") - 20], "200/p:")):
            self.write("200/p", text)
            self.refused(*update, names=found)
            self.assertIn("200/p", self.refused(*update, names="found"))
        self.write("200/p", "notes of somebody\n")
        self.assertEqual(self.figures(*update)["fields_left_out"], ["p"])

    def test_what_is_no_time_directory_is_refused(self):
        mesh = self.mesh()
        self.path("200").mkdir()
        update = ("update", "old.vtkhdf", "naca:0013", "--state", "200", "--state-out", "0")
        self.refused(*update, names="200")
        good = field("T", mesh.cells, [1.0] * mesh.cells, [1.0] * mesh.patches["airfoil"][1])
        for found, wrong in ((f"{mesh.cells} values", "nonuniform List<scalar> 2 (1 1)"),
                             ("a finite number", "nonuniform List<scalar> 1 (nan)"),
                             ("'list'", "nonuniform list")):
            self.write("200/T", re.sub(r"nonuniform List<scalar> \d+ \([^)]*\)", wrong, good, count=1))
            self.refused(*update, names="200/T")
        self.write("200/T", good)
        self.write("file", "")
        for out, names in (("b.csv", "b.csv"), ("file", "is a file"), ("file/0", "is a file")):
            self.refused(*update[:-1], out, "-o", "new.vtkhdf", names=names)
        self.write("200/T", good.replace("ascii", "binary"))
        self.refused(*update, names="binary")
        self.refused("draw", "case/case.foam", "-o", "x.png", names="case.foam")


# Like a solver that a bad start ends; from a good one it converges at once.
STAND_IN = """#!/bin/sh
case=$2
echo "Time = 1"
mkdir -p $case/postProcessing/forces/0 $case/1
if grep -q nonuniform $case/0/T; then echo "Floating point exception"; exit 136; fi
printf '# Time Cd Cl\n1 0.01 0.5\n' > $case/postProcessing/forces/0/coefficient.dat
echo "SIMPLE solution converged in 1 iterations"
"""


class Example(ProgramTest):
    def test_a_warm_start_that_fails_is_tried_again_cold(self):
        self.succeed("mesh", "naca:0012", "--points", 60, "-o", "old.vtkhdf")
        self.path("bin").mkdir()
        self.write("bin/rhoSimpleFoam", STAND_IN)
        self.path("bin/rhoSimpleFoam").chmod(0o755)
        solve = SOURCE / "examples/openfoam/solve.py"
        environment = {**os.environ, "PATH": f"{self.path('bin')}:{os.environ['PATH']}"}
        for kind, state, warm, retried in (("cold", None, 0, 0), ("warm", "uniform 300", 1, 0), ("bad", "nonuniform", 0, 1)):
            case = self.path(kind)
            case.mkdir()
            self.succeed("convert", "old.vtkhdf", "-o", f"{kind}/case.foam")
            if state:
                (case / "0").mkdir()
                (case / "0/T").write_text(state)
            done = subprocess.run([solve, case, self.path(f"{kind}.json")], env=environment, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            outputs = json.loads(self.path(f"{kind}.json").read_text())["outputs"]
            self.assertEqual((outputs["warm"], outputs["retried"]), (warm, retried))
            self.assertEqual("the warm start failed, now cold" in done.stderr, bool(retried))


class OpenFoam(ProgramTest):
    """Minutes with OpenFOAM's own programs, of Debian's package `openfoam`."""

    def setUp(self):
        super().setUp()
        if shutil.which("rhoSimpleFoam") is None:
            self.skipTest("OpenFOAM is not installed: no rhoSimpleFoam in the PATH")
        shutil.copytree(SOURCE / "examples/openfoam", self.directory, dirs_exist_ok=True)

    def foam(self, program, case, *arguments):
        environment = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ}
        done = subprocess.run([program, "-case", case, *arguments], cwd=self.directory, env=environment,
                              capture_output=True, text=True, timeout=250)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        return done.stdout

    def test_openfoam_finds_nothing_wrong(self):
        self.path("case").mkdir()
        self.succeed("mesh", "naca:0012", "--points", 60, "-o", "case/case.foam")
        for name in ("system", "constant"):
            shutil.copytree(self.path(name), self.path("case") / name, dirs_exist_ok=True)
        shutil.copytree(self.path("start"), self.path("case/0"))
        said = self.foam("checkMesh", "case", "-allTopology")
        self.assertIn("Mesh OK.", said)
        self.assertIn("Mesh has 2 geometric (non-empty/wedge) directions (1 1 0)", said)
        self.foam("potentialFoam", "case")

    def test_openfoam_finds_nothing_wrong_with_layers(self):
        self.write("blunt.json", '{"degree": 2, "upper": [0.2, 0.2, 0.2], "lower": [-0.2, -0.2, -0.2],'
                                 ' "te_upper": 0.004, "te_lower": -0.004}')
        spaced = ("--max-spacing", 0.004)  # cells of an aspect below 1000
        for shape, options in (("naca:0012", spaced), ("rae2822", ()), ("blunt.json", spaced),
                               (SOURCE / "examples/domains/high_lift.json", spaced)):
            with self.subTest(shape):
                shutil.rmtree(self.path("case"), ignore_errors=True)
                self.path("case").mkdir()
                figures = self.figures("mesh", shape, "--layers", "--reynolds", 6e6, *options, "-o", "case/case.foam")
                for name in ("system", "constant"):
                    shutil.copytree(self.path(name), self.path("case") / name, dirs_exist_ok=True)
                said = self.foam("checkMesh", "case")
                self.assertIn("Mesh OK.", said)
                self.assertIn(f"hexahedra:     {figures['quadrilaterals']}", said)

    def test_the_example_starts_from_the_design_before(self):
        figures = self.figures(
            "optimise", "--from", "naca:0012", "--evaluate", "./solve.py {case} {result}", "--points", 60, "--sigma",
            0.001, "--evaluations", 3, "--quiet", "-o", "run", "--time-limit", 250)
        self.assertEqual(figures["failed_evaluations"], 0, figures["detail"])
        with sqlite3.connect(self.path("run/history.sqlite")) as history:
            outputs = [json.loads(text) for text, in history.execute("select outputs from evaluations")]
        self.assertEqual([row["warm"] for row in outputs], [0, 1, 1])
        for row in outputs[1:]:
            self.assertLess(row["iterations"], outputs[0]["iterations"])
            self.assertTrue(math.isclose(row["cl"], outputs[0]["cl"], rel_tol=0.1))
