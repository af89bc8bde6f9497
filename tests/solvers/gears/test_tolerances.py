"""Tolerances of a quality class: values of a public calculation, the standard's rounding, and its limits."""

from math import hypot, sqrt
from typing import Any

import pytest

from solvers.errors import InvalidInput
from solvers.gears.inputs import RACK_A, GearPairInputs, GearTeeth
from solvers.gears.tolerances import FlankTolerances, flank_tolerances, rounded


def pair(quality_class: int | None, module: float = 3e-3, face_width: float = 30e-3, **other: Any) -> GearPairInputs:
    teeth = GearTeeth(40), GearTeeth(80)
    return GearPairInputs(
        *teeth, module, face_width=face_width, rack_tip_radius=RACK_A, quality_class=quality_class, **other
    )


def tolerances(*arguments: Any, **other: Any) -> FlankTolerances:
    found = flank_tolerances(pair(*arguments, **other))
    assert found is not None
    return found


def test_class_6_of_a_wheel_with_40_teeth_of_3_mm() -> None:
    """d = 120 mm, b = 30 mm. By hand, times sqrt 2: 6.32, 5.32, 6.465 and hypot(6.465, 7.232) µm.

    A public program (DAYANERA.ai, tests of its ISO 1328-1 rule) states 9 µm for the pitch, too.
    """
    found = tolerances(6)
    pinion = [getattr(found, f"pinion_{name}") for name in ("single_pitch", "profile_slope", "helix_slope", "helix")]
    assert pinion == pytest.approx([9e-6, 7.5e-6, 9e-6, 14e-6], abs=1e-12)


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (12.49, 12.0),
        (12.5, 13.0),
        (10.4, 10.0),
        (10.0, 10.0),
        (7.3, 7.5),
        (7.2, 7.0),
        (5.0, 5.0),
        (4.96, 5.0),
        (4.94, 4.9),
    ],
)
def test_rounding_of_the_standard(value: float, expected: float) -> None:
    assert rounded(value) == expected


def test_two_classes_are_a_factor_of_two_but_for_rounding() -> None:
    for quality_class in range(1, 10):
        finer, coarser = tolerances(quality_class), tolerances(quality_class + 2)
        for name in ("wheel_single_pitch", "wheel_profile_slope", "wheel_helix_slope", "wheel_helix"):
            fine, coarse = (getattr(each, name) * 1e6 for each in (finer, coarser))
            # Both are rounded by at most half of their step.
            steps = [1.0 if value > 10.0 else 0.5 if value >= 5.0 else 0.1 for value in (fine, coarse)]
            assert abs(coarse - 2.0 * fine) <= steps[0] + 0.5 * steps[1] + 1e-9, (quality_class, name)


def test_slopes_of_pinion_and_wheel_are_independent() -> None:
    found = tolerances(5)
    assert found.helix_slope == pytest.approx(hypot(found.pinion_helix_slope, found.wheel_helix_slope))
    assert found.profile_slope == pytest.approx(hypot(found.pinion_profile_slope, found.wheel_profile_slope))


def test_the_module_of_the_transverse_section_counts_as_its_normal_module() -> None:
    slanted = {"helix_angle": 0.4}
    by_normal = tolerances(5, **slanted)
    transverse = tolerances(5, 3e-3 / sqrt(1 - 0.151646645), module_plane="transverse", **slanted)  # sin(0.4)^2
    assert transverse == by_normal


def test_no_tolerances_without_a_class() -> None:
    assert flank_tolerances(pair(None)) is None


@pytest.mark.parametrize(
    ("inputs", "word"),
    [
        ({"module": 0.4e-3}, "module"),
        ({"module": 80e-3}, "module"),
        ({"face_width": 3e-3}, "face width"),
        ({"face_width": 1.3}, "face width"),
    ],
)
def test_the_formulas_are_not_extrapolated(inputs: dict[str, float], word: str) -> None:
    with pytest.raises(InvalidInput, match=word) as refused:
        tolerances(5, **inputs)
    assert (refused.value.code, refused.value.field) == ("quality_class", "quality_class")
