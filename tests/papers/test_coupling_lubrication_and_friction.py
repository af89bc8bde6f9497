"""Pahl, "The operating characteristics of gear-type couplings": overlap, load capacity and friction, Figs 7 to 11.

Numbers without a source in the paper are those of an independent calculation of the same statement.
"""

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from solvers.coupling.inputs import Friction, MixedFrictionTable
from solvers.coupling.lubrication import UNBOUNDED_LOAD, friction_regime, regime_friction
from solvers.coupling.model import solve
from solvers.coupling.results import Lubrication
from solvers.published.pahl import HEAVY, SLIGHT, film, overlap_one, pahl_coupling


def lubrication(misalignment_deg: float, ratio: float) -> Lubrication:
    return film(misalignment_deg, ratio).lubrication


@pytest.mark.parametrize("ratio", [HEAVY, SLIGHT])
def test_figure_7_overlap_falls_with_misalignment(ratio: float) -> None:
    limit = overlap_one(ratio)
    assert lubrication(1.1 * limit, ratio).contact_overlap < 1.0 < lubrication(limit / 1.1, ratio).contact_overlap


def test_figure_8_constant_2_447() -> None:
    assert pytest.approx(2.44748, rel=1e-5) == 12.0 * UNBOUNDED_LOAD


@pytest.mark.parametrize(
    ("ratio", "misalignment", "factor", "tolerance"),
    [(SLIGHT, 0.1, 0.831, 2e-3), (SLIGHT, 0.2, 0.494, 2e-3), (HEAVY, 0.2, 0.99, 5e-3)],
)
def test_figure_8_short_inlet_halves_the_capacity_of_large_flank_radii(
    ratio: float, misalignment: float, factor: float, tolerance: float
) -> None:
    assert lubrication(misalignment, ratio).inlet_factor == pytest.approx(factor, rel=tolerance)


def test_area_1_1_holds_the_heavy_crown() -> None:
    found = lubrication(0.4, HEAVY)
    assert found.load_capacity_coefficient == pytest.approx(0.0322, rel=1e-2)
    assert (found.regime.area, found.regime.friction_min, found.regime.friction_max) == ("1.1", 0.05, 0.1)


@pytest.mark.parametrize(
    ("area", "overlap", "capacity", "band"),
    [
        ("1.1", 0.5, 0.1, (0.05, 0.1)),
        ("1.2", 1.5, 0.1, (0.1, 0.1)),
        ("1.3", 3.0, 0.1, (0.1, None)),
        ("2.1", 0.5, 0.5, (0.01, 0.05)),
        ("2.2", 1.5, 0.5, (0.01, 0.1)),
        ("2.3", 3.0, 0.5, (0.1, 0.1)),
        ("3.1", 0.5, 1.0, (None, 0.01)),
        ("3.2", 1.5, 1.0, (0.01, 0.1)),
        ("3.3", 3.0, 1.0, (None, None)),
        ("2.2", 1.0, 0.2, (0.01, 0.1)),
        ("3.2", 2.0, 0.8, (0.01, 0.1)),
    ],
)
def test_figure_9_areas_and_bands(
    area: str, overlap: float, capacity: float, band: tuple[float | None, float | None]
) -> None:
    regime = friction_regime(overlap, capacity)
    assert (regime.area, (regime.friction_min, regime.friction_max)) == (area, band)


@pytest.mark.parametrize("area", ["1.1", "1.3", "2.1", "2.2", "2.3", "3.1"])
def test_figure_9_friction_lies_inside_the_band(area: str) -> None:
    rows = {"1": (0.0, 0.1999), "2": (0.2, 0.7999), "3": (0.8, 20.0)}
    columns = {"1": (0.0, 0.9999), "2": (1.0, 2.0), "3": (2.0001, 50.0)}
    row, column = area.split(".")
    for capacity in np.linspace(*rows[row], 12):
        for pressure_overlap in np.linspace(*columns[column], 12):
            regime = friction_regime(pressure_overlap, capacity)
            assert regime.area == area
            for mixed in (0.05, 0.07, 0.1):
                friction = regime_friction(pressure_overlap, capacity, mixed, 0.05)
                assert (regime.friction_min or 0.0) * (1 - 1e-12) <= friction
                assert friction <= (regime.friction_max or np.inf) * (1 + 1e-12)


def test_constant_overlap_and_rising_capacity_lead_from_area_1_1_to_below_one_percent() -> None:
    friction = [regime_friction(0.5, capacity, 0.08, 0.05) for capacity in (0.05, 0.2, 0.5, 0.8, 1.5)]
    assert friction == sorted(friction, reverse=True)
    assert friction[0] > 0.05
    assert friction[-1] < 0.01


def test_figure_10_a_measured_table_replaces_the_law_of_mixed_friction() -> None:
    table = MixedFrictionTable(sliding_velocity=(0.02, 0.2), coefficient=(0.09, 0.06))
    for misalignment, expected in ((0.4, 0.09 - 0.03 * (radians(0.4) * 200 * 0.078 - 0.02) / 0.18), (1.0, 0.06)):
        inputs = replace(pahl_coupling(misalignment), friction=Friction(mixed_law=table))
        found = solve(inputs).lubrication
        assert found.regime.area == "1.1"
        capacity = found.load_capacity_coefficient or 0.0
        assert found.friction_coefficient == pytest.approx(expected * (0.06 / expected) ** (capacity / 0.2), rel=1e-12)


def test_figure_11_curve_1_exceeds_0_1_at_small_misalignment() -> None:
    found = lubrication(0.05, HEAVY)
    assert found.friction_coefficient == pytest.approx(0.132, abs=5e-4)
    assert found.regime.area == "1.3"


def test_figure_11_curve_1_stays_mixed_at_large_misalignment() -> None:
    for misalignment in (0.2, 0.4, 0.6, 1.0):
        found = lubrication(misalignment, HEAVY)
        assert found.regime.area == "1.1"
        assert 0.05 * (1 - 1e-2) < found.friction_coefficient < 0.1


def test_figure_11_curve_2_is_low_at_0_1_degrees() -> None:
    assert lubrication(0.1, SLIGHT).friction_coefficient == pytest.approx(0.0084, abs=1e-4)


def test_figure_11_curve_2_rises_sharply_below_its_minimum() -> None:
    friction = [lubrication(delta, SLIGHT).friction_coefficient for delta in (0.1, 0.06, 0.04, 0.02, 0.01)]
    assert friction == sorted(friction)
    assert friction[-1] > 0.1
