"""The picture of a fit: the measured and the fitted curve, the residuals, and the energy release rate."""

from collections.abc import Sequence
from typing import Any

import numpy

from ..model.fit_result import Fit
from ..quantities.laws import DEFAULT_LAW
from ..quantities.shown import Part, Shown
from ..report.fitted import in_words, sentence_of, sentences
from ..tables.fitted import fit_given
from ..text import listed
from ..write.fitted import parts_of_fit
from .drawn import Drawn
from .picture import Curve, Panel, Picture, axis_around

_MOST = 600  # points of a drawn curve
_X = {"contact radius": "contact_radius_at_load", "approach": "approach_at_load", "travel": "lever_travel"}


class FittedCurve(Shown, Fit):
    """The fit of a curve, which can be drawn; notebooks show it as a terminal does."""

    @property
    def drawn(self) -> Drawn:
        """The picture of the curve, its residuals and, with a known radius, G."""
        return Drawn(picture_of_fit(self, "", caption_of_fit(self)))

    def __repr__(self) -> str:
        return f"<FittedCurve: {listed(f'{name} = {in_words(self, name)}' for name in self.values)}>"

    def _parts(self) -> list[Part]:
        return parts_of_fit(self)

    def plot(self, ax: Any = None, style: str = "paper") -> Any:
        """Draw on three matplotlib axes, or on those of a new figure; return them. Needs the extra `plot`."""
        return self.drawn.plot(ax, style)


def fit(
    curve: Any,
    /,
    *,
    spring: Any = None,
    model: str = DEFAULT_LAW,
    branch: str = "both",
    range: str | None = None,
    profile: str = "paraboloid",
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
    BadCurve, BadRequest, BadTable, QuantityError
        The curve cannot be fitted, an argument is wrong, or the table has no curve.

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
    names = ("work_of_adhesion_opening", "work_of_adhesion_closing", "contact_modulus")
    results = [f"{sentence_of(name)} {in_words(fitted, name)}" for name in names if name in fitted.values]
    return [f"{text}." for text in (*results, *sentences(fitted))]


def picture_of_fit(fitted: Fit, title: str, caption: Sequence[str]) -> Picture:
    """Return the picture of a fit. Without a radius, G is scaled and has no panel."""
    points = {name: column[:: max(1, len(column) // _MOST)] for name, column in fitted.points.items()}
    branches = [*dict.fromkeys(points["branch"].tolist())]
    forces, residuals, rates = list[Curve](), list[Curve](), list[Curve]()
    for colour, name in enumerate(branches):
        own = points["branch"] == name
        z = points["z"][own]
        forces.append(Curve(name, z, points["force"][own], colour))
        forces.append(Curve(f"{name}, fitted", z, points["model"][own], colour, is_dashed=True))
        residuals.append(Curve(name, z, points["residual"][own], colour))
        radius, rate = points["contact_radius"][own], points["release_rate"][own]
        if numpy.isfinite(rate).any():
            rates.append(Curve(name, radius, rate, colour))
    x = axis_around(_X[fitted.kind], [points["z"]])
    panels = [
        Panel(x, axis_around("load", [points["force"], points["model"]]), (*forces,), title="force"),
        Panel(x, axis_around("residual_load", [points["residual"]]), (*residuals,), title="residual"),
    ]
    if rates and not fitted.is_scaled:
        across = axis_around("contact_radius_at_load", [curve.x for curve in rates])
        up = axis_around("energy_release_rate", [curve.y for curve in rates])
        panels.append(Panel(across, up, (*rates,), title="energy release rate"))
    return Picture(title, (*panels,), (*caption,))
