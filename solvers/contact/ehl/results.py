"""What a solved line contact is, in SI units."""

from dataclasses import dataclass
from typing import Literal

from solvers.arrays import FloatArray
from solvers.lubricants import OilInUse
from solvers.notices import Notice

Status = Literal["ok", "ok_with_warnings", "no_solution"]
Stage = Literal["isothermal", "coupling", "heat_balance", "verification"]


@dataclass(frozen=True, slots=True)
class HertzContact:
    """Dry contact: half_width [m], max_pressure [Pa]."""

    half_width: float
    max_pressure: float


@dataclass(frozen=True, slots=True)
class Dimensionless:
    """Moes' load and lubricant parameters, slide-roll ratio (u1 - u2)/um, Peclet numbers u b rho c/(2 lambda)."""

    moes_m: float
    moes_l: float
    slide_roll_ratio: float
    peclet_1: float
    peclet_2: float


@dataclass(frozen=True, slots=True)
class FilmThickness:
    """Film at x = 0, smallest film and where, and the formula of Dowson and Higginson (minimum) [m]."""

    central: float | None
    minimum: float | None
    minimum_at: float | None
    dowson_higginson: float


@dataclass(frozen=True, slots=True)
class ContactPressure:
    """Pressure at x = 0 and its largest value [Pa], its position [m]; the second maximum, if there is one.

    The height of a sharp second maximum depends on the mesh.
    """

    centre: float
    maximum: float
    maximum_at: float
    second_maximum: float | None
    second_maximum_at: float | None


@dataclass(frozen=True, slots=True)
class ContactTemperature:
    """Largest temperatures [K] of film, mid-film and surfaces, positions [m], flash temperatures over bulk [K]."""

    film_max: float
    film_max_at: float
    mid_film_max: float
    mid_film_max_at: float
    surface_1_max: float
    surface_1_max_at: float
    surface_2_max: float
    surface_2_max_at: float
    surface_1_flash: float
    surface_2_flash: float


@dataclass(frozen=True, slots=True)
class ContactFriction:
    """Coefficient from the mid-film stress and those of the two faces [-], magnitudes; power mu w |du| [W/m].

    max_shear_stress and max_pressure_stress (|h dp/dx|) [Pa]; traction_ratio is the largest tau/p where p > p_H/10
    (or a tenth of the largest pressure, where that is less).
    """

    coefficient: float
    coefficient_1: float
    coefficient_2: float
    power: float
    max_shear_stress: float
    max_pressure_stress: float
    traction_ratio: float


@dataclass(frozen=True, slots=True)
class ContactHeat:
    """Heat per length of contact [W/m]; into the surfaces and convected out positive.

    balance_error is relative to generated plus absolute convected heat, or to what passes through one of the surfaces
    where that is more: between surfaces of different temperatures the film conducts heat that it does not generate.
    """

    generated: float
    compression: float
    to_surface_1: float
    to_surface_2: float
    convected: float
    balance_error: float


@dataclass(frozen=True, slots=True)
class MeshError:
    """Estimated error that the mesh leaves in what is reported, relative; temperatures and heat None if isothermal.

    Friction below 0.001 and flash temperatures below 25 K are compared with those. Local maxima (of pressure, shear
    stress, film temperature) have none: where they are sharp, no mesh resolves them.
    """

    central_film: float
    minimum_film: float
    centre_pressure: float
    friction: float
    surface_1_flash: float | None = None
    surface_2_flash: float | None = None
    generated_heat: float | None = None

    @property
    def known(self) -> dict[str, float]:
        """By name, without what an isothermal contact does not have."""
        return {name: value for name in self.__slots__ if (value := getattr(self, name)) is not None}

    @property
    def largest(self) -> float:
        """The largest of them."""
        return max(self.known.values())


@dataclass(frozen=True, slots=True)
class Convergence:
    """Newton steps in all, last changes of P and of temperature [K], load error (relative), nodes of the last mesh.

    `stage` is where it ended; `eyring_stress` [Pa] what continuation reached, where it was tried and failed. A change
    is None where there was none: isothermal, or no step left in the budget. `departure` [K] is what
    `verification.departure` finds in a finished thermal state.
    """

    iterations: int
    pressure_change: float | None
    temperature_change: float | None
    load_error: float
    nodes: int
    stage: Stage
    eyring_stress: float | None
    departure: float | None

    @property
    def residuals(self) -> dict[str, float]:
        """How far an iteration came, by name: what is known of changes of P and of temperature [K], and the load."""
        known = {
            "pressure_change": self.pressure_change,
            "temperature_change": self.temperature_change,
            "load_error": self.load_error,
            "departure": self.departure,
        }
        return {name: value for name, value in known.items() if value is not None}


@dataclass(frozen=True, slots=True)
class ContactCurves:
    """Along the contact, (n,): x [m], pressures [Pa], film [m]; None if isothermal: temperatures [K], heat fluxes.

    Fluxes [W/m^2] are those into the surfaces, linear between the nodes.
    """

    x: FloatArray
    pressure: FloatArray
    hertz_pressure: FloatArray
    film: FloatArray
    shear_stress: FloatArray
    fluid_fraction: FloatArray
    mid_film_temperature: FloatArray | None
    surface_1_temperature: FloatArray | None
    surface_2_temperature: FloatArray | None
    surface_1_heat_flux: FloatArray | None
    surface_2_heat_flux: FloatArray | None


@dataclass(frozen=True, slots=True)
class ContactField:
    """Temperature (n, k) [K] over x (n,) [m] and height over film thickness (k,)."""

    x: FloatArray
    film_fraction: FloatArray
    temperature: FloatArray


@dataclass(frozen=True, kw_only=True)
class Derived(OilInUse):
    """What follows from the inputs before any physics: mean surface speed [m/s], reduced modulus E' [Pa], the oil."""

    entrainment_speed: float
    reduced_modulus: float


@dataclass(frozen=True, slots=True)
class LineContactResult:
    """A lubricated line contact; what was not solved is None, and then status is no_solution."""

    status: Status
    hertz: HertzContact
    dimensionless: Dimensionless
    film: FilmThickness
    pressure: ContactPressure | None
    temperature: ContactTemperature | None
    friction: ContactFriction | None
    heat: ContactHeat | None
    mesh_error: MeshError | None
    convergence: Convergence
    curves: ContactCurves | None
    field: ContactField | None
    derived: Derived
    warnings: tuple[Notice, ...]

    @property
    def residuals(self) -> dict[str, float]:
        """How far a solution without convergence came."""
        return self.convergence.residuals
