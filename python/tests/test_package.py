"""A wheel, built from the tree and installed offline into a fresh environment."""

import os
import shutil
import subprocess
import sys
import zipfile
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


WHERE_FROM = """
import sys
sys.path.insert(0, sys.argv[1])
import remodel
mesh = remodel.generate("naca:0012", points=60)
assert mesh.update("naca:2412").triangles == len(mesh) and remodel.LivingFlow().solve(mesh, mach=0.3).converged
mesh.save(sys.argv[1] + "/mesh.vtkhdf")
assert len(remodel.Mesh.load(sys.argv[1] + "/mesh.vtkhdf")) == len(mesh)
print(*sorted({line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}), sep="\\n")
"""


def test_a_whole_wheel_brings_its_libraries_and_their_licences(tmp_path):
    """What it needs beside them are the C and C++ libraries alone; what it loads is its own."""
    missing = [tool for tool in ("patchelf", "dpkg", "objdump", "gcc") if shutil.which(tool) is None]
    if missing or "asan" in os.environ.get("LD_PRELOAD", ""):
        pytest.skip(f"no {', '.join(missing) or 'wheels of a sanitizer'}")
    plain, whole = tmp_path / "plain", tmp_path / "whole"
    run(sys.executable, "-m", "pip", "wheel", "--no-index", "--no-build-isolation", "--no-deps", "-w", plain, SOURCE, REMODEL_BUILD_DIRECTORY=BUILD)
    (wheel,) = plain.glob("*.whl")
    first = subprocess.run([SOURCE / "scripts/wheel", "--check", wheel], stdout=subprocess.PIPE, text=True)
    assert first.returncode == 1 and "libcairo.so" in first.stdout
    assert "libraries" in run(SOURCE / "scripts/wheel", "-o", whole, wheel)
    (wheel,) = whole.glob("remodel-*-manylinux_2_*.whl")
    assert "needs nothing but the C and C++ libraries" in run(SOURCE / "scripts/wheel", "--check", wheel)

    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path / "site")
    libraries = {file.name for file in (tmp_path / "site/remodel.libs").iterdir()}
    assert not any(name.startswith(("libcurl", "libssl", "libcrypto", "libgnutls")) for name in libraries)
    (bundled,) = (tmp_path / "site").glob("*.dist-info/licenses/BUNDLED.txt")
    packages = [line.split()[0] for line in bundled.read_text().splitlines() if ": " in line and line[0].islower()]
    assert len(packages) > 10 and all((bundled.parent / f"{package}.txt").stat().st_size > 200 for package in packages)
    loaded = [Path(name) for name in run(sys.executable, "-I", "-c", WHERE_FROM, tmp_path / "site").split()]
    ours = [path.name for path in loaded if path.parent.name == "remodel.libs"]
    assert set(ours) == libraries
    assert not [path for path in loaded if path.name.startswith(("libhdf5", "libcairo", "libsmumps", "libcurl")) and path.name not in ours]


def test_the_number_of_jobs_is_the_users(tmp_path, monkeypatch):
    """A CMake that writes down what it was asked for."""
    (tmp_path / "cmake").write_text(f"#!/bin/sh\necho \"$@\" >> {tmp_path}/asked\n")
    (tmp_path / "cmake").chmod(0o755)
    code = f"import sys; sys.path.insert(0, {str(SOURCE / 'python/build_backend')!r}); import cmake_backend; cmake_backend._built_module()"
    for level, expected in (("3", "--parallel 3"), ("", f"--parallel {len(os.sched_getaffinity(0))}")):
        subprocess.run([sys.executable, "-c", code], env={**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "REMODEL_BUILD_DIRECTORY": str(tmp_path), "CMAKE_BUILD_PARALLEL_LEVEL": level}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        assert (tmp_path / "asked").read_text().splitlines()[-1].endswith(expected)
