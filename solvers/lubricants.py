"""Lubricants, and the laws of viscosity and density as functions of pressure and temperature."""

from collections.abc import Iterator
from dataclasses import dataclass, fields
from functools import cached_property
from math import exp, log
from typing import Any, Literal, NamedTuple

import numpy as np

from solvers.compiled import kernel
from solvers.errors import InvalidInput
from solvers.notices import Notice, unusual_value
from solvers.quantity import described, quantity, record
from solvers.sources import XUE

PressureViscosityLaw = Literal["roelands", "barus"]
OilKind = Literal["mineral", "pao", "ester", "polyglycol"]

HIGHEST_VISCOSITY = 1e4  # Pa s at zero pressure; no oil flows at this viscosity
# Chosen limits; a value beyond its limit is unusual.
THICK_OIL = 1.0  # Pa s at operating temperature
HOTTEST = 403.15  # K, of oil and teeth; at this temperature mineral oils age within days
COLDEST_OIL = 243.15  # K; below the pour point of most gear oils

ROELANDS_PRESSURE = 5.1e-9  # 1/Pa
ROELANDS_LOG_VISCOSITY = 9.67  # -ln(6.31e-5); the viscosity at the pole is 6.31e-5 Pa s
ROELANDS_POLE_TEMPERATURE = 138.0  # K


@record(slots=False)
class Lubricant:
    """A lubricating oil.

    The default values describe the oil of Xue, Zhang and Wang at 360 K. (Two tables of their paper are numbered 2; the
    values are from the second of these tables.) An incompressible oil has the same density at every pressure and
    temperature. The fields have no ranges, because the models also create `Lubricant` objects themselves, for any
    temperature. Where the API asks users for these values, the API declares ranges.
    """

    viscosity: float = quantity(
        "oil viscosity",
        "η_0",
        f"{XUE}, Table 2",
        unit="pa_s",
        default=0.08,
        text="viscosity at the reference temperature and no pressure",
    )
    reference_temperature: float = quantity(
        "oil reference temperature",
        "θ_0",
        f"{XUE}, Eq. 20",
        unit="c",
        default=86.85,
        tolerance=1,
        text="temperature of viscosity and density",
        assumed="86.85 °C (360 K), where the paper's viscosity gives its film; give that of your oil",
    )
    pressure_viscosity: float = quantity(
        "pressure-viscosity coefficient", "α", f"{XUE}, Table 2", unit="per_gpa", default=21.9
    )
    temperature_viscosity: float = quantity(
        "temperature-viscosity coefficient",
        "β",
        f"{XUE}, Table 2",
        unit="per_k",
        default=0.042,
        tolerance=0.001,
    )
    density: float = quantity(
        "oil density",
        "ρ_0",
        f"{XUE}, Table 2",
        unit="kg_per_m3",
        default=870.0,
        text="density at the reference temperature",
        assumed="the paper's oil",
    )
    specific_heat: float = quantity("oil specific heat", "c_oil", f"{XUE}, Table 2", unit="j_per_kg_k", default=2000.0)
    thermal_conductivity: float = quantity(
        "oil thermal conductivity", "λ_oil", f"{XUE}, Table 2", unit="w_per_m_k", default=0.14
    )
    pressure_viscosity_law: PressureViscosityLaw = quantity(
        "pressure-viscosity law",
        None,
        f"{XUE}, Table 2",
        default="roelands",
        text="how viscosity depends on pressure and temperature",
        advanced=True,
    )
    compressible: bool = quantity(
        "compressible oil",
        None,
        f"{XUE}, Table 2",
        default=True,
        text="whether density follows pressure and temperature (Dowson and Higginson)",
        advanced=True,
    )
    kind: OilKind = described(
        "Base oil; only the lubricant factors of friction laws and scuffing test depend on it.", default="mineral"
    )
    viscosity_index: float | None = described("Viscosity index; reported, not used [-].", default=None)

    @cached_property
    def laws(self) -> "FluidLaws":
        """Constants of the viscosity and density laws, for the compiled functions."""
        a1 = log(self.viscosity) + ROELANDS_LOG_VISCOSITY
        return FluidLaws(
            log_viscosity=log(self.viscosity),
            reference_temperature=float(self.reference_temperature),
            pressure_viscosity=float(self.pressure_viscosity),
            temperature_viscosity=float(self.temperature_viscosity),
            a1=a1,
            pressure_exponent=self.pressure_viscosity / (ROELANDS_PRESSURE * a1) if a1 > 0.0 else 0.0,
            temperature_exponent=(
                self.temperature_viscosity * (self.reference_temperature - ROELANDS_POLE_TEMPERATURE) / a1
                if a1 > 0.0
                else 0.0
            ),
            roelands=int(self.pressure_viscosity_law == "roelands"),
            density=float(self.density),
            pressure_density=0.6e-9 * self.compressible,
            thermal_expansion=0.00065 * self.compressible,
        )

    def viscosity_at(self, pressure: float, temperature: float) -> float:
        """Viscosity [Pa s] at pressure [Pa] and temperature [K]; InvalidInput `viscosity_range` above 10^4 Pa s."""
        laws = self.laws
        logarithm = float(log_viscosity(laws, pressure_part(laws, 0.0)[0], temperature)[0])
        if not logarithm < log(HIGHEST_VISCOSITY):
            message = (
                f"at {temperature:g} K the law of the oil gives a viscosity of 10^{logarithm / log(10.0):.2g} Pa s, "
                f"but the largest permissible viscosity is {HIGHEST_VISCOSITY:g} Pa s; bring the temperatures nearer "
                "to the reference temperature, or lower the temperature-viscosity coefficient"
            )
            raise InvalidInput("viscosity_range", message, "lubricant.temperature_viscosity")
        if pressure != 0.0:
            logarithm = float(log_viscosity(laws, pressure_part(laws, pressure)[0], temperature)[0])
        return exp(logarithm)

    def density_at(self, pressure: float, temperature: float) -> float:
        """Return the density [kg/m^3] at pressure [Pa] and temperature [K]."""
        return float(density(self.laws, pressure, temperature)[0])


@dataclass(frozen=True, kw_only=True)
class OilInUse:
    """The properties of a lubricant that a result reports."""

    viscosity: float = quantity(
        "oil viscosity used", "η_0", unit="pa_s", text="at the reference temperature", equation="R3"
    )
    reference_temperature: float = quantity("oil reference temperature used", "θ_0", unit="c", equation="practice#oils")
    pressure_viscosity: float = quantity("pressure-viscosity coefficient used", "α", unit="per_gpa", equation="R4")
    temperature_viscosity: float = quantity("temperature-viscosity coefficient used", "β", unit="per_k", equation="R4")
    density: float = quantity("oil density used", "ρ_0", unit="kg_per_m3", equation="R3")
    specific_heat: float = quantity("oil specific heat used", "c_oil", unit="j_per_kg_k", equation="R4")
    thermal_conductivity: float = quantity("oil thermal conductivity used", "λ_oil", unit="w_per_m_k", equation="R4")
    viscosity_index: float | None = quantity(
        "viscosity index used", "VI", "ASTM D2270", text="null without grade or data sheet", equation="R2"
    )


def oil_in_use(lubricant: Lubricant) -> dict[str, Any]:
    """Return the properties of the lubricant under the names of the fields of `OilInUse`."""
    return {item.name: getattr(lubricant, item.name) for item in fields(OilInUse)}


class FluidLaws(NamedTuple):
    """Constants of the viscosity and density laws of one oil, in SI units."""

    log_viscosity: float
    reference_temperature: float
    pressure_viscosity: float
    temperature_viscosity: float
    a1: float
    pressure_exponent: float
    temperature_exponent: float
    roelands: int
    density: float
    pressure_density: float
    thermal_expansion: float


@kernel
def pressure_part(laws: FluidLaws, pressure: float) -> tuple[float, float]:
    """Pressure term of ln eta and its derivative; a negative pressure (in iterations) counts as zero (Eq. 20).

    Roelands: A1 (1 + 5.1e-9 p)^Z, Z = alpha/(5.1e-9 A1), A1 = ln eta_0 + 9.67. Barus: alpha p.
    """
    p = max(pressure, 0.0)
    if laws.roelands == 1:
        base = 1.0 + ROELANDS_PRESSURE * p
        value = laws.a1 * base**laws.pressure_exponent
        slope = value * laws.pressure_exponent * ROELANDS_PRESSURE / base
    else:
        value = laws.pressure_viscosity * p
        slope = laws.pressure_viscosity
    if pressure < 0.0:
        slope = 0.0
    return value, slope


@kernel
def log_viscosity(laws: FluidLaws, pressure_term: float, temperature: float) -> tuple[float, float, float]:
    """Logarithm of the viscosity and its derivatives (Eq. 20).

    Roelands: ln eta = ln eta_0 + A1 {-1 + (1 + 5.1e-9 p)^Z [(t - 138)/(t_0 - 138)]^-S0}, S0 = beta (t_0 - 138)/A1. The
    paper prints S0 = beta/(A1 (t_0 - 138)), of the wrong unit; only this form gives -d ln eta/dt = beta at t_0. Barus
    and Reynolds: ln eta = ln eta_0 + alpha p - beta (t - t_0).
    """
    if laws.roelands == 1:
        above_pole = temperature - ROELANDS_POLE_TEMPERATURE
        ratio = above_pole / (laws.reference_temperature - ROELANDS_POLE_TEMPERATURE)
        factor = np.exp(-laws.temperature_exponent * np.log(ratio))
        part = pressure_term * factor
        return laws.log_viscosity - laws.a1 + part, factor, -laws.temperature_exponent * part / above_pole
    heating = temperature - laws.reference_temperature
    value = laws.log_viscosity + pressure_term - laws.temperature_viscosity * heating
    return value, 1.0, -laws.temperature_viscosity


@kernel
def density(laws: FluidLaws, pressure: float, temperature: float) -> tuple[float, float, float]:
    """Density by Dowson and Higginson and its derivatives by pressure and temperature (Eq. 19).

    In kg/m^3, Pa and K; a negative pressure counts as zero.
    """
    p = max(pressure, 0.0)
    base = 1.0 + 1.7e-9 * p
    heating = temperature - laws.reference_temperature
    value = laws.density * (1.0 + laws.pressure_density * p / base - laws.thermal_expansion * heating)
    slope = laws.density * laws.pressure_density / base**2 if pressure > 0.0 else 0.0
    return value, slope, -laws.density * laws.thermal_expansion


def thick_oil(viscosity: float | None, field: str = "lubricant.viscosity") -> Iterator[Notice]:
    """Warn if the viscosity [Pa s] of the oil at its operating temperature is unusually high."""
    if viscosity is not None and viscosity > THICK_OIL:
        yield unusual_value(
            field,
            f"a viscosity of {viscosity:.4g} Pa s at operating temperature is unusually high; was a value entered in "
            "the wrong unit (mPa s)?",
        )


def oil_temperature(temperature: float, field: str = "temperatures.oil") -> Iterator[Notice]:
    """Warn if an oil temperature [K] is too high or too low for gear oils in service."""
    yield from hotter_than_gears(temperature, field)
    if temperature < COLDEST_OIL:
        shown = f"{temperature - 273.15:g} °C"
        yield unusual_value(
            field, f"a temperature of {shown} is unusually low for an oil in service; is the sign right?"
        )


def hotter_than_gears(temperature: float, field: str) -> Iterator[Notice]:
    """Warn if a temperature [K] of oil or teeth is too high for gears in service."""
    if temperature > HOTTEST:
        shown = f"{temperature - 273.15:g} °C"
        yield unusual_value(
            field,
            f"a temperature of {shown} is unusually high for gears in service; was a value entered in degrees "
            "Fahrenheit?",
        )


def hot_oil(oil: float, bulk: float | None) -> Iterator[Notice]:
    """Warn if the oil temperature [K] is higher than the temperature `bulk` [K] of the teeth."""
    if bulk is not None and oil > bulk:
        message = f"the oil at {oil - 273.15:g} °C is hotter than the teeth at {bulk - 273.15:g} °C"
        message += "; were the two temperatures exchanged?"
        yield unusual_value("temperatures.oil", message)
