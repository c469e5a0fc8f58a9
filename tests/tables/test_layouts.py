"""Tables in the layouts of simulations, R and instruments: dumps, row names and rows of units are read or refused."""

import gzip
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from harness import Ran, Run
from jkroll.tables.files import Delimited
from jkroll.tables.layouts import tabbed
from relative import approx

FORCE = "--quantities pull_off_force --no-doubt"
OF_25 = 1.1780972450961723e-8  # the pull-off force in N of spheres of 100 nm with 25 mJ/m2
COLUMN = re.compile(r"--column ('[^']*'|\"[^\"]*\")")


@pytest.fixture(autouse=True)
def _wide(monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep the lines of messages unbroken."""
    monkeypatch.setenv("COLUMNS", "2000")


def batch(run: Run, text: str, words: str = "", name: str = "x.csv", target: str = "") -> Ran:
    """Run `batch` on a table, by default to out.csv or out.tsv."""
    Path(name).write_text(text, encoding="utf-8", newline="")
    target = target or ("out.csv" if name.endswith("csv") else "out.tsv")
    return run("batch", name, *FORCE.split(), *shlex.split(words), "-o", target)


def written(name: str = "out.csv") -> list[str]:
    """Return the lines of a written table."""
    return Path(name).read_text(encoding="utf-8").splitlines()


# --- Dumps ------------------------------------------------------------------------------------------------------------

# LIGGGHTS writes type twice, and a blank at the end of each line.
ITEMS = """ITEM: TIMESTEP
{}
ITEM: NUMBER OF ATOMS
3
ITEM: BOX BOUNDS pp pp ff
-1.0000000000000000e-03 1.0000000000000000e-03
-1.0000000000000000e-03 1.0000000000000000e-03
0.0000000000000000e+00 2.0000000000000000e-03
ITEM: ATOMS id type type x y z fx fy fz radius c_1[3] v_f\x20
"""
ATOMS = (
    "1 1 1 0.0001 0.0002 3e-05 0 0 0 1e-07 1.5 0\x20\n"
    "2 1 1 0.0002 0.0002 3e-05 0 0 0 5e-08 1.5 0\x20\n"
    "3 2 2 0.0004 0.0002 3e-05 0 0 0 1e-07 1.5 0\x20\n"
)
READ = "read: radius [m]; lines skipped before the header: 8; passed through:"
DUMP = ITEMS.format(0) + ATOMS
ASKED = "--gamma 25mJ/m2"
IN_M = f"{ASKED} --column 'radius=radius [m]'"


def test_a_dump_is_read_as_a_table(run: Run) -> None:
    ran = batch(run, DUMP, IN_M, "dump0.liggghts")
    assert (ran.code, ran.err) == (
        0,
        f"{READ} id, type, x, y, z, fx, fy, fz, c_1[3], v_f\n",
    )
    head, *rows = written("out.tsv")
    assert head == "id\ttype\ttype\tx\ty\tz\tfx\tfy\tfz\tradius\tc_1[3]\tv_f\tpull_off_force [N]\tstatus"
    assert [row.split("\t")[:12] for row in rows] == [line.split() for line in ATOMS.splitlines()]
    forces = [float(row.split("\t")[12]) for row in rows]
    assert forces == [approx(OF_25), approx(OF_25 / 2), approx(OF_25)]


def test_the_advice_for_a_radius_without_a_unit_can_be_typed(run: Run) -> None:
    """Unless it was asked to, LAMMPS does not name the units of the simulation in a dump."""
    ran = batch(run, DUMP, ASKED, "dump0.liggghts")
    said = "'radius' (first cell '1e-07'): no unit in the header or in the first cell. Write --column 'radius=radius"
    assert (ran.code, said in ran.err) == (2, True)
    words = COLUMN.search(ran.err)
    assert words is not None
    for unit, force in (("m", OF_25), ("cm", OF_25 / 100), ("um", OF_25 * 1e-6)):  # LAMMPS units si, cgs, micro
        assert batch(run, DUMP, f"{ASKED} {words[0].replace('UNIT', unit)}", "dump0.liggghts").code == 0
        assert float(written("out.tsv")[1].split("\t")[12]) == approx(force)


@pytest.mark.parametrize("name", ["dump.csv", "dump.tsv", "-"])
def test_the_refusal_of_a_dump_read_as_csv_names_its_separator(run: Run, name: str) -> None:
    said = "jkroll: this is a dump of LAMMPS, with blanks between its columns; write --delimiter blank\n"
    if name != "-":
        assert batch(run, DUMP, IN_M, name).err == said
        assert batch(run, DUMP, f"{IN_M} --delimiter blank", name, "out.tsv").code == 0
        return
    command = [sys.executable, "-m", "jkroll", "batch", "-", *FORCE.split(), *shlex.split(IN_M)]
    piped = subprocess.run(command, input=DUMP, capture_output=True, text=True)
    assert (piped.returncode, piped.stderr) == (2, said)
    piped = subprocess.run([*command, "--delimiter", "blank"], input=DUMP, capture_output=True, text=True)
    assert batch(run, DUMP, IN_M, "dump0.liggghts").code == piped.returncode == 0
    assert piped.stdout.splitlines() == written("out.tsv")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        # The time step is variable, and the units of the simulation are stated.
        (
            f"ITEM: UNITS\nsi\nITEM: TIME\n0.5\n{DUMP}",
            "read: radius [m]; lines skipped before the header: 12; passed through: id,",
        ),
        ("ITEM: ATOMS id radius\n1 1e-7\n", "read: radius [m]; passed through: id\n"),
        (DUMP.replace("\n", "\r\n"), f"{READ} id,"),
        # The end was cut off.
        (DUMP[:30], "the dump has no line such as ITEM: ATOMS id radius: its end is missing\n"),
        (DUMP.partition("ITEM: ATOMS")[0], "the dump has no line such as ITEM: ATOMS id radius: its end is missing\n"),
        (
            DUMP.partition("3 2 2")[0],
            "line 4 says 3 rows, and there are 2: the end of the dump is missing. Write 2 there",
        ),
        (
            DUMP + "4 2 2 0 0 0 0 0 0 1e-7 0 0\n",
            "line 4 says 3 rows, and there are 4: there are extra lines. Write 4 there",
        ),
        (ITEMS.format(0), "line 4 says 3 rows, and there are 0"),
        # LAMMPS of 2008 wrote no names of columns.
        (DUMP.replace(" id type type x y z fx fy fz radius c_1[3] v_f", ""), "the table has no header"),
    ],
)
def test_dumps_of_other_forms_are_read_and_incomplete_dumps_are_refused(run: Run, text: str, said: str) -> None:
    ran = batch(run, text, IN_M if "ATOMS id" in text else ASKED, "dump0.lammpstrj")
    assert (said in ran.err, ran.code) == (True, 0 if said.startswith("read") else 2), ran.err
    assert Path("out.tsv").exists() == (not ran.code)


def test_a_dump_of_contacts_is_read_with_option_column(run: Run) -> None:
    """In a dump of `compute pair/gran/local`, options give the columns their meanings."""
    text = (
        "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ENTRIES\n2\nITEM: BOX BOUNDS mm mm mm\n0 1\n0 1\n0 1\n"
        "ITEM: ENTRIES c_cpl[1] c_cpl[2] \n1e-7 3.5 \n5e-8 4.5 \n"
    )
    ran = batch(run, text, f"{ASKED} --column 'c_cpl[1]=radius [m]'", "contacts0.dump")
    assert (ran.code, written("out.tsv")[0]) == (0, "c_cpl[1]\tc_cpl[2]\tpull_off_force [N]\tstatus")
    assert "no column is an input" in batch(run, text, ASKED, "contacts0.dump").err


def test_the_incomplete_last_row_of_a_dump_fails(run: Run) -> None:
    ran = batch(run, DUMP[: DUMP.index("1.5 0 \n3") + len("1.5 0 \n3 2 2 0.0004")], IN_M, "dump0.liggghts")
    assert (ran.code, ran.err.splitlines()[1:]) == (
        1,
        [
            "note: '3 2 2 0.0004' has 4 cells, and the header 12: write \"\" for an empty cell: row 3",
            "jkroll: 1 of 3 rows failed; column status has the reasons",
        ],
    )
    ran = batch(run, DUMP.replace("5e-08", "x"), f"{IN_M} --strict", "dump0.liggghts")
    assert ran.err.splitlines()[1].startswith("jkroll: line 11: radius: 'x' does not begin with a number")


@pytest.mark.parametrize("size", [1, pytest.param(30_000, marks=pytest.mark.slow)])
def test_a_second_step_is_refused_with_a_command_that_splits_the_dump(run: Run, size: int) -> None:
    """The second step may begin in a later block."""
    step = DUMP.replace("\n3\n", f"\n{3 * size}\n").replace(ATOMS, ATOMS * size)
    ran = batch(run, step + step, IN_M, "two.dump")
    last, split = ran.err.splitlines()[-1], "csplit -z 'two.dump' '/ITEM: TIMESTEP/' '{*}'"
    problem = f"jkroll: line {10 + 3 * size} begins a second time step, but a table can have only one"
    assert (ran.code, last) == (2, f"{problem}. Write {split}, and then jkroll batch 'xx*' -o DIRECTORY/")
    assert not Path("out.tsv").exists()
    if shutil.which("csplit") and size == 1:
        subprocess.run(shlex.split(split), check=True, capture_output=True)
        assert batch(run, step, IN_M, "one.dump").code == 0
        assert run("batch", "xx*", *FORCE.split(), *shlex.split(IN_M), "-o", "out/").code == 0
        assert [written(f"out/{name}") for name in ("xx00", "xx01")] == [written("out.tsv")] * 2


def test_a_second_step_begins_with_the_first_of_its_items(run: Run) -> None:
    text = "ITEM: TIME\n0\n" + DUMP + "ITEM: TIME\n1\n" + DUMP
    assert (
        "line 15 begins a second time step, but a table can have only one. Write csplit -z 'x.dump' '/ITEM: TIME$/'"
        in (batch(run, text, IN_M, "x.dump").err)
    )
    Path("x.dump.gz").write_bytes(gzip.compress(text.encode()))
    assert "Write zcat 'x.dump.gz' | csplit -z - '/ITEM: TIME$/' '{*}', and then" in run(f"batch x.dump.gz {FORCE}").err


def test_compressed_dumps_are_read_one_at_a_time_and_many_at_once(run: Run) -> None:
    assert batch(run, DUMP, IN_M, "dump0.liggghts").code == 0
    expected = written("out.tsv")
    Path("in").mkdir()
    for step in (0, 100):
        Path(f"in/dump{step}.gz").write_bytes(gzip.compress(DUMP.encode()))
    words = [*FORCE.split(), *shlex.split(IN_M)]
    assert run("batch", "in/dump0.gz", *words, "-o", "out.tsv").code == 0
    assert written("out.tsv") == expected
    ran = run("batch", "in/*.gz", *words, "-o", "out/")
    assert (ran.code, sorted(path.name for path in Path("out").iterdir())) == (0, ["dump0.gz", "dump100.gz"])
    assert ran.err.startswith(f"{READ} id,")


AVERAGES = "# Time-averaged data for fix 1\n# TimeStep v_f c_1[3]\n100 1.0 2.0\n200 1.5 2.0\n"


def test_averages_of_a_simulation_have_their_header_in_a_comment(run: Run) -> None:
    """`fix ave/time` writes such a file. Without an option, no column is an input."""
    words = f"--delimiter blank {ASKED} --radius 100nm"
    ran = batch(run, AVERAGES, words, "ave.txt")
    assert (ran.code, "no column is an input" in ran.err, "HEADER=INPUT [UNIT]" in ran.err) == (2, True, True)
    ran = batch(run, AVERAGES, f"{words} --column 'v_f=load [nN]'", "ave.txt")
    assert (ran.code, ran.err.splitlines()[0]) == (
        0,
        "read: load [nN] from v_f; lines skipped before the header: 1; passed through: TimeStep, c_1[3]",
    )
    assert [line.split("\t")[:3] for line in written("out.tsv")[1:]] == [["100", "1.0", "2.0"], ["200", "1.5", "2.0"]]
    # The default title of `fix print` is not a header, but a given title may be one.
    said = batch(run, "# Fix print output for fix 1\n100 1e-7\n", words, "print.txt").err
    assert "the header is missing: '100' is a number; begin with a line of the columns' names" in said
    assert batch(run, "# step radius_m\n100 1e-7\n", f"--delimiter blank {ASKED}", "print.txt").code == 0
    assert written("out.tsv")[0].startswith("step\tradius_m\tpull_off_force [N]")


def test_rows_with_another_number_of_cells_than_the_header_fail(run: Run) -> None:
    """`fix ave/chunk` writes a line for each step above the rows of its chunks."""
    chunks = "200.0 2 400\n  1 0.5 200 1e-7\n  2 1.5 200 1e-7\n"
    text = "# Chunk-averaged data for fix 1 and group all\n# Timestep Number-of-chunks Total-count\n"
    text += f"# Chunk Coord1 Ncount v_r\n{chunks}{chunks}"
    ran = batch(run, text, f"--delimiter blank {ASKED} --column 'v_r=radius [m]'", "chunks.txt")
    assert ran.err.splitlines()[1:] == [
        "note: '200.0 2 400' has 3 cells, and the header 4: write \"\" for an empty cell: row 1 and 1 other",
        "jkroll: 2 of 6 rows failed; column status has the reasons",
    ]


# --- Headers below rows -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("other", ["radius [um],gamma [mJ/m2]", "gamma [mJ/m2],radius [nm]", "radius,gamma"])
@pytest.mark.parametrize("rows", [1, 20_000])
def test_another_header_below_rows_is_refused(run: Run, rows: int, other: str) -> None:
    """The rows below would be read in the units, or in the order, of the header above."""
    above = "a,100,25\n" * rows
    Path("x.csv").write_text(f"probe,radius [nm],gamma [mJ/m2]\n{above}probe,{other}\nb,1,25\n")
    ran = run("batch x.csv --quantities pull_off_force -o out.csv")
    heads = f"'{other.replace(',', ', ')}' instead of 'radius [nm], gamma [mJ/m2]'"
    assert (ran.code, f"a row below the header is another header: {heads}" in " ".join(ran.err.split())) == (2, True)
    assert not Path("out.csv").exists()


def test_the_same_header_below_rows_fails_alone(run: Run) -> None:
    Path("x.csv").write_text("radius [nm],gamma [mJ/m2]\n100,25\n" * 2)
    assert run("batch x.csv --quantities pull_off_force --no-doubt -o out.csv").code == 1
    lines = Path("out.csv").read_text().splitlines()
    assert lines[2] == "radius [nm],gamma [mJ/m2],,bad radius"
    assert lines[1] == lines[3]


# --- Headers that lack a name -----------------------------------------------------------------------------------------

R_ROWS = [['"1"', "100", "25", '"a b"'], ['"2"', "50", "25", "NA"], ['"3"', "100", "50", '"c"']]


@pytest.mark.parametrize(("mark", "words"), [(" ", "--delimiter blank"), ("\t", "--format tsv"), (",", "--format csv")])
@pytest.mark.parametrize("names", [['"1"', '"2"', '"3"'], ['"Mazda RX4"', '"Datsun 710"', '"a ""b"""']])
def test_row_names_of_r_are_a_column(run: Run, mark: str, words: str, names: list[str]) -> None:
    """Above the row names, `write.table(df)` writes no header, and `write.csv(df)` an empty header."""
    rows = [mark.join([name, *row[1:]]) for name, row in zip(names, R_ROWS, strict=True)]
    text = "\n".join([mark.join(['"radius [nm]"', '"gamma..mJ.m2."', '"note"']), *rows, ""])
    target = "out.csv" if mark == "," else "out.tsv"
    ran = batch(run, text, words, "r.txt", target)
    said = "read: radius [nm], surface_energy [mJ/m2] from gamma..mJ.m2.; the first column has row names; passed"
    assert (ran.code, ran.err) == (0, f"{said} through: note\n")
    divider = mark.replace(" ", "\t")
    head, *lines = written(target)
    assert head == divider.join(['""', '"radius [nm]"', '"gamma..mJ.m2."', '"note"', "pull_off_force [N]", "status"])
    assert [line.split(divider)[:4] for line in lines] == [
        [name, *row[1:]] for name, row in zip(names, R_ROWS, strict=True)
    ]
    assert [float(line.split(divider)[4]) for line in lines] == [approx(OF_25), approx(OF_25 / 2), approx(2 * OF_25)]
    above = batch(run, f'""{mark}{text}', words, "r.txt", target)
    assert (above.code, "row names" in above.err, written(target)) == (0, False, [head, *lines])


def test_rows_with_row_names_keep_their_line_numbers(run: Run) -> None:
    text = '"radius [nm]" "gamma"\n"1" 100 25\n"2" x 25\n"3" 100\n'
    words = "--delimiter blank --column 'gamma=surface_energy [mJ/m2]'"
    ran = batch(run, text.removesuffix('"3" 100\n'), words, "r.txt")
    assert ran.err.splitlines()[1:] == [
        "note: radius: 'x' does not begin with a number; expected a length such as 100nm: row 2",
        "jkroll: 1 of 2 rows failed; column status has the reasons",
    ]
    assert "line 3: radius: 'x'" in batch(run, text.removesuffix('"3" 100\n'), f"{words} --strict", "r.txt").err
    # One row has as many cells as the header, so no name is missing.
    ran = batch(run, text, words, "r.txt")
    assert (ran.code, "'\"1\" 100 25' has 3 cells, and the header 2" in ran.err) == (1, True)


@pytest.mark.parametrize(
    ("text", "words", "said"),
    [
        # R writes row names in quotes, all of them distinct, and numbers without quotes.
        ("radius_nm gamma_mJ_m2\n1 100 25\n2 50 25\n", "--delimiter blank", "name each column in the header"),
        ('radius_nm,gamma_mJ_m2\n"100","25","3"\n', "", "name each column in the header"),
        ('radius_nm,gamma_mJ_m2\n"a",25,3\n"a",50,3\n', "", "name each column in the header"),
        ("radius_nm,gamma_mJ_m2\n100,25,3\n", "", "R does with write.table(..., col.names = NA)"),
        ("radius_nm,gamma_mJ_m2\n100,25,3,4\n", "", "write text with a comma in quotes"),
        ("radius_nm,gamma_mJ_m2,x\n100,25\n50,25\n", "", "line 2 on, has 2: write a comma for each empty cell"),
        ("# a\nradius_nm;x;y\n\n100\n", "--delimiter semicolon", "line 4 on, has 1: write a semicolon for each"),
        ("radius [nm] gamma [mJ/m2]\n100 25\n", "--delimiter blank", 'in quotes, as in "radius [nm]"'),
        (
            "My data\nradius_nm,gamma_mJ_m2\n100,25\n",
            "",
            "'My data' is not a header, but line 2 may be: write # before",
        ),
    ],
)
def test_a_table_is_refused_if_its_header_has_another_number_of_cells_than_its_rows(
    run: Run, text: str, words: str, said: str
) -> None:
    ran = batch(run, text, words, "x.csv", "out.tsv" if "blank" in words else "out.csv")
    assert (ran.code, ran.err.count("\n")) == (2, 1), ran.err
    assert said in ran.err


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_a_separator_at_the_end_of_each_row_makes_an_empty_column(run: Run, end: str) -> None:
    ran = batch(run, end.join(["radius [nm],gamma [mJ/m2]", "100,25,", "50,25,", ""]))
    assert (ran.code, "; the last column has no header and is empty" in ran.err) == (0, True)
    assert [line.split(",")[:3] for line in written()] == [
        ["radius [nm]", "gamma [mJ/m2]", ""],
        ["100", "25", ""],
        ["50", "25", ""],
    ]


def test_quotes_are_read_in_a_table_with_blanks_between_columns() -> None:
    r"""R writes a quote in a cell as \", which becomes "". A backslash at the end of a cell stays a backslash."""
    text = b'# "a" comment\'s "quote\n"x y" 5" "" "a\t""b"""\r\n"say \\"hi\\" now" "C:\\"  "\\n"\n'
    assert tabbed(text).split(b"\n") == [
        b'#"a"\tcomment\'s\t"quote',
        b'"x y"\t5"\t""\t"a\t""b"""',
        b'"say ""hi"" now"\t"C:\\"\t"\\n"',
        b"",
    ]
    lines = Delimited(" ")
    lines.read_header(b"a\tb\n")
    assert [cells for *_, cells, _ in lines.records(['"a\t""b"""\t"C:\\"\n'])] == [['a\t"b"', "C:\\"]]


@pytest.mark.parametrize("line", ['"open 2', '"a"b 2', '1 "a', '"' * 3 + " 2", '"a' * 10_000])
def test_an_unclosed_quote_between_blanks_is_named(run: Run, line: str) -> None:
    ran = batch(run, f'radius_nm "n"\n\n100 "a b"\n{line}\n', f"--delimiter blank {ASKED}", "x.txt")
    assert (ran.code, "line 4: a quote is not closed in '" in ran.err) == (2, True)
    assert ran.err.endswith("write tabs between the columns, and --format tsv\n")


# --- Rows of units ----------------------------------------------------------------------------------------------------

UNITS = [
    ("radius,gamma", "nm,mJ/m2", "100,25"),
    ("radius,gamma", "[nm],(mJ/m2)", "100,25"),
    ("radius,gamma", "µm,mJ/m²", "0.1,25"),
    ("radius [nm],gamma", "nm,mN/m", "100,25"),
    ("radius [nm],gamma", ",mJ/m2", "100,25"),
    ("radius [um],gamma", "µm,mJ/m2", "0.1,25"),
    ("R1,gamma,n", "nm,mJ/m2,", "100,25,5"),
    ("n,material,radius,T", "-,,nm,K", "5,quartz,100,293"),
    ("n,material,radius,T", "#,name,nm,deg. C", "5,quartz,100,20"),
    ("radius,gamma,nu,gamma_err,±", "nm,mJ/m2,-,,", "100,25,0.2,,"),
    ("radius,gamma,nu", "nm,mJ/m2,1", "100,25,0.2"),
    ("E,radius,gamma,nu", "Gpa,nm,mJ.m-2,-", "70,100,25,0.2"),
]


@pytest.mark.parametrize(
    ("head", "units", "row", "mark", "words"),
    [
        *((*cells, ",", "") for cells in UNITS),
        *((*UNITS[2], mark, f"--delimiter {word}") for mark, word in (("\t", "tab"), (";", "semicolon"), ("|", "bar"))),
    ],
)
def test_a_row_of_units_is_read(run: Run, head: str, units: str, row: str, mark: str, words: str) -> None:
    lines = [line.replace(",", mark) for line in (head, units, row, row)]
    target = "out.tsv" if mark == "\t" else "out.csv"
    ran = batch(run, "\n".join([*lines, ""]), words, "x.csv", target)
    assert (ran.code, "; units: line 2" in ran.err, "failed" in ran.err) == (0, True, False), ran.err
    found = written(target)
    assert [line[: len(given)] for line, given in zip(found, lines, strict=True)] == lines
    below = zip(found[1:], lines[1:], strict=True)
    of_units, *results = [line.removeprefix(given).split(mark)[1:] for line, given in below]
    assert of_units == [*[""] * (len(results[0]) - 1), "row of units"]
    assert [(float(result[0]), result[-1]) for result in results] == [(approx(OF_25), "")] * 2


@pytest.mark.parametrize(("head", "units", "row"), UNITS)
def test_a_row_of_units_equals_units_in_the_header(run: Run, head: str, units: str, row: str) -> None:
    """The notes and the numbers are the same."""
    plain = [each.strip("[]()") for each in units.split(",")]
    pairs = zip(head.split(","), plain, strict=True)
    known = ("nm", "µm", "mJ/m2", "mJ/m²", "mN/m", "K", "Gpa", "mJ.m-2")
    heads = [f"{name} [{unit}]" if unit in known and "[" not in name else name for name, unit in pairs]
    ran = batch(run, f"{head}\n{units}\n{row}\n")
    rows = written()[2:]
    other = batch(run, f"{','.join(heads)}\n{row}\n")
    assert (ran.code, rows) == (other.code, written()[1:])
    assert ran.err.replace("; units: line 2", "").replace("nu [1]", "nu") == other.err


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("radius;gamma\nnm;mJ/m2\n100,5;25\n", "--delimiter semicolon"),
        ("radius gamma\n nm   mJ/m2\n100.5 25\n", "--delimiter blank"),
        ("# radius gamma\n# nm mJ/m2\n100.5 25\n", "--delimiter blank"),
        ("\ufeff# made\n#radius gamma\n#[nm] [mJ/m2]\n100.5 25\n", "--delimiter blank"),
        ("sep=;\nradius;gamma\n\nnm;mJ/m2\n\n100,5;25\n", "--delimiter semicolon"),
        ('"radius"\t"gamma"\r\n"nm"\t"mJ/m2"\r\n"100.5"\t25\r\n', "--delimiter tab"),
    ],
)
def test_a_row_of_units_is_read_in_every_layout(run: Run, text: str, words: str) -> None:
    target = "out.csv" if "semicolon" in words else "out.tsv"
    ran = batch(run, text, words, "x.txt", target)
    assert (ran.code, "read: radius [nm], surface_energy [mJ/m2] from gamma [mJ/m2]; " in ran.err) == (0, True), ran.err
    _, of_units, row = written(target)
    assert of_units.endswith("row of units")
    mark = ";" if target == "out.csv" else "\t"
    assert float(row.split(mark)[2].replace(",", ".")) == approx(1.005 * OF_25)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        # It is not clear that the row is a row of units.
        (
            "radius,gamma,n\nnm,mJ/m2,5\n100,25,3\n",
            "the row below holds units, not values. Delete that row, and write --column 'radius=",
        ),
        ("n,radius,gamma\n1,nm,mJ/m2\n2,100,25\n", "the row below holds units, not values"),
        ("radius,gamma\nnm,25\n100,25\n", "the row below holds units, not values"),
        ("radius,gamma\nnm,kg\n100,25\n", "the row below holds units, not values"),
        ("radius,gamma\nnm,10^-3 J/m2\n100,25\n", "the row below holds units, not values"),
        (
            "radius,gamma\n-,-\n100,25\n",
            "'radius' (first cell '100') and 'gamma' (first cell '25'): no unit in the header or in the first cell",
        ),
        (
            "radius,gamma\nnm,-\n100,25\n",
            "'gamma' (first cell '25'): no unit in the header or in the first cell. Write --column 'gamma=",
        ),
        # The header has another unit.
        (
            "radius [nm],gamma\num,mJ/m2\n100,25\n",
            "'radius [nm]' is above 'um' in the row of units, line 2: make the two agree, or delete the row",
        ),
        ("# a\nradius,gamma_J_m2\nnm,mJ/m2\n100,25\n", "'gamma_J_m2' is above 'mJ/m2' in the row of units, line 3"),
        ("radius,gamma,nu [-]\nnm,mJ/m2,%\n100,25,20\n", "header: 'nu [-]' is above '%'"),
        # The meaning is unclear even with the unit, as it is with a unit in the header.
        (
            "r,gamma\nnm,mJ/m2\n100,25\n",
            "'r [nm]' (first cell '100'): r may be a radius or a distance. Write --column 'r [nm]=",
        ),
        ("radius,gamma,gamma_var\nnm,mJ/m2,mJ/m2\n100,25,2\n", "'gamma_var [mJ/m2]' (first cell '2'): it may be"),
    ],
)
def test_unclear_or_contradictory_rows_of_units_are_refused(run: Run, text: str, said: str) -> None:
    ran = batch(run, text)
    assert (ran.code, said in ran.err, Path("out.csv").exists()) == (2, True, False), ran.err


def test_option_column_goes_with_a_row_of_units(run: Run) -> None:
    """Option --column names a column with or without its unit. It outranks the row of units and the header."""
    for column in ("r [nm]=radius [nm]", "r=radius", "r=radius [nm]", "r [nm]=radius"):
        ran = batch(run, "r,gamma\nnm,mJ/m2\n100,25\n", f"--column '{column}'")
        assert (ran.code, float(written()[2].split(",")[2])) == (0, approx(OF_25)), ran.err
    ran = batch(run, "r,gamma\npx,mJ/m2\n2,25\n", "--column 'r=radius [um]'")
    assert (ran.code, float(written()[2].split(",")[2])) == (0, approx(20 * OF_25))
    ran = batch(run, "r,radius,gamma\npx,nm,mJ/m2\n2,100,25\n", "--column 'r='")
    assert (ran.code, float(written()[2].split(",")[3])) == (0, approx(OF_25))


def test_a_table_that_has_only_a_row_of_units_has_no_contacts(run: Run) -> None:
    ran = batch(run, "radius,gamma\nnm,mJ/m2\n")
    assert (ran.code, written()) == (
        0,
        ["radius,gamma,pull_off_force [N],status", "nm,mJ/m2,,row of units"],
    )
    reading = "read: radius [nm], surface_energy [mJ/m2] from gamma [mJ/m2]; units: line 2"
    assert ran.err == f"{reading}\nnote: the table has no rows\n"


def test_a_row_of_units_is_not_a_contact(run: Run) -> None:
    """A row of units counts in line numbers, but not in row numbers."""
    text = 'radius,gamma,"a\nb"\nnm,mJ/m2,\n100,25,1\nx,25,2\n'
    ran = batch(run, text, "--material quartz")
    assert ran.err.splitlines()[-2:] == [
        "note: radius: 'x' does not begin with a number; expected a length such as 100nm: row 2",
        "jkroll: 1 of 2 rows failed; column status has the reasons",
    ]
    assert "; units: line 3" in ran.err
    assert batch(run, text, "--strict").err.splitlines()[-1].startswith("jkroll: line 5: radius: 'x'")
    measured = "--infer gamma --measured pull_off_force --column 'F=pull_off_force'"
    Path("pulled.csv").write_text("radius,F,n\num,nN,\n2,300,a\n2,290,b\n", encoding="utf-8")
    ran = run("batch", "pulled.csv", *shlex.split(measured), "--radius2", "plane", "-o", "out.csv")
    assert (ran.code, "note: surface_energy by JKR: 2 of 2 rows" in ran.err) == (0, True)
    assert written()[1] == "um,nN,,,,row of units"


@pytest.mark.parametrize("form", ["csv.gz", "tsv.gz", "csv.zst"])
def test_a_row_of_units_is_read_in_compressed_tables_and_pipes(run: Run, form: str) -> None:
    from jkroll.tables.files import COMPRESSIONS, compressed, decompressed

    kind = COMPRESSIONS[form.partition(".")[2]]
    if kind == "zstd":
        pytest.importorskip("zstandard")
    mark = "," if form.startswith("csv") else "\t"
    text = "radius,gamma\nnm,mJ/m2\n100,25\nx,25\n".replace(",", mark).encode()
    Path(f"x.{form}").write_bytes(compressed(text, kind))
    assert run(f"batch x.{form} {FORCE} -o out.{form}").code == 1
    with Path(f"out.{form}").open("rb") as file:
        found = b"".join(decompressed(file, kind, "out"))
    command = [sys.executable, "-m", "jkroll", "batch", "-", *FORCE.split(), "--format", form.partition(".")[0]]
    piped = subprocess.run(command, input=text, capture_output=True)
    assert (piped.returncode, piped.stdout) == (1, found)
    assert [line.split(mark.encode())[-1] for line in found.splitlines()] == [
        b"status",
        b"row of units",
        b"",
        b"bad radius",
    ]


@pytest.mark.slow
def test_a_row_of_units_is_the_same_for_any_number_of_processes(run: Run) -> None:
    from random_tables import IN_SMALL_BLOCKS

    Path("small.py").write_text(IN_SMALL_BLOCKS.replace("1 << 14", "1 << 11"), encoding="utf-8")
    rows = "".join(f"{radius},25\n" for radius in range(1, 20_000))
    assert batch(run, f"radius,gamma\nnm,mJ/m2\n{rows}", "--jobs 1").code == 0
    command = [sys.executable, "small.py", "batch", "x.csv", *FORCE.split(), "--jobs", "3"]
    assert subprocess.run(command, capture_output=True).stdout == Path("out.csv").read_bytes()


def test_option_excel_safe_puts_an_apostrophe_before_a_formula_in_a_row_of_units(run: Run) -> None:
    assert batch(run, "radius,gamma,n\nnm,mJ/m2,=1+1\n100,25,2\n", "--excel-safe").code == 0
    assert written()[1] == "nm,mJ/m2,'=1+1,,row of units"


ORIGIN = "Long Name\tRadius\tSurface energy\r\n{}1\t100\t25\r\n2\t50\t25\r\n"
OF_ORIGIN = {"units": "Units\tnm\tmJ/m2\r\n", "comments": "Comments\tby AFM\t\r\n", "none": "\t\t\r\n"}


@pytest.mark.parametrize("rows", [["units"], ["units", "comments"], ["comments", "units"], ["units", "none"]])
def test_rows_of_units_and_comments_written_by_origin_are_not_contacts(run: Run, rows: list[str]) -> None:
    ran = batch(run, ORIGIN.format("".join(OF_ORIGIN[row] for row in rows)), "", "x.tsv")
    assert (ran.code, f'; units: line {2 + rows.index("units")}; passed through: "Long Name"' in ran.err) == (0, True)
    found = [line.split("\t") for line in written("out.tsv")[1:]]
    assert [row[-1] for row in found] == [f"row of {'units' if row == 'units' else 'comments'}" for row in rows] + [
        "",
        "",
    ]
    assert [float(row[3]) for row in found[-2:]] == [approx(OF_25), approx(OF_25 / 2)]


def test_a_row_of_comments_without_a_label_is_a_failed_row(run: Run) -> None:
    ran = batch(run, "Radius\tSurface energy\nnm\tmJ/m2\nFig. 1\tby AFM\n100\t25\n", "", "x.tsv")
    assert (ran.code, "radius: 'Fig. 1' does not begin with a number" in ran.err) == (1, True)
    assert ran.err.endswith("1 of 2 rows failed; column status has the reasons\n")


def test_a_table_in_json_has_no_row_of_units(run: Run) -> None:
    Path("x.ndjson").write_text('{"radius":"nm","gamma":"mJ/m2"}\n{"radius":100,"gamma":25}\n', encoding="utf-8")
    ran = run(f"batch x.ndjson {FORCE} -o out.ndjson")
    assert (ran.code, "the row below holds units, not values" in ran.err) == (2, True)


# --- Files with the extension .txt ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ("R1 [nm]\tgamma [mJ/m2]\n100\t25\n",
         ["R1 [nm]\tgamma [mJ/m2]\tpull_off_force [N]\tstatus", "100\t25\t1.1780972450961723e-8\t"]),
        ("R1 [nm];gamma [mJ/m2]\r\n100,0;25\r\n",
         ["R1 [nm];gamma [mJ/m2];pull_off_force [N];status", "100,0;25;1,1780972450961723e-8;"]),
        ("# Exported\n# R1_nm gamma_mJ_m2\n100  25\n",
         ["R1_nm\tgamma_mJ_m2\tpull_off_force [N]\tstatus", "100\t25\t1.1780972450961723e-8\t"]),
        ("R1 [nm]\n100\n", ["R1 [nm],pull_off_force [N],status", "100,1.1780972450961723e-8,"]),
    ],
)  # fmt: skip
def test_the_first_lines_of_a_txt_file_tell_its_separator(run: Run, text: str, lines: list[str]) -> None:
    ran = batch(run, text, "--gamma 25mJ/m2 --quiet", "x.txt", "out.txt")
    assert (ran.code, ran.err) == (0, "")
    assert written("out.txt") == lines


def test_a_txt_file_that_may_have_either_of_two_separators_is_refused(run: Run) -> None:
    ran = batch(run, "R1, nm;gamma, mJ/m2\n100,5;25,2\n", "", "x.txt")
    said = "jkroll: 'x.txt' may be divided by commas or by semicolons; write --delimiter comma or semicolon\n"
    assert (ran.code, ran.err) == (2, said)
    assert batch(run, "R1, nm;gamma, mJ/m2\n100,5;25,2\n", "--delimiter semicolon", "x.txt", "out.csv").code == 0
