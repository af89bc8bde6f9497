"""The cooling of a gear pair or a gear unit."""

from typing import ClassVar

from app.schema.model import Section
from solvers.heat_balance import inputs as si


class CasingOfGears(Section, of=si.Casing):
    """The casing of the gears. If no area is given, the heat balance leaves the casing out."""

    def unused(self) -> dict[str, bool]:
        return dict.fromkeys(type(self).model_fields, self.area_m2 is None) | {"area_m2": False}


class MeasuredTemperatures(Section, of=si.Measured):
    """Temperatures measured in operation.

    If temperatures of a gear are given, the wetting share follows from them. If the temperature of the
    drained oil is given, the field `other_w` of the cooling follows from this temperature.
    """

    exclusive: ClassVar = (("pinion_flank_c", "pinion_body_c"), ("wheel_flank_c", "wheel_body_c"))

    @property
    def of_a_gear(self) -> bool:
        """Whether a temperature of a gear is given."""
        names = (name for group in self.exclusive for name in group)
        return bool(self.face) or any(getattr(self, name) is not None for name in names)


class GearCooling(Section, of=si.Cooling):
    """The supply of oil to the teeth, further losses that heat the oil, and measured temperatures."""

    def unused(self) -> dict[str, bool]:
        measured = self.measured
        return {
            "flow_rise_k": self.gear_flow_l_per_min is not None,
            "wetting_share": measured.of_a_gear,
            "other_w": measured.drain_c is not None,
        }
