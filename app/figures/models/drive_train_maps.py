"""Figures of a gear unit's flank: load and contact temperature over profile and face."""

import numpy as np

from app.figures.data import Critical, Figure, Map, Mark, NoFigure, Panel, matrix, values
from app.figures.declaration import Declaration, present
from app.figures.models.flank_maps import FACE, PROFILE
from app.figures.wording import number, percent
from app.requests.drive_train import DriveTrainRequest
from app.responses.drive_train import DriveTrainResponse


def flank_load(_: DriveTrainRequest, answer: DriveTrainResponse) -> Figure:
    """Line load over the flank under the gap that all parts agreed on."""
    flank, load = present(answer.flank), present(answer.load)
    grid = matrix(flank.line_load_n_per_mm)
    chart = Map(
        "line load",
        "N/mm",
        values(flank.face_fraction),
        values(flank.profile_fraction),
        grid,
        range=(0.0, max(float(grid.max()), load.max_line_load_n_per_mm) or 1.0),
    )
    row, column = np.unravel_index(int(np.argmax(grid)), grid.shape)
    mark = Mark(flank.face_fraction[column], flank.profile_fraction[row], number(load.max_line_load_n_per_mm, "N/mm"))
    factor = load.face_load_factor
    finding = (
        f"highest {number(load.max_line_load_n_per_mm, 'N/mm')}; {percent(load.contact_fraction)} of the flank carries"
    )
    if factor is None:
        return Figure("no load", (Panel(x=FACE, y=PROFILE, map=chart),))
    return Figure(f"{finding}, K_Hβ = {number(factor)}", (Panel(x=FACE, y=PROFILE, map=chart, marks=(mark,)),))


def contact_temperature(_: DriveTrainRequest, answer: DriveTrainResponse) -> Figure:
    """Contact temperature by Blok over the flank; the corners that a feature line never meets count."""
    flank = present(answer.flank)
    grid = matrix(flank.contact_temperature_c)
    if present(answer.derived).temperatures.bulk_c is None:
        raise NoFigure("no_oil", "Without an oil and a bulk temperature there is no contact temperature", "lubricant")
    if not np.isfinite(grid).all():
        raise NoFigure(
            "no_temperature", "The loaded path reaches a base circle, where there is no temperature", "gears"
        )
    limit = present(answer.derived).temperatures.scuffing_c
    low, high = float(grid.min()), float(grid.max())
    critical = (Critical(limit, "scuffing"),) if limit is not None and low < limit < high else ()
    chart = Map(
        "contact temperature",
        "°C",
        values(flank.face_fraction),
        values(flank.profile_fraction),
        grid,
        critical=critical,
        range=(low, high if high > low else low + 1.0),
    )
    row, column = np.unravel_index(int(np.argmax(grid)), grid.shape)
    hottest = number(high, "°C", digits=4)
    mark = Mark(flank.face_fraction[column], flank.profile_fraction[row], hottest)
    safety = answer.safety.blok_flank if answer.safety is not None else None
    finding = f"up to {hottest}" + ("" if safety is None else f", safety against scuffing {number(safety)} by Blok")
    return Figure(finding, (Panel(x=FACE, y=PROFILE, map=chart, marks=(mark,) if high > low else ()),))


MAPS = (
    Declaration("flank-load", "Line load on the flank", "Xue 2020, Fig. 11", flank_load, detail="fields"),
    Declaration(
        "contact-temperature",
        "Contact temperature on the flank",
        "Xue 2020, Eq. 25",
        contact_temperature,
        detail="fields",
    ),
)
