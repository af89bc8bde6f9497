"""What is said of the answers about the load distribution: components and views."""

from typing import Any

from app.figures.wording import number, percent
from app.models.card import FromFile, Verdict, Words
from app.schema.answers import Response, component, group, named
from app.schema.quantities import View
from solvers.scuffing import results

MESH = frozenset({"gears", "load", "materials", "modifications", "friction_coefficient"})
NOT_OF_A_MESH = frozenset(  # what only a unit asks for
    {
        "gears.hand",
        "gears.normal_backlash_mm",
        "modifications.second_helix.helix_slope_um",
        "modifications.second_helix.lead_crowning_um",
    }
)

named(
    FlankPlace=results.Place,
    ScuffingGeometry=results.Geometry,
    ContactLengthCurves=results.LengthCurves,
    ContactLineLengths=results.ContactLines,
    ToothStiffnessCurves=results.StiffnessCurves,
    ToothStiffness=results.Stiffness,
    TransmissionErrorCurves=results.ErrorCurves,
    MeshLoss=results.FrictionLoss,
    FeatureLineCurves=results.FeatureLine,
    FlankFields=results.Flank,
)
component(results.TransmissionError, "TransmissionErrorResult", peak_to_peak=View(headline=3))
component(results.Pressure, "FlankPressure", max=View(headline=1))
component(
    results.LoadOnFlank,
    "FlankLoad",
    fields={"pair_share": list[list[float]] | None},
    face_load_factor=View(headline=2),
    contact_fraction=View(percent=True),
)
MESH_DERIVED = group(results.Derived, "MeshDerived", without=("rack_tip_radius",))
SCUFFING_DERIVED = group(results.Derived, "ScuffingDerived", base=MESH_DERIVED)

LOAD_DISTRIBUTION = group(results.LoadDistribution, "LoadDistributionResponse", base=Response)

OF_TWO_HELICES = {"helix": "double-helical"}
"""The chapter of the manual about double-helical pairs."""


def of_helix(response: Any, *paths: str) -> dict[str, str]:
    """Say to which helix of a double-helical pair the headline numbers at the `paths` belong."""
    if response.helix is None:
        return {}
    share = response.helix.share
    which = "each of two equal helices" if share == 0.5 else f"the helix that carries {percent(share)}"
    return dict.fromkeys(paths, which)


def belongs(response: Any) -> dict[str, str]:
    """Name the helix to which the headline numbers belong."""
    return of_helix(response, "pressure.max_mpa", "load.face_load_factor", "transmission_error.peak_to_peak_um")


def carrying(load: Any) -> str:
    """Say how much of the contact carries load."""
    share = load.contact_fraction
    return "the whole contact carries" if share >= 1.0 else f"{percent(share)} of the contact carries"


def verdicts(response: Any) -> dict[str, Verdict]:
    """Say beside the face load factor how much of the contact carries load."""
    return {"load.face_load_factor": Verdict("plain", carrying(response.load))}


def unloaded(response: Any) -> Verdict | None:
    """Say of flanks without load that nothing presses them together; None if there is a load."""
    without = any(warning.code == "no_load" for warning in response.warnings)
    return Verdict("plain", "No load: nothing presses the flanks together.") if without else None


def verdict(response: Any) -> Verdict:
    """Say how much of the contact carries load, how evenly, and with which pressure."""
    load, pressure = response.load, response.pressure.max_mpa
    if idle := unloaded(response):
        return idle
    said = carrying(load)
    even = f"{said[0].upper()}{said[1:]}: K_Hβ {number(load.face_load_factor)}"
    return Verdict("plain", f"{even}, {number(pressure, 'MPa')} at most." if pressure is not None else f"{even}.")


WORDS = Words(
    verdict=verdict,
    verdicts=verdicts,
    belongs=belongs,
    touches={"thin_tip": ()},
    chapters=OF_TWO_HELICES,
    losses=("friction_loss.power_w",),
    from_file=FromFile(MESH, unknown=NOT_OF_A_MESH),
)
