"""The fit of a measured force curve in a table, with the options of `jkroll fit` or the arguments of `jkroll.fit`."""

import os
from collections.abc import Mapping
from math import inf
from typing import Any

from ..errors import BadRequest, BadTable
from ..fitting.branches import TRAVEL, BadCurve, LoadRange
from ..fitting.fit import fit_curve
from ..fitting.measurement import WORK_OF_ADHESION
from ..fitting.result import BODIES, Fit, Known, is_on_plane, ratio_of_plane
from ..materials.library import Materials, materials_of_user
from ..model.accepted import check_range
from ..model.containers import Reader, warn_of_metres
from ..model.reasons import MissingInput
from ..model.solver import solve
from ..model.unknowns import SIZES
from ..physics.sphere import INCOMPRESSIBLE, STIFFER
from ..quantities.formatting import Format, amount
from ..quantities.laws import DEFAULT_LAW, JKR_OF_SPHERE, MAUGIS, PARABOLOID, SPHERE, law_given
from ..quantities.nomenclature import DEFAULTS, NOMENCLATURE, as_input, computed_as
from ..quantities.values import QuantityError, ends_of, is_uncertain, middle, value_of
from ..text import as_arguments, listed, quoted
from .curves import ReadCurve, curve_of_columns, read_curve

_BRANCHES = ("both", "load", "unload")
_BASELINES = ("median", "tilt")
_RADII = ("radius", "radius2", "diameter", "diameter2", "reduced_radius")
_WIDEST = 2.0  # largest a/R of a fitted contact
_FORM = Format(digits=3)
_TAKEN = (*_RADII, *BODIES, "atomic_spacing")
_LIKE = 1.01  # ratio of two numbers that are the same except for rounding


def fit_given(curve: Any, words: Mapping[str, str | None], spring: Any, given: Mapping[str, Any]) -> Fit:
    """Return the fit of a curve in a file or in columns. The arguments are those of `jkroll.fit`.

    `words`: the arguments that are texts, by name. Error messages name arguments instead of options.
    """
    for word in given:
        if as_input(word) not in _TAKEN:
            raise BadRequest(f"fit takes no {quoted(word)}; it takes {listed(_TAKEN)}")
    read = Reader().in_si(given)
    for name, value in read.items():
        if getattr(middle(value), "shape", ()):
            raise BadRequest(f"{name}: a curve takes a single value, not an array")
        check_range(name, middle(value))
    warn_of_metres(given)
    try:
        known = known_of(words, spring, read)
        if isinstance(curve, str | os.PathLike):
            return fit_of_file(os.fspath(curve), known)[0]
        return _fitted(curve_of_columns(curve, materials_of_user(None), _known_stiffness(known)), known)
    except (BadCurve, BadRequest, BadTable) as error:
        error.args = (as_arguments(str(error)),)
        raise


def fit_of_file(
    path: str,
    known: Known,
    materials: Materials | None = None,
    columns: tuple[str, ...] = (),
    form: str = "",
    mark: str = "",
) -> tuple[Fit, str]:
    """Return the fit of the curve in a file, and the sentence that says how the file was read."""
    materials = materials or materials_of_user(None)
    read = read_curve(path, materials, _known_stiffness(known), columns, form, mark)
    return _fitted(read, known), read.reading


def _fitted(read: ReadCurve, known: Known) -> Fit:
    """Return the fit of a curve. Raises BadCurve, and BadTable if a column contradicts an option.

    With a known radius, a fit is refused if no solid has its values. With the profile of a sphere, it is refused if the
    moduli are known and the sphere is not STIFFER times as stiff as the plane.
    """
    _check_stated(read.stated, known.given)
    fitted = fit_curve(read.curve, known)
    if not fitted.is_scaled:
        _check_sizes(fitted, read.reading)
    moduli = {**known.bodies}
    if fitted.other_modulus is not None:
        name, modulus = fitted.other_modulus
        moduli[name] = modulus
    first, second = (moduli.get(name) for name in BODIES[:2])
    if known.profile == SPHERE and first is not None and second is not None and not first >= STIFFER * second:
        here = f"E1 is {first / second:.3g} times E2 here"
        raise BadCurve(
            f"--profile sphere holds for a sphere {STIFFER:.0f} times as stiff as the plane, and {here}",
            "sphere is not rigid",
        )
    return fitted


def _check_stated(stated: Mapping[str, tuple[str, float]], given: Mapping[str, Any]) -> None:
    """Raise BadTable if a column states another number than the option for the same input."""
    for name, (head, number) in stated.items():
        for other, value in given.items():
            if computed_as(name) != computed_as(other):
                continue
            there, (low, high) = _computed(name, number), ends_of(_computed(other, value))
            if not low / _LIKE <= there <= high * _LIKE:
                option = "--spring" if other == "lever_stiffness" else NOMENCLATURE[other].option or f"--{other}"
                both = f"it is {amount(name, number, _FORM)} there, and {option} gives {amount(other, value, _FORM)}"
                raise BadTable(f"column {quoted(head)}: {both}; correct one, or --column {quoted(f'{head}=')}")


def _computed(name: str, value: Any) -> Any:
    """Return the value of the input to which an input is converted, as a radius for a diameter."""
    return value if computed_as(name) == name else solve(computed_as(name), **{name: value})


def _check_sizes(fitted: Fit, reading: str) -> None:
    """Raise BadCurve if no solid has the fitted w or E*, or if no sphere has the fitted a/R.

    w is the work of adhesion, E* the contact modulus, and a/R the contact radius over the reduced radius.
    """
    values, (softest, stiffest) = fitted.values, SIZES["youngs_modulus"]
    modulus, width = values["contact_modulus"], fitted.goodness["contact_over_radius"]
    w = max((values[name] for name in WORK_OF_ADHESION.values() if name in values), default=0.0)
    force = values.get("pull_off_force_measured", 0.0)
    # If the contact is much stiffer than the lever, any larger E* fits as well. Such a fit is accepted if its pull-off
    # force is at most twice the measured one.
    is_too_stiff = modulus > stiffest and values.get("pull_off_force_fitted", inf) > 2 * force
    if w > SIZES["work_of_adhesion"][1]:
        problem = f"w = {amount('work_of_adhesion', w, _FORM)}, which no solid has"
    elif modulus < softest or is_too_stiff:
        problem = f"E* = {amount('contact_modulus', modulus, _FORM)}, which no solid has"
    elif width > _WIDEST:
        problem = f"a/R = {width:.2g}, which no sphere has"
    else:
        return
    causes = ["are columns or units swapped"]
    if fitted.kind == TRAVEL:
        causes.append("is the spring wrong")
        if is_too_stiff:
            causes.append("is the travel an approach (--column 'HEADER=approach_at_load [UNIT]')")
    raise BadCurve(f"the fit gives {problem}: {listed(causes, 'or')}? {reading}", "no solid")


def _known_stiffness(known: Known) -> float | None:
    return known.stiffness if known.stiffness < inf else None


def known_of(words: Mapping[str, str | None], spring: Any, given: Mapping[str, Any]) -> Known:
    """Return the known data of the contact and the lever, and the options of the fit. Raises BadRequest, QuantityError.

    `words`, `spring`, `given`: the arguments of `jkroll.fit`; `given` has inputs in SI units, some with uncertainties.
    """
    for option, choices in (("branch", _BRANCHES), ("baseline", _BASELINES)):
        if words.get(option) not in choices:
            raise BadRequest(f"--{option}: {quoted(str(words.get(option)))} is not one of: {listed(choices)}")
    name = law_given(words["model"], words["profile"]) or DEFAULT_LAW
    law, profile = (DEFAULT_LAW, SPHERE) if name == JKR_OF_SPHERE else (name, PARABOLOID)
    if profile == SPHERE:
        _check_sphere(given)
    stiffness = _stiffness_in_si(spring)
    radius = _radius(given)
    if law == MAUGIS and radius is None:
        raise BadRequest("--model maugis needs --radius: its curve depends on R and the atomic spacing")
    value = middle(stiffness) if stiffness is not None else inf
    return Known(
        radius=None if radius is None else float(middle(radius)),
        radius_error=_relative_error(radius),
        stiffness=value,
        stiffness_error=_relative_error(stiffness),
        spacing=float(middle(given.get("atomic_spacing", DEFAULTS["atomic_spacing"]))),
        law=law,
        profile=profile,
        branch=str(words["branch"]),
        range=_range(words.get("range")),
        tilt=words["baseline"] == "tilt",
        given={**given} if stiffness is None else {**given, "lever_stiffness": stiffness},
    )


def _stiffness_in_si(spring: Any) -> Any:
    if spring is None:
        return None
    is_text = isinstance(spring, str)
    value = value_of(spring, "lever_stiffness") if is_text else Reader().number("lever_stiffness", spring)
    if not middle(value) > 0:
        raise QuantityError("lever_stiffness", str(spring), "must be positive")
    return value


def _radius(given: Mapping[str, Any]) -> Any:
    """Return the reduced radius of the given radii; None if no radius is given."""
    radii = {name: given[name] for name in _RADII if name in given}
    if not radii:
        return None
    try:
        return solve("reduced_radius", **radii) if "reduced_radius" not in radii else radii["reduced_radius"]
    except MissingInput:
        raise BadRequest("--radius2 needs --radius") from None


def _relative_error(value: Any) -> float:
    """Return half the width of a value's uncertainty, relative to the value; 0 without an uncertainty."""
    return float((value.high - value.low) / 2 / abs(value.value)) if is_uncertain(value) else 0.0


def _check_sphere(given: Mapping[str, Any]) -> None:
    """Raise BadRequest unless the inputs are those of a sphere of known radius on a nearly incompressible plane.

    On any other plane, the error of half-space theory is larger than the correction for the profile of a sphere.
    """
    ratio = ratio_of_plane(given)
    if ratio is None or not ratio >= INCOMPRESSIBLE:
        raise BadRequest(
            "--profile sphere holds for a rigid sphere on a body that keeps its volume: give its Poisson's ratio, 0.45 "
            "or more, as in --poisson2 0.5"
        )
    if not any(name in given for name in _RADII):
        raise BadRequest("--profile sphere needs --radius")
    if not is_on_plane(given):
        raise BadRequest("--profile sphere needs a sphere on a plane: give --radius2 plane")


def _range(text: str | None) -> LoadRange | None:
    """Return the range of a text FROM:TO, in percent of the largest tension and load or in forces; None without one."""
    if text is None:
        return None
    ends = [end.strip() for end in text.split(":")]
    if len(ends) != 2 or not all(ends):
        raise BadRequest(f"--range: {quoted(text)} is not of the form FROM:TO, as in -100%:30% or -2uN:500nN")
    are_shares = [end.endswith("%") for end in ends]
    if all(are_shares):
        try:
            low, high = (float(end[:-1]) / 100 for end in ends)
        except ValueError:
            raise BadRequest(f"--range: {quoted(text)} has no numbers before %") from None
    elif any(are_shares):
        raise BadRequest(f"--range: {quoted(text)} mixes a percentage and a force; write two of the same")
    else:
        low, high = (float(middle(value_of(end, "load"))) for end in ends)
    if not low < high:
        raise BadRequest(f"--range: {quoted(text)} does not rise; write FROM:TO with FROM below TO")
    return LoadRange(low, high, all(are_shares))
