"""Reader of plain command lines, which need no typer."""

import os
import re
from collections.abc import Mapping, Sequence
from functools import partial

from ..answers.questions import COMMANDS
from .calls import Call, _show_help, _show_version, call
from .options import EXTRAS, Option, flags_of, room_for_words

COMPLETE = "_JKROLL_COMPLETE"  # the variable in which a shell asks for completions


def quick_call(words: list[str]) -> Call | None:
    """The call that plain words ask for; None for whatever typer had better look at. UnknownOption for what is none."""
    if os.environ.get(COMPLETE):
        from .tab import quick_answer

        return quick_answer(os.environ)
    name = words[0] if words[0] in COMMANDS or words[0] in EXTRAS else None
    flags = flags_of(name)
    read = read_quickly(words[1:] if name else words, flags)
    if read is None:
        unknown = first_unknown(words[1:], flags) if name else None
        if unknown is not None:
            from .mistakes import UnknownOption

            raise UnknownOption(unknown, name)
        return None
    arguments, values = read
    if "help" in values and (name or len(words) == 1):
        return partial(_show_help, name)
    if name is None:
        return _show_version if words == ["--version"] else None
    if len(arguments) > room_for_words(name):
        return None
    return call(name, arguments, values)


def with_minus_signs(words: Sequence[str]) -> list[str]:
    """Negative values with a minus sign in place of the hyphen, so that they are not taken for options."""
    before = [None, *words][: len(words)]
    return [
        "−" + word[1:] if _NEGATIVE.match(word) and option not in _TAKES_NO_QUANTITY else word
        for option, word in zip(before, words, strict=True)
    ]


_NEGATIVE = re.compile(r"-[0-9.]")


_TAKES_NO_QUANTITY = ("--to", "--digits", "--materials")


def read_quickly(words: list[str], options: Mapping[str, Option]) -> tuple[list[str], dict[str, object]] | None:
    """The arguments and option values of plain words; None for whatever is not plain."""
    arguments: list[str] = []
    values: dict[str, object] = {}
    rest = iter(words)
    for word in rest:
        if not word.startswith("-"):
            arguments.append(word)
            continue
        flag, has_value, text = word.partition("=")
        option = options.get(flag)
        if option is None or (has_value and (option.kind is bool or not flag.startswith("--"))):
            return None
        if option.kind is bool:
            values[option.name] = True
            continue
        text = text if has_value else next(rest, "-")
        value = _value(text, option)
        if value is None:
            return None
        values[option.name] = value
    return arguments, values


def first_unknown(words: list[str], options: Mapping[str, Option]) -> str | None:
    """The first long option among the words that is none; None if there is none, or before it something that is not plain."""
    rest = iter(words)
    for word in rest:
        flag, has_value, _ = word.partition("=")
        if not word.startswith("-"):
            continue
        option = options.get(flag)
        if option is None:
            return flag if flag.startswith("--") and len(flag) > len("--") else None
        if has_value and (option.kind is bool or not flag.startswith("--")):
            return None
        if option.kind is not bool and not has_value and next(rest, "-").startswith("-"):
            return None
    return None


def _value(text: str, option: Option) -> object:
    """The value of an option's text; None if it is not plainly one."""
    if text.startswith("-"):
        return None
    if option.kind is str:
        return text
    try:
        number = int(text) if option.kind is int and text.isdecimal() and text.isascii() else float(text)
    except ValueError:
        return None
    is_kind = isinstance(number, option.kind) and option.low is not None and option.high is not None
    return number if is_kind and option.low <= number <= option.high else None  # type: ignore[operator]
