"""Diameters of the gears of a pair, as drawings state them."""

from solvers.gears.pair import GearPair
from solvers.quantity import quantity, record
from solvers.sources import ISO_21771


@record(kw_only=True)
class Diameters:
    """Tip and root diameters [m]."""

    pinion_tip_diameter: float = quantity(
        "tip diameter of the pinion", "d_a1", ISO_21771, unit="mm", equation="load-distribution#geometry"
    )
    wheel_tip_diameter: float = quantity(
        "tip diameter of the wheel", "d_a2", ISO_21771, unit="mm", equation="load-distribution#geometry"
    )
    pinion_root_diameter: float = quantity(
        "root diameter of the pinion", "d_f1", ISO_21771, unit="mm", equation="load-distribution#geometry"
    )
    wheel_root_diameter: float = quantity(
        "root diameter of the wheel", "d_f2", ISO_21771, unit="mm", equation="load-distribution#geometry"
    )


def diameters_of(pair: GearPair) -> dict[str, float]:
    """Return the diameters of a pair; the keys are the field names of `Diameters`."""
    return {
        f"{name}_{circle}_diameter": 2 * getattr(gear, f"{circle}_radius")
        for circle in ("tip", "root")
        for name, gear in (("pinion", pair.pinion), ("wheel", pair.wheel))
    }
