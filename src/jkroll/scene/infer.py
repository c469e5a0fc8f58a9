"""The Python face of the inverse problem."""

from collections.abc import Mapping
from typing import Any

from ..errors import NoResult
from ..materials.library import Material, Materials
from ..quantities.errors import QuantityError
from ..quantities.naming import named
from ..quantities.parsing import is_uncertain
from ..text import MAX_QUOTED
from .inputs import check_range
from .inverse import SIZES, CannotInfer, solution
from .scene import Scene
from .solver import broadcast, in_si, materials_of, uncertain_scene, with_uncertainty


def infer(
    wanted: str,
    /,
    *,
    measured: Mapping[str, Any],
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    **given: Any,
) -> Any:
    """Return the value of an input at which a quantity has its measured value.

    Parameters
    ----------
    wanted
        An input: surface_energy, work_of_adhesion, yield_displacement, adhesion_hysteresis, youngs_modulus, radius or
        load, or the word of its option.
    measured
        One quantity of the nomenclature with its value, which is a number, a list, a text and so on as for `solve`.
    material, material2, materials, model, **given
        The rest of the scene, as `solve` takes it. A value that a material has of the input is not used.

    Returns
    -------
    A float in SI units; an array if a value was one; `Measured` or `Interval` if a given or measured value is uncertain.

    Raises
    ------
    AlreadyGiven, CannotInfer, MissingInput, QuantityError, UnknownMaterial, UnknownQuantity
        An input is wrong, or one is missing.
    NoDependence, NoSolution, SeveralSolutions
        No value gives the measured one, or several do. Arrays hold nan there instead.

    >>> round(infer("gamma", measured={"pull_off_force": "300 nN"}, radius="2 um", radius2="plane"), 6)
    0.015915
    """
    name = named(str(wanted))
    if name not in SIZES:
        raise CannotInfer(str(wanted))
    if not isinstance(measured, Mapping) or len(measured) != 1:
        raise QuantityError(
            "measured",
            str(measured)[:MAX_QUOTED],
            "is not one quantity and its value",
            'write {"pull_off_force": "300 nN"}',
        )
    ((word, value),) = measured.items()
    known, _ = in_si({named(str(word)): value})
    ((quantity, at),) = known.items()
    described, _ = in_si(given)
    check_range(quantity, at.value if is_uncertain(at) else at)
    spheres = materials_of(material, material2, materials)
    if any(map(is_uncertain, (at, *described.values()))):
        return _uncertain(name, quantity, at, uncertain_scene(described, spheres, model))
    if all(isinstance(each, float) for each in (at, *described.values())):
        return solution(name, quantity, at, Scene(described, *spheres, model=model)).value
    return _each(name, quantity, {quantity: at, **described}, Scene({}, *spheres, model=model))


def _uncertain(name: str, quantity: str, at: Any, scene: Scene) -> Any:
    """Return an inferred value with its uncertainty."""
    from .uncertainty import inferred_uncertainty

    found = solution(name, quantity, at.value if is_uncertain(at) else at, scene)
    uncertainty, _ = inferred_uncertainty(name, quantity, at, found, scene)
    return with_uncertainty(found.value, uncertainty)


def _each(name: str, quantity: str, columns: Mapping[str, Any], bare: Scene) -> Any:
    """Return the inferred values for arrays, nan where there is none; `bare` has the materials and the law."""
    import numpy

    shape = broadcast({each: value for each, value in columns.items() if not isinstance(value, float)})
    flat = [numpy.broadcast_to(value, shape).ravel().tolist() for value in columns.values()]
    found = numpy.full(shape, numpy.nan)
    for place, row in enumerate(zip(*flat, strict=True)):
        given = dict(zip(columns, row, strict=True))
        try:
            found.flat[place] = solution(name, quantity, given.pop(quantity), bare.replace(**given)).value
        except NoResult:
            continue
    return found
