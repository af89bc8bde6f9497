"""The cooling of a gear pair or a gear unit, and the results of the heat balance."""

from typing import ClassVar

from app.schema.model import Group, Section
from solvers.heat_balance import inputs as si
from solvers.heat_balance import results


class CasingOfGears(Section, of=si.Casing):
    """The casing in the heat balance. If no area is given, the balance leaves the casing out."""

    def unused(self) -> dict[str, bool]:
        """Mark all other fields as unused if the area of the casing is not given."""
        return dict.fromkeys(type(self).model_fields, self.area_m2 is None) | {"area_m2": False}


class MeasuredTemperatures(Section, of=si.Measured):
    """Temperatures measured in operation.

    The measured temperature of a gear determines the wetting share. The measured drain temperature determines the other
    losses.
    """

    exclusive: ClassVar = (("pinion_flank_c", "pinion_body_c"), ("wheel_flank_c", "wheel_body_c"))

    @property
    def of_a_gear(self) -> bool:
        """Whether a temperature of a gear is given."""
        return any(getattr(self, name) is not None for group in self.exclusive for name in group)


class GearCooling(Section, of=si.Cooling):
    """The supply of oil to the teeth, further losses that heat the oil, and measured temperatures."""

    def unused(self) -> dict[str, bool]:
        """Mark fields as unused if a measured temperature or a given oil flow replaces the values of these fields."""
        measured = self.measured
        return {
            "flow_rise_k": self.gear_flow_l_per_min is not None,
            "wetting_share": measured.of_a_gear,
            "other_w": measured.drain_c is not None,
        }

    @property
    def is_given(self) -> bool:
        """Whether any field of the cooling is given."""
        return bool(self.model_fields_set)


class GearHeat(Group, of=results.GearTemperatures):
    """Temperatures of a gear in the heat balance, its frictional heat, and its cooling by the oil film."""


class BearingHeatBalance(Group, of=results.BearingHeat):
    """Temperatures, oil flow and friction of a plain bearing in the heat balance."""


class FlowOfHeat(Group, of=results.HeatFlow):
    """A heat flow from one place in the network of the heat balance to another."""


class HeatLosses(Group, of=results.HeatLosses):
    """The power losses that heat the oil and the gears."""


class HeatSuppliedRemoved(Group, of=results.Balance):
    """The heat that is supplied, the heat that is removed, and the relative difference between the two."""


class BulkByStandards(Group, of=results.BulkEstimates):
    """Bulk temperatures by the rules of two standards, for comparison with the heat balance."""


class BandOfHeat(Group, of=results.HeatBand):
    """Range of results that the uncertainty of the cooling allows; it states no probability."""


class HeatBalanceResult(Group, of=results.Heat):
    """Temperatures, losses and heat flows that result from the heat balance."""


class CoolingInForce(Group, of=results.CoolingInForce):
    """Values used for the inputs of the cooling that the request left open."""
