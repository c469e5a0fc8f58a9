"""The architecture: which part may import which, and rules for every file."""

import ast
import inspect
import json
import re
import shutil
import subprocess
import sys
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import mypy.api
import pytest

import jkroll
from jkroll.physics import FORMULAS
from jkroll.quantities.nomenclature import DEFAULTS, NOMENCLATURE
from tools.make_stub import stubs

SOURCE = Path(jkroll.__file__).parent
MODULES = sorted(SOURCE.rglob("*.py"))

# From the top down: a folder imports only from folders below it. Files outside of folders are the ground.
FOLDERS = "cli bench pictures tables write report fitting model materials quantities physics ground".split()
# Files of the ground that may import from all folders.
PUBLIC = {"__init__", "__main__", "formulas"}
# The folders that import each library.
ONLY = {
    "typer": {"cli"},
    "rich": {"write"},
    "pint": {"quantities"},
    "tomllib": {"materials"},
    "matplotlib": {"pictures"},
    "orjson": {"tables", "write"},
    "pyarrow": {"tables"},
    "distributed": {"tables"},
    "zstandard": {"tables"},
}

# Formulas of the paper that are steps of a derivation: `solve` does not need them; the guide lists them.
DERIVATION = {"pressure", "boussinesq_pressure_at_approach", "initial_angular_speed"}


def part(path: Path) -> str:
    """Return the folder of a file; "ground" for a file outside of folders."""
    inside = path.relative_to(SOURCE).parts
    return inside[0] if len(inside) > 1 else "ground"


@cache
def imports(path: Path) -> dict[str, str]:
    """Return the modules and names that a file imports when it runs, each with its folder ("" for a library)."""
    package = ["jkroll", *path.relative_to(SOURCE).parts[:-1]]
    found: dict[str, str] = {}
    tree = ast.parse(path.read_text(encoding="utf-8"))
    guarded = [
        node for node in ast.walk(tree) if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)
    ]
    for_types = {inner for outer in guarded for inner in ast.walk(outer)}
    for node in ast.walk(tree):
        if node in for_types:
            continue
        if isinstance(node, ast.Import):
            targets = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            start = package[: len(package) - node.level + 1] if node.level else []
            base = ".".join([*start, *filter(None, [node.module])])
            targets = [f"{base}.{alias.name}" for alias in node.names]
        else:
            continue
        for target in targets:
            found[target] = folder_of(target)
    return found


def folder_of(module: str) -> str:
    """Return the folder of an imported module; "" for a library."""
    top, *inside = module.split(".")
    if top != "jkroll":
        return ""
    return inside[0] if inside and (SOURCE / inside[0]).is_dir() else "ground"


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(SOURCE)))
def test_imports_point_downwards(path: Path) -> None:
    if path.stem in PUBLIC and part(path) == "ground":
        return
    depth = FOLDERS.index(part(path))
    for target, folder in imports(path).items():
        if folder:
            assert FOLDERS.index(folder) >= depth, f"{path.relative_to(SOURCE)} imports {target}"


def test_physics_imports_only_mathematics() -> None:
    for path in (SOURCE / "physics").glob("*.py"):
        foreign = {target.split(".")[0] for target, folder in imports(path).items() if not folder}
        assert foreign <= {"__future__", "math", "numpy", "collections", "typing"}, path.name


def test_there_is_no_cycle_of_imports() -> None:
    names = {".".join(["jkroll", *path.relative_to(SOURCE).with_suffix("").parts]): path for path in MODULES}
    names |= {name.removesuffix(".__init__"): path for name, path in names.items() if name.endswith(".__init__")}
    below: dict[Path, set[Path]] = {}
    for path in MODULES:
        if path.stem in PUBLIC and part(path) == "ground":
            continue
        known = (names.get(target) or names.get(target.rpartition(".")[0]) for target in imports(path))
        below[path] = {target for target in known if target not in (None, path)}
    while ends := {path for path, targets in below.items() if not targets & below.keys()}:
        below = {path: targets for path, targets in below.items() if path not in ends}
    assert not below


@pytest.mark.parametrize("library", ONLY)
def test_each_library_is_imported_only_in_its_folders(library: str) -> None:
    pattern = re.compile(rf"^\s*(import|from) {library}\b", re.MULTILINE)
    users = {part(path) for path in MODULES if pattern.search(path.read_text(encoding="utf-8"))}
    assert users == ONLY[library]


def test_no_private_name_of_a_library_is_imported() -> None:
    """The next version of a library may lack a private name."""
    for path in MODULES:
        libraries = [target for target, folder in imports(path).items() if not folder]
        assert [target for target in libraries if re.search(r"(^|\.)_(?!_)", target)] == [], path.name


def test_no_file_has_more_than_600_lines() -> None:
    lengths = {str(path.relative_to(SOURCE)): len(path.read_text(encoding="utf-8").splitlines()) for path in MODULES}
    assert {path: length for path, length in lengths.items() if length > 600} == {}


def test_no_parameter_of_a_formula_has_a_default() -> None:
    for formula in FORMULAS.values():
        assert all(parameter.default is parameter.empty for parameter in inspect.signature(formula).parameters.values())


def test_a_formula_is_a_quantity_or_a_step_of_the_derivation() -> None:
    assert FORMULAS.keys() - NOMENCLATURE.keys() == DERIVATION
    page = (SOURCE / "guide" / "python.md").read_text(encoding="utf-8")
    assert [name for name in DERIVATION if f"`{name}`" not in page] == []


def test_every_input_with_a_default_has_an_option() -> None:
    assert all(NOMENCLATURE[name].option for name in DEFAULTS)


def test_the_top_level_has_only_the_allowed_files_and_folders() -> None:
    root = Path(__file__).parents[1]
    allowed = {"pyproject.toml", "src", "tests", "materials.toml", "README.md", "LICENSE"}
    assert {path.name for path in root.iterdir() if not path.name.startswith(".")} <= allowed


# --- Types ------------------------------------------------------------------------------------------------------------

# The code of a user; a type checker must refuse its last four lines.
USER = """
import numpy
import jkroll
from jkroll.formulas import pull_off_force

radii = numpy.geomspace(1e-9, 1e-6, 4)
bare: float = float(pull_off_force(work_of_adhesion=0.05, reduced_radius=5e-8))
same: float = float(jkroll.formulas.pull_off_force(work_of_adhesion=0.05, reduced_radius=5e-8))
one = jkroll.solve("r_min", radius=1e-7)
reveal_type(one)
many = jkroll.solve("P_c", material="quartz", radius=radii)
reveal_type(many)
solids = jkroll.solve("P_c", material=["quartz", "iron"], radius=1e-7)
reveal_type(solids)
both = jkroll.solve(["r_min", "n_grav"], material="quartz", radius=1e-7)
reveal_type(both)
text = jkroll.solve("P_c", material="quartz", radius="100 nm")
reveal_type(text)
gamma = jkroll.infer("gamma", measured={"pull_off_force": 3e-7}, radius=2e-6)
reveal_type(gamma)
two = jkroll.infer(["gamma", "young"], measured={"pull_off_force": 3e-7, "stiffness": 1e3}, radius=2e-6)
size: float = two.condition
found = jkroll.answer("pull-off", material="quartz", radius="100 nm")
force: float = float(found["P_c"])
several = jkroll.answer("pull-off", material=["quartz", "iron"], radius=["100 nm", 1e-6])
strings: list[str] = [str(each["P_c"]) for each in several]
reveal_type(several["P_c"])
rounded: str = f"{found['P_c']:.3g} {found['P_c'].unit}"
names: list[str] = [name for name in found]
values: list[float] = [float(result) for _, result in found.items()]
codes: list[str] = [doubt.code for doubt in found.doubts]
low: float = found.best["pull_off_force"].low
numbers: dict[str, float | None] = found.to_dict()
columns = {"radius [nm]": radii, "material": ["quartz"] * 4}
forces = jkroll.table(columns, quantities=["P_c"], best=True)
reveal_type(forces)
known: jkroll.Materials = jkroll.Materials("mine.toml")
quartz: jkroll.Material = known["quartz"]
error: jkroll.Measured = jkroll.Measured(0.025, 0.005)
wide: jkroll.Interval = jkroll.Interval(0.025, 0.02, 0.03)
unit: str = jkroll.NOMENCLATURE["pull_off_force"].unit
jkroll.pull_of_force
pull_off_force(work_of_adhesion=0.05)
both.r_min
two.value
"""
REVEALED = (
    "float",
    "numpy.ndarray[tuple[Any, ...], numpy.dtype[numpy.float64]]",
    "numpy.ndarray[tuple[Any, ...], numpy.dtype[numpy.float64]]",
    "dict[str, float]",
    "Any",
    "float",
    "numpy.ndarray[tuple[Any, ...], numpy.dtype[numpy.float64]]",
    "dict[Any, Any]",
)


def test_the_stub_is_up_to_date() -> None:
    for path, text in stubs().items():
        assert path.read_text(encoding="utf-8") == text, "run tests/tools/make_stub.py"


@pytest.mark.slow
def test_mypy_infers_the_types_in_the_code_of_a_user(tmp_path: Path) -> None:
    (tmp_path / "user.py").write_text(USER, encoding="utf-8")
    out, _, _ = mypy.api.run(
        [str(tmp_path / "user.py"), "--strict", "--config-file=", "--follow-imports=silent", f"--cache-dir={tmp_path}"]
    )
    revealed = re.findall('Revealed type is "(.*)"', out)
    assert tuple(re.sub(r"builtins\.|typing\.", "", kind) for kind in revealed) == REVEALED, out
    wrong = [int(line.split(":")[1]) for line in out.splitlines() if "error: " in line]
    last = len(USER.splitlines())
    assert wrong == [last - 3, last - 2, last - 1, last], out


@pytest.mark.slow
@pytest.mark.skipif(find_spec("pyright") is None or shutil.which("node") is None, reason="needs pyright and node")
def test_pyright_infers_the_same_types_as_mypy(tmp_path: Path) -> None:
    """Without node on this machine, pyright would download it."""
    (tmp_path / "user.py").write_text(USER, encoding="utf-8")
    settings = {"extraPaths": [str(SOURCE.parent)], "typeCheckingMode": "strict"}
    (tmp_path / "pyrightconfig.json").write_text(json.dumps(settings), encoding="utf-8")
    line = [sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable, "user.py"]
    ran = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True)
    reported = json.loads(ran.stdout)["generalDiagnostics"]
    revealed = [
        re.sub('.* is "(.*)"', r"\1", each["message"]) for each in reported if each["severity"] == "information"
    ]
    assert revealed == [kind.replace("numpy.", "") for kind in REVEALED], ran.stdout
    wrong = {each["range"]["start"]["line"] for each in reported if each["severity"] != "information"}
    last = len(USER.splitlines())
    assert wrong == {*range(last - 4, last)}, ran.stdout


# --- Imports of the tests ---------------------------------------------------------------------------------------------


def modules_of_tests(path: Path) -> set[str]:
    """Return the modules and names that a test imports from jkroll, without this prefix, and modules imported whole."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module is not None and node.module.startswith("jkroll"):
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return {name.removeprefix("jkroll.") for name in found}


def test_a_test_imports_internal_names_of_one_folder_at_most() -> None:
    """A module is internal if no other folder of the program imports it. `tuning` may import from several folders."""
    names = {".".join(path.relative_to(SOURCE).with_suffix("").parts) for path in MODULES if part(path) != "ground"}
    fronts = {
        ".".join(target.split(".")[1:3]) for path in MODULES for target, folder in imports(path).items()
        if folder not in ("", part(path))
    }  # fmt: skip
    internal = {name for name in names - fronts if not name.endswith("__init__")}
    assert 10 < len(internal) < len(fronts)
    for path in Path(__file__).parent.rglob("*.py"):
        folders = {name.split(".")[0] for name in modules_of_tests(path) & internal}
        assert len(folders) <= 1 or path.name == "tuning.py", (path, folders)
