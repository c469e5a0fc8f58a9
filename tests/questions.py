"""Questions about rows, as texts: written out, or random in command, law, solids, pair, state, energy, uncertainty."""

import math
import shlex
from collections.abc import Callable, Mapping, Sequence
from itertools import chain, product
from random import Random
from typing import Any, NamedTuple

from jkroll import solve
from jkroll.cli.commands import COMMANDS
from jkroll.errors import JkrollError
from jkroll.model.plan import formula_of
from jkroll.physics.jkr import FOLD_APPROACH
from jkroll.quantities.laws import MODELS
from jkroll.quantities.nomenclature import CONVERTED, NOMENCLATURE, header
from jkroll.quantities.values import has_uncertainty
from jkroll.report.questions import QUESTIONS
from scenes import log_uniform

MATERIALS = ["quartz", "iron", "gold", "PS", "graphite", "silica-dry", "silica-humid", "ice-warm", "ice-cold"]
SOLIDS = ("material", "material2")
NAMES = [name for name in NOMENCLATURE if formula_of(name) is not None]
# Loads in units of P_c, or approaches in units of the depth at which a contact ends: at the end, beyond it, and where
# δ = 0 by JKR.
NEAR_PULL_OFF = [
    -1.0,
    -1 + 1e-15,
    -1 - 1e-15,
    -1 + 1e-9,
    -1 - 1e-9,
    -1.001,
    -1.5,
    -8 / 9,
]
ODD_CELLS = ["abc", "-1 m", "0", "1e-9", "nan", "inf", "1e-9 kg", "1e90 m", "5±1", "3 to 4", "10%"]
MOST_ROWS = 6


class Ask(NamedTuple):
    """A question about rows, as a command line or as a table with options."""

    command: str
    inputs: Mapping[str, Sequence[str]]  # the texts of the values of each input; materials are among them
    quantities: str = ""  # of --quantities
    model: str | None = None
    options: Sequence[str] = ()  # inputs with one value, which a table takes from options

    def words(self, *more: str) -> list[str]:
        """Return the words of a command line."""
        words = [self.command]
        for name, texts in self.inputs.items():
            words += [*([NOMENCLATURE[name].option] if name not in ("material", "radius") else []), ",".join(texts)]
        return [*words, *self.law(), *(["--quantities", self.quantities] if self.quantities else []), *more]

    def law(self) -> list[str]:
        """Return the words that name the law."""
        return ["--model", self.model] if self.model is not None else []

    def rows(self) -> list[dict[str, str]]:
        """Return the texts of each row by input, in the program's order."""
        names = [name for name in dict.fromkeys((*SOLIDS, *NOMENCLATURE)) if name in self.inputs]
        return [dict(zip(names, row, strict=True)) for row in product(*(self.inputs[name] for name in names))]


def ask_of(line: str) -> Ask:
    """Return the question of a command line; in a table, a single material of sphere 2 becomes an option."""
    command, *words = shlex.split(line)
    inputs: dict[str, list[str]] = {}
    quantities, model = "", None
    while words:
        word = words.pop(0)
        if word == "--quantities":
            quantities = words.pop(0)
        elif word == "--model":
            model = words.pop(0)
        elif word in _INPUT_OF_OPTION:
            inputs[_INPUT_OF_OPTION[word]] = words.pop(0).split(",")
        else:
            inputs["radius" if word[0].isdigit() else "material"] = word.split(",")
    options = ["material2"] if len(inputs.get("material2", ())) == 1 else []
    return Ask(command, inputs, quantities, model, options)


_INPUT_OF_OPTION = {quantity.option: name for name, quantity in NOMENCLATURE.items() if quantity.option}


class Sheet(NamedTuple):
    """A table, and the options with which it is read."""

    columns: Sequence[str]
    rows: Sequence[Mapping[str, str]]  # by column; missing cells are empty
    options: Sequence[str]  # with their values, as words of a command line

    def text(self) -> str:
        """Return the table as CSV."""
        names = [*map(header, self.columns), "remark"]
        cells = [[row.get(name, "") for name in self.columns] + ["x"] for row in self.rows]
        return "".join(",".join(line) + "\n" for line in [names, *cells])


def sheet_of(ask: Ask) -> Sheet:
    """Return a table that asks a question: the same rows, with some inputs as options."""
    options = []
    for name in ask.options:
        options += [NOMENCLATURE[name].option or f"--{name}", ask.inputs[name][0]]
    columns = [name for name in ask.inputs if name not in ask.options]
    return Sheet(columns, ask.rows(), [*options, *ask.law(), "--quantities", ask.quantities or ask.command])


def mixed_sheet(random: Random, asks: Sequence[Ask]) -> Sheet:
    """Return a table of rows from several questions, with odd cells, for the quantities and law of the first."""
    rows = [*chain.from_iterable(ask.rows() for ask in asks)]
    random.shuffle(rows)
    names = {*chain.from_iterable(rows)}
    columns = [name for name in dict.fromkeys((*SOLIDS, *NOMENCLATURE)) if name in names]
    for row in rows:
        if row and random.random() < 0.1:
            row[random.choice([*row])] = random.choice(ODD_CELLS)
    options = []
    if random.random() < 0.2:
        options.append("--uncertainty")
    if random.random() < 0.1:
        options.append("--no-doubt")
    first = asks[0]
    return Sheet(columns, rows, [*options, *first.law(), "--quantities", first.quantities or first.command])


# --- At random --------------------------------------------------------------------------------------------------------


def any_ask(random: Random, command: str = "", model: str | None = "") -> Ask:
    """Return a random question. `command`, `model`: random if empty; None stands for the default law."""
    command = command or random.choice([*QUESTIONS, "contact", "moment", "report"])  # some commands are likelier
    taken = {option.name for option in COMMANDS[command].options()} | {"material", "radius"}
    model = random.choice([None, None, *MODELS]) if model == "" else model
    model = model if "model" in taken else None
    inputs = {name: texts for name, texts in _Values(random, model).inputs().items() if name in taken}
    quantities = ""
    if random.random() < 0.3:
        names = [name for name in random.sample(NAMES, random.randint(1, 4)) if name not in inputs]
        quantities = ",".join(names + random.choice([[], [], ["contact"]]))
    options = [name for name, texts in inputs.items() if len(texts) == 1 and random.random() < 0.3]
    if len(options) == len(inputs):  # a table without columns of the contact is refused
        options = options[1:]
    return Ask(command, inputs, quantities, model, tuple(options))


class _Values:
    """Random values of inputs, as texts."""

    def __init__(self, random: Random, model: str | None) -> None:
        self.random, self.model = random, model
        self.wider = random.choice([1.0] * 6 + [1e4, 1e4, 1e20])  # factor beyond the usual sizes, at both ends
        self.kinds = random.choice([[], [], [], [], ["±"], ["±"], ["to"], ["±", "to"]])  # of uncertainties
        self.part = random.choice([0.1, 0.2, 0.2, 0.5])  # share of the values with an uncertainty
        self.texts: dict[str, tuple[str, ...]] = {}  # by input
        self.rows = 1  # the number of combinations of these texts

    def inputs(self) -> dict[str, tuple[str, ...]]:
        """Return the texts of the values of each input."""
        often = 0.92
        if self._is(0.6):
            self._add("material", lambda: self.random.choice(MATERIALS))
            often = 0.1
        if self._is(0.96):
            self._sizes("radius", 1e-9, 1e-4)
        energy = "work_of_adhesion" if self._is(0.2) else "surface_energy"
        for name, low, high in ((energy, 1e-3, 3.0), ("youngs_modulus", 1e8, 1e12), ("density", 1e2, 2e4)):
            if self._is(often):
                self._sizes(name, low, high)
        if self._is(often):
            self._add("poisson_ratio", self._poisson_ratio)
        if self._is(0.5):
            self._sphere_2(has_own_energy=energy == "surface_energy")
        self._convert()
        self._state()
        self._others()
        return self.texts

    def _convert(self) -> None:
        """Rename some radii to diameters and some Young's moduli to shear moduli.

        This draws from its own random numbers, so that all other inputs remain as they were.
        """
        random = Random(str(self.texts))
        for name, other in CONVERTED.items():
            if other in self.texts and "rigid" not in self.texts[other] and random.random() < 0.3:
                self.texts = {name if old == other else old: texts for old, texts in self.texts.items()}

    def _sphere_2(self, *, has_own_energy: bool) -> None:
        if self._is(0.3):
            self._add("material2", lambda: self.random.choice(MATERIALS))
        if self._is(0.8):
            self._sizes("radius2", 1e-9, 1e-4, "plane")
        if has_own_energy and self._is(0.15):
            self._sizes("surface_energy2", 1e-3, 3.0)
        if self._is(0.15):
            self._sizes("youngs_modulus2", 1e8, 1e12, "rigid")
        if self._is(0.15):
            self._add("poisson_ratio2", self._poisson_ratio)
        if self._is(0.15):
            self._sizes("density2", 1e2, 2e4)
        if self._is(0.1) and "youngs_modulus" in self.texts:
            self._add("youngs_modulus", lambda: "rigid", others=self.texts["youngs_modulus"])

    def _state(self) -> None:
        """Add loads or approaches, many of them near or beyond the end of the contact."""
        kind = self.random.choice(["", "", "load", "load", "approach_at_load"])
        if not kind:
            return
        size, least = self._end_of_contact(kind)

        def text() -> str:
            part = self.random.choice(
                [
                    self.random.choice(NEAR_PULL_OFF) * least,
                    self.random.uniform(-2, 2),
                    self.random.choice([0.0, log_uniform(self.random, 1e-9, 1e6)]),
                    self.random.uniform(-1, 0) * least,
                ]
            )
            return self._text(kind, part * size) if part else self._about_zero(kind, size)

        self._add(kind, text)

    def _end_of_contact(self, kind: str) -> tuple[float, float]:
        """Return a unit of loads or approaches, and how far below 0 the first row's contact ends, in this unit."""
        texts: dict[str, Any] = {name: own[0] for name, own in self.texts.items() if not has_uncertainty(own[0])}
        try:
            if kind == "load":
                return solve("pull_off_force", **texts, model=self.model), 1.0
            approach = solve("approach", **texts, model=self.model)
            if self.model == "maugis":
                return approach, -solve("fold_approach_maugis", **texts, model=self.model) / approach
        except JkrollError:
            return (1e-8 if kind == "load" else 1e-10), 1.0
        return approach, 0.0 if self.model == "dmt" else -FOLD_APPROACH

    def _others(self) -> None:
        for alternatives in (
            [("yield_displacement", 1e-11, 1e-8), ("adhesion_hysteresis", 1e-4, 1.0)],
            [("energy", 1e-20, 1e-10), ("energy_ratio", 1e-3, 1e3), ("speed", 1e-3, 1e3)],
        ):
            if self._is(0.4):
                self._sizes(*self.random.choice(alternatives))
        for name, low, high in (("gravity", 1e-2, 1e2), ("atomic_spacing", 1e-10, 1e-9), ("rolling_angle", 0.1, 3.0)):
            if self._is(0.15):
                self._sizes(name, low, high)

    def _is(self, probability: float) -> bool:
        return self.random.random() < probability

    def _poisson_ratio(self) -> str:
        return repr(self.random.choice([0.5, -0.99, 0.3, self.random.uniform(-0.9, 0.5)]))

    def _sizes(self, name: str, low: float, high: float, special: str = "") -> None:
        """Add values from low to high, widened by `wider`: some of one digit, some equal to sphere 1, some special."""
        low, high = low / self.wider, high * self.wider
        first = self.texts.get(name.removesuffix("2"), ())

        def text() -> str:
            if name.endswith("2") and first and self._is(0.3):
                return self.random.choice(first)
            if special and self._is(0.3):
                return special
            value = log_uniform(self.random, low, high)
            return self._text(name, self.random.choice([value, float(f"{value:.1g}")]))

        self._add(name, text)

    def _add(self, name: str, text: Callable[[], str], others: Sequence[str] = ()) -> None:
        """Add one or several values; only the last of them if there were too many rows."""
        count = self.random.choice([1, 1, 1, 1, 2, 3])
        self.texts[name] = tuple(dict.fromkeys([*others, *(text() for _ in range(count))]))
        if self.rows * len(self.texts[name]) > MOST_ROWS:
            self.texts[name] = self.texts[name][-1:]
        self.rows *= len(self.texts[name])

    def _about_zero(self, name: str, size: float) -> str:
        """Return 0 as text, perhaps with an uncertainty up to some size."""
        unit = f" {NOMENCLATURE[name].unit}"
        if not self.kinds or not self._is(2 * self.part):
            return f"0.0{unit}"
        most = self.random.uniform(0.01, 1) * size
        return f"(0±{most!r}){unit}" if self.random.choice(self.kinds) == "±" else f"{-most!r} to {most!r}{unit}"

    def _text(self, name: str, value: float) -> str:
        """Return a value as text, perhaps with an uncertainty."""
        unit = f" {NOMENCLATURE[name].unit}".removesuffix(" 1")
        if not self.kinds or not math.isfinite(value) or not self._is(self.part):
            return f"{value!r}{unit}"
        if self.random.choice(self.kinds) == "±":
            return f"({value!r}±{abs(value) * self.random.choice([0.01, 0.1, 0.4])!r}){unit}"
        low, high = sorted(value * factor for factor in (self.random.uniform(0.3, 1), self.random.uniform(1, 3)))
        return f"{low!r} to {high!r}{unit}"
