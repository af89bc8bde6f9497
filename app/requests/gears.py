"""Gear pairs, shared by pumping and scuffing."""

from typing import Annotated, Literal

from app.requests.common import Section
from app.schema.conversion import to_si
from app.schema.quantities import Input
from solvers.gears.inputs import GearPairInputs, GearTeeth, normal_section

ISO_21771 = "ISO 21771"
RACK_TIP_RADIUS = Input(
    "rack tip radius coefficient",
    "ρ_fP*",
    "ISO 53",
    text="tip radius coefficient of the rack",
    ge=0,
    le=0.6,
    tolerance=0.02,
)


class GearMember(Section):
    """One gear of the pair; coefficients count normal modules."""

    teeth: Annotated[int, Input("number of teeth", "z", ISO_21771, ge=5, le=1000)]
    profile_shift: Annotated[float, Input("profile shift coefficient", "x", ISO_21771, ge=-2, le=3, tolerance=0.01)] = (
        0.0
    )
    addendum: Annotated[
        float,
        Input(
            "addendum coefficient",
            "h_aP*",
            "ISO 53",
            text="addendum coefficient of the rack; the tip radius follows",
            ge=0.01,
            le=3,
        ),
    ] = 1.0
    dedendum: Annotated[
        float,
        Input(
            "dedendum coefficient",
            "h_fP*",
            "ISO 53",
            text="dedendum coefficient of the rack; the root radius follows",
            ge=0.01,
            le=3,
        ),
    ] = 1.25


class Gears(Section):
    """An external parallel-axis pair, spur or helical; the pinion drives.

    Each model adds `rack_tip_radius` with its own default.
    """

    pinion: Annotated[GearMember, Input("pinion", text="the driving gear")]
    wheel: Annotated[GearMember, Input("wheel", text="the driven gear")]
    module_mm: Annotated[
        float, Input("module", "m", ISO_21771, text="module, in the plane named by `module_plane`", ge=0.01, le=100)
    ]
    module_plane: Annotated[
        Literal["normal", "transverse"],
        Input("plane of the module", None, ISO_21771, text="plane of module and pressure angle"),
    ] = "normal"
    pressure_angle_deg: Annotated[
        float,
        Input(
            "pressure angle",
            "α",
            ISO_21771,
            text="pressure angle at the reference circle, in the module's plane",
            ge=10,
            le=35,
        ),
    ] = 20.0
    helix_angle_deg: Annotated[
        float,
        Input(
            "helix angle",
            "β",
            ISO_21771,
            text="helix angle at the reference circle; the hand does not matter",
            ge=0,
            le=45,
            tolerance=0.05,
        ),
    ] = 0.0
    face_width_mm: Annotated[
        float, Input("face width", "b", ISO_21771, text="common face width", ge=0.01, le=5000, tolerance=0.1)
    ]
    centre_distance_mm: Annotated[
        float | None,
        Input(
            "centre distance",
            "a",
            ISO_21771,
            ge=0.1,
            le=20000,
            default_text="the backlash-free value",
            tolerance=0.02,
        ),
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
