"""A wheel, built from the tree and installed offline into a fresh environment."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

SOURCE = Path(os.environ.get("REMODEL_PYTHON_TEST_SOURCE", Path(__file__).resolve().parents[2]))
BUILD = os.environ.get("REMODEL_PYTHON_TEST_BUILD", "")

SCRIPT = """
import remodel, sys
assert remodel.__file__.startswith(sys.prefix), remodel.__file__
mesh = remodel.generate("naca:0012", points=60)
assert mesh.update("naca:2412").triangles == len(mesh) and mesh.check().valid
"""


def run(*command, **environment):
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | environment
    process = subprocess.run([str(part) for part in command], env=clean, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert process.returncode == 0, process.stdout
    return process.stdout


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    if subprocess.run([sys.executable, "-c", "import venv, ensurepip"], stderr=subprocess.DEVNULL).returncode != 0:
        pytest.skip("no python3-venv")
    directory = tmp_path_factory.mktemp("environment")
    run(sys.executable, "-m", "venv", "--system-site-packages", directory)
    python = directory / "bin" / "python"
    run(python, "-m", "pip", "install", "--no-index", "--no-build-isolation", "--no-deps", SOURCE, REMODEL_BUILD_DIRECTORY=BUILD)
    return python


def test_the_installed_package_works(environment, tmp_path):
    (tmp_path / "script.py").write_text(SCRIPT)
    run(environment, tmp_path / "script.py")


def test_the_installed_package_passes_the_tests(environment):
    tests = [SOURCE / "python" / "tests" / f"test_{name}.py" for name in ("shapes", "mesh", "files")]
    assert " passed" in run(environment, "-m", "pytest", "-q", "-p", "no:cacheprovider", *tests)


def test_pip_knows_its_version(environment):
    assert "Version: " in run(environment, "-m", "pip", "show", "remodel")
