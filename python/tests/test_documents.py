"""What the README shows in Python works."""

import os
import re
from pathlib import Path

SOURCE = Path(os.environ.get("REMODEL_PYTHON_TEST_SOURCE", Path(__file__).resolve().parents[2]))


def test_the_lines_of_the_readme(tmp_path, monkeypatch, capsys):
    blocks = re.findall(r"^```python\n(.*?)^```", (SOURCE / "README.md").read_text(), re.MULTILINE | re.DOTALL)
    assert len(blocks) == 1
    monkeypatch.chdir(tmp_path)
    exec(compile(blocks[0], "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert "design 10:" in printed and "tried:" in printed
    kept = [float(percent) for percent in re.findall(r"([\d.]+) % kept", printed)]
    assert len(kept) == 10 and min(kept) > 50
    assert float(re.search(r"off by at most (\S+)", printed)[1]) < 0.01
    assert (tmp_path / "thicker.su2").stat().st_size > 0
