"""Plain TOML: what is read at all is what tomllib reads."""

import tomllib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from harness import Run
from invariants import CORPUS
from jkroll.materials.file import MAX_BYTES, MAX_ODD_BYTES
from jkroll.materials.library import SHIPPED
from jkroll.materials.plain_toml import NotPlain, read_plainly
from shapes import SHAPES, ordinary

KEYS = (
    "a",
    "b",
    "notes",
    "notes.a",
    "notes.b",
    "materials",
    "materials.a",
    "a.b.c",
    '"a"',
    "a-1",
    "1",
    "",
    " a",
    "é",
    "a b",
)
TEXTS = (
    '"x"',
    "'x'",
    '""',
    "''",
    '"a\\"b"',
    '"\\u00e9"',
    '"\\x"',
    '"é, # ] }"',
    '"""x"""',
    '"""',
    "'''",
    "'''x",
    '"x',
    "x",
    '"\t"',
    '"\x7f"',
)
VALUES = (
    *TEXTS, "1", "0.5", "01", "1.", ".5", "-1.5", "1e3", "nan", "true", "1979-05-27", "0x1F", "1_000.5", "1.5.5",
    "[]", '["x"]', '["x", "y",]', "[,]", '["x" "y"]', '["x",, "y"]', '["x"', "[", "]", "[1, [2]]", '["x,y", "]"]', "{}", "{ a = 'x' }",
    '{ a = "x", b.c = "y" }', '{ a = "x", a = "y" }', "{", "}", "{ a = 'x', }", "", "=", "x = 1", "1 2",
    '[\n"x",\n  "y"\n]', '[ # c\n"x"\n]', "[\n]", "[\n\n\t] # c", '[\n"""\n]\n"""\n]', '["x",\n"y"]', '[\n"x"\n] x', '[\n"x"\n], "y"]',
    "[\n1,\n]", '[\n"x\n]', '[\n"""  x\n  ]  """ ]', "[\n'x', # ]\n]", "[\n[\n]\n]", '[\n"x"\n]\na = "y"', '{ a = [\n"x"\n] }', "['x', \"y\"]", "['x' # y]", "['\"']", '["\'"]', "'x' 'y'", "['x\n']", "{a = 'x', b=\"y, c = 'z'\" }", "{a='x',}", "{a='x' b='y'}", "{ a-1 = 'x' } # c", "{a='x', a='y'}", "{'a'='x'}", "{a = 'x\n'}",
    '[ """x  \ny"""\n]', "[ \'\'\'x \t\ny\'\'\'\n]", "12345678901234567890", "1234567890123456", "-1", "+1", "00", "1 .5", "1.5e3", "[1]",
)  # fmt: skip
HEADERS = (
    "[materials.a]", "[materials.b]", "[references.a]", '[materials."a b"]', "[materials.'a']", '[materials.""]', "[ materials . a ]",
    "[materials]", "[a]", "[a.b]", "[materials.a.notes]", "[[materials.a]]", "[materials.a] x", "[materials.a", "[materials.a.]", "[.a]",
    "[materials.a.a]", "[materials.b.notes] # c", '[materials."a b".b]', "[materials.a.b.c]", "[references.a.materials]",
)  # fmt: skip
SPACES = st.sampled_from(("", "", " ", "\t", "  "))
COMMENTS = st.sampled_from(("", "", "", "# x", "#", '# "', "# \x00", "#\u2028", "x", "\\", "\r"))
LINES = st.one_of(
    st.tuples(SPACES, st.sampled_from(KEYS), SPACES, st.just("="), SPACES, st.sampled_from(VALUES), SPACES, COMMENTS),
    st.tuples(SPACES, st.sampled_from(HEADERS), SPACES, COMMENTS),
    st.tuples(SPACES, COMMENTS),
    st.tuples(st.text(alphabet="[]{}materials.a=\"'\\,# \t\r1", max_size=20)),
).map("".join)


def agrees(text: str) -> bool:
    """Whether a text is read plainly; then as tomllib reads it."""
    try:
        found = read_plainly(text)
    except NotPlain as error:
        assert 1 <= error.line <= text.count("\n") + 1
        return False
    assert repr(found) == repr(tomllib.loads(text)), text
    return True


@settings(max_examples=2000)
@given(st.lists(LINES, max_size=8).map("\n".join))
def test_random_lines(text: str) -> None:
    agrees(text)
    agrees(text.replace("\n", "\r\n"))


@pytest.mark.slow
@settings(max_examples=20_000)
@given(st.lists(LINES, max_size=8).map("\n".join))
def test_very_many_random_lines(text: str) -> None:
    agrees(text)


def test_each_value_behind_each_key() -> None:
    texts = [
        f"{head}\n{key} = {value}{end}" for head in HEADERS for key in KEYS for value in VALUES for end in ("", " # x")
    ]
    assert 0.05 < sum(map(agrees, texts)) / len(texts) < 0.9


def test_what_fuzzing_found() -> None:
    paths = [*(CORPUS / "materials").iterdir()]
    assert 0 < sum(agrees(path.read_bytes().decode("utf-8", "ignore")) for path in paths) < len(paths)


def test_no_shape_is_read_otherwise() -> None:
    for shape in SHAPES.values():
        agrees(shape(20_000).decode("utf-8", "ignore"))


def test_files_as_they_are_written_are_plain() -> None:
    assert agrees(Path(SHIPPED).read_text(encoding="utf-8"))
    assert agrees(ordinary(MAX_BYTES).decode())


def test_a_large_file_that_is_not_plain_names_the_line(run: Run) -> None:
    text = ordinary(MAX_ODD_BYTES + 1000).decode()
    line = text.count("\n") + 1
    Path("large.toml").write_text(f"{text}[[materials.a]]\n", encoding="utf-8")
    problem = (
        f"is larger than 5 kB, and line {line} is more than a key with a text, a number, or a list or table of texts"
    )
    assert run("pull-off quartz 1um --materials large.toml").err == f"jkroll: materials file 'large.toml': {problem}\n"
    Path("small.toml").write_text("[materials.a]\nnotes = {\n", encoding="utf-8")
    assert "(at line 2, column 10)" in run("pull-off quartz 1um --materials small.toml").err
