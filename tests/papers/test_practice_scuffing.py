"""Scuffing practice by ISO/TR 13989-1 on FZG type A gears: friction, scuffing and bulk temperature of a stage."""

from dataclasses import replace

import numpy as np
import pytest

from solvers.gears.pair import meshing_path
from solvers.materials import Solid
from solvers.scuffing.inputs import Load, LoadDistributionInputs, OilSupply, angular_speed
from solvers.scuffing.thermal.practice import (
    bulk_temperature,
    lubricant_factor,
    mean_friction,
    scuffing_risk,
    scuffing_temperature,
)
from tests.support.gear_pairs import FZG_A, FZG_TORQUES

PITCH_LINE_SPEED = 8.3  # m/s, the 8.3 of A/8.3/90
GROUND = Solid(roughness=0.35e-6)


def fzg(stage: int, **factors: float) -> LoadDistributionInputs:
    speed = PITCH_LINE_SPEED / (91.5e-3 * 16 / 40)
    return LoadDistributionInputs(
        FZG_A, Load(FZG_TORQUES[stage - 1], speed, **factors), pinion_material=GROUND, wheel_material=GROUND
    )


def friction(inputs: LoadDistributionInputs, face_load_factor: float = 1.0) -> float:
    return mean_friction(inputs, meshing_path(inputs.gears), lubricant_factor(0.015, "mineral"), face_load_factor)


@pytest.mark.parametrize(("stage", "expected"), [(4, 0.050), (6, 0.052), (8, 0.058), (10, 0.064), (12, 0.068)])
def test_mean_friction_of_the_load_stages(stage: int, expected: float) -> None:
    assert friction(fzg(stage)) == pytest.approx(expected, abs=6e-4)


def test_mean_friction_grows_with_the_fifth_root_of_load_and_factors() -> None:
    assert friction(fzg(8, application_factor=1.5)) / friction(fzg(8)) == pytest.approx(1.5**0.2, rel=1e-12)
    assert friction(fzg(8, dynamic_factor=1.2, mesh_load_factor=1.1)) == pytest.approx(
        friction(fzg(8)) * 1.32**0.2, rel=1e-12
    )


def test_face_load_factor_loads_the_friction_law_as_other_factors_do() -> None:
    """K_Hbeta 1.5 raises the coefficient by 8.4 %."""
    assert friction(fzg(8), 1.5) / friction(fzg(8)) == pytest.approx(1.5**0.2, rel=1e-12)


def test_light_loads_count_as_150_newtons_per_millimetre() -> None:
    """Stage 4 is at 60.75 N m / 36 mm / 20 mm = 84 N/mm; without the bound its coefficient would be 0.044."""
    assert friction(fzg(1)) == friction(fzg(4)) == pytest.approx(0.0496, abs=5e-5)
    assert friction(fzg(4, application_factor=150 / (60.75 / 0.72))) == pytest.approx(friction(fzg(4)))


def test_pitch_line_velocity_counts_up_to_50_metres_per_second() -> None:
    """The working pitch radius is 36.6 mm; at 125 m/s the bound raises the coefficient by (125/50)^0.2 = 1.201."""
    pair = fzg(8)

    def at(velocity: float) -> float:
        return friction(replace(pair, load=replace(pair.load, pinion_speed=velocity / 0.0366)))

    assert at(25.0) / at(50.0) == pytest.approx(2.0**0.2, rel=1e-6)
    assert at(125.0) == pytest.approx(at(50.0), rel=1e-6)


def test_lubricant_factors() -> None:
    assert lubricant_factor(0.015, "mineral") == pytest.approx(0.873, abs=5e-4)
    assert lubricant_factor(0.015, "pao") == pytest.approx(0.8 * 0.873, abs=5e-4)
    assert lubricant_factor(0.015, "polyglycol") == pytest.approx(0.7 * 0.873, abs=5e-4)
    assert lubricant_factor(0.015, "ester") == lubricant_factor(0.015, "mineral")


@pytest.mark.parametrize(("stage", "expected"), [(6, 150.74), (8, 205.76), (10, 276.50), (12, 362.97)])
def test_scuffing_temperature_of_a_stage(stage: int, expected: float) -> None:
    """80 + 2.25 X_L S^2 with X_L = 15^-0.05 = 0.87335, by hand."""
    factor = lubricant_factor(0.015, "mineral")
    assert scuffing_temperature(stage, 1.0, factor) - 273.15 == pytest.approx(expected, abs=0.01)


def test_structure_factor_weighs_in_the_steel() -> None:
    """80 + (0.85 + 1.4 0.45) 12^2 = 293.12 C for an austenitic share that halves X_W."""
    assert scuffing_temperature(12, 0.45, 1.0) - 273.15 == pytest.approx(293.12, abs=1e-9)


@pytest.mark.parametrize(("supply", "share"), [("spray", 1.2), ("dip", 1.0), ("submerged", 0.2)])
def test_bulk_takes_on_a_share_of_the_mean_flash_temperature(supply: OilSupply, share: float) -> None:
    """A flash temperature that falls linearly from 100 K to nothing has the mean 50 K."""
    psi = np.linspace(0.0, 1.0, 11)
    assert bulk_temperature(363.15, supply, psi, 100.0 * (1.0 - psi)) == pytest.approx(363.15 + 0.47 * share * 50.0)


def test_risk_words() -> None:
    assert [scuffing_risk(value) for value in (0.99, 1.0, 2.0, 2.01)] == ["high", "moderate", "moderate", "low"]


def test_speed_of_the_test_is_that_of_its_name() -> None:
    assert angular_speed(2165.0) == pytest.approx(PITCH_LINE_SPEED / 0.0366, rel=1e-3)
