"""Columns that are not read, judged by their units: no column may pass if another value would silently replace it.

The unit of a column tells which inputs it may be, and its words choose among them. If a material, an option, a default
or sphere 1 supplies such an input, the column is refused until the user states its meaning. Lengths, forces, times and
ratios are often not inputs, so the words of such a column must point to an input: `words` has these words. A text
column may be an input if its cells are materials.
"""

import re
from collections.abc import Collection, Mapping, Sequence, Set
from functools import cache, lru_cache
from itertools import chain, pairwise, product
from typing import Any, NamedTuple

from ..errors import JkrollError
from ..materials.library import Materials, UnclearMaterial
from ..model.frame import EXCLUSIVE
from ..model.plan import depends_on, formula_of
from ..quantities.formatting import amount, symbol_of
from ..quantities.laws import DEFAULT_LAW, law_given, routes_anywhere
from ..quantities.nomenclature import DEFAULTS, NOMENCLATURE, OPTION_WORDS, PROPERTIES, computed_as, of_sphere
from ..quantities.synonyms import QUANTITY_OF_SYNONYM
from ..quantities.units import BadUnit, dimension_of, is_in_table
from ..quantities.values import QuantityError, value_of
from ..text import ascii_text, shown
from . import words
from .cells import has_no_value, is_number
from .reading import FACTOR_INSIDE, FACTOR_OF_UNIT, Reading, Split, normalized, reading_of, splits_of
from .unit_spellings import TECHNICAL_UNITS, fits, may_be_unit, squeezed, unit_for
from .words import INPUTS, MATERIALS, headed, key, sphere_of, tokens_of

# Inputs that replace each other, in addition to EXCLUSIVE.
_OF_MODULI = tuple(("contact_modulus", name) for name in ("youngs_modulus", "youngs_modulus2"))
# The names of the inputs, and of the formulas that compute them.
_OF_INPUTS = {*INPUTS, *chain.from_iterable(routes_anywhere().get(name, ()) for name in INPUTS)}
# Inputs whose columns may also have words for other quantities.
_WITH_OTHER_WORDS = (
    "yield_strength",
    "approach_at_load",
    "atomic_spacing",
    "yield_displacement",
    "cutoff",
    "poisson_ratio",
    "hysteresis_fraction",
    "hamaker",
)
_INPUT_OF_UNIT = {NOMENCLATURE[name].unit: name for name in INPUTS}  # an input with each SI unit
NOT_READ = "not read, and "  # before the clause that names the value used instead
_POWERS = {"sq": "2", "cu": "3"}
_MOST_MEANT = 3  # maximum number of inputs that a message offers


class Supply(NamedTuple):
    """The inputs supplied without a column, each with a clause that names the source."""

    clauses: Mapping[str, str]  # as in "E is quartz's 54 GPa"; for a replaced input, on the input that replaces it
    direct: Collection[str]  # the supplied inputs, without the replaced ones
    solids: Sequence[str]  # the columns of materials that could supply a property
    known: Materials

    @classmethod
    def of(
        cls, names: Sequence[str], columns: Collection[str], options: Mapping[str, Any], known: Materials
    ) -> "Supply":
        """Return the inputs that some quantities need and that are supplied without a column.

        `names`: the quantities; `columns`: the inputs with columns; `options`: the inputs that options give, as
        texts or, in Python, as values.
        """
        columns = {*columns, *map(computed_as, columns)}
        law = law_given(options.get("model"), options.get("profile"))
        needed = depends_on(tuple(names), (law or DEFAULT_LAW,))
        left = [name for name in INPUTS if name in needed and name not in columns]
        decided = decided_by(columns) | {name for pair, name in _OF_MODULI if pair in columns}
        clauses: dict[str, str] = {}
        has_radius = not {"radius", "diameter", "reduced_radius"}.isdisjoint((*columns, *options))
        for name in left:
            first = of_sphere(1, name)
            # Without a radius of sphere 1, a column of radii is of that sphere, so it replaces no R2.
            is_of_first = first in ("radius", "diameter") and not has_radius
            if is_of_first or (name in decided and name not in options):
                continue
            supplier = _supplier(name, columns, options, known)
            if supplier:
                clauses[name] = f"{symbol_of(name).removesuffix('1')} is {supplier}"
            elif first != name and (first in columns or first in clauses):
                clauses[name] = f"{symbol_of(name)} is that of sphere 1"
        open_names = [name for name in left if name not in clauses and name not in decided]
        replaced = _replaced(open_names, columns, clauses)
        lacking = {NOMENCLATURE[name].sphere for name in left if of_sphere(1, name) in PROPERTIES}
        solids = [solid for sphere, solid in enumerate(MATERIALS, 1) if sphere in lacking and solid not in columns]
        if "material2" in solids:
            clauses["material2"] = "sphere 2 is of the solid of sphere 1"
        return cls(replaced | clauses, clauses, solids, known)


def _replaced(names: Sequence[str], columns: Set[str], clauses: Mapping[str, str]) -> dict[str, str]:
    """Return the inputs that a supplied input replaces, each with a clause on the supplied input."""
    replaced: dict[str, str] = {}
    for group in (*EXCLUSIVE, *_OF_MODULI):
        if not columns.isdisjoint(group):
            continue
        for other in filter(clauses.__contains__, group):
            source = clauses[other].replace(" is ", ", which is ", 1)
            for name in filter(group.__contains__, names):
                replaced[name] = f"{symbol_of(name).removesuffix('1')} follows from {source}"
    return replaced


def decided_by(columns: Collection[str]) -> set[str]:
    """Return the inputs that columns determine.

    A load determines the approach, and the radii of both spheres determine the reduced radius; but γ does not determine
    w of two solids.
    """
    decided: set[str] = set()
    for group in EXCLUSIVE:
        if "work_of_adhesion" not in group and not {*group}.isdisjoint(columns):
            decided |= {*group}
    is_of_two = not {"radius2", "diameter2", "reduced_radius"}.isdisjoint(columns)
    return decided if is_of_two else decided - {"reduced_radius"}


def _supplier(name: str, columns: Collection[str], options: Mapping[str, Any], known: Materials) -> str:
    """Return the source of an input without a column, in words; "" if there is no source, or if it is sphere 1."""
    if name in options:
        value = options[name] if isinstance(options[name], str) else amount(name, options[name])
        return f"{NOMENCLATURE[name].option or f'--{name}'} {shown(value)}"
    sphere = NOMENCLATURE[name].sphere
    solid = of_sphere(sphere, "material") if sphere else ""
    first = of_sphere(1, name)
    if first in PROPERTIES and solid in columns:
        return "the material's" if sphere == 1 else f"that of {solid}"
    if first in PROPERTIES and solid in options:
        try:
            material = known[options[solid]] if isinstance(options[solid], str) else options[solid]
        except JkrollError:
            return ""
        if first in material.properties:
            return f"{material.name}'s {amount(first, material.properties[first])}"
    return f"{amount(name, DEFAULTS[name])} by default" if name in DEFAULTS else ""


def judged(reading: Reading, cells: Sequence[str], supply: Supply) -> Reading:
    """Return the reading of a column, with a problem if the column is unread and may be an input supplied otherwise.

    `cells`: the cells of the column in the first rows.
    """
    if reading.name or reading.problem or reading.part or reading.is_stated:
        return reading
    cells = [cell.strip() for cell in cells if not has_no_value(cell)]
    if cells and not any(map(is_number, cells)):
        of_solids = _of_solids(reading, cells, supply)
        if of_solids is not None:
            return of_solids
    text = normalized(reading.text)
    split, candidates = _candidates(text, cells, supply)
    if not candidates:
        return reading
    tokens = tokens_of(split.word)
    names, is_certain = _likeliest(tokens, [*candidates], supply)
    clauses = dict.fromkeys(supply.clauses[name] for name in names or candidates)
    problem = f"{NOT_READ}{'; '.join([*clauses][:_MOST_MEANT])}"
    is_certain &= not re.search(FACTOR_INSIDE, text) and (words.FUNCTIONS | words.SENSES).isdisjoint(tokens)
    is_mangled = split.is_mangled and is_in_table(f"u{split.unit}")
    cells_have_units = not all(map(is_number, cells))
    if not is_certain:
        meant = []
    elif cells_have_units and not split.unit:
        meant = names
    else:
        units = {} if is_mangled else candidates
        meant = [headed(name, units.get(name) or "UNIT") for name in names]
    first = names[0] if names else next(iter(candidates))
    return reading._replace(name=first, problem=problem, meant=meant[:_MOST_MEANT], names=names or [*candidates])


def offered(text: str, cells: Sequence[str], names: Sequence[str]) -> list[str]:
    """Return the meanings that an unread column may have, out of some inputs that the table lacks.

    The unit, or else the first cell, must fit. The words choose between the inputs that fit, if they can.

    >>> offered("d50 (um)", [], ["radius", "diameter"]), offered("L [nm]", [], ["radius", "diameter"])
    (['diameter [um]'], ['radius [nm]', 'diameter [nm]'])
    """
    cells = [cell.strip() for cell in cells if not has_no_value(cell)]
    split = _with_unit(normalized(text))
    tokens = tokens_of(split.word)
    meanings: dict[str, str] = {}
    for name in names:
        unit = _unit(split, name)
        if unit:
            meanings[name] = headed(name, unit)
        elif cells and _is_value(cells[0], name):
            meanings[name] = name
        if name in meanings and (_is_of_other(tokens, name) or _is_result(split) or sphere_of(tokens) == 2):
            del meanings[name]
    scores = {name: _score(tokens, name) for name in meanings}
    best = max(scores.values(), default=0)
    return [meanings[name] for name in meanings if scores[name] == best]


def _candidates(text: str, cells: Sequence[str], supply: Supply) -> tuple[Split, Mapping[str, str]]:
    """Return the word and the unit of a header, and the supplied inputs that it may mean, with their units."""
    split = _with_unit(text)
    units = {unit: _unit(split, name) for unit, name in _INPUT_OF_UNIT.items()}
    candidates: dict[str, str] = {}
    for name in supply.clauses:
        unit = units.get(NOMENCLATURE[name].unit, "")
        if unit:
            candidates[name] = unit
    if not candidates:
        candidates, split = dict.fromkeys(_without_unit(text, cells, supply), ""), Split(text, "")
    if not candidates:
        split, names = _with_unread_unit(text)
        candidates = {name: "UNIT" for name in names if name in supply.clauses}
    if _is_result(split):
        return split, {}
    tokens = tokens_of(split.word)
    sphere = sphere_of(tokens)
    spheres = (0, sphere) if sphere else (0, 1, 2)
    possible = [name for name in candidates if NOMENCLATURE[name].sphere in spheres]
    if not _is_unreadable(split.word):
        possible = [name for name in possible if _points_to(tokens, name)]
    return split, {name: candidates[name] for name in possible}


@lru_cache(maxsize=5000)
def _unit(split: Split, name: str) -> str:
    """Return the unit of an input in a header; UNIT if its spelling is not read, "" without a unit that fits."""
    quotient = re.sub(r"(?<=\w)([ms])\^?[-−]1$", r"/\1", split.unit)
    if quotient != split.unit and fits(quotient, name):
        return "UNIT"  # ms-1
    is_other = is_in_table(split.unit) and not split.unit.isupper() and not fits(split.unit, name)  # Å may become A
    if not split.unit or is_other:
        return ""
    unit = unit_for(split.unit, name, is_explicit=split.is_explicit)
    if unit:
        return unit
    has_sphere_first = re.match(r"[12][\W_]*(?!e[-\d])[^\W\d]", split.unit)
    spelt = re.sub(FACTOR_OF_UNIT, "", split.unit) + ("_" if split.is_mangled else "")
    return "UNIT" if not has_sphere_first and may_be_unit(spelt, name) else ""


def _without_unit(text: str, cells: Sequence[str], supply: Supply) -> list[str]:
    """Return the supplied inputs that a header without a unit may mean, by its first cell, its words or its symbol."""
    if not all(map(is_number, cells)):
        return [name for name in supply.clauses if _is_value(cells[0], name)]
    tokens = tokens_of(text)
    ratios = [name for name in supply.clauses if NOMENCLATURE[name].unit == "1" and _points_to(tokens, name)]
    if ratios:
        return ratios
    reading = reading_of(text)
    is_symbol = reading.is_symbol and NOMENCLATURE[reading.name].unit not in words.COMMON_UNITS
    is_short = len(text.strip().rstrip("12")) == 1  # w and A are symbols of too many quantities
    is_supplied = reading.name in (supply.direct if is_short else supply.clauses)
    return [reading.name] if is_symbol and is_supplied else []


def _with_unread_unit(text: str) -> tuple[Split, Sequence[str]]:
    """Return a header divided before an unknown or a technical unit, and the inputs that its word means.

    Before an unknown unit, only a symbol counts, as in d2 [mikrometer].
    """
    for split in filter(lambda split: split.is_explicit, splits_of(text)):
        word = words.without_body(split.word)
        symbol = words.with_symbol(word)
        meaning = symbol or words.meanings("").get(key(word), words.Meaning())
        names = [name for name in meaning.names if _is_technical(split.unit, name)]
        if not names and symbol and not _is_known(split.unit):
            names = [name for name in symbol.names if NOMENCLATURE[name].unit != "1"]
        if names:
            return split, names
    return Split(text, ""), []


def _is_technical(unit: str, name: str) -> bool:
    """Return whether a text means a unit of an input in a technical system, as kg/mm² does for a pressure."""
    spelt = {squeezed(text) for text in TECHNICAL_UNITS.get(NOMENCLATURE[name].unit, ())}
    return squeezed(unit) in spelt


@lru_cache(maxsize=5000)
def _is_known(unit: str) -> bool:
    """Return whether a text is empty, or a unit of any quantity or ratio; but a lone µ is not known."""
    if unit in ("µ", "μ", "u"):
        return False  # µ alone stands for µm
    try:
        return unit in ("", "-", "%") or bool(dimension_of(unit))
    except BadUnit:
        return False


def _of_solids(reading: Reading, cells: Sequence[str], supply: Supply) -> Reading | None:
    """Return the refusal of a column of materials; None if it has other cells, is a label, or is not needed."""
    tokens = tokens_of(normalized(reading.text))
    is_label = not words.LABELS.isdisjoint({*tokens} - {"name", "names"})
    if not supply.solids or is_label or not all(_is_material(cell, supply.known) for cell in dict.fromkeys(cells)):
        return None
    sphere, names = sphere_of(tokens), [*supply.solids]
    if sphere and MATERIALS[sphere - 1] in supply.solids:
        names = [MATERIALS[sphere - 1]]
    return reading._replace(name=names[0], problem=f"{NOT_READ}its cells are materials", meant=names)


def _is_material(cell: str, known: Materials) -> bool:
    try:
        return len(cell) > 1 and bool(known[cell])
    except UnclearMaterial:
        return True
    except JkrollError:
        return False


def _is_value(cell: str, name: str) -> bool:
    """Return whether a cell is a number with a unit of this input."""
    if is_number(cell) or not cell[:1].isdigit() or NOMENCLATURE[name].unit in ("", "1"):
        return False
    try:
        value_of(cell, name)
    except QuantityError:
        return False
    return True


# --- Words ------------------------------------------------------------------------------------------------------------


def _with_unit(text: str) -> Split:
    """Return a header divided at its longest known unit; without one, the whole header is the word."""
    known = []
    for split in splits_of(_with_powers(text)):
        if _is_unit(split):
            known.append(split._replace(unit=split.unit.lstrip(" /|:;-")))
    return max(known, key=lambda split: (len(split.unit), len(split.word)), default=Split(text, ""))


def _with_powers(text: str) -> str:
    """Return a header with square and cubic metres written as powers, m2 for sq m, and a gap after a sphere: R2um."""
    text = re.sub(r"^([a-zA-Z]{1,5}[12])(?=[a-zµ])", r"\1 ", text)
    pattern = r"(?i)(?<![a-z])(sq|cu)[\s._]*(c?m)(?![a-z])"
    return re.sub(pattern, lambda found: f"{found[2]}{_POWERS[found[1].lower()]}", text)


def _is_unit(split: Split) -> bool:
    """Return whether the second part of a split is a unit of an input, or is in the table of units."""
    is_certain = split.is_explicit or split.is_mangled or not f"{split.word}{split.unit}".isascii()
    if not is_certain and len(split.unit) == 1 and len(split.word) < 3:
        return False  # an index
    if key(split.unit) in words.meanings(""):
        return False  # the g of specific gravity
    if not split.is_explicit and re.search(r"\s(?:in|[/,;:|])\s|[\s_.][\[({<]", split.unit):
        return False  # the unit is at the end: r_m / nm, A_22 [J]
    return is_in_table(split.unit) or any(_unit(split, name) for name in _INPUT_OF_UNIT.values())


def _is_result(split: Split) -> bool:
    """Return whether a header names a result of this program, at its beginning or by symbol, with a unit that fits."""
    name = re.sub(r"[\s_.-]+", "_", split.word.strip()).casefold()
    for result, quantity in NOMENCLATURE.items():
        is_named = name == result or name.startswith(f"{result}_")
        is_meant = is_named or (quantity.symbol == split.word and quantity.symbol not in _symbols_of_inputs())
        if is_meant and result not in _OF_INPUTS and formula_of(result) is not None and fits(split.unit, result):
            return True
    return False


@cache
def _symbols_of_inputs() -> Collection[str]:
    return {symbol_of(name).removesuffix("1") for name in INPUTS} | {symbol_of(name) for name in INPUTS}


def _is_unreadable(word: str) -> bool:
    """Return whether a word has no letter that can be read, so that only the unit tells its meaning."""
    return not re.search(r"[a-zA-Z]", ascii_text(word)) and re.search(r"[^\W\d]|[?\ufffd]", word) is not None


def _points_to(tokens: Sequence[str], name: str) -> bool:
    """Return whether the words of a header allow it to be this input."""
    first, unit = of_sphere(1, name), NOMENCLATURE[name].unit
    if _is_of_other(tokens, name):
        return False
    if first not in words.POINTERS:
        return unit not in words.COMMON_UNITS
    symbols, stems = words.POINTERS[first]
    bare = {*tokens, *map("".join, pairwise(tokens)), *map(_bare, tokens)}  # also fn for F_n, and cutoff for cut-off
    return not bare.isdisjoint(symbols) or any(stem in token for stem, token in product(stems, bare))


def _is_of_other(tokens: Sequence[str], name: str) -> bool:
    """Return whether the words of a header show that it is another quantity than this input."""
    first = of_sphere(1, name)
    if first not in _WITH_OTHER_WORDS:
        symbol = words.with_symbol(tokens[0]) if tokens else None
        if not words.LABELS.isdisjoint(tokens) and not (symbol and name in symbol.names):
            return True  # but E (lit.) is a modulus
        others = words.NO_INPUTS.get(NOMENCLATURE[name].unit, frozenset())
        long_words = [word for word in others if len(word) > 4]
        if any(word in token for word, token in product(long_words, tokens)):
            return True
        long_tokens = [token for token in tokens if len(token) > 2]
        if not (words.OTHERS | others).isdisjoint([*long_tokens, "".join(tokens)]):
            return True  # short words count together: kn for k_n
    return first in ("radius", "diameter", "reduced_radius") and words.is_of_asperity(tokens)


def _likeliest(tokens: Sequence[str], names: Sequence[str], supply: Supply) -> tuple[list[str], bool]:
    """Return the inputs that the words of a header most likely mean, and whether a word makes them certain."""
    sphere, is_of_pair = sphere_of(tokens), words.is_of_pair(tokens)
    if is_of_pair:
        names = [name for name in names if name in words.PAIRS.values()]
    if not sphere and _index(tokens) in ("", *"psti"):  # no index, particle, sphere, tip or i: rather sphere 1
        names = [name for name in names if NOMENCLATURE[name].sphere != 2 or of_sphere(1, name) not in supply.clauses]
    scored = tokens[:1] if _index(tokens) else tokens
    scores = {name: _score(scored, name) for name in names}
    best = max(scores.values(), default=0)
    likeliest = [name for name in names if scores[name] == best]
    if sphere:
        likeliest = [name for name in likeliest if NOMENCLATURE[name].sphere] or likeliest
    is_certain = best > 0 or is_of_pair
    return [name for name in likeliest if is_certain or name in supply.direct], is_certain


def _index(tokens: Sequence[str]) -> str:
    """Return the letter after a symbol, as the w in E_w; "" if there is none."""
    return tokens[1] if len(tokens) == 2 and len(tokens[0]) < 4 and len(tokens[1]) == 1 else ""


def _score(tokens: Sequence[str], name: str) -> int:
    """Return the number of words in a header that match an input; two adjacent words that match together count more."""
    first = of_sphere(1, name)
    symbols, vocabulary = [_bare(token) for token in tokens_of(symbol_of(first))], _vocabulary(first)
    score = 0
    for token in tokens:
        score += _is_one_of(_bare(token), symbols, vocabulary)
    for pair in map("".join, pairwise(tokens)):  # dGamma
        score += 2 * (pair in vocabulary)
    return score


def _bare(token: str) -> str:
    """Return a word of a header without the number at its end: of a sphere (R2), a start (v0) or a percentile (d50)."""
    return re.sub(r"(?<=[a-z])(?:[12]|\d?0)$", "", token)


def _is_one_of(token: str, symbols: Collection[str], vocabulary: Collection[str]) -> bool:
    """Return whether a token is a symbol, a word, or the beginning or another form of a word."""
    if token in symbols or (len(token) < 3 and token in vocabulary):
        return True
    if len(token) < 3:
        return False
    return any(len(word) > 2 and (word.startswith(token) or word[:5] in token) for word in vocabulary)


@cache
def _vocabulary(name: str) -> Collection[str]:
    """Return the words for an input from its name, its option and its synonyms, without generic ones."""
    texts = [name]
    for name_of in (OPTION_WORDS, QUANTITY_OF_SYNONYM):
        texts += [text for text, meant in name_of.items() if meant == name]
    tokens = {token for token in chain.from_iterable(map(tokens_of, texts)) if len(token) > 1}
    return tokens - words.GENERIC | {*words.WORDS_BESIDES.get(name, ())}
