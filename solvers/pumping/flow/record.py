"""The books of a march through the stroke of a duct: what came and went, means, extremes and fields."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray
from solvers.compiled import kernel
from solvers.pumping.flow.nozzle import Gas

# Entries of `mass` and `energy`, `WORK` of energy alone; of `extremes`; columns of `field`, `profile` and `ends`.
BEGUN, ENDED, LOW_END, HIGH_END, WALLS, IDLE, WORK = range(7)
LARGEST_PRESSURE, SMALLEST_PRESSURE, LARGEST_MACH, LARGEST_VELOCITY, LARGEST_DEMAND = range(5)
PRESSURE, MACH, TEMPERATURE = range(3)
STATIC, STAGNATION, ACTIVE, PEAK, LOWEST, FASTEST = range(6)
TIME, LOW_OUTFLOW, HIGH_OUTFLOW = range(3)


class Record(NamedTuple):
    """What a march leaves behind.

    field: (angles, cells, 3) pressure [Pa], axial Mach number, stagnation temperature [K]
    profile: (cells, 6) integral of temperature and of stagnation temperature [K s], active time [s], peak and lowest
        pressure [Pa], largest axial Mach number (of cells; the chain's jets are between its pockets)
    extremes: largest and smallest pressure [Pa], largest axial Mach number, largest axial velocity [m/s], largest Mach
        number that the ambient pressure asks for at an end (above one: choked)
    mass: content when slices begin, content when they end, outflow at the low end, at the high end, radially, to idle
        slices [kg]
    energy: the same [J], the radial one with the wall work; then the work done on the gas above ambient pressure [J]
    ends: (steps, 3) mid-step time [s], outflow in the step at the low and at the high end [kg]
    """

    field: FloatArray
    profile: FloatArray
    extremes: FloatArray
    mass: FloatArray
    energy: FloatArray
    ends: FloatArray


def empty_record(gas: Gas, angles: int, cells: int, steps: int) -> Record:
    """A record of ambient gas at rest."""
    field = np.zeros((angles, cells, 3))
    field[:, :, PRESSURE], field[:, :, TEMPERATURE] = gas.pressure, gas.temperature
    profile = np.zeros((cells, 6))
    profile[:, PEAK] = profile[:, LOWEST] = gas.pressure
    extremes = np.zeros(5)
    extremes[LARGEST_PRESSURE] = extremes[SMALLEST_PRESSURE] = gas.pressure
    return Record(field, profile, extremes, np.zeros(WORK), np.zeros(WORK + 1), np.zeros((steps, 3)))


@kernel
def book(record: Record, entry: int, mass: float, energy: float) -> None:
    """Add to an entry of both books [kg, J]."""
    record.mass[entry] += mass
    record.energy[entry] += energy


@kernel
def book_means(record: Record, i: int, static: float, stagnation: float, dt: float, share: float) -> None:
    """Add the mean temperatures of slice i [K] in the share of a step of dt [s] in which it is active."""
    record.profile[i, STATIC] += static * dt * share
    record.profile[i, STAGNATION] += stagnation * dt * share
    record.profile[i, ACTIVE] += dt * share


@kernel
def book_pressure(record: Record, i: int, pressure: float) -> None:
    """Keep the extremes of the pressure [Pa] in slice i and in all."""
    extremes = record.extremes
    record.profile[i, PEAK] = max(record.profile[i, PEAK], pressure)
    record.profile[i, LOWEST] = min(record.profile[i, LOWEST], pressure)
    extremes[LARGEST_PRESSURE] = max(extremes[LARGEST_PRESSURE], pressure)
    extremes[SMALLEST_PRESSURE] = min(extremes[SMALLEST_PRESSURE], pressure)


@kernel
def book_speed(record: Record, mach: float, velocity: float) -> None:
    """Keep the largest axial Mach number and velocity [m/s]."""
    record.extremes[LARGEST_MACH] = max(record.extremes[LARGEST_MACH], mach)
    record.extremes[LARGEST_VELOCITY] = max(record.extremes[LARGEST_VELOCITY], velocity)


@kernel
def book_cell_speed(record: Record, i: int, mach: float, velocity: float) -> None:
    """Keep the largest axial Mach number of slice i, and of all with the velocity [m/s]."""
    record.profile[i, FASTEST] = max(record.profile[i, FASTEST], mach)
    book_speed(record, mach, velocity)


@kernel
def book_demand(record: Record, mach: float) -> None:
    """Keep the largest Mach number that the ambient pressure asks for at an end."""
    record.extremes[LARGEST_DEMAND] = max(record.extremes[LARGEST_DEMAND], mach)
