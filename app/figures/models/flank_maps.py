"""Figures of the flank: load, pressure and modification over profile and face."""

import numpy as np

from app.figures.data import Axis, Figure, Map, Mark, Panel, Scale, Values, matrix, values
from app.figures.declaration import Declaration, present
from app.figures.wording import number, percent
from app.requests.load_distribution import LoadDistributionRequest
from app.responses.load_distribution import FlankFields, FlankPlace, LoadDistributionResponse

FIFTHS = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
FACE = Axis("face (0: end that meshes first)", limits=(0.0, 1.0), ticks=FIFTHS)
PROFILE = Axis("profile (0: A, 1: E)", limits=(0.0, 1.0), ticks=FIFTHS)


def flank_load(_: LoadDistributionRequest, answer: LoadDistributionResponse) -> Figure:
    """Line load over the flank, its maximum over all roll positions marked."""
    load, flank = present(answer.load), present(answer.flank)
    panel = _panel(
        flank, "line load", "N/mm", matrix(flank.line_load_n_per_mm), load.max_at, load.max_line_load_n_per_mm
    )
    factor = load.face_load_factor
    face = "" if factor is None else f", K_Hβ = {number(factor)}"
    carrying = f"{percent(load.contact_fraction)} of the flank carries"
    finding = f"highest {number(load.max_line_load_n_per_mm, 'N/mm')}{face}; {carrying}"
    return Figure(finding if load.max_at else "no load", (panel,))


def flank_pressure(_: LoadDistributionRequest, answer: LoadDistributionResponse) -> Figure:
    """Hertz pressure over the flank, its maximum over all roll positions marked."""
    pressure, flank = present(answer.pressure), present(answer.flank)
    grid = matrix(flank.pressure_mpa)
    panel = _panel(flank, "Hertz pressure", "MPa", grid, pressure.max_at, pressure.max_mpa)
    finding = (
        f"highest {number(pressure.max_mpa, 'MPa')} {_where(pressure.max_at)}"
        if pressure.max_mpa and pressure.max_at
        else "no load"
    )
    if pressure.max_mpa is None:
        finding = "no largest pressure: the path reaches a base circle"
    gaps = int(np.isnan(grid).sum())
    return Figure(finding, (panel,), unsolved=gaps)


def modification(_: LoadDistributionRequest, answer: LoadDistributionResponse) -> Figure:
    """Gap between the unloaded flanks."""
    flank = present(answer.flank)
    grid = matrix(flank.modification_um)
    low, high = float(grid.min()), float(grid.max())
    chart = Map(
        "gap between the unloaded flanks",
        "µm",
        values(flank.face_fraction),
        values(flank.profile_fraction),
        grid,
        Scale.SIGNED if low < 0.0 else Scale.MAGNITUDE,
    )
    panel = Panel(x=FACE, y=PROFILE, map=chart)
    finding = f"from {number(low)} to {number(high, 'µm')}" if high > low else "flanks without modification"
    return Figure(finding, (panel,))


def _panel(
    flank: FlankFields, title: str, unit: str, grid: Values, at: FlankPlace | None, largest: float | None
) -> Panel:
    seen = float(np.nanmax(grid, initial=0.0))
    chart = Map(
        title,
        unit,
        values(flank.face_fraction),
        values(flank.profile_fraction),
        grid,
        range=(0.0, max(seen, largest or 0.0) or 1.0),
    )
    marks: tuple[Mark, ...] = ()
    if at is not None and largest is not None:
        marks = (Mark(at.face_fraction, at.profile_fraction, number(largest, unit)),)
    return Panel(x=FACE, y=PROFILE, map=chart, marks=marks)


def _where(place: FlankPlace) -> str:
    return f"at {percent(place.face_fraction)} of the face, {percent(place.profile_fraction)} of the profile"


MAPS = (
    Declaration("flank-load", "Line load on the flank", "Xue 2020, Fig. 11", flank_load, detail="fields"),
    Declaration(
        "flank-pressure", "Hertz pressure on the flank", "Xue 2020, Figs. 13, 16, 17", flank_pressure, detail="fields"
    ),
    Declaration("modification", "Modification of the flank", "Xue 2020, Fig. 15", modification, detail="fields"),
)
