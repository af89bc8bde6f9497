"""Verdicts that depend on several numbers of a result, and the conclusion of a calculation in words."""

from collections.abc import Callable
from typing import Any, NamedTuple

from app.figures.wording import UNCERTAIN, listed, number, percent
from app.schema.coupling import CouplingResponse
from app.schema.model import Response
from app.schema.pumping import ChokingSpeedResponse, PumpingResponse

NEAR_LIMIT = 0.8  # a value above this share of an upper limit is close to the limit


class Verdict(NamedTuple):
    """The level of a number (good, near, bad or plain), and the reason for this level in words."""

    level: str
    text: str


def verdicts(response: Response) -> dict[str, Verdict]:
    """Return the verdicts that need more than a single limit. The keys are the paths of the headline numbers."""
    if response.status == "no_solution":
        return {}
    if isinstance(response, CouplingResponse):
        thrust, tilt = "axial_thrust.design_force_n", "limits.allowable_misalignment_deg"
        return {thrust: _thrust(response), tilt: _misalignment(response)}
    if isinstance(response, PumpingResponse):
        return _of_pumping(response)
    return {}


def conclusion(response: Response) -> str:
    """Return the conclusion of an answer in words; empty if this kind of calculation has no conclusion."""
    conclude = _CONCLUSIONS.get(type(response))
    return conclude(response) if conclude and response.status != "no_solution" else ""


def _of_pumping(response: PumpingResponse) -> dict[str, Verdict]:
    """Judge choking, and mark the power and the temperature rise as doubtful if they are uncertain."""
    spaces = _spaces(response).items()
    judged = {f"{gear}_spaces.peak_axial_mach": _axial(gear, space, response) for gear, space in spaces}
    judged |= {f"{gear}_spaces.peak_pressure_ratio": _radial(response) for gear, _ in spaces}
    resolution = response.resolution
    if resolution.pumping_power > UNCERTAIN:
        judged["total.pumping_power_w"] = _as_known(Verdict("plain", ""), resolution.pumping_power, "the power")
    if (resolution.temperature_rise or 0.0) > UNCERTAIN:
        doubt = _as_known(Verdict("plain", ""), resolution.temperature_rise, "the temperature rise")
        judged |= {f"{gear}_spaces.max_temperature_rise_k": doubt for gear in _spaces(response)}
    return judged


def _thrust(response: CouplingResponse) -> Verdict:
    """Compare the thrust in motion with the coaxial limit, and the design thrust with the customary thrust.

    The coaxial limit is the thrust if the shafts are coaxial and all teeth slide in the same direction. The customary
    thrust is 0.25 T/D, where T is the torque and D is the shaft diameter.
    """
    thrust = response.axial_thrust
    share, customary, held = thrust.fraction_of_limit, thrust.customary_force_n, thrust.design_force_n
    limit = number(thrust.coaxial_limit_n, "N")
    level = "good" if share is None or abs(share) <= NEAR_LIMIT else "near"
    moving = (
        "no load"
        if share is None
        else f"the thrust in motion is {percent(abs(share))} of the limit of coaxial shafts, {limit}"
    )
    if customary is None:
        return Verdict(level, f"{moving}; to compare with the customary thrust 0.25 T/D, give the shaft diameter")
    exceeds = held > customary
    side = "exceeds" if exceeds else "is below"
    return Verdict(
        "bad" if exceeds else level, f"{side} the customary thrust 0.25 T/D of {number(customary, 'N')}; {moving}"
    )


def _misalignment(response: CouplingResponse) -> Verdict:
    """Judge the permissible misalignment: compare the sliding velocity of the case with the permissible velocity."""
    most, sliding = response.limits.allowable_misalignment_deg, response.kinematics.max_sliding_velocity_m_per_s
    share = sliding / response.limits.sliding_velocity_limit_m_per_s
    if most is None:
        return Verdict("good", "no misalignment reaches the limit of the sliding velocity")
    level = "bad" if share > 1.0 else "near" if share > NEAR_LIMIT else "good"
    return Verdict(level, f"the sliding velocity of this case is {percent(share)} of its limit")


def _coupling(response: CouplingResponse) -> str:
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


def _spaces(response: PumpingResponse) -> dict[str, Any]:
    """Return the results for the tooth spaces. The keys are "pinion" and "wheel"."""
    spaces = {"pinion": response.pinion_spaces, "wheel": response.wheel_spaces}
    return {gear: space for gear, space in spaces.items() if space is not None}


def _axial(gear: str, space: Any, response: PumpingResponse) -> Verdict:
    """Say whether the outflow and the inflow at the ends of the tooth spaces are choked, by the refined verdict."""
    choking = response.choking
    words = (choking.outflow, choking.inflow)
    text = f"outflow {choking.outflow} (Ma {number(choking.outflow_mach, '')}), inflow {choking.inflow}"
    text += f" (Ma {number(choking.inflow_mach, '')}), with {choking.slices} slices"
    if "choked" not in words and space.peak_axial_mach > 1.0:
        text += f"; inside the spaces of the {gear} the gas is faster than sound"
        return Verdict("near", text)
    return Verdict("bad" if "choked" in words else "near" if "doubtful" in words else "good", text)


def _radial(response: PumpingResponse) -> Verdict:
    """Say whether the flow in radial clearances is choked, by the refined verdict."""
    word = response.choking.clearances
    return Verdict({"choked": "bad", "doubtful": "near"}.get(word, "good"), f"radial clearances {word}")


def _as_known(verdict: Verdict, uncertainty: float, name: str) -> Verdict:
    """Return the verdict, marked as doubtful if the number behind the verdict is uncertain."""
    if uncertainty <= UNCERTAIN:
        return verdict
    doubt = f"doubtful: {name} is uncertain by {percent(uncertainty)}"
    return Verdict("near", f"{verdict.text}; {doubt}" if verdict.text else doubt)


def _pumping(response: PumpingResponse) -> str:
    """Say which flows become sonic: outflow and inflow at the ends, and the flow through the radial clearances."""
    choking = response.choking
    numbers = {
        "the outflow at the ends": (choking.outflow, _mach(choking.outflow_mach, choking.outflow_uncertainty)),
        "the inflow at the ends": (choking.inflow, _mach(choking.inflow_mach, choking.inflow_uncertainty)),
        "the flow through the radial clearances": (choking.clearances, ""),
    }
    told = {
        word: [f"{flow}{text}" for flow, (found, text) in numbers.items() if found == word]
        for word in ("choked", "doubtful", "not choked")
    }
    if told["choked"]:
        first = f"The mesh is choked: {listed(told['choked'])}"
        rest = [f"doubtful: {listed(told['doubtful'])}"] if told["doubtful"] else []
        rest += [f"not choked: {listed(told['not choked'])}"] if told["not choked"] else []
        return "; ".join([first, *rest]) + "."
    if told["doubtful"]:
        return f"It is doubtful whether the mesh is choked, with {choking.slices} slices: {listed(told['doubtful'])}."
    return f"The mesh is not choked: {listed(told['not choked'])} stay below the speed of sound."


def _mach(mach: float, uncertainty: float) -> str:
    return f" (Ma {number(mach, '')} ± {percent(uncertainty)})"


def _choking(response: ChokingSpeedResponse) -> str:
    """Say above which pinion speeds the mesh is choked."""
    speeds = {
        "ends (outflow)": response.axial_choking_speed_rpm,
        "ends (inflow)": response.inflow_choking_speed_rpm,
        "radial clearances": response.radial_choking_speed_rpm,
    }
    sonic = [f"at the {place} from {number(speed, '1/min')}" for place, speed in speeds.items() if speed is not None]
    never = [
        f"not at the {place} up to {number(response.inputs['search_limit_rpm'], '1/min')}"
        for place, speed in speeds.items()
        if speed is None
    ]
    return f"The flow becomes sonic {listed([*sonic, *never])} of the pinion."


_CONCLUSIONS: dict[type[Response], Callable[..., str]] = {
    CouplingResponse: _coupling,
    PumpingResponse: _pumping,
    ChokingSpeedResponse: _choking,
}
