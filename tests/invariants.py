"""What holds of any input whatever, as functions of bytes: replayed from tests/corpus by a test, searched by tests/tools/fuzz.py."""

import io
import os
import tempfile
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

from jkroll.errors import JkrollError, MaterialsFileError, QuantityError
from jkroll.materials import is_material_name, read
from jkroll.nomenclature import INFINITY, NOMENCLATURE, RANGES
from jkroll.shell import main
from jkroll.units import MAX_TEXT, convert, dimension_of, parse_quantity, unit_of

CORPUS = Path(__file__).parent / "corpus"
LONGEST_MESSAGE = 2000
CODES = (0, 1, 2)
TYPED = [name for name, quantity in NOMENCLATURE.items() if quantity.example and name != "material2"]


def is_one_line(message: str) -> bool:
    """Whether a message can be shown as it is: printable, not empty, not long."""
    return 0 < len(message) <= LONGEST_MESSAGE and message.isprintable()


def _text(data: bytes) -> str:
    """The text of an argument as the system hands it over: bytes that are no UTF-8 become lone surrogates."""
    return data.decode("utf-8", "surrogateescape")


def quantity(data: bytes) -> None:
    """A text is a value in the range of its quantity that reads back the same, or it is refused in one line."""
    name = TYPED[data[0] % len(TYPED)] if data else "radius"
    text = _text(data[1:])
    try:
        value = parse_quantity(text, name)
    except QuantityError as error:
        assert is_one_line(str(error)), text
        return
    limits = RANGES.get(NOMENCLATURE[name].range)
    assert len(text) <= MAX_TEXT, text
    assert limits is None or limits.admits(value), text
    if value != INFINITY:
        unit = NOMENCLATURE[name].unit
        assert parse_quantity(f"{value!r} {'' if unit == '1' else unit}", name) == value, text


def unit(data: bytes) -> None:
    """A text is a unit that is a positive ratio, or it is refused in one line."""
    text = _text(data)
    try:
        found = unit_of(text, "pull_off_force")
    except QuantityError as error:
        assert is_one_line(str(error)), text
        return
    assert found.numerator > 0, text
    assert found.denominator > 0, text
    assert len(found.dimension) == len(dimension_of("1")), text
    assert convert(0.0, found) == 0, text
    assert convert(1.0, found) >= 0, text


def materials(data: bytes) -> None:
    """A file is materials that can be named and lie in their ranges, or it is refused in one line."""
    with tempfile.NamedTemporaryFile(suffix=".toml") as file:
        file.write(data)
        file.flush()
        try:
            found = read(file.name)
        except MaterialsFileError as error:
            assert is_one_line(str(error)), data
            return
    for material in found:
        assert all(is_material_name(word) for word in (material.name, *material.aliases)), data
        assert material.title.isprintable(), data
        for name, value in material.properties.items():
            assert RANGES[NOMENCLATURE[name].range].admits(value), data


def words(data: bytes) -> None:
    """Words parted by NUL end with a documented code; a wrong usage prints nothing but one line of error."""
    check_call([_text(word) for word in data.split(b"\0")][:12])


def check_call(arguments: list[str]) -> int:
    """Run a command line in this process, check what every one keeps to, and return its exit code."""
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8", newline="") for _ in range(2))
    with redirect_stdout(out), redirect_stderr(err):
        code = main(arguments)
    said, complained = (_written(stream) for stream in (out, err))
    lines = complained.splitlines()
    if "--debug" in arguments[:1] + arguments[-1:] and code:  # a traceback stands before the line
        lines = lines[-1:]
    errors = [line for line in lines if line.startswith("jkroll: ")]
    assert code in CODES, arguments
    assert all(line.startswith(("jkroll: ", "note: ")) and line.isprintable() for line in lines), (arguments, lines)
    assert len(errors) == (code != 0), (arguments, code, lines)
    if code == JkrollError.exit_code:
        assert said == "", arguments
        assert lines == errors, arguments
    assert "\x1b" not in said, arguments
    return code


def _written(stream: io.TextIOWrapper) -> str:
    stream.flush()
    assert isinstance(stream.buffer, io.BytesIO)
    return stream.buffer.getvalue().decode("utf-8")


TARGETS: dict[str, Callable[[bytes], None]] = {
    "quantity": quantity,
    "unit": unit,
    "materials": materials,
    "words": words,
}


def isolate(directory: str) -> None:
    """Keep the user's own files and terminal out of what follows."""
    os.environ.update(XDG_CONFIG_HOME=directory, COLUMNS="80", TERM="dumb")
    for name in ("JKROLL_MATERIALS", "_JKROLL_COMPLETE", "FORCE_COLOR"):
        os.environ.pop(name, None)
    os.chdir(directory)
    Path("mine.toml").write_text('[materials.ice]\naliases = ["H2O"]\ndensity = "1 g/cm3"\n', encoding="utf-8")
    Path("broken.toml").write_text("[materials.ice\n", encoding="utf-8")
