"""Results of a line contact, in SI units."""

from dataclasses import dataclass, fields
from typing import Literal

from solvers.arrays import FloatArray
from solvers.lubricants import OilInUse
from solvers.notices import Notice
from solvers.quantity import described, quantity, record
from solvers.sources import XUE

Status = Literal["ok", "ok_with_warnings", "no_solution"]
Stage = Literal["isothermal", "coupling", "heat_balance", "verification"]


@record(equation="E1")
class HertzContact:
    """Half width and largest pressure of the dry contact."""

    half_width: float = quantity("half width of the contact", "b", unit="mm")
    max_pressure: float = quantity("Hertzian pressure", "p_H", f"{XUE}, Eq. 14 without its π/4", unit="mpa")


@record(equation="E2")
class Dimensionless:
    """Dimensionless numbers of the contact: Moes' parameters, slide-roll ratio (u1 - u2)/um and Peclet numbers."""

    moes_m: float = quantity("load parameter of Moes", "M", "Moes 1992")
    moes_l: float = quantity("lubricant parameter of Moes", "L", "Moes 1992")
    slide_roll_ratio: float = quantity(
        "slide-roll ratio", "SRR", text="sliding over mean speed", equation="line-contact#hertz-contact-and-similarity"
    )
    peclet_1: float = quantity("Péclet number of surface 1", "Pe_1", equation="E11")
    peclet_2: float = quantity("Péclet number of surface 2", "Pe_2", equation="E11")


@record(equation="Xue 21")
class FilmThickness:
    """Central and minimum film thickness, and the minimum by the formula of Dowson and Higginson."""

    central: float | None = quantity(
        "central film thickness", "h_c", f"{XUE}, Eq. 21", unit="um", text="film thickness at x = 0"
    )
    minimum: float | None = quantity("minimum film thickness", "h_min", f"{XUE}, Eq. 21", unit="um")
    minimum_at: float | None
    dowson_higginson: float = quantity(
        "film thickness by Dowson and Higginson",
        "h_min,DH",
        "Dowson and Higginson; Xue 2020, Eq. 27",
        unit="um",
        text="minimum film by formula",
    )


@record(equation="E7")
class ContactPressure:
    """Pressure in the film; the height of a sharp second maximum depends on the numerical mesh."""

    centre: float = quantity("pressure in the centre", "p(0)", f"{XUE}, Eq. 17", unit="mpa", text="pressure at x = 0")
    maximum: float = quantity(
        "largest film pressure",
        "p_max",
        XUE,
        unit="mpa",
        text="largest pressure in the film; the height of a sharp spike depends on the mesh",
    )
    maximum_at: float = quantity("place of the largest pressure", "x_p,max", unit="mm")
    second_maximum: float | None
    second_maximum_at: float | None


@record(equation="Xue 24")
class ContactTemperature:
    """Largest temperatures of the film, of the middle of the film and of both surfaces [K].

    The position [m] of each largest temperature is also stated. The flash temperature [K] of a surface is the largest
    temperature of the surface minus the bulk temperature of the surface.
    """

    film_max: float = quantity("largest film temperature", "θ_max", f"{XUE}, Eq. 23", unit="c", equation="E8")
    film_max_at: float
    mid_film_max: float
    mid_film_max_at: float
    surface_1_max: float = quantity("largest temperature of surface 1", "θ_1,max", f"{XUE}, Eq. 24", unit="c")
    surface_1_max_at: float
    surface_2_max: float = quantity("largest temperature of surface 2", "θ_2,max", f"{XUE}, Eq. 24", unit="c")
    surface_2_max_at: float
    surface_1_flash: float = quantity("flash temperature of surface 1", "Δθ_1", unit="k")
    surface_2_flash: float = quantity("flash temperature of surface 2", "Δθ_2", unit="k")


@record(equation="E9")
class ContactFriction:
    """Sliding power, and coefficients of friction from the stress in the middle of the film and at both surfaces.

    The sliding power is mu w |du| per length of contact. `max_pressure_stress` is the largest |h dp/dx| [Pa].
    `traction_ratio` is the largest ratio of shear stress to pressure. Nodes with a low pressure do not count: the
    pressure must exceed a tenth of p_H, or a tenth of the largest pressure if this pressure is less than p_H.
    """

    coefficient: float = quantity("coefficient of friction", "μ", text="coefficient of friction, a magnitude")
    coefficient_1: float
    coefficient_2: float
    power: float = quantity("sliding power", "P", unit="w_per_mm", text="sliding power per length of contact")
    max_shear_stress: float = quantity("largest shear stress", "τ_max", unit="mpa")
    max_pressure_stress: float
    traction_ratio: float


@record(equation="E10")
class ContactHeat:
    """Heat per length of contact [W/m]; heat that enters a surface or leaves with the oil is positive.

    `balance_error` is the error of the heat balance divided by a reference. The reference is the largest of three
    values: the generated heat plus the absolute value of the convected heat, and the heats through both surfaces.
    """

    generated: float = quantity("heat of shear", "q_s", unit="w_per_mm", text="heat generated by shear")
    compression: float = quantity(
        "heat of compression", "q_c", unit="w_per_mm", text="net heat that compression adds to the film"
    )
    to_surface_1: float = quantity("heat into surface 1", "q_1", unit="w_per_mm")
    to_surface_2: float = quantity("heat into surface 2", "q_2", unit="w_per_mm")
    convected: float = quantity("heat carried out by the oil", "q_o", unit="w_per_mm")
    balance_error: float = quantity(
        "heat balance error",
        text=(
            "unbalanced heat, relative to the heat generated and convected, or to what one surface "
            "takes if that is more"
        ),
    )


@record(equation="line-contact#numerics")
class MeshError:
    """Estimated relative errors of the results due to the numerical mesh.

    If the contact is isothermal, the errors of flash temperatures and heat are None. If the coefficient of friction is
    below 0.001, its error is relative to 0.001. If a flash temperature is below 25 K, its error is relative to 25 K.
    The largest values of pressure, shear stress and film temperature have no estimate, because no mesh resolves a
    sharp maximum.
    """

    central_film: float = quantity("mesh error of the central film", text="of the film at x = 0")
    minimum_film: float = quantity("mesh error of the minimum film")
    centre_pressure: float = quantity("mesh error of the centre pressure", text="of the pressure at x = 0")
    friction: float = quantity("mesh error of friction", text="of the coefficient of friction")
    surface_1_flash: float | None = quantity(
        "mesh error of flash temperature 1", text="of surface 1; null if isothermal", default=None
    )
    surface_2_flash: float | None = quantity(
        "mesh error of flash temperature 2", text="of surface 2; null if isothermal", default=None
    )
    generated_heat: float | None = quantity(
        "mesh error of the heat", text="heat by shear; null if isothermal", default=None
    )

    @property
    def estimates(self) -> dict[str, float]:
        """Errors by name; errors that are None are left out."""
        return {item.name: value for item in fields(self) if (value := getattr(self, item.name)) is not None}

    @property
    def largest(self) -> float:
        """Largest of the errors."""
        return max(self.estimates.values())


@record(equation="line-contact#numerics")
class Convergence:
    """How the iteration ended: number of Newton steps, last changes of pressure and temperature, and load error.

    The change of pressure is divided by the Hertzian pressure; the load error is relative to the load. Both changes are
    None if no Newton step was allowed. The change of temperature is also None if the contact is isothermal.

    `stage` is the last stage of the iteration. `eyring_stress` [Pa] has a value only if the solver increased the Eyring
    stress from a low value towards the given value, and failed before the given value. It is then the largest Eyring
    stress with a solution, or 0 if there was no solution. `departure` [K] is the largest error of the temperatures in
    a finished thermal state.
    """

    iterations: int = quantity("Newton steps", text="Newton steps in all")
    pressure_change: float | None = quantity(
        "last change of pressure",
        text="change of pressure in the last step, relative to the Hertzian pressure; null if no step succeeded",
    )
    temperature_change: float | None = quantity(
        "last change of temperature",
        "Δθ",
        unit="k",
        text="change of temperature in the last step; null if isothermal or if no step succeeded",
    )
    load_error: float = quantity("load error", text="relative error of the load")
    nodes: int = quantity("nodes in use", text="nodes of the last mesh")
    stage: Stage = quantity(
        "last stage",
        text=(
            "stage at which the iteration ended: isothermal film, film with temperatures, heat "
            "balance, or check of the solution"
        ),
    )
    eyring_stress: float | None = quantity(
        "Eyring stress reached",
        "τ_0",
        unit="mpa",
        text="Eyring stress at which stepwise continuation ended without a solution; null if it was not tried",
    )
    departure: float | None = quantity(
        "departure of the finished state",
        "Δθ_check",
        unit="k",
        text=(
            "what an independent check of the solved temperatures still finds; up to 0.1 is "
            "accepted; null if isothermal"
        ),
        equation="E12",
    )

    @property
    def residuals(self) -> dict[str, float]:
        """Errors that remained when the iteration ended, by the names of their fields.

        Fields that are None are left out.
        """
        errors = {
            "pressure_change": self.pressure_change,
            "temperature_change": self.temperature_change,
            "load_error": self.load_error,
            "departure": self.departure,
        }
        return {name: value for name, value in errors.items() if value is not None}


@record
class ContactCurves:
    """Curves along the contact (n,); temperatures and heat fluxes are None if the contact is isothermal.

    A heat flux is positive if heat enters the surface. The heat fluxes vary linearly between the nodes.
    """

    x: FloatArray = quantity("position along the flow", "x", unit="mm")
    pressure: FloatArray = quantity("film pressure", "p", unit="mpa", text="pressure in the film", axis="x")
    hertz_pressure: FloatArray = quantity("dry pressure", "p_dry", unit="mpa", axis="x")
    film: FloatArray = quantity("film thickness", "h", unit="um", axis="x")
    shear_stress: FloatArray
    fluid_fraction: FloatArray
    mid_film_temperature: FloatArray | None = quantity("mid-film temperature", "θ_mid", unit="c", axis="x")
    surface_1_temperature: FloatArray | None = quantity("temperature of surface 1", "θ_1", unit="c", axis="x")
    surface_2_temperature: FloatArray | None = quantity("temperature of surface 2", "θ_2", unit="c", axis="x")
    surface_1_heat_flux: FloatArray | None = quantity(
        "heat flux into surface 1", "q_1", XUE, unit="w_per_mm2", axis="x"
    )
    surface_2_heat_flux: FloatArray | None = quantity(
        "heat flux into surface 2", "q_2", XUE, unit="w_per_mm2", axis="x"
    )


@record
class ContactField:
    """Temperature (n, k) as a function of the position along the contact (n,) and the height in the film (k,)."""

    x: FloatArray = quantity("position along the flow", "x", unit="mm")
    film_fraction: FloatArray = quantity("height in the film", "z/h", text="height over film thickness from surface 1")
    temperature: FloatArray = quantity("temperature in the film", "θ", unit="c", axis=("x", "film_fraction"))


@dataclass(frozen=True, kw_only=True)
class Derived(OilInUse):
    """Mean surface speed, reduced modulus and properties of the oil, which follow from the inputs alone."""

    entrainment_speed: float = quantity("mean surface speed", "u_m", XUE, unit="m_per_s", equation="Xue 18")
    reduced_modulus: float = quantity("reduced modulus", "E'", XUE, unit="gpa", equation="E1")


@record
class LineContactResult:
    """Results of a lubricated line contact.

    If the contact has no solution, `status` is no_solution, and the results that need a solution are None.
    """

    status: Status = described("Outcome of the calculation.")
    hertz: HertzContact = quantity("dry contact")
    dimensionless: Dimensionless = quantity("dimensionless numbers")
    film: FilmThickness = quantity("film")
    pressure: ContactPressure | None = quantity("pressure")
    temperature: ContactTemperature | None = quantity("temperatures", text="temperatures; null if isothermal")
    friction: ContactFriction | None = quantity("friction")
    heat: ContactHeat | None = quantity("heat", text="heat; null if isothermal")
    mesh_error: MeshError | None = quantity(
        "estimated mesh error", text="estimated relative error due to the mesh; null if unknown"
    )
    convergence: Convergence = quantity("convergence", text="how the iteration ended")
    curves: ContactCurves | None = quantity("along the contact", detail="curves")
    field: ContactField | None = quantity("film map", text="temperature in the film", detail="fields")
    derived: Derived = quantity("speed and modulus used")
    warnings: tuple[Notice, ...]

    @property
    def residuals(self) -> dict[str, float]:
        """Errors that remained when the iteration ended (see `Convergence.residuals`)."""
        return self.convergence.residuals
