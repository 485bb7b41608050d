"""Files as the shell gives them: pipes, standard input, links, long names; and what other programs put into meshes."""

import json
import os
import resource
import subprocess
import threading
from pathlib import Path

import harness
import shapes
from harness import Outcome, ProgramTest

FORMATS = ("vtkhdf", "su2", "msh", "vtu")


class Memory(ProgramTest):
    def test_writing_the_native_format_takes_no_copies_of_the_file(self):
        if b"__asan_init" in Path(harness.PROGRAM).read_bytes():
            self.skipTest("memory under a sanitizer is the sanitizer's")
        # 700,000 triangles, whose file has 96 MB: 480 MB do, 350 of them for the mesh itself. It took 680.
        most = 580 << 20
        process = subprocess.run(
            [harness.PROGRAM, "mesh", "naca:0012", "--points", "2500", "--gradation", "50", "-o", "m.vtkhdf"],
            cwd=self.directory, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=300,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (most, most)))
        self.assertEqual(process.returncode, 0, process.stderr)


class Pipes(ProgramTest):
    def piped(self, content, *arguments):
        """A command whose standard input is a pipe with that content."""
        process = subprocess.run(
            [harness.PROGRAM, *map(str, arguments)], cwd=self.directory, input=content, capture_output=True, timeout=300
        )
        outcome = Outcome(process)
        self.assertEqual(outcome.status, 0, outcome)
        return outcome

    def test_meshes_of_every_format_from_standard_input(self):
        outputs = [word for end in FORMATS for word in ("-o", f"m.{end}")]
        self.succeed("mesh", "naca:0012", "--points", 20, *outputs)
        for end in FORMATS:
            with self.subTest(end):
                mesh = self.path(f"m.{end}").read_bytes()
                self.assertTrue(self.piped(mesh, "check", "-", "--json").json()["valid"])
                self.piped(mesh, "convert", "-", "-o", "again.su2")
                self.assertEqual(self.path("again.su2").read_bytes(), self.path("m.su2").read_bytes())
                options = [] if end == "vtkhdf" else ["--boundary", "airfoil"]
                self.piped(mesh, "update", "-", "naca:0013", *options, "-o", "piped.su2")
                self.succeed("update", f"m.{end}", "naca:0013", *options, "-o", "named.su2")
                self.assertEqual(self.path("piped.su2").read_bytes(), self.path("named.su2").read_bytes())

    def test_airfoils_and_domains_from_standard_input(self):
        self.write("a.dat", shapes.selig())
        self.succeed("fit", "a.dat", "-o", "a.json")
        domain = (harness.SOURCE / "examples/domains/duct.json").read_bytes()
        self.write("d.json", domain)
        for name in ("a.dat", "a.json", "d.json"):
            with self.subTest(name):
                self.piped(self.path(name).read_bytes(), "mesh", "-", "-o", "piped.su2")
                self.succeed("mesh", name, "-o", "named.su2")
                self.assertEqual(self.path("piped.su2").read_bytes(), self.path("named.su2").read_bytes())
        self.piped(self.path("a.dat").read_bytes(), "fit", "-")

    def test_planar_graphs_from_standard_input(self):
        graph = (harness.SOURCE / "examples/domains/lake.poly").read_bytes()
        self.write("lake.poly", graph)
        self.succeed("mesh", "lake.poly", "-o", "named.su2")
        self.piped(graph, "mesh", "-", "-o", "piped.su2")
        self.assertEqual(self.path("piped.su2").read_bytes(), self.path("named.su2").read_bytes())
        self.succeed("mesh", "lake.poly", "-o", "lake.vtkhdf")
        self.piped(graph, "update", "lake.vtkhdf", "-", "-o", "same.vtkhdf")
        os.mkfifo(self.path("graph"))
        writer = threading.Thread(target=self.path("graph").write_bytes, args=[graph])
        writer.start()
        self.succeed("mesh", "graph", "-o", "fifo.su2")
        writer.join()
        self.assertEqual(self.path("fifo.su2").read_bytes(), self.path("named.su2").read_bytes())

    def test_a_fifo_is_read_once(self):
        self.succeed("mesh", "naca:0012", "--points", 20, "-o", "m.vtkhdf", "-o", "m.su2")
        for name, end in (("fifo.su2", "su2"), ("fifo", "su2"), ("fifo.vtkhdf", "vtkhdf")):
            with self.subTest(name):
                os.mkfifo(self.path(name))
                mesh = self.path(f"m.{end}").read_bytes()
                writer = threading.Thread(target=self.path(name).write_bytes, args=[mesh])
                writer.start()
                self.assertTrue(self.figures("check", name)["valid"])
                writer.join()


class Names(ProgramTest):
    def test_output_through_a_link(self):
        self.path("there").mkdir()
        for name in ("m.su2", "m.vtkhdf", "m.msh", "m.vtu"):
            self.path(name).symlink_to(f"there/{name}")
            self.succeed("mesh", "naca:0012", "--points", 20, "-o", name)
            self.assertTrue(self.path(name).is_symlink())
            self.assertTrue(self.figures("check", f"there/{name}")["valid"])
        self.path("lost.su2").symlink_to("none/m.su2")
        self.refused("mesh", "naca:0012", "-o", "lost.su2", names="none")

    def test_names_as_long_as_the_file_system_takes(self):
        for end in FORMATS:
            name = "x" * (254 - len(end)) + "." + end
            self.succeed("mesh", "naca:0012", "--points", 20, "-o", name)
            self.assertTrue(self.figures("check", name)["valid"])
        self.refused("mesh", "naca:0012", "--points", 20, "-o", "x" * 252 + ".su2", names="too long")

    def test_no_marker_is_a_bare_number(self):
        self.write("4412.dat", shapes.selig())
        arguments = ("naca:0012", "4412.dat", "--place", "1,0,0,0", "--place", "1,0,0,2")
        self.assertEqual(set(self.figures("mesh", *arguments)["boundary"]), {"naca0012", "airfoil4412", "farfield"})


class Reports(ProgramTest):
    def test_a_mesh_without_length_scales_has_no_gradation(self):
        self.succeed("mesh", "naca:0012", "--points", 20, "-o", "m.su2")
        self.assertNotIn("nan", self.succeed("check", "m.su2").stdout)
        self.assertIsNone(self.figures("check", "m.su2")["max_gradation"])

    def test_points_of_no_triangle_are_counted(self):
        self.succeed("mesh", "naca:0012", "--points", 20, "-o", "m.su2")
        text = self.path("m.su2").read_text()
        before = self.figures("check", "m.su2")
        count = before["vertices"]
        head, tail = text.split("NMARK")
        self.write("more.su2", head.replace(f"NPOIN= {count}", f"NPOIN= {count + 2}") + f"0 0 {count}\n7 7\nNMARK" + tail)
        figures = self.figures("check", "more.su2")
        self.assertTrue(figures["valid"])
        self.assertEqual(figures["unused_points"], 2)
        self.assertEqual(figures["vertices"], count)

    def test_empty_files_are_refused_at_line_one(self):
        for name in ("m.su2", "m.msh", "m.vtu", "g.poly", "a.json"):
            self.write(name, "")
            command = "mesh" if name[0] in "ga" else "check"
            self.assertNotIn(":0:", self.refused(command, name, names=name))


class InnerCurves(ProgramTest):
    def wake(self):
        """A square with a curve inside, which has another region on either side."""
        square = [[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]
        self.write("d.json", json.dumps({"loops": [
            {"role": "outer", "region": "air", "curves": [
                {"name": "box", "shape": {"kind": "polyline", "points": square}, "stations": 16}]},
            {"role": "internal", "region": "inside", "right_region": "air", "curves": [
                {"name": "ring", "shape": {"kind": "arc", "centre": [1, 1], "radius": 0.5, "start": 0,
                 "sweep": 6.283185307179586}, "stations": 24}]}]}))
        return "d.json"

    def test_they_are_no_markers_of_su2_unless_asked_for(self):
        outcome = self.succeed("mesh", self.wake(), "-o", "m.su2", "-o", "m.msh")
        self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
        self.assertIn("'ring' left out", outcome.stderr)
        self.assertEqual(set(self.figures("check", "m.su2")["boundary"]), {"box"})
        self.assertEqual(set(self.figures("check", "m.msh")["boundary"]), {"box", "ring"})
        outcome = self.succeed("convert", "m.msh", "-o", "again.su2")
        self.assertIn("'ring' left out", outcome.stderr)
        outcome = self.succeed("convert", "m.msh", "--inner-markers", "-o", "again.su2")
        self.assertEqual(outcome.stderr, "")
        self.assertEqual(set(self.figures("check", "again.su2")["boundary"]), {"box", "ring"})

    def airfoil_with_a_ring(self):
        """A mesh without a design, of an airfoil and a curve around it inside the mesh."""
        self.write("ring.json", json.dumps({"loops": [
            {"airfoil": "naca:0012", "name": "airfoil", "stations": 40},
            {"role": "internal", "curves": [{"name": "ring", "shape": {
                "kind": "arc", "centre": [0.5, 0], "radius": 2, "start": 0, "sweep": 6.283185307179586},
                "stations": 24}]},
            {"role": "outer", "curves": [{"name": "farfield", "shape": {
                "kind": "arc", "centre": [0.5, 0], "radius": 8, "start": 0, "sweep": 6.283185307179586},
                "stations": 24}]}]}))
        self.succeed("mesh", "ring.json", "-o", "ring.msh")
        return "ring.msh"

    def test_a_batch_and_an_evaluator_say_so_too(self):
        mesh = self.airfoil_with_a_ring()
        batch = ("batch", mesh, "naca:0013", "naca:0014", "--boundary", "airfoil", "-o", "out", "--meshes", "su2")
        outcome = self.succeed(*batch)
        self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
        self.assertIn("'ring' left out", outcome.stderr)
        self.assertEqual(set(self.figures("check", "out/002.su2")["boundary"]), {"airfoil", "farfield"})
        outcome = self.succeed(*batch, "--overwrite", "--inner-markers")
        self.assertEqual(outcome.stderr, "")
        self.assertEqual(set(self.figures("check", "out/002.su2")["boundary"]), {"airfoil", "ring", "farfield"})
        self.assertEqual(self.succeed(*batch[:-1], "msh", "--overwrite").stderr, "")

        run = ("optimise", "--mesh", mesh, "--boundary", "airfoil", "--evaluations", 3, "--quiet", "-o", "run")
        outcome = self.succeed(*run, "--evaluator", "echo '{\"objective\": 1}' #")
        self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
        self.assertIn("'ring' left out", outcome.stderr)
        self.assertEqual(self.succeed(*run, "--to", "naca:0013", "--overwrite").stderr, "")

    def test_regions_go_through_every_format_that_has_them(self):
        self.succeed("mesh", self.wake(), "-o", "m.vtkhdf")
        regions = self.figures("check", "m.vtkhdf")["regions"]
        self.assertEqual(set(regions), {"air", "inside"})
        name = "m.vtkhdf"
        for target in ("m.msh", "m.vtu", "frozen.vtkhdf"):
            self.succeed("convert", name, "-o", target)
            self.assertEqual(self.figures("check", target)["regions"], regions)
            name = target
        self.succeed("convert", "m.msh", "--msh-version", "2.2", "-o", "old.msh")
        self.assertEqual(self.figures("check", "old.msh")["regions"], regions)


class Quadrilaterals(ProgramTest):
    """Meshes with a layer of flat quadrilaterals on the wall."""

    def layered(self, name="q.su2", **options):
        text, self.triangles, self.quads = shapes.layered(**options)
        self.write(name, text)
        return name

    def test_they_go_through_every_format_and_come_back(self):
        self.succeed("convert", self.layered(), "-o", "first.su2")
        name = "first.su2"
        for target, options in (("m.msh", []), ("old.msh", ["--msh-version", "2.2"]), ("m.vtu", []), ("m.vtkhdf", []), ("last.su2", [])):
            figures = self.figures("convert", name, "-o", target, *options)
            self.assertEqual((figures["triangles"], figures["quadrilaterals"]), (self.triangles, self.quads))
            checked = self.figures("check", target)
            self.assertTrue(checked["valid"], checked["violations"])
            self.assertEqual(checked["cells"], self.triangles + self.quads)
            self.assertLess(checked["corner_min_deg"], 90)
            name = target
        self.assertEqual(self.path("last.su2").read_bytes(), self.path("first.su2").read_bytes())

    def test_cells_may_come_in_any_order_and_clockwise(self):
        self.succeed("convert", self.layered(), "-o", "a.su2")
        area = self.figures("check", "a.su2")["area"]
        for options in ({"clockwise": True}, {"triangles_first": False}):
            checked = self.figures("check", self.layered("b.su2", **options))
            self.assertTrue(checked["valid"], checked["violations"])
            self.assertEqual((checked["quadrilaterals"], checked["area"]), (self.quads, area))

    def test_they_are_drawn_solved_on_and_carried_to(self):
        name = self.layered()
        self.assertEqual(self.figures("draw", name, "-o", "q.png")["quadrilaterals"], self.quads)
        flow = self.figures("flow", name, "--model", "potential", "--alpha", 2, "-o", "p.vtu")
        self.assertEqual(flow["quadrilaterals"], self.quads)
        self.succeed("draw", "p.vtu", "--color", "cp", "--iso", 9, "-o", "f.svg")
        flow = self.figures("flow", name, "--mach", 0.3, "-o", "e.vtkhdf")
        self.assertEqual((flow["status"], flow["quadrilaterals"]), ("converged", self.quads))
        # To the same mesh and to one of triangles.
        self.succeed("transfer", "e.vtkhdf", name, "-o", "same.vtu")
        self.succeed("transfer", "e.vtkhdf", name, "-o", "same.vtu", "--conservative")
        self.succeed("mesh", "naca:0020", "--points", 60, "-o", "other.vtkhdf")
        self.succeed("transfer", "e.vtkhdf", "other.vtkhdf", "-o", "there.vtu")
        self.succeed("transfer", "there.vtu", name, "-o", "back.vtu", "--conservative")

    def test_layers_are_dissolved_only_where_that_is_wished(self):
        name = self.layered()
        update = ("naca:0013", "--boundary", "airfoil", "-o", "n.su2")
        self.refused("update", name, *update, names=f"{name}: {self.quads} quadrilaterals found, which a remodelling would dissolve")
        figures = self.figures("update", name, *update, "--dissolve-layers")
        self.assertTrue(self.figures("check", "n.su2")["valid"])
        self.assertEqual(figures["triangles_before"], self.triangles + 2 * self.quads)
        # Split by another program they are layers still.
        lines = self.path(name).read_text().splitlines()
        split = []
        for line in lines:
            a, b, c, d = line.split()[1:] if line.startswith("9 ") and len(line.split()) == 5 else [None] * 4
            split += [line] if a is None else [f"5 {a} {b} {c}", f"5 {a} {c} {d}"]
        text = "\n".join(split).replace(f"NELEM= {self.triangles + self.quads}", f"NELEM= {self.triangles + 2 * self.quads}")
        self.write("s.su2", text + "\n")
        self.refused("update", "s.su2", *update, names="triangles flatter than 20 to 1 on")
        self.succeed("update", "s.su2", *update, "--dissolve-layers")
        self.succeed("mesh", "naca:0012", "-o", "own.vtkhdf")
        self.refused("update", "own.vtkhdf", "naca:0013", "--dissolve-layers", "-o", "n.su2", names="--dissolve-layers: given for")

    def test_hostile_ones_are_refused_or_found_invalid(self):
        text, _, _ = shapes.layered(around=8, layers=1, rings=1)
        quad = next(line for line in text.splitlines() if line.startswith("9 "))
        a, b, c, d = quad.split()[1:]
        for found, replacement in (("an index below", f"9 {a} {b} {c} 999"), ("an element expected", f"9 {a} {b} {c}"),
                                   ("the index of a point expected", f"9 {a} {b} {c} -1"), ("found, only triangles", f"12 {a} {b} {c} {d}")):
            self.refused("check", self.write("h.su2", text.replace(quad, replacement)), names=found)
        for rule, replacement in (("index", f"9 {a} {b} {a} {b}"), ("index", f"9 {a} {a} {a} {a}"), ("convex", f"9 {a} {c} {b} {d}"),
                                  ("convex", f"9 {d} {c} {b} {a}"), ("boundary", f"5 {a} {b} {c}")):
            self.write("h.su2", text.replace(quad, replacement))
            checked = self.figures("check", "h.su2", status=1)
            self.assertIn(rule, {violation["rule"] for violation in checked["violations"]})
            for command in (["draw", "h.su2", "-o", "h.png"], ["convert", "h.su2", "-o", "h.msh"], ["flow", "h.su2", "--model", "potential"],
                            ["flow", "h.su2"], ["update", "h.su2", "naca:0012", "--boundary", "airfoil", "--dissolve-layers", "-o", "x.su2"]):
                self.assertIn(self.run_program(*command).status, (0, 1, 2), command)


class Chains(ProgramTest):
    """Updates of another program's mesh, each of which begins with the file that the one before it wrote."""

    STEPS = 24
    SHAPES = ("naca:0013", "naca:2412", "rae2822", "naca:4412", "naca:0012")

    def chain(self, end):
        self.succeed("mesh", "naca:0012", "--points", 100, "-o", "m.msh")
        self.write("bare.msh", "$MeshFormat" + self.path("m.msh").read_text().split("$MeshFormat")[1].split("$Comments")[0])
        name = f"x.{end}"
        edges, triangles = [], []
        for step in range(self.STEPS):
            mesh = "bare.msh" if step == 0 else name
            options = ["--boundary", "airfoil"] if step == 0 or end != "vtkhdf" else []
            figures = self.figures("update", mesh, self.SHAPES[step % len(self.SHAPES)], *options, "-o", name)
            triangles.append(figures["triangles"])
            edges.append(self.figures("check", name)["boundary"]["airfoil"])
        return edges, triangles

    def test_they_do_not_ratchet_in_any_format(self):
        for end in FORMATS:
            with self.subTest(end):
                edges, triangles = self.chain(end)
                self.assertLess(max(edges[12:]), 1.35 * edges[0], edges)
                self.assertLess(max(triangles[12:]), 1.35 * triangles[0], triangles)
