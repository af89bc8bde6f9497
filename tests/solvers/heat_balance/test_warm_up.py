"""The warm-up agrees with the exact curve of one lump and with a worked example, and ends at the equilibrium."""

import time
from dataclasses import replace
from math import exp

import numpy as np
import pytest

from solvers.heat_balance.capacities import MIST_OIL, Capacities, cylinders_capacity, loaded_teeth_capacity
from solvers.heat_balance.losses import MeshHeat
from solvers.heat_balance.network import BODIES, MIST, Network
from solvers.heat_balance.solution import equilibrium
from solvers.heat_balance.warm_up import warm_up
from tests.support.changes import changed
from tests.support.heat_networks import CASED, CELSIUS, MODULE, PAIR, TEETH, UNIT, WIDTH

PINION = ((0.15, 0.13), (0.14, 0.16), (0.03, 0.19), (0.2, 0.2388), (0.03, 0.19), (0.15, 0.16))
WHEEL = ((0.17, 0.2), (0.03, 0.26), (0.2, 0.7), (0.03, 0.26), (0.35, 0.2))


def rotor(sections: tuple[tuple[float, float], ...]) -> float:
    return cylinders_capacity(tuple((length, diameter, 0.0) for length, diameter in sections))


TOOTH_HALVES = tuple(loaded_teeth_capacity(teeth, WIDTH, MODULE, 2.25 * MODULE) for teeth in TEETH)
CAPACITIES = Capacities((rotor(PINION), rotor(WHEEL)), (TOOTH_HALVES[0], TOOTH_HALVES[1]), casing=2000.0 * 470)


def test_one_lump_warms_exponentially() -> None:
    """Windage heats the mist and drained oil cools it; the rise is 1 - exp(-t G/C) times the final rise."""
    network = changed(
        PAIR,
        {
            "mesh": MeshHeat(0.0, 300.0, 0.5, 0.0),
            "spray.jet": 0.0,
            "spray.velocity": 0.0,
            "spray.wetting_share": 1e-6,
            "mist_convection_factor": 1e-9,
            "recovery": 0.0,
        },
    )
    conductance = network.oil.heat_capacity * network.spray.flow
    capacity = MIST_OIL * network.oil.heat_capacity
    result = warm_up(network, CAPACITIES, 50.0 + CELSIUS, 20.0)
    rises = result.curves.temperature[:, MIST] - 50.0 - CELSIUS
    for place in (10, 20, 40, 80, 200):
        grown = 1 - exp(-float(result.curves.time[place]) * conductance / capacity)
        assert rises[place] == pytest.approx(network.windage / conductance * grown, rel=2e-3)


def test_worked_example_from_the_temperature_of_the_oil() -> None:
    result = warm_up(UNIT, CAPACITIES, 50.0 + CELSIUS)
    times = dict(zip(result.nodes, result.time_95, strict=True))
    assert 270 <= times["pinion_flank"] <= 280
    assert 280 <= times["pinion_body"] <= 340
    assert 760 <= times["wheel_flank"] <= 840
    assert 770 <= times["wheel_body"] <= 840
    bearings = [times[f"bearing_{number}"] for number in (1, 2, 3, 4)]
    assert 0 < min(bearings) <= 10 < max(bearings) <= 20


def test_worked_example_from_cold() -> None:
    result = warm_up(UNIT, CAPACITIES, 20.0 + CELSIUS)
    assert result.greatest_difference == pytest.approx(19.7, abs=0.1)
    assert result.greatest_difference_at == pytest.approx(153, abs=4)


@pytest.mark.parametrize("network", [PAIR, UNIT, CASED], ids=["pair", "unit", "casing"])
def test_the_end_is_the_equilibrium(network: Network) -> None:
    result = warm_up(network, CAPACITIES, 20.0 + CELSIUS, 2e5)
    final = equilibrium(network).rises + network.oil.inlet
    assert result.final == pytest.approx(final)
    assert result.curves.temperature[-1] == pytest.approx(final, abs=0.02)
    assert result.curves.temperature[0] == pytest.approx(20.0 + CELSIUS)


def test_a_heavier_rotor_takes_longer() -> None:
    heavy = replace(CAPACITIES, rotors=(CAPACITIES.rotors[0], 2 * CAPACITIES.rotors[1]))
    plain, longer = (warm_up(UNIT, one, 20.0 + CELSIUS) for one in (CAPACITIES, heavy))
    node = BODIES[1]
    assert longer.time_95[node] > 1.8 * plain.time_95[node]
    assert longer.greatest_difference > plain.greatest_difference


def test_before_a_node_is_warm_no_time_is_told() -> None:
    result = warm_up(UNIT, CAPACITIES, 20.0 + CELSIUS, 60.0)
    assert result.time_95[BODIES[1]] is None
    assert result.time_95[5] is not None


def test_arrays_are_finite_and_read_only() -> None:
    curves = warm_up(CASED, CAPACITIES, 20.0 + CELSIUS).curves
    for values in (curves.time, curves.temperature, curves.difference):
        assert np.isfinite(values).all()
        assert not values.flags.writeable


def test_a_warm_up_takes_no_longer_than_three_seconds() -> None:
    begin = time.process_time()
    warm_up(UNIT, CAPACITIES, 20.0 + CELSIUS)
    assert time.process_time() - begin < 3.0
