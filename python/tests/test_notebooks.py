"""The notebooks run, say what they are to say, and are kept without what they printed."""

from __future__ import annotations

from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

FOLDER = Path(__file__).resolve().parents[1] / "notebooks"


def told(name: str, where: Path) -> str:
    """Runs a notebook in a folder. All that it printed; its pictures count as ``<image>``."""
    notebook = nbformat.read(FOLDER / name, as_version=4)
    for cell in notebook.cells:
        assert not cell.get("outputs"), "clear the outputs before keeping a notebook"
    NotebookClient(notebook, timeout=120, resources={"metadata": {"path": where}}).execute()
    texts = []
    for output in (output for cell in notebook.cells for output in cell.get("outputs", [])):
        data = output.get("data", {})
        texts.append(output.get("text", "") or data.get("text/plain", ""))
        texts.append("<image>" if "image/png" in data else "")
    return "\n".join(texts)


def test_a_study_is_loaded_and_drawn() -> None:
    text = told("load_a_study.ipynb", FOLDER)
    assert "300 cases" in text and "½ρgh²" in text
    assert text.count("<image>") == 1


def test_the_softest_wall_is_found(program: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SEAWALL_BIN", str(program))
    text = told("softest_wall.ipynb", tmp_path)
    assert "softest wall that keeps F* < 2" in text and "<image>" in text
