"""The pages for Python on the site: a notebook of `guide python`, run by Jupyter, and a reference of public names."""

import importlib.util
import inspect
import re
from pathlib import Path
from typing import Any

import pytest

import jkroll

MAKER = Path(__file__).parents[1] / ".docs" / "python_pages.py"
pytestmark = pytest.mark.skipif(not MAKER.exists(), reason="the sdist has no .docs")


def maker() -> Any:
    """Return the module that makes the notebook and the reference."""
    spec = importlib.util.spec_from_file_location("python_pages", MAKER)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def page() -> str:
    """Return the page `guide python`."""
    return (Path(jkroll.__file__).parent / "guide" / "python.md").read_text(encoding="utf-8")


def test_a_cell_ends_where_the_page_shows_a_value() -> None:
    code = ">>> a = 1\n>>> b = [a,\n...      2]\n>>> b\n[1, 2]\n>>> print(b)\n[1, 2]\n\n"
    text = f"# Title\n\nText.\n\n```python\n{code}```\n\nEnd.\n"
    cells = [*maker().cells_of(text)]
    assert cells[0] == ("# Title\n\nText.", None)
    assert cells[1:3] == [("a = 1\nb = [a,\n     2]\nb", "[1, 2]\n"), ("b", "[1, 2]\n")]
    assert cells[3:] == [("End.", None)]


def test_the_notebook_has_all_headings_of_the_page_and_cells_of_code() -> None:
    cells = maker().notebook(page())["cells"]
    texts = "\n".join(cell["source"] for cell in cells if cell["cell_type"] == "markdown")
    headings = [line for line in page().splitlines() if line.startswith("#")]
    assert [line for line in texts.splitlines() if line.startswith("#")] == headings
    assert sum(cell["cell_type"] == "code" for cell in cells) > 20
    assert len({cell["id"] for cell in cells}) == len(cells)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # from Jupyter
def test_jupyter_shows_the_outputs_of_the_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    monkeypatch.setenv("PYTHONPATH", str(Path(jkroll.__file__).parents[1]))
    made = nbformat.from_dict(maker().notebook(page()))
    nbformat.validate(made)
    run = nbclient.NotebookClient(made, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    wanted = [cell.shown for cell in maker().cells_of(page()) if cell.shown is not None]
    cells = [cell for cell in run.cells if cell.cell_type == "code"]
    for cell, shown in zip(cells, wanted, strict=True):
        assert "".join(map(text_of, cell.outputs)).split() == shown.split(), cell.source  # line breaks differ
    kinds = {kind for cell in cells for output in cell.outputs for kind in output.get("data", {})}
    assert {"text/html", "text/latex", "image/png"} <= kinds


def text_of(output: Any) -> str:
    """Return the text of an output of a cell."""
    return str(output.text if output.output_type == "stream" else output.data["text/plain"])


# --- The reference ----------------------------------------------------------------------------------------------------


def test_the_reference_has_every_public_name() -> None:
    text = maker().reference()
    named = {
        *re.findall(r"^### `jkroll\.(\w+)`$", text, re.MULTILINE),
        *re.findall(r"^- `jkroll\.(\w+)`", text, re.MULTILINE),
    }
    assert named == {*dir(jkroll)}
    kinds = {*re.findall(r"^ *- `(\w+)`: ", text.partition("## Errors")[2], re.MULTILINE)}
    for name in dir(jkroll):
        doc = inspect.getdoc(getattr(jkroll, name)) or ""
        raised = re.findall(r"^([A-Z]\w+(?:, [A-Z]\w+)*)(?:;.*)?$", doc.partition("Raises\n---")[2], re.MULTILINE)
        assert {kind for line in raised for kind in line.split(", ")} <= kinds, name


def test_functions_have_arguments_and_returns_in_the_reference() -> None:
    sections = maker().reference().partition("## Classes")[0].split("### `jkroll.")[1:]
    assert len(sections) > 8
    for section in sections:
        name = section.partition("`")[0]
        parameters = inspect.signature(getattr(jkroll, name)).parameters
        assert f"jkroll.{name}(" in section
        assert [each for each in parameters if not re.search(rf"^- `[^`]*\b{each}\b", section, re.MULTILINE)] == []
        assert not parameters or ("**Returns**" in section and "**Raises**" in section), name


def test_every_formula_has_its_units_in_the_reference() -> None:
    text = maker().reference()
    rows = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", text, re.MULTILINE))
    assert rows.keys() == jkroll.FORMULAS.keys()
    taken, given, equation, source, valid = rows["pull_off_force"].split(" | ")
    assert (taken, given) == ("work_of_adhesion [J/m^2], reduced_radius [m]", "N")
    assert (equation, source) == ("P_c = 3πγR = (3/2)πwR", "Eq (1).")
    assert valid.startswith("Large, soft spheres")
    assert not [name for name, row in rows.items() if "" in row.split(" | ")[:3]]
