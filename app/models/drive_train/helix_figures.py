"""Figures of double-helical units: load and gap of both helices, and their shares over the coupling's thrust."""

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from app.figures import parts
from app.figures.data import Axis, Figure, Hue, Level, Line, NoFigure, Panel, Span, Values, values
from app.figures.declaration import present
from app.figures.sketches import faces_of
from app.figures.units import MM, axis
from app.figures.wording import number, percent
from solvers.drive_train import solve
from solvers.drive_train.inputs import DriveTrainInputs, floating_shaft
from solvers.drive_train.results import CouplingResult, DriveTrainResult, FaceLoad, TrainSafety
from solvers.errors import NoSolution
from solvers.quantity import UNITS

HELICES = (("helix 1", Hue.BLUE), ("helix 2", Hue.VERMILLION))
FRACTIONS = np.linspace(-1.0, 1.0, 7)  # thrusts of the coupling over the limit of its friction
ENDS = (0, -1)
SIDES = (-1.0, 1.0)  # friction may act either way


def decisive(result: DriveTrainResult) -> str:
    """Return a text that names the helix whose results stand above, to begin a finding; empty for a single helix."""
    return "" if result.decisive_helix is None else f"helix {result.decisive_helix} decides: "


def over_both(inputs: DriveTrainInputs, result: DriveTrainResult) -> Figure:
    """Draw load and gap of both helices over the unit's axis, with the gap between the helices."""
    helices = present(result.helices)
    faces = [(start / MM, end / MM) for start, end in faces_of(inputs)]
    curves = [helix.misalignment.curves for helix in helices]
    z = axis(curves[0], "z", "position along Z", magnitude=False, symbol="", limits=(faces[0][0], faces[1][1]))
    between = Span(faces[0][1], faces[1][0], f"gap {number(faces[1][0] - faces[0][1], 'mm', digits=4)}")
    gaps = {"shafts": "shaft", "heat": "thermal", "as ground": "modification", "total": "total"}
    opened = [
        replace(line, named=place == 0)
        for place, own in enumerate(curves)
        for line in parts.lines(own.z, {title: getattr(own, name) for title, name in gaps.items()})
    ]
    loads = [Line(name, own.z, own.line_force, hue) for own, (name, hue) in zip(curves, HELICES, strict=True)]
    panels = [
        Panel(
            x=z,
            y=axis(curves[0], "line_force", "transverse force per face, mean over the roll"),
            lines=loads,
            marks=[mark for line in loads for mark in parts.extreme([line])],
            spans=[between],
        ),
        Panel(
            x=z,
            y=axis(curves[0], "total", "gap, positive where the flanks part", magnitude=False),
            lines=opened,
            spans=parts.unnamed([between]),
        ),
    ]
    carried = " and ".join(percent(helix.share) for helix in helices)
    factors = [helix.load.face_load_factor for helix in helices]
    spread = "" if None in factors else f", K_Hβ {' and '.join(number(each) for each in factors if each is not None)}"
    slopes = " and ".join(number(helix.misalignment.recommended_helix_slope) for helix in helices)
    return Figure(f"helices carry {carried}{spread}; first estimate of the slopes to grind {slopes} µm", panels)


class Shares(NamedTuple):
    """Shares, least safeties and largest pressures [MPa] of both helices (fractions, 2); NaN where there is none."""

    share: Values
    safety: Values
    pressure: Values


def over_the_thrust(inputs: DriveTrainInputs, result: DriveTrainResult) -> Shares:
    """Solve the unit in closed form while the couplings of the floating shaft push with parts of their friction.

    Raises NoFigure if no coupling acts on the floating shaft.
    """
    _on_floating(inputs, result)
    mesh = inputs.mesh  # the figure needs neither film nor band; each point has a heat balance of its own
    mesh = replace(mesh, lubrication="closed_form", micropitting=None, cooling=replace(mesh.cooling, band=False))
    plain = replace(inputs, mesh=mesh, states=("hot",))
    rows = [_helices_at(plain, float(fraction)) for fraction in FRACTIONS]
    share, safety, pressure = (values(np.array(column)) for column in np.moveaxis(np.array(rows), 2, 0))
    return Shares(share, safety, pressure)


def _helices_at(inputs: DriveTrainInputs, fraction: float) -> list[tuple[float, float, float]]:
    """Return share, least safety and largest pressure [MPa] of both helices under a fraction of the friction limit."""
    floating = floating_shaft(inputs)
    couplings = tuple(
        replace(each, thrust_fraction=fraction) if each.shaft == floating else each for each in inputs.couplings
    )
    try:
        helices = present(solve(replace(inputs, couplings=couplings)).helices)
    except NoSolution:
        return [(np.nan, np.nan, np.nan)] * 2
    return [(helix.share, _factor(helix.safety), _pressure(helix.load)) for helix in helices]


def _factor(safety: TrainSafety | None) -> float:
    return np.nan if safety is None or safety.minimum is None else safety.minimum


def _pressure(load: FaceLoad) -> float:
    return np.nan if load.max_pressure is None else load.max_pressure / UNITS["mpa"].scale


def _on_floating(inputs: DriveTrainInputs, result: DriveTrainResult) -> list[tuple[Any, CouplingResult]]:
    """Return the couplings on the floating shaft, as given and as computed; raise NoFigure without any."""
    name = floating_shaft(inputs)
    pairs = zip(inputs.acting_couplings, result.couplings, strict=True)
    floating = [(given, own) for given, own in pairs if given.shaft == name]
    if not floating:
        message = (
            f"No coupling acts on the {name}'s shaft, which floats, so no friction shifts load between the helices"
        )
        raise NoFigure("no_coupling", message, "couplings")
    return floating


def shares(inputs: DriveTrainInputs, result: DriveTrainResult, solved: Shares) -> Figure:
    """Draw share and least safety of both helices over the thrust of the floating shaft's couplings.

    Marks show the thrust that the hubs hold at their tilt, and the thrust that the apex's runout causes.
    """
    floating, balance = _on_floating(inputs, result), present(result.axial)
    held = max(own.held_thrust_fraction or 0.0 for _, own in floating)
    x = Axis("thrust of the coupling over the limit of its friction", magnitude=False, limits=(-1.0, 1.0), symbol="τ")
    levels = _reached(held, f"held by the tilted hubs: {number(held)}")
    if balance.runout_thrust_fraction is not None:
        name = f"by the apex's runout: {number(balance.runout_thrust_fraction)}"
        levels += _reached(balance.runout_thrust_fraction, name)
    panels = [_panel(x, Axis("share of the load", "%", symbol="F_i/F"), 100.0 * solved.share, levels, [])]
    has_safety = bool(np.isfinite(solved.safety).any())
    if has_safety:
        y = axis(TrainSafety, "minimum", "least safety factor against scuffing", magnitude=False)
        limit = [Level(1.0, "scuffing below 1", limit=True)]
        panels.append(_panel(x, y, solved.safety, parts.unnamed(levels), limit))
    elif np.isfinite(solved.pressure).any():
        panels.append(_panel(x, axis(FaceLoad, "max_pressure"), solved.pressure, parts.unnamed(levels), []))
    return Figure(_finding(solved, held), panels, unsolved=int(np.isnan(solved.share[:, 0]).sum()))


def _reached(fraction: float, name: str) -> list[Level]:
    """Return the vertical lines at a thrust that may act either way; the first one has the name."""
    ends = SIDES if fraction else SIDES[1:]
    return [Level(side * fraction, "" if place else name, vertical=True) for place, side in enumerate(reversed(ends))]


def _panel(x: Axis, y: Axis, data: Values, reached: list[Level], limits: list[Level]) -> Panel:
    """Return a panel of both helices, with marks at the ends of what was solved."""
    lines = [Line(name, values(FRACTIONS), values(data[:, k]), hue) for k, (name, hue) in enumerate(HELICES)]
    marks = []
    for line in lines:
        finite = np.flatnonzero(np.isfinite(line.y))
        ends = dict.fromkeys(int(finite[place]) for place in ENDS) if finite.size else ()
        marks += [line.mark(place, number(float(line.y[place]), y.unit)) for place in ends]
    return Panel(x=x, y=y, lines=lines, levels=[*limits, *reached], marks=marks)


def _finding(solved: Shares, held: float) -> str:
    """Return what a locked coupling does, and what one does that holds only the fraction `held` of its friction."""
    texts = []
    for name, fractions in (("locked", SIDES), (f"holding {number(held)}" if held else "sliding", (-held, held))):
        share = float(np.max([np.interp(fractions, FRACTIONS, line) for line in solved.share.T]))
        factor = float(np.min([np.interp(fractions, FRACTIONS, line) for line in solved.safety.T]))
        if np.isfinite(share):
            carried = f"{percent(share)} on one helix"
            texts.append(f"{name}: {carried}" + (f", S_B {number(factor)}" if np.isfinite(factor) else ""))
        else:
            texts.append(f"{name}: one helix lifts off")
    return "; ".join(texts)
