"""The cooling of a gear pair or a gear unit, and the results of the heat balance."""

from typing import ClassVar

from app.schema.model import Group, Section
from solvers.heat_balance import inputs as si
from solvers.heat_balance import results


class CasingOfGears(Section, of=si.Casing):
    """The casing of the gears. If no area is given, the heat balance leaves the casing out."""

    def unused(self) -> dict[str, bool]:
        """Mark all fields except the area as unused if the area is not given."""
        return dict.fromkeys(type(self).model_fields, self.area_m2 is None) | {"area_m2": False}


class MeasuredTemperatures(Section, of=si.Measured):
    """Temperatures measured in operation.

    If the temperature of a gear is given, the wetting share follows from this temperature. If the temperature of the
    drained oil is given, the field `other_w` of the cooling follows from this temperature.
    """

    exclusive: ClassVar = (("pinion_flank_c", "pinion_body_c"), ("wheel_flank_c", "wheel_body_c"))

    @property
    def of_a_gear(self) -> bool:
        """Whether a temperature of a gear is given."""
        return any(getattr(self, name) is not None for group in self.exclusive for name in group)


class GearCooling(Section, of=si.Cooling):
    """The supply of oil to the teeth, further losses that heat the oil, and measured temperatures."""

    def unused(self) -> dict[str, bool]:
        """Mark fields as unused if their values follow from other inputs that are given.

        The oil flow determines the rise of the oil temperature. The measured temperature of a gear determines the
        wetting share. The measured temperature of the drained oil determines the losses in the field `other_w`.
        """
        measured = self.measured
        return {
            "flow_rise_k": self.gear_flow_l_per_min is not None,
            "wetting_share": measured.of_a_gear,
            "other_w": measured.drain_c is not None,
        }


class GearHeat(Group, of=results.GearTemperatures):
    """Temperatures of a gear, the frictional heat that enters the gear, and the cooling by the oil film."""


class BearingHeatBalance(Group, of=results.BearingHeat):
    """Temperatures, oil flow and friction of a plain bearing, as computed by the heat balance."""


class FlowOfHeat(Group, of=results.HeatFlow):
    """A heat flow in the network of the heat balance, from one node to another."""


class HeatLosses(Group, of=results.HeatLosses):
    """The power losses that heat the oil and the gears."""


class HeatSuppliedRemoved(Group, of=results.Balance):
    """The supplied heat, the removed heat, and the difference of the two divided by the supplied heat."""


class BulkByStandards(Group, of=results.BulkEstimates):
    """Bulk temperatures by ISO/TR 13989-1 and ISO/TS 6336-22, for comparison with the heat balance."""


class BandOfHeat(Group, of=results.HeatBand):
    """Ranges of the flank temperatures and of the safety factor.

    The ranges show the effect of the uncertain cooling. They state no probability.
    """


class HeatBalanceResult(Group, of=results.Heat):
    """Temperatures, losses and heat flows that result from the heat balance."""


class CoolingInForce(Group, of=results.CoolingInForce):
    """The values that the calculation uses for cooling inputs that a request may leave out."""
