"""What is said of the answers about couplings: components, views, verdicts and conclusions."""

from typing import Annotated, Any

from app.figures.wording import number, percent
from app.models.card import NEAR_LIMIT, Verdict, Words
from app.schema.answers import Group, Response, component, group, named
from app.schema.quantities import Output, View
from solvers.coupling import crowning, results
from solvers.coupling.inputs import Coupling
from solvers.quantity import quantities

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
    load_capacity_coefficient=View(headline=2, limit=0.8, bound="lower", verdict=".regime.name"),
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
    load_capacity_coefficient=View(limit=0.8, bound="lower"),
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
    limit = number(thrust.coaxial_limit_n, "N")
    level = "good" if share is None or abs(share) <= NEAR_LIMIT else "near"
    moving = "no load"
    if share is not None:
        moving = f"the thrust in motion is {percent(abs(share))} of the limit of coaxial shafts, {limit}"
    if customary is None:
        return Verdict(level, f"{moving}; to compare with the customary thrust 0.25 T/D, give the shaft diameter")
    exceeds = held > customary
    side = "exceeds" if exceeds else "is below"
    return Verdict(
        "bad" if exceeds else level, f"{side} the customary thrust 0.25 T/D of {number(customary, 'N')}; {moving}"
    )


def _misalignment(response: Any) -> Verdict:
    """Judge the permissible misalignment: compare the sliding velocity of the case with the permissible velocity."""
    most, sliding = response.limits.allowable_misalignment_deg, response.kinematics.max_sliding_velocity_m_per_s
    share = sliding / response.limits.sliding_velocity_limit_m_per_s
    if most is None:
        return Verdict("good", "no misalignment reaches the limit of the sliding velocity")
    level = "bad" if share > 1.0 else "near" if share > NEAR_LIMIT else "good"
    return Verdict(level, f"the sliding velocity of this case is {percent(share)} of its limit")


def conclusion(response: Any) -> str:
    """Say whether the coupling locks axially, how its teeth are lubricated and which misalignment is permitted."""
    thrust, most = response.axial_thrust, response.limits.allowable_misalignment_deg
    if thrust.fraction_of_limit is None:
        locks = "The coupling carries no load, so no friction locks the coupling axially"
    elif thrust.indeterminate:
        locks = f"The coupling locks axially: its teeth stick, up to a thrust of {number(thrust.coaxial_limit_n, 'N')}"
    else:
        share = percent(abs(thrust.fraction_of_limit))
        locks = (
            f"The coupling does not lock axially: its teeth slide. Its thrust is {share} of the thrust of coaxial "
            "shafts"
        )
    regime = response.lubrication.regime.name
    tilt = "no misalignment" if most is None else f"a misalignment up to {number(most, '°')}"
    return f"{locks}. The teeth run in {regime}. The limit of the sliding velocity permits {tilt}."


WORDS = Words(verdicts=verdicts, conclusion=conclusion, losses=("losses.friction_power_w",))
