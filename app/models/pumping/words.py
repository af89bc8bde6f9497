"""What is said of the answers about pumping: components, views, verdicts and conclusions."""

from typing import Any

from app.figures.wording import UNCERTAIN, listed, number, percent
from app.models.card import FromFile, Verdict, Words
from app.schema.answers import Response, component, group, named
from app.schema.quantities import View
from solvers.pumping import lead_correction, pulsation, results
from solvers.pumping.space import stroke

named(
    StrokeCurves=stroke.StrokeTable,
    PumpingStroke=results.Stroke,
    PumpingBalance=results.Balance,
    PumpingProfile=results.FaceProfile,
    PumpingEnd=results.EndOfFace,
    PumpingChoking=results.Choking,
    PumpingGeometry=results.MeshGeometry,
    PumpingLeadCorrection=lead_correction.LeadCorrection,
    PumpingPulsation=pulsation.Pulsation,
    PumpingResolution=results.Resolution,
    PumpingDerived=results.Derived,
)
component(results.MassFlow, "PumpingMassFlow", unit="g_per_s")
component(results.GasField, "PumpingField", axial_mach=View(limit=1.0))
component(
    results.SpacesResult,
    "PumpingSpaces",
    peak_axial_mach=View(headline=2, limit=1.0, verdict=".axial_choked"),
    peak_pressure_ratio=View(headline=3, verdict=".radial_choked"),
    max_temperature_rise=View(headline=4),
)
component(results.Totals, "PumpingTotal", pumping_power=View(headline=1))
component(results.ChokingCurves, exit_mach=View(limit=1.0), inflow_mach=View(limit=1.0))

PUMPING = group(results.PumpingResult, "PumpingResponse", base=Response)
CHOKING = group(
    results.ChokingSpeeds,
    "ChokingSpeedResponse",
    base=Response,
    radial_choking_speed=View(headline=1, limit="search_limit_rpm"),
    axial_choking_speed=View(headline=2, limit="search_limit_rpm"),
    inflow_choking_speed=View(headline=3, limit="search_limit_rpm"),
)


def verdicts(response: Any) -> dict[str, Verdict]:
    """Judge choking, and mark the power and the temperature rise as doubtful if they are uncertain."""
    spaces = _spaces(response).items()
    judged = {f"{gear}_spaces.peak_axial_mach": _axial(gear, space, response) for gear, space in spaces}
    judged |= {f"{gear}_spaces.peak_pressure_ratio": _radial(response) for gear, _ in spaces}
    resolution = response.resolution
    if resolution.pumping_power > UNCERTAIN:
        judged["total.pumping_power_w"] = _doubtful("the power", resolution.pumping_power)
    if (resolution.temperature_rise or 0.0) > UNCERTAIN:
        doubt = _doubtful("the temperature rise", resolution.temperature_rise)
        judged |= {f"{gear}_spaces.max_temperature_rise_k": doubt for gear in _spaces(response)}
    return judged


def _spaces(response: Any) -> dict[str, Any]:
    """Return the results for the tooth spaces. The keys are "pinion" and "wheel"."""
    spaces = {"pinion": response.pinion_spaces, "wheel": response.wheel_spaces}
    return {gear: space for gear, space in spaces.items() if space is not None}


def _axial(gear: str, space: Any, response: Any) -> Verdict:
    """Say whether the outflow and the inflow at the ends of the tooth spaces are choked, by the refined verdict."""
    choking = response.choking
    words = (choking.outflow, choking.inflow)
    text = f"outflow {choking.outflow} (Ma {number(choking.outflow_mach, '')}), inflow {choking.inflow}"
    text += f" (Ma {number(choking.inflow_mach, '')}), with {choking.slices} slices"
    if "choked" not in words and space.peak_axial_mach > 1.0:
        text += f"; inside the spaces of the {gear} the gas is faster than sound"
        return Verdict("near", text)
    return Verdict("bad" if "choked" in words else "near" if "doubtful" in words else "good", text)


def _radial(response: Any) -> Verdict:
    """Say whether the flow in radial clearances is choked, by the refined verdict."""
    word = response.choking.clearances
    return Verdict({"choked": "bad", "doubtful": "near"}.get(word, "good"), f"radial clearances {word}")


def _doubtful(name: str, uncertainty: float) -> Verdict:
    return Verdict("near", f"doubtful: {name} is uncertain by {percent(uncertainty)}")


def verdict(response: Any) -> Verdict:
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
        first = f"Choked: {listed(told['choked'])}"
        rest = [f"doubtful: {listed(told['doubtful'])}"] if told["doubtful"] else []
        rest += [f"not choked: {listed(told['not choked'])}"] if told["not choked"] else []
        return Verdict("bad", "; ".join([first, *rest]) + ".")
    if told["doubtful"]:
        return Verdict("near", f"Doubtful whether choked, with {choking.slices} slices: {listed(told['doubtful'])}.")
    return Verdict("good", f"Not choked: {listed(told['not choked'])} stay below the speed of sound.")


def _mach(mach: float, uncertainty: float) -> str:
    return f" (Ma {number(mach, '')} ± {percent(uncertainty)})"


def choking_verdict(response: Any) -> Verdict:
    """Say above which pinion speeds the mesh is choked."""
    speeds = {
        "ends (outflow)": response.axial_choking_speed_rpm,
        "ends (inflow)": response.inflow_choking_speed_rpm,
        "radial clearances": response.radial_choking_speed_rpm,
    }
    limit = number(response.inputs["search_limit_rpm"], "1/min")
    sonic = sorted((speed, place) for place, speed in speeds.items() if speed is not None)
    told = [f"at the {place} from {number(speed, '1/min')}" for speed, place in sonic]
    told += [f"not at the {place} up to {limit}" for place, speed in speeds.items() if speed is None]
    if not sonic:
        return Verdict("good", f"Does not choke up to {limit} of the pinion.")
    return Verdict("plain", f"Chokes from {number(sonic[0][0], '1/min')} of the pinion: {listed(told)}.")


def belongs(response: Any) -> dict[str, str]:
    """Say of the pumping power of double-helical gears that it is that of both helices."""
    double = response.derived is not None and response.derived.total_face_width_mm is not None
    return {"total.pumping_power_w": "both helices, each with both ends open"} if double else {}


def _both(name: str) -> tuple[str, str]:
    """Return the paths of a headline number of the spaces of either gear."""
    return f"pinion_spaces.{name}", f"wheel_spaces.{name}"


WORDS = Words(
    verdict=verdict,
    verdicts=verdicts,
    belongs=belongs,
    touches={
        "net_flow_uncertain": (),
        "no_energy_balance": ("total.pumping_power_w", *_both("max_temperature_rise_k")),
        "pressure_not_resolved": _both("peak_pressure_ratio"),
        "incompressible_mach": _both("peak_axial_mach"),
    },
    losses=("total.pumping_power_w",),
    hands_on={"/v1/scuffing": {"cooling.pumping_w": "total.pumping_power_w"}},
    from_file=FromFile(
        frozenset({"gears"}),
        unknown=frozenset({"gears.hand"}),
        renamed={"load.pinion_speed_rpm": "operation.pinion_speed_rpm"},
    ),
)
CHOKING_WORDS = Words(verdict=choking_verdict)
