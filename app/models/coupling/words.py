"""What is said of the answers about couplings: components, views, verdicts and conclusions."""

from typing import Annotated, Any

from app.figures.wording import number, percent
from app.models.card import NEAR_LIMIT, Verdict, Words
from app.models.coupling.figures import CONSTRAINTS
from app.schema.answers import Group, Response, component, group, named
from app.schema.quantities import Output, View
from solvers.coupling import crowning, results
from solvers.coupling.inputs import Coupling
from solvers.quantity import quantities

FULL_FILM = 0.8  # load capacity coefficient from which the film carries (area 1 of Fig. 9)

named(
    CouplingGeometry=results.Geometry,
    CouplingKinematicCurves=results.KinematicCurves,
    CouplingLoadCurves=results.LoadCurves,
    CouplingLoadDistribution=results.LoadDistribution,
    FrictionRegime=results.Regime,
    CouplingLosses=results.Losses,
    SleeveOrbit=results.Orbit,
    SleeveInertia=results.InertiaForce,
)
component(
    results.Kinematics,
    "CouplingKinematics",
    max_sliding_velocity=View(headline=3, limit="limits.sliding_velocity_limit_m_per_s", bound="upper"),
)
component(
    results.Lubrication,
    "CouplingLubrication",
    hertz_pressure=View(limit=2000.0, bound="upper"),
    contact_overlap=View(limit=1.0, bound="upper"),
    load_capacity_coefficient=View(headline=2, limit=FULL_FILM, bound="lower"),
)
component(
    results.AxialThrust,
    "CouplingThrust",
    design_force=View(headline=1),
    force=View(limit="axial_thrust.coaxial_limit_n", bound="upper"),
    fraction_of_limit=View(limit=1.0),
)
component(results.Limits, "CouplingLimits", allowable_misalignment=View(headline=4))
component(
    crowning.RecommendedPoint,
    load_concentration=View(headline=3),
    contact_overlap=View(limit=1.0, bound="upper"),
    load_capacity_coefficient=View(limit=FULL_FILM, bound="lower"),
)
component(crowning.CrowningScan, max_contact_overlap=View(limit=1.0))


def _used(name: str, title: str) -> Output:
    """Declare which value the calculation used for the input `name` of a coupling."""
    declared = quantities(Coupling)[name]
    return Output(title, declared.symbol, unit=declared.unit, equation=declared.equation, origin=(Coupling, name))


class ProportionsInForce(Group):
    """Face width, tooth height and tooth stiffness that the calculation uses for a coupling."""

    face_width_mm: Annotated[float, _used("face_width", "face width used")]
    tooth_height_mm: Annotated[float, _used("tooth_height", "tooth height used")]
    tooth_stiffness_n_per_um: Annotated[float, _used("tooth_stiffness", "tooth pair stiffness used")]


component(results.Derived, "CouplingDerived", base=ProportionsInForce)
ORBIT_DERIVED = group(results.Geometry, "SleeveOrbitDerived", only=("pitch_radius",))

COUPLING = group(results.CouplingResult, "CouplingResponse", base=Response)
ORBIT = group(
    results.OrbitResult,
    "SleeveOrbitResponse",
    base=Response,
    fields={"derived": ORBIT_DERIVED},
    max_displacement=View(headline=1),
)
RECOMMENDATION = group(
    crowning.Recommendation,
    "RecommendationResponse",
    base=Response,
    crowning_radius=View(headline=1),
    crowning_drop=View(headline=2),
    unloading_margin=View(headline=4, limit=1.0, bound="lower"),
    min_load_capacity_coefficient=View(headline=4),
)


def verdicts(response: Any) -> dict[str, Verdict]:
    """Judge the design thrust, the film and the permissible misalignment."""
    judged = {_THRUST: _thrust(response), "limits.allowable_misalignment_deg": _misalignment(response)}
    film = response.lubrication
    if film.load_capacity_coefficient is not None:
        judged[_FILM] = Verdict(_level_of_film(film), f"kind of lubrication: {film.regime.name}")
    return judged


def _level_of_film(film: Any) -> str:
    """Return the level of a film: teeth are permitted to rub, so that a film that does not carry is not bad."""
    return "good" if film.load_capacity_coefficient >= FULL_FILM else "near"


def _thrust(response: Any) -> Verdict:
    """Compare the thrust in motion with the coaxial limit, and the design thrust with the customary thrust."""
    thrust = response.axial_thrust
    share, customary, held = thrust.fraction_of_limit, thrust.customary_force_n, thrust.design_force_n
    level = "good" if share is None or abs(share) <= NEAR_LIMIT else "near"
    limit = number(thrust.coaxial_limit_n, "N")
    moving = "no load" if share is None else f"in motion {percent(abs(share))} of the coaxial limit {limit}"
    if customary is None:
        return Verdict(
            "plain" if level == "good" else level, f"{moving}; to compare with 0.25 T/D, give the shaft diameter"
        )
    exceeds = held > customary
    side = "exceeds" if exceeds else "below"
    return Verdict("bad" if exceeds else level, f"{side} the customary {number(customary, 'N')} (0.25 T/D); {moving}")


def _misalignment(response: Any) -> Verdict:
    """Judge the permissible misalignment: compare the sliding velocity of the case with the permissible velocity."""
    most, sliding = response.limits.allowable_misalignment_deg, response.kinematics.max_sliding_velocity_m_per_s
    share = sliding / response.limits.sliding_velocity_limit_m_per_s
    if most is None:
        return Verdict("good", "no misalignment reaches the limit of the sliding velocity")
    level = "bad" if share > 1.0 else "near" if share > NEAR_LIMIT else "good"
    return Verdict(level, f"the sliding velocity of this case is {percent(share)} of its limit")


def verdict(response: Any) -> Verdict:
    """Say whether the case is permissible: sliding, position of the contact, thrust; then how well its film carries."""
    sliding = response.kinematics.max_sliding_velocity_m_per_s / response.limits.sliding_velocity_limit_m_per_s
    thrust, film = response.axial_thrust, response.lubrication
    codes = {warning.code: warning.rank for warning in response.warnings}
    faults = [f"the teeth slide at {number(sliding)} times the limit"] if sliding > 1.0 else []
    faults += ["contact leaves the tooth face"] if codes.get("edge_contact") == "invalid" else []
    faults += ["the contact is wider than the tooth face"] if "wide_contact" in codes else []
    if thrust.customary_force_n is not None and thrust.design_force_n > thrust.customary_force_n:
        held, customary = number(thrust.design_force_n, "N"), number(thrust.customary_force_n, "N")
        faults.append(f"the thrust to be held is {held}, customary are {customary}")
    if faults:
        return Verdict("bad", f"Not permissible: {'; '.join(faults)}.")
    if thrust.indeterminate and thrust.fraction_of_limit is not None:
        return Verdict("near", f"Locks axially: its teeth stick up to {number(thrust.coaxial_limit_n, 'N')}.")
    slide = f"the teeth slide at {percent(sliding)} of the limit"
    if film.load_capacity_coefficient is None:
        return Verdict("plain", "No load: no film, no thrust and no friction are stated.")
    least = f"{film.regime.name}, Tr {number(film.load_capacity_coefficient)}"
    if _level_of_film(film) != "good":
        return Verdict("near", f"Permissible without full film: {slide}; {least}.")
    return Verdict("near" if sliding > NEAR_LIMIT else "good", f"Permissible: {slide}; {least}.")


def conclusion(response: Any) -> str:
    """Say whether the coupling is free to move axially, and which misalignment is permitted."""
    thrust, most = response.axial_thrust, response.limits.allowable_misalignment_deg
    tilt = "no misalignment" if most is None else f"a misalignment up to {number(most, '°')}"
    permits = f"The limit of the sliding velocity permits {tilt}."
    if thrust.fraction_of_limit is None:
        return f"Free axially: without load its teeth have no friction. {permits}"
    load, teeth = response.load_distribution, response.inputs["coupling"]["teeth"]
    carry = "All" if load.loaded_teeth == teeth else f"{load.loaded_teeth} of"
    unloads = f"{carry} {teeth} teeth carry; the first unloads at {number(load.unloading_misalignment_deg, '°')}."
    if thrust.indeterminate:
        return f"{permits} {unloads}"
    if not thrust.fraction_of_limit and not response.inputs["operation"]["axial_velocity_mm_per_s"]:
        return f"Free axially: without axial velocity it has no thrust in motion. {permits} {unloads}"
    share = percent(abs(thrust.fraction_of_limit))
    return f"Free axially: its thrust in motion is {share} of the thrust of coaxial shafts. {permits} {unloads}"


def orbit_verdict(response: Any) -> Verdict:
    """Say how far the sleeve whirls."""
    return Verdict("plain", f"The sleeve whirls by {number(response.max_displacement_um, 'µm')} at most.")


def crowning_verdicts(response: Any) -> dict[str, Verdict]:
    """Say what belongs to radius and drop of the crowning, and judge what it costs; nothing if no crowning serves."""
    if not response.feasible:
        return {}
    teeth, largest = response.inputs["coupling"]["teeth"], _range_of(response)[1]
    judged = {
        "crowning_radius_mm": Verdict(
            "plain",
            f"of the cutter's path (ε = {number(response.crowning_ratio)}); the flank then has "
            f"{number(response.tangential_flank_radius_mm, 'mm')} in the tangential plane",
        ),
        "crowning_drop_um": Verdict(
            "plain", f"of the flank at both ends of the {number(response.derived.face_width_mm, 'mm')} face"
        ),
    }
    for place, tilt in zip(("at_min", "at_max"), _range_of(response), strict=True):
        point = getattr(response, place)
        carry = "all" if point.loaded_teeth == teeth else f"{point.loaded_teeth} of"
        judged[f"{place}.load_concentration"] = Verdict(
            "plain", f"times the mean tooth force, at {number(tilt, '°')}; {carry} {teeth} teeth carry"
        )
    unloads = number(response.unloading_misalignment_deg, "°")
    if response.unloading_margin < 1.0:
        verdict = Verdict("near", f"teeth unload within the range, from {unloads}")
    else:
        level = "near" if response.unloading_margin < 1.0 / NEAR_LIMIT else "good"
        verdict = Verdict(level, f"the first tooth unloads at {unloads}; the range ends at {number(largest, '°')}")
    return judged | {"unloading_margin": verdict}


def _range_of(response: Any) -> list[float]:
    """Return the smallest and the largest misalignment of the range [deg]."""
    ends: list[float] = response.inputs["operation"]["misalignment_range_deg"]
    return ends


def recommendation_verdict(response: Any) -> Verdict:
    """Say which crowning to make, or why none serves the range of misalignment."""
    if not response.feasible:
        low, high = (number(tilt, "°") for tilt in _range_of(response))
        return Verdict("bad", f"No crowning serves {low} to {high}: {CONSTRAINTS[response.failed_constraint]}.")
    return Verdict(
        "good" if response.unloading_margin >= 1.0 / NEAR_LIMIT else "near",
        f"Crown with radius {number(response.crowning_radius_mm, 'mm')}: the flanks drop "
        f"{number(response.crowning_drop_um, 'µm')} over the {number(response.derived.face_width_mm, 'mm')} face "
        f"(ε = {number(response.crowning_ratio)}).",
    )


def crowning_conclusion(response: Any) -> str:
    """Say what the crowning costs in load sharing, and how far the range is from unloading."""
    if not response.feasible:
        return ""
    point, margin = response.at_max, response.unloading_margin
    unloads = "already unload" if margin < 1.0 else "unload"
    return (
        f"At {number(_range_of(response)[1], '°')} the most loaded tooth carries {number(point.load_concentration)} "
        f"times the mean; teeth {unloads} from {number(response.unloading_misalignment_deg, '°')}, "
        f"{number(margin)} times that misalignment."
    )


FOUND = {
    "coupling.crowning_ratio": "crowning_ratio",
    "operation.misalignment_deg": "inputs.operation.misalignment_range_deg.1",
}
"""The crowning that was found, and the largest misalignment of the range, where the teeth share the load worst."""
_THRUST, _FILM = "axial_thrust.design_force_n", "lubrication.load_capacity_coefficient"

WORDS = Words(
    verdict=verdict,
    verdicts=verdicts,
    conclusion=conclusion,
    losses=("losses.friction_power_w",),
    touches={
        "sliding_velocity": (),  # its tiles say it
        "edge_contact": (_FILM,),
        "wide_contact": (_FILM,),
        "friction_indeterminate": (_THRUST,),
        "indeterminate_moment": (),
        "unstable_regime": (_THRUST,),
        "sleeve_position": (_FILM, _THRUST),
        "sleeve_not_centred": (_FILM, _THRUST),
    },
    names=frozenset({"edge_contact", "wide_contact"}),
)
ORBIT_WORDS = Words(verdict=orbit_verdict)
RECOMMENDATION_WORDS = Words(
    verdict=recommendation_verdict,
    verdicts=crowning_verdicts,
    conclusion=crowning_conclusion,
    touches={"infeasible": ()},
    names=frozenset({"infeasible"}),
    hands_on={"/v1/coupling": FOUND, "/v1/coupling/sleeve-orbit": FOUND},
)
