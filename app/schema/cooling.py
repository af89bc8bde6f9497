"""How a gear pair or unit is cooled, and what the heat balance answers."""

from typing import ClassVar

from app.schema.model import Group, Section
from solvers.heat_balance import inputs as si
from solvers.heat_balance import results


class CasingOfGears(Section, of=si.Casing):
    """The casing; without an area it does not take part."""

    def unused(self) -> dict[str, bool]:
        """Mark all other fields as unused if the area of the casing is not given."""
        return dict.fromkeys(type(self).model_fields, self.area_m2 is None) | {"area_m2": False}


class MeasuredTemperatures(Section, of=si.Measured):
    """Temperatures measured in operation: one of a gear fixes the wetting share, that of the drain the other losses."""

    exclusive: ClassVar = (("pinion_flank_c", "pinion_body_c"), ("wheel_flank_c", "wheel_body_c"))

    @property
    def of_a_gear(self) -> bool:
        """Whether a temperature of a gear is given."""
        return any(getattr(self, name) is not None for group in self.exclusive for name in group)


class GearCooling(Section, of=si.Cooling):
    """How the oil reaches the teeth, what else heats it, and what was measured."""

    def unused(self) -> dict[str, bool]:
        """Mark the fields as unused whose values a measured temperature or a given oil flow replaces."""
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
    """A gear in the balance."""


class BearingHeatBalance(Group, of=results.BearingHeat):
    """A plain bearing in the balance."""


class FlowOfHeat(Group, of=results.HeatFlow):
    """Heat from one place of the network to another."""


class HeatLosses(Group, of=results.HeatLosses):
    """What heats oil and gears."""


class HeatSuppliedRemoved(Group, of=results.Balance):
    """Heat supplied and removed."""


class BulkByStandards(Group, of=results.BulkEstimates):
    """Bulk temperatures by rules of standards, for comparison."""


class BandOfHeat(Group, of=results.HeatBand):
    """Range of what is unknown of the cooling; not a probability."""


class HeatBalanceResult(Group, of=results.Heat):
    """Temperatures, losses and flows of heat."""


class CoolingInForce(Group, of=results.CoolingInForce):
    """What was left open of the cooling."""
