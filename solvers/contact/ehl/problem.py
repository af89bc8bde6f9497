"""Constants of one contact: dimensionless groups, published film formulas, and parameters for the kernels."""

from dataclasses import dataclass
from functools import lru_cache
from math import exp, inf, pi, sqrt
from typing import NamedTuple, get_args

from solvers.contact import hertz
from solvers.contact.ehl.inputs import LineContactInputs, Rheology
from solvers.contact.film import dowson_higginson_minimum
from solvers.lubricants import FluidLaws
from solvers.materials import Solid

NO_LOAD = 1e-9  # smaller values of Moes' M count as no load; at this M the film is about 10^18 times as thick as b^2/R


@dataclass(frozen=True, slots=True)
class Groups:
    """Hertzian contact and similarity parameters.

    `reduced_modulus` and `maximum_pressure` are in Pa. `half_width` and `gap_scale` (b^2/R) are in m. `viscosity` is
    the viscosity of the oil at zero pressure [Pa s]. `moes_m` is the load parameter M [-], and `moes_l` is the
    lubricant parameter L [-]. `speed_parameter` is U = eta (u1 + u2)/(E' R) [-].
    """

    reduced_modulus: float
    half_width: float
    maximum_pressure: float
    gap_scale: float
    viscosity: float
    speed_parameter: float
    moes_m: float
    moes_l: float


@lru_cache(maxsize=256)
def groups(inputs: LineContactInputs, temperature: float | None = None) -> Groups:
    """Compute the Hertzian contact and the parameters of Moes (Eq. E2)."""
    contact, lubricant = inputs.contact, inputs.lubricant
    modulus = hertz.reduced_modulus(inputs.surface_1, inputs.surface_2)
    half_width = hertz.half_width(contact.line_load, contact.radius, modulus)
    viscosity = lubricant.viscosity_at(0.0, inputs.temperatures.inlet if temperature is None else temperature)
    speed_parameter = viscosity * 2.0 * contact.entrainment_speed / (modulus * contact.radius)
    load_parameter = contact.line_load / (modulus * contact.radius)
    return Groups(
        reduced_modulus=modulus,
        half_width=float(half_width),
        maximum_pressure=float(hertz.maximum_pressure(contact.line_load, contact.radius, modulus)),
        gap_scale=float(half_width**2 / contact.radius),
        viscosity=viscosity,
        speed_parameter=speed_parameter,
        moes_m=load_parameter / sqrt(speed_parameter),
        moes_l=lubricant.pressure_viscosity * modulus * speed_parameter**0.25,
    )


def entry_temperature(inputs: LineContactInputs) -> float:
    """Temperature [K] expected where the film forms, between mean bulk and inlet temperature.

    The larger the film's Peclet number rho c um h^2/(lambda b), the nearer to the inlet temperature.
    """
    temperatures, oil = inputs.temperatures, inputs.lubricant
    if not inputs.model.thermal:
        return temperatures.inlet
    surfaces = 0.5 * (temperatures.surface_1 + temperatures.surface_2)
    scales = groups(inputs, surfaces)
    gap = moes_gap(scales)
    if gap == inf:
        return temperatures.inlet
    height = gap * scales.gap_scale
    diffusivity = oil.thermal_conductivity / (oil.density * oil.specific_heat)
    peclet = inputs.contact.entrainment_speed * height**2 / (diffusivity * scales.half_width)
    return surfaces + (temperatures.inlet - surfaces) * peclet / (1.0 + peclet)


def moes_central_film(m: float, l: float) -> float:
    """Central film (h/R) U^-1/2 of an isothermal, incompressible line contact [-] (Eq. E3).

    Regression of Nijenbanning and others.
    """
    return _moes_film(l, (3.0 / m, 2.621 * m**-0.2, 1.287 * l ** (2 / 3), 1.311 * m**-0.125 * l**0.75))


def moes_minimum_film(m: float, l: float) -> float:
    """Minimum film (h/R) U^-1/2 of an isothermal, incompressible line contact [-] (Eq. E3).

    Regression of Nijenbanning and others.
    """
    return _moes_film(l, (2.45 / m, 2.05 * m**-0.2, 1.05 * l ** (2 / 3), 0.96 * m**-0.125 * l**0.75))


def _moes_film(l: float, asymptotes: tuple[float, float, float, float]) -> float:
    """Blend four asymptotes: rigid isoviscous, elastic isoviscous, rigid piezoviscous, elastic piezoviscous."""
    rigid_isoviscous, elastic_isoviscous, rigid_piezoviscous, elastic_piezoviscous = asymptotes
    s = (7.0 + 8.0 * exp(-2.0 * elastic_isoviscous / rigid_isoviscous)) / 5.0
    isoviscous = rigid_isoviscous ** (7 / 3) + elastic_isoviscous ** (7 / 3)
    if l <= 0.0:
        return float(isoviscous ** (3 / 7))
    piezoviscous = rigid_piezoviscous**-3.5 + elastic_piezoviscous**-3.5
    return float((isoviscous ** (3 * s / 7) + piezoviscous ** (-2 * s / 7)) ** (1.0 / s))


def moes_gap(contact: Groups) -> float:
    """Film thickness of `moes_central_film` in b^2/R, infinite without load; grades the mesh."""
    if contact.moes_m < NO_LOAD:
        return inf
    return moes_central_film(contact.moes_m, contact.moes_l) * pi / (8.0 * contact.moes_m)


def expected_gap(inputs: LineContactInputs) -> float:
    """Return the expected central film thickness in units of b^2/R, with the viscosity at the entry temperature."""
    return moes_gap(groups(inputs, entry_temperature(inputs)))


def dowson_higginson_film(inputs: LineContactInputs) -> float:
    """Return the minimum film thickness [m] of Dowson and Higginson, with the viscosity at the inlet temperature."""
    contact, scales = inputs.contact, groups(inputs)
    return dowson_higginson_minimum(
        viscosity=scales.viscosity,
        pressure_viscosity=inputs.lubricant.pressure_viscosity,
        mean_speed=contact.entrainment_speed,
        radius=contact.radius,
        line_load=contact.line_load,
        modulus=scales.reduced_modulus,
    )


class Problem(NamedTuple):
    """Constants of a contact for the kernels, in SI units.

    For each surface i, the field `surface_heating_i` is (b/(pi rho_i c_i u_i lambda_i))^1/2 [K m^2/W]. The flash
    temperature of surface i is `surface_heating_i` times Wt q, where Wt is the matrix `Grid.heat` and q is the heat
    flux. `flux_scale` is the unit of mass fluxes, rho0 um b^2/R [kg/(m s)]. `rheology` is the position of the law of
    shear in `inputs.Rheology`.
    """

    laws: FluidLaws
    half_width: float
    maximum_pressure: float
    gap_scale: float
    speed_1: float
    speed_2: float
    eyring_stress: float
    rheology: int
    conductivity: float
    specific_heat: float
    bulk_1: float
    bulk_2: float
    inlet: float
    surface_heating_1: float
    surface_heating_2: float
    flux_scale: float


def problem(inputs: LineContactInputs, scales: Groups) -> Problem:
    """Return the constants of a contact for the kernels."""
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
        rheology=get_args(Rheology).index(inputs.model.rheology),
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
    """Peclet number u b rho c/(2 lambda) of a surface; below about 5 heat also spreads along it [-] (Eq. E11)."""
    return speed * scales.half_width * solid.density * solid.specific_heat / (2.0 * solid.thermal_conductivity)
