"""The heat balance of a unit, in turn with the loads of its bearings and of its flanks.

Bodies deform the flanks, flanks are the bulk of the contact, and the films of plain bearings in the gears' oil have the
temperature of the balance. Losses and loads of the bearings follow from these.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from math import hypot

import numpy as np

from solvers import heat_balance
from solvers.arrays import FloatArray
from solvers.drive_train.elements import coupling_results, hubs_of
from solvers.drive_train.gap.balance import Equilibrium
from solvers.drive_train.gap.thermal_lead import gas_heat
from solvers.drive_train.inputs import DriveTrainInputs, JournalBearing, Shaft, UnitCoupling
from solvers.drive_train.prepared import Prepared, prepare, settle
from solvers.drive_train.results import TrainSafety
from solvers.drive_train.shafts.bearings import friction_and_eccentricity
from solvers.drive_train.shafts.influence import Unit
from solvers.errors import NoSolution
from solvers.heat_balance import Heat, HeatBalanceInputs, Journal, rod_conductance
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.model import distribution
from solvers.scuffing.safety import safety_factor
from solvers.scuffing.thermal.flank import map_flash
from solvers.scuffing.thermal.pair_heat import balance_inputs, with_backlash_loss
from solvers.scuffing.thermal.temperatures import estimated_bulk, with_friction

CLOSE = 0.05  # K; of every temperature from one pass to the next
MOST_PASSES = 10
FIRST_RISE = 25.0  # K over the oil, of flanks, bodies and films in the first pass
SHAFT_CONDUCTIVITY = 46.0  # W/(m K), of steel
SHORTEST_ROD = 1e-3  # m, of a shaft between gear and bearing


@dataclass(frozen=True, slots=True)
class WarmUnit:
    """A unit with the temperatures of its balance: the inputs with them, the gap that all agreed on, the balance."""

    inputs: DriveTrainInputs
    prepared: Prepared
    found: Equilibrium
    heat: Heat
    balance: HeatBalanceInputs


def asks_for_balance(inputs: DriveTrainInputs) -> bool:
    """Return True if the bulk temperature is asked for by heat balance and not known yet, and an oil is known."""
    temperatures = inputs.mesh.temperatures
    unknown = temperatures.bulk_method == "heat_balance" and temperatures.flanks is None
    return unknown and inputs.mesh.known_oil is not None


def warm_unit(inputs: DriveTrainInputs, start: FloatArray | None = None) -> WarmUnit:
    """Bring the heat balance of a unit and its bearings, couplings and flanks together.

    Parameters
    ----------
    inputs : DriveTrainInputs
        The unit with a known oil and its cooling.
    start : FloatArray, optional
        The shafts' gap of a similar unit [m].

    Returns
    -------
    WarmUnit
        The unit at the temperatures of its balance.

    Raises
    ------
    InvalidInput
        What `prepare` and the balance raise.
    NoSolution
        `heat_balance` if the temperatures do not settle within ten passes; what `settle` and the balance raise.

    """
    warm, before, change = _first_guess(inputs), np.empty(0), np.inf
    for _ in range(MOST_PASSES):
        prepared = prepare(warm)
        found = settle(warm, prepared, start)
        balance = _balance(inputs, warm, prepared, found)
        quick = replace(balance, cooling=replace(balance.cooling, band=False))
        heat = heat_balance.solve(quick)
        temperatures = _temperatures(heat)
        if before.size:
            change = float(np.abs(temperatures - before).max())
        before, start = temperatures, found.gap
        warm = with_balance(inputs, heat)
        if change < CLOSE:
            heat = heat_balance.solve(balance) if balance.cooling.band else heat
            return WarmUnit(warm, prepared, found, with_backlash_loss(heat, prepared.mesh.prepared.path.pair), balance)
    message = (
        f"temperatures and alignment of the unit do not settle: they still change by {change:.3g} K after "
        f"{MOST_PASSES} passes; give more oil or larger bearings"
    )
    raise NoSolution("heat_balance", message, {"change_k": change})


def _first_guess(inputs: DriveTrainInputs) -> DriveTrainInputs:
    """Return the unit with one temperature of flanks, bodies and films."""
    guess = inputs.mesh.temperatures.oil + FIRST_RISE
    return at_temperatures(inputs, (guess, guess), (guess, guess), [guess] * 4, None)


def with_balance(inputs: DriveTrainInputs, heat: Heat) -> DriveTrainInputs:
    """Return the unit at the temperatures of a balance: flanks, bodies, films of the bearings, supports."""
    films, known = list[float](), iter(heat.bearings)
    for bearing in _bearings(inputs):
        films.append(next(known).film if isinstance(bearing, JournalBearing) else np.nan)
    flanks, bodies = (heat.pinion.flank, heat.wheel.flank), (heat.pinion.body, heat.wheel.body)
    return at_temperatures(inputs, flanks, bodies, films, heat.casing)


def _bearings(inputs: DriveTrainInputs) -> Iterator[object]:
    for shaft in inputs.shafts:
        yield from shaft.bearings


def at_temperatures(
    inputs: DriveTrainInputs,
    flanks: tuple[float, float],
    bodies: tuple[float, float],
    films: list[float],
    casing: float | None,
) -> DriveTrainInputs:
    """Return the unit at given temperatures.

    Parameters
    ----------
    inputs : DriveTrainInputs
        The unit with a known oil.
    flanks, bodies : tuple of float
        Of pinion and wheel [K].
    films : list of float
        Of the four bearings, the pinion's first [K]; NaN of bearings without one.
    casing : float or None
        Of the casing [K].

    Returns
    -------
    DriveTrainInputs
        With bulk temperatures, viscosities of bearings in the gears' oil, and the rise of the supports.

    """
    mesh = inputs.mesh
    return replace(
        inputs,
        mesh=replace(mesh, temperatures=replace(mesh.temperatures, bulk=sum(flanks) / 2, flanks=flanks)),
        heat=replace(inputs.heat, pinion_bulk=bodies[0], wheel_bulk=bodies[1], bulk_includes_pumping=True),
        pinion_shaft=_with_films(inputs.mesh, inputs.pinion_shaft, films[:2]),
        wheel_shaft=_with_films(inputs.mesh, inputs.wheel_shaft, films[2:]),
        couplings=tuple(_with_rise(one, casing, inputs.heat.reference) for one in inputs.couplings),
    )


def _with_films(mesh: ScuffingInputs, shaft: Shaft, films: list[float]) -> Shaft:
    """Return the shaft with the viscosity of the gears' oil at the films' temperatures where its bearings run in it."""
    assert mesh.known_oil is not None
    oil = heat_balance.cooling_oil(mesh.known_oil, mesh.temperatures.oil)
    bearings = tuple(
        replace(bearing, viscosity=oil.viscosity(film))
        if isinstance(bearing, JournalBearing) and bearing.in_gear_oil
        else bearing
        for bearing, film in zip(shaft.bearings, films, strict=True)
    )
    return replace(shaft, bearings=bearings)


def _with_rise(coupling: UnitCoupling, casing: float | None, reference: float) -> UnitCoupling:
    """Return the coupling with the casing's rise as that of the unit's supports, unless that is given."""
    alignment = coupling.alignment
    if casing is None or alignment is None or alignment.unit_rise is not None:
        return coupling
    return replace(coupling, alignment=replace(alignment, unit_rise=casing - reference))


def _balance(
    inputs: DriveTrainInputs, warm: DriveTrainInputs, prepared: Prepared, found: Equilibrium
) -> HeatBalanceInputs:
    """Return what the balance of the unit depends on, at the gap and the loads of a pass."""
    mesh = prepared.mesh.prepared
    spread = distribution(warm.mesh.distribution, mesh, found.balance)
    contact, spread = with_friction(inputs.mesh, spread)
    balance = balance_inputs(contact, spread, estimated_bulk(contact, spread, map_flash(contact.distribution, spread)))
    gas = gas_heat(inputs.pumping, inputs.mesh.distribution.load.pinion_speed)
    system, face = prepared.unit, (inputs.face_start, inputs.face_start + inputs.mesh.distribution.gears.face_width)
    couplings = coupling_results(system, found, hubs_of(system, found))
    pinion, wheel = balance.gears
    return replace(
        balance,
        gears=(
            replace(pinion, shaft_radii=_radii_beside(inputs.pinion_shaft, face)),
            replace(wheel, shaft_radii=_radii_beside(inputs.wheel_shaft, face)),
        ),
        pumping=gas.powers,
        journals=tuple(_journals(system, found, face)),
        couplings=sum(one.friction_power for one in couplings),
    )


def _journals(system: Unit, found: Equilibrium, face: tuple[float, float]) -> Iterator[Journal]:
    """Describe the plain bearings of both shafts under their loads."""
    states = system.bearings(found.loads)
    for gear, side in enumerate(system.shafts):
        for k, bearing in enumerate(side.shaft.bearings):
            if isinstance(bearing, JournalBearing):
                load = hypot(*states[2 * gear + k].load)
                yield Journal(
                    gear=gear,
                    diameter=bearing.diameter,
                    width=bearing.width,
                    clearance=bearing.clearance,
                    speed=side.speed,
                    shaft_conductance=rod_conductance(
                        _sections_between(side.shaft, face, bearing.position), SHAFT_CONDUCTIVITY
                    ),
                    operate=partial(_operate, bearing, load, side.speed),
                    oil_flow=bearing.oil_flow,
                )


def _operate(bearing: JournalBearing, load: float, speed: float, viscosity: float) -> tuple[float, float]:
    """Return friction and eccentricity of a bearing at a viscosity; at its own if it does not run in the gears' oil."""
    film = replace(bearing, viscosity=viscosity) if bearing.in_gear_oil else bearing
    return friction_and_eccentricity(film, load, speed)


def _places(shaft: Shaft) -> Iterator[tuple[float, float, float, float]]:
    """Start, end, outer and inner diameter of every section [m]."""
    start = shaft.start
    for section in shaft.sections:
        yield start, start + section.length, section.outer_diameter, section.inner_diameter
        start += section.length


def _sections_between(
    shaft: Shaft, face: tuple[float, float], bearing: float
) -> tuple[tuple[float, float, float], ...]:
    """Return length, outer and inner diameter of the sections from the face of the gear to a bearing's centre [m]."""
    low, high = (face[1], bearing) if bearing > face[1] else (bearing, face[0])
    if high - low < SHORTEST_ROD:  # the bearing lies under the face or at its edge
        low, high = bearing - SHORTEST_ROD / 2, bearing + SHORTEST_ROD / 2
    parts = [
        (min(end, high) - max(start, low), outer, inner)
        for start, end, outer, inner in _places(shaft)
        if min(end, high) > max(start, low)
    ]
    return tuple(parts)


def _radii_beside(shaft: Shaft, face: tuple[float, float]) -> tuple[float, float]:
    """Return the radii of the shaft beside both ends of the face [m], 0 where it ends there."""
    below = [outer / 2 for start, end, outer, _ in _places(shaft) if start < face[0] - SHORTEST_ROD <= end]
    above = [outer / 2 for start, end, outer, _ in _places(shaft) if start <= face[1] + SHORTEST_ROD < end]
    return max(below, default=0.0), max(above, default=0.0)


def _temperatures(heat: Heat) -> FloatArray:
    """Return all temperatures of a balance [K]."""
    casing = [] if heat.casing is None else [heat.casing]
    films = [bearing.film for bearing in heat.bearings]
    gears = [heat.pinion.flank, heat.pinion.body, heat.wheel.flank, heat.wheel.body, heat.mist]
    return np.array([*gears, *films, *casing])


def with_safety_band(inputs: DriveTrainInputs, heat: Heat, safety: TrainSafety | None) -> Heat:
    """Return the balance with the safety at the ends of its band: the band shifts the bulk temperature alone."""
    temperatures = inputs.mesh.temperatures
    if heat.band is None or safety is None or not safety.minimum or temperatures.scuffing is None:
        return heat
    assert temperatures.bulk is not None
    limit, oil = temperatures.scuffing, temperatures.oil
    hottest = oil + (limit - oil) / safety.minimum
    contacts = [hottest + sum(flanks) / 2 - temperatures.bulk for flanks in heat.flank_cases]
    factors = [safety_factor(limit, oil, contact) for contact in contacts]
    known = [factor for factor in factors if factor is not None]
    if len(known) < len(factors):
        return heat
    return replace(heat, band=replace(heat.band, safety=(min(known), max(known))))
