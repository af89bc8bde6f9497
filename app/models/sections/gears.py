"""Gear pairs and their materials, shared by pumping and scuffing."""

from typing import Annotated, Any, ClassVar

from pydantic import model_validator

from app.schema.model import Section
from app.schema.quantities import Input
from solvers.gears.inputs import GROUND_FILLET, RACK_A, GearPairInputs, GearTeeth
from solvers.materials import Solid
from solvers.pumping.inputs import PumpingSetup

QUALITY_CLASS = "gears.quality_class"
"""The field of the quality class."""
SLOPES_BY_CLASS = ("modifications.helix_slope_um", "modifications.profile_slope_um")
"""The fields that scatter by the quality class of the gears."""
SECOND_BY_CLASS = "modifications.second_helix.helix_slope_um"
"""The field of a second helix that does."""


def of_class(quality_class: int) -> dict[str, Any]:
    """Return what a request changes for gears of a quality class, by the paths of the fields."""
    return {QUALITY_CLASS: quality_class}


class GearMember(Section, of=GearTeeth):
    """One gear of the pair. Coefficients, such as the addendum, are multiples of the normal module."""

    exclusive: ClassVar = (("addendum", "tip_diameter_mm"),)
    choice_missing: ClassVar = "missing_property"

    @model_validator(mode="before")
    @classmethod
    def addendum_follows_the_tip_diameter(cls, given: Any) -> Any:
        """Set the addendum to null if the request gives a tip diameter but no addendum."""
        by_diameter = isinstance(given, dict) and given.get("tip_diameter_mm") is not None
        return {"addendum": None} | given if by_diameter else given


class Gears(Section, of=GearPairInputs, without=("rack_tip_radius", "quality_class")):
    """An external gear pair, spur or helical, with parallel axes. The pinion drives.

    Subclasses add `rack_tip_radius`, because the default of this field depends on the calculation, and
    `quality_class`, where a calculation knows the deviations of flanks.
    """

    def assumed_widths(self) -> dict[str, str]:
        """Say what two helices and their gap measure together, because three conventions of the width are in use."""
        if self.gap_width_mm is None:
            return {}
        b, e = self.face_width_mm, self.gap_width_mm
        return {"gears.face_width_mm": f"of one helix: two of {b:g} mm and the gap of {e:g} mm are {2 * b + e:g} mm"}


class ScuffingGears(Gears, of=GearPairInputs, only=("quality_class",)):
    """The gear pair of the scuffing calculations."""

    rack_tip_radius: Annotated[
        float,
        Input.of(
            GearPairInputs,
            "rack_tip_radius",
            text="tip radius coefficient of the rack",
            assumed="rack A of ISO 53; the paper gives none",
        ),
    ] = RACK_A


class BacklashGears(Gears, of=PumpingSetup, only=("normal_backlash",)):
    """The gear pair with its backlash."""


class PumpingGears(BacklashGears):
    """The gear pair of the pumping calculations."""

    rack_tip_radius: Annotated[float, Input.of(GearPairInputs, "rack_tip_radius")] = GROUND_FILLET


class Surface(Section, of=Solid, without=("roughness",)):
    """The material of a surface; the default is steel."""


class GearMaterial(Surface, of=Solid):
    """Material and roughness of one gear."""


class GearMaterials(Section):
    """Materials of both gears."""

    pinion: Annotated[GearMaterial, Input("pinion material")] = GearMaterial()
    wheel: Annotated[GearMaterial, Input("wheel material")] = GearMaterial()
