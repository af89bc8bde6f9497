"""What is said of the answers about the load distribution: components and views."""

from app.models.card import FromFile, Words
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

WORDS = Words(losses=("friction_loss.power_w",), from_file=FromFile(MESH, unknown=NOT_OF_A_MESH))
