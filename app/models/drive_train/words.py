"""What is said of the answers about gear units: components, views, remarks, and what files take back."""

from types import GenericAlias
from typing import Any

from app.figures.wording import number, percent
from app.models.card import FileResult, FromFile, ScuffingPaths, Verdict, Words
from app.models.coupling.words import ProportionsInForce
from app.models.load_distribution.words import MESH_DERIVED, carrying, unloaded
from app.models.scuffing.words import (
    BULK_BY,
    LOAD_RESULTS,
    MICROPITTING_RESULTS,
    OPTIONAL_CHAPTERS,
    LocalPaths,
    band_of,
    beside,
    by_standard,
    how_well_known,
    risk_of_scuffing,
    tile_of_scuffing,
    with_micropitting,
    without_risk,
)
from app.schema.answers import Response, component, group, named
from app.schema.quantities import View
from solvers.drive_train import derived, results, warm_up
from solvers.drive_train.shafts import thrust_budget
from solvers.heat_balance.warm_up import WarmUp
from solvers.lubricants import OilInUse
from solvers.scuffing.safety_results import BulkInForce

named(
    BearingLoad=results.BearingResult,
    ShaftLine=results.ShaftCurves,
    UnitCouplingState=results.CouplingResult,
    BearingInForce=derived.DerivedBearing,
    SectionInForce=derived.DerivedSection,
    ShaftInForce=derived.DerivedShaft,
    HeatInForce=derived.DerivedHeat,
    TrainFlash=results.FlashPlaces,
    TrainBalance=results.ForceBalance,
    TrainConvergence=results.Convergence,
    TrainMaps=results.FlankMaps,
    OilInForce=OilInUse,
    AlignmentAtTimes=warm_up.AlignmentOverTime,
)
OF_A_HELIX = ("safety.minimum", "load.face_load_factor", "misalignment.shaft_slope_um")
"""Headline numbers that belong to one helix of a double-helical unit."""
component(derived.DerivedTemperatures, "TemperaturesInForce", BulkInForce)
component(thrust_budget.Thrust, "ShaftThrust", use=View(limit=1.0))
component(results.FaceLoad, "TrainLoad", face_load_factor=View(headline=2), contact_fraction=View(percent=True))
component(
    results.TrainSafety,
    blok_feature=View(limit=1.0, bound="lower"),
    blok_flank=View(limit=1.0, bound="lower"),
    thermal_ehl_feature=View(limit=1.0, bound="lower"),
    thermal_ehl_profile=View(limit=1.0, bound="lower"),
    minimum=View(headline=1, limit=1.0, bound="lower", needs="temperatures.scuffing_c", band="heat.band.safety"),
)
component(derived.DerivedCoupling, "CouplingInForce", fields={"coupling": ProportionsInForce})
component(results.Parts, "MisalignmentParts", unit="um")

# States other than the hot one have a summary without curves.
SHAFT = group(results.ShaftResult, "ShaftSummary", without=("curves",))
component(results.ShaftResult, "ShaftState", base=SHAFT)
GAPS = group(results.Misalignment, "MisalignmentSummary", without=("curves",), shaft_slope=View(headline=3))
component(results.Misalignment, "MisalignmentState", base=GAPS)
HELIX = group(results.HelixResult, "HelixSummary", stands=False, fields={"misalignment": GAPS})
STATE_DERIVED = group(derived.Derived, "StateDerived", only=("temperatures",))
component(derived.Derived, "DriveTrainDerived", base=MESH_DERIVED)
SUMMARY = group(
    results.DriveTrainResult,
    "TrainSummary",
    without=("flank", "states", "heat"),
    fields={
        "misalignment": GAPS,
        "shafts": GenericAlias(list, SHAFT),
        "helices": GenericAlias(list, HELIX) | None,
        "derived": STATE_DERIVED,
    },
)
component(results.States, "TrainStates", fields={"cold": SUMMARY | None})
component(WarmUp, "WarmUpOfNodes", greatest_difference=View(headline=1))

DRIVE_TRAIN = group(results.DriveTrainResult, "DriveTrainResponse", base=Response)
WARM_UP = group(
    warm_up.UnitWarmUp,
    "WarmUpResponse",
    base=Response,
    least_safety=View(headline=2, limit=1.0, bound="lower", needs="temperatures.scuffing_c"),
    largest_face_load_factor=View(headline=3),
)


def verdict(response: Any) -> Verdict:
    """Judge scuffing, and micropitting where it is asked for; a double-helical unit by the helix that decides."""
    if idle := unloaded(response):
        return idle
    least, bulk = _least(response), response.derived.temperatures.bulk_c
    if least is not None:
        first = risk_of_scuffing(least, band_of(response))
    else:
        first = without_risk(response, bulk, response.flash.contact_max_c)
    return with_micropitting(first, response)


def _least(response: Any) -> float | None:
    """Return the least safety factor against scuffing; None if the answer has none."""
    least: float | None = response.safety.minimum if response.safety is not None else None
    return least


def verdicts(response: Any) -> dict[str, Verdict]:
    """Judge the least safety factor; say what carries, and how the bulk temperature came about."""
    return {
        **tile_of_scuffing(_SAFETY, _least(response), band_of(response)),
        _LOAD: Verdict("plain", carrying(response.load)),
        _BULK: Verdict("plain", BULK_BY[response.derived.temperatures.bulk_method]),
    }


def warm_up_verdict(response: Any) -> Verdict:
    """Judge the least safety factor of the warm-up."""
    if response.least_safety is None:
        return Verdict("plain", f"The bodies differ by {number(response.warm_up.greatest_difference_k, 'K')} at most.")
    return risk_of_scuffing(response.least_safety, None, "S_B,min")


def warm_up_verdicts(response: Any) -> dict[str, Verdict]:
    """Judge the least safety factor on its tile."""
    return tile_of_scuffing("least_safety", response.least_safety, None)


def remarks(response: Any) -> dict[str, str]:
    """Say how well the temperatures of the flanks are known."""
    return how_well_known(response, "heat.pinion.flank_c", "heat.wheel.flank_c", _BULK)


def belongs(response: Any) -> dict[str, str]:
    """Name the helix to which the headline numbers of a double-helical unit belong."""
    if response.decisive_helix is None:
        return {}
    return dict.fromkeys(OF_A_HELIX, f"helix {response.decisive_helix} decides")


def conclusion(response: Any) -> str:
    """Say what the standard finds; of a double-helical unit whether its coupling locks, and what is ground on each."""
    if response.axial is None:
        return by_standard(response.safety, _least(response))
    grind = [
        f"Grind on helix {place}: slope {number(helix.misalignment.recommended_helix_slope_um, 'µm')}, crowning "
        f"{number(helix.misalignment.recommended_lead_crowning_um, 'µm')} (first estimate)."
        for place, helix in enumerate(response.helices, start=1)
    ]
    standards = [
        said
        for place, helix in enumerate(response.helices, start=1)
        if (said := by_standard(helix.safety, helix.safety and helix.safety.minimum, f" of helix {place}"))
    ]
    return "\n".join([_locks(response), *standards, *grind])


def _locks(response: Any) -> str:
    """Answer whether the coupling of the floating shaft locks, with the shares if it does and if it slides."""
    axial = response.axial
    shafts = [coupling["shaft"] for coupling in response.inputs["couplings"]]
    own = [
        coupling
        for shaft, coupling in zip(shafts, response.couplings, strict=False)
        if shaft == axial.floating_shaft and coupling.held_thrust_fraction is not None
    ]
    if not own:
        return f"No coupling loads the {axial.floating_shaft}, which floats: nothing locks."
    if axial.unloading_force_n == 0.0:
        return "The coupling does not lock: without load its teeth have no friction."
    held = max(coupling.held_thrust_fraction for coupling in own)
    (least, _), (greatest, _) = axial.share_bounds
    without = (1.0 + abs(response.inputs["operation"]["axial_force_n"]) / axial.unloading_force_n) / 2
    locked = max(least, greatest, 1.0 - least, 1.0 - greatest)
    tilts = " and ".join(number(tilt) for tilt in own[0].tilt_mrad)
    if held == 0.0:
        said = f"The coupling does not lock: its hubs tilt by {tilts} mrad and slide"
    else:
        said = f"The coupling can lock: tilted by {tilts} mrad, its hubs hold {percent(held)} of their axial friction"
    free, fast = (f"one helix carries {percent(share)} (K_γ = {number(2.0 * share)})" for share in (without, locked))
    free = "both helices carry half" if without == 0.5 else free
    fast = "one helix lifts off" if locked == 1.0 else fast
    return f"{said}. While it slides, {free}; if dirt or wear lock it, {fast}."


def _local(at: str = "") -> LocalPaths:
    """Paths of local values, of the unit or of the helix at the path `at`."""
    return LocalPaths(
        dynamic_factor="inputs.operation.dynamic_factor",
        bulk=f"{at}bulk_c" if at else "inputs.temperatures.bulk_c",
        largest_flash=f"{at}flash.flank_k",
        contact=f"{at}flash.contact_max_c",
        limit="inputs.temperatures.scuffing_c",
        safety=f"{at}safety.blok_flank",
    )


BESIDE = (
    *beside(_local(), unless="helices.0"),
    *(
        table
        for k in range(2)
        for table in beside(_local(f"helices.{k}."), of=f" of helix {k + 1}", at=f"helices.{k}.")
    ),
)

_SAFETY, _LOAD, _SLOPE = OF_A_HELIX
_BULK, _PITTING = "derived.temperatures.bulk_c", "micropitting.local.safety"

WORDS = Words(
    verdict=verdict,
    verdicts=verdicts,
    tiles=(_BULK, _PITTING),
    touches=dict.fromkeys(
        # of bearings, couplings, losses and gas flows that no tile shows
        (
            *("thin_film", "thrust_reversal", "thrust_overload", "misalignment_limit", "edge_contact", "wide_contact"),
            *("friction_indeterminate", "indeterminate_moment", "unstable_regime", "sleeve_position"),
            *("sleeve_not_centred", "losses_exceed_power", "no_cold_solution", "net_flow_uncertain", "thin_tip"),
        ),
        (),
    )
    | dict.fromkeys(("short_bearing_range", "wide_bearing", "turbulent_film", "not_resolved"), (_LOAD, _SLOPE))
    | dict.fromkeys(("micropitting_temperature", "micropitting_range"), (_PITTING,))
    | dict.fromkeys(("bulk_lower_bound", "losses_overestimated", "measured_contradiction"), (_SAFETY, _BULK, _PITTING))
    | {"edge_load": (_LOAD, _SLOPE), "low_peclet": (_SAFETY,)},
    remarks=remarks,
    belongs=belongs,
    conclusion=conclusion,
    chapters=OPTIONAL_CHAPTERS | {"axial": "double-helical"},
    losses=("losses.coupling_w", "losses.pumping_w", "losses.mesh_w", "losses.bearings_w"),
    scuffing=ScuffingPaths("flash.contact_max_c", "derived.temperatures.scuffing_c"),
    beside=BESIDE,
    of_the_film=frozenset({"safety.minimum", "helices.*.safety.minimum"}),
    from_file=FromFile(unknown=frozenset({"scuffing.application_factor"}), renamed={"load": "operation"}),
    to_file=(
        FileResult("share", "share", "none"),
        *LOAD_RESULTS,
        FileResult("load.max_pressure_mpa", "maximum_hertzian_pressure", "MPa"),
        FileResult("load.transmission_error_pp_um", "transmission_error_peak_to_peak", "mum"),
        FileResult("safety.blok_flank", "scuffing_safety_blok_flank", "none"),
        FileResult("safety.minimum", "scuffing_safety_minimum", "none"),
        *MICROPITTING_RESULTS,
        FileResult("losses.total_w", "total_power_loss", "W"),
        FileResult("losses.efficiency", "efficiency", "none"),
    ),
)
WARM_UP_WORDS = Words(verdict=warm_up_verdict, verdicts=warm_up_verdicts)
