"""Measurements compared with values of this program: the data of the table in `jkroll guide validation`.

    python tests/tools/measurements.py

renews the table in the page. A row has only numbers that were read in the abstract of the source or in a text that
cites the source; `read` states which of the two. The remark names assumptions, such as the shape of the other body.
"""

from collections.abc import Iterator, Mapping
from math import log
from pathlib import Path
from typing import NamedTuple

from jkroll.materials.library import known_materials
from jkroll.model.frame import Frame
from jkroll.quantities.formatting import Format, amount, in_words, significant
from jkroll.quantities.nomenclature import DEFAULTS, NOMENCLATURE
from jkroll.quantities.values import value_of

PAGE = Path(__file__).parents[2] / "src" / "jkroll" / "guide" / "validation.md"
HEAD = "| row | solids | R1 | quantity | measured | computed | ratio |\n|---|---|---|---|---|---|---|\n"
END = "\n*abstract*:"  # the beginning of the text below the table and its origins

_OF_RATIOS = "yield_force_ratio"  # a quantity without a unit, to read and print ratios
_ROUNDED = Format(digits=3)
_STATED = (  # the inputs of a frame that the table states
    "radius", "radius2", "surface_energy", "surface_energy2", "yield_displacement", "humidity", "contact_angle"
)  # fmt: skip


class Measurement(NamedTuple):
    """A measured value, and the inputs for which it is computed."""

    solids: str
    quantity: str
    measured: str  # with ± or as a range if the source states one
    material: str
    given: Mapping[str, str]  # the other inputs
    source: str
    read: str  # "abstract": in the abstract of the source; "second hand": in a text that cites it
    remark: str
    other_radius: str = ""  # if given, the numbers are ratios of the value at `radius` to the value at this radius
    material2: str = ""  # the material of the other body, if it differs


class Compared(NamedTuple):
    """A measurement: the middle of the measured value, and the computed value."""

    row: Measurement
    measured: float
    computed: float
    inputs: str  # of the computation, in words

    @property
    def ratio(self) -> float:
        """Measured over computed."""
        return self.measured / self.computed


_PLANE = {"radius2": "plane"}
_BLUM = "Blum & Wurm 2000, Icarus 143, 138"
_HEIM = "Heim, Blum, Preuss & Butt 1999, PRL 83, 3328"
_GUNDLACH = "Gundlach et al. 2011, Icarus 214, 717"
_SUMER = "Sümer & Sitti, Rolling and spinning friction characterization of fine particles"
_MOUTINHO = "Quoted by Moutinho et al."
_XI = "ξ: 2 Å is the value of the paper, and F_roll = 6πγξ at any radius"
_GROWS = "ξ grows with the radius; the source may have derived ξ from a force or from a displacement"
_MICHALSKE = "Michalske & Fuller 1985, J. Am. Ceram. Soc. 68, 586"
_TIPS = "J. Phys. D: Appl. Phys. 7, 1243 (1974)"
_DUST_SIMULATION = "Comments in Lumajord/DustSimulation, which was fitted to this value"
_LACTOSE = "Newell et al. 2001, Pharm. Res. 18, 662"
_OF_TIPS = (
    "Tips in a microbalance, pull-off by JKR; the abstract does not give the radii, and the work is per contact area"
)
_BY_GAS = "Measured by gas chromatography, dispersive part; γ of the material is from pull-off by AFM"
_SMOOTH = "γ: the theory of the source itself agrees within tens of per cent"

MEASUREMENTS = (
    Measurement(
        "SiO2", "yield_force", "1.2 nN", "quartz", {"radius": "0.95 um"},
        _BLUM, "abstract", _XI,
    ),
    Measurement(
        "SiO2", "yield_force", "0.85±0.16 nN", "quartz", {"radius": "0.95 um"},
        _HEIM, "second hand", _XI,
    ),
    Measurement(
        "SiO2", "yield_force", "1.21±0.36 nN", "quartz", {"radius": "0.95 um"},
        _GUNDLACH, "abstract", _XI + "; the abstract does not give the radius, and 0.95 µm is assumed",
    ),
    Measurement(
        "SiO2", "yield_force_ratio", "0.01", "quartz", {"radius": "1 um"},
        _HEIM, "abstract",
        "ξ: about 1/100 at radii of 0.5 to 2.5 µm means that ξ is proportional to the radius; 1 µm is assumed",
    ),
    Measurement(
        "water ice", "yield_force", "11.48±2.38 nN", "ice-warm", {"radius": "1.45 um"},
        _GUNDLACH, "abstract",
        "ξ; this is no independent test, as γ of ice-warm was itself scaled with this force, from γ of SiO2",
    ),
    Measurement(
        "SiO2", "break_energy_dust_simulation", "1.3e-15 J", "quartz", {"radius": "0.95 um"},
        _BLUM, "abstract",
        "γ: dry silica has about ten times the γ of quartz, and the energy is proportional to γ^(5/3)",
    ),
    *(
        Measurement(
            "polystyrene on glass", "yield_displacement", measured, "polystyrene-glassy", {"radius": radius, **_PLANE},
            _SUMER, "abstract", _GROWS,
        )
        for radius, measured in (("5 um", "42 nm"), ("10 um", "84 nm"), ("15 um", "128 nm"))
    ),
    Measurement(
        "water ice, 175–200 K", "yield_displacement", "0.19 mm", "ice-cold", {"radius": "1.1 mm"},
        "Musiolik & Wurm 2019, arXiv:1902.08503", "abstract",
        "ξ grows with the radius; the abstract does not say whether 1.1 mm is the radius or the diameter",
    ),
    Measurement(
        "polystyrene on glass", "shear_strength", "9 to 15 MPa", "polystyrene-glassy", {"radius": "10 um", **_PLANE},
        _SUMER, "abstract", "G/4π² is an order of magnitude; G is that of the softer solid",
    ),
    Measurement(
        "water ice, below 210 K", "sticking_speed", "9.6 m/s", "ice-warm", {"radius": "1 um", **_PLANE},
        "Gundlach & Blum 2015, ApJ 798, 34", "abstract",
        "Losses other than adhesion, or γ; the grains are µm-sized and hit grown ice: 1 µm and a plane are assumed",
    ),
    *(
        Measurement(
            "silica", "sticking_speed", measured, "quartz", {"radius": radius, **_PLANE}, source, "second hand",
            "Plastic asperities (Paszun & Dominik 2008), or γ of dry silica, ten times larger (Kimura et al. 2015); a "
                "plane is assumed, and the sizes are presumably radii",
        )
        for radius, measured, source in (
            ("0.6 um", "1.2 m/s", _DUST_SIMULATION + "; its 105.869 cm/s at 0.76 µm is not measured: it is the power "
                "law 1.2 m/s·(0.6/0.76)^0.53"),
            ("0.25 um", "1.90 m/s", _DUST_SIMULATION),
        )
    ),
    Measurement(
        "silver on aluminium", "sticking_speed", "636", "iron", {"radius": "10 nm", **_PLANE},
        "Arffman et al. 2015, J. Aerosol Sci. 86, 32", "abstract",
        "14 m/s at 20 nm over 0.022 m/s at 1 µm, presumably diameters: the measured speed is proportional to R^−1.6, "
            "that of an elastic contact of any solids to R^(−5/6); plastic losses probably explain the difference",
        other_radius="500 nm",
    ),
    Measurement(
        "polystyrene on polyurethane", "contact_radius", "1.68±0.06", "polystyrene-glassy",
        {"radius": "6 um", **_PLANE},
        "J. Appl. Phys. 1989, doi 10.1063/1.344087", "abstract",
        "At twice the radius: a is proportional to R^(0.75 ± 0.05), and by JKR and DMT to R^(2/3) for any solids",
        other_radius="3 um",
    ),
    Measurement(
        "vitreous silica, closing cracks", "work_of_adhesion", "0.15 J/m2", "silica-humid", {},
        _MICHALSKE, "abstract",
        "γ: freshly cracked glass closes with twice the surface tension of water at any humidity; silica-humid is a "
            "convention of simulations",
    ),
    Measurement(
        "vitreous silica, closing cracks", "work_of_adhesion", "0.15 J/m2", "silica-dry", {},
        _MICHALSKE, "abstract", "γ of silica-dry is that of dry dust, from the strength of aggregates",
    ),
    Measurement(
        "soda-lime glass, closing cracks", "work_of_adhesion", "0.15 J/m2", "glass-soda-lime-air", {},
        _MICHALSKE, "abstract", "No independent test: γ of the material is half of this w",
    ),
    Measurement(
        "mica on mica, dry", "pull_off_force", "12 to 16 mN", "mica", {"radius": "1 cm", **_PLANE},
        "Christenson 1993, J. Phys. Chem. 97, 12034", "abstract",
        "No independent test: γ of mica is from this force; cleavage of sheets gives the same; the source has 1.2 to "
            "1.6 N/m for crossed cylinders of any radius, which are equivalent to a sphere on a plane",
    ),
    *(
        Measurement(solids, "surface_energy", measured, material, {}, _LACTOSE, "abstract", _BY_GAS)
        for solids, measured, material in (
            ("lactose, crystalline", "31.2 mJ/m2", "lactose-crystalline"),
            ("lactose, spray-dried", "37.1 mJ/m2", "lactose-amorphous"),
        )
    ),
    Measurement(
        "fused quartz on steel", "work_of_adhesion", "42±3 mJ/m2", "quartz", {}, _TIPS, "abstract",
        f"{_OF_TIPS}; oxide and adsorbed water decide, not the metal", material2="iron",
    ),
    Measurement(
        "fused quartz on steel", "work_of_adhesion", "42±3 mJ/m2", "quartz", {}, _TIPS, "abstract",
        f"{_OF_TIPS}; this w gives the lower end of γ of steel-304", material2="steel-304",
    ),
    Measurement(
        "tungsten on steel", "work_of_adhesion", "130±7 mJ/m2", "tungsten-oxide", {}, _TIPS, "abstract",
        f"{_OF_TIPS}; γ of tungsten-oxide is from AFM", material2="steel-304",
    ),
    *(
        Measurement(
            solids, "pull_off_force", measured, "quartz", {"radius": radius, **_PLANE},
            _MOUTINHO, "second hand", f"{cause}; the sizes are presumably diameters",
        )
        for solids, radius, measured, cause in (
            ("SiO2 on smooth glass, dry", "2.5 um", "314 nN", _SMOOTH),
            ("SiO2 on smooth glass, dry", "10 um", "684 nN", _SMOOTH),
            ("SiO2, rms roughness 8 nm", "10 um", "350 nN", "Roughness"),
            ("SiO2, rms roughness 22 nm", "10 um", "120 nN", "Roughness"),
            ("SiO2, rms roughness 321 nm", "10 um", "20 to 60 nN", "Roughness"),
            ("SiO2, 67 % humidity", "10 um", "1.2 to 1.9 uN", (
                "Water between the bodies: the dry force was half as large, and the ratio is near 1 by "
                "chance"
            )),
        )
    ),
    Measurement(
        "SiO2, 67 % humidity", "meniscus_force", "1.2 to 1.9 uN", "quartz",
        {"radius": "10 um", "humidity": "67%", **_PLANE}, _MOUTINHO, "second hand",
        "Roughness probably lowers the force: the formula is for smooth bodies; the sizes are presumably diameters",
    ),
)  # fmt: skip


def comparisons() -> list[Compared]:
    """Return all measurements with their measured and computed numbers, the largest disagreement first."""
    return sorted(map(_compared, MEASUREMENTS), key=lambda compared: -abs(log(compared.ratio)))


def measurements_table() -> str:
    """Return the measurements as a table in Markdown, with the origin of each row below it."""
    rows, origins = [], []
    for number, compared in enumerate(comparisons(), 1):
        row = compared.row
        radius = amount("radius", value_of(row.given["radius"], "radius")) if "radius" in row.given else "—"
        symbol = NOMENCLATURE[row.quantity].symbol
        unit_of = _OF_RATIOS if row.other_radius else row.quantity
        cells = (
            str(number),
            row.solids,
            radius,
            f"{symbol}, ratio" if row.other_radius else symbol,
            amount(unit_of, value_of(row.measured, unit_of)),
            amount(unit_of, compared.computed, _ROUNDED),
            significant(compared.ratio, 2),
        )
        rows.append(f"| {' | '.join(cells)} |")
        origins.append(f"{number}. {row.source} ({row.read}). Computed for {compared.inputs}. {row.remark}.")
    return HEAD + "\n".join([*rows, "", *origins, ""])


def with_table(page: str) -> str:
    """Return a page with its table replaced."""
    before, _, rest = page.partition(HEAD)
    return f"{before}{measurements_table()}{END}{rest.partition(END)[2]}"


def _compared(row: Measurement) -> Compared:
    unit_of = _OF_RATIOS if row.other_radius else row.quantity
    frame = _frame(row, row.given)
    computed = frame[row.quantity]
    computed_for = ", ".join(_inputs_of(frame, row))
    if row.other_radius:
        computed /= _frame(row, {**row.given, "radius": row.other_radius})[row.quantity]
        computed_for += f", over that at R1 = {amount('radius', value_of(row.other_radius, 'radius'))}"
    law = "the first order of a meniscus" if row.quantity == "meniscus_force" else frame.law.name.upper()
    return Compared(row, _middle(row.measured, unit_of), computed, f"{computed_for}, by {law}")


def _frame(row: Measurement, given: Mapping[str, str]) -> Frame:
    """Return the frame for which a measured value is computed."""
    materials = known_materials()
    other = materials[row.material2] if row.material2 else None
    return Frame({name: value_of(text, name) for name, text in given.items()}, materials[row.material], other)


def _inputs_of(frame: Frame, row: Measurement) -> Iterator[str]:
    """Iterate over the inputs of a computation in words: the materials, and the inputs in _STATED that enter."""
    for name, value in frame.echo({*row.given, row.quantity, *frame.inputs_of(row.quantity)}).items():
        if name in ("material", "material2"):
            yield value
        elif name in _STATED:
            assumed = " (assumed)" if name in DEFAULTS else ""
            yield f"{NOMENCLATURE[name].symbol} = {amount(name, in_words(name, value))}{assumed}"


def _middle(text: str, name: str) -> float:
    found = value_of(text, name)
    return found if isinstance(found, float) else found.value


if __name__ == "__main__":
    PAGE.write_text(with_table(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
