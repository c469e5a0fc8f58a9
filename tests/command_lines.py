"""Command lines as people mistype them and adversaries write them, drawn from what the program takes."""

from random import Random

from jkroll.commands import COMMANDS
from jkroll.nomenclature import NOMENCLATURE
from jkroll.options import EXTRAS, Option, options_of
from jkroll.unit_table import PLAIN, PREFIXABLE, PREFIXES

KNOWN = ("quartz", "quartz", "SiO2", "iron", "FE", "gold", "polystyrene", "graphite", "all")
MATERIALS = (*KNOWN, *KNOWN, "plane", "quarz", "lead")
FILES = ("mine.toml", "mine.toml", ".", "/dev/null", "/dev/zero", "none.toml", "", "broken.toml", "../../etc/passwd")
HOSTILE = (
    "", " ", "-", "--", "---", "=", "-=", "--=", "-h", "--help", "--version", "--debug", "-V", "--install-completion=x",
    "nan", "inf", "-inf", "1e9999nm", "1e-9999nm", "1e400m", "5e-324m", "0", "-0nm", "1,2,3", ",", ",,", ":", "::", "1nm:", "1nm:1um",
    "1nm:1um:1", "1nm:1um:3", "1nm:1um:3:lin", "1nm:1um:3:sin", "1nm:1um:-3", "1nm:1um:99999999", "1nm:1um:1e3", "1um:1nm:2",
    "5,5 nm", "5.00(1) nm", "5±1 nm", "5 nm = 6 nm", "$5 nm", "[5] nm", "10**10**10", "5 m/m m", "5 °C", "20 degC", "5 dB",
    "−5nm", "5 µm", "5 μm", "5 Å", "5\u00a0nm", "5 m²", "5 m⁻", "١ nm", "५nm", "nm", "m" * 30, "5 " + "m " * 20, "9" * 100 + "m",
    "x" * 3000, "\x1b[31m", "\u202e", "\r", "\n", "a\nb", "\t", "\0", "\ud800", "\udcff", "é", "𝒜", "ﬁ", "İ", "ß", "{}", "%s", "%n",
    "[red]", "[/]", "$(id)", "`id`", "'", '"', "\\", "*", "?", "~", "@file", "../..", "/etc/passwd", "1_000nm", "0x10nm", "1e1_0nm",
    "plane", "rigid", "Plane", "RIGID", "all,all", "quartz,", ",quartz", "quartz,,iron", "quartz,iron,quarz", "quartz=iron",
)  # fmt: skip
LONGEST = 8


def command_line(source: Random) -> list[str]:
    """One command line: a command, words and options, of which some are not meant so."""
    name = source.choice([*COMMANDS, *COMMANDS, "materials"]) if source.random() < 0.98 else _mutated(source, "verify")
    if name in ("verify", "bench"):
        return [name, source.choice(HOSTILE[1:8])]
    options = options_of(COMMANDS[name]) if name in COMMANDS else EXTRAS["materials"].options
    words = [name]
    if name in COMMANDS:
        words += [_material(source)] * (source.random() < 0.85) + [_value(source, "radius")] * (source.random() < 0.9)
    elif source.random() < 0.5:
        words.append(_material(source))
    for _ in range(min(LONGEST, int(source.expovariate(0.7)))):
        words += _option(source, source.choice(options))
    if source.random() < 0.12:
        place = source.randrange(len(words) + 1)
        words[place:place] = [source.choice(HOSTILE)]
    if source.random() < 0.12:
        place = source.randrange(len(words))
        words[place] = _mutated(source, words[place])
    if source.random() < 0.03:
        source.shuffle(words)
    return words


def _option(source: Random, option: Option) -> list[str]:
    if option.kind is bool:
        return [option.flag]
    if option.name in NOMENCLATURE:
        value = _material(source) if option.name == "material2" else _value(source, option.name)
    elif option.name == "to":
        units = source.choice(((), ("nN", "nm", "MHz", "deg"), ("N", "m", "Hz", "J")))
        value = ",".join(source.sample(units, 1) if units else [_unit(source), _unit(source)])
    elif option.name == "materials":
        value = source.choice(FILES)
    else:
        value = source.choice(("3", "17", "1", "0", "18", "1e-3", "0.5", "-1", "x", "nan", "1.0", "٣", "3" * 5000))
    form = source.random()
    if form < 0.6:
        return [option.flag, value]
    return [f"{option.flag}={value}"] if form < 0.95 else [option.flag]


def _material(source: Random) -> str:
    name = source.choice(MATERIALS)
    return f"{name},{source.choice(MATERIALS)}" if source.random() < 0.05 else name


def _value(source: Random, name: str) -> str:
    """A value of a quantity, most of the time one that it can have."""
    kind = source.random()
    if kind < 0.65:
        return NOMENCLATURE[name].example
    if kind < 0.7:
        return source.choice(HOSTILE)
    number = source.choice(("1", "2.5", "1e-3", "-4", "0", "100", "1e300", "1e-300", ".5", "7.", "+3", "−2"))
    unit = NOMENCLATURE[name].unit if kind < 0.9 else _unit(source)
    value = number + source.choice(("", "", " ")) + unit.removesuffix("1")
    if kind > 0.97:
        return f"{value}:{number}{unit}:{source.choice('234')}{source.choice(('', ':lin', ':log'))}"
    return value + (f",{value}" if kind > 0.95 else "")


def _unit(source: Random) -> str:
    """A unit, or several, of any dimension."""
    name = source.choice([*PREFIXABLE]) if source.random() < 0.8 else source.choice([*PLAIN, "furlong", "zorch", "dB"])
    unit = source.choice(["", "", *PREFIXES]) + name + source.choice(("", "", "", "2", "^2", "**-1", "-3", "⁻²", "99"))
    return unit + source.choice(("/", "*", " ", "·")) + _unit(source) if source.random() < 0.3 else unit


def _mutated(source: Random, word: str) -> str:
    """A word with a slip: a letter lost, doubled, exchanged, of another case, or one that nobody expects."""
    place = source.randrange(len(word) + 1)
    head, letter, tail = word[:place], word[place : place + 1], word[place + 1 :]
    odd = source.choice("\x00\x07\x1b\x7f\u00ad\u200b\u202e\ufeff\ud83d\U000e0001=-,.:/^ ")
    return head + source.choice(("", letter * 2, letter.swapcase(), odd, letter + odd, tail[:1] + letter)) + tail
