"""The bulk temperature of the contact: given, estimated, by heat balance, or between the last two without a step."""

from dataclasses import dataclass

from solvers.heat_balance import Cooling
from solvers.scuffing.inputs import BulkMethod, Temperatures
from solvers.scuffing.safety_results import BulkInForce, BulkRan

FLOODED_UP_TO, STARVED_FROM = (
    20.0,
    60.0,
)  # m/s, chosen: flanks are flooded; jets alone wet them

Flanks = tuple[float, float]


def method_asked(temperatures: Temperatures, cooling: Cooling, *, has_oil: bool) -> BulkMethod | None:
    """Return the method for the bulk temperature; None for the rule between the estimate and the heat balance.

    A measured temperature asks for the heat balance at every speed. The rule needs jets of a known oil, because the
    heat balance does.
    """
    if temperatures.bulk_method is not None:
        return temperatures.bulk_method
    if temperatures.bulk is not None and temperatures.flanks is None:
        return "given"
    if not has_oil or temperatures.oil_supply != "spray":
        return "estimated"
    return "heat_balance" if cooling.measured.any else None


def balance_share(velocity: float) -> float:
    """Share s of the heat balance in the rule: 0 up to 20 m/s, 1 from 60 m/s, linear between (Eq. H25)."""
    return min(max((velocity - FLOODED_UP_TO) / (STARVED_FROM - FLOODED_UP_TO), 0.0), 1.0)


@dataclass(frozen=True, slots=True)
class BulkRule:
    """How the bulk temperature follows from the estimate [K] and from the flanks of the heat balance.

    `estimate` is None where the flash temperature has no mean. `share` is s; None where a method was chosen.
    """

    method: BulkMethod | None
    estimate: float | None
    share: float | None

    @property
    def weight(self) -> float:
        """Share of a difference between two places of a flank, by the balance, that the contact takes."""
        return 1.0 if self.method == "heat_balance" else self.share or 0.0

    @property
    def takes_balance(self) -> bool:
        """Whether the heat balance can have an effect on the bulk temperature."""
        return self.method == "heat_balance" or (self.method is None and bool(self.share))

    def surfaces(self, flanks: Flanks) -> Flanks | None:
        """Bulk temperatures of both flanks in the contact [K], estimate + s max(0, F - estimate) in the mean (Eq. H25).

        The flanks differ from their mean by s times their difference in the balance, also where the balance lies below
        the estimate: otherwise they would jump where both are equal.
        """
        if self.method == "heat_balance":
            return flanks
        if self.estimate is None or self.share is None:  # without an estimate, only the balance alone can be stated
            return flanks if self.share == 1.0 else None
        mean = sum(flanks) / 2
        bulk = self.estimate + self.share * max(0.0, mean - self.estimate)
        return bulk + self.share * (flanks[0] - mean), bulk + self.share * (flanks[1] - mean)

    def bulk(self, flanks: Flanks) -> float | None:
        """Mean bulk temperature of the contact [K] for the flanks of a heat balance."""
        surfaces = self.surfaces(flanks)
        return None if surfaces is None else sum(surfaces) / 2

    def in_force(self, flanks: Flanks | None) -> BulkInForce:
        """Say what ran; `flanks` are those of the heat balance, None without one."""
        balance = None if flanks is None else sum(flanks) / 2
        if self.method is not None:
            return BulkInForce(self.method, self.estimate, balance, None)
        above = balance is not None and (self.estimate is None or balance > self.estimate)
        ran: BulkRan = "estimated"
        if above and self.share:
            ran = "heat_balance" if self.share == 1.0 else "between"
        return BulkInForce(ran, self.estimate, balance, self.share)
