"""What is said of the answers about couplings: components, views, verdicts and conclusions."""

from typing import Annotated, Any

from app.figures.wording import number, percent
from app.models.card import NEAR_LIMIT, Verdict, Words
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
    load_capacity_coefficient=View(headline=2, limit=FULL_FILM, bound="lower", verdict=".regime.name"),
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
    feasible=View(headline=2),
    crowning_ratio=View(headline=1),
    min_load_capacity_coefficient=View(headline=3),
)


def verdicts(response: Any) -> dict[str, Verdict]:
    """Judge the design thrust and the permissible misalignment."""
    thrust, tilt = "axial_thrust.design_force_n", "limits.allowable_misalignment_deg"
    return {thrust: _thrust(response), tilt: _misalignment(response)}


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
    if film.load_capacity_coefficient < FULL_FILM:
        return Verdict("near", f"Permissible without full film: {slide}; {least}.")
    return Verdict("near" if sliding > NEAR_LIMIT else "good", f"Permissible: {slide}; {least}.")


def conclusion(response: Any) -> str:
    """Say whether the coupling is free to move axially, and which misalignment is permitted."""
    thrust, most = response.axial_thrust, response.limits.allowable_misalignment_deg
    tilt = "no misalignment" if most is None else f"a misalignment up to {number(most, '°')}"
    permits = f"The limit of the sliding velocity permits {tilt}."
    if thrust.fraction_of_limit is None:
        return f"Free axially: without load its teeth have no friction. {permits}"
    if thrust.indeterminate:
        return permits
    share = percent(abs(thrust.fraction_of_limit))
    return f"Free axially: its thrust in motion is {share} of the thrust of coaxial shafts. {permits}"


def orbit_verdict(response: Any) -> Verdict:
    """Say how far the sleeve whirls."""
    return Verdict("plain", f"The sleeve whirls by {number(response.max_displacement_um, 'µm')} at most.")


def recommendation_verdict(response: Any) -> Verdict:
    """Say whether a crowning serves the whole range of misalignment."""
    if not response.feasible:
        return Verdict("bad", "No crowning serves this range.")
    least = number(response.min_load_capacity_coefficient)
    return Verdict("good", f"A crowning serves: ε {number(response.crowning_ratio)}, Tr {least} at the least.")


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
)
ORBIT_WORDS = Words(verdict=orbit_verdict)
RECOMMENDATION_WORDS = Words(verdict=recommendation_verdict, touches={"infeasible": ()})
