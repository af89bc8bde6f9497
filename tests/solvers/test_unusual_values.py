"""The solvers themselves, not only the service, warn of unusual values."""

from dataclasses import replace

from solvers.coupling import recommend, solve
from solvers.coupling.inputs import Coupling, CouplingInputs, Operation, RecommendationInputs
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.gears.notices import tooth_temperature, unusual_gears
from solvers.lubricants import hot_oil, oil_temperature, thick_oil
from solvers.notices import Notice
from solvers.pumping.notices import thin_air

TALL = CouplingInputs(
    coupling=Coupling(teeth=52, module=3e-3, face_width=24e-3, tooth_height=13e-3, crowning_ratio=2.0),
    operation=Operation(torque=2000.0, speed=100.0, misalignment=0.005),
)
SAID = Notice(
    "unusual_value",
    "the tooth height of 13 mm exceeds 4 modules; was a diameter entered instead of a height?",
    "coupling.tooth_height",
)


def test_a_solver_says_it_once() -> None:
    assert [each for each in solve(TALL).warnings if each.code == "unusual_value"] == [SAID]
    usual = replace(TALL, coupling=replace(TALL.coupling, tooth_height=6e-3))
    assert not [each for each in solve(usual).warnings if each.code == "unusual_value"]


def test_a_search_that_calls_the_solver_says_it_once() -> None:
    found = recommend(RecommendationInputs(TALL, min_misalignment=0.001, max_misalignment=0.005))
    assert [each for each in found.warnings if each.code == "unusual_value"] == [SAID]


def test_limits_hold_at_their_ends() -> None:
    pair = GearPairInputs(
        module=4e-3, pinion=GearTeeth(25), wheel=GearTeeth(50), face_width=0.3, rack_tip_radius=GROUND_FILLET
    )
    assert not [*unusual_gears(pair, 5000.0), *thin_air(20e3), *hot_oil(350.0, 350.0), *thick_oil(1.0)]
    assert not [*oil_temperature(403.15), *oil_temperature(243.15), *tooth_temperature(403.15)]
    assert [each.field for each in oil_temperature(403.2)] == ["temperatures.oil"]
    assert [each.field for each in oil_temperature(243.1)] == ["temperatures.oil"]
    assert [each.field for each in tooth_temperature(403.2)] == ["temperatures.bulk"]
    assert [each.field for each in unusual_gears(replace(pair, face_width=0.3001))] == ["gears.face_width"]
    assert [each.field for each in unusual_gears(replace(pair, face_width=1.9e-3))] == ["gears.face_width"]
    assert [each.field for each in unusual_gears(pair, 5001.0)] == ["pinion_speed"]
    assert [each.message for each in thin_air(1e3)] == [
        "an ambient pressure of 1 kPa is nearly a vacuum; was a value entered in the wrong unit (bar)?"
    ]
    assert [each.field for each in hot_oil(350.1, 350.0)] == ["temperatures.oil"]
    assert [each.field for each in thick_oil(1.01)] == ["lubricant.viscosity"]
