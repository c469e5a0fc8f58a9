"""The messages for commands and options that do not exist, with what was probably meant."""

from collections.abc import Iterable

from ..errors import JkrollError
from ..quantities.errors import OTHER_WORDS
from ..quantities.nomenclature import NOMENCLATURE
from ..text import closest, quoted
from .commands import COMMANDS, flags_of

MAX_OTHERS = 3


class UnknownCommand(JkrollError):
    """Error raised for a first word that is not a command."""

    def __init__(self, word: str) -> None:
        super().__init__(word)
        self.word = word

    def __str__(self) -> str:
        name = self.word.replace("-", "_").casefold()
        if name in NOMENCLATURE:
            return f"{quoted(self.word)} is a quantity, not a command; jkroll quantities {name} lists the commands that show it"
        guess = closest(name.replace("_", "-"), COMMANDS)
        return f"no such command {quoted(self.word)}; {f'did you mean {guess}?' if guess else 'see jkroll --help'}"


class UnknownOption(JkrollError):
    """Error raised when a command, or the program before any command, does not take an option."""

    def __init__(self, flag: str, command: str | None) -> None:
        super().__init__(flag, command)
        self.flag, self.command = flag, command

    def __str__(self) -> str:
        shown, name = quoted(self.flag), self.flag.lstrip("-").replace("-", "_").casefold()
        if name[:1].isdigit() or name[:1] == ".":
            return f"{shown} begins with a hyphen, as options do; {self._correction()}"
        if (alone := OTHER_WORDS.get(name, name)) in ("radius", "material"):
            return f"no such option {shown}; a {alone} stands alone: jkroll pull-off quartz 100nm"
        program = f"jkroll {self.command}" if self.command else "jkroll"
        takers = {flag: command.name for command in reversed([*COMMANDS.values()]) for flag in command.flags()}
        own = None if self.flag in takers else _meant(name, flags_of(self.command))
        if own is not None:
            return f"no such option {shown}; did you mean {own}?"
        guess = _meant(name, takers)
        if guess is None:
            return f"no such option {shown}; see {program} --help"
        if self.command is None:
            return f"{guess} goes behind a command: jkroll {takers[guess]} ... {guess}"
        others = [command.name for command in COMMANDS.values() if guess in command.flags()]
        more = ", ..." if len(others) > MAX_OTHERS else ""
        return f"{self.command} takes no {shown}; {guess} is an option of {', '.join(others[:MAX_OTHERS])}{more}"

    def _correction(self) -> str:
        """Return how a word that begins with a hyphen and a digit can be given."""
        if self.command and COMMANDS[self.command].words.are_files:
            return f"write {quoted('./' + self.flag)} for a file of that name"
        return "a negative value follows the option that takes it: --load -5nN"


def _meant(name: str, flags: Iterable[str]) -> str | None:
    """Return the option that a name stands for, begins or resembles; None if there is none."""
    known = {flag.lstrip("-").replace("-", "_"): flag for flag in flags}
    quantity = NOMENCLATURE.get(OTHER_WORDS.get(name, name))
    if quantity is not None and quantity.option in known.values():
        return quantity.option
    begun = [word for word in known if name and word.startswith(name)]
    return known.get(begun[0] if len(begun) == 1 else closest(name, known) or "")
