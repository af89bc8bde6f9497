"""Figures of the load distribution: over the flank, over the roll and along the path of contact."""

from dataclasses import replace
from math import radians, tan

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from app.figures.data import (
    NO_BREAK,
    ORDER,
    Axis,
    Bars,
    Figure,
    Hue,
    Level,
    Line,
    Map,
    Mark,
    NoFigure,
    Panel,
    Role,
    Scale,
    Values,
    values,
)
from app.figures.declaration import Declaration, present
from app.figures.units import MM, axis
from app.figures.wording import number, percent
from solvers.scuffing.inputs import LoadDistributionInputs
from solvers.scuffing.results import ErrorCurves, Flank, LoadDistribution, Place, StiffnessCurves

MOST_LINES = 12  # of contact on either side of one
FIFTHS = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
PROFILE = Axis("profile (0: A, 1: E)", limits=(0.0, 1.0), ticks=FIFTHS, symbol="ξ")


def face(width: float) -> Axis:
    """The axis along a face of this width [m]."""
    return Axis("position on the face, from the end that meshes first", "mm", limits=(0.0, width / MM), symbol="y")


def flank_load(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Line load over the flank, its maximum over all roll positions marked."""
    load, flank = result.load, result.flank
    panel = _panel(
        inputs.gears.face_width, flank, "line load", "N/mm", flank.line_load, load.max_at, load.max_line_load
    )
    factor = load.face_load_factor
    spread = "" if factor is None else f", K_Hβ = {number(factor)}"
    carrying = f"{percent(load.contact_fraction)} of the flank carries"
    finding = f"highest {number(load.max_line_load, 'N/mm')}{spread}; {carrying}"
    return Figure(finding if load.max_at else "no load", (panel,))


def flank_pressure(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Hertz pressure over the flank, its maximum over all roll positions marked."""
    pressure, flank = result.pressure, result.flank
    grid = flank.pressure
    panel = _panel(inputs.gears.face_width, flank, "Hertz pressure", "MPa", grid, pressure.max_at, pressure.max)
    finding = (
        f"highest {number(pressure.max, 'MPa')} {_where(pressure.max_at)}"
        if pressure.max and pressure.max_at
        else "no load"
    )
    if pressure.max is None:
        finding = "no largest pressure: the path reaches a base circle"
    gaps = int(np.isnan(grid).sum())
    return Figure(finding, (panel,), unsolved=gaps)


def modification(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Gap between the unloaded flanks."""
    flank = result.flank
    grid = flank.modification
    low, high = float(grid.min()), float(grid.max())
    if not grid.any():
        raise NoFigure("no_modification", "The flanks are not modified: the gap between them is zero", "modifications")
    chart = Map(
        "gap between the unloaded flanks",
        "µm",
        values(flank.face_fraction * inputs.gears.face_width / MM),
        values(flank.profile_fraction),
        grid,
        Scale.SIGNED,
    )
    panel = Panel(x=face(inputs.gears.face_width), y=PROFILE, map=chart)
    finding = f"from {number(low)} to {number(high, 'µm')}"
    return Figure(finding, (panel,))


def _panel(
    width: float, flank: Flank, title: str, unit: str, grid: Values, at: Place | None, largest: float | None
) -> Panel:
    seen = float(np.nanmax(grid, initial=0.0))
    chart = Map(
        title,
        unit,
        values(flank.face_fraction * width / MM),
        values(flank.profile_fraction),
        grid,
        range=(0.0, max(seen, largest or 0.0) or 1.0),
    )
    marks: tuple[Mark, ...] = ()
    if at is not None and largest is not None:
        marks = (Mark(at.face_fraction * width / MM, at.profile_fraction, number(largest, unit)),)
    return Panel(x=face(width), y=PROFILE, map=chart, marks=marks)


def contact_line_load(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Line load along the contact lines of the roll position at which it is largest.

    A line of contact crosses the plane of action at the base helix angle; simultaneous ones are a transverse base pitch
    apart.
    """
    load, flank, geometry = result.load, result.flank, result.geometry
    if load.max_at is None:
        raise NoFigure("no_load", "Without load there is none along the face", "load")
    y = values(flank.face_fraction * inputs.gears.face_width / MM)
    start = load.max_at.face_fraction * inputs.gears.face_width / MM
    known = RegularGridInterpolator(
        (flank.profile_fraction, y), flank.line_load, method="linear", bounds_error=False, fill_value=np.nan
    )
    lines = []
    for pitches in range(-MOST_LINES, MOST_LINES + 1):
        across = (start - y) * tan(radians(geometry.base_helix_angle)) + pitches * geometry.transverse_base_pitch
        along = known(np.column_stack([load.max_at.profile_fraction + across / geometry.path_of_contact, y]))
        if np.isfinite(along).sum() > 1:
            lines.append(Line(_line_name(pitches), y, values(along), ORDER[pitches % len(ORDER)]))
    panel = Panel(
        x=face(inputs.gears.face_width),
        y=axis(Flank, "line_load", "line load"),
        lines=tuple(lines),
        marks=(Mark(start, load.max_line_load, number(load.max_line_load, "N/mm")),),
    )
    factor = "" if load.face_load_factor is None else f"K_Hβ = {number(load.face_load_factor)}; "
    return Figure(f"{factor}highest {number(load.max_line_load, 'N/mm')} at {number(start, 'mm')}", (panel,))


def _line_name(pitches: int) -> str:
    """Of the line so many base pitches nearer to E than the highest loaded one."""
    if pitches == 0:
        return "highest loaded line"
    return f"{abs(pitches)} {'ahead' if pitches > 0 else 'behind'}"


def traces(inputs: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Gap of the unloaded flanks along the profile in the middle of the face, and along the face at mid-profile."""
    flank = result.flank
    if not flank.modification.any():
        raise NoFigure("no_modification", "The flanks are not modified: the gap between them is zero", "modifications")
    middle = tuple(size // 2 for size in flank.modification.shape)
    profile, lead = flank.modification[:, middle[1]], flank.modification[middle[0]]
    y = values(flank.face_fraction * inputs.gears.face_width / MM)
    gap = axis(Flank, "modification", "gap between the unloaded flanks", magnitude=False)
    panels = (
        Panel(
            x=replace(PROFILE, magnitude=False),
            y=gap,
            title="profile, in the middle of the face",
            lines=(Line("profile", values(flank.profile_fraction), values(profile), named=False),),
        ),
        Panel(
            x=face(inputs.gears.face_width),
            y=gap,
            title="helix, in the middle of the profile",
            lines=(Line("helix", y, values(lead), named=False),),
        ),
    )
    ranges = (number(float(np.ptp(each)), "µm") for each in (profile, lead))
    return Figure("profile over {}, helix over {}; of both gears together".format(*ranges), panels)


def _where(place: Place) -> str:
    return f"at {percent(place.face_fraction)} of the face, {percent(place.profile_fraction)} of the profile"


MAPS = (
    Declaration("flank-load", "Line load on the flank", "Xue 2020, Fig. 11", flank_load),
    Declaration("flank-pressure", "Hertz pressure on the flank", "Xue 2020, Figs. 13, 16, 17", flank_pressure),
    Declaration("modification", "Modification of the flank", "Xue 2020, Fig. 15", modification),
)


ROLL = Axis("roll position", "base pitches", limits=(0.0, 1.0), magnitude=False)
PATH = Axis("path of contact Ψ (0: A, pinion root; 1: E, pinion tip)", limits=(0.0, 1.0), magnitude=False)
SLIDING = f"|u₁{NO_BREAK}−{NO_BREAK}u₂|"
NO_LOAD = "no load"


def transmission_error(_: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Transmission error and length of contact over the roll, and the orders of the error."""
    error, lines = result.transmission_error, result.contact_lines
    curves, lengths = error.curves, lines.curves
    order = values([float(order) for order in range(1, len(error.harmonics) + 1)])
    panels = (
        Panel(
            x=ROLL,
            y=axis(ErrorCurves, "error", "transmission error", magnitude=False),
            lines=(Line("transmission error", values(curves.roll_position), values(curves.error), named=False),),
            levels=(Level(error.mean, f"mean {number(error.mean, 'µm')}"),),
        ),
        Panel(
            x=ROLL,
            y=Axis("total length of the contact lines", "mm", symbol="L"),
            lines=(Line("length", values(lengths.roll_position), values(lengths.length), Hue.GREEN, named=False),),
        ),
        Panel(
            x=Axis("order of the mesh", magnitude=False, ticks=tuple(order.tolist())),
            y=Axis("amplitude of the transmission error", "µm"),
            bars=(Bars("amplitude", order, values(error.harmonics)),),
        ),
    )
    contact = f"contact from {number(lines.min_length)} to {number(lines.max_length, 'mm')}"
    finding = f"peak to peak {number(error.peak_to_peak, 'µm')}; {contact}"
    return Figure(finding, panels)


def path_of_contact(_: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Line load, pressure and sliding along the feature line."""
    curves, load, pressure = result.feature_line, result.load, result.pressure
    psi = values(curves.psi)
    points = path_points(result)
    stresses, sliding = values(curves.pressure), np.abs(values(curves.sliding))
    panels = (
        _along(psi, "line load", "w", "N/mm", values(curves.line_load), Hue.BLUE, points, "N/mm"),
        _along(psi, "Hertz pressure", "p_H", "MPa", stresses, Hue.VERMILLION, unnamed(points), "MPa"),
        _along(
            psi,
            "sliding speed, magnitude",
            f"|u₁{NO_BREAK}−{NO_BREAK}u₂|",
            "m/s",
            sliding,
            Hue.GREEN,
            unnamed(points),
            None,
        ),
    )
    loaded = load.max_at is not None
    finding = f"on the whole flank up to {number(load.max_line_load, 'N/mm')}"
    if pressure.max is not None:
        finding += f" and {number(pressure.max, 'MPa')}"
    gaps = int(np.isnan(stresses).sum())
    return Figure(finding if loaded else NO_LOAD, panels, unsolved=gaps)


def _along(
    psi: Values, title: str, symbol: str, unit: str, y: Values, hue: Hue, points: tuple[Level, ...], marked: str | None
) -> Panel:
    name = title.split(",", maxsplit=1)[0]
    marks: tuple[Mark, ...] = ()
    if marked is not None and np.nanmax(y, initial=0.0) > 0.0:
        top = int(np.nanargmax(y))
        marks = (Mark(float(psi[top]), float(y[top]), number(float(y[top]), marked), hue),)
    return Panel(
        x=PATH,
        y=Axis(title, unit, symbol=symbol),
        lines=(Line(name, psi, y, hue, named=False),),
        levels=points,
        marks=marks,
    )


def path_points(result: LoadDistribution) -> tuple[Level, ...]:
    """The points A to E of the path of contact, as fractions of it.

    A and E are its ends. Between B and D, each one transverse base pitch from the other end, one pair of teeth meshes
    in a transverse section (with a contact ratio up to 2); C is the pitch point, where the path has one.
    """
    curves, pitch = result.feature_line, 1.0 / result.geometry.transverse_contact_ratio
    points = {"A": 0.0, "B": 1.0 - pitch, "D": pitch, "E": 1.0} if pitch < 1.0 else {"A": 0.0, "E": 1.0}
    if curves.gamma[0] < 0.0 < curves.gamma[-1]:
        points["C"] = float(np.interp(0.0, curves.gamma, curves.psi))
    return tuple(Level(place, name, vertical=True) for name, place in sorted(points.items()))


def unnamed(levels: tuple[Level, ...]) -> tuple[Level, ...]:
    """The same lines without their names, for the panels below."""
    return tuple(Level(level.value, "", level.limit, level.vertical) for level in levels)


def stiffness(_: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Stiffness of one pair along the path beside the standard's."""
    stiff = result.stiffness
    curves = stiff.curves
    gamma, single = values(curves.gamma), values(curves.single)
    unit = "N/(mm µm)"
    levels = [Level(stiff.standard_single, f"ISO 6336-1, one pair: {number(stiff.standard_single)}")]
    if stiff.mean_mesh is not None:
        levels.append(Level(stiff.mean_mesh, f"mean of the loaded mesh: {number(stiff.mean_mesh)}"))
    if gamma[0] < 0.0 < gamma[-1]:
        levels.append(Level(0.0, "C", vertical=True))
    panel = Panel(
        x=Axis("profile parameter Γ (A left, C at 0, E right)", magnitude=False),
        y=axis(StiffnessCurves, "single", "stiffness of one pair per face width"),
        lines=(Line("one pair", gamma, single, named=False),),
        levels=tuple(levels),
        marks=(Mark(stiff.max_at_gamma, stiff.max, number(stiff.max, unit)),),
    )
    highest = f"highest {number(stiff.max)} at Γ = {number(stiff.max_at_gamma)}"
    ends = f"{number(stiff.approach)} at A, {number(stiff.recess, unit)} at E"
    finding = f"{highest}, {ends}"
    return Figure(finding, (panel,))


def load_sharing(_: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Load sharing factor beside the standard's diagram."""
    curves = result.feature_line
    psi = values(curves.psi)
    lines = []
    if curves.load_sharing is not None:
        lines.append(Line("this mesh", psi, values(curves.load_sharing)))
    if curves.iso_load_sharing is not None:
        lines.append(Line("ISO 13989-1", psi, values(curves.iso_load_sharing), Hue.GREY, Role.REFERENCE))
    finding = NO_LOAD
    marks: tuple[Mark, ...] = ()
    if curves.load_sharing is not None:
        top = int(np.argmax(lines[0].y))
        value = float(lines[0].y[top])
        finding = f"at most {number(value)} of the force on one line, at Ψ = {number(float(psi[top]))}"
        marks = (Mark(float(psi[top]), value, number(value)),)
    panel = Panel(
        x=PATH,
        y=Axis("load sharing factor X_Γ = w b / F_bt"),
        lines=tuple(lines),
        levels=path_points(result),
        marks=marks,
    )
    return Figure(finding, (panel,))


def pair_share(_: LoadDistributionInputs, result: LoadDistribution) -> Figure:
    """Share of the force on each line of contact over the roll."""
    load, curves = result.load, present(result.transmission_error.curves)
    if load.pair_share is None:
        raise NoFigure("no_load", "Without load no pair of teeth carries a share of it", "load")
    roll, shares = values(curves.roll_position), load.pair_share
    carrying = [values(share) for share in shares if np.any(np.asarray(share) != 0.0)]
    lines = tuple(
        Line(f"line {index + 1}", roll, share, ORDER[index % len(ORDER)], _role(index))
        for index, share in enumerate(carrying)
    )
    panel = Panel(x=ROLL, y=Axis("share of the normal force"), lines=lines)
    most = max(float(line.y.max()) for line in lines)
    return Figure(f"one line of contact carries up to {percent(most)} of the force", (panel,))


def _role(index: int) -> Role:
    """Lines beyond the hues are dotted."""
    return Role.RESULT if index < len(ORDER) else Role.REFERENCE


FIGURES = (
    *MAPS,
    Declaration("modification-traces", "Profile and helix of the pair", "Xue 2020, Fig. 15", traces),
    Declaration(
        "contact-line-load",
        "Line load along the face at the worst roll position",
        "Xue 2020, section II",
        contact_line_load,
    ),
    Declaration(
        "transmission-error", "Transmission error and length of contact", "Xue 2020, Figs. 5, 12", transmission_error
    ),
    Declaration(
        "path-of-contact",
        "Load, pressure and sliding along the path of contact",
        "Xue 2020, Figs. 11, 13, 18",
        path_of_contact,
    ),
    Declaration("stiffness", "Stiffness of a pair of teeth along the path", "Xue 2020, Fig. 8", stiffness),
    Declaration("load-sharing", "Load sharing along the path of contact", "Xue 2020, Fig. 19", load_sharing),
    Declaration("pair-share", "Share of each pair of teeth over the roll", "Xue 2020, section II", pair_share),
)
