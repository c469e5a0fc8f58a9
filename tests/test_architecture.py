"""The house: which part may know which, and what nobody may do."""

import ast
import inspect
import re
from pathlib import Path

import pytest

import jkroll
from jkroll.nomenclature import NOMENCLATURE
from jkroll.physics import FORMULAS
from jkroll.scene import DEFAULTS

SOURCE = Path(jkroll.__file__).parent
MODULES = sorted(SOURCE.rglob("*.py"))

# From the outside in: a module imports only from those below it.
LAYERS = [
    {"__main__"},
    {"cli"},
    {"shell"},
    {"tab"},
    {"completion", "help", "mistakes"},
    {"run_pictures"},
    {"run"},
    {"plots"},
    {"pictures"},
    {"sections"},
    {"curve", "terminal", "figures"},
    {"drawing"},
    {"on_axes"},
    {"charts"},
    {"maps"},
    {"batch"},
    {"request", "catalogue", "explain", "table", "verify", "bench"},
    {"spread"},
    {"report"},
    {"answer"},
    {"judgement", "ladder"},
    {"bench_measure"},
    {"bench_ways"},
    {"bench_forms", "bench_reference", "bench_scenes", "bench_bare"},
    {"solver"},
    {"options", "canvas"},
    {"commands", "streams", "axes", "files"},
    {"formatting", "scene"},
    {"materials"},
    {"materials_file"},
    {"wiring", "plain_toml"},
    {"units"},
    {"pint_names", "unit_table"},
    {"suggestions", "errors"},
    {"nomenclature"},
    {"claims", "physics"},
]
ONLY = {
    "typer": {"cli"},
    "rich": {"table"},
    "pint": {"pint_names"},
    "tomllib": {"materials_file", "plain_toml"},
    "mpmath": {"bench_reference"},
    "matplotlib": {"drawing"},
    "orjson": {"batch"},
    "pyarrow": {"batch"},
    "distributed": {"batch"},
    "zstandard": {"batch"},
}


def part(path: Path) -> str:
    """The part of the house that a file belongs to."""
    return path.relative_to(SOURCE).parts[0].removesuffix(".py")


def imports(path: Path) -> set[str]:
    """What a file imports when it is imported: absolute top-level names, and parts of the house as `.part`."""
    found: set[str] = set()
    inside_functions = {
        inner
        for outer in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(outer, ast.FunctionDef)
        for inner in ast.walk(outer)
    }
    names = {node.lineno for node in inside_functions if isinstance(node, ast.Import | ast.ImportFrom)}
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if getattr(node, "lineno", None) in names:
            continue
        if isinstance(node, ast.Import):
            found |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            found.add((node.module or "").split(".")[0])
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.add("." + node.module.split(".")[0])
        elif isinstance(node, ast.ImportFrom):
            found |= {"." + alias.name for alias in node.names}
    return found


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(SOURCE)))
def test_imports_point_inwards(path: Path) -> None:
    if part(path) == "physics":
        assert imports(path) <= {"math", "collections", "typing"} | {
            "." + name.stem for name in (SOURCE / "physics").glob("*.py")
        }
        return
    if path.name == "__init__.py":
        return
    depth = next(place for place, layer in enumerate(LAYERS) if part(path) in layer)
    for name in imports(path):
        if name.startswith("."):
            inner = next((place for place, layer in enumerate(LAYERS) if name[1:] in layer), len(LAYERS))
            assert inner > depth, f"{path.name} imports {name}"


@pytest.mark.parametrize("library", ONLY)
def test_one_module_knows_each_library(library: str) -> None:
    pattern = re.compile(rf"^\s*(import|from) {library}\b", re.MULTILINE)
    users = {part(path) for path in MODULES if pattern.search(path.read_text(encoding="utf-8"))}
    assert users == ONLY[library]


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(SOURCE)))
def test_a_file_is_short_enough_to_read(path: Path) -> None:
    assert len(path.read_text(encoding="utf-8").splitlines()) <= 300


def test_no_formula_has_a_default() -> None:
    for formula in FORMULAS.values():
        assert all(parameter.default is parameter.empty for parameter in inspect.signature(formula).parameters.values())


def test_defaults_are_named_inputs_with_an_option() -> None:
    assert all(NOMENCLATURE[name].option for name in DEFAULTS)


def test_the_top_level_holds_what_it_may() -> None:
    root = Path(__file__).parents[1]
    allowed = {"pyproject.toml", "src", "tests", "materials.toml", "README.md", "LICENSE"}
    assert {path.name for path in root.iterdir() if not path.name.startswith(".")} <= allowed
