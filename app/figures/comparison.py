"""Two cases in one figure: the second is dashed in the hues of the first."""

from collections.abc import Iterable
from dataclasses import replace
from typing import TypeVar

from app.figures.data import Bars, Figure, Hue, Line, Panel, Role, Row

Series = TypeVar("Series", Line, Bars)


def compared(figure: Figure, variant: Figure, name: str) -> Figure:
    """The figure with the results of the same figure of another case; maps stand beside each other."""
    finding = f"dashed: {name} · {figure.finding}"
    if any(panel.map is not None for panel in figure.panels):
        return replace(
            figure, finding=f"right: {name} · {figure.finding}", panels=_maps(figure, variant, name), beside=True
        )
    others = {_key(panel): panel for panel in variant.panels}
    panels = tuple(_overlaid(panel, others.get(_key(panel)), name) for panel in figure.panels)
    return replace(figure, finding=finding, panels=panels, unsolved=figure.unsolved + variant.unsolved)


def _key(panel: Panel) -> tuple[str, str | None]:
    return panel.y.title, panel.title


def _overlaid(panel: Panel, other: Panel | None, name: str) -> Panel:
    """The panel with lines, bars and rows of the other that have the names of its own, and its point on a plane."""
    if other is None:
        return panel
    return replace(
        panel,
        lines=(*panel.lines, *_variants(panel.lines, other.lines)),
        bars=(*panel.bars, *_variants(panel.bars, other.bars)),
        rows=(*panel.rows, *_variant_rows(panel.rows, other.rows)),
        marks=(*panel.marks, *(replace(mark, text=name, hue=Hue.VERMILLION) for mark in other.marks if panel.areas)),
    )


def _variants(own: Iterable[Series], others: Iterable[Series]) -> tuple[Series, ...]:
    hues = {each.title: each.hue for each in own if each.role is Role.RESULT}
    return tuple(replace(each, role=Role.VARIANT, hue=hues[each.title]) for each in others if each.title in hues)


def _variant_rows(own: Iterable[Row], others: Iterable[Row]) -> tuple[Row, ...]:
    hues = {row.name: row.hue for row in own}
    return tuple(replace(row, role=Role.VARIANT, hue=hues[row.name]) for row in others if row.name in hues)


def _maps(figure: Figure, variant: Figure, name: str) -> tuple[Panel, ...]:
    """First map of both cases in the same colours."""
    panels = []
    pairs = ((figure, "this case"), (variant, name))
    charts = [panel.map for each, _ in pairs for panel in each.panels[:1] if panel.map is not None]
    known = [chart.range for chart in charts if chart.range is not None]
    common = (min(low for low, _ in known), max(high for _, high in known)) if known else None
    for each, title in pairs:
        panel = each.panels[0]
        assert panel.map is not None
        chart = replace(panel.map, range=common, bar=each is variant)
        panels.append(replace(panel, title=title, map=chart))
    return tuple(panels)
