"""The figures of the paper: its maps, the shifted contact of Figs. 2 and 9, and the pull-off force by each law.

The paper's other figures carry no data.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import pi
from typing import Any, NamedTuple

import numpy

from ..materials.library import Materials
from ..physics.any_law import pull_off_force_lennard_jones, transition_parameter
from ..physics.contact import pressure
from ..physics.cylinder import asymmetric_pressure, contact_point_moment, half_strips_moment
from ..physics.maugis import edge_ratio_at_pull_off, pull_off_force_maugis
from ..physics.shifted import exact_pressure, half_circle_pressure, unloaded_half_width
from ..quantities.formatting import amount
from ..quantities.markup import symbol
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.scene import DEFAULTS, Scene
from ..scene.solver import values_of
from .curves import AREA_AND_PRESSURES, POINTS, across, pressure_panel
from .picture import Axis, Curve, Mark, Panel, Picture
from .request import DRAWN_LIMITS, PlotRequest, mark_at, picture_of

# --- Maps: Figs. 3, 6 and 8 -------------------------------------------------------------------------------------------


RADII = Axis("radius", 5e-10, 1e-3)
_ENERGIES = Axis("surface_energy", 1e-3, 1e1)
# E1* = E1/(1 - ν1²) is 10 GPa in Fig. 6a; elsewhere it enters only where the model has no meaning.
_SOFT = {"youngs_modulus": 1e10, "poisson_ratio": 0.0}
_LIGHT = {**_SOFT, "density": 2000.0}


class PaperMap(NamedTuple):
    """A map of the paper over R1: its quantity, what the paper's text reads off it, its other axis, what it assumes."""

    quantity: str
    remark: str
    x: Axis = _ENERGIES
    given: Mapping[str, float] = _SOFT
    printed: str = ""  # the same quantity as the paper prints it


PAPER_MAPS: Mapping[str, PaperMap] = {
    "3a": PaperMap(
        "pull_off_force",
        "⟦P_c = 3πγR⟧ with ⟦R = R1/2⟧: JKR; small, hard spheres tend to ⟦4πγR⟧.",
    ),
    "3b": PaperMap(
        "yield_force_ratio",
        "It does not depend on ⟦γ⟧. The forces are equal (contour 1) at ⟦R1 = 4ξ⟧ = 0.8 nm; the text has 1 nm. "
        "There, as the text warns, elasticity holds no longer.",
    ),
    "3c": PaperMap(
        "r_min",
        "It does not depend on ⟦γ⟧: ⟦R1²/ξ⟧. At ⟦R1⟧ = 100 nm it is 50 µm, 500 times the radius.",
    ),
    "3d": PaperMap(
        "n_grav",
        "About a thousand spheres of 100 nm stand at ⟦γ⟧ = 25 mJ/m². A single sphere (contour 1) rolls "
        "from 8 µm (polystyrene) to 52 µm (iron) on; the text has about 100 µm.",
        given=_LIGHT,
    ),
    "6a": PaperMap(
        "vertical_frequency",
        "GHz at ⟦R1⟧ = 35 nm (⟦γ⟧ = 1 mJ/m²) to 130 nm (10 J/m²): almost independent of ⟦γ⟧, which "
        "enters by its power 1/6.",
        given=_LIGHT,
    ),
    "6b": PaperMap(
        "rolling_frequency",
        "Eq (40) as it follows. The paper's curves are Eq (41), 2.5 times lower. At ⟦R1⟧ = "
        "100 nm and ⟦γ⟧ = 100 mJ/m² it is 5.3 times slower than the vibration along the centres; the text has one to "
        "two orders.",
        given=_LIGHT,
        printed="rolling_frequency_as_printed",
    ),
    "8": PaperMap(
        "n_roll",
        "For ⟦W0 = P_cδ0⟧; in general these are ⟦n_roll/(W0/P_cδ0)⟧. An energy balance gives 7/2 of Eq (49). Below "
        "10 nm, spheres with ⟦E*/γ⟧ above 9·10¹¹ m⁻¹ do not roll; below 100 nm a full turn takes ⟦E*/γ⟧ below "
        "1.5·10⁹ m⁻¹.",
        x=Axis("modulus_over_energy", 1e9, 1e13, needs={"surface_energy": 1.0}),  # γ may be any
        given={},
    ),
}


def paper_map(
    name: str, materials: Materials, marks: Sequence[str] = (), *, as_printed: bool = False, is_plain: bool = False
) -> Picture:
    """Return a map of the paper with marked grains. `is_plain`: without the limits of the model."""
    declared = PAPER_MAPS[name]
    scenes, printed = (("", Scene(declared.given)),), declared.printed if as_printed else ""
    limits = () if is_plain else DRAWN_LIMITS
    drawn, _ = picture_of(
        PlotRequest(declared.quantity, declared.x, RADII, scenes, marks, materials, limits, printed=printed)
    )
    dashed = (f"Dashed in files: Eq ({NOMENCLATURE[printed].equation}), each below its contour.",) if printed else ()
    return Picture(
        f"Fig. {name}: {symbol(declared.quantity)}",
        drawn.panels,
        (*drawn.caption, *dashed),
        (*drawn.remarks, declared.remark),
    )


# --- Figs. 2 and 9: the shifted contact in three and two dimensions ---------------------------------------------------

SIZE = {"radius": 2e-8}  # of the spheres of Fig. 2, small enough that ξ is visible


def figure_2(materials: Materials, _: Sequence[str]) -> Picture:
    """Return Fig. 2: the shifted contact from above with its half-circles, and its pressure, exact and simplified."""
    scene = Scene(SIZE, materials["quartz"])
    moduli = ("contact_modulus", "reduced_radius")
    state = values_of(scene, (*AREA_AND_PRESSURES, *moduli, "approach_at_load", "yield_moment", "half_circles_moment"))
    of_pair = {name: state[name] for name in moduli}
    of_circle = {name: state[name] for name in AREA_AND_PRESSURES}
    a, shift = state["contact_radius_at_load"], float(scene["yield_displacement"])
    angle = numpy.linspace(-numpy.pi, numpy.pi, POINTS)
    half = angle / 2 + numpy.pi
    outlines = (
        Curve("contact, shifted by ⟦ξ⟧", a * numpy.cos(angle) - shift, a * numpy.sin(angle), 0),
        Curve("half-circle ⟦a + ξ⟧", (a + shift) * numpy.cos(half), (a + shift) * numpy.sin(half), 1, is_dashed=True),
        Curve("half-circle ⟦a − ξ⟧", -(a - shift) * numpy.cos(half), (a - shift) * numpy.sin(half), 2, is_dashed=True),
    )
    reach = 1.5 * (a + shift)
    x, y = (Axis(name, -reach, reach, is_log=False) for name in ("position_across", "position_beside"))
    point = Mark("contact point", 0.0, 0.0)
    view = Panel(x, y, outlines, (point,), "from above, rolling to the right", is_true_to_scale=True)

    def of_half(position: Any, radius: float) -> Any:
        given = {"distance": abs(position), "approach_at_load": state["approach_at_load"]}
        return half_circle_pressure(half_circle_radius=radius, **given, **of_pair)

    centred, shifted = across(-a, a), across(-a - shift, a - shift)
    exact = exact_pressure(position_in_circle=shifted + shift, yield_displacement=shift, **of_circle, **of_pair)
    curves = [
        Curve("exact", shifted, exact),
        *_halves("half-circle", a, shift, of_half),
        Curve("not shifted", centred, pressure(distance=abs(centred), **of_circle), 3),
    ]
    along = pressure_panel(curves, state["hertz_pressure"], "pressure along the way")
    moments = [amount(name, state[name]) for name in ("yield_moment", "half_circles_moment")]
    caption = (
        f"Two quartz spheres of 20 nm that have rolled by ⟦ξ⟧ = {amount('yield_displacement', shift)}, without load.",
        f"Moment: exact {moments[0]}, Eq (25); half-circles {moments[1]}, Eq (19).",
    )
    remarks = (
        "The circle stays behind the contact point. Ahead the pull at the rim is weaker, behind it is stronger.",
        "Exact: Hertz, flat punch and tilted flat punch on one circle at a fixed load.",
        "Half-circles: Eq (16) at a fixed approach, not continuous at ⟦x = 0⟧.",
    )
    return Picture("Fig. 2: the shifted contact", (view, along), caption, remarks)


def _halves(word: str, a: float, shift: float, of_half: Callable[[Any, float], Any]) -> Iterator[Curve]:
    """Iterate over the pressures of two halves that meet at the contact point, of the contact behind it and ahead."""
    for sign, size, x in (("+", a + shift, across(-a - shift, 0.0)), ("−", a - shift, across(0.0, a - shift))):
        yield Curve(f"{word} ⟦a {sign} ξ⟧", x, of_half(x, size), 1 if sign == "+" else 2, is_dashed=True)


def figure_9(materials: Materials, _: Sequence[str]) -> Picture:
    """Return Fig. 9: the pressure of a cylinder on a rigid plane, symmetric and shifted, exact and simplified."""
    quartz = materials["quartz"].properties
    modulus = quartz["youngs_modulus"] / (1 - quartz["poisson_ratio"] ** 2)
    radius, shift = SIZE["radius"], float(Scene(SIZE).values["yield_displacement"])
    size = {"cylinder_radius": radius, "plane_strain_modulus": modulus}
    a = float(unloaded_half_width(work_of_adhesion=2 * quartz["surface_energy"], **size))
    size["load_constant"] = 0.0

    def strip(position: Any, width: float, shift: float = 0.0) -> Any:
        given = {"position_in_strip": position, "contact_half_width": width, "yield_displacement": shift}
        return asymmetric_pressure(**given, **size)

    centred, shifted = across(-a, a), across(-a - shift, a - shift)
    symmetric = Curve("exact, Eq (56)", centred, strip(centred, a))
    exact = Curve("exact, Eq (64)", shifted, strip(shifted + shift, a, shift))
    curves = [exact, *_halves("half-strip", a, shift, strip)]
    of_shifted = {"contact_half_width": a, "yield_displacement": shift, **size}
    moments = contact_point_moment(**of_shifted), half_strips_moment(**of_shifted)
    shifted_by = amount("yield_displacement", shift)
    caption = (
        f"Quartz cylinder of 20 nm on a rigid plane without load (⟦C = 0⟧), shifted by ⟦ξ⟧ = {shifted_by}.",
        "Exact: Eq (64). Half-strips: two halves of symmetric strips, Eq (71).",
    )
    remarks = (
        f"Griffith's criterion gives ⟦a⟧ = {amount('contact_radius', a)}.",
        "The half-strips are not continuous at ⟦x = 0⟧.",
        f"Moment per length about the contact point: exact {moments[0]:.3g} N, Eq (70) with its sign corrected.",
        f"Half-strips {moments[1]:.3g} N, Eq (77): lower by {moments[0] / moments[1]:.3f}, ⟦π/2⟧ where ⟦ξ⟧ ≪ ⟦a⟧.",
    )
    highest = modulus * a / (2 * radius)
    panels = (pressure_panel([symmetric], highest, "symmetric"), pressure_panel(curves, highest, "shifted by ⟦ξ⟧"))
    return Picture("Fig. 9: the line contact", panels, caption, remarks)


# --- The pull-off force by each law -----------------------------------------------------------------------------------

_TABOR = Axis("tabor_parameter", 1e-2, 1e2, size=POINTS)
_RATIO = Axis("pull_off_force_ratio", 1.45, 2.05, is_log=False)
_LENNARD_JONES = Axis("tabor_parameter", 0.01, 2.0, size=POINTS)  # the range of its fit
_UNIT = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0}  # in which forces are those over πwR


def figure_laws(materials: Materials, marks: Sequence[str]) -> Picture:
    """Return the pull-off force over πwR against μ by JKR, DMT, Maugis and Lennard-Jones, with grains as marks."""
    tabor, near = _TABOR.values(), _LENNARD_JONES.values()
    of_law = {"transition_parameter": transition_parameter(tabor_parameter=tabor)}
    maugis = pull_off_force_maugis(edge_ratio_at_pull_off=edge_ratio_at_pull_off(**of_law), **of_law, **_UNIT)
    ends = numpy.array([_TABOR.low, _TABOR.high])
    curves = (
        Curve("Maugis–Dugdale", tabor, maugis, 0),
        Curve("Lennard-Jones", near, pull_off_force_lennard_jones(tabor_parameter=near, **_UNIT), 1),
        Curve("DMT", ends, numpy.array([2.0, 2.0]), 2),
        Curve("JKR", ends, numpy.array([1.5, 1.5]), 3),
    )
    points = tuple(mark_at(text, materials, Scene({}, model="maugis"), _TABOR, _RATIO) for text in marks)
    spacing = amount("atomic_spacing", DEFAULTS["atomic_spacing"])
    fit = "Lennard-Jones' by a fit to numerical solutions, within 0.3 % for ⟦0.01 ≤ μ ≤ 2⟧"
    caption = (
        f"Pull-off force over ⟦πwR⟧ by each law; {fit}.",
        *((f"Grains at Maugis–Dugdale with ⟦z0⟧ = {spacing}: ⟦μ⟧ falls as ⟦1/z0⟧.",) if points else ()),
    )
    return Picture("", (Panel(_TABOR, _RATIO, curves, points),), caption)


# --- All of them ------------------------------------------------------------------------------------------------------

# Figures of curves.
PROFILES: Mapping[str, Callable[[Materials, Sequence[str]], Picture]] = {
    "2": figure_2,
    "9": figure_9,
    "laws": figure_laws,
}
FIGURE_NAMES = tuple(sorted({*PAPER_MAPS, *PROFILES}))


def options_of(name: str) -> Sequence[str]:
    """Return the options that a figure takes."""
    if name in PROFILES:
        return ("--mark",) if name == "laws" else ()
    return ("--mark", "--plain", "--as-printed") if PAPER_MAPS[name].printed else ("--mark", "--plain")
