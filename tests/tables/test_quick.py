"""Quick and careful reading of a table lead to the same output, byte for byte."""

import csv
import io
import pickle
from unittest.mock import patch

from hypothesis import given, settings
from hypothesis import strategies as st

from jkroll.materials.library import known_materials
from jkroll.model.limits import EVERY_DOUBT
from jkroll.report.questions import quantities_named
from jkroll.tables import cells
from jkroll.tables.files import SEPARATORS, Delimited, as_lines
from jkroll.tables.header import understood
from jkroll.tables.run import Converted, Converter
from jkroll.tables.table import Asked, Table

HEADER = ["name", "material", "radius [nm]", "load [nN]", "poisson_ratio", "radius2"]
PLAIN = st.sampled_from(
    ["100", "12.5", "0.25", "-0", "1e-3", "2E+1", "0.1000000000000000055", "123456789012345678", "0"]
)
NUMBERS = PLAIN | st.floats(1e-3, 1e3).map(repr) | st.decimals(-9, 999, places=3, allow_nan=False).map(str)
ODD = st.sampled_from(
    [
        "",
        *" ,7 ,+1,.5,5.,1_0,007,inf,nan,true,null,[1,1],1 2,\t3,--1,1e400,{},é,\0,5 nm,2um,1 N,plane".split(","),
        '"0.5"',
        '"1,5"',
        '"a\nb"',
        '5"',
        '"open',
    ]
)
NAMES = st.sampled_from(["a", "", "=1+1", "x y", "true", "1", "[", "grün", '"b,c"', '"d""e"'])
MATERIALS = st.sampled_from(["quartz", "iron", "gold", "", "SiO2", "unobtainium", " quartz", '"iron"'])


def rows(cell: st.SearchStrategy[str], name: st.SearchStrategy[str]) -> st.SearchStrategy[list[str]]:
    """Return a strategy for the cells of a row, with as many cells as the header has."""
    own = st.floats(1, 1e4).map("{:.3f} nm".format)
    return st.tuples(name, MATERIALS, cell, cell, st.sampled_from(["0.1", "0.25"]) | cell, own | cell).map(list)


USUAL = rows(NUMBERS, st.sampled_from(["a", "", "b c", "-1"]))
ANY = rows(NUMBERS | ODD, NAMES) | st.lists(NUMBERS | ODD, max_size=8)


def converter(dialect: str, end: str, *, excel_safe: bool) -> Converter:
    """Return the converter of a table with the columns of HEADER."""
    lines = Delimited(SEPARATORS[dialect], excel_safe=excel_safe)
    lines.read_header((lines.separator.join(HEADER) + end).encode())
    table = Table(understood(lines.names), [], Asked({}, known_materials(), offered=quantities_named("report")[1]))
    return Converter(lines, table, "", strict=False)


def converted(dialect: str, end: str, text: bytes, *, excel_safe: bool) -> Converted:
    """Return a converted block of rows."""
    return converter(dialect, end, excel_safe=excel_safe).converted(text)


@settings(deadline=None, max_examples=40)
@given(
    table=st.lists(USUAL, min_size=1, max_size=8) | st.lists(USUAL | ANY, max_size=8),
    dialect=st.sampled_from(["csv", "tsv"]),
    end=st.sampled_from(["\n", "\r\n"]),
    last=st.sampled_from(["", "\n", "\r\n", "\n\n"]),
    excel_safe=st.booleans(),
)
def test_quick_and_careful_reading_agree(
    *, table: list[list[str]], dialect: str, end: str, last: str, excel_safe: bool
) -> None:
    separator = SEPARATORS[dialect]
    text = (end.join(separator.join(row) for row in table) + last).encode()
    quick = converted(dialect, end, text, excel_safe=excel_safe)
    with patch.object(Delimited, "_split", return_value=None), patch.object(cells, "plain_numbers", return_value=None):
        careful = converted(dialect, end, text, excel_safe=excel_safe)
    assert quick == careful


def test_usual_rows_are_read_quickly() -> None:
    text = b"a,quartz,100,1,0.2,50 nm\n" * 300 + b"b,quartz,-5,0,0.2,50 nm\n"
    convert = converter("csv", "\n", excel_safe=False)
    with patch.object(Delimited, "_parsed", side_effect=AssertionError), patch.object(cells, "_meaning") as careful:
        found = convert.converted(text)
    assert (found.tally.rows, found.tally.failed, found.tally.with_doubts(EVERY_DOUBT)) == (301, 1, 300)
    assert found.output.splitlines()[300].endswith(b",bad radius")
    (gap,) = found.tally.gaps.values()
    assert gap == (1, 301, "radius: '-5' must be positive; expected a length such as 100nm")
    assert not careful.called
    first, *others = found.output.splitlines()[:300]
    assert others == [first] * 299


def test_a_converter_may_be_sent_to_another_process() -> None:
    text = b"a,quartz,100,1,0.2,50 nm\nb,quartz,-5,0,0.2,50 nm\n"
    convert = converter("csv", "\n", excel_safe=False)
    assert pickle.loads(pickle.dumps(convert)).converted(text) == convert.converted(text)


@settings(deadline=None)
@given(text=st.text(st.sampled_from('a,"\n\r'), max_size=24).map(str.encode))
def test_records_equal_those_of_the_csv_module(text: bytes) -> None:
    """The records contain the whole text. If Python's csv module accepts the text, it gives the same records."""
    lines = as_lines(text)
    records = [*Delimited(",").records(lines)]
    assert "".join("".join(lines[start:stop]) for start, stop, *_ in records).encode() == text
    try:
        expected = [*csv.reader(io.StringIO(text.decode(), newline="\n"), strict=True)]
    except csv.Error:
        assert any(problem for *_, problem in records)
    else:
        assert [cells for *_, cells, _ in records] == expected


@settings(deadline=None)
@given(
    text=st.text(st.sampled_from('a,"\n\r'), max_size=24).map(str.encode),
    rest=st.text(st.sampled_from('a,"\n'), max_size=8).map(str.encode),
)
def test_no_record_is_cut(text: bytes, rest: bytes) -> None:
    """A text is cut where a record ends, whatever follows."""

    def records(text: bytes) -> list[tuple[list[str], str]]:
        return [(cells, problem) for *_, cells, problem in Delimited(",").records(as_lines(text))]

    size = Delimited(",").cut(text)
    assert records(text[:size]) + records(text[size:] + rest) == records(text + rest)


def test_an_open_quote_does_not_make_one_block_of_the_rest_of_a_table() -> None:
    from jkroll.tables.files import CHUNK, blocks

    lines = [b'"open,quartz\n', *(b"row %d,quartz\n" % row for row in range(CHUNK // 10))]
    pieces = [b"".join(lines[start : start + 1000]) for start in range(0, len(lines), 1000)]
    found = [*blocks(iter(pieces), Delimited(",").cut)]
    assert b"".join(found) == b"".join(lines)
    assert len(found) > 4
    assert all(block.endswith(b"\n") and len(block) <= CHUNK for block in found)


def test_the_first_record_may_be_longer_than_a_block() -> None:
    from jkroll.tables.files import CHUNK, blocks

    text = b"radius [nm]" + b",column" * CHUNK + b"\n100\n"  # read in pieces of CHUNK bytes
    pieces = [text[start : start + CHUNK] for start in range(0, len(text), CHUNK)]
    first, *rest = blocks(iter(pieces), Delimited(",").cut)
    assert first.startswith(text[:-4])
    assert first + b"".join(rest) == text


def test_a_line_of_separators_takes_little_memory() -> None:
    import tracemalloc

    line = b"," * (1 << 18)
    converted("csv", "\n", b"\n", excel_safe=False)  # loads the modules before the measurement
    tracemalloc.start()
    found = converted("csv", "\n", line + b"\n", excel_safe=False)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert (found.tally.rows, found.tally.failed, found.tally.with_doubts(EVERY_DOUBT)) == (1, 1, 0)
    assert peak < 50 * len(line)
