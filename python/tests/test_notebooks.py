"""The notebooks run from the first cell to the last, and end with a picture."""

import os
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
preprocessors = pytest.importorskip("nbconvert.preprocessors")
pytest.importorskip("ipykernel")

SOURCE = Path(os.environ.get("REMODEL_PYTHON_TEST_SOURCE", Path(__file__).resolve().parents[2]))
NOTEBOOKS = sorted((SOURCE / "python" / "notebooks").glob("*.ipynb"))


def pictures(cell):
    return [output for output in cell.get("outputs", []) if "image/png" in output.get("data", {})]


def test_there_are_six():
    assert len(NOTEBOOKS) == 6


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_runs(file, tmp_path, monkeypatch):
    monkeypatch.delenv("MPLBACKEND", raising=False)  # the kernel shows its pictures itself
    for table in file.parent.glob("*.csv"):
        (tmp_path / table.name).write_bytes(table.read_bytes())
    notebook = nbformat.read(file, 4)
    assert pictures(notebook.cells[-1]) and file.stat().st_size < 200_000
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs = []
    preprocessors.ExecutePreprocessor(timeout=300, kernel_name="python3").preprocess(notebook, {"metadata": {"path": str(tmp_path)}})
    assert pictures(notebook.cells[-1])
