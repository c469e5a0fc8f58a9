"""`jkroll.infer`: values of inputs from measured quantities, for numbers and arrays."""

from collections.abc import Mapping, Sequence
from typing import Any, overload

from ..materials.library import Material, Materials
from ..quantities.laws import law_given
from ..quantities.nomenclature import NOMENCLATURE, named
from ..quantities.values import QuantityError, is_uncertain, middle
from .accepted import check_range
from .containers import Reader
from .frame import Frame
from .inverse import Inverse
from .solver import materials_of, with_uncertainties
from .unknowns import inputs_named


class InferredValues(dict[str, Any]):
    """The values of inputs by name, and the condition number of the problem."""

    def __init__(self, values: Mapping[str, Any], condition: Any) -> None:
        super().__init__(values)
        self.condition = condition


@overload
def infer(
    wanted: str,
    /,
    *,
    measured: Mapping[str, float],
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    profile: str | None = None,
    **given: float,
) -> float: ...
@overload
def infer(wanted: str, /, *, measured: Mapping[str, Any], **scene: Any) -> Any: ...
@overload
def infer(wanted: Sequence[str], /, *, measured: Mapping[str, Any], **scene: Any) -> InferredValues: ...
def infer(
    wanted: str | Sequence[str],
    /,
    *,
    measured: Mapping[str, Any],
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    profile: str | None = None,
    **given: Any,
) -> Any:
    """Return the value of an input from a measured quantity, or the values of two inputs from two quantities.

    Parameters
    ----------
    wanted
        An input among `jkroll.model.unknowns.SIZES`, or the name of its option; or a list of one or two such names.
    measured
        A quantity of the nomenclature for each wanted input, with its value: a number, a list, a text and so on, as for
        `solve`.
    material, material2, materials, model, profile, **given
        The rest of the scene, as for `solve`. A material's values of the wanted inputs are not used.

    Returns
    -------
    A float in SI units; an array if any value is an array; `Measured` or `Interval` if a given or measured value is
    uncertain. For a list, a dict of these values by name. The dict's attribute `condition` is the condition number of
    the logarithms of the measured quantities as functions of the logarithms of the inputs.

    Raises
    ------
    BadRequest, MissingInput, QuantityError, UnknownMaterial, UnknownQuantity
        An input is wrong or missing.
    NoDependence, NoSolution, SeveralSolutions, Undetermined; for two inputs Unseparated
        No value of the input gives the measured value, or several values do; for two inputs, the condition number may
        also be above 1e8. Arrays have nan in such elements instead.

    >>> round(infer("gamma", measured={"pull_off_force": "300 nN"}, radius="2 um", radius2="plane"), 6)
    0.015915
    >>> measured = {"pull_off_force": "300 nN", "stiffness": "1 kN/m"}
    >>> both = infer(["gamma", "young"], measured=measured, material="quartz", radius="2 um", radius2="plane")
    >>> round(both["surface_energy"], 6), f"{both['youngs_modulus']:.4g}", round(both.condition, 2)
    (0.015915, '3.482e+10', 1.77)
    """
    is_list = isinstance(wanted, list | tuple)
    names = inputs_named([*map(str, wanted)] if is_list else [str(wanted)])
    if not isinstance(measured, Mapping) or len(measured) != len(names):
        lack, example = "does not give a quantity and its value for each input", 'write {"pull_off_force": "300 nN"}'
        raise QuantityError("measured", str(measured), lack, example)
    reader = Reader()
    measured, given = reader.aligned(measured, given)
    levels = reader.in_si(measured, named)
    described = reader.in_si(given)
    for name, value in levels.items():
        check_range(name, middle(value))
    known = Frame(described, *materials_of(material, material2, materials), model=law_given(model, profile))
    frame = Inverse(names, levels, known)
    values, inputs = {name: frame[name] for name in names}, {**described, **levels}
    if any(map(is_uncertain, inputs.values())):  # as in `solve`
        values = with_uncertainties(frame, inputs, values)
    values = {name: reader.labelled(name, value, NOMENCLATURE[name].unit) for name, value in values.items()}
    return InferredValues(values, frame.solution.condition) if is_list else values[names[0]]
