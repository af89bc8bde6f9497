"""Double-helical pairs: the more loaded helix at its share, the losses of both, twice the pumping."""

from dataclasses import replace

import pytest

from solvers.errors import InvalidInput, NoSolution
from solvers.pumping import solve as solve_pumping
from solvers.pumping.inputs import PumpingInputs, PumpingModel, PumpingSetup
from solvers.scuffing import solve_load_distribution, solve_scuffing
from solvers.scuffing.inputs import ScuffingInputs
from tests.support.answers import differences
from tests.support.changes import changed
from tests.support.double_helicals import double_helical

COARSE = {
    "distribution.resolution.roll_positions": 24,
    "distribution.resolution.slices": 20,
    "path_points": 11,
}
LOAD, GAP = "distribution.load", "distribution.gears.gap_width"


def pair(axial_force: float = 0.0) -> ScuffingInputs:
    return changed(double_helical().mesh, {**COARSE, f"{LOAD}.axial_force": axial_force})


def alone(inputs: ScuffingInputs, share: float) -> ScuffingInputs:
    """Return the single-helical pair of one helix under a share of the torque."""
    torque = share * inputs.distribution.load.torque
    return changed(inputs, {GAP: None, f"{LOAD}.pinion_torque": torque, f"{LOAD}.axial_force": 0.0})


def test_without_axial_force_each_helix_is_a_pair_of_half_the_torque() -> None:
    both, one = solve_scuffing(pair()), solve_scuffing(alone(pair(), 0.5))
    for name in ("flash", "film", "safety", "contact_temperature"):
        assert not differences(getattr(one, name), getattr(both, name), tolerance=1e-12)
    assert both.distribution.helix is not None
    assert both.distribution.helix.share == 0.5
    assert one.distribution.friction_loss.power is not None
    assert both.distribution.friction_loss.power == pytest.approx(2 * one.distribution.friction_loss.power, rel=1e-12)
    assert both.distribution.friction_loss.efficiency == pytest.approx(one.distribution.friction_loss.efficiency)
    assert both.distribution.derived.pinion_torque == pytest.approx(2 * one.distribution.derived.pinion_torque)
    assert both.derived.mesh.total_face_width == pytest.approx(0.28)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_more_loaded_helix_is_checked_and_both_lose_power(sign: float) -> None:
    result = solve_load_distribution(pair(sign * 20324.0).distribution)
    assert result.helix is not None
    assert result.helix.share == pytest.approx(0.70259, rel=1e-4)
    assert result.helix.unloading_force == pytest.approx(50161, rel=1e-4)
    share = result.helix.share
    heavy, light = (solve_load_distribution(alone(pair(), part).distribution) for part in (share, 1 - share))
    assert not differences(heavy.pressure, result.pressure, tolerance=1e-12)
    assert result.load.face_load_factor == pytest.approx(heavy.load.face_load_factor, rel=1e-12)
    assert heavy.friction_loss.power is not None
    assert light.friction_loss.power is not None
    assert result.friction_loss.power == pytest.approx(heavy.friction_loss.power + light.friction_loss.power, rel=1e-12)
    assert result.friction_loss.efficiency == pytest.approx(
        1 - result.friction_loss.power / result.derived.power, rel=1e-9
    )


def test_a_force_that_unloads_a_helix_is_refused() -> None:
    with pytest.raises(NoSolution, match=r"lifts off at 50\.16 kN") as refused:
        solve_load_distribution(pair(51e3).distribution)
    assert refused.value.code == "helix_unloaded"
    with pytest.raises(InvalidInput, match="need a helix"):
        solve_load_distribution(changed(pair(), {"distribution.gears.helix_angle": 0.0}).distribution)


def test_two_helices_pump_twice_the_power() -> None:
    gears = pair().distribution.gears
    setup = PumpingSetup(replace(gears, rack_tip_radius=0.25), model=PumpingModel(slices=12))
    one = replace(setup, gears=replace(setup.gears, gap_width=None))
    both, single = (solve_pumping(PumpingInputs(own, 1047.0)) for own in (setup, one))
    assert both.total.pumping_power == pytest.approx(2 * single.total.pumping_power, rel=1e-12)
    assert not differences(single.pinion_spaces, both.pinion_spaces)
