"""Draw maps and curves on a pair of matplotlib's axes. Both axes run from 0 to 1, so that contours of powers are straight."""

from typing import Any

from .axes import Axis
from .maps import NEIGHBOURS, Map, Mark, Mesh, Region, shifted
from .mathtext import typeset, typeset_lines
from .panels import Curve, Panel
from .styles import BORDERS, DASHES, HATCHES, LABEL, LETTER, SHADE, SMALL, Style

CONTOURS, PRINTED, OUTLINE = "contours", "printed", "outline"  # the artists that `labels` looks for, by their gid


def draw_map(axes: Any, drawn: Map, inches: float, aspect: float, style: Style) -> None:
    """Draw bands, contours, regions and what is marked on the edges; texts inside the map follow in `labels`."""
    import numpy

    mesh = (
        drawn.mesh()
        if drawn.has_gaps
        else Mesh(drawn.x.place(drawn.x.values()), drawn.y.place(drawn.y.values()), drawn.values)
    )
    scale = numpy.ma.log10 if drawn.is_log else numpy.ma.asarray
    heights = [float(scale(level.value)) for level in drawn.levels()]
    values = scale(numpy.ma.masked_invalid(mesh.values))
    ends = [values.min() - 1, values.max() + 1]
    colours = [style.band(place / max(1, len(heights))) for place in range(len(heights) + 1)]
    axes.contourf(mesh.x, mesh.y, values, levels=[ends[0], *heights, ends[1]], colors=colours)
    edge = None
    if drawn.has_gaps:
        outline = axes.contourf(mesh.x, mesh.y, values, levels=ends, colors="none")
        outline.set_gid(OUTLINE)
        edge = outline.get_paths()[0]
        _draw_edge(axes, edge, style)
    if heights:
        axes.contour(
            mesh.x, mesh.y, values, levels=heights, colors=style.ink, linewidths=0.7, linestyles="solid"
        ).set_gid(CONTOURS)
        if drawn.printed is not None:
            axes.contour(
                mesh.x,
                mesh.y,
                scale(drawn.printed),
                levels=heights,
                colors=style.ink,
                linewidths=0.6,
                linestyles="dashed",
            ).set_gid(PRINTED)
    for place, region in enumerate(drawn.regions):
        if region.kind != "everywhere":
            _draw_region(axes, region, HATCHES[place % len(HATCHES)], style, edge)
    for guide in drawn.guides:
        axes.axhline(drawn.y.place(guide.y), color=style.ink, linewidth=0.6, linestyle=(0, (1, 2)))
    for mark in (*drawn.guides, *drawn.marks):
        _draw_tick(axes, drawn.x, drawn.y, mark, style)
    _set_axes(axes, drawn.x, drawn.y, inches, aspect)


def draw_panel(axes: Any, panel: Panel, inches: float, aspect: float, style: Style) -> None:
    """Draw curves, which differ in colour and in their dashes."""
    for number, curve in enumerate(panel.curves):
        axes.plot(panel.x.place(curve.x), panel.y.place(curve.y), **line_of(curve, number, style))
    for mark in panel.points:
        _draw_tick(axes, panel.x, panel.y, mark, style)
    _set_axes(axes, panel.x, panel.y, inches, aspect)


def line_of(curve: Curve, number: int, style: Style) -> dict[str, Any]:
    """Return the look of the curve of a number, as matplotlib takes it."""
    turn = number // len(DASHES)  # after which the colours come again, with other dashes
    dashes = "--" if curve.is_dashed else DASHES[(number + turn) % len(DASHES)]
    return {"color": style.line(curve.colour), "linestyle": dashes, "linewidth": 1.1}


def _draw_edge(axes: Any, outline: Any, style: Style) -> None:
    """Draw the outline of the part with values, except along the frame."""
    import numpy

    for polygon in outline.to_polygons():
        is_on_frame = ((polygon < 1e-9) | (polygon > 1 - 1e-9)).any(axis=1)
        is_edge = ~(is_on_frame[:-1] & is_on_frame[1:])
        breaks = numpy.full(is_edge.sum(), numpy.nan)
        x, y = (numpy.column_stack([part[:-1][is_edge], part[1:][is_edge], breaks]).ravel() for part in polygon.T)
        axes.plot(x, y, color=style.ink, linewidth=0.8, solid_capstyle="round")


def _draw_region(axes: Any, region: Region, hatch: str, style: Style, edge: Any) -> None:
    """Draw a region hatched or shaded, with its border, or the border alone; nothing beyond the edge of the map's values."""
    x, y = region.x.place(region.x.values()), region.y.place(region.y.values())
    margin = _grown(region.margin)
    parts = [axes.contour(x, y, margin, levels=[0], colors=style.ink, **BORDERS[region.kind])]
    if region.kind != "border":
        is_shaded = region.kind == "shaded"
        look = {"colors": [style.ink], "alpha": SHADE} if is_shaded else {"colors": "none", "hatches": [hatch]}
        parts.append(axes.contourf(x, y, margin, levels=[float(margin.min()) - 1, 0], **look))
    if edge is not None:
        for part in parts:
            part.set_clip_path(edge, axes.transData)


def _grown(margin: Any) -> Any:
    """Return a margin continued by one point into its gaps, so that a region reaches the edge at which it is cut."""
    import numpy

    grown = numpy.array(margin)
    for step in 2 * NEIGHBOURS:
        grown = numpy.where(numpy.isnan(grown) & shifted(~numpy.isnan(grown), step), shifted(grown, step), grown)
    return numpy.ma.masked_invalid(grown)


def _draw_tick(axes: Any, x: Axis, y: Axis, mark: Mark, style: Style) -> None:
    """Draw a mark that has a place on one axis only: a tick on the upper or the right edge, with its text."""
    if mark.x is not None and mark.y is None:
        at = float(x.place(mark.x)), 1.0
        axes.plot(*at, "|", markersize=6, color=style.ink, clip_on=False)
        look: dict[str, Any] = {"xytext": (0, 4), "rotation": 35, "rotation_mode": "anchor"}
    elif mark.y is not None and mark.x is None:
        at = 1.0, float(y.place(mark.y))
        axes.plot(*at, "_", markersize=6, color=style.ink, clip_on=False)
        look = {"xytext": (5, 0), "va": "center"}
    else:
        return
    axes.annotate(typeset(mark.text), at, textcoords="offset points", fontsize=SMALL, **look)


def _set_axes(axes: Any, x: Axis, y: Axis, inches: float, aspect: float) -> None:
    """Set limits, and as many ticks and as long titles as there is room for."""
    across = max(2, int(inches / 0.6))
    for axis, side, most, part in ((x, axes.xaxis, across, 0.8), (y, axes.yaxis, 9, 0.65 * aspect)):
        ticks = axis.ticks(most)
        side.set_ticks([float(axis.place(tick.value)) for tick in ticks], labels=[typeset(tick.text) for tick in ticks])
        side.set_ticks([float(axis.place(value)) for value in axis.small_ticks()], minor=True)
        side.set_label_text("\n".join(typeset_lines(axis.label(most), int(part * inches * 72 / (LETTER * LABEL)))))
    axes.tick_params(which="both", direction="in", top=False, right=False)
    axes.set(xlim=(0, 1), ylim=(0, 1))
