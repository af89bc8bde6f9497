"""Programs that were written for the previous minor version still run."""

from math import radians

import pytest

from solvers.coupling import (
    Coupling,
    CouplingDesign,
    CouplingInputs,
    CouplingOil,
    Lubricant,
    OperatingPoint,
    OperatingRange,
    Operation,
    solve,
)
from solvers.errors import InvalidInput

NOW = CouplingInputs(Coupling(teeth=52, module=3e-3), Operation(3000.0, 200.0, misalignment=radians(0.05)))


def test_former_inputs_are_those_of_today() -> None:
    design = CouplingDesign(teeth=52, module=3e-3)
    point = OperatingPoint(3000.0, 200.0, misalignment=radians(0.05))
    former = CouplingInputs(design.coupling(), point.operation(design.hub_distance), CouplingOil().lubricant())
    assert former == NOW
    assert solve(former).axial_thrust == solve(NOW).axial_thrust
    assert (
        OperatingRange(torque=3000.0, speed=200.0, misalignment_range=(radians(0.05), 0.1)).operation() == NOW.operation
    )


def test_a_former_oil_by_grade_has_its_viscosity_at_the_teeth() -> None:
    oil = CouplingOil(iso_vg=46)
    sheet = oil.sheet()
    assert sheet is not None
    assert oil.lubricant() == Lubricant(sheet.viscosity(323.15), 1e-6, sheet.viscosity_index, 323.15)


def test_a_former_point_without_tilt_is_refused() -> None:
    with pytest.raises(InvalidInput, match="give misalignment or parallel_offset"):
        OperatingPoint(1.0, 1.0).operation(0.2)
    with pytest.raises(InvalidInput, match="give the viscosity"):
        CouplingOil(viscosity=None).lubricant()
