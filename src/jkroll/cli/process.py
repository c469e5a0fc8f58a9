"""The command line as a process: it reads the words, runs the command, and prints an error as a line.

The command comes first, then its arguments and options in any order: `--to nN`, `--to=nN`, `-o x.csv` or `-ox.csv`. A
value that begins with a hyphen needs `=`, unless it is `-` or a negative number. All words after `--` are arguments.
"""

import errno
import io
import os
import sys
from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from importlib import import_module
from typing import Any

from .. import __version__
from ..errors import FAILED, BadRequest, JkrollError
from ..quantities.nomenclature import ALIKE, NOMENCLATURE, as_input, named, nearest
from ..quantities.synonyms import QUANTITY_OF_SYNONYM
from ..text import closest, first_of, quoted, say, say_wrapped, shown
from .commands import COMMANDS, Action, Command, flags_of, help_of
from .options import DEBUG, HELP, VERSION, Option

BROKEN_PIPE = 141  # exit code if the reader of stdout ends: in a shell, 128 + SIGPIPE

# Words of other programs that are understood here. An input may also be given by its name or symbol: see `_option`.
SYNONYMS: Mapping[str, str] = {
    "help": "--help",
    "manual": "guide",
    "units": "guide units",
    "version": "--version",
    "--format bare": "--bare",
    "--format csv": "--csv",
    "--format json": "--json",
    "--format markdown": "--md",
    "--format md": "--md",
    "--markdown": "--md",
    "--out": "-o",
    "--output": "-o",
    "--unit": "--to",
    "--units": "--to",
}
# Hints at what to type instead of words of other programs. A key of two words holds after that command only.
HINTS: Mapping[str, str] = {
    "verify": "jkroll guide paper has the audit of the paper",
    "plot": "jkroll map draws a quantity, jkroll figure a figure of the paper, jkroll contact --curve a force curve",
    "--format": "write --json, --csv, --md or --bare, or name a file: -o x.tsv",
    "--gamma12": "the interface energy is part of the work of adhesion: --work-of-adhesion, γ1 + γ2 - γ12",
    "--plane": "a plane is an infinite sphere 2: --radius2 plane",
    "--material": "a material needs no option: jkroll pull-off quartz 100nm",
    "--temperature": "no formula depends on it, though γ and E of a material do: jkroll materials",
    **dict.fromkeys(("-R", "--radius"), "a radius needs no option: jkroll pull-off quartz 100nm"),
    **dict.fromkeys(("export -o", "export --output", "export --out"), "it writes to standard output: add > FILE"),
    **dict.fromkeys(
        ("map --csv", "map --json", "map --md", "figure --csv", "figure --json", "figure --md"),
        "--data FILE writes the numbers as CSV",
    ),
    "map --quantities": "the quantity comes first: jkroll map a quartz 100nm --x load=-5nN:20nN",
    **dict.fromkeys(
        ("batch --json", "batch --csv", "batch --bare"), "--format or the name of the file sets the format"
    ),
    "batch --md": "name the file: -o x.md",
}
# Arguments that may also be given as options.
NAMED = {
    "MATERIAL": Option(None, "--material", metavar="quartz", name="material"),
    "RADIUS": Option(None, "--radius", metavar="100nm", name="radius"),
}
_DASHES = ("–", "—")  # dashes that word processors write for hyphens


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command line and return the exit code."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    is_debugged = DEBUG.flag in words
    words = [word for word in words if word != DEBUG.flag]

    def run() -> int:
        _check(words)
        return action_of(words)()

    return finished(run, words, is_debugged=is_debugged)


def finished(run: Action, words: Sequence[str] = (), *, is_debugged: bool = False) -> int:
    """Run an action that writes to stdout, and return the exit code; an error is printed as a line on stderr.

    `words`: the command line as typed.
    """
    if sys.stderr is None:  # stderr is closed
        sys.stderr = open(os.devnull, "w", encoding="utf-8")
    try:
        if sys.stdout is None:
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        for stream in (sys.stdout, sys.stderr):
            if isinstance(stream, io.TextIOWrapper):
                stream.reconfigure(errors="jkroll-ascii")
        code = run()
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        return BROKEN_PIPE
    except Exception as error:
        if is_debugged:
            import traceback

            traceback.print_exc()
        return report(error, words)


def _check(words: Iterable[str]) -> None:
    """Raise BadRequest for words that cannot be file names, and that no shell can pass."""
    for word in words:
        if "\0" in word:
            raise BadRequest(f"{quoted(word)} contains a NUL character")
        try:
            word.encode("utf-8", "surrogateescape")
        except UnicodeEncodeError:
            raise BadRequest(f"{quoted(word)} contains half a character (a lone surrogate)") from None


def report(error: Exception, words: Sequence[str]) -> int:
    """Print an error on stderr and return the exit code. `words`: the command line as typed."""
    code = FAILED
    if isinstance(error, JkrollError):
        from .call import message_of

        typed = [word.partition("=")[0] for word in words]
        message, code = message_of(error, typed[0] if typed else "", typed), error.exit_code
    elif isinstance(error, MemoryError):
        message = "there is not enough memory; ask for fewer rows or points"
    elif isinstance(error, OSError):
        file = f" {quoted(str(error.filename))}" if error.filename else ""
        message = f"cannot write{file}: {error.strerror or error}"
    else:
        problem = f"{type(error).__name__}: {shown(str(error))}"
        message = f"{problem}; this is a bug in jkroll: run it with {DEBUG.flag} to see where"
    with suppress(OSError):
        say_wrapped(f"jkroll: {message}", sys.stderr)
    return code


# --- Words and options ------------------------------------------------------------------------------------------------


def action_of(words: Sequence[str]) -> Action:
    """Return the action of a command line; raise BadRequest for an invalid command line."""
    first, *rest = words or (HELP.flag,)
    if rest and (first == "help" or first in HELP.flags):
        first, rest = rest[0], [HELP.flag]
    if first in SYNONYMS:
        first, *rest = *SYNONYMS[first].split(), *rest
    if first in COMMANDS:
        return _action_of_command(COMMANDS[first], rest)
    if not first.startswith("-") or first in ("-", "--"):
        raise _no_such_command(first)
    _, given = _parsed([first], flags_of(None))
    if HELP.name in given:
        return partial(_print_help, None)
    if VERSION.name in given:
        return partial(_print, f"jkroll {__version__}")
    raise BadRequest(f"{first} takes nothing else: jkroll {first}")


def _action_of_command(command: Command, words: Sequence[str]) -> Action:
    """Return the action of a command. `words`: the words after its name."""
    end = words.index("--") if "--" in words else len(words)
    if any(flag in words[:end] for flag in HELP.flags):
        return partial(_print_help, command.name)
    named_arguments = [option for placeholder, option in NAMED.items() if placeholder in command.placeholders]
    flags = {option.flag: option for option in named_arguments} | command.flags()
    arguments, options = _parsed(words[:end], flags, command)
    arguments += words[end + 1 :]
    for option in named_arguments:
        if option.name in options:
            arguments.append(options.pop(option.name))
    if len(arguments) > command.most_words:
        extra = quoted(arguments[int(command.most_words)])
        raise BadRequest(f"{extra} is one word too many: jkroll {command.name} {command.words}".rstrip())
    from .call import Call

    module, _, function = command.runner.partition(":")
    run = getattr(import_module(f".{module}", __package__), function)
    return partial(run, Call(command, arguments, options))


def _print_help(name: str | None) -> int:
    """Print the help of a command, or of the program; return exit code 0."""
    return _print(help_of(name))


def _print(text: str) -> int:
    say(text, sys.stdout)
    return 0


def _parsed(
    words: Iterable[str], flags: Mapping[str, Option[Any]], command: Command | None = None
) -> tuple[list[str], dict[str, Any]]:
    """Return the arguments, and the values of the options by name."""
    placeholders = command.placeholders if command else ()
    arguments: list[str] = []
    given: dict[str, Any] = {}
    rest = deque(words)
    while rest:
        word = rest.popleft()
        name, has_value, _ = word.partition("=")
        if "RADIUS" in placeholders and has_value and not word.startswith("-") and _option(f"--{name}", flags):
            word = f"--{word}"  # gamma=25mJ/m2
        elif word[:1] in _DASHES and word[1:2].isalpha() and "IN" not in placeholders:
            raise BadRequest(f"{quoted(word)} begins with a dash; options begin with hyphens: --{word[1:]}")
        elif not word.startswith("-") or word == "-" or ("IN" in placeholders and _is_negative(word)):
            arguments.append(_with_unit(word, rest) if "RADIUS" in placeholders else word)
            continue
        flag, value = flag_and_value(word, flags)
        following = rest[0] if value is None and rest else value
        meant = SYNONYMS.get(f"{flag} {following}")  # --format json
        if meant and flag not in flags:
            if value is None:
                rest.popleft()
            flag, value = meant, None
        option = _option(flag, flags)
        if option is None:
            raise _no_such_option(flag, command.name if command else None)
        if not option.metavar:
            if value is not None:
                raise BadRequest(f"{option.flag} takes no value: leave {quoted('=' + value)} out")
            given[option.name] = True
        elif option.repeats:
            given[option.name] = (*given.get(option.name, ()), _value(option, value, rest))
        elif option.name in given:
            raise BadRequest(f"{option.flag} is given more than once")
        else:
            given[option.name] = option.parsed(_value(option, value, rest))
    return arguments, given


def flag_and_value(word: str, flags: Mapping[str, Option[Any]]) -> tuple[str, str | None]:
    """Return the flag of a word and the value joined to it, as in --to=nN and -ox.csv; None without a value."""
    flag, has_value, value = word.partition("=")
    short = flags.get(word[:2])
    if short is not None and short.metavar and word[2:] and _option(f"-{flag}", flags) is None:
        return word[:2], word[2:].removeprefix("=")
    return flag, value if has_value else None


def _value(option: Option[Any], value: str | None, rest: deque[str]) -> str:
    """Return the value of an option: the joined value, or the next word, with a unit that may be a word of its own."""
    if value is None:
        following = rest[0] if rest else HELP.flag
        if following.startswith("-") and following != "-" and not _is_negative(following):
            raise BadRequest(f"{option.flag} needs a value, as in {option.flag} {option.metavar}")
        value = rest.popleft()
    quantity = NOMENCLATURE.get(option.name)
    if quantity is None or quantity.unit in ("", "1"):
        return value
    return _with_unit(value, rest)


def _with_unit(word: str, rest: deque[str]) -> str:
    """Return a word, together with the next word if they are a number and its unit."""
    is_number = word[-1:].isdigit() and not word.strip("+-−±().0123456789eE")
    if is_number and rest and rest[0][:1].isalpha() and rest[0].casefold() not in ("plane", "all"):
        return f"{word} {rest.popleft()}"
    return word


def _is_negative(text: str) -> bool:
    """Return whether a text begins like a negative number."""
    return len(text) > 1 and text[0] == "-" and text[1] in "0123456789."


def _option(flag: str, flags: Mapping[str, Option[Any]]) -> Option[Any] | None:
    """Return the option of a flag, of its synonym, or of an input with this name or symbol; None if there is none."""
    option = flags.get(flag) or flags.get(SYNONYMS.get(flag, ""))
    if option:
        return option
    by_name = {option.name: option for option in flags.values() if option.name in NOMENCLATURE}
    return by_name.get(named(as_input(flag).lstrip("-"), by_name)) if flag.startswith("--") else None


# --- Mistakes ---------------------------------------------------------------------------------------------------------


def _no_such_command(word: str) -> BadRequest:
    """Return the error for a first word that is not a command."""
    name = word.replace("-", "_").casefold()
    if name in HINTS:
        hint = HINTS[name]
    elif command := closest(name.replace("_", "-"), COMMANDS):
        hint = f"did you mean {command}?"
    elif quantity := nearest(name):
        hint = f"did you mean the quantity {quantity}? jkroll quantities {quantity} lists the commands that show it"
    else:
        hint = "see jkroll --help, or write, for example, jkroll pull-off quartz 100nm"
    return BadRequest(f"no such command {quoted(word)}; {hint}")


def _no_such_option(flag: str, command: str | None) -> BadRequest:
    """Return the error for an option that a command, or the program itself, does not take."""
    if _is_negative(flag):
        remedy = "a negative value follows the option that takes it: --load -5nN"
        return BadRequest(f"{quoted(flag)} begins with a hyphen, as options do; {remedy}")
    flags = flags_of(command)
    everywhere: dict[str, Any] = {}
    for other in COMMANDS.values():
        everywhere |= other.flags()
    problem = f"no such option {quoted(flag)}"
    if flag in everywhere:
        problem, flags = f"{command or 'jkroll without a command'} takes no {quoted(flag)}", {}
    hint = HINTS.get(f"{command} {flag}") or HINTS.get(flag)
    if hint:
        return BadRequest(f"{problem}; {hint}")
    if guess := _meant(flag, flags):
        return BadRequest(f"{problem}; did you mean {guess}?")
    if guess := _meant(flag, everywhere):
        commands = [other.name for other in COMMANDS.values() if guess in other.flags()]
        return BadRequest(f"{problem}; {guess} is an option of {first_of(commands)}")
    return BadRequest(f"{problem}; see {' '.join(filter(None, ['jkroll', command]))} --help")


def _meant(flag: str, flags: Mapping[str, Option[Any]]) -> str | None:
    """Return the flag that a word probably means, as a synonym, an abbreviation or a misspelling; None without one."""
    name = flag.lstrip("-").replace("-", "_").casefold()
    option = _option(f"--{flag.lstrip('-')}", flags)
    if option is not None:
        return option.flag
    spellings = {option.name: spelling for spelling, option in flags.items()}
    of_synonym = spellings.get(QUANTITY_OF_SYNONYM.get(name, ""))
    if of_synonym is not None:
        return of_synonym
    known = {spelling.lstrip("-").replace("-", "_"): spelling for spelling in flags}
    beginning = [word for word in known if name and word.startswith(name)]
    likely = min(beginning, key=len) if beginning else closest(name, known, ALIKE)
    return known.get(likely or "")
