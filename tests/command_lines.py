"""Random command lines, plausible, mistyped and hostile, built from the declarations of the commands."""

from random import Random
from typing import Any

from jkroll.cli.commands import COMMANDS
from jkroll.cli.options import Option
from jkroll.quantities.nomenclature import NOMENCLATURE
from jkroll.quantities.units import PLAIN, PREFIXABLE, PREFIXES
from jkroll.report.questions import QUESTIONS

KNOWN = ("quartz", "quartz", "SiO2", "iron", "FE", "gold", "polystyrene", "graphite", "all")
MATERIALS = (*KNOWN, *KNOWN, "plane", "quarz", "lead")
# Files and links that `isolate` of invariants.py makes, the directory itself, and names without a file. No name leads
# out of the directory, even with a typing error.
FILES = ("mine.toml", "mine.toml", ".", "null", "zero", "none.toml", "", "broken.toml", "../../none/passwd")
TABLES = (
    *("grains.csv",) * 4, *("pairs.tsv", "grains.ndjson", "grains.csv.gz", "grains.parquet") * 2, "wrong.csv",
    "odd.csv", "empty.csv",
    "none.csv", "-", ".", "null.csv", "mine.toml", "*.csv", "gr*.csv", "[", "grains.*", "no*thing", "",
)  # fmt: skip
TARGETS = (
    "out.csv", "out.csv", "out.tsv", "out.ndjson", "out.csv.gz", "out.parquet", "out.md", "out/", "-", "full.csv",
    "null.csv", ".", "a/b.csv", "",
)  # fmt: skip
PICTURES = ("out.svg", "out.svg", "out.pdf", "out.png", "full.svg", "out.jpg", "a/b.svg", ".svg")
FIGURES = ("3a", "3a", "3b", "3c", "3d", "6a", "6b", "8", "2", "9", "7", "3A", "")
AXES = (
    ("radius", "1nm:1um"), ("radius", "1nm:1um"), ("radius", "1um:1nm"), ("radius", "1e-300m:1e300m"),
    ("radius2", "1nm:1mm"),
    ("gamma", "1mJ/m2:1J/m2"), ("surface_energy", "1mJ/m2:1J/m2"), ("young", "1GPa:1TPa"), ("load", "-1nN:1nN"),
    ("load", "0N:10nN"),
    ("xi", "1angstrom:1nm"), ("density", "1g/cm3:9g/cm3"),
)  # fmt: skip
SIZES = (":9", ":9", ":9:lin", ":20", ":20:lin", ":lin:20", ":1", ":2", ":-3", ":1e3", ":log", ":999999")
UNKNOWN = (
    *("gamma", "xi", "young", "radius", "load") * 4,
    "hamaker",
    "shear_strength",
    "gamma,young",
    "density",
    "gama",
    "",
)
MEASURED = (
    "pull_off_force=10nN", "yield_force=100pN", "yield_moment=10aN m", "n_grav=1000", "n_roll=0.01", "stiffness=100N/m",
    "contact_radius=4nm",
    "vertical_frequency=1GHz", "hysteresis_ratio=0.5", "P_c=10±1nN,9nN", "sticking_speed=0.5m/s", "yield_force",
)  # fmt: skip
PROGRAMS = ("lammps", "lammps", "liggghts", "dust-collider", "dust-simulation", "yade", "")
QUANTITIES = [name for name, quantity in NOMENCLATURE.items() if quantity.equation]
VALUES = {
    "materials": FILES,
    "data": ("out.csv", "out.csv", "-", "full.csv", "null", ".", "a/b.csv", ""),
    "width": ("85mm", "85mm", "1m", "5nN", "5mm", "nan", ""),
    "style": ("paper", "dark", "Dark", ""),
    "format": ("csv", "csv", "tsv", "ndjson", "ndjson.gz", "parquet", "csv.zst", "xlsx", ""),
    "quantities": ("pull_off_force", "pull_off_force,r_min", "report", "pull-off", "contact,moment", "load", "n_grav,",
    ",", "zorch", ""),
    "jobs": ("1", "1", "01", "0", "65", "-1", "x", "1.0"),
    "mark": ("quartz@100nm", "@1um", "iron", "quartz@100nm,@1nm", "quarz@1nm", "@", "quartz@", "@5nN", ",", "a@b@c",
    ""),
}  # fmt: skip
# How often each command is drawn: figures and tables take a hundred times as long as a single contact.
WEIGHTS = dict.fromkeys(QUESTIONS, 100.0)
WEIGHTS |= {"infer": 100, "materials": 50, "batch": 12, "map": 16, "export": 30, "quantities": 10, "guide": 3}
WEIGHTS |= {"figure": 1, "bench": 1, "fit": 6}
HOSTILE = (
    "", " ", "-", "--", "---", "=", "-=", "--=", "-h", "--help", "--version", "--debug", "-V", "--install-completion=x",
    "nan", "inf", "-inf", "1e9999nm", "1e-9999nm", "1e400m", "5e-324m", "0", "-0nm", "1,2,3", ",", ",,", ":", "::",
    "1nm:", "1nm:1um",
    "1nm:1um:1", "1nm:1um:3", "1nm:1um:3:lin", "1nm:1um:3:sin", "1nm:1um:-3", "1nm:1um:999999", "1nm:1um:1e3",
    "1um:1nm:2",
    "5,5 nm", "5.00(1) nm", "5±1 nm", "5 nm = 6 nm", "$5 nm", "[5] nm", "10**10**10", "5 m/m m", "5 °C", "20 degC",
    "5 dB",
    "−5nm", "5 µm", "5 μm", "5 Å", "5\u00a0nm", "5 m²", "5 m⁻", "١ nm", "५nm", "nm", "m" * 30, "5 " + "m " * 20,
    "9" * 100 + "m",
    "x" * 3000, "\x1b[31m", "\u202e", "\r", "\n", "a\nb", "\t", "\0", "\ud800", "\udcff", "é", "𝒜", "ﬁ", "İ", "ß", "{}",
    "%s", "%n",
    "[red]", "[/]", "$(id)", "`id`", "'", '"', "\\", "*", "?", "~", "@file", "../..", "/dev/null/passwd", "1_000nm",
    "0x10nm", "1e1_0nm",
    "plane", "rigid", "Plane", "RIGID", "all,all", "quartz,", ",quartz", "quartz,,iron", "quartz,iron,quarz",
    "quartz=iron",
)  # fmt: skip
LONGEST = 8  # most options of a line
TAKE_SECONDS = ("dask", "plot")  # options that are not drawn


def command_line(source: Random) -> list[str]:
    """Return a command line: a command, words and options, some of them with mistakes."""
    (name,) = source.choices([*WEIGHTS], [*WEIGHTS.values()])
    words = [name, *_words(source, name)]
    options = [option for option in COMMANDS[name].options() if option.name not in TAKE_SECONDS]
    for _ in range(min(LONGEST, int(source.expovariate(0.7))) if options else 0):
        words += _option(source, name, source.choice(options))
    if source.random() < 0.12:
        index = source.randrange(len(words) + 1)
        words[index:index] = [source.choice(HOSTILE)]
    if source.random() < 0.12:
        index = source.randrange(len(words))
        words[index] = _mutated(source, words[index])
    if source.random() < 0.03:
        source.shuffle(words)
    return words


def _sometimes(source: Random, share: float, *words: str) -> list[str]:
    """Return words in this share of the calls, otherwise nothing."""
    return [*words] if source.random() < share else []


def _words(source: Random, name: str) -> list[str]:
    """Return the arguments of a command, mostly correct, and the options that it needs."""
    scene = _sometimes(source, 0.85, _material(source)) + _sometimes(source, 0.9, _value(source, "radius"))
    words = {
        "materials": _sometimes(source, 0.5, _material(source)),
        "figure": [source.choice(FIGURES)],
        "infer": [source.choice(UNKNOWN), *scene],
        "export": [source.choice(PROGRAMS), *scene],
        "quantities": _sometimes(source, 0.5, source.choice(QUANTITIES)),
        "guide": _sometimes(source, 0.9, source.choice(("dem", "units", "nowhere"))),
        "fit": [source.choice(TABLES)],
        "bench": ["nothing"],  # it takes seconds, so it is always called incorrectly
    }
    if name == "infer":
        measured = source.choice([*MEASURED, f"{source.choice(QUANTITIES)}={_value(source, 'load')}"])
        return [*words[name], "--measured", measured]
    if name == "batch":
        jobs = _sometimes(source, 0.97, "--jobs", "1")
        return [source.choice(TABLES), *_sometimes(source, 0.8, "-o", source.choice(TARGETS)), *jobs]
    if name == "map":
        axes = ["--x", _axis(source), *_sometimes(source, 0.4, "--y", _axis(source))]
        return [source.choice([*QUANTITIES, *(*QUESTIONS,) * 9]), *scene[: source.choice((0, 1, 1, 1, 2))], *axes]
    if name == "contact" and source.random() < 0.003:
        return [*scene, "--curve", "-o", source.choice(PICTURES)]
    if name in QUESTIONS:
        return [*scene, *_sometimes(source, 0.5, "-o", source.choice(TARGETS))]
    return words.get(name, scene)


def _option(source: Random, command: str, option: Option[Any]) -> list[str]:
    if not option.metavar:
        return [option.flag]
    if option.name in NOMENCLATURE:
        value = _material(source) if option.name == "material2" else _value(source, option.name)
    elif option.name in VALUES:
        value = source.choice(VALUES[option.name])
    elif option.name == "target":
        value = source.choice(TARGETS if command not in ("map", "figure") else PICTURES)
    elif option.name in ("x", "y"):
        value = _axis(source)
    elif option.name == "to":
        units = source.choice(((), ("nN", "nm", "MHz", "deg"), ("N", "m", "Hz", "J")))
        value = ",".join(source.sample(units, 1) if units else [_unit(source), _unit(source)])
    else:
        value = source.choice(("3", "17", "1", "0", "18", "1e-3", "0.5", "-1", "x", "nan", "1.0", "٣", "3" * 5000))
    form = source.random()
    if form < 0.6:
        return [option.flag, value]
    return [f"{option.flag}={value}"] if form < 0.95 else [option.flag]


def _material(source: Random) -> str:
    name = source.choice(MATERIALS)
    return f"{name},{source.choice(MATERIALS)}" if source.random() < 0.05 else name


def _axis(source: Random) -> str:
    """Return an axis, mostly correct and with few points."""
    name, ends = source.choice(AXES)
    if source.random() < 0.1:
        name = source.choice([*NOMENCLATURE])
    if source.random() < 0.1:
        ends = f"{_value(source, 'radius')}:{_value(source, 'radius')}"
    size = source.choice(SIZES) if source.random() < 0.97 else ""
    return source.choice(HOSTILE) if source.random() < 0.05 else f"{name}={ends}{size}"


def _value(source: Random, name: str) -> str:
    """Return a value of a quantity, mostly within its range."""
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
    """Return a unit of any dimension, or a product or quotient of several units."""
    name = (
        source.choice([*PREFIXABLE])
        if source.random() < 0.8
        else source.choice([*PLAIN, "nautical_mile", "zorch", "dB"])
    )
    unit = source.choice(["", "", *PREFIXES]) + name + source.choice(("", "", "", "2", "^2", "**-1", "-3", "⁻²", "99"))
    return unit + source.choice(("/", "*", " ", "·")) + _unit(source) if source.random() < 0.3 else unit


def _mutated(source: Random, word: str) -> str:
    """Return a word with a typing error: a letter lost, doubled, in another case or too early, or an odd character."""
    index = source.randrange(len(word) + 1)
    head, letter, tail = word[:index], word[index : index + 1], word[index + 1 :]
    odd = source.choice("\x00\x07\x1b\x7f\u00ad\u200b\u202e\ufeff\ud83d\U000e0001=-,.:/^ ")
    return head + source.choice(("", letter * 2, letter.swapcase(), odd, letter + odd, tail[:1] + letter)) + tail
