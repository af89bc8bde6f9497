"""What the scuffing check adds to a load distribution; SI units, read-only arrays, temperatures in kelvin."""

from dataclasses import dataclass
from typing import Literal

from solvers.arrays import FloatArray
from solvers.contact.film import Regime
from solvers.lubricants import OilInUse
from solvers.notices import Notice
from solvers.scuffing.results import Derived, LoadDistribution
from solvers.scuffing.thermal.practice import ScuffingRisk

PointStatus = Literal["ok", "ok_with_warnings", "no_solution", "refused", "unloaded"]


@dataclass(frozen=True, slots=True)
class Flash:
    """Largest flash temperature [K] and where; no place without load, no thermal EHL value in closed form.

    Neither is stated where loaded points that may decide have no value.
    """

    blok_max: float | None
    blok_at_psi: float | None
    thermal_ehl_max: float | None = None
    thermal_ehl_at_psi: float | None = None


@dataclass(frozen=True, slots=True)
class ContactTemperature:
    """Bulk temperature t_M and largest contact temperature t_B = t_M + t_f [K] (Eq. 16); None where t_f is."""

    bulk: float
    blok_max: float | None
    thermal_ehl_max: float | None = None


@dataclass(frozen=True, slots=True)
class Film:
    """Thinnest film [m], where, and against roughness; None if no point is loaded, or one without a film may decide."""

    dowson_higginson_min: float | None = None
    min_at_psi: float | None = None
    thickness_ratio: float | None = None
    thickness_regime: Regime | None = None
    thermal_ehl_min: float | None = None


@dataclass(frozen=True, slots=True)
class Safety:
    """Safety against scuffing (Eq. 26); None where the teeth stay as cool as the oil, or the temperature is unknown.

    `scuffing` is the temperature it is against [K]; `verdict` the standard's risk by Blok's factor.
    """

    scuffing: float
    blok_factor: float | None
    thermal_ehl_factor: float | None = None
    verdict: ScuffingRisk | None = None


@dataclass(frozen=True, slots=True)
class ScuffingDerived:
    """What follows for mesh and oil, if any, as it enters the contact; where a sheet gives it nu at 100 C, rho at 15 C.

    kinematic_viscosity_100 [m^2/s], density_15 [kg/m^3].
    """

    mesh: Derived
    oil: OilInUse | None
    kinematic_viscosity_100: float | None
    density_15: float | None


@dataclass(frozen=True, slots=True)
class ThermalPath:
    """Point by point: status, flash temperatures of both flanks [K], films [m], pressure [Pa], friction, film [K].

    What was not solved is NaN. A point refused because its load is too light has bounds instead: it is no hotter
    (flash_bound [K]) and its film no thinner (film_bound [m]) than under the lightest load that the solver takes.
    """

    status: tuple[PointStatus, ...]
    warnings: tuple[Notice, ...]
    flash_bound: FloatArray
    film_bound: FloatArray
    pinion_flash: FloatArray
    wheel_flash: FloatArray
    minimum_film: FloatArray
    central_film: FloatArray
    max_pressure: FloatArray
    friction_coefficient: FloatArray
    film_max_temperature: FloatArray


@dataclass(frozen=True, slots=True)
class ScuffingPath:
    """Along the feature line: Blok's flash temperature [K], film [m] and its ratio to roughness.

    psi is equidistant but for the places where Blok's flash temperature is largest and the film of the formula
    thinnest. Where nothing is loaded or nothing moves the status is "unloaded", film and ratio are NaN and Blok's flash
    temperature is 0; where the reduced radius vanishes under load it is "refused" and all is NaN. `thermal` is None in
    closed form; points that it did not solve are "no_solution", those it would not take "refused". The thickness ratio
    is that of its film if there is one.
    """

    psi: FloatArray
    status: tuple[PointStatus, ...]
    blok_flash: FloatArray
    dowson_higginson: FloatArray
    thickness_ratio: FloatArray
    thermal: ThermalPath | None = None


@dataclass(frozen=True, kw_only=True, slots=True)
class Scuffing:
    """The scuffing check on a load distribution; `safety` is None without a scuffing temperature.

    Without an oil, contact temperature, film and safety are None.
    `warnings` are those of the load distribution and of the check.
    """

    distribution: LoadDistribution
    flash: Flash
    contact_temperature: ContactTemperature | None
    film: Film | None
    safety: Safety | None
    path: ScuffingPath
    derived: ScuffingDerived
    warnings: tuple[Notice, ...]
    unsolved_points: int
