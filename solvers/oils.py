"""Oils as their data sheets describe them, and the lubricant they are at the temperature where they enter a contact."""

from dataclasses import dataclass
from math import log, log10

from solvers.errors import InvalidInput
from solvers.lubricants import Lubricant, OilKind, PressureViscosityLaw
from solvers.viscosity_index import SQUARE_MILLIMETRE, viscosity_index

CELSIUS = 273.15  # K
WALTHER_SHIFT = 0.7  # mm^2/s
DENSITY_TEMPERATURE = 15.0 + CELSIUS  # K
THERMAL_EXPANSION = 0.00065  # 1/K
LEAST_VISCOSITY_100 = 1e-6  # m^2/s; ASTM D341 has further terms for oils as thin as that
VISCOSITY_INDICES = (-100.0, 500.0)  # naphthenic and aromatic oils reach -100, silicone oils 400
LARGEST_VISCOSITY = 0.1  # m^2/s; an oil that thick hardly flows, and the law does not know where it sets

TYPICAL_VISCOSITY_100 = {
    32: 5.4e-6,
    46: 6.8e-6,
    68: 8.7e-6,
    100: 11.2e-6,
    150: 14.8e-6,
    220: 19.0e-6,
    320: 24.2e-6,
    460: 30.6e-6,
    680: 38.8e-6,
}
"""Kinematic viscosity at 100 C [m^2/s] of a mineral oil of an ISO 3448 grade with viscosity index 95."""


@dataclass(frozen=True, slots=True)
class KindOfOil:
    """What a data sheet rarely says: Gold's s [1/GPa at 1 mm^2/s] and t, density at 15 C, heat, conductivity (SI)."""

    pressure_viscosity_scale: float
    pressure_viscosity_exponent: float
    density_15: float
    specific_heat: float
    thermal_conductivity: float


KINDS: dict[OilKind, KindOfOil] = {
    "mineral": KindOfOil(9.904, 0.1390, 880.0, 2000.0, 0.14),
    "pao": KindOfOil(7.382, 0.1335, 840.0, 2150.0, 0.15),
    "ester": KindOfOil(6.605, 0.1360, 950.0, 2000.0, 0.15),
    "polyglycol": KindOfOil(5.489, 0.1485, 1030.0, 2000.0, 0.17),
}


_THICK, _THIN = "lubricant.kinematic_viscosity_40", "lubricant.kinematic_viscosity_100"


@dataclass(frozen=True, slots=True)
class OilSheet:
    """An oil by its data sheet; what is None follows from the kind of oil or from the viscosities.

    Units: kinematic viscosities at 40 C and 100 C [m^2/s], density at 15 C [kg/m^3]; the others as in `Lubricant`.
    """

    kinematic_viscosity_40: float
    kinematic_viscosity_100: float
    kind: OilKind = "mineral"
    density_15: float | None = None
    pressure_viscosity: float | None = None
    temperature_viscosity: float | None = None
    specific_heat: float | None = None
    thermal_conductivity: float | None = None
    pressure_viscosity_law: PressureViscosityLaw = "roelands"
    compressible: bool = True

    def __post_init__(self) -> None:
        """Raise InvalidInput for viscosities that no oil has: out_of_range, viscosity_order, viscosity_index."""
        thick, thin, field = self.kinematic_viscosity_40, self.kinematic_viscosity_100, _THIN
        if not thin >= LEAST_VISCOSITY_100:
            raise InvalidInput("out_of_range", "the oil needs at least 1 mm²/s at 100 °C", field)
        if not thin < thick:
            raise InvalidInput("viscosity_order", "the oil must be thinner at 100 °C than at 40 °C", field)
        index, (least, largest) = viscosity_index(thick, thin), VISCOSITY_INDICES
        if not least <= index <= largest:
            message = (
                f"{thick / SQUARE_MILLIMETRE:.4g} and {thin / SQUARE_MILLIMETRE:.4g} mm²/s at 40 and 100 °C make a "
                f"viscosity index of {index:.3g}; oils have {least:g} to {largest:g}: check both viscosities"
            )
            raise InvalidInput("viscosity_index", message, field)

    def kinematic_viscosity(self, temperature: float) -> float:
        """Kinematic viscosity [m^2/s] at a temperature [K] by the Walther law through both points (ASTM D341) (Eq. R1).

        Raises InvalidInput oil_too_thick beyond 10^5 mm^2/s.
        """
        logarithm = self._logarithm(temperature)
        if logarithm > log10(LARGEST_VISCOSITY / SQUARE_MILLIMETRE):
            message = (
                f"by its viscosities at 40 and 100 °C the oil would have 10^{logarithm:.1f} mm²/s at "
                f"{temperature - CELSIUS:.4g} °C; beyond 10^5 it hardly flows: give a warmer oil or a thinner one"
            )
            raise InvalidInput("oil_too_thick", message, _THICK)
        return float(10.0**logarithm - WALTHER_SHIFT) * SQUARE_MILLIMETRE

    @property
    def reference_density(self) -> float:
        """Density at 15 C [kg/m^3], that of the kind where the sheet does not give it."""
        return KINDS[self.kind].density_15 if self.density_15 is None else self.density_15

    def density(self, temperature: float) -> float:
        """Rho_15 [1 - 0.00065 (t - 15 C)] [kg/m^3] (Eq. R3)."""
        return self.reference_density * (1.0 - THERMAL_EXPANSION * (temperature - DENSITY_TEMPERATURE))

    def viscosity(self, temperature: float) -> float:
        """Eta = nu rho [Pa s] (Eq. R3)."""
        return self.kinematic_viscosity(temperature) * self.density(temperature)

    def temperature_coefficient(self, temperature: float) -> float:
        """Beta = -d ln eta/dt [1/K]: what the Walther law and the density say there, unless the sheet gives it.

        Eq. R4.
        """
        if self.temperature_viscosity is not None:
            return self.temperature_viscosity
        viscosity = self.kinematic_viscosity(temperature) / SQUARE_MILLIMETRE
        _, slope = self._walther()
        thinning = log(10.0) * (1.0 + WALTHER_SHIFT / viscosity) * self._logarithm(temperature) * slope / temperature
        expansion = THERMAL_EXPANSION / (1.0 - THERMAL_EXPANSION * (temperature - DENSITY_TEMPERATURE))
        return float(thinning + expansion)

    def pressure_coefficient(self, temperature: float) -> float:
        """Alpha = s nu^t [1/Pa], nu in mm^2/s (Gold), unless the sheet gives it (Eq. R4)."""
        if self.pressure_viscosity is not None:
            return self.pressure_viscosity
        kind = KINDS[self.kind]
        thickness = self.kinematic_viscosity(temperature) / SQUARE_MILLIMETRE
        return float(kind.pressure_viscosity_scale * thickness**kind.pressure_viscosity_exponent) * 1e-9

    def lubricant(self, temperature: float) -> Lubricant:
        """The lubricant with this temperature [K] as its reference."""
        kind = KINDS[self.kind]
        return Lubricant(
            viscosity=self.viscosity(temperature),
            reference_temperature=temperature,
            pressure_viscosity=self.pressure_coefficient(temperature),
            temperature_viscosity=self.temperature_coefficient(temperature),
            density=self.density(temperature),
            specific_heat=kind.specific_heat if self.specific_heat is None else self.specific_heat,
            thermal_conductivity=(
                kind.thermal_conductivity if self.thermal_conductivity is None else self.thermal_conductivity
            ),
            pressure_viscosity_law=self.pressure_viscosity_law,
            compressible=self.compressible,
            kind=self.kind,
        )

    def _walther(self) -> tuple[float, float]:
        """A and B of log10 log10 (nu + 0.7) = A - B log10 T through both points, nu in mm^2/s, T in kelvin."""
        cold, hot = 40.0 + CELSIUS, 100.0 + CELSIUS
        thick = _double_logarithm(self.kinematic_viscosity_40)
        thin = _double_logarithm(self.kinematic_viscosity_100)
        slope = (thick - thin) / (log10(hot) - log10(cold))
        return thick + slope * log10(cold), slope

    def _logarithm(self, temperature: float) -> float:
        """log10 (nu + 0.7) at a temperature [K]."""
        intercept, slope = self._walther()
        return float(10.0 ** (intercept - slope * log10(temperature)))


def iso_vg(grade: int) -> OilSheet:
    """A mineral oil of viscosity index 95 of an ISO 3448 grade (its viscosity at 40 C in mm^2/s)."""
    return OilSheet(grade * SQUARE_MILLIMETRE, TYPICAL_VISCOSITY_100[grade])


def lubricant_at(oil: Lubricant | OilSheet, temperature: float) -> Lubricant:
    """The lubricant of a contact that the oil enters at this temperature [K]; one given by its viscosity stays."""
    return oil.lubricant(temperature) if isinstance(oil, OilSheet) else oil


def _double_logarithm(kinematic_viscosity: float) -> float:
    return log10(log10(kinematic_viscosity / SQUARE_MILLIMETRE + WALTHER_SHIFT))
