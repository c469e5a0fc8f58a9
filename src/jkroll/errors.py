"""What can go wrong. An error carries the values that are wrong; its words are made from the nomenclature when asked for."""

from collections.abc import Sequence

from .nomenclature import NOMENCLATURE, word_for_infinity

MAX_QUOTED = 200
MAX_KNOWN = 20


class JkrollError(Exception):
    """Any error that jkroll declares. `exit_code` is what the command line ends with."""

    exit_code = 2


class QuantityError(JkrollError):
    """A text that is not a value of the quantity it was given for."""

    def __init__(self, name: str, text: str, *details: object) -> None:
        super().__init__(name, text, *details)
        self.name = name
        self.text = text

    def problem(self) -> str:
        """What is wrong, to stand behind the name and the text."""
        raise NotImplementedError

    def __str__(self) -> str:
        return f"{self.name}: {quoted(self.text)} {self.problem()}"


class MalformedQuantity(QuantityError):
    """A text outside the grammar, or a value outside the range."""

    def __init__(self, name: str, text: str, reason: str) -> None:
        super().__init__(name, text, reason)
        self.reason = reason

    def problem(self) -> str:
        """The reason, and what was expected."""
        return f"{self.reason}; expected {expectation(self.name)}"


class BareNumber(QuantityError):
    """A number where a unit is needed."""

    def problem(self) -> str:
        """What was expected."""
        return f"has no unit; expected {expectation(self.name)}"


class AmbiguousUnit(QuantityError):
    """A product after a division, which people read in two ways."""

    def __init__(self, name: str, text: str, before: str, after: str) -> None:
        super().__init__(name, text, before, after)
        self.before, self.after = before, after

    def problem(self) -> str:
        """Both readings."""
        before, after = shown(self.before), shown(self.after)
        return f"can be read as {before}*{after} or as {before}/{after}; write the one that is meant"


class UnknownUnit(QuantityError):
    """A unit name that neither the shipped table nor pint knows."""

    def __init__(self, name: str, text: str, unit: str) -> None:
        super().__init__(name, text, unit)
        self.unit = unit

    def problem(self) -> str:
        """What the unit probably is, or what was expected."""
        from .suggestions import unit_like

        guess = unit_like(self.unit, self.name)
        return f"has an unknown unit {quoted(self.unit)}; " + (
            f"did you mean {guess}?" if guess else f"expected {expectation(self.name)}"
        )


class WrongDimension(QuantityError):
    """A quantity of another kind."""

    def __init__(self, name: str, text: str, dimension: Sequence[int]) -> None:
        super().__init__(name, text, tuple(dimension))
        self.dimension = tuple(dimension)

    def problem(self) -> str:
        """What it is, and what was expected."""
        from .units import kind_of

        return f"is {kind_of(self.dimension)}; expected {expectation(self.name)}"


class UnknownMaterial(JkrollError):
    """A material that no file describes."""

    def __init__(self, name: str, known: Sequence[str], guess: str | None) -> None:
        super().__init__(name, tuple(known), guess)
        self.name, self.known, self.guess = name, tuple(known), guess

    def __str__(self) -> str:
        hint = f"did you mean {self.guess}? " if self.guess else ""
        return f"material: {quoted(self.name)} is not known; {hint}known are {', '.join(self.known[:MAX_KNOWN])}" + (
            f" and {len(self.known) - MAX_KNOWN} more" if len(self.known) > MAX_KNOWN else ""
        )


class MaterialsFileError(JkrollError):
    """A materials file that cannot be read or that says something that is no material."""

    def __init__(self, path: str, problem: str) -> None:
        super().__init__(path, problem)
        self.path, self.problem = path, problem

    def __str__(self) -> str:
        return f"materials file {quoted(self.path)}: {self.problem}"


class MissingInput(JkrollError):
    """A quantity that cannot be computed from what was given."""

    def __init__(self, wanted: str, missing: Sequence[str], instead: Sequence[str] = (), lacking: str = "") -> None:
        super().__init__(wanted, tuple(missing), tuple(instead), lacking)
        self.wanted, self.missing, self.instead, self.lacking = wanted, tuple(missing), tuple(instead), lacking

    def __str__(self) -> str:
        return f"{self.wanted} needs {self.needs()}"

    def needs(self) -> str:
        """The missing inputs, which material does not have them, and how they are given."""
        words = " and ".join(NOMENCLATURE[name].sentence for name in self.missing)
        options = " ".join(_as_typed(name) for name in self.missing if NOMENCLATURE[name].option)
        radii = [
            f"a radius such as {NOMENCLATURE[name].example}" for name in self.missing if not NOMENCLATURE[name].option
        ]
        give = " and ".join([options, *radii] if options else radii)
        instead = "".join(f" or {_as_typed(name)}" for name in self.instead)
        return f"{words}{self.lacking and '; ' + self.lacking}; give {give}{instead}"


def _as_typed(name: str) -> str:
    return f"{NOMENCLATURE[name].option} {NOMENCLATURE[name].example}"


class MissingExtra(JkrollError):
    """A library that only an extra installs."""

    def __init__(self, library: str, extra: str) -> None:
        super().__init__(library, extra)
        self.library, self.extra = library, extra

    def __str__(self) -> str:
        return f"this needs {self.library.partition('.')[0]}: pip install 'jkroll[{self.extra}]'"


class Contradiction(JkrollError):
    """Inputs of which one follows from the other."""

    def __init__(self, names: Sequence[str]) -> None:
        super().__init__(tuple(names))
        self.names = tuple(names)

    def __str__(self) -> str:
        return f"{' and '.join(self.names)} exclude each other: one follows from the other"


class ShapeMismatch(JkrollError):
    """Arrays that do not broadcast."""

    def __init__(self, shapes: Sequence[tuple[str, tuple[int, ...]]]) -> None:
        super().__init__(tuple(shapes))
        self.shapes = tuple(shapes)

    def __str__(self) -> str:
        return "these arrays do not broadcast: " + ", ".join(f"{name} {shape}" for name, shape in self.shapes)


class UnknownQuantity(JkrollError):
    """A name that is not in the nomenclature."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.name = name

    def __str__(self) -> str:
        from .suggestions import closest

        by_option = (name for name, quantity in NOMENCLATURE.items() if quantity.option == f"--{self.name}")
        guess = next(by_option, None) or closest(self.name, NOMENCLATURE)
        return f"{quoted(self.name)} is not a quantity" + (f"; did you mean {guess}?" if guess else "")


class OutOfRange(JkrollError):
    """A value given to the core, as a number, that its quantity cannot have."""

    def __init__(self, name: str, value: object, words: str) -> None:
        super().__init__(name, value, words)
        self.name, self.value, self.words = name, value, words

    def __str__(self) -> str:
        return f"{self.name}: {self.value!r} {self.words}"


class NoResult(JkrollError):
    """The physics has no answer: the computation fails for these values."""

    exit_code = 1


class BeyondPullOff(NoResult):
    """A tension larger than the pull-off force: there is no contact."""

    def __init__(self, load: float, pull_off_force: float) -> None:
        super().__init__(load, pull_off_force)
        self.load, self.pull_off_force = load, pull_off_force

    def __str__(self) -> str:
        return f"load: {self.load!r} N is beyond pull-off; this contact holds down to {-self.pull_off_force!r} N"


class BeyondFold(NoResult):
    """An approach at which even fixed grips have let go."""

    def __init__(self, approach: float, least: float) -> None:
        super().__init__(approach, least)
        self.approach, self.least = approach, least

    def __str__(self) -> str:
        return f"approach_at_load: {self.approach!r} m is beyond the fold; fixed grips hold this contact down to {self.least!r} m"


class TwoRigidBodies(NoResult):
    """Neither body yields, so there is no area of contact."""

    def __str__(self) -> str:
        return "contact_modulus: both bodies are rigid; a contact area needs one that yields"


class NoChain(NoResult):
    """A chain of spheres and planes."""

    def __str__(self) -> str:
        return "r_min: sphere 2 is a plane; a chain needs two spheres"


class NoVibration(NoResult):
    """A contact between pull-off and the fold: the spheres are free, and it does not hold them."""

    def __str__(self) -> str:
        return "vertical_frequency: beyond pull-off only fixed grips hold the contact; free spheres fly apart"


class NoFiniteValue(NoResult):
    """A result outside the range of doubles, or without limit."""

    def __init__(self, name: str, value: float) -> None:
        super().__init__(name, value)
        self.name, self.value = name, value

    def __str__(self) -> str:
        return f"{self.name}: " + (
            "no finite value for these inputs" if abs(self.value) > 1 else "no value that a double can hold"
        )


def expectation(name: str) -> str:
    """What should have stood there: "a length such as 100nm"."""
    from .units import dimension_of, kind_of

    quantity = NOMENCLATURE[name]
    word = word_for_infinity(name)
    example = f" such as {quantity.example}" if quantity.example else ""
    return kind_of(dimension_of(quantity.unit)) + example + (f", or {word}" if word else "")


def quoted(text: str, limit: int = MAX_QUOTED) -> str:
    r"""A user's text in quotes, as it can be shown.

    >>> quoted("a\x1b[31m\u202e")
    "'a?[31m?'"
    """
    return f"'{shown(text, limit)}'"


def shown(text: str, limit: int = MAX_QUOTED) -> str:
    """A user's text without the characters that would move the cursor or reverse the line, and not too long."""
    text = text if len(text) <= limit else text[:limit] + "..."
    if text.isprintable():
        return text
    return "".join(character if character.isprintable() else "?" for character in text)
