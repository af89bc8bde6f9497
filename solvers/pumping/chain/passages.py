"""What passes an opening between two pockets, or a pocket and the ambient: nozzle flow and the heat it carries."""

from typing import NamedTuple

from solvers.compiled import kernel
from solvers.pumping.flow.nozzle import Gas, mass_flux


class Side(NamedTuple):
    """A side of an opening: pressure [Pa], mass [kg/m] and section [m^2] of a pocket, or of one of ambient gas."""

    pressure: float
    mass: float
    area: float


class Passage(NamedTuple):
    """What passes an opening from left to right, and its derivatives by the pressure and mass on both sides."""

    flow: float
    by_left_pressure: float
    by_left_mass: float
    by_right_pressure: float
    by_right_mass: float


@kernel
def ambient(gas: Gas) -> Side:
    """The side of ambient gas."""
    return Side(gas.pressure, gas.density, 1.0)


@kernel
def passages(gas: Gas, left: Side, right: Side) -> tuple[Passage, Passage]:
    """Mass and heat per open area from the side of the higher pressure to the other, at the temperature of the first.

    Per unit of mass the heat is that of its source, c_p T = c_p p A/(m R).
    """
    forward = left.pressure >= right.pressure
    source, sink = (left, right) if forward else (right, left)
    flux, by_p, by_p_sink = mass_flux(gas, source.pressure, source.mass / source.area, sink.pressure)
    per_mass = 1.0 / source.mass
    by_m = 0.5 * flux * per_mass
    per_pressure = gas.heat_capacity / gas.constant * source.area * per_mass
    heat = source.pressure * per_pressure
    energy, energy_by_p_sink = flux * heat, by_p_sink * heat
    energy_by_p, energy_by_m = by_p * heat + flux * per_pressure, by_m * heat - energy * per_mass
    if forward:
        return Passage(flux, by_p, by_m, by_p_sink, 0.0), Passage(
            energy, energy_by_p, energy_by_m, energy_by_p_sink, 0.0
        )
    return Passage(-flux, -by_p_sink, 0.0, -by_p, -by_m), Passage(
        -energy, -energy_by_p_sink, 0.0, -energy_by_p, -energy_by_m
    )
