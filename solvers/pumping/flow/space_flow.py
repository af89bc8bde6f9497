"""The flow in a tooth space over one stroke.

`Record` holds the values that a march in time records. `SpaceFlow` is the result that every flow model returns.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, RecordArray, floats, frozen, records
from solvers.compiled import inner_kernel
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.space.face import Stretch

FIELD = floats("pressure", "mach", "temperature")
"""Gas at one angle and cell: pressure [Pa], axial Mach number, stagnation temperature [K]."""

PROFILE = floats("static", "stagnation", "active", "highest", "lowest", "mach")
"""Gas of a cell over its stroke.

`static` and `stagnation`: integrals of static and stagnation temperature over time [K s]; `active`: time in the stroke
[s]; `highest` and `lowest`: pressures [Pa]; `mach`: largest axial Mach number. The Mach number is 0 in the pocket
chain, because there the gas moves only between pockets.
"""

EXTREMES = floats("mach", "velocity", "front_out", "rear_out", "front_in", "rear_in")
"""Largest axial Mach number, largest velocity [m/s], and the values of `EndDemand` in one stroke."""

BALANCE = floats("begun", "ended", "low_end", "high_end", "walls", "idle")
"""Balance of the mass [kg] or energy [J] of all cells over their strokes.

`begun` and `ended`: content of the cells when their strokes began and ended. `low_end` and `high_end`: outflow through
both ends. `walls`: outflow through the radial gaps, and gas that the moving flanks carry out of the cells; in the
balance of energy, also the work on the walls. `idle`: outflow to cells outside their stroke. `begun` minus the sum of
the other values is the error of conservation.
"""

ENDS = floats("time", "low_outflow", "high_outflow")
"""Time at the middle of a step [s], and mass that left through the low end and the high end in this step [kg]."""


class Record(NamedTuple):
    """Arrays that a march in time fills with the results of one stroke.

    `field` (angles, cells) contains records of FIELD, `profile` (cells,) contains records of PROFILE, and `ends`
    (steps,) contains records of ENDS. `extremes` (1,) contains one record of EXTREMES, and `mass` (1,) contains one
    record of BALANCE. `energy` (1,) contains one record with the fields of BALANCE and the additional field `work`.
    `work` is the work on the gas by pressures above ambient pressure [J].
    """

    field: RecordArray
    profile: RecordArray
    extremes: RecordArray
    mass: RecordArray
    energy: RecordArray
    ends: RecordArray


def empty_record(gas: Gas, angles: int, cells: int, steps: int) -> Record:
    """Return a record of ambient gas at rest, with room for `steps` steps."""
    field, profile = records((angles, cells), FIELD), records(cells, PROFILE)
    field.pressure, field.temperature = gas.pressure, gas.temperature
    profile.highest = profile.lowest = gas.pressure
    energy = records(1, [*BALANCE, *floats("work")])
    return Record(field, profile, records(1, EXTREMES), records(1, BALANCE), energy, records(steps, ENDS))


@inner_kernel
def add_outflow(record: Record, end: int, step: int, mass: float, energy: float) -> None:
    """Record mass [kg] and energy [J] that left through the low (0) or high (1) end in a step."""
    if end == 0:
        record.mass[0].low_end += mass
        record.energy[0].low_end += energy
        record.ends[step].low_outflow = mass
    else:
        record.mass[0].high_end += mass
        record.energy[0].high_end += energy
        record.ends[step].high_outflow = mass


@inner_kernel
def add_means(profile: RecordArray, i: int, static: float, stagnation: float, dt: float, share: float) -> None:
    """Add the temperatures of a cell in one step to their integrals over the stroke (Eq. P10)."""
    profile[i].static += static * dt * share
    profile[i].stagnation += stagnation * dt * share
    profile[i].active += dt * share


@inner_kernel
def include_pressure(profile: RecordArray, i: int, pressure: float) -> None:
    """Update the highest and the lowest pressure of cell i with a new pressure [Pa]."""
    profile[i].highest = max(profile[i].highest, pressure)
    profile[i].lowest = min(profile[i].lowest, pressure)


@inner_kernel
def include_speed(extremes: RecordArray, mach: float, velocity: float) -> None:
    """Update the extremes of the stroke with a new axial Mach number and a new velocity [m/s]."""
    extremes[0].mach = max(extremes[0].mach, mach)
    extremes[0].velocity = max(extremes[0].velocity, velocity)


@inner_kernel
def include_demand(extremes: RecordArray, mach: float, end: int) -> None:
    """Include a Mach number at the low (0) or high (1) end, negative for inflow, in the stroke's largest."""
    if end == 0:
        extremes[0].front_out = max(extremes[0].front_out, mach)
        extremes[0].front_in = max(extremes[0].front_in, -mach)
    else:
        extremes[0].rear_out = max(extremes[0].rear_out, mach)
        extremes[0].rear_in = max(extremes[0].rear_in, -mach)


class EndDemand(NamedTuple):
    """Largest Mach numbers that the pressures ask for at both ends of the face; above 1, the flow there is choked.

    Outflow would expand to the ambient pressure, and inflow to the pressure in the space.
    """

    front_out: float
    rear_out: float
    front_in: float
    rear_in: float


@dataclass(frozen=True, slots=True)
class ExitMasses:
    """Net mass that leaves one tooth space in a stroke through each exit [kg].

    `reset` is the sum of two masses. The first is the mass that slices lose between two strokes, when ambient gas
    replaces the gas in these slices. The second is the mass that flows to slices outside their stroke. All five masses
    of this class add up to 0.
    """

    front: float
    rear: float
    radial: float
    grooves: float
    reset: float


@dataclass(frozen=True, slots=True)
class EndFlow:
    """Mass [kg] that leaves both ends of the face in each step (steps,), and the middle of the step `time` [s]."""

    time: FloatArray
    front: FloatArray
    rear: FloatArray


@dataclass(frozen=True, slots=True)
class SpaceFlow:
    """One stroke of one tooth space.

    `pressure` [Pa], `mach` and `stagnation_temperature` [K] have the shape (angles, positions) over the `angle` [rad]
    of the gear and the `position` [m] on the face; curves over the face have (positions,). Means and extremes are those
    over the stroke; `peak_mach` is 0 in the pocket chain.

    `demand` has the Mach numbers at the ends of the face; `exit_demand` and `inflow_demand` are the largest at ends and
    grooves. `work` [J] counts the pressure above ambient. Errors of conservation are relative. Temperatures are None if
    the flow model gives none.
    """

    angle: FloatArray
    position: FloatArray
    pressure: FloatArray
    mach: FloatArray
    stagnation_temperature: FloatArray | None
    mean_temperature: FloatArray | None
    mean_stagnation_temperature: FloatArray | None
    peak_pressure: FloatArray
    lowest_pressure: FloatArray
    peak_mach: FloatArray
    largest_pressure: float
    smallest_pressure: float
    largest_mach: float
    largest_velocity: float
    demand: EndDemand
    exit_demand: float
    inflow_demand: float
    work: float
    masses: ExitMasses
    mass_error: float
    energy_error: float | None
    ends: EndFlow
    steps: int


@dataclass(frozen=True, slots=True)
class March:
    """One stretch of the face, the record of the march in time through this stretch, and the number of time steps."""

    stretch: Stretch
    record: Record
    steps: int


def space_flow(angle: FloatArray, marches: list[March], *, conserves_energy: bool) -> SpaceFlow:
    """Join the marches through all stretches of a face into one flow."""
    marched = [march.record for march in marches]
    field = np.concatenate([record.field for record in marched], axis=1).view(np.recarray)
    profile = np.concatenate([record.profile for record in marched]).view(np.recarray)
    extremes = np.concatenate([record.extremes for record in marched]).view(np.recarray)
    return SpaceFlow(
        angle=frozen(angle),
        position=frozen(np.concatenate([march.stretch.centres for march in marches])),
        pressure=frozen(field.pressure),
        mach=frozen(field.mach),
        stagnation_temperature=frozen(field.temperature),
        mean_temperature=frozen(profile.static / profile.active),
        mean_stagnation_temperature=frozen(profile.stagnation / profile.active),
        peak_pressure=frozen(profile.highest),
        lowest_pressure=frozen(profile.lowest),
        peak_mach=frozen(profile.mach),
        largest_pressure=float(profile.highest.max()),
        smallest_pressure=float(profile.lowest.min()),
        largest_mach=float(extremes.mach.max()),
        largest_velocity=float(extremes.velocity.max()),
        demand=EndDemand(
            *(float(extremes[part][name]) for part, name in ((0, "front_out"), (-1, "rear_out"))),
            *(float(extremes[part][name]) for part, name in ((0, "front_in"), (-1, "rear_in"))),
        ),
        exit_demand=float(max(extremes.front_out.max(), extremes.rear_out.max())),
        inflow_demand=float(max(extremes.front_in.max(), extremes.rear_in.max())),
        work=float(sum(record.energy[0].work for record in marched)),
        masses=_exit_masses(marches),
        mass_error=_error([record.mass for record in marched]),
        energy_error=_error([record.energy for record in marched]) if conserves_energy else None,
        ends=_end_flow(marches),
        steps=sum(march.steps for march in marches),
    )


def _error(balances: list[RecordArray]) -> float:
    """Compute the error of conservation, divided by the content of all cells at the beginning of their strokes."""
    begun = np.concatenate([balance.begun for balance in balances]).sum()
    accounted = np.array(
        [[balance[0][name] for name in ("ended", "low_end", "high_end", "walls", "idle")] for balance in balances]
    ).sum()
    return float(abs(begun - accounted) / begun)


def _exit_masses(marches: list[March]) -> ExitMasses:
    front = rear = grooves = radial = reset = 0.0
    for march in marches:
        mass = march.record.mass[0]
        low, high = mass.low_end, mass.high_end
        front, grooves = (front + low, grooves) if march.stretch.opens_front else (front, grooves + low)
        rear, grooves = (rear + high, grooves) if march.stretch.opens_rear else (rear, grooves + high)
        radial += mass.walls
        reset += mass.ended - mass.begun + mass.idle
    return ExitMasses(front=front, rear=rear, radial=radial, grooves=grooves, reset=reset)


def _end_flow(marches: list[March]) -> EndFlow:
    time = np.concatenate([march.record.ends.time[: march.steps] for march in marches])
    front = [march.record.ends.low_outflow[: march.steps] * march.stretch.opens_front for march in marches]
    rear = [march.record.ends.high_outflow[: march.steps] * march.stretch.opens_rear for march in marches]
    return EndFlow(frozen(time), frozen(np.concatenate(front)), frozen(np.concatenate(rear)))
