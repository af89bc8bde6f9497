"""What a gear unit's mesh is described by beyond scuffing and pumping: sections of /v1/drive-train."""

from dataclasses import replace
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from app.requests.flank_modifications import FlankModifications
from app.requests.load_distribution import ScuffingLoad
from app.requests.scuffing_options import ScuffingModel
from app.schema.base import Section
from app.schema.conversion import to_si
from app.schema.gears import BacklashGears
from app.schema.pumping import PumpingOptions
from app.schema.quantities import Input
from solvers.drive_train import inputs as si
from solvers.gears.inputs import GearPairInputs
from solvers.scuffing import inputs as mesh

PUMPING_RACK, MESH_RACK = 0.25, 0.38

_ARRANGEMENT = si.Arrangement()


class TrainGears(BacklashGears):
    """The gear pair."""

    rack_tip_radius: Annotated[
        float | None,
        Input(
            "rack tip radius coefficient",
            "ρ_fP*",
            "ISO 53",
            text="tip radius coefficient of the rack, of mesh and pumped spaces alike",
            ge=0,
            le=0.6,
            tolerance=0.02,
            default_text=f"{MESH_RACK} for the mesh, {PUMPING_RACK} for the pumped spaces",
            assumed=f"rack A of ISO 53, {MESH_RACK}, for the mesh; a ground fillet, {PUMPING_RACK}, for the spaces",
        ),
    ] = None
    hand: Annotated[
        Literal["right", "left"], Input("hand of the pinion's helix", text="without meaning for spur gears")
    ] = _ARRANGEMENT.hand

    def mesh_pair(self) -> GearPairInputs:
        """The pair of the load distribution."""
        return self._pair(MESH_RACK)

    def pumping_pair(self) -> GearPairInputs:
        """The pair of the pumped spaces."""
        return self._pair(PUMPING_RACK)

    def _pair(self, rack_tip_radius: float) -> GearPairInputs:
        """The pair; `rack_tip_radius` counts where none is given."""
        pair = self.si(GearPairInputs)
        return pair if self.rack_tip_radius is not None else replace(pair, rack_tip_radius=rack_tip_radius)


class TrainOperation(ScuffingLoad):
    """Torque or power, speed, and how the unit stands and turns."""

    rotation: Annotated[
        Literal["counterclockwise", "clockwise"],
        Input("rotation of the pinion", text="rotation of the pinion, seen from +Z"),
    ] = _ARRANGEMENT.rotation
    wheel_angle_deg: Annotated[
        float,
        Input(
            "direction to the wheel", "γ_W", text="from pinion to wheel, from X towards Y", ge=-360, le=360, tolerance=1
        ),
    ] = _ARRANGEMENT.wheel_angle
    gravity_angle_deg: Annotated[
        float, Input("direction of gravity", "γ_g", text="from X towards Y", ge=-360, le=360, tolerance=1)
    ] = -90.0
    gravity_factor: Annotated[
        float, Input("gravity factor", "g/g_0", text="weight over that on earth", ge=0, le=10, tolerance=0.1)
    ] = _ARRANGEMENT.gravity_factor

    @model_validator(mode="after")
    def torque_or_power(self) -> Self:
        """Refuse both and neither."""
        if self.pinion_torque_n_m is None and self.power_kw is None:
            raise PydanticCustomError("load_missing", "give pinion_torque_n_m or power_kw")
        if self.pinion_torque_n_m is not None and self.power_kw is not None:
            raise PydanticCustomError("torque_or_power", "pinion_torque_n_m and power_kw are both given; keep one")
        return self

    def arrangement(self, gears: TrainGears) -> si.Arrangement:
        """The solver's arrangement."""
        fields = to_si(self) | to_si(gears)
        return si.Arrangement(**{name: fields[name] for name in si.Arrangement.__dataclass_fields__})


class GroundCurve(Section):
    """Any gap along the face beyond the named modifications; empty lists are none."""

    position_mm: Annotated[
        list[float],
        Field(max_length=1000),
        Input(
            "positions of the lead curve",
            "y",
            text="rising, from the end that meshes first",
            ge=0,
            le=5000,
            tolerance=0.1,
        ),
    ] = Field(default_factory=list)
    gap_um: Annotated[
        list[float],
        Field(max_length=1000),
        Input("lead curve", "Δ_β", text="gap, positive where material is missing", ge=-1000, le=1000, tolerance=2),
    ] = Field(default_factory=list)


class TrainModifications(FlankModifications):
    """Modifications as ground, positive where material is missing."""

    lead_curve: Annotated[GroundCurve, Input("lead curve", text="any gap along the face")] = GroundCurve()

    def modifications(self) -> mesh.Modifications:
        """The solver's modifications."""
        curve = self.lead_curve
        given = bool(curve.position_mm or curve.gap_um)
        return mesh.Modifications(**to_si(self), lead_curve=mesh.LeadCurve(**to_si(curve)) if given else None)


class TrainModel(ScuffingModel, PumpingOptions):
    """Choices where the papers leave room, and the resolution."""

    face_stations: Annotated[
        int, Input("stations over the face", "n", text="at which shafts and mesh meet", ge=5, le=201, advanced=True)
    ] = si.STATIONS
    coupling_friction: Annotated[
        si.CouplingFriction,
        Input(
            "friction law of the hubs",
            text="teeth that yield before they slide, or full sliding at any tilt, for comparison",
            assumed="own derivation; no measurement of a well aligned hub is known",
            advanced=True,
        ),
    ] = "elastic_plastic"
