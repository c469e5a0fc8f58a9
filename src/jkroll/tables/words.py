"""The words and symbols of headers: for inputs, for quantities that may be inputs, and for other quantities.

Another name of a quantity belongs in `quantities.synonyms`. Symbols, words that change the meaning of a header, and
reasons to refuse a doubtful name belong here; words for uncertainties in `error_words`, units in `unit_spellings`.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from itertools import chain
from typing import NamedTuple

from ..quantities.nomenclature import NOMENCLATURE, OF_CURVES, OPTION_WORDS
from ..quantities.synonyms import CERTAIN_SYNONYMS
from ..text import ascii_text

MATERIALS = ("material", "material2")
INPUTS = ("radius", *(name for name, quantity in NOMENCLATURE.items() if quantity.option and quantity.unit))
_MORE_SYMBOLS = {  # in addition to those of the nomenclature, or with a second meaning
    "E": "energy",
    "Er": "contact_modulus",
    "W": "work_of_adhesion",
    "SFE": "surface_energy",
    "rad": "radius",
    "Ered": "contact_modulus",
    "vimp": "speed",
    "YM": "youngs_modulus",
    "AH": "hamaker",
    "A11": "hamaker",
    "A22": "hamaker2",
    **dict.fromkeys("last charge carga carico".split(), "load"),  # charge [C] is another quantity
}
# Words for quantities of curves. Like the synonyms of these quantities, they are read only if the quantity is measured.
_OF_CURVES = {
    **dict.fromkeys(OF_CURVES, ""),
    "contact_radius_at_load": "a",
    "lever_force": "F",
    "lever_stiffness": "k spring spring_constant",
    "lever_deflection": "d",
    "approach_at_load": """indentation depth penetration indentation_depth penetration_depth tip_sample_separation
        tip_sample_distance""",
}
NO_HEADERS = ("roughness",)  # options that are not headers: a column of roughness gives a height, not a gap
RATIOS = ("poisson_ratio", "poisson_ratio2", "humidity")  # the only ratios whose symbol has no other common meaning


class Meaning(NamedTuple):
    """The inputs that a word or a symbol may mean, distinguished by unit; `names` is empty for another quantity."""

    names: Sequence[str] = ()
    problem: str = ""  # the reason why the word is not read
    has_remedy: bool = True  # True if the numbers of the column may be values of the input


_SIZE = Meaning(["radius", "diameter"], "it may be a radius or a diameter")
_DIAMETER = Meaning(["diameter"], "it may be a diameter")
_FORCE = Meaning(["load"], "it may be a load, or a force that was measured")
_OF_PAIR = Meaning(["work_of_adhesion", "surface_energy"], "it may be the work of adhesion of the pair")
_MODULUS = Meaning(["youngs_modulus", "contact_modulus"], "it may be Young's modulus, or E* of the contact")
_DOUBTFUL_WORDS = {
    "size": _SIZE,
    **dict.fromkeys("normalforce appliedforce preload setpoint".split(), _FORCE),
    **dict.fromkeys("indentation overlap penetration".split(), Meaning(["approach_at_load"], "it may be the approach")),
    **dict.fromkeys(
        """modulus effectivemodulus equivalentmodulus combinedmodulus compositemodulus dmtmodulus jkrmodulus
        hertzmodulus sneddonmodulus indentationmodulus""".split(),
        _MODULUS,
    ),
    "surfacetension": Meaning(["surface_energy"], "it may be the tension of a liquid"),
    **dict.fromkeys("adhesion adhesionenergy energyofadhesion".split(), _OF_PAIR),
    "hysteresis": Meaning(["adhesion_hysteresis"], "it may be another hysteresis"),
}
_DOUBTFUL_SYMBOLS = {
    **dict.fromkeys("d D dp Dp".split(), _DIAMETER),
    **dict.fromkeys("Fn FN".split(), _FORCE),
    "gamma12": Meaning(["work_of_adhesion"], "it may be of the interface: w = γ1 + γ2 - γ12", has_remedy=False),
    **dict.fromkeys("R* Reff Rred Req".split(), Meaning(["reduced_radius"], "it may be the reduced radius")),
    **dict.fromkeys("w12 W12 wa Wa wad Wad".split(), Meaning(["work_of_adhesion"], "it may be the work of adhesion")),
    "2gamma": Meaning(["work_of_adhesion"], "it may be the work of adhesion, w = 2γ"),
    "Rp": Meaning(["radius"], "it may be the radius of a particle"),
    "Eeff": _MODULUS,
}

_DISTANCE = {  # but r1 and r2 are radii
    "r": Meaning(["radius"], "r may be a radius or a distance"),
    "s": Meaning(["asperity_radius"], "s may be an asperity radius or a distance"),
}
# Symbols that mean another quantity if their case changes: Δ is not δ, d0 may be a diameter, and Rh is rhodium.
_OTHER_IN_CASE = ("d0", "delta", "deltaw", "rh")

# The symbol of a property with an index for the solid: E_s, rho_p, Es. After nu there must be a gap, and after R a gap
# and the name of a body.
_WITH_INDEX = re.compile(
    r"([EG]|rho|nu|R(?=[\s_](?:tip|probe|sphere|sample|wall)\Z))(?:[\s_]+([A-Za-z]\w*)|(?<!nu)[a-z])"
)

# Words that other quantities share, as in speed of sound and contact angle. Alone or with a unit, they mean an input.
SHARED = (
    *"""energy speed velocity geschwindigkeit vitesse velocidad angle approach contacts monomers gravity cutoff xi z0
    surfacetension""".split(),
)
# Words that turn the word next to them into another quantity.
OTHERS = {
    *"""atomic ionic covalent metallic vdw bohr gyration current dislocation yield failure ultimate shear bulk
    storage loss dynamic complex flexural bending section rupture resilience polar dispersive water liquid
    apparent apparente hydrodynamic pore crater capillary meniscus kelvin""".split()
}
# Words for sphere 1, which moves, and for sphere 2; a sample may be either.
BODIES = {
    1: {
        *"""tip probe indenter colloid projectile impactor intruder particle sphere ball bead grain monomer spitze kugel
        partikel teilchen pointe bille particule""".split()
    },
    2: {
        *"""wall substrate sub plate plane target counterface counterbody boundary geometry wand substrat platte ebene
        paroi""".split()
    },
}
# Words that leave the quantity unchanged, such as names of bodies and words for a mean.
NEUTRAL = {
    *"""mean average avg nominal measured applied indentation sample surface body solid first second s of the de la du
        der per area jkr dmt""".split(),
    *chain(BODIES[1], BODIES[2]),
    *(f"{body}s" for body in chain(BODIES[1], BODIES[2])),
}
# Words for a function of a quantity.
FUNCTIONS = {*"log ln lg exp inv inverse reciprocal sqrt normalized".split()}
# Words, and stems of words, for a quantity of the pair of spheres.
_INDICES_OF_PAIR = {*"eff red eq star".split()}
_STEMS_OF_PAIR = re.compile("redu[czi]|ridott|effe[ck]|equiv|combined|composite|harmoni")
# The quantity of the pair that corresponds to an input of one sphere.
PAIRS = {"radius": "reduced_radius", "youngs_modulus": "contact_modulus", "surface_energy": "work_of_adhesion"}
# Words that turn the word before them into a label or a count: material_id, load case.
LABELS = {*"""id ids no nr num number name names type types class classes case cases code codes key group category kind
    family label tag index step count counts cell rank source ref reference url doi note notes comment comments desc
    description quality flag status unit units method model formula cost price date color colour grade out
    ratio lit dft calc""".split()}  # fmt: skip
INDICES = ("in", "bar")  # units in brackets; elsewhere, "in" may be inside, and "bar" a mean

_WORD = re.compile(r"[^\W\d_](?:[\w\s.'-]*[\w\s.-])?")


def key(word: str) -> str:
    """Return the letters and digits of a word in lower case; "" if it is not a word.

    >>> key("Young's modulus"), key("youngs_modulus"), key("γ"), key("2 gamma")
    ('youngsmodulus', 'youngsmodulus', 'gamma', '')
    """
    plain = word if word.isascii() else ascii_text(word)
    return re.sub(r"[\W_]+", "", plain).casefold() if _WORD.fullmatch(plain) else ""


def spelt_out(word: str) -> str:
    """Return a symbol with Greek letters spelt out, without gaps; Rho and some others are written in lower case."""
    spelt = ascii_text(word).replace(" ", "").replace("_", "")
    return spelt.lower() if spelt.rstrip("12").title() in ("Gamma", "Nu", "Rho", "Xi", "Tau", "Theta") else spelt


@cache
def meanings(measured: str) -> dict[str, Meaning]:
    """Return the meanings of words by key, with and without 1 or 2 for the sphere.

    `measured`: quantities separated by commas, whose names and symbols are known in addition to inputs.
    """
    names = {name: name for name in (*INPUTS, *MATERIALS)} | OPTION_WORDS
    for word in NO_HEADERS:
        del names[word]
    for name, others in CERTAIN_SYNONYMS.items():
        names |= dict.fromkeys(others, name)
    inputs, plurals = {}, {}
    for word, name in names.items():
        if name in INPUTS or name in MATERIALS:
            inputs[word] = Meaning([name])
            plurals[re.sub("us$", "i", re.sub("y$", "ies", word))] = inputs[word]  # radii
    known = dict.fromkeys(NOMENCLATURE, Meaning()) | _of_spheres(inputs | plurals | _DOUBTFUL_WORDS)
    for name in filter(None, measured.split(",")):
        spelt = [name, NOMENCLATURE[name].symbol]
        if name in _OF_CURVES:
            spelt += [*CERTAIN_SYNONYMS.get(name, []), *_OF_CURVES[name].split()]
        known |= dict.fromkeys(filter(None, map(key, spelt)), Meaning([name]))
    return {word.replace("_", ""): meaning for word, meaning in known.items() if word}


@cache
def symbols() -> dict[str, Meaning]:
    """Return the meanings of symbols with Greek letters spelt out, with and without 1 or 2 for the sphere."""
    names: dict[str, list[str]] = {}
    for name in INPUTS:
        if name in RATIOS or NOMENCLATURE[name].unit != "1":
            names.setdefault(spelt_out(NOMENCLATURE[name].symbol).removesuffix("1"), []).append(name)
    for symbol, name in _MORE_SYMBOLS.items():
        names.setdefault(symbol, []).append(name)
    return _of_spheres({symbol: Meaning(inputs) for symbol, inputs in names.items()} | _DOUBTFUL_SYMBOLS) | _DISTANCE


@cache
def symbols_in_any_case() -> dict[str, Meaning]:
    """Return the meanings of symbols in lower case, except symbols such as R and r, whose meaning depends on case."""
    by_letters: dict[str, list[Meaning]] = {}
    for symbol, meaning in symbols().items():
        by_letters.setdefault(symbol.casefold(), []).append(meaning)
    unique = {}
    for symbol, (first, *others) in by_letters.items():
        if symbol not in _OTHER_IN_CASE and all(other == first for other in others):
            unique[symbol] = first
    return unique


def with_symbol(word: str) -> Meaning | None:
    """Return the meaning of a symbol before a unit, in any case; None for another word.

    >>> with_symbol("e").names, with_symbol("r2").names, with_symbol("d0")
    (['youngs_modulus', 'energy'], ['radius2'], None)
    """
    symbol = spelt_out(word)
    return symbols().get(symbol) or symbols_in_any_case().get(symbol.casefold())


def with_index(text: str) -> str:
    """Return the key of the property whose symbol stands before an index for the solid; "" for another text.

    >>> with_index("E_s"), with_index("ρp"), with_index("E_loss"), with_index("num")
    ('youngsmodulus', 'density', '', '')
    """
    if spelt_out(text) in symbols():
        return ""  # Er is E*
    parts = _WITH_INDEX.fullmatch(ascii_text(text))
    if parts is None or (parts[2] or "").casefold() in {*OTHERS, *LABELS}:
        return ""
    return key(symbols()[parts[1]].names[0])


def tokens_of(text: str) -> list[str]:
    """Return the words, symbols and numbers of a header in lower case.

    >>> tokens_of("E wall"), tokens_of("surfAdh_2"), tokens_of("z0")
    (['e', 'wall'], ['surf', 'adh', '2'], ['z0'])
    """
    parted = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", ascii_text(text).replace("'", ""))
    return re.findall(r"[a-z]+\d*|\d+", parted.casefold())


def is_of_pair(tokens: Iterable[str]) -> bool:
    """Return whether the words of a header name a quantity of the pair of spheres.

    >>> is_of_pair(["modulo", "ridotto"]), is_of_pair(["e", "eff"]), is_of_pair(["red", "grain"]), is_of_pair(["e"])
    (True, True, True, False)
    """
    return any(token in _INDICES_OF_PAIR or _STEMS_OF_PAIR.search(token) for token in tokens)


def is_of_asperity(tokens: Iterable[str]) -> bool:
    """Return whether the words of a header name an asperity.

    >>> is_of_asperity(["asperitytipradius"]), is_of_asperity(["r", "asp"]), is_of_asperity(["grasp"])
    (True, True, False)
    """
    return any("asperit" in token or token in ("asp", "rasp") for token in tokens)


_ORDINALS = {"first": 1, "second": 2}


def sphere_of(tokens: Sequence[str]) -> int:
    """Return the number of the sphere that the words of a header name, by number, body or a last j; 0 for none."""
    numbers = [int(token[-1]) for token in tokens if re.fullmatch(r"[a-z]*([12])\1?", token)]  # A22
    numbers += [_ORDINALS[token] for token in tokens if token in _ORDINALS]
    if numbers:
        return numbers[0]
    if not BODIES[2].isdisjoint(tokens):  # particle density of the wall
        return 2
    if not BODIES[1].isdisjoint(tokens):
        return 1
    return 2 if tokens and tokens[-1] == "j" else 0


_GAPS = re.compile(r"[\s_.,(){}\[\]-]+|(?<=[a-z0-9])(?=[A-Z])")
_BODY = rf"(?:(?:body|material|sphere|particle)_?(?P<number>[12])|(?P<body>{'|'.join([*BODIES[1], *BODIES[2]])}))"
_WITH_BODY = (
    re.compile(rf"(?i){_BODY}_(?P<word>.*[^\d_])"),
    re.compile(rf"(?i)(?P<word>.*?[^\d_])(?:_(?:of|of_the|de|de_la|du|der))?_{_BODY}"),
)


def without_body(word: str) -> str:
    """Return a word with a number in place of the body of a sphere; a word without a body is returned unchanged.

    >>> without_body("E wall"), without_body("tip radius"), without_body("radius of sphere 2"), without_body("wall")
    ('E2', 'radius1', 'radius2', 'wall')
    """
    plain = "_".join(filter(None, _GAPS.split(word)))
    for pattern in _WITH_BODY:
        found = pattern.fullmatch(plain)
        if found:
            return f"{found['word']}{found['number'] or sphere_of([found['body'].casefold()])}"
    return word


def _of_spheres(known: Mapping[str, Meaning]) -> dict[str, Meaning]:
    """Return the meanings of words, and of each word with 1 or 2 appended if it means an input of one sphere."""
    of_spheres = dict(known)
    for word, meaning in known.items():
        of_first = [name for name in meaning.names if NOMENCLATURE[name].sphere == 1]
        if of_first:
            of_spheres[f"{word}1"] = meaning._replace(names=of_first)
            of_spheres[f"{word}2"] = meaning._replace(names=[NOMENCLATURE[name].twin for name in of_first])
    return of_spheres


@cache
def slips() -> dict[str, str]:
    """Return the words for inputs by their spellings: the right one, and those that lack a letter.

    Two words that share such a spelling differ by a slip: one letter is missing, extra, wrong or in another place.
    Short words, and those of doubtful meaning, are left out.
    """
    known = []
    for word, meaning in meanings("").items():
        is_like_diag = re.fullmatch("diam?[12]?", word)
        if meaning.names and not meaning.problem and len(word) > 3 and not is_like_diag:
            known.append(word)
    spellings: dict[str, str] = {}
    for word in sorted(known, key=len, reverse=True):  # the longest first, since gamma is not a slip of gamma2
        spellings |= dict.fromkeys(lacking_a_letter(word), word)
    return spellings


def lacking_a_letter(word: str) -> list[str]:
    """Return a word, and its spellings that lack one letter."""
    return [word, *(word[:index] + word[index + 1 :] for index in range(len(word)))]


def headed(name: str, unit_text: str = "UNIT") -> str:
    """Return the header of an input, with its unit if it needs one."""
    return f"{name} [{unit_text}]" if unit_text == "%" or NOMENCLATURE[name].unit not in ("", "1") else name


# --- Words of columns that are not read -------------------------------------------------------------------------------

# Words that turn the quantity next to them into another: a multiple, a part, a power or a ratio.
SENSES = {*"half double twice fwhm hwhm squared square inv times per ratio rel relative change rate".split()}
# SI units so common that a unit alone does not point to an input: a word must.
COMMON_UNITS = ("m", "N", "s", "1")
_OF_BODIES = """size groess gross grain partic sphere bead kugel korn partikel colloid monomer indenter bille tamano
    taille tip probe ball""".split()
# Symbols, and parts of words, that point to an input with a common unit, or to some other inputs.
POINTERS: Mapping[str, tuple[Sequence[str], Sequence[str]]] = {
    "humidity": (["rh"], "humid feucht umid".split()),
    "yield_strength": ("sigmay sy ys rp02".split(), "yield streck fliess".split()),
    "poisson_ratio": ("nu pr".split(), "poiss querkontrak".split()),
    "hysteresis_fraction": ((), ["hyst"]),
    "hamaker": ("a ah".split(), ["hamaker"]),
    "adhesion_hysteresis": ("dw deltaw".split(), ["hyst"]),
    "radius": (
        "r a rp rs rt rw ri rj rm rb rad roc".split(),
        ["radi", "rayon", "raggi", "halbmess", "raio", "straal", *_OF_BODIES],
    ),
    "diameter": ("d d32 d43 dp ds dt dw di dj dv x10 x50 x90 vmd dia".split(), ["diam", "durchm", *_OF_BODIES]),
    "reduced_radius": ("reff rstar".split(), "radi rayon raggi".split()),
    "yield_displacement": ("xi ksi".split(), "displac verschieb deplac crit krit roll".split()),
    "atomic_spacing": (
        "z0 d0 h0 hmin dmin eps".split(),
        "spacing atom minim closest separation attract equilib gleichgew".split(),
    ),
    "cutoff": ("d0 rcut dcut".split(), ["cutoff"]),
    "approach_at_load": (
        "delta deltan ind hind dind".split(),
        "indent approach overlap uberlapp ueberlapp penetr deform verform indring enfonc".split(),
    ),
    "load": (
        "fn p pn l ext external app set pre".split(),
        "load last charge setpoint applied norm carg caric trigger press aufl belast".split(),
    ),
}
# Words that do not distinguish inputs of the same dimension.
GENERIC = {
    *"energy energie energia modulus module modulo modul coefficient constante rate radius rayon radio work of".split(),
    *"roughness gap".split(),
}
# Words for quantities that are not inputs, by SI unit.
NO_INPUTS: Mapping[str, frozenset[str]] = {
    unit: frozenset(text.split())
    for unit, text in {
        "J/m^2": """stiffness spring constant steifigkeit federkonstante raideur k kn kt kc ks kr cantilever lever
            liquid water fluence dose gradient slope sensitivity polar dispersive film torque moment drehmoment""",
        "Pa": """uts festigkeit vickers knoop pressure press druck pression stress spannung yield hardness haerte
            durete strength compressive vacuum vapour vapor tresca mises p sigma""",
        "kg/m^3": "gas air fluid liquid water medium bulk tap tapped packing loose number charge",
        "J": """potential ioni chemical atom molecule mol formation exfoliation decomposition vbm cbm heat thermal
            activation bond lattice band bandgap gap photon fermi dissipation dissipated lost loss barrier kt kbt break
            breaking rolling roll fold sticking pull binding strain internal torque moment drehmoment""",
        "m/s": """sound schall thermal friction shear vx vy vz wave wind flow gas fluid scan ramp retract
            retraction terminal settling sticking rebound rotation angular escape crack pull stick""",
        "m": """contact gyration height thickness width length position distance dist roughness rms rq ra
            wavelength box film layer lattice pore mesh grid tube bend orbital separation lambda mfp path trajectory
            screen debye""",
        "N": """adhesion adhesive pull off pulloff friction lateral shear measured snap detach detachment
            rupture capillary drag electrostatic""",
    }.items()
}
# Words that are used for an input, but may also mean another quantity.
WORDS_BESIDES: Mapping[str, Sequence[str]] = {
    "radius": "radius radii rad raggio halbmesser roc".split(),
    "atomic_spacing": "minimum closest".split(),
    "cutoff": "cutoff cut minimum closest".split(),
    "diameter": "d32 d43 dp ds dt dw di dj dv x10 x50 x90 vmd".split(),
    "surface_energy": "surface surf tension sfe".split(),
    "work_of_adhesion": """adhesion adh interface interfacial fracture release separation dupre haft gc gic jkr
        dgamma""".split(),
    "adhesion_hysteresis": "hysteresis dw deltaw".split(),
    "youngs_modulus": "young elastic modul dmt ym".split(),
    "contact_modulus": "contact reduced reduz reduit reducido red effective effekt eff equivalent eq star er".split(),
    "shear_strength": "friction strength tau".split(),
    "energy": "kinetic impact collision ekin".split(),
    "speed": "relative impact collision rel".split(),
    "yield_displacement": "xi critical rolling roll".split(),
}
