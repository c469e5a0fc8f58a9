"""The pull-off force by each law of attraction, against the parameter that leads from one to the other."""

from collections.abc import Sequence
from math import pi

from ..materials.library import Materials
from ..physics.jkr_to_dmt import pull_off_force_lennard_jones, transition_parameter
from ..physics.maugis_states import pull_off_force_maugis
from ..quantities.formatting import amount
from ..scene.scene import DEFAULTS, Scene
from .axes import Axis
from .panels import Curve, Panel, Picture
from .plot_request import mark_at

POINTS = 401
_TABOR = Axis("tabor_parameter", 1e-2, 1e2, size=POINTS)
_RATIO = Axis("pull_off_force_ratio", 1.45, 2.05, is_log=False)
_LENNARD_JONES = Axis("tabor_parameter", 0.01, 2.0, size=POINTS)  # the range of its fit
_UNIT = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0}  # in which forces are those over πwR


def figure_laws(materials: Materials, marks: Sequence[str]) -> Picture:
    """Return the pull-off force over πwR against μ by JKR, DMT, Maugis' law and that of Lennard-Jones, with grains as marks."""
    import numpy

    tabor, near = _TABOR.values(), _LENNARD_JONES.values()
    maugis = pull_off_force_maugis(transition_parameter=transition_parameter(tabor_parameter=tabor), **_UNIT)
    ends = numpy.array([_TABOR.low, _TABOR.high])
    curves = (
        Curve("Maugis–Dugdale", tabor, maugis, 0),
        Curve("Lennard-Jones", near, pull_off_force_lennard_jones(tabor_parameter=near, **_UNIT), 1),
        Curve("DMT", ends, numpy.array([2.0, 2.0]), 2),
        Curve("JKR", ends, numpy.array([1.5, 1.5]), 3),
    )
    points = tuple(mark_at(text, materials, Scene({}, model="maugis"), _TABOR, _RATIO) for text in marks)
    spacing = amount("atomic_spacing", DEFAULTS["atomic_spacing"])
    caption = (
        "Pull-off force over πwR by each law; Lennard-Jones' by a fit to numerical solutions, within 0.3 % for 0.01 ≤ μ ≤ 2.",
        *((f"Grains at Maugis–Dugdale with z0 = {spacing}: μ falls as 1/z0.",) if points else ()),
    )
    return Picture("", (Panel(_TABOR, _RATIO, curves, points),), caption)
