"""The Python face of the inverse problem."""

from collections.abc import Callable, Mapping, Sequence
from math import prod
from typing import Any

from ..errors import NoResult
from ..materials.library import Material, Materials
from ..quantities.errors import QuantityError
from ..quantities.nomenclature import named
from ..quantities.values import is_uncertain
from ..scene.inverse import Problem, already_given, input_named
from ..scene.scene import broadcast, check_range
from ..scene.solver import in_si, materials_of, refuse_arrays, with_uncertainty


class InferredValues(dict[str, Any]):
    """The values of two inputs by name, and the condition number of both together."""

    def __init__(self, values: Mapping[str, Any], condition: Any) -> None:
        super().__init__(values)
        self.condition = condition


def infer(
    wanted: str | Sequence[str],
    /,
    *,
    measured: Mapping[str, Any],
    material: str | Material | None = None,
    material2: str | Material | None = None,
    materials: Materials | None = None,
    model: str | None = None,
    **given: Any,
) -> Any:
    """Return the value of an input at which a quantity has its measured value, or those of two inputs by two quantities.

    Parameters
    ----------
    wanted
        An input: surface_energy, work_of_adhesion, hamaker, yield_displacement, adhesion_hysteresis, youngs_modulus,
        shear_strength, radius or load, or the word of its option. A list of two for both.
    measured
        One quantity of the nomenclature with its value, which is a number, a list, a text and so on as for `solve`. For
        two inputs, two quantities.
    material, material2, materials, model, **given
        The rest of the scene, as `solve` takes it. Values that a material has of the inputs are not used.

    Returns
    -------
    A float in SI units; an array if a value was one; `Measured` or `Interval` if a given or measured value is
    uncertain. For two inputs, a dict of these by name. Its attribute `condition` is the condition number of the
    logarithms of the measured quantities as functions of those of the inputs.

    Raises
    ------
    AlreadyGiven, CannotInfer, MissingInput, QuantityError, UnknownMaterial, UnknownQuantity
        An input is wrong, or one is missing.
    NoDependence, NoSolution, SeveralSolutions; of two inputs Unseparated
        No value gives the measured one, or several do; or the condition number is above 1e8. Arrays hold nan there
        instead.

    >>> round(infer("gamma", measured={"pull_off_force": "300 nN"}, radius="2 um", radius2="plane"), 6)
    0.015915
    >>> measured = {"pull_off_force": "300 nN", "stiffness": "1 kN/m"}
    >>> both = infer(["gamma", "young"], measured=measured, material="quartz", radius="2 um", radius2="plane")
    >>> round(both["surface_energy"], 6), f"{both['youngs_modulus']:.4g}", round(both.condition, 2)
    (0.015915, '3.482e+10', 1.77)
    """
    names = _names(wanted)
    if not isinstance(measured, Mapping) or len(measured) != len(names):
        few = len(names) == 1
        raise QuantityError(
            "measured",
            str(measured),
            "is not one quantity and its value" if few else "is not two quantities and their values",
            'write {"pull_off_force": "300 nN"}'
            if few
            else 'write {"pull_off_force": "300 nN", "stiffness": "1 kN/m"}',
        )
    known, _ = in_si({str(word): value for word, value in measured.items()}, named)
    described, _ = in_si(given)
    for both in known.keys() & described.keys():
        raise already_given(both, both)
    for each, value in {**known, **described}.items():
        check_range(each, value.value if is_uncertain(value) else value)
    spheres = materials_of(material, material2, materials)
    inputs = {**described, **known}

    def problem(own: Mapping[str, Any]) -> Problem:
        return Problem.of(names, [*known], {**inputs, **own}, *spheres, model=model)

    arrays = {each: value for each, value in inputs.items() if not (isinstance(value, float) or is_uncertain(value))}
    if any(map(is_uncertain, inputs.values())):
        refuse_arrays(inputs)
    if arrays:
        values, condition = _of_arrays(problem, arrays, names)
    else:
        values, condition = _of_numbers(problem({}))
    return InferredValues(values, condition) if len(names) > 1 else values[names[0]]


def _names(wanted: str | Sequence[str]) -> list[str]:
    """Return the names of one input, or of two."""
    words = [*map(str, wanted)] if isinstance(wanted, list | tuple) else [str(wanted)]
    names = [*map(input_named, words)]
    if isinstance(wanted, list | tuple) and len({*names}) != 2:
        remedy = 'write "gamma" or ["gamma", "young"]'
        raise QuantityError("wanted", str(wanted), "cannot be inferred: one input can, or two", remedy)
    return names


def _of_numbers(problem: Problem) -> tuple[Mapping[str, Any], float]:
    """Return the values of the unknowns, with their uncertainties, and the condition."""
    from ..scene.unknowns import solution

    solved = solution(problem)
    if not (any(map(is_uncertain, problem.measured.values())) or problem.scene.uncertain):
        return solved.values, solved.condition
    from ..scene.uncertainty import uncertainties_of_unknowns

    bars, _ = uncertainties_of_unknowns(solved.values, problem)
    values = {name: with_uncertainty(name, value, bars.get(name)) for name, value in solved.values.items()}
    return values, solved.condition


def _of_arrays(
    problem: Callable[[Mapping[str, Any]], Problem], arrays: Mapping[str, Any], names: Sequence[str]
) -> tuple[Mapping[str, Any], Any]:
    """Return the values of the unknowns and the condition for arrays, nan where there is no solution. `problem`: of some inputs."""
    import numpy

    from ..scene.unknowns import solutions
    from .block import Block
    from .cells import Numbers
    from .rows import groups

    class Elements(Block):
        """Rows of the elements of arrays."""

        def scene(self, given: Mapping[str, Any], rows: Any) -> Problem:  # noqa: ARG002
            """Return the problem of rows that are alike."""
            return problem(given)

        def scene_of(self, row: int) -> Problem:
            """Return the problem of a row by itself."""
            return problem({name: float(numbers.values[row]) for name, numbers in columns.items()})

    shape = broadcast(arrays)
    columns = {name: Numbers(numpy.broadcast_to(value, shape).ravel()) for name, value in arrays.items()}
    found = numpy.full((len(names) + 1, prod(shape)), numpy.nan)
    for rows, given in groups(Elements(prod(shape), columns)):
        solved = solutions(problem(given), len(rows))
        for error in solved.failures.values():
            if not isinstance(error, NoResult):
                raise error
        found[:, rows] = *solved.values.values(), solved.condition
    *values, condition = (column.reshape(shape) for column in found)
    return dict(zip(names, values, strict=True)), condition
