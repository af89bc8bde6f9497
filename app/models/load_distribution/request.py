"""Request of /v1/scuffing/load-distribution, and what other requests about gear pairs share with it."""

from typing import Annotated, ClassVar

from app.models.sections.gears import GearMaterials, ScuffingGears
from app.schema.model import Request, Section
from app.schema.quantities import Input
from solvers.gears.inputs import GearPairInputs
from solvers.materials import Solid
from solvers.scuffing import inputs as si


class FlankModifications(Section, of=si.Modifications, without=("lead_curve", "second_helix")):
    """Gaps between the flanks because of modifications and misalignment.

    The gaps are measured along the transverse line of action. A gap is positive where material is missing.
    """

    def unused(self) -> dict[str, bool]:
        amplitudes = {relief: getattr(self, f"{relief}_um") for relief in ("tip_relief", "root_relief", "end_relief")}
        lengths = {f"{relief}_length_mm": value == 0.0 for relief, value in amplitudes.items()}
        return lengths | {"relief_exponent": all(lengths.values())}


class ScuffingLoad(Section, of=si.Load):
    """The speed, and either the torque or the power."""

    exclusive: ClassVar = (("pinion_torque_n_m", "power_kw"),)
    choice_code: ClassVar = "torque_or_power"
    choice_missing: ClassVar = "torque_or_power"

    pinion_torque_n_m: float | None = None


class LoadDistributionModel(Section, of=(si.Model, si.Resolution)):
    """Choices that the paper leaves open in the model of the load distribution."""


class GearPairRequest(Request):
    """A loaded gear pair with modifications and misalignment."""

    gears: Annotated[ScuffingGears, Input("gear pair")]
    load: Annotated[ScuffingLoad, Input("load", text="torque or power, and speed")]
    modifications: Annotated[FlankModifications, Input("modifications", text="modification and misalignment")] = (
        FlankModifications()
    )
    materials: Annotated[GearMaterials, Input("materials", text="materials of the pair")] = GearMaterials()


def distribution_inputs(request: Request, gears: GearPairInputs, load: si.Load) -> si.LoadDistributionInputs:
    """Return the solver's inputs for the load distribution of the pair `gears` under `load`."""
    return request.si(
        si.LoadDistributionInputs,
        gears=gears,
        load=load,
        pinion_material=request.materials.pinion.si(Solid),
        wheel_material=request.materials.wheel.si(Solid),
        resolution=request.model.si(si.Resolution),
    )


class LoadDistributionRequest(GearPairRequest):
    """A loaded gear pair with modifications, misalignment and friction between the flanks."""

    friction_coefficient: Annotated[float, Input.of(si.LoadDistributionInputs, "friction_coefficient")] = 0.06
    model: Annotated[
        LoadDistributionModel, Input("model", text="options where the paper leaves the model open", advanced=True)
    ] = LoadDistributionModel()

    def inputs(self) -> si.LoadDistributionInputs:
        return distribution_inputs(self, self.gears.si(GearPairInputs), self.load.si(si.Load))

    def assumed_by_the_model(self) -> dict[str, str]:
        return self.gears.assumed_widths()

    def unused(self) -> dict[str, bool]:
        roughness = {"materials.pinion.roughness_um": True, "materials.wheel.roughness_um": True}
        return roughness | {"load.axial_force_n": self.gears.gap_width_mm is None}
