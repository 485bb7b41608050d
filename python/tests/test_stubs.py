"""The type stubs say what is there, and a type checker accepts them."""

import importlib.util
import inspect
import os
import subprocess
import sys
from pathlib import Path

import pytest
import remodel

PACKAGE = Path(remodel.__file__).parent

USER = """
import numpy as np
import remodel

airfoil = remodel.Airfoil("naca:0012")
mesh: remodel.Mesh = remodel.generate(airfoil, points=100)
step: remodel.Step = mesh.update(airfoil.with_design(1.01 * airfoil.design), record=True)
kept: float = step.preserved_percent
ride: np.ndarray = step.transfer.ride(mesh.points[:, 0])
with mesh.trial(airfoil) as trial:
    trial.keep()
reveal_type(mesh.points)
"""


def test_every_name_has_a_stub_and_a_docstring():
    stub = (PACKAGE / "__init__.pyi").read_text()
    for name in remodel.__all__:
        if name == "__version__":
            continue
        thing = getattr(remodel, name)
        assert inspect.getdoc(thing), name
        assert f"class {name}" in stub or f"def {name}(" in stub, name
        if inspect.isclass(thing) and name not in ("OptimiseResult",):
            body = stub.split(f"class {name}", 1)[1].split("\nclass ", 1)[0]
            for member in vars(thing):
                if not member.startswith("_"):
                    assert f"def {member}(" in body or f"    {member}:" in body, f"{name}.{member}"


def test_a_type_checker_accepts_them(tmp_path):
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("no mypy")
    (tmp_path / "user.py").write_text(USER)
    (tmp_path / "wrong.py").write_text("import remodel\nremodel.generate(7)\nremodel.Mesh.nothing\n")
    environment = {**os.environ, "MYPYPATH": str(PACKAGE.parent)}
    environment.pop("LD_PRELOAD", None)

    def mypy(*files):
        command = [sys.executable, "-m", "mypy", "--cache-dir", str(tmp_path / "cache"), *map(str, files)]
        return subprocess.run(command, env=environment, stdout=subprocess.PIPE, text=True, cwd=tmp_path)

    result = mypy(tmp_path / "user.py")
    assert result.returncode == 0 and "ndarray" in result.stdout, result.stdout
    wrong = mypy(tmp_path / "wrong.py")
    assert wrong.returncode == 1 and "generate" in wrong.stdout and "nothing" in wrong.stdout, wrong.stdout
