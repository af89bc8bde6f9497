"""Two cases in one figure. Curves of the second case are dashed and have the hues of the first case's curves."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from app.figures.data import Figure, Hue, Line, Panel, Role, Row

OWN = "this case"


def compared(figure: Figure, variant: Figure, name: str) -> Figure:
    """Add the curves of another case to the figure of a case, and return the combined figure."""
    unsolved = figure.unsolved + variant.unsolved
    if any(panel.map is not None for panel in figure.panels):
        maps = _maps({OWN: figure, name: variant})
        place = "right" if len(maps) == 2 else "below"
        finding = f"{place}: {name} · {figure.finding}"
        return replace(figure, finding=finding, panels=maps, beside=place == "right", unsolved=unsolved)
    others = {_key(panel): panel for panel in variant.panels}
    panels = tuple(_overlaid(panel, others.pop(_key(panel), panel), name) for panel in figure.panels)
    panels += tuple(replace(panel, title=f"{name}: {panel.title or panel.y.title}") for panel in others.values())
    how = "the same in" if panels == tuple(figure.panels) else "dashed:"
    return replace(figure, finding=f"{how} {name} · {figure.finding}", panels=panels, unsolved=unsolved)


def _key(panel: Panel) -> tuple[str, str | None]:
    return panel.y.title, panel.title


def _overlaid(panel: Panel, other: Panel, name: str) -> Panel:
    """Return `panel` with those parts of `other` added that differ from the parts of `panel`."""
    own = {(level.name, level.value) for level in panel.levels}
    levels = (level for level in other.levels if (level.name, level.value) not in own)
    added: dict[str, list[Any]] = {
        "lines": _lines(panel, other, name),
        "bars": _bars(panel, other),
        "rows": _rows(panel, other, name),
        "levels": [replace(level, name=level.name and f"{level.name}, {name}", point=False) for level in levels],
        "marks": [replace(mark, text=name, hue=Hue.VERMILLION) for mark in other.marks if panel.areas],
    }
    if other is panel or not any(added.values()):
        return panel
    both: dict[str, Any] = {part: (*getattr(panel, part), *more) for part, more in added.items()}
    return replace(panel, **both)


def _lines(panel: Panel, other: Panel, name: str) -> list[Line]:
    """Return the curves and edges of `other`, except those that have the same points as a curve or edge of `panel`.

    If a curve of `panel` has the same title as a returned curve, both have the same hue. If no curve of `panel` has
    this title, the name of the other case is added to the title.
    """
    own = [*panel.lines, *_edges(panel)]
    hues = {line.title: line.hue for line in own}
    present = {(line.x.tobytes(), line.y.tobytes()) for line in own}
    return [
        replace(line, role=Role.VARIANT, hue=hues[line.title], named=False)
        if line.title in hues
        else replace(line, role=Role.VARIANT, title=f"{line.title}, {name}")
        for line in (*other.lines, *_edges(other))
        if (line.x.tobytes(), line.y.tobytes()) not in present
    ]


def _edges(panel: Panel) -> Iterator[Line]:
    """Yield the outlines of polygons and the edges of bands as lines."""
    for shape in panel.shapes:
        yield replace(shape, x=np.append(shape.x, shape.x[:1]), y=np.append(shape.y, shape.y[:1]))
    for ribbon in panel.ribbons:
        yield from (Line(ribbon.title, ribbon.x, edge, ribbon.hue) for edge in (ribbon.low, ribbon.high))


def _bars(panel: Panel, other: Panel) -> list[Line]:
    """Return all bars of `other`, or no bars if the bars of both panels are equal.

    If some bars differ, the equal bars are returned too, because the width of a bar depends on the number of bars.
    """
    if [bars.y.tobytes() for bars in panel.bars] == [bars.y.tobytes() for bars in other.bars]:
        return []
    hues = {bars.title: bars.hue for bars in panel.bars}
    return [replace(bars, role=Role.VARIANT, hue=hues.get(bars.title, bars.hue)) for bars in other.bars]


def _rows(panel: Panel, other: Panel, name: str) -> list[Row]:
    """Return the rows of `other` that differ from the rows of `panel`."""
    own_rows, rows = {row.name: row for row in panel.rows}, []
    for row in other.rows:
        own = own_rows.get(row.name)
        if own is None:
            rows.append(replace(row, name=f"{row.name}, {name}"))
        elif repr((own.value, own.parts, own.bounds)) != repr((row.value, row.parts, row.bounds)):  # NaN equals NaN
            rows.append(replace(row, role=Role.VARIANT, hue=own.hue))
    return rows


def _maps(figures: dict[str, Figure]) -> tuple[Panel, ...]:
    """Return the panels with the maps of all cases. All maps have the same scale of colours."""
    panels = [(name, panel) for name, figure in figures.items() for panel in figure.panels]
    ends = [panel.map.ends for _, panel in panels if panel.map is not None]
    common = min(low for low, _ in ends), max(high for _, high in ends)
    return tuple(
        replace(
            panel,
            title=": ".join(filter(None, (name, panel.title))),
            map=replace(panel.map, range=common, bar=place == len(panels)),
        )
        for place, (name, panel) in enumerate(panels, 1)
        if panel.map is not None
    )
