"""How a gear pair carries its load: request and answer of /v1/scuffing/load-distribution."""

from typing import Annotated, ClassVar

from app.schema.gears import GearMaterials, ScuffingGears
from app.schema.model import Derived, Group, Request, Response, Section
from app.schema.quantities import Input, View
from solvers.gears.inputs import GearPairInputs
from solvers.materials import Solid
from solvers.scuffing import inputs as si
from solvers.scuffing import results

FRICTION_COEFFICIENT = Input.of(si.LoadDistributionInputs, "friction_coefficient")


class FlankModifications(Section, of=si.Modifications, without=("lead_curve",)):
    """Gaps along the transverse line of action, positive where material is missing."""

    def unused(self) -> set[str]:
        """Lengths and exponent of reliefs that are zero."""
        amplitudes = {relief: getattr(self, f"{relief}_um") for relief in ("tip_relief", "root_relief", "end_relief")}
        unused = {f"{relief}_length_mm" for relief, value in amplitudes.items() if value == 0.0}
        return unused if any(amplitudes.values()) else {*unused, "relief_exponent"}


class ScuffingLoad(Section, of=si.Load):
    """Torque or power, and speed; exactly one of torque and power is given."""

    exclusive: ClassVar = (("pinion_torque_n_m", "power_kw"),)
    choice_code: ClassVar = "torque_or_power"
    choice_missing: ClassVar = "torque_or_power"

    pinion_torque_n_m: float | None = None


class LoadDistributionModel(Section, of=(si.Model, si.Resolution)):
    """Choices where the paper leaves room."""


class GearPairRequest(Request):
    """A loaded, modified, misaligned gear pair."""

    gears: Annotated[ScuffingGears, Input("gear pair")]
    load: Annotated[ScuffingLoad, Input("load", text="torque or power, and speed")]
    modifications: Annotated[FlankModifications, Input("modifications", text="modification and misalignment")] = (
        FlankModifications()
    )
    materials: Annotated[GearMaterials, Input("materials", text="materials of the pair")] = GearMaterials()


def distribution_inputs(request: Request, gears: GearPairInputs, load: si.Load) -> si.LoadDistributionInputs:
    """The solver's inputs for this pair and load, of a request with modifications, materials and friction."""
    return request.si(
        si.LoadDistributionInputs,
        gears=gears,
        load=load,
        pinion_material=request.materials.pinion.si(Solid),
        wheel_material=request.materials.wheel.si(Solid),
        resolution=request.model.si(si.Resolution),
    )


class LoadDistributionRequest(GearPairRequest):
    """A loaded, modified, misaligned gear pair and the friction between its flanks."""

    friction_coefficient: Annotated[float, FRICTION_COEFFICIENT] = 0.06
    model: Annotated[
        LoadDistributionModel, Input("model", text="choices where the paper leaves room", advanced=True)
    ] = LoadDistributionModel()

    def inputs(self) -> si.LoadDistributionInputs:
        """The solver's inputs."""
        return distribution_inputs(self, self.gears.si(GearPairInputs), self.load.si(si.Load))

    def unused(self) -> set[str]:
        """Roughness, which loads do not depend on."""
        return {"materials.pinion.roughness_um", "materials.wheel.roughness_um"}


class ScuffingGeometry(Group, of=results.Geometry):
    """The mesh."""


class ContactLengthCurves(Group, of=results.LengthCurves):
    """Total contact length over one base pitch; a spur gear's jumps stand twice."""


class ContactLineLengths(Group, of=results.ContactLines):
    """Total length of the contact lines."""


class ToothStiffnessCurves(Group, of=results.StiffnessCurves):
    """Stiffness of one pair of teeth along the path."""


class ToothStiffness(Group, of=results.Stiffness):
    """Stiffness per face width."""


class TransmissionErrorCurves(Group, of=results.ErrorCurves):
    """Transmission error over one base pitch; a spur gear's jumps stand twice."""


class TransmissionErrorResult(Group, of=results.TransmissionError):
    """Transmission error along the transverse line of action."""

    views: ClassVar = {"peak_to_peak": View(headline=3)}


class MeshLoss(Group, of=results.FrictionLoss):
    """Friction loss at the mean coefficient; power and efficiency are those of the transmitted power."""


class MeshDerived(Derived, of=results.Derived, without=("rack_tip_radius",)):
    """Load and lengths where the request left them open."""


class ScuffingDerived(MeshDerived, of=results.Derived):
    """Load and lengths where the request left them open, and what is used of the rack."""


class FlankPlace(Group, of=results.Place):
    """A point of the flank."""


class FlankLoad(Group, of=results.LoadOnFlank):
    """Load on the flank."""

    views: ClassVar = {"face_load_factor": View(headline=2), "contact_fraction": View(percent=True)}

    pair_share: list[list[float]] | None


class FlankPressure(Group, of=results.Pressure):
    """Dry Hertzian pressure."""

    views: ClassVar = {"max": View(headline=1)}


class FeatureLineCurves(Group, of=results.FeatureLine):
    """Along the feature line from A1 to E2; the points A, C and E of the path lie on it."""


class FlankFields(Group, of=results.Flank):
    """Over the flank, `[profile][face]`."""


class LoadDistributionResponse(Response, of=results.LoadDistribution):
    """How a gear pair carries its load; sections are missing where there is no solution."""
