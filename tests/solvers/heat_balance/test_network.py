"""The network of the heat balance agrees with worked examples and exact limits, and has only one solution."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from solvers.arrays import FloatArray
from solvers.errors import NoSolution
from solvers.heat_balance.bearings import Journal
from solvers.heat_balance.conduction import rod_conductance
from solvers.heat_balance.losses import MeshHeat, impact_rise
from solvers.heat_balance.network import BODIES, FLANKS, MIST, CasingWalls, Network
from solvers.heat_balance.solution import equilibrium, jacobian
from tests.support.changes import changed
from tests.support.heat_networks import CASED, CELSIUS, FLOW, OIL, PAIR, UNIT, VELOCITY, gear, random_network
from tests.support.outcomes import unsolved

FOUR_UNITS = {
    "unit": UNIT,
    "casing": CASED,
    "starved": changed(UNIT, {"spray.wetting_share": 0.1, "spray.rewetting_share": 0.4}),
    "flooded": changed(CASED, {"spray.wetting_share": 1.0, "spray.fling_off_factor": 1.5}),
}


def celsius(network: Network) -> FloatArray:
    return equilibrium(network).rises + network.oil.inlet - CELSIUS


def plain(network: Network) -> Network:
    """Return the network without air friction at the tooth tips, and with oil that nothing accelerates."""
    return changed(network, {"recovery": 0.0, "spray.jet": 0.0, "spray.velocity": 0.0})


def constant(network: Network) -> Network:
    """Return the network with an oil whose viscosity does not depend on temperature."""
    return changed(network, {"oil.viscosity": lambda _: 0.02})


def power(network: Network, carrier: str) -> float:
    flows = network.flows(equilibrium(network).rises)
    return sum(flow.power for flow in flows if flow.carrier == carrier)


# Worked example


PAIRS = {
    "pair": (PAIR, (77.16, 71.36, 73.32, 70.93, 66.11), (938, 982), (1195, 1671), (35897, 13030)),
    "wetting 0.2": (
        changed(PAIR, {"spray.wetting_share": 0.2}),
        (96.51, 88.67, 82.76, 79.41, 64.34),
        (397, 397),
        (1122, 1614),
        (36679, 5212),
    ),
    "wetting 1, factor 1.5": (
        changed(PAIR, {"spray.wetting_share": 1.0, "spray.fling_off_factor": 1.5}),
        (67.82, 63.81, 66.96, 65.49, 69.29),
        (1821, 1985),
        (1844, 2566),
        (35477, 26061),
    ),
}


@pytest.mark.parametrize("name", PAIRS)
def test_worked_example_of_the_pair(name: str) -> None:
    network, temperatures, conductances, flooded, heats = PAIRS[name]
    rises = equilibrium(network).rises
    assert rises + 50.0 == pytest.approx(temperatures, abs=0.1)
    coolings = [network.cooling(number, rises) for number in (0, 1)]
    assert [cooling.conductance for cooling in coolings] == pytest.approx(conductances, abs=1.0)
    assert [cooling.flooded for cooling in coolings] == pytest.approx(flooded, abs=1.0)
    assert power(network, "friction of the mesh") == pytest.approx(heats[0], abs=5.0)
    assert power(network, "oil brought to speed") == pytest.approx(heats[1], abs=5.0)


def test_worked_example_of_the_unit() -> None:
    rises = equilibrium(UNIT).rises
    expected = (78.81, 73.26, 75.37, 73.09, 69.92, 89.89, 88.25, 70.37, 71.30)
    assert rises + 50.0 == pytest.approx(expected, abs=0.1)
    films = [UNIT.film_temperature(number, rise) - CELSIUS for number, rise in enumerate(rises[5:])]
    assert films == pytest.approx((81.9, 80.6, 66.3, 67.0), abs=0.1)
    assert [UNIT.cooling(number, rises).conductance for number in (0, 1)] == pytest.approx((937, 982), abs=1.0)
    states = [one.loss_and_flow(OIL.viscosity(film + CELSIUS)) for one, film in zip(UNIT.journals, films, strict=True)]
    assert [loss for loss, _ in states] == pytest.approx((36870, 39710, 11980, 11320), abs=10.0)
    assert [flow * 6e4 for _, flow in states] == pytest.approx((32.5, 36.5, 20.8, 18.8), abs=0.1)
    assert UNIT.gains(UNIT.flows(rises))[-1] == pytest.approx(-178666.0, abs=20.0)


def test_jets_do_not_make_energy() -> None:
    """Oil is heated by v (v - v_jet) + v_jet^2/2 per kilogram, never by less than nothing, at any speed of the jets."""
    for jet in (-80.0, -20.0, 5.0, 80.0, 2 * PAIR.spray.velocity):
        network = changed(PAIR, {"spray.jet": jet, "spray.wetting_share": 1.0})
        rises, mass = equilibrium(network).rises, OIL.density * network.spray.flow
        heat = power(network, "oil brought to speed") + power(network, "oil jets")
        v = network.spray.velocity
        assert heat == pytest.approx(mass * (v * (v - jet) + jet**2 / 2))
        assert heat >= mass * impact_rise(OIL, v, jet) * OIL.specific_heat
        assert network.gains(network.flows(rises))[: network.size] == pytest.approx(0.0, abs=1e-3)


# Conservation


@pytest.mark.parametrize("name", FOUR_UNITS)
def test_supplied_is_removed(name: str) -> None:
    network = FOUR_UNITS[name]
    gains = network.gains(network.flows(equilibrium(network).rises))
    supplied, removed = -gains[-1], gains[-3] + gains[-2]
    assert supplied > 1e5
    assert removed == pytest.approx(supplied, rel=1e-9)


def test_without_heat_everything_is_as_cold_as_the_oil() -> None:
    cold = changed(plain(PAIR), {"mesh.power": 0.0, "windage": 0.0})
    for start in (0.0, 60.0, -30.0):
        assert equilibrium(cold, np.full(5, start)).rises == pytest.approx(0.0, abs=1e-9)


# One solution


@pytest.mark.parametrize("name", FOUR_UNITS)
def test_starts_meet(name: str) -> None:
    network = FOUR_UNITS[name]
    cold, hot = (equilibrium(network, np.full(network.size, start - 50.0)).rises for start in (60.0, 150.0))
    assert cold == pytest.approx(hot, abs=1e-6)


@pytest.mark.parametrize("name", FOUR_UNITS)
def test_minus_the_jacobian_is_an_m_matrix(name: str) -> None:
    network, random = FOUR_UNITS[name], np.random.default_rng(44)
    for _ in range(60):
        rises = random.uniform(0.0, 80.0, network.size)
        matrix = -jacobian(network, rises, network.residual(rises))
        beside = matrix - np.diag(np.diag(matrix))
        assert beside.max() <= 1e-5
        assert matrix.sum(axis=1).min() > 0.0
        assert np.linalg.eigvals(-matrix).real.max() < 0.0


def test_a_loss_that_outgrows_its_cooling_is_a_runaway() -> None:
    """Friction that grows tenfold every four kelvin has no equilibrium; the error states the remaining residual [W]."""
    heating = replace(PAIR.mesh, viscosity_exponent=-20.0, temperature=OIL.inlet)
    failure = unsolved(equilibrium, replace(PAIR, mesh=heating))
    assert failure.code == "heat_balance"
    assert failure.residuals["residual_w"] > 1.0


def test_an_equilibrium_that_runs_away_is_refused() -> None:
    """A loss that grows with temperature has two equilibria, and the upper equilibrium is not stable."""
    # Some hot starts reach the upper equilibrium, which is then refused.
    heating = replace(PAIR.mesh, viscosity_exponent=-3.0, temperature=OIL.inlet, power=1000.0)
    network = changed(plain(PAIR), {"mesh": heating, "windage": 0.0})
    assert equilibrium(network).rises[0] < 5.0
    codes = set()
    for start in np.linspace(20.0, 100.0, 17):
        try:
            equilibrium(network, np.full(5, start))
        except NoSolution as failure:
            codes.add(failure.code)
    assert "thermal_runaway" in codes


# Limits


def test_doubled_heat_doubles_every_rise() -> None:
    network = constant(plain(UNIT))
    network = replace(network, journals=tuple(replace(one, oil_flow=5e-4) for one in network.journals))
    double = changed(network, {"mesh.power": 2 * network.mesh.power, "windage": 2 * network.windage})
    double = replace(
        double,
        gears=tuple(replace(one, pumping=2 * one.pumping) for one in network.gears),
        journals=tuple(replace(one, operate=_doubled(one)) for one in network.journals),
    )
    assert equilibrium(double).rises == pytest.approx(2 * equilibrium(network).rises, abs=1e-6)


def _doubled(journal: Journal):  # type: ignore[no-untyped-def]  # noqa: ANN202
    def operate(viscosity: float) -> tuple[float, float]:
        loss, leakage = journal.operate(viscosity)
        return 2 * loss, leakage

    return operate


def test_a_symmetric_pair_has_equal_temperatures() -> None:
    one = gear(60, 6e-3, 0.1, 0.18, 500.0)
    network = replace(PAIR, gears=(one, one), mesh=replace(PAIR.mesh, share_to_pinion=0.5))
    rises = equilibrium(network).rises
    assert rises[0] == pytest.approx(rises[2], abs=1e-6)
    assert rises[1] == pytest.approx(rises[3], abs=1e-6)
    assert rises[0] > rises[1] > 0.0


def test_a_very_large_flow_leaves_the_fling_off_resistance() -> None:
    """At a very large flow, the mist is as warm as the oil, and only the flooded film cools flanks and bodies."""
    network = changed(constant(plain(PAIR)), {"spray.flow": 1e5, "mist_convection_factor": 0.0})
    rises = equilibrium(network).rises
    assert rises[MIST] == pytest.approx(0.0, abs=1e-4)
    for number in (0, 1):
        share = network.mesh.share_to_pinion if number == 0 else 1 - network.mesh.share_to_pinion
        heat = share * network.mesh.at(network.oil, network.oil.inlet)
        cooling, tooth = network.cooling(number, rises), network.gears[number].to_body
        assert cooling.conductance == pytest.approx(cooling.flooded, rel=1e-9)
        through = 1 / (1 / tooth + 1 / (1 / (1 / tooth + 2 / cooling.flooded)))
        assert rises[FLANKS[number]] == pytest.approx(heat / (cooling.flooded / 2 + through), abs=1e-4)


def test_conduction_alone_is_that_of_a_rod() -> None:
    """Half of the heat leaves through each of two shafts, whose ends are as cold as the oil."""
    diameter, length = 0.16, 0.3
    rod = rod_conductance(((length, diameter, 0.0),), 46.0)
    cold = Journal(0, 0.16, 1e-4, 1e3, rod, lambda _: (0.0, 0.0), oil_flow=1e3)
    network = changed(
        constant(plain(PAIR)),
        {"spray.fling_off_factor": 0.0, "mist_convection_factor": 0.0, "mesh": MeshHeat(5000.0, 300.0, 1.0, 0.0)},
    )
    rises = equilibrium(replace(network, journals=(cold, cold, replace(cold, gear=1)))).rises
    assert rises[BODIES[0]] == pytest.approx(5000.0 * length / (2 * 46.0 * pi / 4 * diameter**2), rel=1e-3)


# Direction


CHANGES = {
    "friction": ({"mesh.power": 40000.0}, 1),
    "windage": ({"windage": 20000.0}, 1),
    "inlet": ({"oil.inlet": 60.0 + CELSIUS}, 1),
    "pumping share": ({"pumping_to_teeth": 0.2}, 1),
    "wetting": ({"spray.wetting_share": 0.6}, -1),
    "factor": ({"spray.fling_off_factor": 1.2}, -1),
    "flow": ({"spray.flow": 1.2 * FLOW}, -1),
}


@pytest.mark.parametrize("name", CHANGES)
def test_direction_of_every_change(name: str) -> None:
    change, sign = CHANGES[name]
    rise = celsius(changed(UNIT, change)) - celsius(UNIT)
    assert np.all(sign * rise[[*FLANKS, *BODIES]] > 1e-3)


# Invariance


def test_exchanged_gears_exchange_temperatures() -> None:
    """The pair with exchanged gears is an increaser, in which the smaller gear is the driven gear."""
    swapped = replace(
        CASED,
        gears=CASED.gears[::-1],
        mesh=replace(CASED.mesh, share_to_pinion=1 - CASED.mesh.share_to_pinion),
        journals=tuple(replace(one, gear=1 - one.gear) for one in CASED.journals),
    )
    order = [2, 3, 0, 1, *range(4, CASED.size)]
    assert equilibrium(swapped).rises[order] == pytest.approx(equilibrium(CASED).rises, abs=1e-9)


def test_the_order_of_bearings_does_not_matter() -> None:
    turned = replace(CASED, journals=CASED.journals[::-1])
    order = [*range(5), 8, 7, 6, 5, 9]
    assert equilibrium(turned).rises[order] == pytest.approx(equilibrium(CASED).rises, abs=1e-9)


def test_jets_against_the_teeth_heat_the_mist_more() -> None:
    against = celsius(changed(PAIR, {"spray.jet": -20.0}))
    assert against[MIST] > celsius(PAIR)[MIST] + 1.0
    assert power(changed(PAIR, {"spray.jet": -20.0}), "oil brought to speed") == pytest.approx(
        850 * FLOW * 0.5 * VELOCITY * (VELOCITY + 20.0)
    )


def test_a_casing_in_the_cold_cools() -> None:
    cased = celsius(CASED)
    assert np.all(cased[:5] < celsius(UNIT)[:5])
    assert 25.0 < cased[-1] < cased[MIST]
    outside = CASED.casing.area * CASED.casing.outside * (cased[-1] - 25.0)
    assert power(CASED, "surroundings") == pytest.approx(outside)


def test_no_oil_out_of_a_casing_is_colder_than_both_its_sources() -> None:
    walls = CasingWalls(1e4, 50.0, 12.0, 223.15)
    assert celsius(replace(UNIT, casing=walls))[-1] > -50.0


# Any pair, any unit


def _converges(network: Network) -> bool:
    """Return whether the network has an equilibrium.

    If so, check that the equilibrium is balanced, and that a hot start gives the same equilibrium.
    """
    try:
        rises = equilibrium(network).rises
    except NoSolution:
        return False
    gains = network.gains(network.flows(rises))
    assert np.isfinite(rises).all()
    assert gains[-3] + gains[-2] == pytest.approx(-gains[-1], rel=1e-9)
    assert equilibrium(network, 1.2 * rises).rises == pytest.approx(rises, abs=1e-6)
    return True


def _converging_share(count: int, *, unit: bool) -> float:
    random = np.random.default_rng(2)
    return float(np.mean([_converges(random_network(random, unit=unit)) for _ in range(count)]))


@pytest.mark.parametrize(("unit", "count"), [(False, 40), (True, 10)], ids=["pairs", "units"])
def test_random_networks(unit: bool, count: int) -> None:
    assert _converging_share(count, unit=unit) > 0.9


@pytest.mark.slow
@pytest.mark.parametrize(("unit", "count"), [(False, 1000), (True, 200)], ids=["pairs", "units"])
def test_many_random_networks(unit: bool, count: int) -> None:
    assert _converging_share(count, unit=unit) > 0.95
