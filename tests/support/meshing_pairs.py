"""Draw random gear pairs that can mesh, for tests of properties that hold for every gear pair."""

from dataclasses import replace
from math import radians

from hypothesis import assume
from hypothesis import strategies as st

from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.gears.pair import gear_pair
from solvers.pumping.inputs import PumpingSetup
from solvers.pumping.spaces import prepare


def teeth(low: int, high: int) -> st.SearchStrategy[GearTeeth]:
    return st.builds(
        lambda z, x, ha, clearance: GearTeeth(z, x, ha, ha + clearance),
        st.integers(low, high),
        st.floats(-0.2, 0.6),
        st.floats(0.7, 1.1),
        st.floats(0.15, 0.5),
    )


@st.composite
def setups(draw: st.DrawFn, *, helix: bool = True) -> PumpingSetup:
    """Draw a set-up whose gear pair and tooth spaces are possible. About one of four draws is rejected."""
    module = draw(st.floats(1e-3, 12e-3))
    gears = GearPairInputs(
        pinion=draw(teeth(18, 70)),
        wheel=draw(teeth(25, 140)),
        module=module,
        face_width=module * draw(st.floats(2, 40)),
        pressure_angle=radians(draw(st.floats(17, 26))),
        helix_angle=radians(draw(st.floats(0, 32))) if helix else 0.0,
        rack_tip_radius=draw(st.floats(0.1, 0.38)),
    )
    backlash = module * draw(st.floats(0, 0.08))
    try:
        apart = gear_pair(gears).backlash_free_centre_distance + module * draw(st.floats(0, 0.05))
        setup = PumpingSetup(replace(gears, centre_distance=apart), normal_backlash=backlash)
        prepare(setup)
    except InvalidInput:
        assume(False)
    return setup
