"""Programs that describe an oil in the form of the previous minor version still run."""

import pytest

from solvers.lubricants import Lubricant
from solvers.oils import OilSheet, iso_vg, sheet_of_index
from solvers.scuffing import OilChoice


@pytest.mark.parametrize(
    ("former", "now"),
    [
        (OilChoice(), None),
        (OilChoice(iso_vg=220), iso_vg(220)),
        (OilChoice(iso_vg=220, viscosity_index=120.0), sheet_of_index(220 * 1e-6, 120.0)),
        (OilChoice(kinematic_viscosity_40=100e-6, kind="pao"), sheet_of_index(100e-6, kind="pao")),
        (
            OilChoice(
                kinematic_viscosity_40=220e-6, kinematic_viscosity_100=19e-6, density_15=870.0, specific_heat=2100.0
            ),
            OilSheet(220e-6, 19e-6, density_15=870.0, specific_heat=2100.0),
        ),
        (OilChoice(viscosity=0.02, density=850.0, kind="pao"), Lubricant(0.02, density=850.0, kind="pao")),
    ],
)
def test_a_former_oil_is_that_of_today(former: OilChoice, now: OilSheet | Lubricant | None) -> None:
    assert former.resolve() == now
