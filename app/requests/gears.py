"""Gear pairs, shared by pumping and scuffing."""

from typing import Annotated, Literal

from app.conversion import to_si
from app.quantities import Input
from app.requests.common import Section
from solvers.gears.inputs import GearPairInputs, GearTeeth, normal_section

ISO_21771 = "ISO 21771"


class GearMember(Section):
    """One gear of the pair; coefficients count normal modules."""

    teeth: Annotated[int, Input("number of teeth", "z", ISO_21771, ge=5, le=1000)]
    profile_shift: Annotated[float, Input("profile shift coefficient", "x", ISO_21771, ge=-2, le=3)] = 0.0
    addendum: Annotated[
        float, Input("addendum coefficient of the rack; the tip radius follows", "h_aP*", "ISO 53", ge=0.01, le=3)
    ] = 1.0
    dedendum: Annotated[
        float, Input("dedendum coefficient of the rack; the root radius follows", "h_fP*", "ISO 53", ge=0.01, le=3)
    ] = 1.25


class Gears(Section):
    """An external parallel-axis pair, spur or helical; the pinion drives.

    Each model adds `rack_tip_radius` with its own default.
    """

    pinion: Annotated[GearMember, Input("the driving gear")]
    wheel: Annotated[GearMember, Input("the driven gear")]
    module_mm: Annotated[float, Input("module, in the plane named by `module_plane`", "m", ISO_21771, ge=0.01, le=100)]
    module_plane: Annotated[
        Literal["normal", "transverse"], Input("plane of module and pressure angle", None, ISO_21771)
    ] = "normal"
    pressure_angle_deg: Annotated[
        float, Input("pressure angle at the reference circle, in the module's plane", "α", ISO_21771, ge=10, le=35)
    ] = 20.0
    helix_angle_deg: Annotated[
        float, Input("helix angle at the reference circle; the hand does not matter", "β", ISO_21771, ge=0, le=45)
    ] = 0.0
    face_width_mm: Annotated[float, Input("common face width", "b", ISO_21771, ge=0.01, le=5000)]
    centre_distance_mm: Annotated[
        float | None, Input("centre distance; null: the backlash-free value", "a", ISO_21771, ge=0.1, le=20000)
    ] = None

    def pair(self, rack_tip_radius: float) -> GearPairInputs:
        """The solver's gear pair."""
        fields = to_si(self)
        module, pressure_angle, helix_angle = fields["module"], fields["pressure_angle"], fields["helix_angle"]
        if self.module_plane == "transverse":
            module, pressure_angle = normal_section(module, pressure_angle, helix_angle)
        return GearPairInputs(
            pinion=GearTeeth(**to_si(self.pinion)),
            wheel=GearTeeth(**to_si(self.wheel)),
            normal_module=module,
            face_width=fields["face_width"],
            normal_pressure_angle=pressure_angle,
            helix_angle=helix_angle,
            centre_distance=fields["centre_distance"],
            rack_tip_radius=rack_tip_radius,
        )
