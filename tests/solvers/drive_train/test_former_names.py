"""Programs that describe a bearing as in the previous minor version still run."""

from collections.abc import Callable

import pytest

from solvers.drive_train import JournalBearing, LinearBearing, RigidBearing, ShaftBearing
from solvers.drive_train.inputs import Bearing, gear_oil_viscosity
from solvers.oils import iso_vg
from tests.support.outcomes import refused

OIL, WARM = iso_vg(46), 323.15
STIFFNESS = ((4e8, 0.0), (0.0, 4e8))


@pytest.mark.parametrize(
    ("former", "now"),
    [
        (ShaftBearing(0.1, "rigid", (1e-6, 0.0)), lambda: RigidBearing(0.1, offset=(1e-6, 0.0))),
        (ShaftBearing(0.1, "linear", stiffness=STIFFNESS), lambda: LinearBearing(0.1, STIFFNESS)),
        (ShaftBearing(0.1, diameter=0.16, width=0.11, viscosity=0.014), lambda: JournalBearing(0.1, 0.16, 0.11, 0.014)),
        (
            ShaftBearing(0.1, diameter=0.16, width=0.11, oil_flow=1e-4),
            lambda: JournalBearing(
                0.1, 0.16, 0.11, gear_oil_viscosity(OIL, WARM, None), in_gear_oil=True, oil_flow=1e-4
            ),
        ),
        (
            ShaftBearing(0.1, diameter=0.16, width=0.11, film_temperature=345.0),
            lambda: JournalBearing(0.1, 0.16, 0.11, gear_oil_viscosity(OIL, WARM, 345.0)),
        ),
    ],
)
def test_a_former_bearing_is_that_of_today(former: ShaftBearing, now: Callable[[], Bearing]) -> None:
    assert former.bearing(OIL, WARM) == now()


def test_a_former_bearing_without_its_data_is_refused() -> None:
    assert refused(lambda: ShaftBearing(0.1, "linear").bearing(OIL, WARM)) == ("bearing_data", "stiffness")
    assert refused(lambda: ShaftBearing(0.1, width=0.1).bearing(OIL, WARM)) == ("bearing_data", "diameter")
    plain = ShaftBearing(0.1, diameter=0.16, width=0.11)
    assert refused(lambda: plain.bearing(None, WARM)) == ("no_oil", "viscosity")


def test_the_film_is_warmer_than_the_oil() -> None:
    assert gear_oil_viscosity(OIL, WARM, None) == pytest.approx(OIL.viscosity(WARM + 15.0), rel=1e-12)
