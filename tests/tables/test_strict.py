"""Comment lines above a header are counted, nan does not count as an empty cell, and ambiguous text is refused."""

from pathlib import Path

import orjson
import pytest

from harness import Run
from jkroll import Interval, Measured
from jkroll.quantities.values import QuantityError, Uncertain
from jkroll.tables.header import understood
from relative import approx

FORCE = "--quantities pull_off_force --no-doubt"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "# made by a program\n#\n# on Monday\nradius [nm],gamma [mJ/m2]\n100,25\n",
            "lines skipped before the header: 3",
        ),
        ("# made by a program\nradius [nm],gamma [mJ/m2]\n100,25\n", "lines skipped before the header: 1"),
        ("# made by a program\n# radius [nm],gamma [mJ/m2]\n100,25\n", "lines skipped before the header: 1"),
        ("# radius [nm],gamma [mJ/m2]\n100,25\n", ""),
    ],
)
def test_lines_of_comments_before_a_header_are_counted(run: Run, text: str, said: str) -> None:
    Path("x.csv").write_text(text, encoding="utf-8")
    ran = run(f"batch x.csv -o out.csv {FORCE}")
    assert (ran.code, said in ran.err, bool(said) == ("skipped" in ran.err)) == (0, True, True)
    head, row = Path("out.csv").read_text(encoding="utf-8").splitlines()
    assert head == "radius [nm],gamma [mJ/m2],pull_off_force [N],status"
    assert float(row.split(",")[2]) == approx(1.1780972450961723e-8)


def test_the_line_of_a_bad_row_is_counted_from_the_beginning_of_the_file(run: Run) -> None:
    Path("x.csv").write_text("# one\n# two\nradius [nm],gamma [mJ/m2]\n100,25\nx,25\n", encoding="utf-8")
    assert "line 5: " in run(f"batch x.csv -o out.csv --strict {FORCE}").err


def test_a_duplicate_member_is_refused(run: Run) -> None:
    rows = [
        '{"radius [nm]": 100, "gamma [mJ/m2]": 25, "at": "12:30"}',
        '{"radius [nm]": 100, "gamma [mJ/m2]": 25, "radius [nm]": 5, "at": ""}',
    ]
    Path("x.ndjson").write_text("\n".join(rows), encoding="utf-8")
    assert run(f"batch x.ndjson -o out.ndjson {FORCE}").code == 1
    first, second = map(orjson.loads, Path("out.ndjson").read_text(encoding="utf-8").splitlines())
    assert first["status"] is None
    assert (second["status"], second["pull_off_force [N]"]) == ("has 'radius [nm]' twice", None)
    Path("x.ndjson").write_text("\n".join(reversed(rows)), encoding="utf-8")
    ran = run(f"batch x.ndjson -o out.ndjson {FORCE}")
    assert (ran.code, "two columns are called 'radius [nm]'; rename one" in ran.err) == (2, True)


@pytest.mark.parametrize(
    ("column", "values"),
    [
        ("surface_energy [J/m^2]", [float("nan"), float("inf"), 0.025, None]),
        ("gamma [mJ/m2]", [float("nan"), float("inf"), 25.0, None]),
        ("surface_energy [ft lbf/ft^2]", [float("nan"), float("inf"), 0.0017, None]),
        ("load [nN]", [float("nan"), float("inf"), 0.0, None]),
    ],
)
def test_a_default_replaces_an_empty_cell_but_not_nan_or_infinity(
    run: Run, column: str, values: list[float | None]
) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    parquet = pytest.importorskip("pyarrow.parquet")
    table = pyarrow.table({"radius [nm]": [100.0] * 4, column: pyarrow.array(values, pyarrow.float64())})
    parquet.write_table(table, "x.parquet")
    words = "--material quartz --quantities contact_radius_at_load --no-doubt"
    assert run(f"batch x.parquet -o out.parquet {words}").code == 1
    found = parquet.read_table("out.parquet").to_pydict()
    results = found["contact_radius_at_load [m]"]
    assert [result is None for result in results] == [True, True, False, False]
    assert found["status"][0] == ("bad load" if column.startswith("load") else "bad surface_energy")
    text = "\n".join([f"radius [nm],{column}", *(f"100,{'' if value is None else value}" for value in values), ""])
    Path("x.csv").write_text(text, encoding="utf-8")
    assert run(f"batch x.csv -o out.csv {words}").code == 1
    rows = [line.split(",") for line in Path("out.csv").read_text(encoding="utf-8").splitlines()[1:]]
    assert [not row[2] for row in rows] == [True, True, False, False]


CELLS = {
    "1.00(5)e-7": Measured(1e-7, 5e-9),
    "(1.00+/-0.05)e-07": Measured(1e-7, 5e-9),
    "(1.00±0.05)×10⁻⁷": Measured(1e-7, 5e-9),
    "(1.00±0.05)e−07": Measured(1e-7, 5e-9),
    "1E−07": 1e-7,
    "1×10⁻⁷": 1e-7,
    "1.0 x 10^-7": 1e-7,
    "1·10**-7": 1e-7,
    "1e-7 to 2e-7": Interval(1.5e-7, 1e-7, 2e-7),
    "１００e-9": 1e-7,
    "100㎚": 1e-7,
    "1000 A\u030a": 1e-7,
    "100 nm∕1": None,
    "1×10-7": None,
    "1.00±0.05e-7": None,
    "1 +0.5/-0.4e-7": None,
    "1 000": None,
    "1e-7²": None,
    "1₀e-7": None,
    **dict.fromkeys(("5①nm", "5⒈nm", "5⑴nm", "5ᵐ", "1\u202e2nm")),  # marks of footnotes, and a control character
    "1×10⁻¹µm": 1e-7,
}  # fmt: skip


@pytest.mark.parametrize("cell", CELLS)
def test_a_cell_is_read_or_refused_with_the_true_reason(cell: str) -> None:
    """The header gives the unit, so no cell is refused for lack of a unit."""
    expected = CELLS[cell]
    (column,) = understood(["radius [m]"]).inputs
    if expected is None:
        with pytest.raises(QuantityError) as refusal:
            column.value(cell)
        assert "has no unit" not in str(refusal.value)
        return
    found = column.value(cell)
    if isinstance(found, Uncertain):
        assert isinstance(expected, Uncertain)
        assert [found.value, *found.sides.values()] == approx([expected.value, *expected.sides.values()])
    else:
        assert found == expected


@pytest.mark.parametrize(
    ("head", "cells", "values"),
    [
        ("viscous_time [ps]", ["1.25d1", "1.25e1", "1.25D+01"], [None, 1.25e-11, None]),  # not 1.25 days
        ("radius [nm]", ["5m1", "5 m", "1.5D-07", "5Q2"], [None, 5.0, None, None]),
    ],
)
def test_a_letter_and_digits_directly_after_a_number_are_not_a_unit(
    head: str, cells: list[str], values: list[float | None]
) -> None:
    """The cells of a column are read together."""
    (column,) = understood([head]).inputs
    numbers = column.numbers({column.name: [cell.encode() for cell in cells]})
    assert [*numbers.odd] == [row for row, value in enumerate(values) if value is None]
    assert [numbers.values[row] for row, value in enumerate(values) if value is not None] == approx(
        [value for value in values if value is not None], rel=1e-15
    )


def test_per_cent_after_an_error_bar_in_a_column_of_per_cent_is_refused() -> None:
    """In 40±5 %, the error may be 5 % of the value, or % may be the unit of both numbers."""
    (column,) = understood(["filling_factor [%]"]).inputs
    with pytest.raises(QuantityError, match="has a % that can be read in two ways"):
        column.value("40±5 %")


@pytest.mark.parametrize("cell", ["1e-7", "1E−07", "1×10⁻⁷", "１e-7", "1.0 x 10^-7"])
def test_a_value_keeps_the_unit_of_its_column_next_to_an_error_in_another_unit(cell: str) -> None:
    """The notation of the power of ten makes no difference."""
    (column,) = understood(["load [N]", "load_err [nN]"]).inputs
    load = column.value(column.joined(cell, "5"))
    assert isinstance(load, Measured)
    assert [load.value, *load.sides.values()] == approx([1e-7, 5e-9, 5e-9])


@pytest.mark.parametrize(
    ("rows", "is_refused"), [(["1.200;25"], True), (["1.200;25.5"], False), (["1.200;25", "2.5;25"], False)]
)
def test_a_point_between_semicolons_is_refused_unless_a_point_in_the_table_is_clearly_decimal(
    run: Run, rows: list[str], is_refused: bool
) -> None:
    Path("x.csv").write_text("\n".join(["radius [nm];gamma [mJ/m2]", *rows, ""]), encoding="utf-8")
    ran = run(f"batch x.csv -o out.csv --delimiter semicolon {FORCE}")
    assert (ran.code, "'1.200' may be 1.200 or 1200" in ran.err) == ((2, True) if is_refused else (0, False))


@pytest.mark.parametrize("words", ["n-roll quartz 1um --energy-ratio 1,5", "aggregates quartz 1um --monomers 2,500"])
def test_a_comma_in_a_number_without_a_unit_is_refused(run: Run, words: str) -> None:
    ran = run(words)
    assert (ran.code, "may be a list or a number with a comma" in ran.err) == (2, True)
    # The example is fixed, not made from the typed number.
    assert ran.err.endswith("as in 1.0,5.0; for a single number, write 1.5 or 2500\n")


def test_a_power_after_an_error_bar_without_brackets_is_refused(run: Run) -> None:
    ran = run("pull-off 100nm --gamma 2.5±0.5e-2J/m2")
    assert (ran.code, "can be read as (2.5±0.5)e-2 or as 2.5±(0.5e-2)" in ran.err) == (2, True)
