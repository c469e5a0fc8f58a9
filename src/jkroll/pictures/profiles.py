"""Figs. 2 and 9: the shifted contact in three and two dimensions."""

from ..materials.library import Materials
from ..physics.cylinder import asymmetric_pressure, contact_point_moment, half_strips_moment, symmetric_pressure
from ..physics.pressure import pressure
from ..physics.shifted import exact_pressure, half_circle_pressure, unloaded_half_width
from ..quantities.formatting import amount
from ..scene.scene import Scene
from .axes import Axis
from .contact_curves import POINTS, STATE, across, pressure_panel
from .maps import Mark, solved
from .panels import Curve, Panel, Picture

SIZE = {"radius": 2e-8}  # of the spheres of Fig. 2, small enough that ξ is visible


def figure_2(materials: Materials) -> Picture:
    """Return Fig. 2: the shifted contact from above with its half-circles, and its pressure, exact and simplified."""
    import numpy

    scene = Scene(SIZE, materials["quartz"])
    names = (*STATE, "contact_modulus", "reduced_radius", "approach_at_load", "yield_moment", "half_circles_moment")
    state = solved(scene, names, {})
    shift = float(scene.values["yield_displacement"])
    a = state["contact_radius_at_load"]
    angle = numpy.linspace(-numpy.pi, numpy.pi, POINTS)
    outlines = [Curve("contact, shifted by ξ", a * numpy.cos(angle) - shift, a * numpy.sin(angle), 0)]
    half = numpy.linspace(numpy.pi / 2, 3 * numpy.pi / 2, POINTS)
    outlines += [
        Curve("half-circle a + ξ", (a + shift) * numpy.cos(half), (a + shift) * numpy.sin(half), 1, is_dashed=True),
        Curve("half-circle a − ξ", -(a - shift) * numpy.cos(half), (a - shift) * numpy.sin(half), 2, is_dashed=True),
    ]
    reach = 1.5 * (a + shift)
    view = Panel(
        Axis("position_across", -reach, reach, is_log=False), Axis("position_beside", -reach, reach, is_log=False),
        tuple(outlines), (Mark("contact point", 0.0, 0.0),), "from above, rolling to the right", is_true_to_scale=True,
    )  # fmt: skip
    given = {"contact_modulus": state["contact_modulus"], "reduced_radius": state["reduced_radius"]}
    parts = {name: state[name] for name in STATE}
    centred, shifted = across(-a, a), across(-a - shift, a - shift)
    left, right = across(-a - shift, 0.0), across(0.0, a - shift)
    at = {"approach_at_load": state["approach_at_load"], **given}
    curves = [
        Curve("exact", shifted, exact_pressure(position_in_circle=shifted + shift, yield_displacement=shift, **parts, **given), 0),
        Curve("half-circle a + ξ", left, half_circle_pressure(distance=-left, half_circle_radius=a + shift, **at), 1, is_dashed=True),
        Curve("half-circle a − ξ", right, half_circle_pressure(distance=right, half_circle_radius=a - shift, **at), 2, is_dashed=True),
        Curve("not shifted", centred, pressure(distance=abs(centred), **parts), 3),
    ]  # fmt: skip
    along = pressure_panel(curves, state["hertz_pressure"], "pressure along the way")
    exact, simple = (amount(name, state[name]) for name in ("yield_moment", "half_circles_moment"))
    caption = (
        "The contact of two quartz spheres of 20 nm that have rolled by ξ: the circle stays behind the contact point.",
        (
            "Exact: Hertz, flat punch and tilted flat punch on one circle at a fixed load. Half-circles: Eq (16) at a fixed approach, "
            "not continuous at x = 0. Ahead the pull at the rim is weaker, behind it is stronger."
        ),
        f"Moment: exact {exact}, Eq (25); half-circles {simple}, Eq (19).",
        f"Assumed: P = 0, ξ = {amount('yield_displacement', shift)}.",
    )
    return Picture("Fig. 2: the shifted contact", (view, along), caption)


def figure_9(materials: Materials) -> Picture:
    """Return Fig. 9: the pressure of a cylinder on a rigid plane, symmetric and shifted, exact and simplified."""
    quartz = materials["quartz"].properties
    modulus = quartz["youngs_modulus"] / (1 - quartz["poisson_ratio"] ** 2)
    radius = SIZE["radius"]
    size = {"cylinder_radius": radius, "plane_strain_modulus": modulus}
    a = unloaded_half_width(work_of_adhesion=2 * quartz["surface_energy"], **size)
    shift = float(Scene(SIZE).values["yield_displacement"])
    size["load_constant"] = 0.0
    centred, shifted = across(-a, a), across(-a - shift, a - shift)
    left, right = across(-a - shift, 0.0), across(0.0, a - shift)
    exact = asymmetric_pressure(
        position_in_strip=shifted + shift, contact_half_width=a, yield_displacement=shift, **size
    )
    behind = symmetric_pressure(position=left, contact_half_width=a + shift, **size)
    ahead = symmetric_pressure(position=right, contact_half_width=a - shift, **size)
    highest = modulus * a / (2 * radius)
    symmetric = Curve("exact, Eq (56)", centred, symmetric_pressure(position=centred, contact_half_width=a, **size))
    curves = [
        Curve("exact, Eq (64)", shifted, exact),
        Curve("half-strip a + ξ", left, behind, 1, is_dashed=True),
        Curve("half-strip a − ξ", right, ahead, 2, is_dashed=True),
    ]
    moments = [
        moment(contact_half_width=a, yield_displacement=shift, **size)
        for moment in (contact_point_moment, half_strips_moment)
    ]
    caption = (
        (
            "The line contact of a quartz cylinder of 20 nm on a rigid plane, without load (C = 0), where Griffith's criterion gives "
            f"a = {amount('contact_radius', a)}."
        ),
        "Shifted by ξ, exact by Eq (64); simplified by two halves of symmetric strips, Eq (71), not continuous at x = 0.",
        (
            f"Moment per length about the contact point: exact {moments[0]:.3g} N, Eq (70) with its sign corrected; "
            f"half-strips {moments[1]:.3g} N, Eq (77): lower by {moments[0] / moments[1]:.3f}, π/2 where ξ ≪ a."
        ),
        f"Assumed: ξ = {amount('yield_displacement', shift)}.",
    )
    panels = (pressure_panel([symmetric], highest, "symmetric"), pressure_panel(curves, highest, "shifted by ξ"))
    return Picture("Fig. 9: the line contact", panels, caption)


PROFILES = {"2": figure_2, "9": figure_9}  # figures of the paper
