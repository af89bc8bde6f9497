"""The numbers of one contact as the compiled functions take them."""

from math import pi, sqrt
from typing import NamedTuple

from solvers.contact.ehl.dimensionless import Groups
from solvers.contact.ehl.inputs import LineContactInputs
from solvers.lubricants import FluidLaws
from solvers.materials import Solid


class Problem(NamedTuple):
    """SI; surface_heating_i = (b / (pi rho_i c_i u_i lambda_i))^1/2 [K m^2/W] turns Wt q into a flash temperature.

    `flux_scale` is rho0 um b^2/R; `newtonian` and `thermal` are 0 or 1.
    """

    laws: FluidLaws
    half_width: float
    maximum_pressure: float
    gap_scale: float
    speed_1: float
    speed_2: float
    eyring_stress: float
    newtonian: int
    conductivity: float
    specific_heat: float
    bulk_1: float
    bulk_2: float
    inlet: float
    surface_heating_1: float
    surface_heating_2: float
    flux_scale: float


def problem(inputs: LineContactInputs, scales: Groups) -> Problem:
    """Gather the constants of a contact."""
    contact, oil, temperatures = inputs.contact, inputs.lubricant, inputs.temperatures
    thermal = inputs.model.thermal
    return Problem(
        laws=oil.laws,
        half_width=scales.half_width,
        maximum_pressure=scales.maximum_pressure,
        gap_scale=scales.gap_scale,
        speed_1=float(contact.speed_1),
        speed_2=float(contact.speed_2),
        eyring_stress=float(inputs.model.eyring_stress),
        newtonian=int(inputs.model.rheology == "newtonian"),
        conductivity=float(oil.thermal_conductivity),
        specific_heat=float(oil.specific_heat),
        bulk_1=float(temperatures.surface_1),
        bulk_2=float(temperatures.surface_2),
        inlet=float(temperatures.inlet),
        surface_heating_1=_surface_heating(inputs.surface_1, contact.speed_1, scales) if thermal else 0.0,
        surface_heating_2=_surface_heating(inputs.surface_2, contact.speed_2, scales) if thermal else 0.0,
        flux_scale=oil.density * contact.entrainment_speed * scales.gap_scale,
    )


def _surface_heating(solid: Solid, speed: float, scales: Groups) -> float:
    effusivity_squared = solid.density * solid.specific_heat * solid.thermal_conductivity
    return sqrt(scales.half_width / (pi * effusivity_squared * speed))


def peclet_number(solid: Solid, speed: float, scales: Groups) -> float:
    """Pe = u b rho c / (2 lambda) [-]; below about 5 heat also spreads along the surface."""
    return speed * scales.half_width * solid.density * solid.specific_heat / (2.0 * solid.thermal_conductivity)
