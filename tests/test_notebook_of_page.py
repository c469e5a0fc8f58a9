"""The notebook of the page on Python, run by Jupyter: it shows what the page does."""

import importlib.util
from pathlib import Path
from typing import Any

import pytest

import jkroll

MAKER = Path(__file__).parents[1] / ".docs" / "notebook.py"
pytestmark = pytest.mark.skipif(not MAKER.exists(), reason="the sdist has no .docs")


def maker() -> Any:
    """Return the module that makes a notebook."""
    spec = importlib.util.spec_from_file_location("notebook", MAKER)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def page() -> str:
    """Return the page."""
    return (Path(jkroll.__file__).parent / "guide" / "python.md").read_text(encoding="utf-8")


def test_a_cell_ends_where_the_page_shows_a_value() -> None:
    code = ">>> a = 1\n>>> b = [a,\n...      2]\n>>> b\n[1, 2]\n>>> print(b)\n[1, 2]\n\n"
    text = f"# Title\n\nText.\n\n```python\n{code}```\n\nEnd.\n"
    cells = [*maker().cells_of(text)]
    assert cells[0] == ("# Title\n\nText.", None)
    assert cells[1:3] == [("a = 1\nb = [a,\n     2]\nb", "[1, 2]\n"), ("b", "[1, 2]\n")]
    assert cells[3:] == [("End.", None)]


def test_the_notebook_has_all_of_the_page() -> None:
    cells = maker().notebook(page())["cells"]
    texts = "\n".join(cell["source"] for cell in cells if cell["cell_type"] == "markdown")
    headings = [line for line in page().splitlines() if line.startswith("#")]
    assert [line for line in texts.splitlines() if line.startswith("#")] == headings
    assert sum(cell["cell_type"] == "code" for cell in cells) > 20
    assert len({cell["id"] for cell in cells}) == len(cells)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # of Jupyter
def test_jupyter_shows_what_the_page_shows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    monkeypatch.setenv("PYTHONPATH", str(Path(jkroll.__file__).parents[1]))
    made = nbformat.from_dict(maker().notebook(page()))
    nbformat.validate(made)
    run = nbclient.NotebookClient(made, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    wanted = [cell.shown for cell in maker().cells_of(page()) if cell.shown is not None]
    cells = [cell for cell in run.cells if cell.cell_type == "code"]
    for cell, shown in zip(cells, wanted, strict=True):
        assert "".join(map(text_of, cell.outputs)).split() == shown.split(), cell.source  # lines break elsewhere
    kinds = {kind for cell in cells for output in cell.outputs for kind in output.get("data", {})}
    assert {"text/html", "text/latex", "image/png"} <= kinds


def text_of(output: Any) -> str:
    """Return the text of an output of a cell."""
    return str(output.text if output.output_type == "stream" else output.data["text/plain"])
