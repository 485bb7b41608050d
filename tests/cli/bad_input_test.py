"""Bad input: each case is refused with exit status 2 and one line that names the place; nothing is written."""

import json
import os
import resource
import stat
import subprocess
import unittest
from pathlib import Path

import shapes
from harness import ProgramTest, shared_file

BINARY = bytes(range(256)) * 16


class AirfoilFiles(ProgramTest):
    """Every subcommand that takes a SHAPE refuses the same files."""

    def refuse_shape(self, name, names=None):
        names = names or name
        self.refused("mesh", name, "-o", "out.su2", names=names)
        self.refused("fit", name, "-o", "out.json", names=names)
        self.refused("optimise", "--from", "naca:0012", "--to", name, "-o", "run", names=names)

    def refuse_content(self, content, name="shape.dat"):
        self.refuse_shape(self.write(name, content))

    def test_missing_file(self):
        self.refuse_shape("no-such-file.dat")

    def test_directory(self):
        self.path("shape.dat").mkdir()
        self.refuse_shape("shape.dat")

    def test_empty_file(self):
        self.refuse_content("")

    def test_header_alone(self):
        self.refuse_content("NACA 0012\n")

    def test_binary_file(self):
        self.refuse_content(BINARY)

    def test_truncated_after_the_upper_surface(self):
        lines = shapes.selig().splitlines()
        self.refuse_content("\n".join(lines[:22]) + "\n")

    def test_truncated_within_a_row(self):
        lines = shapes.selig().splitlines()
        self.refuse_content("\n".join(lines[:30] + [lines[30].split()[0]]))

    def test_truncated_lednicer(self):
        self.refuse_content("".join(shapes.lednicer().splitlines(keepends=True)[:30]))

    def test_not_a_number(self):
        self.refuse_content(shapes.with_row("0.5 nan"))

    def test_infinity(self):
        self.refuse_content(shapes.with_row("0.5 inf"))
        self.refuse_content(shapes.with_row("-inf 0.05"))

    def test_huge_number(self):
        self.refuse_content(shapes.with_row("0.5 1e300"))
        self.refuse_content(shapes.with_row("0.5 1e999"))

    def test_too_few_points(self):
        points = shapes.selig_points()
        self.refuse_content(shapes.text_of([points[0], points[20], points[-1]]))
        self.refuse_content(shapes.text_of(points[:1]))

    def test_one_point_many_times(self):
        self.refuse_content(shapes.text_of([(0.5, 0.0)] * 40))

    def test_crossing_surfaces(self):
        crossing = [(x, -y if 0.3 < x < 0.7 else y) for x, y in shapes.selig_points()]
        self.refuse_content(shapes.text_of(crossing))

    def test_wrong_header(self):
        self.refuse_content(shapes.lednicer().replace("21.  21.", "21.  30."))

    def test_words_between_the_points(self):
        self.refuse_content(shapes.with_row("lower surface 0.1"))

    def test_message_names_the_line(self):
        name = self.write("shape.dat", shapes.with_row("0.5 nan", index=10))
        self.assertIn("shape.dat:11", self.refused("mesh", name, names=name))

    def test_unknown_names(self):
        for name in ("naca:", "naca:12", "naca:00x2", "naca:999999", "rae9999"):
            with self.subTest(name):
                self.refuse_shape(name, names=name.removeprefix("naca:") or "NACA")
        self.refuse_shape("naca:0000", names="0000")  # no thickness


class CoefficientFiles(ProgramTest):
    GOOD = {"degree": 3, "upper": [0.17, 0.16, 0.14, 0.14], "lower": [-0.17, -0.16, -0.14, -0.14]}

    def refuse(self, content):
        name = self.write("shape.json", content if isinstance(content, (str, bytes)) else json.dumps(content))
        self.refused("mesh", name, "-o", "out.su2", names=name)
        self.refused("fit", name, "-o", "out.json", names=name)

    def test_the_good_one_is_accepted(self):
        self.write("good.json", json.dumps(self.GOOD))
        self.succeed("mesh", "good.json", "--points", 50)

    def test_no_json(self):
        for content in ("", BINARY, "{", json.dumps(self.GOOD)[:-20], "[1, 2]", "3"):
            with self.subTest(content[:20]):
                self.refuse(content)

    def test_missing_or_wrong_members(self):
        for change in (
            {"upper": None},
            {"upper": []},
            {"upper": ["a", 1, 2, 3]},
            {"upper": [0.1, 0.1, 0.1]},
            {"degree": 7},
        ):
            with self.subTest(change):
                self.refuse({**self.GOOD, **change})
        self.refuse({key: value for key, value in self.GOOD.items() if key != "lower"})

    def test_numbers_that_are_none(self):
        text = json.dumps(self.GOOD)
        for number in ("NaN", "Infinity", "1e999", "1e300"):
            with self.subTest(number):
                self.refuse(text.replace("0.17", number, 1))

    def test_a_design_that_crosses_itself_is_not_meshed(self):
        crossing = {**self.GOOD, "upper": [0.17, -0.9, 0.14, 0.14]}
        name = self.write("shape.json", json.dumps(crossing))
        self.refused("mesh", name, "-o", "out.su2", names="")
        self.refused("optimise", "--from", name, "--to", "naca:0012", "-o", "run", names="")


class Options(ProgramTest):
    def refuse(self, option, *values, command=("mesh", "naca:0012", "-o", "out.su2")):
        for value in values:
            with self.subTest(f"{option} {value}"):
                line = self.refused(*command, option, value, names=option)
                self.assertIn(str(value), line)
                self.assertIn("expected", line)

    def test_points(self):
        self.refuse("--points", 7, 6, 0, -200, 201, 100002, 1e300, "nan", "many", "8.5", "")

    def test_gradation(self):
        self.refuse("--gradation", 0, -1, 2e6, "nan", "inf", "1e300", "1e999", "x")

    def test_resolution(self):
        self.refuse("--resolution", 0, -1, "nan", "inf")

    def test_min_angle(self):
        self.refuse("--min-angle", 60, 34.1, -1, "nan", "inf")

    def test_max_gradation(self):
        self.refuse("--max-gradation", 0, -1, "nan", "inf")

    def test_farfield(self):
        self.refuse("--farfield-radius", 1, 0.5, -25, "nan", "inf", "1e300")
        self.refuse("--farfield-points", 7, 0, -50, 100001, "nan")

    def test_cst_degree(self):
        self.refuse("--cst-degree", 1, 13, -5, "5.5", "nan")
        self.refuse("--cst-degree", 1, 13, command=("fit", "naca:0012", "-o", "out.json"))

    def test_counts(self):
        self.refuse("--repeat", 0, -1, "nan")
        self.refuse("--max-vertices", 0, -1, "nan")
        self.refuse("--msh-version", 3, "2.1", "4")

    def test_optimise(self):
        run = ("optimise", "--from", "naca:0012", "--to", "rae2822", "-o", "run")
        self.refuse("--sigma", 0, -0.05, "nan", "inf", command=run)
        self.refuse("--evaluations", 0, -1, "nan", "1e4", command=run)
        self.refuse("--compare-every", -1, "x", command=run)
        self.refuse("--checkpoint-every", -1, "x", command=run)
        self.refuse("--seed", -1, "x", command=run)
        self.refuse("--distance", -1, "nan", "inf", command=run)
        self.refuse("--method", "fast", command=run)
        self.refuse("--strategy", "best", "Chain", "", command=run)
        self.refuse("--workers", 0, -1, 1001, "2.5", "x", command=run)
        self.refuse("--threads", 0, -1, 1001, "x", command=run)
        self.refuse("--points", 7, command=run)

    def test_study(self):
        study = ("study", "-o", "s")
        for option in ("--sigmas", "--distances", "--pairs", "--strategy"):
            self.refuse(option, "", ",", "1,,2", command=study)
        self.refuse("--sigmas", 0, "nan", "x", "0.1,0.10", command=study)
        self.refuse("--distances", -1, "nan", "1;2", command=study)
        self.refuse("--pairs", "6", "many", "50/1,50", command=study)
        self.refuse("--strategy", "hope", "chain,chain", command=study)
        # The message names the refused part.
        for option, value, part in (
            ("--sigmas", "0.1,-1", "'-1'"),
            ("--pairs", "51/1", "'51'"),
            ("--pairs", "50/0", "'0'"),
            ("--pairs", "50/", "''"),
            ("--pairs", "/1", "''"),
            ("--pairs", "50/1/2", "'1/2'"),
            ("--strategy", "chain,hope", "'hope'"),
        ):
            with self.subTest(f"{option} {value}"):
                self.assertIn(part, self.refused(*study, option, value, names=option))
        self.refuse("--scenarios", 0, 10000, "x", command=study)
        self.refuse("--evaluations", 0, "1e4", command=study)
        self.refuse("--compare-every", -1, command=study)
        self.refuse("--check-every", 0, "x", command=study)
        self.refuse("--validate-every", 0, command=study)
        self.refuse("--seed", -1, command=study)
        self.refuse("--threads", 0, 2000, "all", command=study)
        self.refuse("--time-limit", 0, "nan", command=study)
        self.refuse("--rank-timeout", 0, "x", command=study)
        self.refused("study", names="-o")
        self.refused("study", "-o", "s", "--airfoils", "rae2822,rae9999", names="rae9999")
        self.refused("study", "-o", "s", "--resume", names="s/study.sqlite")
        self.refused("study", "-o", "s", "--resume", "--full", names="--full")
        self.refused("study", "-o", "no/such/s", names="no/such/s")
        self.write("file", "text")
        self.refused("study", "-o", "file", names="file")
        self.path("thesis").mkdir()
        self.write("thesis/chapter1.tex", "years of work")
        self.refused("study", "-o", "thesis", names="thesis")
        self.refused("study", "-o", "thesis", "--resume", names="thesis")
        self.path("foreign").mkdir()
        self.write("foreign/study.sqlite", BINARY)
        self.refused("study", "-o", "foreign", "--resume", names="foreign/study.sqlite")
        self.write("foreign/study.sqlite", b"")
        self.refused("study", "-o", "foreign", "--resume", names="foreign/study.sqlite")

    def test_strategies_of_a_run_are_not_those_of_a_step(self):
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "a.vtkhdf")
        self.refuse("--strategy", "hub", "pool", "regenerate", "x", command=("update", "a.vtkhdf", "rae2822"))
        self.refused("update", "a.vtkhdf", "rae2822", "--workers", 2, names="--workers")
        self.refused(
            "optimise", "--mesh", "a.vtkhdf", "--to", "rae2822", "--strategy", "regenerate", "-o", "run",
            names="regenerate",
        )

    def test_batch(self):
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "a.vtkhdf")
        batch = ("batch", "a.vtkhdf", "rae2822", "-o", "out")
        self.refuse("--order", "farthest", "", command=batch)
        self.refuse("--meshes", "png", command=batch)
        self.refuse("--strategy", "pool", command=batch)
        self.refused("batch", "a.vtkhdf", "-o", "out", names="shapes")
        self.refused("batch", "a.vtkhdf", "rae2822", names="--output")
        self.refused("batch", "no.vtkhdf", "rae2822", "-o", "out", names="no.vtkhdf")
        self.refused("batch", "a.vtkhdf", "rae2822", "no.dat", "-o", "out", names="no.dat")
        self.refused("batch", "a.vtkhdf", "rae2822", "-o", "a.vtkhdf", names="a.vtkhdf")
        self.refused("batch", "a.vtkhdf", "rae2822", "-o", "no/out", names="no")
        # The second design is no domain: nothing is meshed, although the first one is.
        crossing = {"degree": 3, "upper": [0.17, -0.9, 0.14, 0.14], "lower": [-0.17, -0.16, -0.14, -0.14]}
        self.write("crossing.json", json.dumps(crossing))
        self.refused("batch", "a.vtkhdf", "rae2822", "crossing.json", "-o", "out", names="crossing.json")

    def test_draw(self):
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "a.vtkhdf")
        draw = ("draw", "a.vtkhdf", "-o", "a.png")
        self.refuse("--window", "1,2,3", "0,0,nan,1", "0,0,0,1", "1,0,0,1", "a,b,c,d", "", command=draw)
        self.refuse("--color", "red", command=draw)
        self.refuse("--width", 0, 100000, command=draw)
        self.refused("draw", "a.vtkhdf", "-o", "a.pdf", names="a.pdf")
        self.succeed("convert", "a.vtkhdf", "-o", "a.su2")
        self.refused("draw", "a.su2", "-o", "a.png", "--color", "gradation", names="a.su2")
        self.refused(*draw, "--color", "fate", names="--since")
        self.refused(*draw, "--since", "a.vtkhdf", names="--since")
        self.refused(*draw, "--color", "fate", "--since", "a.su2", names="fate")
        self.refused(*draw, "--color", "fate", "--since", "missing.vtkhdf", names="missing.vtkhdf")

    def test_film(self):
        self.succeed("optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 50, "--evaluations", 5, "-o", "run")
        film = ("film", "run", "-o", "a.webp")
        self.refuse("--frames", 0, 1, 10001, "x", command=film)
        self.refuse("--frame-ms", 0, 9, 60001, "x", command=film)
        self.refuse("--worker", 0, "x", command=film)
        self.refused(*film, "--worker", 2, names="worker")
        self.refuse("--window", "1,2,3", "1,0,0,1", command=film)
        self.refuse("--width", 0, 99, 8001, command=film)
        self.refused("film", "run", "-o", "a.gif", names="a.gif")
        self.refused("film", "missing", "-o", "a.webp", names="missing")
        self.refused("film", "run", "-o", "missing/a.webp", names="missing")
        self.refused("film", "run", names="-o")
        self.path("run/first.vtkhdf").unlink()
        self.refused(*film, names="first.vtkhdf")

    def test_unknown_arguments(self):
        self.refused(names="command line")
        self.assertNotIn("did you mean", self.refused("frobnicate", names="frobnicate"))
        self.refused("help", "frobnicate", names="frobnicate")
        self.refused("optimize", names="did you mean 'optimise'?")
        self.refused("mesh", "naca:0012", "--point", 100, names="did you mean '--points'?")
        self.refused("mesh", names="shape")
        self.refused("mesh", "naca:0012", "--frobnicate", names="--frobnicate")
        self.refused("mesh", "naca:0012", "surplus", names="surplus")
        self.refused("mesh", "naca:0012", "--points", names="--points")
        self.refused("mesh", "naca:0012", "--points", 50, "--points", 100, names="--points")
        self.refused("optimise", "--from", "naca:0012", "-o", "run", names="--to")

    def test_repeat_does_not_go_with_resume(self):
        self.refused(
            "optimise", "--from", "naca:0012", "--to", "rae2822", "-o", "run", "--resume", "--repeat", 2,
            names="--repeat",
        )


class MeshFiles(ProgramTest):
    FORMATS = ("vtkhdf", "su2", "msh", "vtu")

    def setUp(self):
        super().setUp()
        outputs = [word for format in self.FORMATS for word in ("-o", f"a.{format}")]
        self.succeed("mesh", "naca:0012", "--points", 50, *outputs)

    def refuse(self, name):
        self.refused("check", name, names=name)
        self.refused("convert", name, "-o", "out.su2", names=name)
        self.refused("draw", name, "-o", "out.png", names=name)

    def refuse_change(self, name, old, new):
        text = self.path(name).read_text()
        self.assertIn(old, text)
        self.refuse(self.write(f"changed{Path(name).suffix}", text.replace(old, new, 1)))

    def test_missing(self):
        for format in self.FORMATS:
            self.refuse(f"no-such-file.{format}")

    def test_directory(self):
        for format in self.FORMATS:
            self.path(f"dir.{format}").mkdir()
            self.refuse(f"dir.{format}")

    def test_empty_and_binary(self):
        for format in self.FORMATS:
            with self.subTest(format):
                self.refuse(self.write(f"empty.{format}", ""))
                self.refuse(self.write(f"binary.{format}", BINARY))

    def test_truncated(self):
        for format in self.FORMATS:
            content = self.path(f"a.{format}").read_bytes()
            for part in (0.1, 0.5, 0.9, 0.99):
                with self.subTest(f"{format} {part}"):
                    self.refuse(self.write(f"part.{format}", content[: int(part * len(content))]))

    def test_unknown_extension(self):
        self.write("a.stl", "solid\n")
        self.refuse("a.stl")
        self.refused("mesh", "naca:0012", "-o", "out.stl", names="out.stl")
        self.refused("mesh", "naca:0012", "-o", "out", names="out")
        self.refused("convert", "a.su2", "-o", "out.vtp", names="out.vtp")

    def test_wrong_content_for_the_extension(self):
        for source in self.FORMATS:
            for target in self.FORMATS:
                if source != target:
                    with self.subTest(f"{source} as {target}"):
                        self.refuse(self.write(f"as-{source}.{target}", self.path(f"a.{source}").read_bytes()))

    def test_wrong_header(self):
        self.refuse_change("a.su2", "NDIME", "NDIMS")
        self.refuse_change("a.msh", "4.1 ", "9.9 ")

    def test_numbers_out_of_range(self):
        """The first point's first coordinate, and the first triangle's first vertex."""
        lines = self.path("a.su2").read_text().splitlines()
        points = next(i for i, line in enumerate(lines) if line.startswith("NPOIN"))
        triangles = next(i for i, line in enumerate(lines) if line.startswith("NELEM"))
        for row, column, values in (
            (points + 1, 0, ("nan", "inf", "1e300", "1e999", "x")),
            (triangles + 1, 1, ("99999999", "-1", "1.5", "99999999999999999999")),
        ):
            for value in values:
                with self.subTest(value):
                    words = lines[row].split()
                    words[column] = value
                    changed = lines[:row] + [" ".join(words)] + lines[row + 1 :]
                    self.refuse(self.write("changed.su2", "\n".join(changed) + "\n"))

    def test_native_mesh_with_flipped_bytes_never_crashes(self):
        content = bytearray(self.path("a.vtkhdf").read_bytes())
        for position in range(0, len(content), max(1, len(content) // 60)):
            changed = bytearray(content)
            changed[position] ^= 0xFF
            self.write("flipped.vtkhdf", bytes(changed))
            outcome = self.run_program("check", "flipped.vtkhdf")
            self.assertIn(outcome.status, (0, 1, 2), f"byte {position}: {outcome}")

    def test_update_needs_the_boundary_of_a_foreign_mesh(self):
        for format in ("su2", "msh", "vtu"):
            self.refused("update", f"a.{format}", "rae2822", "-o", "out.su2", names=f"a.{format}")

    def test_update_needs_the_boundary_of_a_mesh_without_state(self):
        self.succeed("convert", "a.su2", "-o", "stateless.vtkhdf")
        self.refused("update", "stateless.vtkhdf", "rae2822", "-o", "out.su2", names="stateless.vtkhdf")

    def test_update_needs_the_boundary_of_the_shared_mesh(self):
        foreign = shared_file(self, "meshes/mesh_NACA0012_inv.su2")
        self.refused("update", foreign, "rae2822", "-o", "out.su2", names=foreign.name)

    def test_update_refuses_a_bad_shape(self):
        self.refused("update", "a.vtkhdf", "no-such-file", "-o", "out.vtkhdf", names="no-such-file")


def limit_file_size(size):
    def apply():
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    return apply


class Outputs(ProgramTest):
    MESHES = ("out.vtkhdf", "out.su2", "out.msh", "out.vtu")

    def refuse_outputs(self, prefix, **options):
        for name in self.MESHES:
            target = f"{prefix}{name}"
            with self.subTest(target):
                self.refused("mesh", "naca:0012", "--points", 100, "-o", target, names=name, **options)
        self.refused("fit", "naca:0012", "-o", f"{prefix}out.json", names="out.json", **options)
        for name in ("out.svg", "out.png"):
            self.refused("draw", "a.vtkhdf", "-o", f"{prefix}{name}", names=name, **options)

    def setUp(self):
        super().setUp()
        self.succeed("mesh", "naca:0012", "--points", 50, "-o", "a.vtkhdf")

    def test_missing_directory(self):
        self.refuse_outputs("no/such/directory/")
        self.refused(
            "optimise", "--from", "naca:0012", "--to", "rae2822", "-o", "no/such/run", names="no/such/run"
        )

    def test_directory_that_nobody_can_write(self):
        if not os.path.isdir("/proc/self"):
            self.skipTest("needs /proc")
        self.refuse_outputs("/proc/self/")
        self.refused("optimise", "--from", "naca:0012", "--to", "rae2822", "-o", "/proc/self/run", names="run")

    def test_directory_without_permission(self):
        if os.geteuid() == 0:
            self.skipTest("needs a user other than root: root may write everywhere")
        self.path("closed").mkdir(mode=stat.S_IRUSR | stat.S_IXUSR)
        self.refuse_outputs("closed/")

    def test_output_that_is_a_directory(self):
        for name in self.MESHES + ("out.json", "out.svg", "out.png"):
            self.path(name).mkdir()
        self.refuse_outputs("")

    def test_same_output_twice(self):
        self.refused("mesh", "naca:0012", "-o", "a.su2", "-o", "a.su2", names="a.su2")

    def test_existing_file_survives_a_full_disk(self):
        self.write("out.su2", "precious")
        self.refused(
            "mesh", "naca:0012", "--points", 100, "-o", "out.su2", names="out.su2", preexec_fn=limit_file_size(4096)
        )

    def test_file_size_limit(self):
        """A write beyond RLIMIT_FSIZE fails with EFBIG, which stands for a full disk here."""
        for name in self.MESHES:
            with self.subTest(name):
                self.refused(
                    "mesh", "naca:0012", "--points", 100, "-o", name, names=name, preexec_fn=limit_file_size(4096)
                )
        for name in ("out.svg", "out.png"):
            with self.subTest(name):
                self.refused("draw", "a.vtkhdf", "-o", name, names=name, preexec_fn=limit_file_size(1024))
        self.refused("fit", "naca:0012", "-o", "out.json", names="out.json", preexec_fn=limit_file_size(16))

    def test_full_disk(self):
        disk = self.path("disk")
        disk.mkdir()
        mount = subprocess.run(
            ["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", str(disk)], capture_output=True, check=False
        )
        if mount.returncode != 0:
            self.skipTest("needs the right to mount a small tmpfs")
        self.addCleanup(subprocess.run, ["umount", "-l", str(disk)], check=False)
        for name in self.MESHES:
            with self.subTest(name):
                self.refused("mesh", "naca:0012", "--points", 100, "-o", f"disk/{name}", names=name)
        (disk / "filler").write_bytes(b"x" * 12288)
        for name in ("out.svg", "out.png"):
            with self.subTest(name):
                self.refused("draw", "a.vtkhdf", "-o", f"disk/{name}", names=name)

    def test_run_on_a_full_disk(self):
        outcome = self.run_program(
            "optimise", "--from", "naca:0012", "--to", "rae2822", "--points", 50, "--evaluations", 20, "--quiet",
            "-o", "run", preexec_fn=limit_file_size(2048),
        )
        self.assertEqual(outcome.status, 2, outcome)
        self.assertEqual(len(outcome.stderr.splitlines()), 1, outcome)
        self.assertIn("run", outcome.stderr)
        left = {path.name for path in self.path("run").iterdir()} if self.path("run").exists() else set()
        self.assertLessEqual(left, {"history.sqlite"}, "partial or temporary files")

    def test_run_directory_with_other_files(self):
        self.path("thesis").mkdir()
        self.write("thesis/chapter1.tex", "years of work")
        self.refused("optimise", "--from", "naca:0012", "--to", "rae2822", "-o", "thesis", names="thesis")

    def test_run_directory_that_is_a_file(self):
        self.write("run", "text")
        self.refused("optimise", "--from", "naca:0012", "--to", "rae2822", "-o", "run", names="run")

    def test_resume_without_a_checkpoint(self):
        self.refused("optimise", "--from", "naca:0012", "--to", "rae2822", "-o", "run", "--resume", names="run")

    def test_devices_and_endless_pipes_are_not_read_as_meshes(self):
        os.symlink("/dev/zero", self.path("zero.su2"))
        os.symlink("/dev/zero", self.path("zero.vtkhdf"))
        for name in ("zero.su2", "zero.vtkhdf", "/dev/zero", "/dev/null"):
            self.refused("check", name, names="is a device, expected a file or a pipe")
        self.refused("update", "/dev/zero", "naca:0012", "-o", "b.vtkhdf", names="is a device")
        self.refused("mesh", "/dev/zero", "-o", "b.vtkhdf", names="/dev/zero")

    def test_standard_output_on_a_full_disk(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("needs /dev/full")
        with open("/dev/full", "wb") as full:
            self.refused("shapes", names="standard output", stdout=full)


