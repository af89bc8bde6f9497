"""Random pumping pairs are mirrored, counted from the other end, solved gear by gear, or driven by the other gear."""

import re

import numpy as np
from numpy.random import Generator

from solvers.arrays import FloatArray
from solvers.pumping import Flow, Gap, Groove, PumpingInputs, PumpingModel, Spaces
from solvers.pumping.model import solve_on_slices
from solvers.pumping.spaces import prepare
from tests.support.answers import differences, leaves
from tests.support.changes import changed
from tests.support.properties import seeds
from tests.support.pumping_cases import random_setup, random_speed

RISES = {r"\.temperature_rise$": 1e-6}  # of less than a kelvin, the difference of temperatures of 300 K
ENDS = {"front": "rear", "rear": "front"}
TIES = r"hottest_position$|\.correction$"  # of two equal places the first is told, and where the correction is 0


def draw_case(random: Generator) -> PumpingInputs:
    flow = Flow(random.choice([Flow.GAS_DYNAMICS, Flow.POCKET_CHAIN]))
    slices = int(random.integers(10, 40)) if flow is Flow.GAS_DYNAMICS else 6
    setup = random_setup(random, PumpingModel(flow=flow, slices=slices, gap=Gap(random.choice(list(Gap)))))
    return PumpingInputs(setup, random_speed(random, setup))


@seeds(4, 200)
def test_a_pair_of_the_other_hand(random: Generator) -> None:
    inputs = draw_case(random)
    helix = inputs.setup.gears.helix_angle
    assert not differences(
        solve_on_slices(inputs), solve_on_slices(changed(inputs, {"setup.gears.helix_angle": -helix})), tolerance=0.0
    )


@seeds(4, 200)
def test_each_gear_pumps_as_if_alone(random: Generator) -> None:
    inputs = draw_case(random)
    both = solve_on_slices(inputs)
    for spaces in (Spaces.PINION, Spaces.WHEEL):
        name = f"{spaces}_spaces"
        alone = solve_on_slices(changed(inputs, {"setup.model.spaces": spaces}))
        assert not differences(getattr(both, name), getattr(alone, name), tolerance=0.0)


@seeds(6, 200)
def test_grooves_of_a_spur_pair_counted_from_its_other_end(random: Generator) -> None:
    inputs = draw_case(random)
    inputs = changed(inputs, {"setup.gears.helix_angle": 0.0, "setup.gears.centre_distance": None})
    width = inputs.setup.gears.face_width
    grooves: tuple[Groove, ...] = (Groove(width * random.uniform(0.2, 0.45), width * random.uniform(0.03, 0.1)),)
    if random.random() < 0.5:
        grooves += (Groove(width * random.uniform(0.6, 0.8), width * random.uniform(0.03, 0.1)),)
    turned = tuple(Groove(width - groove.position, groove.width) for groove in reversed(grooves))
    one, other = (solve_on_slices(changed(inputs, {"setup.grooves": each})) for each in (grooves, turned))
    before = leaves(one)

    def expected(name: str, values: FloatArray, _: str | None) -> FloatArray:
        last = name.rpartition(".")[2]
        for end, opposite in ENDS.items():
            if f".{end}_end." in name:
                last = f"{end}_end"
            if re.match(rf"{end}(_|$)", last):
                found = before[name.replace(end, opposite)].values
                assert not isinstance(found, str)
                return found
        if last in {"position", "hottest_position"} or name.endswith("peak_position"):
            return width - values[::-1]
        if re.search(r"\.(profile|field|curves)\.", name) and ".stroke." not in name and values.ndim:
            return values[..., ::-1] if last != "angle" else values
        return -values if name == "lead_correction.slope" else values

    assert not differences(one, other, expected, without=TIES, loose=RISES)


@seeds(6, 200)
def test_the_spaces_of_a_driven_gear_are_those_of_a_driver_gone_through_from_behind(random: Generator) -> None:
    """The areas and clearances over the stroke depend on the geometry alone."""
    # A driven gear passes through the stroke of a driving gear in the reverse direction.
    inputs = draw_case(random)
    gears = inputs.setup.gears
    exchanged = changed(inputs, {"setup.gears.pinion": gears.wheel, "setup.gears.wheel": gears.pinion})

    def strokes(case: PumpingInputs) -> list[FloatArray]:
        tables = [space.table for space in prepare(case.setup).spaces]
        return [np.stack((each.angle, each.area, each.clearance_left, each.clearance_right)) for each in tables]

    turned = np.array([-1.0, 1.0, 1.0, 1.0])[:, None]
    for here, there in zip(strokes(inputs), strokes(exchanged)[::-1], strict=True):
        mirrored = turned * there[[0, 1, 3, 2], ::-1]
        scale = np.abs(here).max(axis=1, keepdims=True)
        assert np.abs(mirrored - here).max(where=scale > 0, initial=0.0) < 1e-9 * scale.max()
