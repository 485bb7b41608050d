"""The type stubs say what is there, and a type checker accepts them."""

import ast
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


def stubbed(function, method):
    """Names, kinds and defaults of a function in the stubs."""
    a = function.args
    positional = (a.posonlyargs + a.args)[1 if method else 0 :]
    defaults = [None] * (len(positional) - len(a.defaults)) + a.defaults
    rows = [(p.arg, False, d) for p, d in zip(positional, defaults)] + [(p.arg, True, d) for p, d in zip(a.kwonlyargs, a.kw_defaults)]
    return [(name, keyword, d is not None) for name, keyword, d in rows], {name: ast.literal_eval(d) for name, _, d in rows if d is not None and not (isinstance(d, ast.Constant) and d.value is ...)}


def test_the_stubs_have_the_signatures_that_there_are():
    tree, checked = ast.parse((PACKAGE / "__init__.pyi").read_text()), 0
    for node in tree.body:
        members = [(None, node)] if isinstance(node, ast.FunctionDef) else [(node.name, m) for m in getattr(node, "body", []) if isinstance(m, ast.FunctionDef)]
        for owner, function in members:
            thing = getattr(remodel, owner, None) if owner else remodel
            name = function.name
            if thing is None or function.decorator_list and ast.unparse(function.decorator_list[0]) == "property" or name.startswith("__") and name != "__init__":
                continue
            call = vars(thing)[name] if owner else getattr(thing, name)
            static = isinstance(call, staticmethod)
            signature = inspect.signature(call.__func__ if static else call)
            parameters = [p for p in signature.parameters.values() if p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]
            parameters = parameters[1:] if owner and not static else parameters
            expected, defaults = stubbed(function, owner and not static)
            found = [(p.name, p.kind is p.KEYWORD_ONLY, p.default is not p.empty) for p in parameters]
            assert found == expected, f"{owner}.{name}"
            for p in parameters:
                assert p.name not in defaults or p.default == defaults[p.name], f"{owner}.{name}({p.name})"
            checked += 1
    assert checked > 50


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
