"""What the README shows in Python works."""

import os
import re
from pathlib import Path

import remodel

SOURCE = Path(os.environ.get("REMODEL_PYTHON_TEST_SOURCE", Path(__file__).resolve().parents[2]))


def blocks_of(document):
    return re.findall(r"^```python\n(.*?)^```", (SOURCE / document).read_text(), re.MULTILINE | re.DOTALL)


def blocks_of_readme():
    blocks = blocks_of("README.md")
    assert len(blocks) == 3
    return blocks


def test_values_of_a_flow_say_their_units_and_every_property_what_it_is():
    for name, of_stream in (("density", "the stream's"), ("velocity_x", "speed of sound"), ("velocity_y", "speed of sound"), ("pressure", "1 / 1.4 in the stream")):
        assert of_stream in getattr(remodel.FlowResult, name).__doc__
    for kind in (remodel.FlowResult, remodel.PotentialFlow, remodel.CheckResult, remodel.Changes, remodel.Violation):
        for name, member in vars(kind).items():
            assert not isinstance(member, property) or (member.__doc__ or "").strip(), f"{kind.__name__}.{name}"


def test_the_loop_of_the_page_on_python_loses_drag(capsys):
    exec(compile(blocks_of("docs/python.md")[0], "python.md", "exec"), {})
    counts = [float(line.split()[0]) for line in capsys.readouterr().out.splitlines()]
    assert len(counts) == 3 and counts[2] < counts[1] < counts[0]


def test_the_lines_of_the_page_on_sweeps(capsys):
    exec(compile(blocks_of("docs/sweep.md")[1], "sweep.md", "exec"), {})
    assert "found=4" in capsys.readouterr().out


def test_the_lines_of_the_tutorial(capsys):
    (lines,) = blocks_of("docs/tutorial.md")
    exec(compile(lines, "tutorial.md", "exec"), {})
    lifts = [float(line.split()[1]) for line in capsys.readouterr().out.splitlines()]
    assert len(lifts) == 3 and lifts == sorted(lifts)  # more camber, more lift
    assert 0.1 < lifts[0] < 0.16


def test_the_first_lines_of_the_readme_end_in_a_drag_and_its_gradient(capsys):
    names = {}
    exec(compile(blocks_of_readme()[0], "README.md", "exec"), names)
    printed = capsys.readouterr().out
    assert float(re.search(r"drag: (\S+) counts", printed)[1]) > 0.0
    # The gradient is that of whole flows along one coefficient, whose mesh moves its walls alone.
    remodel, mesh, flow = names["remodel"], names["mesh"], names["flow"]
    gradient = mesh.vjp(flow.gradients()["cd"]["points"])
    airfoil, step, drags = remodel.Airfoil("rae2822"), 1e-5, []
    for sign in (-1, 1):
        design = airfoil.design.copy()
        design[3] += sign * step
        moved = mesh.copy()
        assert moved.update(airfoil.with_design(design)).full_adjustment
        drags.append(flow.solve(moved, mach=0.75, alpha=1.0).cd)
    assert abs((drags[1] - drags[0]) / (2 * step) / gradient[3] - 1) < 1e-3


def test_the_readmes_flow_with_friction_outlives_its_mesh(capsys):
    exec(compile(blocks_of_readme()[1], "README.md", "exec"), {})
    pressure, friction, start, by_reynolds = capsys.readouterr().out.split()
    assert 0.01 < float(pressure) < 0.05 and 0.02 < float(friction) < 0.06
    assert start != "cold" and float(by_reynolds) < 0.0


def test_the_lines_of_the_readme(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    exec(compile(blocks_of_readme()[2], "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert "design 10:" in printed and "tried:" in printed
    kept = [float(percent) for percent in re.findall(r"([\d.]+) % kept", printed)]
    assert len(kept) == 10 and min(kept) > 50
    assert float(re.search(r"off by at most (\S+)", printed)[1]) < 0.01
    assert (tmp_path / "thicker.su2").stat().st_size > 0
