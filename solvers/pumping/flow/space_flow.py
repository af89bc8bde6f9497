"""The flow in the tooth spaces over one stroke: what a march records, and the result that every flow model gives."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray, RecordArray, floats, frozen, records
from solvers.compiled import kernel
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.space.face import Stretch

FIELD = floats("pressure", "mach", "temperature")
"""Gas at one angle and cell: pressure [Pa], axial Mach number, stagnation temperature [K]."""

PROFILE = floats("static", "stagnation", "active", "highest", "lowest", "mach")
"""Gas of a cell over its stroke.

Integrals of static and stagnation temperature over time [K s], time in the stroke [s], highest and lowest pressure
[Pa], largest axial Mach number (0 in the chain of pockets, whose jets are between its pockets).
"""

EXTREMES = floats("mach", "velocity", "demand")
"""Largest axial Mach number and velocity [m/s], largest Mach number that the ambient pressure asks for at an end."""

BALANCE = floats("begun", "ended", "low_end", "high_end", "walls", "idle")
"""Mass [kg] or energy [J] that cells held when their stroke began, and where it went.

Content when the stroke ended; outflow through the low and the high end; through the radial gaps and with the flanks
(energy: with the wall work); to cells outside their stroke. The first less the others is the error of conservation.
"""

ENDS = floats("time", "low_outflow", "high_outflow")
"""A step: time of its middle [s], mass that flowed out of the low and of the high end in it [kg]."""


class Record(NamedTuple):
    """What a march through the stroke of a duct computes, arrays of records.

    `field` (angles, cells) of FIELD; `profile` (cells,) of PROFILE; `extremes` (1,) of EXTREMES; `mass` and `energy`
    (1,) of BALANCE, the energy with the `work` done on the gas above ambient pressure [J]; `ends` (steps,) of ENDS.
    """

    field: RecordArray
    profile: RecordArray
    extremes: RecordArray
    mass: RecordArray
    energy: RecordArray
    ends: RecordArray


def empty_record(gas: Gas, angles: int, cells: int, steps: int) -> Record:
    """A record of ambient gas at rest."""
    field, profile = records((angles, cells), FIELD), records(cells, PROFILE)
    field.pressure, field.temperature = gas.pressure, gas.temperature
    profile.highest = profile.lowest = gas.pressure
    energy = records(1, [*BALANCE, *floats("work")])
    return Record(field, profile, records(1, EXTREMES), records(1, BALANCE), energy, records(steps, ENDS))


@kernel
def add_outflow(record: Record, end: int, step: int, mass: float, energy: float) -> None:
    """Add what flowed out of the low (0) or the high end (1) in a step: mass [kg] and energy [J]."""
    if end == 0:
        record.mass[0].low_end += mass
        record.energy[0].low_end += energy
        record.ends[step].low_outflow = mass
    else:
        record.mass[0].high_end += mass
        record.energy[0].high_end += energy
        record.ends[step].high_outflow = mass


@kernel
def add_means(profile: RecordArray, i: int, static: float, stagnation: float, dt: float, share: float) -> None:
    """Add the mean temperatures of cell i [K] in the share of a step of dt [s] in which it is active (Eq. P10)."""
    profile[i].static += static * dt * share
    profile[i].stagnation += stagnation * dt * share
    profile[i].active += dt * share


@kernel
def include_pressure(profile: RecordArray, i: int, pressure: float) -> None:
    """Include a pressure [Pa] of cell i in its extremes."""
    profile[i].highest = max(profile[i].highest, pressure)
    profile[i].lowest = min(profile[i].lowest, pressure)


@kernel
def include_speed(extremes: RecordArray, mach: float, velocity: float) -> None:
    """Include an axial Mach number and velocity [m/s] in the extremes of the stroke."""
    extremes[0].mach = max(extremes[0].mach, mach)
    extremes[0].velocity = max(extremes[0].velocity, velocity)


@kernel
def include_demand(extremes: RecordArray, mach: float) -> None:
    """Include the Mach number that the ambient pressure asks for at an end in the extremes of the stroke."""
    extremes[0].demand = max(extremes[0].demand, mach)


@dataclass(frozen=True, slots=True)
class ExitMasses:
    """Net mass that leaves one tooth space in a stroke, by exit [kg].

    `reset` is what slices exchange with the ambient when their stroke begins and ends, and with idle neighbours. The
    five add up to 0.
    """

    front: float
    rear: float
    radial: float
    grooves: float
    reset: float


@dataclass(frozen=True, slots=True)
class EndFlow:
    """Mass that leaves through both ends of the face, step by step: `time` [s], `front` and `rear` [kg]."""

    time: FloatArray
    front: FloatArray
    rear: FloatArray


@dataclass(frozen=True, slots=True)
class SpaceFlow:
    """One stroke of one tooth space; a temperature is None where the model has none.

    Fields of shape (angles, positions): `pressure` [Pa], `mach`, `stagnation_temperature` [K] at the owner's `angle`
    [rad] and `position` [m]. Over the face: stroke means of temperature and stagnation temperature [K], peak and
    lowest pressure [Pa], largest Mach number within slices (0 in the chain). `exit_demand` is the Mach number that
    the ambient pressure asks for at the ends, above one where they are choked; `work` [J] is done on the gas above
    ambient pressure. Errors are relative.
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
    exit_demand: float
    work: float
    masses: ExitMasses
    mass_error: float
    energy_error: float | None
    ends: EndFlow
    steps: int


@dataclass(frozen=True, slots=True)
class March:
    """A record, the stretch of face it belongs to and the steps it took."""

    stretch: Stretch
    record: Record
    steps: int


def space_flow(angle: FloatArray, marches: list[March], *, conserves_energy: bool) -> SpaceFlow:
    """Join the stretches of a face between its grooves."""
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
        exit_demand=float(extremes.demand.max()),
        work=float(sum(record.energy[0].work for record in marched)),
        masses=_exit_masses(marches),
        mass_error=_error([record.mass for record in marched]),
        energy_error=_error([record.energy for record in marched]) if conserves_energy else None,
        ends=_end_flow(marches),
        steps=sum(march.steps for march in marches),
    )


def _error(balances: list[RecordArray]) -> float:
    """What conservation leaves unaccounted for, relative to the content of cells when their stroke begins."""
    begun = np.concatenate([each.begun for each in balances]).sum()
    accounted = np.array(
        [[each[0][name] for name in ("ended", "low_end", "high_end", "walls", "idle")] for each in balances]
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
