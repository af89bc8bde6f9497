"""What every flow model gives back: the gas in the tooth spaces over one stroke."""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.pumping.flow.record import (
    ACTIVE,
    BEGUN,
    ENDED,
    FASTEST,
    HIGH_END,
    HIGH_OUTFLOW,
    IDLE,
    LARGEST_DEMAND,
    LARGEST_MACH,
    LARGEST_PRESSURE,
    LARGEST_VELOCITY,
    LOW_END,
    LOW_OUTFLOW,
    LOWEST,
    MACH,
    PEAK,
    PRESSURE,
    SMALLEST_PRESSURE,
    STAGNATION,
    STATIC,
    TEMPERATURE,
    TIME,
    WALLS,
    WORK,
    Record,
)
from solvers.pumping.space.face import Stretch


@dataclass(frozen=True, slots=True)
class ExitMasses:
    """Net mass that leaves one tooth space in a stroke, by exit [kg].

    `reset` is what slices exchange with the ambient when their stroke begins and ends, and with idle neighbours: with
    it the five sum to nought.
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
    lowest pressure [Pa], largest Mach number within slices (nought in the chain). `exit_demand` is the Mach number that
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
    records = [march.record for march in marches]
    field = np.concatenate([record.field for record in records], axis=1)
    profile = np.concatenate([record.profile for record in records])
    extremes = np.array([record.extremes for record in records])
    mass = np.array([record.mass for record in records])
    energy = np.array([record.energy for record in records])
    mass_error = (mass[:, BEGUN].sum() - mass[:, ENDED:].sum()) / mass[:, BEGUN].sum()
    energy_error = (energy[:, BEGUN].sum() - energy[:, ENDED:WORK].sum()) / energy[:, BEGUN].sum()
    return SpaceFlow(
        angle=frozen(angle),
        position=frozen(np.concatenate([march.stretch.centres for march in marches])),
        pressure=frozen(field[:, :, PRESSURE]),
        mach=frozen(field[:, :, MACH]),
        stagnation_temperature=frozen(field[:, :, TEMPERATURE]),
        mean_temperature=frozen(profile[:, STATIC] / profile[:, ACTIVE]),
        mean_stagnation_temperature=frozen(profile[:, STAGNATION] / profile[:, ACTIVE]),
        peak_pressure=frozen(profile[:, PEAK]),
        lowest_pressure=frozen(profile[:, LOWEST]),
        peak_mach=frozen(profile[:, FASTEST]),
        largest_pressure=float(extremes[:, LARGEST_PRESSURE].max()),
        smallest_pressure=float(extremes[:, SMALLEST_PRESSURE].min()),
        largest_mach=float(extremes[:, LARGEST_MACH].max()),
        largest_velocity=float(extremes[:, LARGEST_VELOCITY].max()),
        exit_demand=float(extremes[:, LARGEST_DEMAND].max()),
        work=float(energy[:, WORK].sum()),
        masses=_exit_masses(marches),
        mass_error=float(abs(mass_error)),
        energy_error=float(abs(energy_error)) if conserves_energy else None,
        ends=_end_flow(marches),
        steps=sum(march.steps for march in marches),
    )


def _exit_masses(marches: list[March]) -> ExitMasses:
    front = rear = grooves = radial = reset = 0.0
    for march in marches:
        mass = march.record.mass
        low, high = mass[LOW_END], mass[HIGH_END]
        front, grooves = (front + low, grooves) if march.stretch.opens_front else (front, grooves + low)
        rear, grooves = (rear + high, grooves) if march.stretch.opens_rear else (rear, grooves + high)
        radial += mass[WALLS]
        reset += mass[ENDED] - mass[BEGUN] + mass[IDLE]
    return ExitMasses(front=front, rear=rear, radial=radial, grooves=grooves, reset=reset)


def _end_flow(marches: list[March]) -> EndFlow:
    time = np.concatenate([march.record.ends[: march.steps, TIME] for march in marches])
    front = [march.record.ends[: march.steps, LOW_OUTFLOW] * march.stretch.opens_front for march in marches]
    rear = [march.record.ends[: march.steps, HIGH_OUTFLOW] * march.stretch.opens_rear for march in marches]
    return EndFlow(frozen(time), frozen(np.concatenate(front)), frozen(np.concatenate(rear)))
