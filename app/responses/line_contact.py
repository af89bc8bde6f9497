"""One lubricated line contact: response of /v1/scuffing/line-contact."""

from typing import Annotated, Literal

from app.quantities import Output
from app.responses.common import Group, Response

XUE = "Xue 2020"


class HertzContact(Group):
    """The dry contact."""

    half_width_mm: Annotated[float, Output("half width", "b")]
    max_pressure_mpa: Annotated[
        float, Output("largest pressure", "p_H", f"{XUE}, Eq. 14 without its π/4", si="maximum_pressure")
    ]


class ContactNumbers(Group):
    """Dimensionless numbers."""

    moes_m: Annotated[float, Output("load parameter of Moes", "M", "Moes 1992")]
    moes_l: Annotated[float, Output("lubricant parameter of Moes", "L", "Moes 1992")]
    slide_roll_ratio: Annotated[float, Output("sliding over mean speed", "SRR")]
    peclet_1: Annotated[float, Output("Péclet number of surface 1", "Pe_1")]
    peclet_2: Annotated[float, Output("Péclet number of surface 2", "Pe_2")]


class FilmThickness(Group):
    """Film thickness; null without a solution, but for the formula."""

    central_um: Annotated[float | None, Output("at x = 0", "h_c", f"{XUE}, Eq. 21")]
    minimum_um: Annotated[float | None, Output("smallest", "h_min", f"{XUE}, Eq. 21")]
    dowson_higginson_um: Annotated[
        float, Output("smallest by formula", "h_min", f"Dowson and Higginson; {XUE}, Eq. 27")
    ]


class FilmPressure(Group):
    """Pressure in the film."""

    centre_mpa: Annotated[float, Output("at x = 0", "p(0)", f"{XUE}, Eq. 17")]
    maximum_mpa: Annotated[float, Output("largest; a sharp second maximum depends on the mesh", "p_max", XUE)]
    maximum_at_mm: Annotated[float, Output("where it is largest", "x")]


class FilmTemperature(Group):
    """Temperatures."""

    film_max_c: Annotated[float, Output("largest in the film", "t_max", f"{XUE}, Eq. 23")]
    surface_1_max_c: Annotated[float, Output("largest of surface 1", "t_1", f"{XUE}, Eq. 24")]
    surface_2_max_c: Annotated[float, Output("largest of surface 2", "t_2", f"{XUE}, Eq. 24")]
    surface_1_flash_k: Annotated[float, Output("flash temperature of surface 1")]
    surface_2_flash_k: Annotated[float, Output("flash temperature of surface 2")]


class FilmFriction(Group):
    """Friction."""

    coefficient: Annotated[float, Output("coefficient of friction, a magnitude", "μ")]
    power_w_per_mm: Annotated[float, Output("sliding power per length of contact")]
    max_shear_stress_mpa: Annotated[float, Output("largest shear stress", "τ")]


class FilmHeat(Group):
    """Heat per length of contact; into the surfaces and convected out positive."""

    generated_w_per_mm: Annotated[float, Output("by shear")]
    compression_w_per_mm: Annotated[float, Output("by compression, added")]
    to_surface_1_w_per_mm: Annotated[float, Output("into surface 1")]
    to_surface_2_w_per_mm: Annotated[float, Output("into surface 2")]
    convected_w_per_mm: Annotated[float, Output("carried out by the oil")]
    balance_error: Annotated[
        float,
        Output("what is missing, over generated plus absolute convected heat, or over what one surface takes if more"),
    ]


class ContactConvergence(Group):
    """How the iteration ended."""

    iterations: Annotated[int, Output("Newton steps in all")]
    pressure_change: Annotated[
        float | None, Output("last change of the pressure over the Hertz pressure; null if no step could be taken")
    ]
    temperature_change_k: Annotated[
        float | None, Output("last change of temperature; null if isothermal or no step could be taken")
    ]
    load_error: Annotated[float, Output("relative error of the load")]
    nodes: Annotated[int, Output("nodes of the last mesh")]
    stage: Annotated[
        Literal["isothermal", "coupling", "heat_balance", "verification"],
        Output("where it ended: the isothermal film, film and temperatures, the books on heat, the check of the state"),
    ]
    eyring_stress_mpa: Annotated[
        float | None, Output("Eyring stress that a continuation without solution reached; null where none was tried")
    ]
    departure_k: Annotated[
        float | None,
        Output("what an independent check of the finished temperatures finds, at most 0.1; null if isothermal"),
    ]


class MeshErrors(Group):
    """Estimated error that the mesh leaves, relative; small friction and flash temperatures over 0.001 and 25 K."""

    central_film: Annotated[float, Output("of the film at x = 0")]
    minimum_film: Annotated[float, Output("of the smallest film")]
    centre_pressure: Annotated[float, Output("of the pressure at x = 0")]
    friction: Annotated[float, Output("of the coefficient of friction")]
    surface_1_flash: Annotated[float | None, Output("of the flash temperature of surface 1; null if isothermal")]
    surface_2_flash: Annotated[float | None, Output("of the flash temperature of surface 2; null if isothermal")]
    generated_heat: Annotated[float | None, Output("of the heat by shear; null if isothermal")]


class ContactCurves(Group):
    """Along the contact; temperatures are null if isothermal."""

    x_mm: Annotated[list[float], Output("position along the flow", "x")]
    pressure_mpa: Annotated[list[float], Output("pressure in the film", "p")]
    hertz_pressure_mpa: Annotated[list[float], Output("dry pressure")]
    film_um: Annotated[list[float], Output("film thickness", "h")]
    mid_film_temperature_c: Annotated[list[float] | None, Output("in the middle of the film")]
    surface_1_temperature_c: Annotated[list[float] | None, Output("of surface 1")]
    surface_2_temperature_c: Annotated[list[float] | None, Output("of surface 2")]
    surface_1_heat_flux_w_per_mm2: Annotated[list[float] | None, Output("heat flux into surface 1", "q_1", XUE)]
    surface_2_heat_flux_w_per_mm2: Annotated[list[float] | None, Output("heat flux into surface 2", "q_2", XUE)]


class ContactField(Group):
    """Temperature in the film, indexed [x][film fraction]."""

    x_mm: Annotated[list[float], Output("position along the flow", "x")]
    film_fraction: Annotated[list[float], Output("height over film thickness from surface 1")]
    temperature_c: Annotated[list[list[float]], Output("temperature")]


class LineContactResponse(Response):
    """A lubricated line contact; what was not solved is null."""

    hertz: Annotated[HertzContact | None, Output("the dry contact")] = None
    dimensionless: Annotated[ContactNumbers | None, Output("dimensionless numbers")] = None
    film: Annotated[FilmThickness | None, Output("film thickness")] = None
    pressure: Annotated[FilmPressure | None, Output("pressure")] = None
    temperature: Annotated[FilmTemperature | None, Output("temperatures; null if isothermal")] = None
    friction: Annotated[FilmFriction | None, Output("friction")] = None
    heat: Annotated[FilmHeat | None, Output("heat; null if isothermal")] = None
    mesh_error: Annotated[MeshErrors | None, Output("estimated error of the mesh; null where it is not known")] = None
    convergence: Annotated[ContactConvergence | None, Output("how the iteration ended")] = None
    curves: Annotated[ContactCurves | None, Output("along the contact", detail="curves")] = None
    field: Annotated[ContactField | None, Output("temperature in the film", detail="fields")] = None
