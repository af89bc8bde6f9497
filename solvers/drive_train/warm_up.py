"""The warm-up of a unit: the heat balance over time, and the alignment of the flanks at five points in time."""

from collections.abc import Iterator
from dataclasses import replace
from math import cos

import numpy as np

from solvers import heat_balance
from solvers.arrays import ROUNDING, FloatArray, frozen
from solvers.drive_train.derived import Derived, derived
from solvers.drive_train.gap.balance import Equilibrium
from solvers.drive_train.helices import on_face
from solvers.drive_train.inputs import DriveTrainInputs, JournalBearing, Shaft, torsion_diameter
from solvers.drive_train.outcome import Outcome, outcome_of
from solvers.drive_train.prepared import prepare, settle
from solvers.drive_train.safety import contact_of
from solvers.drive_train.unit_heat import WarmUnit, asks_for_balance, at_temperatures, warm_unit
from solvers.errors import InvalidInput
from solvers.gears.pair import GearPair
from solvers.heat_balance import Capacities, Heat, WarmUp, cylinders_capacity, loaded_teeth_capacity
from solvers.heat_balance.capacities import STEEL_HEAT
from solvers.heat_balance.network import BODIES, FLANKS, MIST, Network
from solvers.lubricants import oil_temperature
from solvers.materials import Solid
from solvers.notices import Notice
from solvers.pumping.space.tooth_space import normal_backlash
from solvers.quantity import quantity, record
from solvers.scuffing.helices import UNEQUAL
from solvers.scuffing.model import distribution
from solvers.scuffing.thermal.bulk import method_asked
from solvers.scuffing.thermal.pair_heat import STEEL_EXPANSION
from solvers.scuffing.thermal.temperatures import in_force
from solvers.sources import ISO_6336, OWN

TIMES = 5


@record
class WarmUpInputs:
    """A unit, its temperature at the start, and the end of the warm-up."""

    unit: DriveTrainInputs
    start: float = quantity(
        "temperature at the start",
        "θ_start",
        unit="c",
        default=20.0,
        ge=-50,
        le=150,
        tolerance=5,
        text="of gears, bearings, mist and casing",
        assumed="20 °C, a start from cold; the oil is supplied at its own temperature",
    )
    until: float | None = quantity(
        "end of the warm-up",
        "t_end",
        unit="s",
        default=None,
        ge=1,
        le=1e6,
        default_text="six times the slowest time constant",
    )


@record
class AlignmentOverTime:
    """Load and safety at five points in time of the warm-up, calculated with the temperatures at these points."""

    time: FloatArray = quantity("times of the alignment", "t", unit="s")
    face_load_factor: FloatArray = quantity("face load factor over time", "K_Hβ", ISO_6336, axis="time", gaps=True)
    safety: FloatArray = quantity(
        "safety factor over time",
        "S_B",
        text="by Blok over the flank; null without a scuffing temperature",
        axis="time",
        gaps=True,
    )
    total_slope: FloatArray = quantity("slope by shafts and heat over time", "f_Hβ", unit="um", axis="time")


@record(kw_only=True, equation="H24")
class UnitWarmUp:
    """A warm-up: temperatures, alignment at five points in time, and the heat balance at the end.

    The least safety factor, the largest face load factor and the least backlash of the warm-up are also given.
    """

    warm_up: WarmUp = quantity("warm-up")
    least_safety: float | None = quantity(
        "least safety factor of the warm-up",
        "S_B,min",
        text=(
            "smallest of the five times; null without a scuffing temperature, or if the teeth stay as cool as the oil"
        ),
    )
    largest_face_load_factor: float | None = quantity(
        "largest face load factor of the warm-up", "K_Hβ,max", ISO_6336, text="of the five times"
    )
    least_backlash: float | None = quantity(
        "least normal backlash of the warm-up",
        "j_n,min",
        OWN,
        unit="um",
        text="from the temperatures of gears and casing; null without a casing in the balance",
        equation="H22",
    )
    alignment: AlignmentOverTime = quantity("alignment over time", detail="curves")
    heat: Heat = quantity("heat balance", text="balance of the running unit, at the end of the warm-up")
    derived: Derived = quantity("what was left open, as the running unit uses it")
    warnings: tuple[Notice, ...]


def solve(inputs: WarmUpInputs) -> UnitWarmUp:
    """Compute the temperatures of a unit during its warm-up, and the load on its flanks.

    Parameters
    ----------
    inputs : WarmUpInputs
        The unit with a heat balance, its temperature at the start [K] and the end of the warm-up [s].

    Returns
    -------
    UnitWarmUp
        Temperatures over time [K], load and safety at five points in time, and the least backlash [m].

    Raises
    ------
    InvalidInput
        `not_asked` if the unit has no heat balance, `missing_mass` if a casing with an area has no mass; the errors of
        `warm_unit`.
    NoSolution
        `warm_up` if the integration fails; the errors of `warm_unit`.

    Notes
    -----
    The losses are those of the warm unit, and change only with the viscosity of the oil (Eq. H24).

    Examples
    --------
    >>> from solvers import drive_train, pumping, scuffing
    >>> gears = scuffing.GearPairInputs(scuffing.GearTeeth(25), scuffing.GearTeeth(76), 4e-3, 0.1, rack_tip_radius=0.3)
    >>> load = scuffing.LoadDistributionInputs(gears, scuffing.Load(900.0, 157.0))
    >>> mesh = scuffing.ScuffingInputs(load, oil=scuffing.iso_vg(46), lubrication="closed_form")
    >>> gas = pumping.PumpingSetup(gears, model=pumping.PumpingModel(pumping.Flow.INCOMPRESSIBLE))
    >>> bearings = drive_train.RigidBearing(0.05), drive_train.RigidBearing(0.35)
    >>> shaft = drive_train.Shaft((drive_train.ShaftSection(0.4, 0.1),), bearings, torque_position=0.0)
    >>> unit = drive_train.DriveTrainInputs(mesh, gas, 0.15, shaft, shaft)
    >>> result = drive_train.solve_warm_up(drive_train.WarmUpInputs(unit))
    >>> result.warm_up.greatest_difference > 0.0
    True
    """
    unit = _by_balance(inputs.unit)
    if not asks_for_balance(unit):
        message = (
            "a warm-up needs the heat balance; cool the gears by jets of a known oil, and do not give a bulk "
            "temperature"
        )
        raise InvalidInput("not_asked", message, "temperatures.bulk_method")
    walls = unit.mesh.cooling.casing
    if walls.area and walls.mass is None:
        raise InvalidInput(
            "missing_mass", "a casing that warms up needs a mass; give the mass of the casing", "cooling.casing.mass"
        )
    cooling = unit.mesh.cooling
    if cooling.measured.face:  # the wetting share follows from the running unit
        share = warm_unit(unit).heat.wetting_share
        cooling = replace(cooling, wetting_share=share, measured=replace(cooling.measured, face=()))
        unit = replace(unit, mesh=replace(unit.mesh, cooling=cooling))
    warm = warm_unit(replace(unit, face_heat="uniform"))
    balance = warm.balance
    network = heat_balance.calibrated(heat_balance.network_of(balance), balance.cooling)
    course = heat_balance.warm_up(network, _capacities(unit, warm), inputs.start, inputs.until)
    times = _times(course)
    outcomes = [_outcome_at(unit, network, course, float(time)) for time in times]
    factors = np.array([np.nan if (factor := at.face_load_factor) is None else factor for at in outcomes])
    safeties = np.array([np.nan if at.safety is None else at.safety for at in outcomes])
    return UnitWarmUp(
        warm_up=course,
        least_safety=_least_safety(outcomes),
        largest_face_load_factor=None if np.isnan(factors).any() else float(factors.max()),
        least_backlash=_least_backlash(unit, warm, course),
        alignment=AlignmentOverTime(
            time=frozen(times),
            face_load_factor=frozen(factors),
            safety=frozen(safeties),
            total_slope=frozen([at.total_slope for at in outcomes]),
        ),
        heat=warm.heat,
        derived=_derived(warm),
        warnings=(*warm.heat.warnings, *_of_two_helices(warm.equilibrium), *_of_the_face(unit)),
    )


def _of_two_helices(equilibrium: Equilibrium) -> Iterator[Notice]:
    """Warn that the warm-up has one flank temperature for helices that do not carry alike."""
    factor = equilibrium.shares.size * float(equilibrium.shares.max())
    if factor > UNEQUAL:
        message = (
            f"one helix carries {100 * equilibrium.shares.max():.0f} % of the load; during the warm-up both have the "
            "flank temperature of equal shares, so that the safety of the hotter one is overstated: the drive train "
            "states that of the end"
        )
        yield Notice("helices_warm_unequally", message, "floating_shaft")


def _of_the_face(unit: DriveTrainInputs) -> Iterator[Notice]:
    """Say that the temperatures along the face are uniform during a warm-up."""
    if unit.face_heat != "uniform" and unit.effects.thermal:
        message = (
            "the warm-up takes uniform temperatures along the face; its end differs from the answer of the drive train "
            "by the lead of the profile"
        )
        yield Notice("warm_up_is_uniform", message, "face_heat", rank="note")


def _by_balance(unit: DriveTrainInputs) -> DriveTrainInputs:
    """Return the unit with the heat balance as method if no other is chosen: the estimate knows no time."""
    mesh = contact_of(unit)
    if method_asked(mesh.temperatures, mesh.cooling, has_oil=mesh.known_oil is not None) is None:
        mesh = replace(mesh, temperatures=replace(mesh.temperatures, bulk_method="heat_balance"))
    return replace(unit, mesh=mesh)


def unusual_values(inputs: WarmUpInputs, _: UnitWarmUp) -> Iterator[Notice]:
    """Warn of an unusual temperature of the oil."""
    yield from oil_temperature(inputs.unit.mesh.temperatures.oil)


def _least_safety(outcomes: list[Outcome]) -> float | None:
    """Return the least safety factor; None if no time has one, or if the flank has no temperature at one of the times.

    At a time at which no place of the flank is hotter than the oil, the safety has no bound; it is not the least.
    """
    if any(np.isnan(at.temperature).any() for at in outcomes):
        return None
    return min((at.safety for at in outcomes if at.safety is not None), default=None)


def _derived(warm: WarmUnit) -> Derived:
    """Return the values that the warm unit uses for the inputs that the user has not given."""
    equilibrium = warm.equilibrium
    face = int(np.argmax(equilibrium.shares))
    inputs = on_face(warm.inputs, face, float(equilibrium.shares[face]))
    mesh = equilibrium.meshes[face].prepared
    spread = distribution(inputs.mesh.distribution, mesh, equilibrium.balances[face])
    contact, spread, *_, ran = in_force(contact_of(inputs), spread)
    return derived(replace(inputs, mesh=contact), spread, ran, warm.heat)


def _capacities(unit: DriveTrainInputs, warm: WarmUnit) -> Capacities:
    """Return the heat capacities of both rotors, of the teeth and of the casing [J/K]."""
    given = unit.mesh.distribution
    materials, gears = (given.pinion_material, given.wheel_material), warm.balance.gears
    teeth = [
        loaded_teeth_capacity(
            gear.teeth,
            gear.face_width,
            gear.module,
            heat_balance.TOOTH_HEIGHT * gear.module,
            material.density,
            material.specific_heat,
        )
        for gear, material in zip(gears, materials, strict=True)
    ]
    pair = given.gears
    rotors = [
        _rotor(shaft, material, torsion_diameter(pair, own) * (1.0 - ROUNDING), 2 * gear.reference_radius)
        for shaft, material, own, gear in zip(unit.shafts, materials, (pair.pinion, pair.wheel), gears, strict=True)
    ]
    mass = unit.mesh.cooling.casing.mass
    return Capacities((rotors[0], rotors[1]), (teeth[0], teeth[1]), None if mass is None else mass * STEEL_HEAT)


def _rotor(shaft: Shaft, material: Solid, solid: float, reference: float) -> float:
    """Return the heat capacity of a rotor [J/K].

    A section carries the teeth if its outer diameter is at least `solid` [m]. If the outer diameter of such a section
    is smaller than `reference` [m], the function computes with `reference` instead, to include the heat capacity of
    the teeth.
    """
    sections = tuple(
        (
            section.length,
            max(section.outer_diameter, reference) if section.outer_diameter >= solid else section.outer_diameter,
            section.inner_diameter,
        )
        for section in shaft.sections
    )
    return cylinders_capacity(sections, shaft.density, material.specific_heat)


def _times(course: WarmUp) -> FloatArray:
    """Return the five points in time [s] at which the alignment is computed.

    Let t_max be the time at which the temperature difference between the gear bodies is greatest. The points are:

    - the start of the warm-up,
    - a time between the start of the warm-up and t_max,
    - t_max,
    - a time between t_max and the end of the warm-up,
    - the end of the warm-up.

    If t_max is the start or the end of the warm-up, the five points are equidistant.
    """
    end = float(course.curves.time[-1])
    greatest = course.greatest_difference_at
    if not 0.0 < greatest < end:
        return np.linspace(0.0, end, TIMES)
    return np.array([0.0, greatest / 2, greatest, np.sqrt(greatest * end), end])


def _outcome_at(unit: DriveTrainInputs, network: Network, course: WarmUp, time: float) -> Outcome:
    """Compute the main results of the unit with the temperatures at a point in time [s]."""
    curves = course.curves
    now = np.array([np.interp(time, curves.time, curve) for curve in curves.temperature.T])
    outlets = enumerate(now[MIST + 1 :] - network.oil.inlet)
    films = [
        network.film_temperature(*next(outlets)) if isinstance(bearing, JournalBearing) else np.nan
        for shaft in unit.shafts
        for bearing in shaft.bearings
    ]
    flanks = (float(now[FLANKS[0]]), float(now[FLANKS[1]]))
    bodies = (float(now[BODIES[0]]), float(now[BODIES[1]]))
    casing = float(now[-1]) if network.casing else None
    warm = at_temperatures(unit, flanks, bodies, films, casing)
    prepared = prepare(warm)
    return outcome_of(warm, prepared, settle(warm, prepared))


def _least_backlash(unit: DriveTrainInputs, warm: WarmUnit, course: WarmUp) -> float | None:
    """Return the least normal backlash during the warm-up (Eq. H22).

    Returns least normal backlash [m]; None if the heat balance has no casing.
    """
    if course.nodes[-1] != "casing":
        return None
    pair: GearPair = warm.prepared.path.pair
    temperatures = course.curves.temperature
    rises = [temperatures[:, body] - temperatures[:, -1] for body in BODIES]
    growth = STEEL_EXPANSION * (pair.pinion_working_radius * rises[0] + pair.wheel_working_radius * rises[1])
    lost = 2 * np.tan(pair.working_pressure_angle) * growth * cos(pair.working_pressure_angle)
    return normal_backlash(pair, unit.pumping.normal_backlash) - float(lost.max()) * cos(pair.base_helix_angle)
