"""Tables in Markdown: GitHub shows the cells of the CSV output, or of the table on a terminal."""

import csv
import gzip
import math
import re
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest

from harness import Run
from jkroll.write.writers import in_markdown
from relative import approx

HOSTILE = ("a|b", "|", "\\", "a\\|b\\", "`code` `", "*b* **", "_i_ a_b __", "<b>x</b>", "&amp;", "[x](y) ![z](w)",
    "~~s~~", "$x$", "# 1. -", "γ = 25 µ", "")  # fmt: skip


class Table(NamedTuple):
    """A table of Markdown as GitHub reads it."""

    heads: list[str]
    are_right: list[bool]
    rows: list[list[str]]


def cells_of(line: str) -> list[str]:
    """Return the texts that GitHub shows in a line of a table."""
    assert line.startswith("|")
    assert line.endswith("|")
    cells = re.findall(r"((?:\\.|[^\\|])*)\|", line[1:])
    return [re.sub(r"\\([!-/:-@[-`{-~])", r"\1", cell.strip()) for cell in cells]


def read(text: str) -> Table:
    """Return the only table of a text. Each of its rows must have as many cells as the header."""
    lines = [line for line in text.removesuffix("\n").split("\n") if line.startswith("|")]
    heads, sides, *rows = map(cells_of, lines)
    assert all(re.fullmatch("-{3,}:?", side) for side in sides)
    assert {len(row) for row in (sides, *rows)} <= {len(heads)}
    return Table(heads, [side.endswith(":") for side in sides], rows)


def read_csv(text: str) -> list[list[str]]:
    """Return the rows of CSV as lists of cells."""
    return [*csv.reader(text.splitlines())]


# --- Lists ------------------------------------------------------------------------------------------------------------

LISTS = (
    "pull-off quartz,iron 100nm,1.5um",
    "report quartz 10nm:1um:7 --load 1nN --best",
    "pull-off 1um,2um --gamma 25±5mJ/m2 --to nN",
    "yield-force quartz 1um,2um --radius2 plane --model jkr,maugis,dmt",
    "contact quartz 100nm --curve",
    "infer gamma quartz 2um,3um --radius2 plane --measured P_c=300nN",
)


@pytest.mark.parametrize("words", LISTS)
def test_lists_in_markdown_have_the_cells_of_csv(run: Run, words: str) -> None:
    exact, (heads, *rows) = read(run(f"{words} --md --digits 17").out), read_csv(run(f"{words} --csv").out)
    table = read(run(f"{words} --md").out)
    assert table.heads == exact.heads == heads
    assert len(table.rows) == len(exact.rows) == len(rows)
    for of_table, of_exact, row in zip(table.rows, exact.rows, rows, strict=True):
        for head, is_right, cell, digits, plain in zip(heads, table.are_right, of_table, of_exact, row, strict=True):
            if is_right and plain not in ("", "plane", "rigid"):
                assert float(digits) == float(plain), head
                assert float(cell) == approx(float(plain), rel=5.1e-4), head
            else:
                assert cell == digits == plain, head


def test_numbers_are_aligned_on_the_right_and_results_have_four_digits(run: Run) -> None:
    table = read(run("pull-off quartz 100nm,1um --quantities P_c --md").out)
    sides = dict(zip(table.heads, table.are_right, strict=True))
    assert sides == {
        "material": False, "radius [m]": True, "radius2 [m]": True, "surface_energy [J/m^2]": True,
        "pull_off_force [N]": True, "doubt": False, "status": False,
    }  # fmt: skip
    forces = [3 * math.pi * 0.025 * radius / 2 for radius in (1e-7, 1e-6)]
    assert [row[4] for row in table.rows] == [f"{force:.3e}".replace("e-0", "e-") for force in forces]
    assert [row[1] for row in table.rows] == ["1e-7", "1e-6"]
    assert read(run("pull-off quartz 100nm,1um --best --md").out).are_right[5:8] == [True, True, False]


def test_an_input_has_six_digits_and_a_whole_number_has_no_decimal_point(run: Run) -> None:
    row = read(run("pull-off quartz 10nm:1um:7 --quantities P_c --md").out).rows[1]
    assert row[1] == f"{1e-8 * 10 ** (1 / 3):.5e}".replace("e-0", "e-")
    row = read(run("yield-force quartz 100nm,1um --young 123456789123Pa --digits 2 --md").out).rows[0]
    assert "120000000000" in row


def test_a_missing_result_is_an_empty_cell_with_its_reason_in_the_status(run: Run) -> None:
    heads, _, (_, gap) = read(run("contact quartz 100nm --load 1nN,-50nN --quantities a --md").out)
    row = dict(zip(heads, gap, strict=True))
    assert row["contact_radius_at_load [m]"] == ""
    assert "beyond pull-off" in row["status"]


# --- One answer -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words",
    [
        "pull-off quartz 100nm",
        "report quartz 100nm",
        "energies quartz 1um --digits 3",
        "n-grav iron 1um",
        "infer gamma quartz 2um --radius2 plane --measured P_c=300nN",
    ],
)
def test_a_single_answer_has_the_texts_of_the_table_on_a_terminal(
    run: Run, monkeypatch: pytest.MonkeyPatch, words: str
) -> None:
    monkeypatch.setenv("COLUMNS", "999")
    ran, shown = run(f"{words} --md"), run(words, terminal=True)
    lines = [line for line in shown.out.splitlines() if not line.startswith("─")]
    parts = [line for line in ran.out.splitlines() if line and not line.startswith("|---")]
    assert len(parts) == len(lines)
    for part, line in zip(parts, lines, strict=True):
        texts = [*filter(None, cells_of(part))] if part.startswith("|") else [part.replace("\\", "")]
        assert texts == (re.split(r" {2,}", line.strip()) if part.startswith("|") else [line])
    assert ran.err == shown.err


def test_blank_lines_separate_paragraphs_and_tables(run: Run) -> None:
    out = run("energies quartz 100nm --md").out
    for before, after in zip(out.splitlines(), out.splitlines()[1:], strict=False):
        assert not (before and after) or (before.startswith("|") and after.startswith("|"))
    assert not out.endswith("\n\n")


def test_the_unit_and_the_inputs_are_shown_as_typed(run: Run) -> None:
    out = run("pull-off quartz .1um --to uN --digits 2 --md").out
    assert out.startswith("quartz (γ = 25 mJ/m² per surface), R1 = R2 = .1 µm\n\n")
    assert read(out).rows[1][-2:] == ["0.012", "uN"]


# --- Texts ------------------------------------------------------------------------------------------------------------


def test_texts_with_markup_are_shown_unchanged(run: Run) -> None:
    with Path("in.csv").open("w", encoding="utf-8", newline="") as file:
        csv.writer(file).writerows([["id|`x`", "radius [nm]", "n"], *([text, 100, 7.5] for text in HOSTILE)])
    ran = run("batch in.csv -o out.md --gamma 25mJ/m2 --quantities P_c")
    assert ran.code == 0
    table = read(Path("out.md").read_text(encoding="utf-8"))
    assert table.heads == ["id|`x`", "radius [nm]", "n", "pull_off_force [N]", "doubt", "status"]
    assert table.are_right == [False, True, True, True, False, False]
    assert [row[:4] for row in table.rows] == [[text, "100", "7.5", "1.178e-8"] for text in HOSTILE]


def test_line_breaks_in_cells_become_blanks(run: Run) -> None:
    Path("in.csv").write_text('id,radius [nm]\r\n"a\r\nb\nc\rd",100\r\n', encoding="utf-8", newline="")
    run("batch in.csv -o out.md --gamma 25mJ/m2 --quantities P_c")
    assert read(Path("out.md").read_bytes().decode()).rows[0][:2] == ["a b c d", "100"]


def test_a_material_name_with_markup_is_shown_unchanged(run: Run) -> None:
    name, options = "q|`*\\z", ("--materials", "mine.toml", "--md")
    Path("mine.toml").write_text(f"[materials.'{name}']\nsurface_energy = '25 mJ/m2'\n", encoding="utf-8")
    assert [row[0] for row in read(run("pull-off", name, "100nm,1um", *options).out).rows] == [name, name]
    assert read(run("materials", name, *options).out).rows[0][:2] == [name, "0.025"]
    single = run("pull-off", name, "100nm", *options).out
    assert single.startswith("q\\|\\`\\*\\\\z (γ = 25 mJ/m² per surface), R1 = R2 = 100 nm\n\n")


def test_a_parser_of_commonmark_reads_the_same_texts() -> None:
    markdown_it = pytest.importorskip("markdown_it")
    reader = markdown_it.MarkdownIt("commonmark").enable(["table", "strikethrough"])
    source = Random(1)
    letters = "|\\`*_<>&;[]()!~# ab1:/"
    texts = [*HOSTILE, *("".join(source.choices(letters, k=source.randint(1, 12))) for _ in range(3000))]
    for text in texts:
        tokens = reader.parse(f"| h |\n|---|\n| {in_markdown(text)} |\n")
        shown = ["".join(child.content for child in token.children) for token in tokens if token.type == "inline"]
        assert shown == ["h", text.strip()], text


def test_catalogues_have_the_cells_of_csv(run: Run) -> None:
    for words in ("quantities", "materials"):
        table, (heads, *rows) = read(run(f"{words} --md").out), read_csv(run(f"{words} --csv").out)
        assert table.heads == heads
        for found, row in zip(table.rows, rows, strict=True):
            for is_right, cell, plain in zip(table.are_right, found, row, strict=True):
                assert cell == plain or (is_right and float(cell) == approx(float(plain), rel=1e-5))
        assert table.are_right[1] == (words == "materials")


# --- Files ------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("words", ["pull-off quartz 100nm", "pull-off quartz 100nm,1um", "contact quartz 1um --curve"])
def test_a_markdown_file_has_the_printed_text(run: Run, words: str) -> None:
    printed = run(f"{words} --md").out
    for options in ("-o x.md", "--md -o x.MD"):
        assert run(f"{words} {options}").out == ""
        assert Path(options.split()[-1]).read_text(encoding="utf-8") == printed
    if "," in words:
        run(f"{words} -o x.md.gz")
        assert gzip.decompress(Path("x.md.gz").read_bytes()).decode() == printed


def test_decimal_commas_of_the_input_are_kept_and_its_byte_order_mark_is_not(run: Run) -> None:
    Path("in.csv").write_text("\ufeffid;R1 (nm);R2\nx;99,5;plane\ny;1e2;plane\n", encoding="utf-8")
    assert run("batch in.csv --delimiter semicolon --gamma 25mJ/m2 --quantities P_c -o out.md").code == 0
    text = Path("out.md").read_text(encoding="utf-8")
    assert text.startswith("| id | R1 (nm) |")
    assert [row[1:4] for row in read(text).rows] == [["99,5", "plane", "2,344e-8"], ["1e2", "plane", "2,356e-8"]]


def test_the_row_of_units_and_failed_rows_are_rows_of_the_output(run: Run) -> None:
    Path("in.csv").write_text("id,radius\n,nm\na,100\nb,c,d\nc,x\n", encoding="utf-8")
    assert run("batch in.csv -o out.md --gamma 25mJ/m2 --quantities P_c").code == 1
    rows = read(Path("out.md").read_text(encoding="utf-8")).rows
    assert [row[:3] for row in rows] == [["", "nm", ""], ["a", "100", "1.178e-8"], ["b", "c,d", ""], ["c", "x", ""]]
    assert [row[-1] for row in rows] == ["row of units", "", "row is long: 3 cells for 2", "bad radius"]


def test_a_table_computed_in_many_blocks_is_one_markdown_table(run: Run) -> None:
    size = 12_000
    Path("in.csv").write_text("radius [nm]\n" + "".join(f"{100 + row}\n" for row in range(size)), encoding="utf-8")
    for jobs in (1, 2):
        assert run(f"batch in.csv -o {jobs}.md --gamma 25mJ/m2 --quantities P_c --no-doubt --jobs {jobs}").code == 0
    assert Path("1.md").read_bytes() == Path("2.md").read_bytes()
    rows = read(Path("1.md").read_text(encoding="utf-8")).rows
    assert [float(row[0]) for row in rows] == [100.0 + row for row in range(size)]
    assert float(rows[-1][1]) == approx(1.5 * math.pi * 0.025 * (99 + size) * 1e-9, rel=5e-4)


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        ("batch grains.ndjson -o x.md", "the output has the format of the input; write 'x.ndjson'"),
        ("batch grains.md", "'grains.md'"),
        ("batch grains.csv -o x.csv --format md", "--format: 'md' is not csv, tsv or ndjson"),
        ("batch grains.csv --md", "batch takes no '--md'; name the file: -o x.md"),
        ("map pull-off --x radius=1nm:1um --md", "map takes no '--md'; --data FILE writes the numbers as CSV"),
        ("pull-off quartz 1um --csv -o x.md", "-o 'x.md' and --csv exclude each other"),
        ("pull-off quartz 1um --md -o x.csv", "-o 'x.csv' and --md exclude each other"),
        *((f"pull-off quartz 1um --md --{other}", "exclude each other") for other in ("csv", "json", "bare", "cite")),
        ("pull-off quartz 1um --explain --md", "exclude each other"),
        (f"report quartz 1um --angle {'9' * 90}deg -o x.md", "is longer than 80 characters; expected an angle"),
        ("contact quartz 1um --curve --density 1mµm -o x.md", "has a µ that is not the first letter of a unit"),
    ],
)  # fmt: skip
def test_invalid_calls_for_markdown_are_refused_and_write_no_file(run: Run, words: str, problem: str) -> None:
    Path("grains.csv").write_text("material,radius [nm]\nquartz,100\n", encoding="utf-8")
    Path("grains.ndjson").write_text('{"material": "quartz", "radius [nm]": 100}\n', encoding="utf-8")
    ran = run(words)
    assert ran.code == 2
    assert problem in ran.err
    assert not Path("x.md").exists()
