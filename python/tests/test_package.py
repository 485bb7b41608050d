"""A wheel, built from the tree and installed offline into a fresh environment."""

import os
import shutil
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
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | {name: str(value) for name, value in environment.items()}
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


def test_pip_knows_what_it_is(environment):
    shown = run(environment, "-m", "pip", "show", "-v", "remodel")
    for line in ("Version: ", "Summary: Quality triangular meshes", "Author: The Remodel authors", "License: MIT", "Requires: numpy", "Typing :: Typed", "License :: OSI Approved :: MIT License"):
        assert line in shown, line
    code = "import importlib.metadata as m; d = m.metadata('remodel'); print(d['Keywords'], d['Description-Content-Type'], len(d.get_payload()), d['Requires-Python'])"
    keywords, kind, size, least = run(environment, "-c", code).split()
    assert "mesh" in keywords.split(",") and kind == "text/markdown" and int(size) > 1000 and least == ">=3.9"


def test_an_editable_install_works_and_a_failed_one_leaves_the_good_one(environment, tmp_path):
    source = tmp_path / "source"  # an editable install writes a link beside the sources
    for part in ("python/remodel", "python/build_backend", "include/remodel", "pyproject.toml", "README.md", "LICENSE"):
        (source / part).parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (SOURCE / part).is_dir() else shutil.copy)(SOURCE / part, source / part)
    (tmp_path / "script.py").write_text(SCRIPT.replace("assert remodel.__file__.startswith(sys.prefix), remodel.__file__\n", ""))
    install = [environment, "-m", "pip", "install", "--no-index", "--no-build-isolation", "--no-deps", "-e", source]
    with pytest.raises(AssertionError, match="ended with status|found no"):
        run(*install, REMODEL_BUILD_DIRECTORY=tmp_path / "nothing")
    run(environment, tmp_path / "script.py")
    assert "site-packages" in run(environment, "-c", "import remodel; print(remodel.__file__)")
    run(*install, REMODEL_BUILD_DIRECTORY=BUILD)
    run(environment, tmp_path / "script.py")
    assert str(source) in run(environment, "-c", "import remodel; print(remodel.__file__)")
    (source / "python/remodel/__init__.py").open("a").write("\nedited = True\n")
    assert run(environment, "-c", "import remodel; print(remodel.edited)").strip() == "True"
    run(environment, "-m", "pip", "uninstall", "-y", "remodel")
    run(environment, "-c", "import importlib.util as i; assert i.find_spec('remodel') is None")


def test_the_number_of_jobs_is_the_users(tmp_path, monkeypatch):
    """A CMake that writes down what it was asked for."""
    (tmp_path / "cmake").write_text(f"#!/bin/sh\necho \"$@\" >> {tmp_path}/asked\n")
    (tmp_path / "cmake").chmod(0o755)
    code = f"import sys; sys.path.insert(0, {str(SOURCE / 'python/build_backend')!r}); import cmake_backend; cmake_backend._built_module()"
    for level, expected in (("3", "--parallel 3"), ("", f"--parallel {len(os.sched_getaffinity(0))}")):
        subprocess.run([sys.executable, "-c", code], env={**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "REMODEL_BUILD_DIRECTORY": str(tmp_path), "CMAKE_BUILD_PARALLEL_LEVEL": level}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        assert (tmp_path / "asked").read_text().splitlines()[-1].endswith(expected)
