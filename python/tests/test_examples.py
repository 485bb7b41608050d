"""The scripts of examples/python do what they say, in small."""

import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

SOURCE = Path(os.environ.get("REMODEL_PYTHON_TEST_SOURCE", Path(__file__).resolve().parents[2]))
EXAMPLES = SOURCE / "examples/python"


def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_script_is_tested():
    here = Path(__file__).read_text()
    for script in EXAMPLES.glob("*.py"):
        assert script.stem in here, script


def test_a_polar_has_the_slope_of_thin_airfoils():
    rows = example("polar").main(angles=(0, 2), points=100)
    slope = np.polyfit(rows[:, 0], rows[:, 1], 1)[0]
    assert 1.0 < slope / (2 * np.pi**2 / 180 / np.sqrt(1 - 0.3**2)) < 1.2


def test_drag_falls_at_fixed_lift():
    pytest.importorskip("scipy")
    first, last, flows, area = example("drag_at_fixed_lift").main(points=60, evaluations=10)
    assert last < 0.8 * first and area > 99.99 and flows < 60


def test_the_same_under_openmdao():
    pytest.importorskip("openmdao.api").Problem
    first, last, flows, area = example("openmdao_slsqp").main(iterations=8, mesh={"points": 60})
    assert last < 0.7 * first and area > 0.9999 and flows < 40


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_results_come_back_from_a_pool(method):
    code = ("import process_pool, remodel\n"
            "if __name__ == '__main__':\n"
            f"    designs, results = process_pool.main({method!r}, count=20)\n"
            "    flow = remodel.solve_flow(remodel.generate(remodel.Airfoil('naca:0012').with_design(designs[7]), points=60), mach=0.5, alpha=1.0)\n"
            "    assert abs(results[7].cl - flow.cl) < 0.01, (results[7].cl, flow.cl)\n"
            "    assert len(results[7].mesh.points) == len(results[7].pressure)\n")  # fmt: skip
    script = Path(os.environ.get("PYTEST_TMPDIR", "/tmp")) / f"pool_{os.getpid()}_{method}.py"
    script.write_text(code)
    try:
        environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(EXAMPLES), *filter(None, sys.path)])}
        outcome = subprocess.run([sys.executable, script], env=environment, capture_output=True, text=True, timeout=240)
    finally:
        script.unlink()
    assert outcome.returncode == 0, outcome.stderr
    assert "20 of 20 flows" in outcome.stdout


def test_a_latin_hypercube_is_one_file(tmp_path):
    result = example("latin_hypercube").main(tmp_path / "flows.npz", sections=6, conditions=3, points=40)
    assert result.found == 18
    with np.load(tmp_path / "flows.npz") as arrays:
        assert arrays["outlines"].shape == (18, 100) and arrays["cp"].shape == (18, 100)
        assert np.isfinite(arrays["cl"]).all()
        lift = np.trapz(arrays["cp"][:, 50:] - arrays["cp"][:, :50], arrays["x"], axis=1)
        np.testing.assert_allclose(lift * np.cos(np.radians(arrays["alpha"])), arrays["cl"], atol=0.03)


def test_a_carried_state_leaves_little_to_do():
    pytest.importorskip("scipy")
    cold, carried, temperature, mesh = example("own_solver").main(designs=3)
    assert max(carried) < cold
    assert 0.0 <= temperature.min() and temperature.max() <= 1.0 + 1e-12  # the maximum principle of Delaunay meshes
    assert len(temperature) == len(mesh.points)


def test_a_function_of_ones_own_has_an_exact_gradient():
    value, gradient, difference = example("own_function").main()
    assert value > 0 and abs(gradient / difference - 1) < 1e-5
