"""The picture of a fit: the curve with what was fitted, the residuals, and the energy release rate over the radius."""

from collections.abc import Sequence

import numpy

from ..model.fit_result import Fit
from .picture import Curve, Panel, Picture, axis_around

_MOST = 600  # points of a drawn curve
_X = {"contact radius": "contact_radius_at_load", "approach": "approach_at_load", "travel": "lever_travel"}


def picture_of_fit(fitted: Fit, title: str, caption: Sequence[str]) -> Picture:
    """Return the picture of a fit. Without a radius lengths and energies are scaled, and G has no panel."""
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
        Panel(x, axis_around("load", [points["residual"]]), (*residuals,), title="residual"),
    ]
    if rates and not fitted.is_scaled:
        across = axis_around("contact_radius_at_load", [curve.x for curve in rates])
        up = axis_around("work_of_adhesion", [curve.y for curve in rates])
        panels.append(Panel(across, up, (*rates,), title="energy release rate"))
    return Picture(title, (*panels,), (*caption,))
