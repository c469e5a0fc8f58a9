"""Declarations of the paper's maps: Figs. 3, 6 and 8. Figs. 2 and 9 are in `profiles`; the others carry no data."""

from collections.abc import Collection, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from ..answers.results import equation_of
from ..materials.library import Materials
from ..physics.shifted import rolled_over_displacement
from ..quantities.formatting import amount
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.scene import DEFAULTS, Scene
from ..scene.wiring import depends_on
from ..text import capitalized
from .axes import Axis
from .maps import Bound, Map, Mark, Region, bounds, evaluate, label_of, material_marks, regions


class Figure(NamedTuple):
    """A map of the paper: its quantity, its axes, what it assumes, and what the paper's text reads off it."""

    quantity: str
    x: Axis
    given: Mapping[str, float]
    remark: str
    has_log_labels: bool = True
    guide: tuple[float, str] | None = None  # a radius that the text speaks of
    point: tuple[float, float, str] | None = None  # (x, R1) that the text speaks of
    printed: str = ""
    shades_no_rolling: bool = False  # where spheres roll by less than ξ


RADII = Axis("radius", 5e-10, 1e-3)
_ENERGIES = Axis("surface_energy", 1e-3, 1e1)
# E1* = E1/(1 - ν1²) is 10 GPa in Fig. 6a; elsewhere it enters only where the model has no meaning.
_SOFT = {"youngs_modulus": 1e10, "poisson_ratio": 0.0}
_LIGHT = {**_SOFT, "density": 2000.0}

FIGURES: Mapping[str, Figure] = MappingProxyType(
    {
        "3a": Figure("pull_off_force", _ENERGIES, _SOFT, "P_c = 3πγR with R = R1/2: JKR; small, hard spheres tend to 4πγR."),
        "3b": Figure(
            "yield_force_ratio",
            _ENERGIES,
            _SOFT,
            "It does not depend on γ. The forces are equal (contour 0) at R1 = 4ξ = 0.8 nm; the text has 1 nm. There, "
            "as the text warns, elasticity holds no longer.",
            guide=(1e-9, "1 nm"),
        ),
        "3c": Figure(
            "r_min",
            _ENERGIES,
            _SOFT,
            "It does not depend on γ: R1²/ξ. At R1 = 100 nm it is 50 µm (log: −4.3), 500 times the radius.",
            guide=(1e-7, "100 nm"),
        ),
        "3d": Figure(
            "n_grav",
            _ENERGIES,
            _LIGHT,
            "About a thousand (contour 3) spheres of 100 nm stand at γ = 25 mJ/m². A single sphere (contour 0) rolls from "
            "8 µm (polystyrene) to 52 µm (iron) on; the text has about 100 µm.",
            guide=(1e-4, "100 µm"),
            point=(0.025, 1e-7, "1071"),
        ),
        "6a": Figure(
            "vertical_frequency",
            _ENERGIES,
            _LIGHT,
            "GHz (contour 9) at R1 = 35 nm (γ = 1 mJ/m²) to 130 nm (10 J/m²): almost independent of γ, which enters by its power 1/6.",
        ),
        "6b": Figure(
            "rolling_frequency",
            _ENERGIES,
            _LIGHT,
            "Eq (40) as it follows. The paper's curves are Eq (41), 2.5 times lower (0.4 in the logarithm). At R1 = 100 nm and "
            "γ = 100 mJ/m² it is 5.3 times slower than the vertical vibration; the text has one to two orders.",
            printed="rolling_frequency_as_printed",
        ),
        "8": Figure(
            "n_roll",
            Axis("modulus_over_energy", 1e9, 1e13, beside={"surface_energy": 1.0}),  # γ may be any
            {},
            "For W0 = P_cδ0; in general these are n_roll/(W0/P_cδ0). An energy balance gives 7/2 of Eq (49). Below 10 nm, spheres "
            "with E*/γ above 3·10¹² m⁻¹ do not roll; below 100 nm a full turn takes E*/γ below 1.5·10⁹ m⁻¹.",
            has_log_labels=False,
            guide=(1e-8, "10 nm"),
            shades_no_rolling=True,
        ),
    }
)  # fmt: skip


def figure(
    name: str, materials: Materials, size: tuple[int, int], *, as_printed: bool = False, is_plain: bool = False
) -> Map:
    """Return a map of the paper with `size` points across and up. `is_plain`: without the limits of the model."""
    declared = FIGURES[name]
    scene = Scene(declared.given)
    x, y = declared.x._replace(size=size[0]), RADII._replace(size=size[1])
    values = evaluate(scene, declared.quantity, x, y)
    printed = evaluate(scene, declared.printed, x, y) if as_printed and declared.printed else None
    limits = () if is_plain else bounds(declared.quantity)
    shaded = (_no_rolling(scene, values, x, y),) if declared.shades_no_rolling and limits else ()
    marks, others = material_marks(materials, x, y)
    points = (Mark(declared.point[2], *declared.point[:2]),) if declared.point else ()
    return Map(
        declared.quantity,
        scene,
        x,
        y,
        values,
        (*shaded, *regions(scene, limits, x, y, values)),
        (*marks, *points),
        f"Fig. {name}: {label_of(declared.quantity, has_log_labels=declared.has_log_labels)}",
        (*_caption(declared, limits, as_printed=printed is not None), *others),
        declared.has_log_labels,
        printed,
        (Mark(declared.guide[1], None, declared.guide[0]),) if declared.guide else (),
        (declared.remark,),
    )


def _no_rolling(scene: Scene, turns: Any, x: Axis, y: Axis) -> Region:
    """Return the region in which spheres roll by less than ξ, given their turns."""
    import numpy

    shift = scene.values["yield_displacement"]
    rolled = rolled_over_displacement(n_roll=turns, radius=y.values()[:, None], yield_displacement=shift)
    return Region("2πR1 n_roll < ξ: it does not roll", x, y, numpy.log10(rolled), "rolled_over_displacement")


def _caption(declared: Figure, limits: Collection[Bound], *, as_printed: bool) -> tuple[str, ...]:
    """Return the caption: the quantity and its equation, and the assumptions."""
    quantity = NOMENCLATURE[declared.quantity]
    at_a_corner = {RADII.name: RADII.high, **declared.x.inputs(declared.x.low)}
    scene = Scene({**declared.given, **at_a_corner})
    shown = f"{capitalized(quantity.sentence)} {quantity.symbol}, Eq ({equation_of(scene, declared.quantity)})."
    if as_printed:
        shown += f" Dashed: Eq ({NOMENCLATURE[declared.printed].equation}) as printed."
    used = _assumed(scene, declared, {declared.quantity})
    of_limits = _assumed(scene, declared, {bound.name for bound in limits}) if limits else []
    elsewhere = [text for text in of_limits if text not in used]
    parts = [", ".join(["identical spheres", *used]), f"hatches: {', '.join(elsewhere)}" if elsewhere else ""]
    return shown, f"Assumed: {'; '.join(filter(None, parts))}."


def _assumed(scene: Scene, declared: Figure, names: Collection[str]) -> list[str]:
    """Return the assumed inputs of these quantities, as texts."""
    used = {*scene.inputs_of(*names), *(name for name in ("load", "energy_ratio") if name in depends_on(names))}
    texts = []
    for name, value in {**DEFAULTS, **declared.given}.items():
        if name in used and name != "poisson_ratio":
            symbol = "E1/(1 − ν1²)" if name == "youngs_modulus" else NOMENCLATURE[name].symbol
            texts.append(f"{symbol} = {amount(name, value)}")
    return texts
