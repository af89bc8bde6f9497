"""What is said of the answers about scuffing: components, views, verdicts, remarks, and what files take back."""

from typing import Any, NamedTuple

from app.figures.wording import number
from app.models.card import Beside, FileResult, FromFile, ScuffingPaths, Verdict, Words
from app.models.load_distribution.words import (
    LOAD_DISTRIBUTION,
    MESH,
    NOT_OF_A_MESH,
    OF_TWO_HELICES,
    SCUFFING_DERIVED,
    carrying,
    of_helix,
    unloaded,
)
from app.schema.answers import Response, component, group, named
from app.schema.quantities import View
from solvers.heat_balance import results as heat
from solvers.heat_balance.notices import KNOWN_WITHIN
from solvers.lubricants import OilInUse
from solvers.scuffing import safety_results as results
from solvers.scuffing.load_factors.results import LoadFactors
from solvers.scuffing.micropitting import results as film_results
from solvers.scuffing.standard import results as standard_results
from solvers.scuffing.thermal.practice import scuffing_risk

OPTIONAL_CHAPTERS = {"micropitting": "micropitting", "heat": "heat-balance"}
ABOVE_ONE = View(limit=1.0, bound="lower")

named(
    MicropittingTestFilm=film_results.FilmOfTest,
    MicropittingResult=film_results.Micropitting,
    FlankWear=film_results.Wear,
    GearHeat=heat.GearTemperatures,
    BearingHeatBalance=heat.BearingHeat,
    FlowOfHeat=heat.HeatFlow,
    HeatSuppliedRemoved=heat.Balance,
    BulkByStandards=heat.BulkEstimates,
    BandOfHeat=heat.HeatBand,
    HeatBalanceResult=heat.Heat,
    FlashTemperature=results.Flash,
    StandardLoadFactors=LoadFactors,
    StandardFlashPoint=standard_results.FlashPoint,
)
component(film_results.LocalPoint, "LocalFilmPoint", safety=ABOVE_ONE)
component(
    film_results.LocalFilm,
    safety=View(limit=1.0, bound="lower", needs="micropitting.failure_load_stage", verdict=".verdict"),
)
component(film_results.StandardPoint, "StandardFilmPoint", safety=ABOVE_ONE)
component(film_results.StandardFilm, safety=ABOVE_ONE)
component(standard_results.FlashMethod, safety=ABOVE_ONE)
component(standard_results.IntegralMethod, safety=ABOVE_ONE, load_safety=ABOVE_ONE)
component(
    results.ContactTemperature,
    "ContactTemperatureResult",
    blok_max=View(headline=2, limit="safety.scuffing_c", bound="upper"),
    thermal_ehl_max=View(limit="safety.scuffing_c", bound="upper"),
)
component(
    results.Film,
    "ThinnestFilm",
    thickness_ratio=View(headline=3, limit=1.0, bound="lower", verdict=".thickness_regime"),
)
component(
    results.Safety,
    "ScuffingSafety",
    blok_factor=View(
        headline=1,
        limit=1.0,
        bound="lower",
        needs="temperatures.scuffing_c",
        verdict=".verdict",
        band="heat.band.safety",
    ),
    feature_line_factor=View(limit=1.0, bound="lower"),
    thermal_ehl_factor=View(limit=1.0, bound="lower"),
)
component(
    results.ScuffingPath,
    "ScuffingPathCurves",
    results.ThermalPath,
    thickness_ratio=View(limit=1.0, bound="lower"),
)
HEATED_FLANK = group(results.HeatedFlank, "HeatedFlankFields")
DERIVED = group(results.ScuffingDerived, "ScuffingOilDerived", OilInUse, results.BulkInForce, base=SCUFFING_DERIVED)

SCUFFING = group(
    results.Scuffing,
    "ScuffingResponse",
    base=LOAD_DISTRIBUTION,
    fields={"flank": HEATED_FLANK | None, "derived": DERIVED},
)

LEVEL_OF_MICROPITTING = {"micropitting is likely": "bad", "limited margin": "near", "micropitting is unlikely": "good"}
BULK_BY = {
    "given": "given",
    "estimated": "estimated",
    "between": "between estimate and heat balance",
    "heat_balance": "by the heat balance",
}
NOT_VALIDATED = "not_validated"
KNOWN = f"known to about ±{KNOWN_WITHIN:g} K"


def how_well_known(response: Response, *paths: str) -> dict[str, str]:
    """Return the remark that the temperatures at the `paths` are uncertain, unless a gear temperature was measured."""
    return dict.fromkeys(paths, KNOWN) if NOT_VALIDATED in {notice.code for notice in response.warnings} else {}


LEVEL_OF_RISK = {"high": "bad", "moderate": "near", "low": "good"}


def risk_of_scuffing(safety: float, band: list[float] | None, symbol: str = "S_B") -> Verdict:
    """Judge a safety factor in the words of ISO/TS 6336-20, at the worse end of its band: the first sentence."""
    worst = min(band) if band else safety
    risk, least = scuffing_risk(worst), f", at worst {number(worst)}" if band else ""
    return Verdict(LEVEL_OF_RISK[risk], f"{risk.capitalize()} risk of scuffing: {symbol} {number(safety)}{least}.")


def tile_of_scuffing(path: str, safety: float | None, band: list[float] | None) -> dict[str, Verdict]:
    """Judge the safety factor at `path` on its tile; empty without a safety factor."""
    if safety is None:
        return {}
    worst = min(band) if band else safety
    risk = scuffing_risk(worst)
    text = f"at worst {number(worst)}: {risk}" if band else f"{risk} risk of scuffing"
    return {path: Verdict(LEVEL_OF_RISK[risk], text)}


def without_risk(response: Any, bulk: float | None, hottest: float | None) -> Verdict:
    """Say why an answer has no safety factor, in the order in which inputs are missing: the first sentence."""
    codes, reached = {warning.code for warning in response.warnings}, ""
    if bulk is None:
        why = "no oil" if "no_oil" in codes else "no bulk temperature"
    elif response.safety is None:
        why = "no scuffing temperature"
        reached = f" The contact reaches {number(hottest, '°C')}." if hottest is not None else ""
    elif hottest is None or "unsolved_points" in codes:
        why = "the contact temperature is not known everywhere"
    else:
        why = "no contact is hotter than the oil"
    return Verdict("plain", f"No verdict: {why}.{reached}")


def band_of(response: Any) -> list[float] | None:
    """Return the ends of the safety factor that the heat balance leaves open; None if there is no band."""
    band = response.heat.band if response.heat is not None else None
    return band.safety if band is not None else None


def risk_of_micropitting(response: Any) -> Verdict | None:
    """Judge the safety factor against micropitting; None if it is not asked for or not known."""
    local = response.micropitting.local if response.micropitting is not None else None
    if local is None or local.safety is None:
        return None
    level = LEVEL_OF_MICROPITTING[local.verdict]
    return Verdict(
        level, f"Micropitting: S_λ {number(local.safety)}, {local.verdict.removeprefix('micropitting is ')}."
    )


def verdict(response: Any) -> Verdict:
    """Judge scuffing, and micropitting where it is asked for; the worse of both gives the level."""
    if idle := unloaded(response):
        return idle
    factor, contact = _factor(response), response.contact_temperature
    if factor is not None:
        first = risk_of_scuffing(factor, band_of(response))
    else:
        bulk, hottest = (None, None) if contact is None else (contact.bulk_c, contact.blok_max_c)
        first = without_risk(response, bulk, hottest)
    return with_micropitting(first, response)


def by_standard(safety: Any, own: float | None, of: str = "") -> str:
    """Return the safety factors of the standard, and whether it alone says that the pair scuffs; else nothing."""
    standard = safety.standard if safety is not None else None
    methods = () if standard is None else (("20", "flash", standard.flash), ("21", "integral", standard.integral))
    found = [(part, name, each.safety) for part, name, each in methods if each is not None and each.safety is not None]
    if not found:
        return ""
    parts = " and ".join(f"-{part}" for part, _, _ in found)
    factors = " and ".join(f"{number(factor)} ({name})" for _, name, factor in found)
    is_stricter = (own is None or own >= 1.0) and min(factor for _, _, factor in found) < 1.0
    end = ": by the standard it scuffs" if is_stricter else ""
    return f"By ISO/TS 6336{parts} the safety factor{of} is {factors}{end}."


def conclusion(response: Any) -> str:
    """Say what the standard finds beside the local verdict."""
    return by_standard(response.safety, _factor(response))


def _factor(response: Any) -> float | None:
    """Return the safety factor against scuffing; None if the answer has none."""
    factor: float | None = response.safety.blok_factor if response.safety is not None else None
    return factor


def with_micropitting(first: Verdict, response: Any) -> Verdict:
    """Return the verdict with that on micropitting behind it; the worse of both gives the level."""
    second = risk_of_micropitting(response)
    if second is None:
        return first
    worse = max(first.level, second.level, key=("plain", "good", "near", "bad").index)
    return Verdict(worse, f"{first.text} {second.text}")


def verdicts(response: Any) -> dict[str, Verdict]:
    """Judge the safety factor; say what carries, and how the bulk temperature came about."""
    return {
        **tile_of_scuffing(_SAFETY, _factor(response), band_of(response)),
        _LOAD: Verdict("plain", carrying(response.load)),
        _BULK: Verdict("plain", BULK_BY[response.derived.bulk_method]),
    }


def remarks(response: Any) -> dict[str, str]:
    """Say how well the bulk temperature is known."""
    return how_well_known(response, "contact_temperature.bulk_c")


def belongs(response: Any) -> dict[str, str]:
    """Name the helix to which the headline numbers belong."""
    return of_helix(response, _SAFETY, _HOTTEST, _FILM, _LOAD, _BULK, _PITTING)


LOAD_RESULTS = (
    FileResult("load.face_load_factor", "face_load_factor_contact_stress", "none"),
    FileResult("load.max_line_load_n_per_mm", "maximum_line_load", "N / mm"),
)
MICROPITTING_RESULTS = (
    FileResult("micropitting.permissible_ratio", "permissible_specific_film_thickness_micropitting", "none"),
    FileResult("micropitting.local.least_ratio", "minimum_specific_film_thickness_micropitting", "none"),
    FileResult("micropitting.local.safety", "micropitting_safety", "none"),
    FileResult("micropitting.local.verdict", "micropitting_risk", "none"),
    FileResult("micropitting.standard.safety", "micropitting_safety_method_b", "none"),
    FileResult("wear.pinion_max_um_per_million", "maximum_wear_pinion_per_million_revolutions", "mum"),
    FileResult("wear.wheel_max_um_per_million", "maximum_wear_wheel_per_million_revolutions", "mum"),
)
"""Results about micropitting.

These results need the failure load stage of a micropitting test. REXS has no attribute for this load stage, so the user
enters the load stage on the page of the calculation.
"""


class LocalPaths(NamedTuple):
    """Paths of local values that stand beside those of the standard; empty where an answer has no such value."""

    dynamic_factor: str
    bulk: str
    largest_flash: str
    contact: str
    limit: str
    safety: str


WHY_SCUFFING_DIFFERS = (
    "They differ because the local check takes the computed load of every place with its modifications, the bulk "
    "temperature in force and X_L of the test at 90 °C, while the standard has one load for the whole face, raised by "
    "K_v, K_Hα and K_Hβ, a load sharing that knows no relief, flooded flanks and X_L at the oil temperature; the "
    "integral method compares means."
)
WHY_MICROPITTING_DIFFERS = (
    "They differ because method A takes the computed load of every place and the bulk temperature in force, while "
    "method B has seven points of a load that is even over the face, raised by K_v, K_Hα and K_Hβ, and its own bulk "
    "temperature."
)


def beside(local: LocalPaths, *, of: str = "", at: str = "", unless: str = "") -> tuple[Beside, Beside]:
    """Return the tables of scuffing and of micropitting, local and by the standard.

    `of` stands behind the check in the titles; the results stand at the path `at`. Not shown where `unless` is there.
    """
    standard, film = f"{at}safety.standard", f"{at}micropitting.standard"
    flash, integral, own = f"{standard}.flash", f"{standard}.integral", f"{at}micropitting.local"
    face = f"{at}load.face_load_factor"
    scuffing = (
        ("face load factor", (face, *[f"{standard}.factors.face_load_factor"] * 2)),
        ("dynamic factor", (local.dynamic_factor, *[f"{standard}.factors.dynamic_factor"] * 2)),
        (
            "coefficient of friction",
            (f"{at}flash.friction_coefficient", f"{flash}.friction_coefficient", f"{integral}.friction_coefficient"),
        ),
        ("bulk temperature", (local.bulk, f"{flash}.bulk_c", f"{integral}.bulk_c")),
        ("largest flash temperature", (local.largest_flash, f"{flash}.max_flash_k", "")),
        ("mean flash temperature", ("", f"{flash}.mean_flash_k", f"{integral}.mean_flash_k")),
        ("contact or integral temperature", (local.contact, f"{flash}.contact_c", f"{integral}.integral_c")),
        ("scuffing temperature", (local.limit, f"{flash}.scuffing_c", f"{integral}.scuffing_c")),
        ("safety factor", (local.safety, f"{flash}.safety", f"{integral}.safety")),
    )
    micropitting = (
        ("face load factor", (face, f"{film}.factors.face_load_factor")),
        ("dynamic factor", (local.dynamic_factor, f"{film}.factors.dynamic_factor")),
        ("coefficient of friction", (f"{own}.friction_coefficient", f"{film}.friction_coefficient")),
        ("bulk temperature", (local.bulk, f"{film}.bulk_c")),
        ("least specific film thickness", (f"{own}.least_ratio", f"{film}.least_ratio")),
        ("safety factor", (f"{own}.safety", f"{film}.safety")),
    )
    return (
        Beside(
            f"Scuffing{of}: local and by the standard",
            ("local", "ISO/TS 6336-20, flash", "ISO/TS 6336-21, integral"),
            scuffing,
            WHY_SCUFFING_DIFFERS,
            standard,
            unless,
            "no_standard_flash",
        ),
        Beside(
            f"Micropitting{of}: local and by the standard",
            ("local, method A", "ISO/TR 15144-1, method B"),
            micropitting,
            WHY_MICROPITTING_DIFFERS,
            film,
            unless,
            "no_standard_film",
        ),
    )


LOCAL = LocalPaths(
    dynamic_factor="inputs.load.dynamic_factor",
    bulk="contact_temperature.bulk_c",
    largest_flash="flash.blok_max_k",
    contact="contact_temperature.blok_max_c",
    limit="safety.scuffing_c",
    safety="safety.blok_factor",
)

_SAFETY, _HOTTEST, _FILM = "safety.blok_factor", "contact_temperature.blok_max_c", "film.thickness_ratio"
_LOAD, _BULK, _PITTING = "load.face_load_factor", "contact_temperature.bulk_c", "micropitting.local.safety"

WORDS = Words(
    verdict=verdict,
    verdicts=verdicts,
    conclusion=conclusion,
    tiles=(_LOAD, _BULK, _PITTING),
    touches={
        "low_peclet": (_SAFETY, _HOTTEST),
        "bulk_lower_bound": (_SAFETY, _HOTTEST, _FILM, _BULK, _PITTING),
        "losses_overestimated": (_SAFETY, _HOTTEST, _FILM, _BULK, _PITTING),
        "measured_contradiction": (_SAFETY, _HOTTEST, _FILM, _BULK, _PITTING),
        "micropitting_temperature": (_PITTING,),
        "micropitting_range": (_PITTING,),
        "unsolved_points": (_FILM,),
        "edge_load": (_LOAD,),
        "thin_tip": (),
    },
    remarks=remarks,
    belongs=belongs,
    chapters=OPTIONAL_CHAPTERS | OF_TWO_HELICES,
    losses=("friction_loss.power_w",),
    scuffing=ScuffingPaths("contact_temperature.blok_max_c", "safety.scuffing_c"),
    of_the_film=frozenset({"film.min_at_psi", "film.thickness_ratio", "unsolved_points"}),
    beside=beside(LOCAL),
    from_file=FromFile(
        MESH | {"temperatures", "lubricant"},
        unknown=NOT_OF_A_MESH,
        renamed={"scuffing.application_factor": "load.application_factor"},
    ),
    to_file=(
        FileResult("helix.share", "share", "none"),
        *LOAD_RESULTS,
        FileResult("load.contact_fraction", "contact_pattern_fraction", "none"),
        FileResult("pressure.max_mpa", "maximum_hertzian_pressure", "MPa"),
        FileResult("transmission_error.peak_to_peak_um", "transmission_error_peak_to_peak", "mum"),
        FileResult("friction_loss.coefficient", "mean_coefficient_of_friction", "none"),
        FileResult("friction_loss.power_w", "mesh_power_loss", "W"),
        FileResult("flash.blok_max_k", "maximum_flash_temperature_blok", "K"),
        FileResult("flash.thermal_ehl_max_k", "maximum_flash_temperature_thermal_ehl", "K"),
        FileResult("contact_temperature.bulk_c", "bulk_temperature", "C"),
        FileResult("contact_temperature.blok_max_c", "maximum_contact_temperature_blok", "C"),
        FileResult("contact_temperature.thermal_ehl_max_c", "maximum_contact_temperature_thermal_ehl", "C"),
        FileResult("film.dowson_higginson_min_um", "minimum_film_thickness_dowson_higginson", "mum"),
        FileResult("film.thermal_ehl_min_um", "minimum_film_thickness_thermal_ehl", "mum"),
        FileResult("film.thickness_ratio", "specific_film_thickness", "none"),
        FileResult("safety.scuffing_c", "scuffing_temperature", "C"),
        FileResult("safety.blok_factor", "scuffing_safety_blok", "none"),
        FileResult("safety.thermal_ehl_factor", "scuffing_safety_thermal_ehl", "none"),
        FileResult("safety.verdict", "scuffing_risk", "none"),
        *MICROPITTING_RESULTS,
    ),
)
