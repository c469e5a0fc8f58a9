"""Hostile input is read or refused, and takes little memory."""

import math
import re
import tracemalloc
from collections.abc import Callable, Iterable
from decimal import Decimal
from itertools import count, product
from pathlib import Path
from string import ascii_lowercase
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from invariants import MATERIALS, TARGETS, TYPED, kept
from jkroll.errors import JkrollError
from jkroll.materials.library import MAX_BYTES, MaterialsFileError
from jkroll.quantities.formatting import Format, ShownUnit
from jkroll.quantities.nomenclature import NOMENCLATURE
from jkroll.quantities.units import PREFIXABLE, PREFIXES, dimension_of
from jkroll.quantities.values import QuantityError, parse_quantity, unit_of
from jkroll.text import closest, spelled
from material_files import read

MEGABYTE = 1_000_000
MOST_FOR_A_FILE = 50 * MEGABYTE  # of memory, for the worst file of materials; 31 MB were measured


def peak_memory(work: Callable[[], object]) -> int:
    """Return the largest number of bytes that a function has allocated at any one time."""
    tracemalloc.start()
    try:
        work()
    except JkrollError as error:
        str(error)
    finally:
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
    return peak


# --- The corpus -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("target", TARGETS)
def test_inputs_kept_from_fuzzing_pass_the_checks_of_their_target(target: str) -> None:
    inputs = kept(target)
    assert inputs
    for data in inputs:
        TARGETS[target](data)


@pytest.mark.parametrize("entry", MATERIALS["refused"], ids=lambda entry: entry["reason"])
def test_a_wrong_materials_file_is_refused(entry: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    for file in entry["files"]:
        path.write_bytes(file.encode())
        with pytest.raises(MaterialsFileError) as error:
            read(path)
        message = re.sub("is not TOML: .+", "is not TOML", str(error.value))
        assert message == f"materials file '{path}': {entry['error']}", file


@pytest.mark.parametrize("entry", MATERIALS["read"], ids=lambda entry: entry["reason"])
def test_an_unusual_materials_file_is_read(entry: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_bytes(entry["file"].encode())
    assert {material.name: material.properties for material in read(path)} == entry["materials"]


# --- Materials files --------------------------------------------------------------------------------------------------


def _names() -> Iterable[str]:
    for length in count(1):
        yield from map("".join, product(ascii_lowercase, repeat=length))


def _filled(size: int, piece: Callable[[str], str], start: str = "", end: str = "") -> bytes:
    """Return a file with as many pieces as fit, each made from a different name."""
    parts, length = [start], len(start) + len(end)
    for name in _names():
        part = piece(name)
        if length + len(part) > size:
            break
        parts.append(part)
        length += len(part)
    return ("".join(parts) + end).encode()


def ordinary(size: int) -> bytes:
    """Return a file of materials as people write them."""
    return _filled(
        size,
        lambda name: (
            f'[materials.m{name}]\naliases        = ["a_{name}", "B{name}"]\nsurface_energy = "0.37 J/m2"\n'
            f'youngs_modulus = "7 GPa"\npoisson_ratio  = 0.25\ndensity        = "1 g/cm3"\n'
            f'references     = ["r{name}"]\n\n[references.r{name}]\nauthor = "Someone, A. and Other, B."\n'
            f'title = "A title of a usual length for a title"\njournal = "Journal of Things"\nyear = "1990"\n\n'
        ),
    )


# Functions that return a file of a given size that is expensive for a TOML parser.
SHAPES: dict[str, Callable[[int], bytes]] = {
    "very long dotted keys": lambda size: _filled(size, lambda name: name + ".a" * 98 + "=1\n"),
    "tables": lambda size: _filled(size, lambda name: f"[{name}]\n"),
    "very deep tables": lambda size: _filled(size, lambda name: f"[{name}" + ".a" * 97 + "]\n"),
    "tables in an array": lambda size: _filled(size, lambda name: f"[a.{name}]\n", "[[a]]\n"),
    "inline tables": lambda size: _filled(size, lambda _: "{a.a.a.a=1},\n", "a=[\n", "]"),
    "nested inline tables": lambda size: _filled(size, lambda _: "{a=" * 50 + "1" + "}" * 50 + ",\n", "a=[\n", "]"),
    "nested arrays": lambda size: _filled(size, lambda _: "[" * 300 + "]" * 300 + ",\n", "a=[\n", "]"),
    "open brackets": lambda size: b"a = " + b"[\n" * ((size - 4) // 2),
    "numbers": lambda size: _filled(size, lambda _: "1,\n", "a=[\n", "]"),
    "long unknown keys": lambda size: _filled(size, lambda name: f"[materials.{name}]\n{'surface_energy' * 100} = 1\n"),
    "empty materials": lambda size: _filled(size, lambda name: f"[materials.{name}]\n"),
    "materials with one alias": lambda size: _filled(size, lambda name: f'[materials.{name}]\naliases=["A{name}"]\n'),
    "odd lists": lambda size: _filled(size, lambda _: "1,", "[references.a]\na=[", "]"),
    "lists over lines": lambda size: _filled(size, lambda name: f'{name}=[\n""\n]\n', "[references.a]\n"),
    "not UTF-8": lambda size: b"\xff" * size,
}


@pytest.mark.parametrize("share", [0.05, pytest.param(1.0, marks=pytest.mark.slow)])
@pytest.mark.parametrize("shape", SHAPES)
def test_no_shape_of_a_file_takes_much_memory(shape: str, share: float, tmp_path: Path) -> None:
    path = tmp_path / "any.toml"
    path.write_bytes(SHAPES[shape](int(share * MAX_BYTES)))
    assert peak_memory(lambda: read(path)) < share * MOST_FOR_A_FILE


def test_a_file_above_the_size_limit_is_read_only_up_to_the_limit(tmp_path: Path) -> None:
    path = tmp_path / "any.toml"
    path.write_bytes(ordinary(MEGABYTE))
    with pytest.raises(MaterialsFileError, match="is larger than 64 kB"):
        read(path)
    assert peak_memory(lambda: read(path)) < 4 * MAX_BYTES


def test_a_file_of_the_largest_size_is_read(tmp_path: Path) -> None:
    path = tmp_path / "many.toml"
    path.write_bytes(ordinary(MAX_BYTES))
    assert len(read(path)) > 150


# --- Texts with units -------------------------------------------------------------------------------------------------

LONG = {
    "digits": "9",
    "spaces": " ",
    "signs": "−",
    "letters": "m",
    "units": "m ",
    "powers": "^9",
    "brackets": "(",
    "points": ".",
    "slashes": "/",
    "superscripts": "⁹",
    "combining accents": "\u0301",
    "NULs": "\0",
}


@pytest.mark.parametrize("piece", LONG)
def test_a_long_text_takes_little_memory(piece: str) -> None:
    for head in ("", "5", "5 m"):
        text = head + LONG[piece] * (MEGABYTE // len(LONG[piece]))
        for work in (lambda: parse_quantity(text, "radius"), lambda: unit_of(text, "radius")):  # noqa: B023
            with pytest.raises(QuantityError) as error:
                work()
            assert len(str(error.value)) < 400
            assert peak_memory(work) < 5 * MEGABYTE


def test_names_of_unknown_units_are_not_kept_in_memory() -> None:
    with pytest.raises(QuantityError):
        unit_of("zzzzz", "radius")  # this loads Pint before the measurement

    def ask() -> None:
        for number in range(100):
            letters = "".join(chr(ord("a") + digit) for digit in divmod(number, 26)[1:] + divmod(number // 26, 26))
            with pytest.raises(QuantityError):
                unit_of("zzq" + letters, "radius")

    assert peak_memory(ask) < MEGABYTE / 3


def test_a_very_long_word_is_quickly_compared_with_known_words() -> None:
    assert closest("quartz" * 100_000, ["quartz"]) is None


PREFIXED = [
    prefix + unit
    for prefix in ("", *PREFIXES)
    for unit, (_, _, dimension) in PREFIXABLE.items()
    if dimension == dimension_of("N")
]


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(PREFIXED))
@example(5e-324, "N")
@example(-1.7976931348623157e308, "YN")
def test_a_written_number_reads_back(value: float, unit: str) -> None:
    """Every finite double in the SI unit reads back exactly; in another unit, the number is rounded twice."""
    as_usual, in_unit = Format(), Format({"load": ShownUnit(unit, unit_of(unit, "load"))})
    assert parse_quantity(f"{spelled(as_usual.number('load', value))} {as_usual.unit('load')}", "load") == value
    try:
        written = in_unit.number("load", value)
    except OverflowError:  # no double has the number in this unit
        return
    if value and 1e-290 < abs(written) < 1e290 and abs(value) > 1e-290:
        assert math.isclose(parse_quantity(f"{spelled(written)} {unit}", "load"), value, rel_tol=3e-16)


@given(st.floats(allow_nan=False, allow_infinity=False), st.sampled_from(PREFIXED))
def test_a_number_typed_in_any_unit_is_rounded_once(value: float, unit: str) -> None:
    numerator, denominator, _ = unit_of(unit, "load")
    exact = Decimal(value)
    try:
        expected = exact.as_integer_ratio()[0] * numerator / (exact.as_integer_ratio()[1] * denominator)
    except OverflowError:
        expected = math.inf
    text = f"{value!r} {unit}"
    if math.isinf(expected) or (value and not expected):
        with pytest.raises(QuantityError):
            parse_quantity(text, "load")
    else:
        shortest = Decimal(repr(value)).as_integer_ratio()
        assert parse_quantity(text, "load") == shortest[0] * numerator / (shortest[1] * denominator)


@given(st.sampled_from(TYPED), st.floats(min_value=0.0, max_value=0.5, exclude_min=True))
def test_every_quantity_reads_its_own_unit(name: str, value: float) -> None:
    quantity = NOMENCLATURE[name]
    value += max(0.0, quantity.range.low)
    assert parse_quantity(f"{value!r} {quantity.unit}".removesuffix(" 1"), name) == value
