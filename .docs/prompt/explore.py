"""What the explorer shows of a contact, as JSON: numbers, reasons, the curve, and calls that give the same numbers."""

import json
import shlex
from collections.abc import Mapping
from itertools import groupby
from typing import Any

import jkroll

# The questions of the explorer, each with the results that answer it.
QUESTIONS = {
    "pulls them apart": ("pull_off_force",),
    "starts one rolling": ("yield_force",),
    "bends a chain most": ("r_min",),
    "stands level in gravity": ("n_grav",),
    "vibrates": ("vertical_frequency", "rolling_frequency"),
    "rolls after a collision": ("n_roll",),
}
SKETCHED = ("contact_radius_at_load", "approach_at_load", "reduced_radius")
WANTED = [name for names in QUESTIONS.values() for name in names] + [*SKETCHED]
POSITIONAL = ("material", "radius")
# The words of inputs, and their names in an answer.
INPUTS = {
    word: next((name for name, each in jkroll.NOMENCLATURE.items() if each.option == f"--{word}"), word)
    for word in ("radius", "radius2", "gamma", "young", "poisson", "density", "load", "xi", "speed")
}
OF_CURVE = ("material", "material2", "model", "radius", "radius2", "gamma", "young", "poisson")
CURVE_ENDS_AT = 16 / 9  # in units of the pull-off force, if no loads are given


def explore(text: str) -> str:
    """Return what is shown of a contact, given the texts of its inputs; for a mistake, the input and the error."""
    given = _given(text)
    try:
        found = _shown(given)
    except jkroll.JkrollError as error:
        name = getattr(error, "name", "")
        found = {"error": str(error), "input": next((word for word, each in INPUTS.items() if each == name), name)}
    return json.dumps({**found, **_calls(given), "given": given}, ensure_ascii=False)


def curve(text: str) -> str:
    """Return the force curve of a contact: its lines by label, each a list of points of approach and load."""
    given = _given(text)
    contact = {name: given[name] for name in OF_CURVE if name in given}
    try:
        force, load = jkroll.answer(["pull_off_force", "load"], **contact, load=given.get("load", "0N")).values.values()
        is_beyond = load.value > CURVE_ENDS_AT * force.value
        drawn = jkroll.curve(**contact, load=(-force.value, 1.3 * load.value) if is_beyond else None)
    except jkroll.JkrollError:
        return json.dumps({"lines": {}})
    lines = {
        label: [[*map(float, point)] if point[0] == point[0] else None for point in zip(*line, strict=True)]
        for label, line in drawn.lines.items()
    }
    return json.dumps({"lines": lines})


def materials() -> list[tuple[str, list[str]]]:
    """Return the groups of known materials, and the names in each."""
    known = jkroll.known_materials().materials.values()
    return [(title, [each.name for each in group]) for title, group in groupby(known, key=lambda each: each.title)]


def _given(text: str) -> dict[str, str]:
    return {name: word.strip() for name, word in json.loads(text).items() if word.strip()}


def _shown(given: Mapping[str, str]) -> dict[str, Any]:
    answered = jkroll.answer(WANTED, **given)
    inputs = {word: name for word, name in INPUTS.items() if name in answered.inputs}
    return {
        "results": {name: _result(answered, name) for name in WANTED},
        "inputs": {
            word: {"value": _number(answered.inputs[name]), "text": answered.inputs_in_words[name]}
            for word, name in inputs.items()
        },
        "why": {by: text for by, text in answered.why.items() if any(row.by == by for row in answered.rows.values())},
        "doubts": [
            {"text": doubt.text, "ends": doubt.ends}
            for doubt in answered.doubts
            if not doubt.code.startswith("law-off")  # the best ranges say so
        ],
        "notes": answered.notes,
    }


def _result(answered: Any, name: str) -> dict[str, Any]:
    """Return a result: its texts as on a terminal, its number for the drawings, and the reason if it has no value."""
    result, row = answered[name], answered.rows.get(name)
    texts = row._asdict() if row else {"symbol": jkroll.NOMENCLATURE[name].symbol, "best": "–", "by": "–", "value": "–"}
    return {**texts, "number": result.value, "reason": result.reason}


def _number(value: Any) -> float | None:
    """Return an input as a number: the middle of an uncertain one; None for a word, such as a plane."""
    return None if isinstance(value, str) else float(getattr(value, "value", value))


def _calls(given: Mapping[str, str]) -> dict[str, str]:
    """Return the command and the Python call that give the same numbers."""
    first = [given[name] for name in POSITIONAL if name in given]
    others = [f"--{name}={word}" for name, word in given.items() if name not in POSITIONAL]
    keywords = ", ".join(f"{name}={json.dumps(word, ensure_ascii=False)}" for name, word in given.items())
    return {
        "shell": shlex.join(["jkroll", "report", *first, *others]),
        "python": f'import jkroll\nprint(jkroll.answer("report", {keywords}))',
    }
