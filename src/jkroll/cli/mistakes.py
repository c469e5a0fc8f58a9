"""Options that a command does not take, and what was probably meant. Read only when there is an error to word."""

from collections.abc import Iterable

from ..answers.questions import COMMANDS
from ..errors import JkrollError
from ..quantities.nomenclature import NOMENCLATURE
from ..text import closest, quoted
from .options import EXTRAS, flags_of

MAX_OTHERS = 3


class UnknownOption(JkrollError):
    """An option that a command, or the program before any command, does not take."""

    def __init__(self, flag: str, command: str | None) -> None:
        super().__init__(flag, command)
        self.flag, self.command = flag, command

    def __str__(self) -> str:
        shown, name = quoted(self.flag), self.flag.lstrip("-").replace("-", "_").casefold()
        if name in ("radius", "material"):
            return f"no such option {shown}; a {name} stands alone: jkroll pull-off quartz 100nm"
        program = f"jkroll {self.command}" if self.command else "jkroll"
        takers = {flag: command for command in (*EXTRAS, *reversed(list(COMMANDS))) for flag in flags_of(command)}
        own = None if self.flag in takers else _meant(name, flags_of(self.command))
        if own is not None:
            return f"no such option {shown}; did you mean {own}?"
        guess = _meant(name, takers)
        if guess is None:
            return f"no such option {shown}; see {program} --help"
        if self.command is None:
            return f"{guess} goes behind a command: jkroll {takers[guess]} ... {guess}"
        others = [command for command in (*COMMANDS, *EXTRAS) if guess in flags_of(command)]
        more = ", ..." if len(others) > MAX_OTHERS else ""
        return f"{self.command} takes no {shown}; {guess} is an option of {', '.join(others[:MAX_OTHERS])}{more}"


def _meant(name: str, flags: Iterable[str]) -> str | None:
    """The option that a name stands for, begins or resembles."""
    known = {flag.lstrip("-").replace("-", "_"): flag for flag in flags}
    quantity = NOMENCLATURE.get(name)
    if quantity is not None and quantity.option in known.values():
        return quantity.option
    begun = [word for word in known if name and word.startswith(name)]
    return known.get(begun[0] if len(begun) == 1 else closest(name, known) or "")
