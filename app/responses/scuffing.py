"""Scuffing of a gear pair: response of /v1/scuffing."""

from typing import Annotated, ClassVar

from app.responses.gear_mesh import XUE, Values
from app.responses.load_distribution import Gaps, LoadDistributionResponse, ScuffingDerived
from app.responses.oil import OilDerived
from app.schema.base import Group
from app.schema.quantities import Output
from solvers.contact.film import Regime
from solvers.scuffing.safety_results import PointStatus
from solvers.scuffing.thermal.practice import ScuffingRisk

FIG_22 = f"{XUE}, Fig. 22"
FIG_23 = f"{XUE}, Fig. 23"
SCUFFING = "temperatures.scuffing_c"
LIMIT = "safety.scuffing_c"


class ScuffingOilDerived(ScuffingDerived, OilDerived):
    """Load and lengths, and the oil as it enters the contact."""

    held: ClassVar = {ScuffingDerived: "mesh", OilDerived: "oil"}

    kinematic_viscosity_100_mm2_per_s: Annotated[
        float | None, Output("kinematic viscosity used at 100 °C", "ν_100", text="null without grade or data sheet")
    ]
    density_15_kg_per_m3: Annotated[
        float | None, Output("oil density used at 15 °C", "ρ_15", text="null without grade or data sheet")
    ]


class FlashTemperature(Group):
    """Largest flash temperature; thermal EHL values are null in closed form."""

    blok_max_k: Annotated[
        float | None,
        Output(
            "largest flash temperature by Blok",
            "Δθ_fl,B",
            f"{XUE}, Eq. 25",
            text="by Blok; null where a loaded point has none, as all do without a coefficient of friction",
        ),
    ]
    blok_at_psi: Annotated[
        float | None, Output("place of the largest flash by Blok", "Ψ_B", text="where; null without load")
    ]
    thermal_ehl_max_k: Annotated[float | None, Output("largest flash temperature by thermal EHL", "Δθ_fl", FIG_22)]
    thermal_ehl_at_psi: Annotated[float | None, Output("place of the largest flash by thermal EHL", "Ψ_fl")]


class ContactTemperatureResult(Group):
    """Bulk temperature, and the largest contact temperature: bulk plus flash."""

    bulk_c: Annotated[float, Output("bulk temperature used", "θ_M", f"{XUE}, Eq. 16", text="given or estimated")]
    blok_max_c: Annotated[
        float | None,
        Output(
            "contact temperature by Blok",
            "θ_B,max",
            f"{XUE}, Eq. 16",
            text="by Blok; null where a loaded point has none",
            headline=2,
            limit=LIMIT,
            bound="upper",
        ),
    ]
    thermal_ehl_max_c: Annotated[
        float | None,
        Output(
            "contact temperature by thermal EHL",
            "θ_B,max,EHL",
            text="by the thermal EHL solution; null in closed form",
            limit=LIMIT,
            bound="upper",
        ),
    ]


class ThinnestFilm(Group):
    """Thinnest film; null where nothing is loaded."""

    dowson_higginson_min_um: Annotated[
        float | None, Output("thinnest film by Dowson and Higginson", "h_min,DH", f"{XUE}, Eq. 27")
    ]
    thermal_ehl_min_um: Annotated[
        float | None,
        Output("thinnest film by thermal EHL", "h_min", text="by the thermal EHL solution; null in closed form"),
    ]
    min_at_psi: Annotated[float | None, Output("place of the thinnest film", "Ψ_h")]
    thickness_ratio: Annotated[
        float | None,
        Output(
            "specific film thickness",
            "λ",
            f"{XUE}, Eq. 28",
            text="minimum film over the roughness of both flanks",
            headline=3,
            limit=1.0,
            bound="lower",
        ),
    ]
    thickness_regime: Annotated[
        Regime | None,
        Output(
            "lubrication regime", None, XUE, text="below 1 boundary, scuffing probable; to 4 mixed; above full film"
        ),
    ]


class ScuffingSafety(Group):
    """Safety against scuffing."""

    scuffing_c: Annotated[float, Output("scuffing temperature used", "θ_S", text="given or by the scuffing test")]
    verdict: Annotated[
        ScuffingRisk | None,
        Output(
            "risk of scuffing",
            None,
            "ISO/TR 13989-1, from memory",
            text="by Blok's factor: below 1 high, to 2 moderate, above low; null without it",
        ),
    ]
    blok_factor: Annotated[
        float | None,
        Output(
            "scuffing safety by Blok",
            "S_B",
            f"{XUE}, Eq. 26",
            text="scuffing safety by Blok; null where the teeth stay as cool as the oil",
            headline=1,
            needs=SCUFFING,
            verdict="safety.verdict",
            limit=1.0,
            bound="lower",
        ),
    ]
    thermal_ehl_factor: Annotated[
        float | None,
        Output(
            "scuffing safety by thermal EHL",
            "S_B,EHL",
            text="by the thermal EHL solution, whose flanks touch nowhere; null in closed form",
            limit=1.0,
            bound="lower",
        ),
    ]


class ScuffingPathCurves(Group):
    """Along the feature line; what only the thermal EHL solution knows is null in closed form."""

    psi: Annotated[Values, Output("position of the check", "Ψ", text="fraction of the feature line, A1 to E2")]
    status: Annotated[
        list[PointStatus],
        Output(
            "outcome at the point",
            text="outcome at the point; refused: outside the range of the thermal EHL solver",
            axis="psi",
        ),
    ]
    blok_flash_k: Annotated[
        Gaps,
        Output("flash temperature by Blok", "Δθ_fl,B", FIG_22, text="by Blok; null at a base circle", axis="psi"),
    ]
    pinion_flash_k: Annotated[
        Gaps | None, Output("flash temperature of the pinion", "Δθ_fl1", FIG_22, axis="psi", of="thermal")
    ]
    wheel_flash_k: Annotated[
        Gaps | None, Output("flash temperature of the wheel", "Δθ_fl2", FIG_22, axis="psi", of="thermal")
    ]
    dowson_higginson_um: Annotated[
        Gaps,
        Output(
            "film by Dowson and Higginson",
            "h_min,DH",
            FIG_23,
            text="film by Dowson and Higginson; null without load",
            axis="psi",
        ),
    ]
    minimum_film_um: Annotated[Gaps | None, Output("minimum film", "h_min", FIG_23, axis="psi", of="thermal")]
    central_film_um: Annotated[Gaps | None, Output("central film", "h_c", axis="psi", of="thermal")]
    max_pressure_mpa: Annotated[Gaps | None, Output("largest film pressure", "p_max", axis="psi", of="thermal")]
    friction_coefficient: Annotated[Gaps | None, Output("local coefficient of friction", "μ", axis="psi", of="thermal")]
    film_max_temperature_c: Annotated[
        Gaps | None, Output("largest film temperature", "θ_max", axis="psi", of="thermal")
    ]
    thickness_ratio: Annotated[
        Gaps,
        Output(
            "local specific film thickness",
            "λ",
            f"{XUE}, Eq. 28",
            text="film over roughness; null without load",
            axis="psi",
            limit=1.0,
            bound="lower",
        ),
    ]


class ScuffingResponse(LoadDistributionResponse):
    """Load distribution and scuffing check; sections are missing where there is no solution."""

    held: ClassVar = {LoadDistributionResponse: "distribution"}

    flash: Annotated[FlashTemperature | None, Output("flash temperature")] = None
    contact_temperature: Annotated[
        ContactTemperatureResult | None, Output("contact temperature", text="null without an oil or a bulk temperature")
    ] = None
    film: Annotated[
        ThinnestFilm | None, Output("film", text="film thickness; null without an oil or a bulk temperature")
    ] = None
    safety: Annotated[
        ScuffingSafety | None, Output("safety", text="safety factors; null without a scuffing temperature or an oil")
    ] = None
    path: Annotated[ScuffingPathCurves | None, Output("scuffing check along the feature line", detail="curves")] = None
    unsolved_points: Annotated[
        int | None, Output("unsolved points", text="points of the path without a solution or refused")
    ] = None
    derived: Annotated[ScuffingOilDerived | None, Output("load, lengths and oil used")] = None
