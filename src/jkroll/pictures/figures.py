"""The figures of the paper, and two that are not in it: the pull-off force by each law, and a sketch of the symbols.

The figures of the paper are its maps, and the shifted contact of Figs. 2 and 9. Its other figures, which are sketches,
are left out.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import pi
from typing import Any, NamedTuple

import numpy

from ..errors import BadRequest
from ..materials.library import Materials
from ..model.frame import Frame
from ..model.solver import values_of
from ..physics.any_law import pull_off_force_lennard_jones, transition_parameter
from ..physics.contact import pressure
from ..physics.cylinder import asymmetric_pressure, contact_point_moment, half_strips_moment
from ..physics.maugis import edge_ratio_at_pull_off, pull_off_force_maugis
from ..physics.shifted import exact_pressure, half_circle_pressure, unloaded_half_width
from ..quantities.formatting import amount
from ..quantities.laws import MAUGIS
from ..quantities.markup import symbol
from ..quantities.nomenclature import DEFAULTS, NOMENCLATURE, bracketed
from ..text import quoted
from .contact_curves import POINTS, RADIUS_AND_PRESSURES, across, pressure_panel
from .geometry import sketch
from .maps import HATCHED_LIMITS, MapRequest, mark_at, picture_of
from .picture import Axis, Curve, Mark, Panel, Picture

# --- Maps: Figs. 3, 6 and 8 -------------------------------------------------------------------------------------------

RADII = Axis("radius", 5e-10, 1e-3)
_ENERGIES = Axis("surface_energy", 1e-3, 1e1)
# E1* = E1/(1 - ν1²) is 10 GPa in Fig. 6a; in Figs. 3 and 6b it affects only the limits of the model.
_SOFT = {"youngs_modulus": 1e10, "poisson_ratio": 0.0}
_LIGHT = {**_SOFT, "density": 2000.0}


class PaperMap(NamedTuple):
    """A map of the paper over R1: its quantity, the remark below it, its other axis, and its fixed inputs."""

    quantity: str
    remark: str
    x: Axis = _ENERGIES
    given: Mapping[str, float] = _SOFT
    printed: str = ""  # the quantity as the paper prints it, if that differs


PAPER_MAPS: Mapping[str, PaperMap] = {
    "3a": PaperMap(
        "pull_off_force",
        "JKR gives ⟦P_c = 3πγR⟧ with ⟦R = R1/2⟧; for small, hard spheres the force tends to ⟦4πγR⟧.",
    ),
    "3b": PaperMap(
        "yield_force_ratio",
        "The ratio does not depend on ⟦γ⟧. The forces are equal (contour 1) at ⟦R1 = 4ξ⟧ = 0.8 nm; the paper has 1 nm. "
        "As the paper warns, elasticity no longer holds there.",
    ),
    "3c": PaperMap(
        "r_min",
        "The radius ⟦r_min = R1²/ξ⟧ does not depend on ⟦γ⟧. At ⟦R1⟧ = 100 nm it is 50 µm, 500 times as large.",
    ),
    "3d": PaperMap(
        "n_grav",
        "At ⟦γ⟧ = 25 mJ/m², a level chain of about a thousand spheres of 100 nm holds. A single sphere (contour 1) "
        "rolls down if it is larger than 8 µm (polystyrene) to 52 µm (iron); the paper has about 100 µm.",
        given=_LIGHT,
    ),
    "6a": PaperMap(
        "vertical_frequency",
        "The frequency is 1 GHz at ⟦R1⟧ = 35 nm (⟦γ⟧ = 1 mJ/m²) to 130 nm (10 J/m²): it hardly depends on ⟦γ⟧, "
        "which enters with the power 1/6.",
        given=_LIGHT,
    ),
    "6b": PaperMap(
        "rolling_frequency",
        "The contours are Eq (40); the paper's curves are Eq (41), 2.5 times lower. At ⟦R1⟧ = 100 nm and ⟦γ⟧ = 100 "
        "mJ/m², rolling is 5.3 times slower than the normal vibration; the paper has one to two orders of magnitude.",
        given=_LIGHT,
        printed="rolling_frequency_as_printed",
    ),
    "8": PaperMap(
        "n_roll",
        "The energy is ⟦W0 = P_cδ0⟧; for another, multiply n_roll by ⟦W0/P_cδ0⟧. An energy balance gives 7/2 "
        "of Eq (49). Spheres below 10 nm do not roll if ⟦E*/γ⟧ is above 9·10¹¹ m⁻¹; spheres below 100 nm roll a full "
        "turn only if it is below 1.5·10⁹ m⁻¹.",
        x=Axis("modulus_over_energy", 1e9, 1e13, needs={"surface_energy": 1.0}),  # only E*/γ affects the result
        given={},
    ),
}


def paper_map(
    name: str, materials: Materials, marks: Sequence[str] = (), *, as_printed: bool = False, is_plain: bool = False
) -> Picture:
    """Return a map of the paper with marked grains. `is_plain`: True to leave out the limits of the model."""
    declared = PAPER_MAPS[name]
    frames = (("", Frame(declared.given)),)
    printed = declared.printed if as_printed else ""
    limits = () if is_plain else HATCHED_LIMITS
    drawn, _ = picture_of(
        MapRequest(declared.quantity, declared.x, RADII, frames, marks, materials, limits, printed, has_best=False)
    )
    (panel,) = drawn.panels
    assert panel.field is not None
    _, unit = panel.field.in_words([])
    title = f"Fig. {name}: {symbol(declared.quantity)}{bracketed(unit)}"
    remarks = (*drawn.remarks, declared.remark)
    caption = [*drawn.caption]
    if printed:
        caption.append(f"Dashed in files: Eq ({NOMENCLATURE[printed].equation}), each below its contour.")
    return Picture(title, drawn.panels, tuple(caption), drawn.doubts, remarks)


# --- Figs. 2 and 9: the shifted contact in three and two dimensions ---------------------------------------------------

SPHERES = {"radius": 2e-8}  # of the spheres in Fig. 2 and the cylinder in Fig. 9; so small that ξ is visible


def figure_2(materials: Materials) -> Picture:
    """Return Fig. 2: the shifted contact from above with its half-circles, and its exact and simplified pressure."""
    frame = Frame(SPHERES, materials["quartz"])
    moduli = ("contact_modulus", "reduced_radius")
    moments = ("yield_moment", "half_circles_moment")
    state = values_of(frame, (*RADIUS_AND_PRESSURES, *moduli, *moments, "approach_at_load"))
    pair = {name: state[name] for name in moduli}
    circle = {name: state[name] for name in RADIUS_AND_PRESSURES}
    a, shift = state["contact_radius_at_load"], float(frame["yield_displacement"])
    angle = numpy.linspace(-numpy.pi, numpy.pi, POINTS)
    behind = angle / 2 + numpy.pi  # the angles of the half behind the contact point
    outlines = (
        Curve("contact, shifted by ⟦ξ⟧", a * numpy.cos(angle) - shift, a * numpy.sin(angle), 0),
        Curve("half-circle ⟦a + ξ⟧", (a + shift) * numpy.cos(behind), (a + shift) * numpy.sin(behind), 1),
        Curve("half-circle ⟦a − ξ⟧", -(a - shift) * numpy.cos(behind), (a - shift) * numpy.sin(behind), 2),
    )
    reach = 1.5 * (a + shift)
    x, y = (Axis(name, -reach, reach, is_log=False) for name in ("position_across", "position_beside"))
    point = Mark("contact point", 0.0, 0.0)
    view = Panel(x, y, outlines, (point,), "from above, rolling to the right", is_true_to_scale=True)

    def half_circle(position: Any, radius: float) -> Any:
        given = {"distance": abs(position), "approach_at_load": state["approach_at_load"]}
        return half_circle_pressure(half_circle_radius=radius, **given, **pair)

    centred, shifted = across(-a, a), across(-a - shift, a - shift)
    exact = exact_pressure(position_in_circle=shifted + shift, yield_displacement=shift, **circle, **pair)
    curves = [
        Curve("exact", shifted, exact),
        *_halves("half-circle", a, shift, half_circle),
        Curve("not shifted", centred, pressure(distance=abs(centred), **circle), 3),
    ]
    along = pressure_panel(curves, state["hertz_pressure"], "pressure along the rolling direction")
    moment, half_circles = (amount(name, state[name]) for name in moments)
    caption = (
        f"Two quartz spheres of 20 nm that have rolled by ⟦ξ⟧ = {amount('yield_displacement', shift)}, without load.",
        f"Moment: exact {moment}, Eq (25); half-circles {half_circles}, Eq (19).",
    )
    remarks = (
        "The circle lags behind the contact point. The pull at its rim is weaker ahead and stronger behind.",
        "Exact: Hertz, flat punch and tilted flat punch on one circle at a fixed load.",
        "Half-circles: Eq (16) at a fixed approach, not continuous at ⟦x = 0⟧.",
    )
    return Picture("Fig. 2: the shifted contact", (view, along), caption, remarks=remarks)


def _halves(word: str, a: float, shift: float, pressure_of: Callable[[Any, float], Any]) -> Iterator[Curve]:
    """Iterate over the pressures behind and ahead of the contact point, each from half of a symmetric contact.

    `pressure_of` returns the pressure at positions, given half the width of the symmetric contact.
    """
    behind, ahead = across(-a - shift, 0.0), across(0.0, a - shift)
    yield Curve(f"{word} ⟦a + ξ⟧", behind, pressure_of(behind, a + shift), 1)
    yield Curve(f"{word} ⟦a − ξ⟧", ahead, pressure_of(ahead, a - shift), 2)


def figure_9(materials: Materials) -> Picture:
    """Return Fig. 9: the pressure of a cylinder on a rigid plane, symmetric and shifted, exact and simplified."""
    quartz = materials["quartz"].properties
    modulus = quartz["youngs_modulus"] / (1 - quartz["poisson_ratio"] ** 2)
    radius, shift = SPHERES["radius"], float(Frame(SPHERES).values["yield_displacement"])
    cylinder = {"cylinder_radius": radius, "plane_strain_modulus": modulus}
    a = float(unloaded_half_width(work_of_adhesion=2 * quartz["surface_energy"], **cylinder))
    cylinder["load_constant"] = 0.0

    def strip(position: Any, width: float, shift: float = 0.0) -> Any:
        given = {"position_in_strip": position, "contact_half_width": width, "yield_displacement": shift}
        return asymmetric_pressure(**given, **cylinder)

    centred, shifted = across(-a, a), across(-a - shift, a - shift)
    symmetric = Curve("exact, Eq (56)", centred, strip(centred, a))
    exact = Curve("exact, Eq (64)", shifted, strip(shifted + shift, a, shift))
    curves = [exact, *_halves("half-strip", a, shift, strip)]
    shifted_strip = {"contact_half_width": a, "yield_displacement": shift, **cylinder}
    exact_moment, half_strips = contact_point_moment(**shifted_strip), half_strips_moment(**shifted_strip)
    shifted_by = amount("yield_displacement", shift)
    ratio = f"{exact_moment / half_strips:.3f}"
    caption = (
        f"Quartz cylinder of 20 nm on a rigid plane without load (⟦C = 0⟧), shifted by ⟦ξ⟧ = {shifted_by}.",
        "Exact: Eq (64). Half-strips: two halves of symmetric strips, Eq (71).",
    )
    remarks = (
        f"Griffith's criterion gives ⟦a⟧ = {amount('contact_radius', a)}.",
        "The half-strips are not continuous at ⟦x = 0⟧.",
        f"Moment per length about the contact point: exact {exact_moment:.3g} N, Eq (70) with its sign corrected.",
        f"Half-strips {half_strips:.3g} N, Eq (77): lower by a factor of {ratio}, which tends to ⟦π/2⟧ for ⟦ξ⟧ ≪ ⟦a⟧.",
    )
    central = modulus * a / (2 * radius)
    panels = (pressure_panel([symmetric], central, "symmetric"), pressure_panel(curves, central, "shifted by ⟦ξ⟧"))
    return Picture("Fig. 9: the line contact", panels, caption, remarks=remarks)


# --- The pull-off force by each law -----------------------------------------------------------------------------------

_TABOR = Axis("tabor_parameter", 1e-2, 1e2, size=POINTS)
_RATIO = Axis("pull_off_force_ratio", 1.45, 2.05, is_log=False)
_LENNARD_JONES = Axis("tabor_parameter", 0.01, 2.0, size=POINTS)  # range of the fit
_UNIT = {"work_of_adhesion": 1 / pi, "reduced_radius": 1.0}  # forces are then relative to πwR


def figure_laws(materials: Materials, marks: Sequence[str]) -> Picture:
    """Return the figure of the pull-off force over πwR against Tabor's μ, by four laws, with marked grains."""
    tabor, near = _TABOR.values(), _LENNARD_JONES.values()
    transition = {"transition_parameter": transition_parameter(tabor_parameter=tabor)}
    ratio = edge_ratio_at_pull_off(**transition)
    maugis = pull_off_force_maugis(edge_ratio_at_pull_off=ratio, **transition, **_UNIT)
    ends = numpy.array([_TABOR.low, _TABOR.high])
    curves = (
        Curve("Maugis–Dugdale", tabor, maugis, 0),
        Curve("Lennard-Jones", near, pull_off_force_lennard_jones(tabor_parameter=near, **_UNIT), 1),
        Curve("DMT", ends, numpy.array([2.0, 2.0]), 2),
        Curve("JKR", ends, numpy.array([1.5, 1.5]), 3),
    )
    points = tuple(mark_at(text, materials, Frame({}, model=MAUGIS), _TABOR, _RATIO) for text in marks)
    fit = "the Lennard-Jones curve is a fit to numerical solutions, within 0.3 % for ⟦0.01 ≤ μ ≤ 2⟧"
    caption = [f"Pull-off force over ⟦πwR⟧ by each law; {fit}."]
    if points:
        spacing = amount("atomic_spacing", DEFAULTS["atomic_spacing"])
        caption.append(f"Grains are on the Maugis–Dugdale curve for ⟦z0⟧ = {spacing}; ⟦μ⟧ falls as ⟦1/z0⟧.")
    return Picture("", (Panel(_TABOR, _RATIO, curves, points),), tuple(caption))


# --- The names of all figures -----------------------------------------------------------------------------------------

PROFILES: Mapping[str, Callable[[Materials], Picture]] = {"2": figure_2, "9": figure_9}  # take no marks
FIGURE_NAMES = (*sorted({*PAPER_MAPS, *PROFILES}), "laws", "geometry")


def check_figure(name: str, given: Mapping[str, object]) -> None:
    """Raise BadRequest for a name that no figure has, or an argument that does not apply to the figure.

    `given`: arguments by name, as in `jkroll.figure`, or by option; those that are false were not given.
    """
    if name not in FIGURE_NAMES:
        mistake = f"{quoted(name)} is not a figure" if name else "figure needs a name"
        raise BadRequest(f"{mistake}; choose one of {', '.join(FIGURE_NAMES)}")
    idle = set[str]()
    if name in PROFILES or name == "geometry":
        idle |= {"--mark", "marks"}
    if name == "geometry":
        idle.add("--data")
    if name not in PAPER_MAPS:
        idle.add("--plain")
    if name not in PAPER_MAPS or not PAPER_MAPS[name].printed:
        idle |= {"--as-printed", "as_printed"}
    for argument, value in given.items():
        if value and argument in idle:
            raise BadRequest(f"figure {name} takes no {argument}")


def figure_named(
    name: str, materials: Materials, marks: Sequence[str] = (), *, as_printed: bool = False, is_plain: bool = False
) -> Picture:
    """Return a figure by its name, with marked grains; `is_plain`: see `paper_map`."""
    if name in PAPER_MAPS:
        return paper_map(name, materials, marks, as_printed=as_printed, is_plain=is_plain)
    if name in PROFILES:
        return PROFILES[name](materials)
    return sketch() if name == "geometry" else figure_laws(materials, marks)
