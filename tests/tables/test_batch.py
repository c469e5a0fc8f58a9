"""Tables of contacts: each row gets the same numbers as if it were calculated alone, whatever the other rows hold."""

import csv
import io
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any
from unittest.mock import patch

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from harness import Run, captured
from jkroll.model.limits import CODES, UNCHECKED
from jkroll.quantities.values import QuantityError, unit_of
from jkroll.tables import files
from jkroll.tables.cells import Column
from jkroll.tables.header import understood
from jkroll.write.manual import page
from random_tables import ENDS, IN_SMALL_BLOCKS, random_table, read_rows, write_rows
from relative import approx

csv.field_size_limit(1 << 20)  # some cells read here are longer than the default limit of 128 KiB
GRAINS = "name,material,radius [nm],load [nN]\na,quartz,100,0\nb,iron,50,-2e-3\n"


@pytest.fixture
def small_chunks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let each block of a table hold only a line or two."""
    monkeypatch.setattr(files, "CHUNK", 64)


def table(text: str, name: str = "grains.csv") -> str:
    """Write a table to a file, and return the file's name."""
    Path(name).write_text(text, encoding="utf-8", newline="")
    return name


def rows(text: str) -> list[dict[str, str]]:
    """Return the rows of a CSV table."""
    return list(csv.DictReader(io.StringIO(text, newline="")))


def batch(run: Run, *words: str) -> list[dict[str, str]]:
    """Return the rows that a batch in one process writes."""
    ran = run("batch", *words, "-o", "out.csv", "--jobs", "1")
    assert ran.code in (0, 1), ran.err
    return rows(Path("out.csv").read_text(encoding="utf-8"))


# --- Doubts and numbers -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("end", ENDS)
def test_doubts_have_a_column(run: Run, end: str) -> None:
    """The column has the codes of exceeded limits, also where a number without a meaning is left out.

    A failed row has no code.
    """
    write_rows(
        [
            {"radius [nm]": 100.0, "material": "quartz", "gamma [mJ/m2]": 25.0},
            {"radius [nm]": 0.5, "material": "quartz", "gamma [mJ/m2]": 30.0},
            {"radius [nm]": 0.5, "material": "quarz", "gamma [mJ/m2]": None},
        ],
        f"grains.{end}",
    )
    words = f"batch grains.{end} -o out.{end} --quantities yield_force"
    ran = run(words)
    *lines, unknown, failed = ran.err.splitlines()
    assert unknown.startswith("note: no material 'quarz'; did you mean quartz? jkroll materials lists all")
    assert unknown.endswith(": row 3")
    assert [*lines[1:], failed] == [
        "assumed: ξ = 200 pm (--xi), no load (--load)",
        (
            "warning: numbers have no meaning in 1 of 3 rows (column doubt): xi-over-limit 1 (ξ is too large for the "
            "formula), xi-over-contact 1 (ξ is larger than the contact) and 1 more"
        ),
        "note: doubts in 1 of 3 rows (column doubt): law-off-2x 1",
        "jkroll: 1 of 3 rows failed; column status has the reasons",
    ]
    found = read_rows(f"out.{end}")
    assert [*found[0]][-3:] == ["yield_force [N]", "doubt", "status"]
    assert [row["doubt"] or "" for row in found] == [
        "law-off-2x",
        "xi-over-limit xi-over-contact slides-first",
        "",
    ]
    assert found[1]["status"] == "ξ is too large for the formula"
    assert found[1]["yield_force [N]"] in (None, "")
    assert "doubts in" not in run(f"{words} --no-doubt").err
    assert "doubt" not in read_rows(f"out.{end}")[0]


def test_the_guide_explains_the_codes_of_doubts() -> None:
    assert all(f"`{code}`" in page("models") for code in {*CODES, UNCHECKED})


@pytest.mark.parametrize("unit", ["nm", "ft"])
@settings(deadline=None, max_examples=50)
@given(number=st.from_regex(r"\A-?[0-9]{1,18}(\.[0-9]{1,17})?([eE][-+]?[0-9]{1,2})?\Z"))
def test_cells_read_together_give_the_same_numbers_as_single_cells(unit: str, number: str) -> None:
    column = Column(0, "radius", unit, unit_of(unit, "radius"))
    try:
        expected = column.value(number)
    except QuantityError:
        return
    cell = number.encode()
    for cells in ([cell, cell], [cell, b""], [cell, b"3 " + unit.encode()]):
        assert column.numbers({"radius": cells}).values[0] == expected
    own = f"{number} {unit}".encode()
    assert Column(0, "radius", "", None).numbers({"radius": [own, own]}).values.tolist() == [expected] * 2


@settings(deadline=None)
@given(cells=st.lists(st.sampled_from([b"50 nm", b"7 nm", b" nm", b"nm", b"60", b"", b" ", b"2 um", b"1 nm nm"])))
def test_in_a_column_without_a_unit_each_cell_needs_a_number_and_a_unit(cells: list[bytes]) -> None:
    radii = {b"50 nm": 50e-9, b"7 nm": 7e-9, b"2 um": 2e-6}
    found = Column(0, "radius", "", None).numbers({"radius": cells})
    assert [None if math.isnan(value) else value for value in found.values] == [*map(radii.get, cells)]
    assert sorted(found.odd) == [row for row, cell in enumerate(cells) if cell.strip() and cell not in radii]


@pytest.mark.parametrize(
    "text",
    ["true", "1 2", "[1]", "1e", "nan", "inf", "--1", "1e+-3", "null", '"1"', "0x1", "1_0", "1 nm2", "1 nm nm", "1 m"],
)
def test_malformed_numbers_and_wrong_units_have_no_value(text: str) -> None:
    for column, others in (
        (Column(0, "poisson_ratio", "", None), b"0.1"),
        (Column(0, "load", "nN", unit_of("nN", "load")), b"1"),
        (Column(0, "load", "", None), b"1 nN"),
    ):
        found = column.numbers({column.name: [others, text.encode()]})
        assert found.odd == [1]
        assert math.isnan(found.values[1])


def test_empty_cells_and_several_units_are_read_together() -> None:
    cells = [b"1 nN", b"", b"", b"2.5e1 uN", b" ", b"+3 nN", b"4 uN"]
    with patch.object(Column, "value", side_effect=AssertionError):
        values = Column(0, "load", "", None).numbers({"load": cells}).values.tolist()
    assert str(values) == "[1e-09, nan, nan, 2.5e-05, nan, 3e-09, 4e-06]"


# --- Rows that go wrong -----------------------------------------------------------------------------------------------

STATUS = {
    "x,unobtainium,100,0": (
        "unknown material",
        (
            "no material 'unobtainium'. Give its own numbers, as in jkroll pull-off 100nm --gamma 30mJ/m2 (an "
            "example), add it to a file (jkroll guide materials), or write one that jkroll materials lists"
        ),
    ),
    "x,quartz,,0": ("needs radius", "contact_radius_at_load: needs radius of sphere 1; give a radius such as 100nm"),
    "x,quartz,0,0": ("bad radius", "radius: '0' must be positive; expected a length such as 100nm"),
    "x,quartz,100,-": ("bad load", "load: '-' is not a number; leave the cell empty if there is none"),
    "x,quartz,100,-20": (
        "beyond pull-off",
        "load: -20 nN breaks this contact: the hardest pull that it holds is -11.78 nN",
    ),
    "x,quartz,100": (
        "row is short: 3 cells for 4",
        "'x,quartz,100' has 3 cells, and the header 4: write a comma for each empty cell",
    ),
    "x,quartz,100,0,": (
        "row is long: 5 cells for 4",
        "'x,quartz,100,0,' has 5 cells, and the header 4: write text with a comma in quotes",
    ),
    'x,"quartz,100,0': ("a quote is not closed", "a quote is not closed"),
    "x,quartz\ry,100,0": ("there is a carriage return outside quotes; lines end in line feeds",) * 2,
    "x,quartz,1e400,0": ("bad radius", "radius: '1e400' is too large for a double; expected a length such as 100nm"),
    "x,quartz,1\x1b[31m,0": (
        "bad radius",
        "radius: '1?[31m' is not a number and a unit; expected a length such as 100nm",
    ),
}


def test_a_wrong_unit_is_looked_up_once_for_all_rows(run: Run) -> None:
    name = table(GRAINS + "".join(f"x,quartz,{row} nq,0\n" for row in range(1000)))
    with patch("jkroll.quantities.units.closest", return_value="nm") as guess:
        assert run("batch", name, "--quantities", "r_min", "-o", "out.csv", "--jobs", "1").code == 1
    assert guess.call_count == 1
    assert Path("out.csv").read_text(encoding="utf-8").count("bad radius") == 1000


@pytest.mark.parametrize("line", STATUS)
def test_a_bad_row_has_a_reason_and_spoils_no_other_row(run: Run, line: str) -> None:
    name = table(GRAINS + line + "\n" + "c,quartz,100,0\n")
    status, words = STATUS[line]
    ran = run("batch", name, "--quantities", "contact_radius_at_load", "-o", "out.csv", "--jobs", "1", "--no-doubt")
    assert ran.code == 1
    assert ran.err.splitlines()[-2:] == [
        f"note: {words}: row 3",
        "jkroll: 1 of 4 rows failed; column status has the reasons",
    ]
    good, _, bad, last = rows(Path("out.csv").read_text(encoding="utf-8"))
    assert bad["status"] == status
    assert bad["contact_radius_at_load [m]"] == ""
    assert good["contact_radius_at_load [m]"] == last["contact_radius_at_load [m]"]
    assert float(good["contact_radius_at_load [m]"]) == approx(3.99077763611189e-9)
    assert good["status"] == last["status"] == ""


def test_option_strict_stops_at_a_bad_row_and_names_its_line(run: Run) -> None:
    name = table('name,material,radius [nm]\na,quartz,100\n"two\nlines",quartz,100\n\nb,quartz,0\n')
    ran = run("batch", name, "--strict", "-o", "out.csv", "--jobs", "1", "--quiet")
    assert (ran.code, ran.err) == (
        1,
        "jkroll: line 6: radius: '0' must be positive; expected a length such as 100nm\n",
    )
    assert not [*Path().glob("out.csv*")]
    assert run("batch", name, "--strict", "-o", "out/").err == (
        f"jkroll: '{name}': line 6: radius: '0' must be positive; expected a length such as 100nm\n"
    )
    assert [*Path("out").iterdir()] == []


def test_a_missing_directory_and_a_directory_instead_of_a_file_are_refused(run: Run) -> None:
    name = table(GRAINS)
    Path("forces").mkdir()
    assert run("batch", name, "-o", "nowhere/out.csv", "--quiet").err == (
        "jkroll: cannot write 'nowhere/out.csv': No such file or directory\n"
    )
    message = "jkroll: -o: 'forces' is a directory; name a file in it, such as 'forces/x.csv'\n"
    assert run("batch", name, "-o", "forces", "--quiet").err == message
    message = "jkroll: 'forces' is a directory; name its tables, as in 'forces/*.csv'\n"
    assert run("batch", "forces", "-o", "out.csv").err == message


def test_no_cell_joins_or_splits_rows(run: Run) -> None:
    """The cells are quoted text of many lines or bytes, and text with stray or unclosed quotes."""
    cells = ["x\ny" * 300, "long " * 60_000, 'said ""so""', "a\r\nb", "a,b"]
    lines = [f'"{cell}",quartz,100,0\n' for cell in cells] + ['5" d,quartz,100,0\n', '"open,quartz,100,0\n']
    name = table(GRAINS + "plain,quartz,100,0\n".join(["", *lines, ""]))
    found = batch(run, name, "--quantities", "r_min")
    assert len(found) == 2 + 2 * len(lines) + 1
    assert [row["status"] for row in found if row["status"]] == ["a quote is not closed"]
    assert [row["name"].replace("\r\n", "\n") for row in found[3:-4:2]] == [
        cell.replace('""', '"').replace("\r\n", "\n") for cell in cells
    ]


def test_two_carriage_returns_at_the_end_of_a_line_split_no_row(run: Run) -> None:
    name = table(GRAINS + "x,quartz,100,0\r\r\n")
    assert run("batch", name, "--quantities", "r_min", "--no-doubt", "-o", "out.csv").code == 0
    assert b"\r" not in Path("out.csv").read_bytes()


def test_a_refusal_names_carriage_returns_at_line_ends_and_semicolons_between_columns(run: Run) -> None:
    assert run("batch", table(GRAINS.replace("\n", "\r")), "-o", "out.csv").err == (
        "jkroll: header: there is a carriage return outside quotes; lines end in line feeds\n"
    )
    message = "has semicolons between its columns; write --delimiter semicolon"
    for header in ("material;radius [nm];a,b", '"material";"radius [nm]"'):
        ran = run("batch", table(f"{header}\nquartz;100,5\n"), "-o", "out.csv")
        assert (ran.code, message in ran.err) == (2, True)


def test_each_line_of_an_unclosed_record_is_a_failed_row(run: Run) -> None:
    """The last quote of a line is closed only in the next line; the last quote of the table is never closed."""
    name = table(GRAINS + 'a","quartz","100","0\n' * 3)
    found = batch(run, name, "--quantities", "r_min")
    assert [row["name"] for row in found] == ["a", "b", *['a","quartz","100","0'] * 3]
    assert [row["status"] for row in found] == ["", "", *["a quote is not closed"] * 3]


@pytest.mark.parametrize(("cells", "kept"), [("a,quartz", "a,quartz,,"), ('"a",quartz,1,2,"3"', 'a,quartz,1,"2,3"')])
def test_a_row_with_too_few_or_too_many_cells_keeps_its_cells(run: Run, cells: str, kept: str) -> None:
    assert run("batch", table(f"{GRAINS}{cells}\n"), "--quantities", "r_min", "-o", "out.csv").code == 1
    assert Path("out.csv").read_text(encoding="utf-8").splitlines()[-1].startswith(f"{kept},,,")


# --- Headers ----------------------------------------------------------------------------------------------------------


def mistaken(text: str, name: str, unit: str = " [UNIT]") -> str:
    """Return the refusal of a header whose text after the name of an input is not its unit."""
    columns = " or ".join(f"--column '{text}={name}{sphere}{unit}'" for sphere in ("", "2"))
    remedy = f"Write {columns}, or --column '{text}=' to pass it through"
    return f"header: '{text}' (first cell '100'): the text after '{text.partition(' ')[0]}' is not its unit. {remedy}"


HEADERS = {
    "radius [nm],radius [nm]": "header: the columns 'radius [nm]' and 'radius [nm]' mean the same: rename one",
    "radius [kg]": mistaken("radius [kg]", "radius"),
    "young GP": mistaken("young GP", "youngs_modulus").replace(" or --column 'young GP=youngs_modulus2 [UNIT]'", ""),
    "material [m]": mistaken("material [m]", "material", unit=""),
    "material\tradius": "header: 'material?radius' has tabs between its columns; write --delimiter tab",
    "radius,x": (
        "header: 'radius' (first cell '100'): no unit in the header or in the first cell. Write "
        "--column 'radius=radius [UNIT]', or --column 'radius=' to pass it through"
    ),
    "radius [nm],status": "header: the table already has a column 'status'; rename it",
    "radius [nm],doubt": "header: the table already has a column 'doubt'; rename it",
    "radius [nm],r_min [m]": "header: the table already has a column 'r_min [m]'; rename it",
    "poisson_ratio,x": (
        "pull-off force needs radius of sphere 1 and surface energy per surface; give --gamma 25mJ/m2 and a radius "
        "such as 100nm; --work-of-adhesion 50mJ/m2 may replace --gamma"
    ),
    "name,x": (
        "header: no column is an input; a row is a contact, and its inputs have columns such as radius [nm]. Write "
        "--column 'HEADER=INPUT [UNIT]'"
    ),
    "# grains of 2020,x": "the header is missing: '100' is a number; begin with a line of the columns' names",
    '"radius [nm],x': "header: a quote is not closed",
    "": "the table has no header; begin with a line of the columns' names",
}


def test_a_long_header_is_not_searched_at_each_underscore() -> None:
    name = "radius_" * 100_000
    with patch("jkroll.tables.reading.key", side_effect=str) as plain, patch("jkroll.tables.header.key", plain):
        assert understood([name]).inputs == ()
        assert understood([name, "radius [nm]"]).names == {"radius"}
    assert plain.call_count < 200  # far fewer calls than underscores


@pytest.mark.parametrize("text", HEADERS)
def test_a_header_is_checked_before_the_first_row(run: Run, text: str) -> None:
    row = "100,1" if "," in text else "100"
    ran = run("batch", table(f"{text}\n{row}\n"), "-o", "out.csv", "--jobs", "1")
    assert ran.code == 2
    reading, message = ran.err.splitlines(keepends=True) if ran.err.startswith("read: ") else ("", ran.err)
    assert (message, not reading or " passed through: " in reading) == (f"jkroll: {HEADERS[text]}\n", True)
    assert run("batch", table(f"{text}\n{row}\n"), "-o", "out.csv", "--quiet").err == f"jkroll: {HEADERS[text]}\n"
    assert not [path.name for path in Path().iterdir() if path.name.startswith("out.csv")]


@pytest.mark.parametrize("text", ["material,radius [nm]\n", "material,radius [nm]\n\n"])
def test_a_table_without_rows_gets_a_note(run: Run, text: str) -> None:
    ran = run("batch", table(text), "-o", "out.csv")
    assert (ran.code, ran.err.splitlines()[-1]) == (0, "note: the table has no rows")


def test_a_note_counts_only_rows_with_the_same_fault(run: Run) -> None:
    cells = ["nan", "N/A", "-25", "-30", "inf", "30±300", "25", "25-30", "<25"]
    text = "radius [nm],gamma [mJ/m2]\n" + "".join(f"100,{cell}\n" for cell in cells)
    ran = run("batch", table(text), "-o", "out.csv", "--quantities", "pull_off_force", "--no-doubt")
    notes = [line for line in ran.err.replace("\n  ", " ").splitlines() if line.startswith("note: surface_energy")]
    ends = {"'nan' is not": "1 and 1 other", "'-25' must be": "3 and 1 other", "'inf' does not": "5 and 1 other"}
    ends |= {"'30±300' has an": "6", "'25-30' has two": "8"}
    assert [(note.split(": ")[2].split()[:3], note.rpartition("row ")[2]) for note in notes] == [
        (start.split(), end) for start, end in ends.items()
    ]


def test_an_empty_file_and_utf_16_are_refused(run: Run) -> None:
    Path("empty.csv").write_bytes(b"")
    assert run("batch empty.csv").err == "jkroll: the table has no header; begin with a line of the columns' names\n"
    for encoding in ("utf-16", "utf-16le", "utf-16be", "latin1"):
        Path("wide.csv").write_bytes("radius [µm]\n1\n".encode(encoding))
        remedy = f"save it as UTF-8, as with iconv -f {encoding} -t utf-8 in.csv > out.csv"
        assert run("batch wide.csv").err == f"jkroll: the table is not UTF-8; {remedy}\n"
    assert batch(run, table("radius,name\n1 um,a\0b\n"), "--material", "quartz")[0]["name"] == "a\0b"


@pytest.mark.parametrize("kind", ["csv", "tsv"])
@pytest.mark.parametrize("text", [b"\x1f\x8b\x08\0", b"\x28\xb5\x2f\xfd"])
def test_a_compressed_table_with_the_extension_of_plain_text_is_refused(run: Run, kind: str, text: bytes) -> None:
    Path(f"grains.{kind}").write_bytes(text)
    ran = run("batch", f"grains.{kind}")
    remedy = "the table is compressed: give it a name such as x.csv.gz, or write --format csv.gz"
    assert (ran.code, remedy in ran.err) == (2, True)


def test_option_quantities_takes_names_and_commands(run: Run) -> None:
    found = batch(run, table(GRAINS), "--quantities", "r-min,pull_off_force,mass")
    assert [*found[0]][4:] == ["pull_off_force [N]", "mass [kg]", "r_min [m]", "doubt", "status"]
    assert (
        run("batch", table(GRAINS), "--quantities", "pulloff").err
        == "jkroll: 'pulloff' is not a quantity; did you mean pull_off_force? jkroll quantities lists them\n"
    )
    said = "jkroll: --quantities: load is an input here and is shown with the inputs; leave it out\n"
    assert run("batch", table(GRAINS), "--quantities", "load", "--quiet").err == said


# --- Cells that pass through ------------------------------------------------------------------------------------------

ODD_TABLES = {
    "crlf": GRAINS.replace("\n", "\r\n"),
    "bom": "\ufeff" + GRAINS,
    "no line end": GRAINS.removesuffix("\n"),
    "mixed ends": GRAINS + "c,quartz,100,0\r\nd,quartz,100,0\n",
    "blank lines": GRAINS.replace("\nb", "\n\n\nb") + "\n\n",
    "lines of blanks": GRAINS.replace("\nb", "\n \t \n  \nb") + "  \n ",
    "quotes": GRAINS + '"a ""b"", c",quartz,"100",0\n"x\n\ny","quartz",100,0\n',
    "stray quotes": GRAINS + 'c 5" d,quartz,100,0\nd,quartz,100,0\n',
    "spaces": GRAINS + " c , quartz , 100 , 0 \n",
    "nul": GRAINS + "c\0d,quartz,100,0\n",
    "one column and blanks": "radius [nm]\n100\n  \n200\n",
    "one column and blank lines": "radius [nm]\n100\n\n200\n",
    "only a header": "material,radius [nm]\n",
    "unicode": GRAINS + "grün,quartz,100,0\n",
    "carriage return": GRAINS + '"a\rb",quartz,100,0\n',
}


@pytest.mark.usefixtures("small_chunks")
@pytest.mark.parametrize("kind", ODD_TABLES)
def test_cells_pass_through_unchanged(run: Run, kind: str) -> None:
    """Line ends become those of the header, and blank lines are left out."""
    text = ODD_TABLES[kind].encode()
    Path("grains.csv").write_bytes(text)
    ran = run("batch grains.csv --quantities r_min --no-doubt -o out.csv --jobs 1")
    assert ran.code == 0, Path("out.csv").read_bytes()
    written = Path("out.csv").read_bytes()
    end = b"\r\n" if b"\r\n" in text[:60] else b"\n"
    kept = b""
    for line in written.removesuffix(end).split(end):
        ends_row = line.count(b",") > 1  # with r_min and status; other lines end inside a cell
        kept += (line.rsplit(b",", 2)[0] if ends_row else line) + end
    normal = text if text.endswith(b"\n") else text + end
    if "blank" in kind:  # blank lines are left out
        normal = b"".join(line + end for line in normal.split(end) if line.strip())
    assert kept.replace(b"\r\n", b"\n") == normal.replace(b"\r\n", b"\n")


@pytest.mark.slow
def test_any_number_of_processes_writes_the_same_bytes(run: Run) -> None:
    Path("small.py").write_text(IN_SMALL_BLOCKS.replace("1 << 14", "1 << 11"))
    name = table(random_table(200, 3).replace("speed [m/s]", "text"))
    assert Path(name).stat().st_size > 5 << 11  # two blocks for this process, and one for each of three others
    assert run("batch", name, "-o", "one.csv", "--jobs", "1").code == 1
    ran = subprocess.run([sys.executable, "small.py", "batch", name, "--jobs", "3"], capture_output=True)
    assert ran.returncode == 1
    assert ran.stdout == Path("one.csv").read_bytes()
    assert b"of 200 rows failed" in ran.stderr


@pytest.mark.parametrize("compression", ["gz", "zst"])
def test_compressed_tables_are_read_and_written_and_truncated_tables_are_refused(run: Run, compression: str) -> None:
    from jkroll.tables.files import compressed, decompressed

    if compression == "zst":
        pytest.importorskip("zstandard")
    kind = {"gz": "gzip", "zst": "zstd"}[compression]
    Path(f"grains.csv.{compression}").write_bytes(compressed(GRAINS.encode(), kind))
    assert run(f"batch grains.csv.{compression} -o out.csv.{compression} --jobs 1").code == 0
    with open(f"out.csv.{compression}", "rb") as file:
        text = b"".join(decompressed(file, kind, "out"))
    assert run("batch", table(GRAINS), "-o", "out.csv", "--jobs", "1").code == 0
    assert text == Path("out.csv").read_bytes()
    Path(f"cut.csv.{compression}").write_bytes(Path(f"grains.csv.{compression}").read_bytes()[:-9])
    ran = run(f"batch cut.csv.{compression} -o cut.csv --jobs 1")
    assert ran.code in (1, 2)
    assert not Path("cut.csv").exists()


@pytest.mark.parametrize("compression", ["gz", "zst"])
def test_a_decompressor_may_return_nothing_before_the_end(run: Run, compression: str) -> None:
    """A decompressor keeps bytes until a block of up to 128 KiB is complete. A file may also end in zeros."""
    from jkroll.tables.files import compressed

    if compression == "zst":
        pytest.importorskip("zstandard")
    text = b"radius [nm],text\n" + b"".join(b"%d,%s\n" % (100 + row, b"x" * 50) for row in range(3000))
    kind = {"gz": "gzip", "zst": "zstd"}[compression]
    packed = compressed(text, kind) + compressed(text.partition(b"\n")[2], kind) + bytes(2000)
    Path(f"grains.csv.{compression}").write_bytes(packed)
    assert run(f"batch grains.csv.{compression} --quantities r_min -o out.csv --jobs 1").code == 0
    assert Path("out.csv").read_bytes().count(b"\n") == 6001


@pytest.mark.parametrize("words", ["batch grains.csv.zst -o out.csv", "batch grains.csv -o out.csv.zst"])
def test_a_missing_library_is_named(run: Run, monkeypatch: pytest.MonkeyPatch, words: str) -> None:
    monkeypatch.setitem(sys.modules, "zstandard", None)
    for name in ("grains.csv", "grains.csv.zst"):
        Path(name).write_text(GRAINS, encoding="utf-8")
    assert run(*words.split(), "--quiet") == (2, "", "jkroll: this needs zstandard: pip install 'jkroll[zstd]'\n")
    assert not [*Path().glob("*out*")]


def test_option_excel_safe_puts_an_apostrophe_before_formulas_in_tables_with_tabs(run: Run) -> None:
    names = ["=1+1", "'-x", "-2+3", "+x", "@x"]
    rows = "".join(f"{name}\tquartz\t100\t-2\n" for name in names)
    name = table(GRAINS.replace(",", "\t") + rows, "grains.tsv")
    assert run("batch", name, "--excel-safe", "--quantities", "r_min", "-o", "out.tsv", "--jobs", "1").code == 0
    lines = [line.split("\t") for line in Path("out.tsv").read_text().splitlines()]
    assert "\t".join(lines[0]) == "name\tmaterial\tradius [nm]\tload [nN]\tr_min [m]\tdoubt\tstatus"
    assert [line[0] for line in lines[1:]] == ["a", "b", *("'" + name.removeprefix("'") for name in names)]
    assert [line[3] for line in lines[1:]] == ["0", "-2e-3", *["-2"] * 5]


def test_option_excel_safe_leaves_empty_cells_empty(run: Run) -> None:
    name = table('radius\tname\tlast\r\n1 um\t\t\r\n1 um\t"=1+1"\t\r\n', "grains.tsv")
    words = f"batch {name} --material quartz --quantities r_min -o out.tsv"
    assert run(f"{words} --excel-safe").code == 0
    safe = Path("out.tsv").read_bytes()
    assert run(words).code == 0
    assert safe == Path("out.tsv").read_bytes().replace(b'"=1+1"', b"'=1+1")


def test_a_formula_may_follow_characters_that_a_spreadsheet_drops(run: Run) -> None:
    """A line feed, a NUL or blanks may come first, and a sign may be full-width.

    Text that begins with a line feed is escaped in any case; numbers and all other text are kept.
    """
    names = ["\n=1+1", "\nx", "\0=1", " =1+1", "  @x", "＝1+1", "＋x", "－x", "＠x"]
    kept = [" -5", "-5", "+1e3", "x=1", "", " x"]
    cells = [{"name": name, "radius": "1 um"} for name in [*names, *kept]]
    words = "--material quartz --quantities r_min -o out.csv --excel-safe"
    assert run(f"batch {write_rows(cells, 'grains.csv')} {words}").code == 0
    assert [row["name"] for row in rows(Path("out.csv").read_bytes().decode())] == [
        *(f"'{name}" for name in names),
        *kept,
    ]


HOSTILE = "\x1b[31m\x07\x08\x7f\x9b\u202e"


@pytest.mark.parametrize("end", ["csv", "tsv", "ndjson"])
def test_cells_cannot_control_a_terminal(end: str) -> None:
    """A pipe gets the bytes unchanged."""
    hostile = "\x7f\x9b\u202e" if end == "ndjson" else HOSTILE  # JSON text cannot contain the other characters
    text = "radius [nm]{0}name\n100{0}{1}\n" if end != "ndjson" else '{{"radius [nm]":100,"name":"{1}"}}\n'
    mark = "\t" if end == "tsv" else ","
    name = table(text.format(mark, f"a{hostile}\u00a0石"), f"grains.{end}")
    words = f"batch {name} --material quartz --quantities r_min --quiet".split()
    shown, piped = captured(words, terminal=True), captured(words)
    assert (shown.code, piped.code) == (0, 0)
    assert f"a{hostile}\u00a0石" in piped.out
    assert shown.out == piped.out.replace(hostile, "".join(c if c.isprintable() else "?" for c in hostile))
    assert all(letter.isprintable() or letter in "\n\t\u00a0" for letter in shown.out)


@pytest.mark.parametrize("end", ENDS)
def test_option_model_adds_a_column_that_names_the_law(run: Run, end: str) -> None:
    rows: list[dict[str, Any]] = [
        {"radius [nm]": 100.0, "material": "quartz"},
        {"radius [nm]": 50.0, "material": "iron"},
        {"radius [nm]": 0.0, "material": "iron"},
    ]
    write_rows(rows, f"grains.{end}")
    assert run(f"batch grains.{end} -o out.{end} --model maugis --quantities pull_off_force").code == 1
    found = read_rows(f"out.{end}")
    assert [*found[0]] == ["radius [nm]", "material", "model", "pull_off_force [N]", "doubt", "status"]
    assert [row["model"] for row in found] == ["maugis"] * 3
    for row, (radius, material) in zip(found, [("100nm", "quartz"), ("50nm", "iron")], strict=False):
        wanted = run(f"pull-off {material} {radius} --model maugis --bare").out
        assert float(row["pull_off_force [N]"]) == approx(float(wanted), rel=1e-9)
    assert found[2]["status"] == "bad radius"


# --- Files ------------------------------------------------------------------------------------------------------------


def test_the_input_is_not_overwritten(run: Run) -> None:
    name = table(GRAINS)
    Path("link.csv").symlink_to(name)
    for target in (name, "link.csv"):
        assert run("batch", name, "-o", target).err == f"jkroll: -o: '{target}' is the input; it is not overwritten\n"
    assert run("batch", name, "-o", ".").code == 2
    assert Path(name).read_text() == GRAINS


@pytest.mark.parametrize("jobs", ["1", pytest.param("2", marks=pytest.mark.slow)])
def test_a_full_disk_is_an_error(jobs: str) -> None:
    name = table(random_table(200, 5))
    command = [sys.executable, "-m", "jkroll", "batch", name, "--quiet", "--no-doubt", "--jobs", jobs, "-o"]
    full = subprocess.run([*command, "/dev/full"], capture_output=True, text=True)
    assert (full.returncode, full.stderr) == (1, "jkroll: cannot write '/dev/full': No space left on device\n")
    limited = subprocess.run(
        ["sh", "-c", f"ulimit -f 30; exec {' '.join(command)} out.csv"], capture_output=True, text=True
    )
    assert (limited.returncode, limited.stderr) == (1, "jkroll: cannot write 'out.csv': File too large\n")
    assert os.listdir() == [name]


def test_a_closed_pipe_ends_the_run() -> None:
    name = table(random_table(300, 6))
    ran = subprocess.run(
        ["sh", "-c", f"({sys.executable} -m jkroll batch {name} --quiet --no-doubt; echo $? >&2) | head -1"],
        capture_output=True,
        text=True,
    )
    assert ran.stderr == "141\n"
    assert ran.stdout.startswith("material,radius [nm],")


def test_commands_need_no_posix_module() -> None:
    script = "import sys; sys.modules.update(dict.fromkeys(['fcntl', 'resource', 'termios', 'pwd', 'grp', 'pty']));"
    script += "from jkroll.cli.process import main; print(*[main(line.split()) for line in sys.argv[1:]])"
    table(GRAINS)
    lines = ["pull-off quartz 100nm --bare", "report quartz 1nm:1um:3 --csv", "materials quartz", "batch --help"]
    lines.append("batch grains.csv -o out.csv")
    ran = subprocess.run([sys.executable, "-c", script, *lines], capture_output=True, text=True)
    assert (ran.returncode, ran.stdout.splitlines()[-1]) == (0, "0 0 0 0 0")
    assert "read: material, radius [nm], load [nN]; passed through: name" in ran.stderr.splitlines()


def test_a_table_without_a_radius_gets_a_note(run: Run, tmp_path: Path) -> None:
    (tmp_path / "sizes.csv").write_text("height_um,xi [nm]\n1,0.2\n", encoding="utf-8")
    ran = run("batch sizes.csv --material quartz -o out.csv")
    assert ran.err.splitlines() == [
        "read: yield_displacement [nm] from xi [nm]; passed through: height_um",
        "assumed: no load (--load)",
        "note: no column and no option gives a radius; quantities that need a radius are left out",
        "note: doubts in 1 of 1 rows (column doubt): unchecked 1 (a limit needs an input that is not given)",
    ]
    assert (tmp_path / "out.csv").read_text(encoding="utf-8").splitlines()[
        0
    ] == "height_um,xi [nm],yield_force [N],doubt,status"
    assert "no column" not in run("batch sizes.csv --material quartz --quantities yield_force -o out.csv").err


def test_an_output_for_several_tables_must_not_have_the_name_of_a_file(run: Run) -> None:
    table(GRAINS)
    ran = run("batch *.csv -o all.csv")
    assert (ran.code, "need a directory" in ran.err, Path("all.csv").exists()) == (2, True, False)


@pytest.mark.parametrize("option", ["quantities", "delimiter", "format", "dask"])
def test_an_empty_option_is_refused(run: Run, option: str) -> None:
    table(GRAINS)
    ran = run("batch", "grains.csv", f"--{option}", "")
    assert (ran.code, ran.err) == (2, f"jkroll: --{option} is empty\n")


@pytest.mark.parametrize("name", ["/dev/stdout", "/dev/fd/1"])
def test_output_to_dev_stdout_keeps_the_lines_of_a_file_that_the_shell_appends_to(name: str) -> None:
    table(GRAINS)
    Path("log.csv").write_text("kept\n", encoding="utf-8")
    jkroll = f"{sys.executable} -m jkroll batch grains.csv --quiet --quantities pull_off_force -o {name}"
    subprocess.run(["sh", "-c", f"{jkroll} >> log.csv"], check=False)
    assert Path("log.csv").read_text(encoding="utf-8").startswith("kept\nname,material,")
    piped = subprocess.run(["sh", "-c", f"{jkroll} | cat"], capture_output=True, text=True)
    assert piped.stdout.startswith("name,material,")


# --- The rows that decide how a table is read -------------------------------------------------------------------------


def test_the_first_block_holds_the_whole_sample_even_if_each_piece_holds_one_row() -> None:
    from jkroll.tables.layouts import SAMPLE

    rows = [b"%d," % row + b"x" * 1000 + b"\n" for row in range(500)]
    first = next(files.blocks(iter([b"a,b\n", *rows]), lambda text: text.rfind(b"\n") + 1))
    assert first.count(b"\n") > SAMPLE


# --- Columns that exclude each other ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("columns", "cells", "quantity"),
    [
        ("energy [J],speed [m/s]", ["1e-18,", ",0.1"], "kinetic_energy"),
        ("xi [nm],adhesion_hysteresis [mJ/m2]", ["0.2,", ",10"], "hysteresis_moment"),
        ("load [nN],approach [nm]", ["1,", ",0.1"], "stiffness"),
    ],
)
def test_the_order_of_columns_changes_no_result(run: Run, columns: str, cells: list[str], quantity: str) -> None:
    found = []
    for step in (1, -1):
        lines = [",".join(line.split(",")[::step]) for line in (columns, *cells)]
        name = table("".join(f"100,{line}\n" for line in lines).replace("100", "radius [nm]", 1))
        written = batch(run, name, "--material", "quartz", "--quantities", quantity, "--no-doubt")
        found.append([[*row.values()][3:] for row in written])
    assert found[0] == found[1]
    assert found[0][1][0] != ""
