"""Completion with TAB in real shells, each on its own terminal."""

import json
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from jkroll.cli.completion import candidates as candidates_for
from shells import Shell

# Typed keys, and the words of the completed command. Keys after a TAB continue at the end of its completion.
TYPED = {
    "commands": ("yie\t quartz", ["yield-force", "quartz"]),
    "a material": ("pull-off qua\t 1um", ["pull-off", "quartz", "1um"]),
    "a material in quotes": ("pull-off 'qua\t", ["pull-off", "quartz"]),
    "a second material of a list": ("pull-off quartz,ir\t", ["pull-off", "quartz,iron"]),
    "a unit": ("pull-off quartz 100n\t", ["pull-off", "quartz", "100nm"]),
    "an option, and its unit": ("r-min 1um --rad\t2n\t", ["r-min", "1um", "--radius2", "2nm"]),
    "a file": ("materials --materials mine.to\t", ["materials", "--materials", "mine.toml"]),
    "an unknown word": ("pull-off zz\t", ["pull-off", "zz"]),
}
# Only the last of these names is one word to a shell.
NAMES = [
    "za$(touch hacked)",
    "zb`touch hacked`",
    "zc;touch hacked",
    "zd two",
    "ze*",
    "zf'x'",
    'zg"x"',
    "zh>hacked",
    "zy_+é",
]
NAMED = "".join(f"[materials.{json.dumps(name, ensure_ascii=False)}]\n" for name in NAMES)


@pytest.fixture(
    scope="module",
    params=["bash", pytest.param("zsh", marks=pytest.mark.slow), pytest.param("fish", marks=pytest.mark.slow)],
)
def shell(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Shell]:
    """A shell whose user has a materials file. If the shell is missing, tests fail in CI and are skipped elsewhere."""
    program = shutil.which(request.param)
    if program is None:
        message = f"{request.param} is not installed: its completion is not tested"
        if os.environ.get("CI"):
            pytest.fail(message)
        pytest.skip(message)
    directory = tmp_path_factory.mktemp(request.param)
    (directory / "mine.toml").write_text(NAMED, encoding="utf-8")
    shell = Shell(request.param, program, directory, JKROLL_MATERIALS=str(directory / "mine.toml"))
    yield shell
    shell.close()


@pytest.mark.parametrize("what", TYPED)
def test_tab_completes(shell: Shell, what: str) -> None:
    keys, words = TYPED[what]
    assert shell.words_of(f"jkroll {keys}") == words


def offered(line: str) -> list[str]:
    """Return the candidates for the last word of a line."""
    _, *words, begun = line.split(" ")
    return [word for word, _ in candidates_for(words, begun)]


def test_only_names_that_are_one_word_are_offered(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "mine.toml").write_text(NAMED, encoding="utf-8")
    monkeypatch.setenv("JKROLL_MATERIALS", "mine.toml")
    assert offered("jkroll pull-off zy") == [NAMES[-1]]


@pytest.mark.parametrize(
    ("line", "candidates"),
    [
        ("jkroll figure 3a --mark quar", ["quartz"]),
        ("jkroll materials SiO", ["SiO2"]),
        ("jkroll contact quartz 1um --material2 ir", ["iron"]),
        ("jkroll report quartz --quantities r_min,n_gr", ["r_min,n_grav"]),
        ("jkroll quantities r_", ["r_min", "r_min_over_radius"]),
        ("jkroll map r_", ["r_min", "r_min_over_radius"]),
        ("jkroll report quartz --quantities surf", []),
        ("jkroll map r_min qua", ["quartz"]),
        ("jkroll export l", ["lammps", "liggghts"]),
        ("jkroll export lammps l", ["lactose-crystalline", "lactose-amorphous"]),
        ("jkroll pull-off --model m", ["maugis"]),
        ("jkroll guide wo", ["words"]),
        ("jkroll contact --model dmt,j", ["dmt,jkr"]),
        ("jkroll contact --gamma 5mJ", ["5mJ/m2"]),
        ("jkroll contact --material2 = ir", ["iron"]),  # bash splits --material2=ir like this
        ("jkroll contact --radius2 = 100n", ["100nm"]),
        ("jkroll contact --model = ma", ["maugis"]),
        ("jkroll contact --material2=ir", ["iron"]),
        ("jkroll pull-off quartz gamma=5mJ", ["5mJ/m2"]),
        ("jkroll pull-off quartz gama=", []),
        ("jkroll pull-off --quiet=25", []),
        ("jkroll --json gamma=", []),
        ("jkroll batch --jo", ["--jobs"]),
        ("jkroll batch gr", []),
        ("jkroll --v", ["--version"]),
    ],
)
def test_the_last_word_of_a_line_has_these_candidates(line: str, candidates: list[str]) -> None:
    assert offered(line) == candidates


def test_an_option_is_offered_once() -> None:
    assert "--radius2" in offered("jkroll r-min --")
    assert "--radius2" not in offered("jkroll r-min --radius2 1um --")
    assert "--radius2" not in offered("jkroll r-min --radius2=1um --")
    assert "-o" not in offered("jkroll r-min -ox.csv -")


def test_no_name_in_a_file_becomes_a_command(shell: Shell) -> None:
    assert shell.words_of(f"jkroll pull-off {NAMES[0][:2]}\t") == ["pull-off", NAMES[0][:2]]
    assert shell.words_of("jkroll pull-off zy\t") == ["pull-off", NAMES[-1]]
    assert not (shell.words.parent / "hacked").exists()


@pytest.mark.parametrize("word", ["$(touch hacked),qu", r"\$(touch hacked),qu", "`touch hacked`,qu"])
def test_completion_runs_nothing_in_the_typed_words(shell: Shell, word: str) -> None:
    typed = "".join(character if character.isalnum() or character == "," else f"\\{character}" for character in word)
    assert shell.words_of(f"jkroll pull-off {typed}\t") == ["pull-off", word]
    assert not (shell.words.parent / "hacked").exists()


def test_a_broken_materials_file_does_not_disturb_completion(shell: Shell) -> None:
    path = shell.words.parent / "mine.toml"
    content = path.read_bytes()
    path.write_text("[materials", encoding="utf-8")
    assert shell.words_of("jkroll pull-off qua\t") == ["pull-off", "quartz"]
    assert b"materials file" not in shell.screen
    path.write_bytes(content)
