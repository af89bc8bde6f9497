"""Results of the scuffing check beside those of the load distribution; SI units, arrays read-only."""

from typing import Literal

from solvers.arrays import FloatArray
from solvers.contact.film import Regime
from solvers.lubricants import OilInUse
from solvers.notices import Notice
from solvers.quantity import quantity, record
from solvers.scuffing.inputs import TR_13989
from solvers.scuffing.results import Derived, LoadDistribution
from solvers.scuffing.thermal.practice import ScuffingRisk
from solvers.sources import XUE

PointStatus = Literal["ok", "ok_with_warnings", "no_solution", "refused", "unloaded"]


@record
class Flash:
    """Largest flash temperature [K] and where; no place without load, no thermal EHL value in closed form.

    Neither is stated where loaded points that may decide have no value.
    """

    blok_max: float | None = quantity(
        "largest flash temperature by Blok",
        "Δθ_fl,B",
        f"{XUE}, Eq. 25",
        unit="k",
        text="by Blok; null where a loaded point has none, as all do without a coefficient of friction",
    )
    blok_at_psi: float | None = quantity("place of the largest flash by Blok", "Ψ_B", text="where; null without load")
    thermal_ehl_max: float | None = quantity(
        "largest flash temperature by thermal EHL", "Δθ_fl", f"{XUE}, Fig. 22", unit="k", default=None
    )
    thermal_ehl_at_psi: float | None = quantity("place of the largest flash by thermal EHL", "Ψ_fl", default=None)
    friction_coefficient: float | None = quantity(
        "mean coefficient of friction of the flash temperature",
        "μ_mB",
        TR_13989,
        text="Blok's; given, or by the oil (ISO/TR 13989-1); null if neither it nor an oil is given",
        default=None,
    )


@record
class ContactTemperature:
    """Bulk temperature t_M and largest contact temperature t_B = t_M + t_f [K] (Eq. 16); None where t_f is."""

    bulk: float = quantity("bulk temperature used", "θ_M", f"{XUE}, Eq. 16", unit="c", text="given or estimated")
    blok_max: float | None = quantity(
        "contact temperature by Blok",
        "θ_B,max",
        f"{XUE}, Eq. 16",
        unit="c",
        text="by Blok; null where a loaded point has none",
    )
    thermal_ehl_max: float | None = quantity(
        "contact temperature by thermal EHL",
        "θ_B,max,EHL",
        unit="c",
        text="by the thermal EHL solution; null in closed form",
        default=None,
    )


@record
class Film:
    """Thinnest film [m], where, and against roughness; None if no point is loaded, or one without a film may decide."""

    dowson_higginson_min: float | None = quantity(
        "thinnest film by Dowson and Higginson", "h_min,DH", f"{XUE}, Eq. 27", unit="um", default=None
    )
    min_at_psi: float | None = quantity("place of the thinnest film", "Ψ_h", default=None)
    thickness_ratio: float | None = quantity(
        "specific film thickness",
        "λ",
        f"{XUE}, Eq. 28",
        text="minimum film over the roughness of both flanks",
        default=None,
    )
    thickness_regime: Regime | None = quantity(
        "lubrication regime",
        None,
        XUE,
        text="below 1 boundary, scuffing probable; to 4 mixed; above full film",
        default=None,
    )
    thermal_ehl_min: float | None = quantity(
        "thinnest film by thermal EHL",
        "h_min",
        unit="um",
        text="by the thermal EHL solution; null in closed form",
        default=None,
    )


@record
class Safety:
    """Safety factor against scuffing (Eq. 26); None where teeth stay as cool as the oil, or the temperature is unknown.

    `scuffing` is the temperature it is against [K]; `verdict` the standard's risk by Blok's factor.
    """

    scuffing: float = quantity("scuffing temperature used", "θ_S", unit="c", text="given or by the scuffing test")
    blok_factor: float | None = quantity(
        "safety factor (flash temperature method)",
        "S_B",
        f"{XUE}, Eq. 26",
        text="scuffing safety by Blok; null where the teeth stay as cool as the oil",
    )
    thermal_ehl_factor: float | None = quantity(
        "safety factor (thermal EHL)",
        "S_B,EHL",
        text="by the thermal EHL solution, whose flanks touch nowhere; null in closed form",
        default=None,
    )
    verdict: ScuffingRisk | None = quantity(
        "risk of scuffing",
        None,
        "ISO/TR 13989-1, quoted, not verified against the standard",
        text="by Blok's factor: below 1 high, to 2 moderate, above low; null without it",
        default=None,
    )


@record
class ScuffingDerived:
    """What follows for mesh and oil, if any, as it enters the contact; where a sheet gives it nu at 100 C, rho at 15 C.

    kinematic_viscosity_100 [m^2/s], density_15 [kg/m^3].
    """

    mesh: Derived
    oil: OilInUse | None
    kinematic_viscosity_100: float | None = quantity(
        "kinematic viscosity used at 100 °C", "ν_100", unit="mm2_per_s", text="null without grade or data sheet"
    )
    density_15: float | None = quantity(
        "oil density used at 15 °C", "ρ_15", unit="kg_per_m3", text="null without grade or data sheet"
    )
    lubricant_factor: float | None = quantity(
        "lubricant factor of the scuffing test used", "X_L", TR_13989, text="null without a scuffing test"
    )


@record
class ThermalPath:
    """Point by point: status, flash temperatures of both flanks [K], films [m], pressure [Pa], friction, film [K].

    What was not solved is NaN. A point refused because its load is too light has bounds instead: it is no hotter
    (flash_bound [K]) and its film no thinner (film_bound [m]) than under the lightest load that the solver takes.
    """

    status: tuple[PointStatus, ...]
    warnings: tuple[Notice, ...]
    flash_bound: FloatArray
    film_bound: FloatArray
    pinion_flash: FloatArray = quantity(
        "flash temperature of the pinion", "Δθ_fl1", f"{XUE}, Fig. 22", unit="k", axis="psi", gaps=True
    )
    wheel_flash: FloatArray = quantity(
        "flash temperature of the wheel", "Δθ_fl2", f"{XUE}, Fig. 22", unit="k", axis="psi", gaps=True
    )
    minimum_film: FloatArray = quantity("minimum film", "h_min", f"{XUE}, Fig. 23", unit="um", axis="psi", gaps=True)
    central_film: FloatArray = quantity("central film", "h_c", unit="um", axis="psi", gaps=True)
    max_pressure: FloatArray = quantity("largest film pressure", "p_max", unit="mpa", axis="psi", gaps=True)
    friction_coefficient: FloatArray = quantity("local coefficient of friction", "μ", axis="psi", gaps=True)
    film_max_temperature: FloatArray = quantity("largest film temperature", "θ_max", unit="c", axis="psi", gaps=True)


@record
class ScuffingPath:
    """Along the feature line: Blok's flash temperature [K], film [m] and its ratio to roughness.

    psi is equidistant but for the places where Blok's flash temperature is largest and the film of the formula
    thinnest. Where nothing is loaded or nothing moves the status is "unloaded", film and ratio are NaN and Blok's flash
    temperature is 0; where the reduced radius vanishes under load it is "refused" and all is NaN. `thermal` is None in
    closed form; points that it did not solve are "no_solution", those it would not take "refused". The thickness ratio
    is that of its film if there is one.
    """

    psi: FloatArray = quantity("position of the check", "Ψ", text="fraction of the feature line, A1 to E2")
    status: tuple[PointStatus, ...] = quantity(
        "outcome at the point",
        text="outcome at the point; refused: outside the range of the thermal EHL solver",
        axis="psi",
    )
    blok_flash: FloatArray = quantity(
        "flash temperature by Blok",
        "Δθ_fl,B",
        f"{XUE}, Fig. 22",
        unit="k",
        text="by Blok; null at a base circle",
        axis="psi",
        gaps=True,
    )
    dowson_higginson: FloatArray = quantity(
        "film by Dowson and Higginson",
        "h_min,DH",
        f"{XUE}, Fig. 23",
        unit="um",
        text="film by Dowson and Higginson; null without load",
        axis="psi",
        gaps=True,
    )
    thickness_ratio: FloatArray = quantity(
        "local specific film thickness",
        "λ",
        f"{XUE}, Eq. 28",
        text="film over roughness; null without load",
        axis="psi",
        gaps=True,
    )
    thermal: ThermalPath | None = None


@record(kw_only=True)
class Scuffing:
    """The scuffing check on a load distribution; `safety` is None without a scuffing temperature.

    Without an oil, contact temperature, film and safety are None.
    `warnings` are those of the load distribution and of the check.
    """

    distribution: LoadDistribution
    flash: Flash = quantity("flash temperature")
    contact_temperature: ContactTemperature | None = quantity(
        "contact temperature", text="null without an oil or a bulk temperature"
    )
    film: Film | None = quantity("film", text="film thickness; null without an oil or a bulk temperature")
    safety: Safety | None = quantity("safety", text="safety factors; null without a scuffing temperature or an oil")
    path: ScuffingPath = quantity("scuffing check along the feature line", detail="curves")
    derived: ScuffingDerived = quantity("load, lengths and oil used")
    warnings: tuple[Notice, ...]
    unsolved_points: int = quantity("unsolved points", text="points of the path without a solution or refused")
