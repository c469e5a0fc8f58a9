"""Invariants of the program for any input: each is a function that checks an input given as bytes.

A test checks the inputs of tests/corpus, and tests/tools/fuzz.py searches for violations.
"""

import os
import resource
import tempfile
import tomllib
from collections.abc import Callable
from pathlib import Path

from harness import captured
from input_files import CONTENTS
from jkroll.cli.process import main
from jkroll.errors import JkrollError
from jkroll.materials.library import MaterialsFileError, is_material_name
from jkroll.quantities.nomenclature import INFINITY, NOMENCLATURE
from jkroll.quantities.units import MAX_TEXT, convert, dimension_of
from jkroll.quantities.values import QuantityError, parse_quantity, unit_of
from material_files import read

CORPUS = Path(__file__).parent / "corpus"
MATERIALS = tomllib.loads((CORPUS / "material_files.toml").read_text(encoding="utf-8"))
LONGEST_MESSAGE = 2000
CODES = (0, 1, 2)
TYPED = [name for name, quantity in NOMENCLATURE.items() if quantity.example and name != "material2"]


def is_one_line(message: str) -> bool:
    """Return whether a message can be shown unchanged: it is printable, not empty and not long."""
    return 0 < len(message) <= LONGEST_MESSAGE and message.isprintable()


def _text(data: bytes) -> str:
    """Decode an argument like the system: bytes that are not UTF-8 become lone surrogates."""
    return data.decode("utf-8", "surrogateescape")


def quantity(data: bytes) -> None:
    """Check that a text is a value in the quantity's range that reads back the same, or is refused in one line.

    The first byte chooses the quantity.
    """
    name = TYPED[data[0] % len(TYPED)] if data else "radius"
    text = _text(data[1:])
    try:
        value = parse_quantity(text, name)
    except QuantityError as error:
        assert is_one_line(str(error)), text
        return
    assert len(text) <= MAX_TEXT, text
    assert NOMENCLATURE[name].range.admits(value), text
    if value != INFINITY:
        unit = NOMENCLATURE[name].unit
        assert parse_quantity(f"{value!r} {'' if unit == '1' else unit}", name) == value, text


def unit(data: bytes) -> None:
    """Check that a text is a unit with a positive factor, or is refused in one line."""
    text = _text(data)
    try:
        of_text = unit_of(text, "pull_off_force")
    except QuantityError as error:
        assert is_one_line(str(error)), text
        return
    numerator, denominator, dimension = of_text
    assert min(numerator, denominator) > 0, text
    assert len(dimension) == len(dimension_of("1")), text
    assert convert(0.0, of_text) == 0, text
    assert convert(1.0, of_text) >= 0, text


def materials(data: bytes) -> None:
    """Check that a file gives materials with valid names and values in range, or is refused in one line."""
    with tempfile.NamedTemporaryFile(suffix=".toml") as file:
        file.write(data)
        file.flush()
        try:
            of_file = read(file.name)
        except MaterialsFileError as error:
            assert is_one_line(str(error)), data
            return
    for material in of_file:
        assert all(is_material_name(word) for word in (material.name, *material.aliases)), data
        assert material.title.isprintable(), data
        for name, value in material.properties.items():
            assert NOMENCLATURE[name].range.admits(value), data


def words(data: bytes) -> None:
    """Check the invariants of a command line whose words are separated by NUL; only the first twelve words count."""
    check_call([_text(word) for word in data.split(b"\0")[:12]])


def check_call(arguments: list[str]) -> int:
    """Run a command line in this process, check the invariants of all command lines, and return its exit code."""
    code, out, err = captured(arguments)
    lines = err.splitlines()
    if "--debug" in arguments and code:  # a traceback precedes the line
        lines = lines[-1:]
    errors = [line for line in lines if line.startswith("jkroll: ")]
    assert code in CODES, arguments
    assert all(
        line.startswith(("jkroll: ", "note: ", "warning: ", "assumed: ", "more: ", "read: ")) and line.isprintable()
        for line in lines
    ), (arguments, lines)
    assert bool(errors) == (code != 0), (arguments, code, lines)
    has_files = not {"batch", "fit"}.isdisjoint(arguments[:2])  # each file that fails has its own line
    assert len(errors) <= 1 or has_files, (arguments, lines)
    assert not any("this is a bug in jkroll" in line for line in errors), (arguments, lines)
    if code == JkrollError.exit_code:
        assert out == "", arguments
        assert lines == errors or "batch" in arguments, arguments  # notes on the tables precede the errors
    assert "\x1b" not in out, arguments
    return code


TARGETS: dict[str, Callable[[bytes], None]] = {
    "quantity": quantity,
    "unit": unit,
    "materials": materials,
    "words": words,
}


def kept(target: str) -> list[bytes]:
    """Return the inputs of a target in tests/corpus: the files of a folder or, for materials, entries of a table."""
    if target != "materials":
        return [path.read_bytes() for path in sorted((CORPUS / target).iterdir())]
    files = [entry["file"] for entry in MATERIALS["read"]]
    for entry in MATERIALS["refused"]:
        files += entry["files"]
    return [file.encode() for file in files]


# Links to devices, by the name of the link; command lines may name them as well as the files of input_files.py.
DEVICES = {
    "null": "null",
    "null.csv": "null",
    "zero": "zero",
    "zero.csv": "zero",
    "full.csv": "full",
    "full.svg": "full",
}
MOST_WRITTEN = 1_000_000  # bytes per file; beyond this, writing fails


def isolate(directory: str) -> None:
    """Hide the user's files and terminal from later calls, and confine the calls to a directory."""
    os.environ.update(XDG_CONFIG_HOME=directory, COLUMNS="80", TERM="dumb")
    for name in ("JKROLL_MATERIALS", "_JKROLL_COMPLETE", "FORCE_COLOR"):
        os.environ.pop(name, None)
    with open(os.devnull, encoding="utf-8") as nothing:
        os.dup2(nothing.fileno(), 0)
    inner = Path(directory, "with", "in")  # ../.. stays within the directory
    inner.mkdir(parents=True)
    os.chdir(inner)
    for name, content in CONTENTS.items():
        Path(name).write_bytes(content)
    for name, device in DEVICES.items():
        Path(name).symlink_to(f"/dev/{device}")
    assert main(["pull-off", "quartz,iron", "1nm:1um:3", "-o", "grains.parquet", "--quiet"]) == 0
    resource.setrlimit(resource.RLIMIT_FSIZE, (MOST_WRITTEN, resource.getrlimit(resource.RLIMIT_FSIZE)[1]))
