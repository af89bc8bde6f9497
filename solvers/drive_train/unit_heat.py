"""The heat balance of a unit, solved alternately with the loads of bearings and flanks.

The temperatures of the gear bodies deform the flanks. The temperature of the flanks is the bulk temperature of the
contact. The films of plain bearings that run in the gears' oil have the temperatures of the balance. The losses and
loads of the bearings follow from these temperatures and enter the next balance. One solution of the loads, followed by
one solution of the balance, is called a pass.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from math import hypot

import numpy as np

from solvers import heat_balance
from solvers.arrays import FloatArray
from solvers.drive_train.checks import NAMES, check_bearing_count, check_readings
from solvers.drive_train.elements import coupling_results, hubs_of
from solvers.drive_train.gap.balance import Equilibrium
from solvers.drive_train.gap.face_curves import face_mean
from solvers.drive_train.gap.thermal_lead import gas_heat
from solvers.drive_train.gap.warm_face import WarmFace, WarmFaces
from solvers.drive_train.helices import on_face
from solvers.drive_train.inputs import BearingFilm, DriveTrainInputs, JournalBearing, Shaft, UnitCoupling
from solvers.drive_train.prepared import Prepared, prepare, settle
from solvers.drive_train.results import TrainSafety
from solvers.drive_train.shafts.bearings import friction_and_leakage
from solvers.drive_train.shafts.influence import Unit
from solvers.errors import InvalidInput, NoSolution
from solvers.heat_balance import Heat, HeatBalanceInputs, Journal, MeshHeat, rod_conductance
from solvers.heat_balance.calibration import LEAST_WETTING, MOST_WETTING
from solvers.heat_balance.inputs import FaceReading, Measured
from solvers.scuffing.inputs import ScuffingInputs
from solvers.scuffing.model import distribution
from solvers.scuffing.safety import safety_factor
from solvers.scuffing.thermal.bulk import BulkRule, Flanks, method_asked
from solvers.scuffing.thermal.flank import map_flash
from solvers.scuffing.thermal.pair_heat import balance_inputs, with_backlash_loss
from solvers.scuffing.thermal.temperatures import estimated_bulk, with_friction

CLOSE = 0.05  # K; the passes end if no temperature changes by more than this value from one pass to the next
MOST_PASSES = 10
CLOSE_SHARE = 1e-4  # of the wetting share and of the skew of the jets that fit readings along the face
RELAXATIONS = (0.2, 2.0)  # least and largest relaxation of that fit, chosen
FIRST_RISE = 25.0  # K; rise of flanks, bodies and films above the oil in the first pass
SHAFT_CONDUCTIVITY = 46.0  # W/(m K), of steel
SHORTEST_ROD = 1e-3  # m; least length of the shaft, as a conductor of heat, between gear and bearing


@dataclass(frozen=True, slots=True)
class WarmUnit:
    """A unit at the temperatures of its heat balance.

    `heat` is the result of the heat balance, and `balance` holds the inputs of the heat balance. Of a double-helical
    unit `helices` are the balances in which both helices carry the load of one (Eq. D24); else empty. `face` holds the
    temperatures along the face where they are asked for, `faces` how they were found, and `readings` what was measured
    there.
    """

    inputs: DriveTrainInputs
    prepared: Prepared
    equilibrium: Equilibrium
    heat: Heat
    balance: HeatBalanceInputs
    helices: tuple[Heat, ...]
    face: WarmFace | None = None
    faces: WarmFaces | None = None
    readings: tuple[FaceReading, ...] = ()

    @property
    def helix_flanks(self) -> list[Flanks | None]:
        """Flank temperatures of pinion and wheel on every face [K]; None where those of the unit hold."""
        if self.face is not None:
            return mean_flanks(self.face.flanks)
        return [(heat.pinion.flank, heat.wheel.flank) for heat in self.helices] or [None]


def mean_flanks(flanks: FloatArray) -> list[Flanks | None]:
    """Return the means of both flanks (gears, faces, stations) over every face [K]."""
    return [(face_mean(pinion), face_mean(wheel)) for pinion, wheel in flanks.swapaxes(0, 1)]


def asks_for_balance(inputs: DriveTrainInputs) -> bool:
    """Return True if the bulk temperature has to come from a heat balance that has not been solved yet.

    A heat balance needs a known oil. Without a known oil, return False. Where no method is chosen, the balance is
    solved at every speed, for the bodies of the gears; the bulk temperature of the contact follows the rule in
    `scuffing.thermal.bulk`.
    """
    temperatures, has_oil = inputs.mesh.temperatures, inputs.mesh.known_oil is not None
    if temperatures.flanks is not None or not has_oil:
        return False
    if temperatures.bulk_method is None and inputs.heat.states_teeth:
        return False
    return method_asked(temperatures, inputs.mesh.cooling, has_oil=True) in {None, "heat_balance"}


def check_face_heat(inputs: DriveTrainInputs) -> None:
    """Refuse (`face_heat_needs_balance`) the profile along the face of a unit without a heat balance."""
    if inputs.face_heat == "profile":
        message = "the profile along the face follows from the heat balance; choose it as bulk method or take uniform"
        raise InvalidInput("face_heat_needs_balance", message, "face_heat")


def warm_unit(inputs: DriveTrainInputs, start: FloatArray | None = None) -> WarmUnit:
    """Solve the heat balance of a unit together with its bearings, couplings and flanks.

    Temperatures that were measured along the face determine the wetting share and the skew of the jets.

    Raises InvalidInput: the errors of `prepare` and of the balance. Raises NoSolution: `heat_balance` if the
    temperatures do not settle within ten passes; the errors of `settle` and of the balance.
    """
    cooling = inputs.mesh.cooling
    readings = cooling.measured.face
    if not readings:
        return _settled(inputs, start)
    cooling.check()
    check_readings(inputs)
    if inputs.face_heat == "uniform":
        message = "readings along the face need the temperatures along it; take profile as face_heat"
        raise InvalidInput("face_heat_needs_balance", message, "face_heat")
    values, step, relaxation = np.array([cooling.wetting, 0.0]), np.zeros(2), 1.0
    without = replace(cooling, measured=replace(cooling.measured, face=()))
    for _ in range(MOST_PASSES):  # the load follows the fit: Aitken's relaxation of a fit at the load that is there
        fitted = replace(inputs, mesh=replace(inputs.mesh, cooling=replace(without, wetting_share=float(values[0]))))
        warm = _settled(fitted, start, float(values[1]))
        assert warm.faces is not None
        before, step = step, np.array(warm.faces.fit(readings, warm.equilibrium)) - values
        if np.abs(step).max() < CLOSE_SHARE:
            return replace(warm, readings=readings)
        change = step - before
        if before.any() and change @ change > 0.0:
            relaxation = float(np.clip(-relaxation * (before @ change) / (change @ change), *RELAXATIONS))
        values, start = values + relaxation * step, warm.equilibrium.gap
        values[0] = np.clip(values[0], LEAST_WETTING, MOST_WETTING)
    message = "wetting share and skew of the jets do not settle; check the temperatures measured along the face"
    raise NoSolution("heat_balance", message, {"wetting_share": float(values[0])})


def _settled(inputs: DriveTrainInputs, start: FloatArray | None, skew: float = 0.0) -> WarmUnit:
    """Solve the unit with the jets skewed by `skew` along the face."""
    warm, before, change = _first_guess(inputs), np.empty(0), np.inf
    for _ in range(MOST_PASSES):
        prepared = prepare(warm)
        equilibrium = settle(warm, prepared, start)
        balance, of_helices = _balance(inputs, warm, prepared, equilibrium)
        quick = replace(balance, cooling=replace(balance.cooling, band=False))
        heat = heat_balance.solve(quick)
        temperatures = _temperatures(heat)
        if before.size:
            change = float(np.abs(temperatures - before).max())
        before, start = temperatures, equilibrium.gap
        warm = with_balance(inputs, heat)
        if change < CLOSE:
            heat = heat_balance.solve(balance) if balance.cooling.band else heat
            heat = with_backlash_loss(heat, prepared.path.pair)
            if inputs.face_heat != "uniform":
                faces = warm_faces(warm, prepared, balance, heat, skew)
                face = faces.solve(equilibrium)
                return WarmUnit(warm, face.prepared, face.equilibrium, heat, balance, (), face, faces)
            helices = tuple(heat_balance.solve(_of_helix(balance, heat, mesh)) for mesh in of_helices)
            return WarmUnit(warm, prepared, equilibrium, heat, balance, helices)
    message = (
        f"temperatures and alignment of the unit do not settle; the temperatures still change by {change:.3g} K after "
        f"{MOST_PASSES} passes. Give more oil or larger bearings"
    )
    raise NoSolution("heat_balance", message, {"change_k": change})


def warm_faces(
    warm: DriveTrainInputs, prepared: Prepared, balance: HeatBalanceInputs, heat: Heat, skew: float = 0.0
) -> WarmFaces:
    """Return the faces of a unit in the heat balance that was solved."""
    network = heat_balance.calibrated(heat_balance.network_of(balance), balance.cooling)
    inlet, casing = balance.oil.inlet, [] if heat.casing is None else [heat.casing]
    gears = [heat.pinion.flank, heat.pinion.body, heat.wheel.flank, heat.wheel.body, heat.mist]
    rises = np.array([*gears, *(bearing.outlet for bearing in heat.bearings), *casing]) - inlet
    return WarmFaces(warm, prepared, network, rises, skew)


def sized_flow(inputs: DriveTrainInputs) -> float | None:
    """Compute the oil flow to the gears that is sized where none is given.

    Parameters
    ----------
    inputs : DriveTrainInputs
        The unit.

    Returns
    -------
    float or None
        Oil flow [m^3/s]; None if a flow is given or no heat balance runs.

    Examples
    --------
    >>> from solvers import drive_train, pumping, scuffing
    >>> gears = scuffing.GearPairInputs(scuffing.GearTeeth(25), scuffing.GearTeeth(76), 4e-3, 0.1, rack_tip_radius=0.3)
    >>> load = scuffing.LoadDistributionInputs(gears, scuffing.Load(900.0, 157.0))
    >>> bearings = drive_train.RigidBearing(0.05), drive_train.RigidBearing(0.35)
    >>> shaft = drive_train.Shaft((drive_train.ShaftSection(0.4, 0.1),), bearings, torque_position=0.0)
    >>> dry = scuffing.ScuffingInputs(load)
    >>> unit = drive_train.DriveTrainInputs(dry, pumping.PumpingSetup(gears), 0.15, shaft, shaft)
    >>> drive_train.sized_flow(unit) is None
    True
    """
    if inputs.mesh.cooling.gear_flow is not None or not asks_for_balance(inputs):
        return None
    unbanded = replace(inputs, mesh=replace(inputs.mesh, cooling=replace(inputs.mesh.cooling, band=False)))
    return warm_unit(unbanded).heat.gear_flow


def _first_guess(inputs: DriveTrainInputs) -> DriveTrainInputs:
    """Return the unit for the first pass, in which flanks, bodies and films all have the same temperature."""
    for shaft, name in zip(inputs.shafts, NAMES, strict=True):  # films below are those of two bearings
        check_bearing_count(shaft, name)
    guess = inputs.mesh.temperatures.oil + FIRST_RISE
    return at_temperatures(inputs, (guess, guess), (guess, guess), [guess] * 4, None)


def with_balance(inputs: DriveTrainInputs, heat: Heat) -> DriveTrainInputs:
    """Return the unit with flanks, bodies, bearing films and supports at the temperatures of a heat balance."""
    films, journals = list[float](), iter(heat.bearings)
    for bearing in _bearings(inputs):
        films.append(next(journals).film if isinstance(bearing, JournalBearing) else np.nan)
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
    """Return the unit with given temperatures of its parts."""
    mesh = inputs.mesh
    return replace(
        inputs,
        mesh=replace(mesh, temperatures=replace(mesh.temperatures, bulk=sum(flanks) / 2, flanks=flanks)),
        heat=replace(inputs.heat, pinion_bulk=bodies[0], wheel_bulk=bodies[1], bulk_includes_pumping=True),
        pinion_shaft=_with_films(inputs.mesh, inputs.pinion_shaft, films[:2]),
        wheel_shaft=_with_films(inputs.mesh, inputs.wheel_shaft, films[2:]),
        couplings=tuple(_with_rise(coupling, casing, inputs.heat.reference) for coupling in inputs.couplings),
    )


def _with_films(mesh: ScuffingInputs, shaft: Shaft, films: list[float]) -> Shaft:
    """Return the shaft with new viscosities for the bearings that run in the gears' oil.

    The viscosity of such a bearing is the viscosity of the gears' oil at the temperature of the bearing's film.
    """
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
    """Return the coupling with a temperature rise of the unit's supports.

    If no temperature rise of the supports is given, the temperature rise of the casing is used.
    """
    alignment = coupling.alignment
    if casing is None or alignment is None or alignment.unit_rise is not None:
        return coupling
    return replace(coupling, alignment=replace(alignment, unit_rise=casing - reference))


def _balance(
    inputs: DriveTrainInputs, warm: DriveTrainInputs, prepared: Prepared, equilibrium: Equilibrium
) -> tuple[HeatBalanceInputs, tuple[MeshHeat, ...]]:
    """Return the inputs of the heat balance that follow from the loads in `equilibrium`.

    `inputs` is the unit as given, and `warm` is the unit at the temperatures with which `equilibrium` was computed.
    Also return the friction of the mesh if both helices were loaded like one of them, for each; empty for one face.
    """
    balances = []
    for helix, mesh in enumerate(equilibrium.meshes):
        own = on_face(warm, helix, float(equilibrium.shares[helix])).mesh.distribution
        spread = distribution(own, mesh.prepared, equilibrium.balances[helix])
        contact, spread = with_friction(replace(inputs.mesh, distribution=own), spread)
        flash = map_flash(contact.distribution, spread)
        balances.append(balance_inputs(contact, spread, estimated_bulk(contact, spread, flash)))
    helices = tuple(each.mesh for each in balances) if len(balances) > 1 else ()
    balance = max(balances, key=lambda each: each.mesh.power)  # the estimate that it repeats is the warmer one
    if helices:
        balance = replace(balance, mesh=_mean(helices))
    gas = gas_heat(inputs.pumping, inputs.mesh.distribution.load.pinion_speed)
    width = inputs.mesh.distribution.gears.total_width
    system, face = prepared.unit, (inputs.face_start, inputs.face_start + width)
    couplings = coupling_results(system, equilibrium, hubs_of(system, equilibrium))
    pinion, wheel = balance.gears
    balance = replace(
        balance,
        gears=(
            replace(pinion, shaft_radii=_radii_beside(inputs.pinion_shaft, face)),
            replace(wheel, shaft_radii=_radii_beside(inputs.wheel_shaft, face)),
        ),
        pumping=gas.powers,
        journals=tuple(_journals(system, equilibrium, face)),
        couplings=sum(result.friction_power for result in couplings),
    )
    return balance, helices


def _mean(helices: tuple[MeshHeat, ...]) -> MeshHeat:
    """Return the friction of both helices: each one stands for twice its own."""
    powers, first = [helix.power for helix in helices], helices[0]
    total = sum(powers)
    to_pinion = sum(helix.share_to_pinion * helix.power for helix in helices) / total if total > 0.0 else None
    formulas = [helix.by_formula for helix in helices if helix.by_formula is not None]
    return replace(
        first,
        power=total / len(helices),
        share_to_pinion=first.share_to_pinion if to_pinion is None else to_pinion,
        by_formula=sum(formulas) / len(formulas) if formulas else None,
    )


def _of_helix(balance: HeatBalanceInputs, heat: Heat, mesh: MeshHeat) -> HeatBalanceInputs:
    """Return the balance in which both helices carry the load of one, with the oil and the calibration of the unit."""
    cooling = replace(balance.cooling, gear_flow=heat.gear_flow, band=False)
    if cooling.measured.any:
        other = cooling.other if cooling.measured.drain is None else heat.losses.other
        wetting = heat.wetting_share if cooling.measured.rotors else cooling.wetting_share
        cooling = replace(cooling, measured=Measured(), wetting_share=wetting, other=other)
    return replace(balance, cooling=cooling, mesh=mesh)


def _journals(system: Unit, equilibrium: Equilibrium, face: tuple[float, float]) -> Iterator[Journal]:
    """Yield the plain bearings of both shafts and their loads, in the form that the heat balance needs."""
    states = system.bearings(equilibrium.loads)
    for gear, side in enumerate(system.shafts):
        for k, bearing in enumerate(side.shaft.bearings):
            if isinstance(bearing, JournalBearing):
                load = hypot(*states[2 * gear + k].load)
                yield Journal(
                    gear=gear,
                    diameter=bearing.diameter,
                    clearance=bearing.clearance,
                    speed=side.speed,
                    shaft_conductance=rod_conductance(
                        _sections_between(side.shaft, face, bearing.position), SHAFT_CONDUCTIVITY
                    ),
                    operate=partial(_operate, bearing, load, side.speed, system.bearing_film),
                    oil_flow=bearing.oil_flow,
                    feed=bearing.feed_temperature,
                )


def _operate(
    bearing: JournalBearing, load: float, speed: float, film: BearingFilm, viscosity: float
) -> tuple[float, float]:
    """Return the friction power [W] and the side leakage [m^3/s] of a plain bearing.

    `viscosity` [Pa s] is used only if the bearing runs in the gears' oil. Otherwise the bearing keeps its own
    viscosity.
    """
    filled = replace(bearing, viscosity=viscosity) if bearing.in_gear_oil else bearing
    return friction_and_leakage(filled, load, speed, film)


def _places(shaft: Shaft) -> Iterator[tuple[float, float, float, float]]:
    """Yield start, end, outer diameter and inner diameter of every section [m]."""
    start = shaft.start
    for section in shaft.sections:
        yield start, start + section.length, section.outer_diameter, section.inner_diameter
        start += section.length


def _sections_between(
    shaft: Shaft, face: tuple[float, float], bearing: float
) -> tuple[tuple[float, float, float], ...]:
    """Return length, outer and inner diameters of the sections between the gear's face and a bearing's centre [m]."""
    low, high = (face[1], bearing) if bearing > face[1] else (bearing, face[0])
    if high - low < SHORTEST_ROD:  # the bearing lies under the face or at the edge of the face
        low, high = bearing - SHORTEST_ROD / 2, bearing + SHORTEST_ROD / 2
    parts = [
        (min(end, high) - max(start, low), outer, inner)
        for start, end, outer, inner in _places(shaft)
        if min(end, high) > max(start, low)
    ]
    return tuple(parts)


def _radii_beside(shaft: Shaft, face: tuple[float, float]) -> tuple[float, float]:
    """Return the radii [m] of the shaft just outside both ends of the gear's face; 0 if the shaft ends there."""
    below = [outer / 2 for start, end, outer, _ in _places(shaft) if start < face[0] - SHORTEST_ROD <= end]
    above = [outer / 2 for start, end, outer, _ in _places(shaft) if start <= face[1] + SHORTEST_ROD < end]
    return max(below, default=0.0), max(above, default=0.0)


def _temperatures(heat: Heat) -> FloatArray:
    """Return all temperatures of a heat balance [K]."""
    casing = [] if heat.casing is None else [heat.casing]
    films = [bearing.film for bearing in heat.bearings]
    gears = [heat.pinion.flank, heat.pinion.body, heat.wheel.flank, heat.wheel.body, heat.mist]
    return np.array([*gears, *films, *casing])


def with_safety_band(
    inputs: DriveTrainInputs, rule: BulkRule, warm: WarmUnit, face: int, safety: TrainSafety | None
) -> Heat:
    """Return the heat balance with the bands of the bulk temperature of the contact and of the safety on a face.

    The flash temperature is the same at both ends.
    """
    temperatures, heat, flanks_of_helix = inputs.mesh.temperatures, warm.heat, warm.helix_flanks[face]
    shifts = (0.0, 0.0)
    if flanks_of_helix is not None:  # a helix differs from the unit by as much in every case of the band
        shifts = flanks_of_helix[0] - heat.pinion.flank, flanks_of_helix[1] - heat.wheel.flank
    cases = [(pinion + shifts[0], wheel + shifts[1]) for pinion, wheel in heat.flank_cases]
    bulks = [bulk for flanks in cases if (bulk := rule.bulk(flanks)) is not None]
    if heat.band is None or not bulks:
        return heat
    heat = replace(heat, band=replace(heat.band, bulk=(min(bulks), max(bulks))))
    if safety is None or not safety.minimum or temperatures.scuffing is None or temperatures.bulk is None:
        return heat
    limit, oil = temperatures.scuffing, temperatures.oil
    flash = oil + (limit - oil) / safety.minimum - temperatures.bulk
    least, greatest = (safety_factor(limit, oil, bulk + flash) for bulk in (max(bulks), min(bulks)))
    if least is None or greatest is None:
        return heat
    assert heat.band is not None
    return replace(heat, band=replace(heat.band, safety=(least, greatest)))
