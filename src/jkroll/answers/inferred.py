"""The answer of `infer`: the value of an input that a measured quantity implies, with what it rests on."""

from collections.abc import Mapping
from math import isfinite
from typing import TYPE_CHECKING

from ..errors import NoResult
from ..quantities.formatting import amount
from ..quantities.laws import LAWS
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.errors import MissingInput, reason_of
from ..scene.inverse import SIZES, Solution, solution, with_input
from ..scene.scene import Scene
from .answer import Answer, add_uncertainties, answer
from .questions import Question
from .result import Note, Result

if TYPE_CHECKING:
    from ..quantities.uncertain import Uncertain

# The properties of a material that an inferred input takes the place of.
_REPLACED = {"work_of_adhesion": ("surface_energy",)}


def inferred(name: str, quantity: str, measured: "float | Uncertain", scene: Scene) -> Answer:
    """Return the value of an input at which a quantity of a scene has its measured value, as the answer of a command.

    A scene without a solution gives an answer without a value. Raises the errors of `solution` other than NoResult.
    """
    value = measured if isinstance(measured, float) else measured.value
    question = Question((quantity,), (quantity,))
    try:
        found = solution(name, quantity, value, scene)
    except NoResult as error:
        anywhere = answer(question, with_input(scene, name, SIZES[name][1]))
        return Answer(
            _echo(anywhere, name, quantity, value), (Result(name, None, reason_of(name, error)),), (), (), error
        )
    forward = answer(question, found.scene)
    inputs = _echo(forward, name, quantity, value)
    by_law = _by_other_laws(name, quantity, value, scene)
    result = Result(name, found.value, condition=found.condition if isfinite(found.condition) else None, by_law=by_law)
    notes = (*_notes(name, quantity, found, by_law, scene), *forward.notes)
    plain = Answer(inputs, (result,), notes, forward.validity, None)
    if isinstance(measured, float) and not scene.is_uncertain:
        return plain
    from ..scene.uncertainty import inferred_uncertainty

    uncertainty, sources = inferred_uncertainty(name, quantity, measured, found, scene)
    return add_uncertainties(plain, {} if uncertainty is None else {name: uncertainty}, sources)


def _echo(forward: Answer, name: str, quantity: str, value: float) -> dict[str, float | str]:
    """Return the inputs of an answer without the one that is asked for, and with the measured value."""
    return {known: each for known, each in forward.inputs.items() if known != name} | {quantity: value}


def _by_other_laws(name: str, quantity: str, value: float, scene: Scene) -> dict[str, float]:
    """Return the value of an input under each other law of attraction that has the quantity by other formulas."""
    own = with_input(scene, name, SIZES[name][1]).plan(quantity).steps
    values = {}
    for law in LAWS:
        other = scene.under(law)
        try:
            if with_input(other, name, SIZES[name][1]).plan(quantity).steps != own:
                values[law] = solution(name, quantity, value, other).value
        except (MissingInput, NoResult):
            continue
    return values


def _notes(name: str, quantity: str, found: Solution, by_law: Mapping[str, float], scene: Scene) -> list[Note]:
    """Return what of the materials is not used, how errors grow, and the proof of the value."""
    used = found.scene.data_used(found.scene.inputs_of(quantity))
    materials = {one.name: one for one in (scene.material, scene.material2) if one is not None}
    unused = [
        f"{NOMENCLATURE[each].symbol.rstrip('1')} of {material.name} is not used"
        for material in materials.values()
        for each in _REPLACED.get(name, (name,))
        if each in material.properties and all(one.name != material.name or other != each for one, other in used)
    ]
    symbol, of_measured = NOMENCLATURE[name].symbol, NOMENCLATURE[quantity].symbol
    proof = (
        f"{symbol} = {amount(name, found.value)} gives {of_measured} = {amount(quantity, found.forward)}; "
        f"κ = |d ln {symbol}/d ln {of_measured}| = {found.condition:.3g}"
    )
    if by_law:
        others = ", ".join(f"{amount(name, value)} under {LAWS[law].title}" for law, value in by_law.items())
        proof += f"; {others}"
    return [*(Note("result", text) for text in unused), Note("model", proof)]
