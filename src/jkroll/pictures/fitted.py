"""The picture of a fit: the measured and the fitted curve, the residuals, and the energy release rate."""

import re
from collections.abc import Sequence
from typing import Any

import numpy

from ..fitting.branches import QUANTITIES
from ..fitting.result import Fit
from ..quantities.laws import DEFAULT_LAW, PARABOLOID
from ..quantities.shown import Part, Shown
from ..report.fitted import findings, in_words, line_on_known, name_in_sentence, symbol_of_result
from ..tables.fitted import fit_given
from ..text import capital, listed
from ..write.fitted import parts_of_fit
from .drawn import Drawn
from .picture import Curve, Panel, Picture, axis_around

_RESULTS = ("work_of_adhesion_opening", "work_of_adhesion_closing", "contact_modulus")
# Advice on options in a line of a terminal: in parentheses, or after a colon or semicolon.
_ADVICE = (re.compile(r" \(--[^()]*\)"), re.compile(r"[:;] [^:;()]*--[^:;()]*"))
# The symbols in a line, apart from parts of words and formulas.
_SYMBOL = re.compile(r"(?<![\w/*])(?:wR?_open|wR?_close|wR?|E\*√R|E\*|E[12]|a0?/R|P_c|R|G|k|z0/2)(?![\w*/'])")
_INK = -1  # colour of measured points under the coloured line of their fit
_MOST = 600  # of twice as many points or more, every n-th is drawn, and at least this number


class FittedCurve(Shown, Fit):
    """The fit of a curve, which can be drawn; notebooks show it as a terminal does."""

    @property
    def drawn(self) -> Drawn:
        """The picture of the curve, its residuals and, with a known radius, the energy release rate."""
        return Drawn(picture_of_fit(self, "", caption_of_fit(self)))

    def __repr__(self) -> str:
        return f"<FittedCurve: {listed(f'{name} = {in_words(self, name)}' for name in self.values)}>"

    def _parts(self) -> list[Part]:
        return parts_of_fit(self)

    def plot(self, ax: Any = None, style: str = "paper") -> Any:
        """Draw on matplotlib axes, one for each of the two or three panels, or on those of a new figure; return them.

        Needs the extra `plot`.
        """
        return self.drawn.plot(ax, style)


def fit(
    curve: Any,
    /,
    *,
    spring: Any = None,
    model: str = DEFAULT_LAW,
    branch: str = "both",
    range: str | None = None,
    profile: str = PARABOLOID,
    baseline: str = "median",
    **given: Any,
) -> FittedCurve:
    """Return the fit of a measured force curve.

    Parameters
    ----------
    curve
        The path of a table, or a mapping of headers to columns, such as a DataFrame. The columns are contact radius and
        load, approach and load, or travel and the force or deflection of a lever, with units in the headers.
    spring
        The stiffness of the lever in N/m, or a text such as "3.01±0.1N/m"; required for a travel or a deflection.
    model
        The law: jkr, maugis or dmt.
    branch
        both, load or unload.
    range
        The loads to fit, as "-100%:30%" of the largest tension and load, or "-2uN:500nN".
    profile
        paraboloid, or sphere: a rigid sphere on a body with a Poisson's ratio of 0.45 or more.
    baseline
        median, or tilt: lines through the parts out of contact.
    **given
        The radii, as in `solve`; without a radius, the fit gives wR and E*√R. Also Poisson's ratios, `atomic_spacing`,
        and the Young's modulus of one body, from which that of the other body is computed.

    Returns
    -------
    `FittedCurve`: `values` and `errors` by name, in SI units, with `covariance`; `curve` holds the points by header,
    and `plot()` draws them.

    Raises
    ------
    BadCurve, BadRequest, BadRow, BadTable, QuantityError
        The curve cannot be fitted, an argument is wrong, or the table has no curve or a bad row.

    >>> import numpy
    >>> a = numpy.linspace(80e-6, 40e-6, 30)
    >>> load = 4 / 3 * 2e6 * a**3 / 1e-3 - numpy.sqrt(8 * numpy.pi * 0.05 * 2e6 * a**3)
    >>> fitted = fit({"contact radius [m]": a, "load [N]": load}, radius=1e-3, radius2="plane")
    >>> [f"{fitted.values[name]:.4g}" for name in ("work_of_adhesion_opening", "contact_modulus")]
    ['0.05', '2e+06']
    """
    words = {"model": model, "branch": branch, "range": range, "profile": profile, "baseline": baseline}
    return FittedCurve(**vars(fit_given(curve, words, spring, given)))


def caption_of_fit(fitted: Fit) -> list[str]:
    """Return the sentences below the picture of a fit."""
    results = []
    for name in _RESULTS:
        if name in fitted.values:
            results.append(f"{name_in_sentence(name)}, {symbol_of_result(fitted, name)} = {in_words(fitted, name)}")
    texts = (line_on_known(fitted), "; ".join(results), *findings(fitted), *fitted.remarks.values())
    return [_as_sentence(text) for text in texts]


def _as_sentence(text: str) -> str:
    """Return a line of a terminal as a sentence of a caption: with marked symbols, and without advice on options.

    >>> _as_sentence("the misfit is 2% of P_c (--baseline tilt fits lines); if it is not, give --branch load")
    'The misfit is 2 % of ⟦P_c⟧.'
    """
    for advice in _ADVICE:
        text = advice.sub("", text)
    text = text.replace("%", " %").replace("m^0.5", "√m")
    return capital(_SYMBOL.sub(r"⟦\g<0>⟧", text)) + "."


def picture_of_fit(fitted: Fit, title: str, caption: Sequence[str]) -> Picture:
    """Return the picture of a fit. Without a radius, the energy release rate is scaled and has no panel."""
    points = {name: column[:: max(1, len(column) // _MOST)] for name, column in fitted.points.items()}
    branches = [*dict.fromkeys(points["branch"].tolist())]
    forces, residuals, rates = list[Curve](), list[Curve](), list[Curve]()
    for colour, name in enumerate(branches):
        own = points["branch"] == name
        z = points["z"][own]
        forces.append(Curve(f"{name}, measured", z, points["force"][own], _INK, has_points=True))
        forces.append(Curve(f"{name}, fitted", z, points["model"][own], colour))
        residuals.append(Curve(name, z, points["residual"][own], colour, has_points=True))
        has_rate = own & numpy.isfinite(points["release_rate"])
        if has_rate.any():
            radius, rate = points["contact_radius"][has_rate], points["release_rate"][has_rate]
            rates.append(Curve(name, radius, rate, colour, has_points=True))
    x = axis_around(QUANTITIES[fitted.kind], [points["z"]])
    panels = [
        Panel(x, axis_around("load", [points["force"], points["model"]]), (*forces,), title="force"),
        Panel(x, axis_around("residual_load", [points["residual"]]), (*residuals,), title="residual"),
    ]
    if rates and not fitted.is_scaled:
        across = axis_around("contact_radius_at_load", [curve.x for curve in rates])
        up = axis_around("energy_release_rate", [curve.y for curve in rates])
        panels.append(Panel(across, up, (*rates,), title="energy release rate"))
    return Picture(title, (*panels,), (*caption,))
