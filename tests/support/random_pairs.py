"""Draw loaded gear pairs like those of users with hypothesis, for tests of properties that hold for every pair."""

from dataclasses import replace
from math import radians

from hypothesis import strategies as st

from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.scuffing.inputs import Load, LoadDistributionInputs, Model, Modifications, Resolution

SHAPES = ("profile_crowning", "lead_crowning", "tip_relief", "root_relief", "end_relief")
SLOPES = ("profile_slope", "helix_slope")
AMPLITUDES = (*SHAPES, *SLOPES)
COARSE = Resolution(roll_positions=40, slices=25, profile_points=21, face_points=11, feature_points=11)
MODELS = st.builds(
    Model, contact=st.sampled_from(["linear", "hertzian"]), section=st.sampled_from(["normal", "transverse"])
)


@st.composite
def gears(draw: st.DrawFn) -> GearPairInputs:
    """Draw a spur or helical gear pair."""
    # The profile shifts are -0.2 to 0.4 modules, and the addendum is 0.8 to 1 module.
    helix = draw(st.one_of(st.just(0.0), st.floats(0.1, 35.0)))
    addendum = draw(st.floats(0.8, 1.0))
    pinion, wheel = (
        GearTeeth(draw(st.integers(*teeth)), draw(st.floats(-0.2, 0.4)), addendum) for teeth in ((17, 50), (20, 90))
    )
    inputs = GearPairInputs(
        pinion,
        wheel,
        module=draw(st.floats(1e-3, 10e-3)),
        face_width=1.0,
        pressure_angle=radians(draw(st.floats(17.5, 24.0))),
        helix_angle=radians(helix),
        rack_tip_radius=0.25,
    )
    return replace(inputs, face_width=inputs.normal_module * draw(st.floats(3.0, 25.0)))


@st.composite
def designs(draw: st.DrawFn) -> LoadDistributionInputs:
    """Draw a loaded gear pair with random flank modifications of up to a hundredth of the normal module."""
    inputs = draw(gears())
    amplitude = inputs.normal_module * draw(st.floats(0.0, 0.01))
    shape = {name: amplitude * draw(st.floats(0.0, 1.0)) for name in SHAPES}
    slopes = {name: amplitude * draw(st.floats(-1.0, 1.0)) for name in SLOPES}
    # Up to about 500 N per mm of face and 3 mm of module: stress of the same order for every size.
    stress = draw(st.floats(1e6, 1.5e8))
    torque = stress * inputs.face_width * inputs.normal_module * inputs.pinion.teeth * inputs.normal_module / 2
    return LoadDistributionInputs(
        gears=inputs,
        load=Load(torque, 200.0),
        modifications=Modifications(**shape, **slopes, relief_exponent=draw(st.sampled_from([1.0, 2.0, 1.5]))),
        model=draw(MODELS),
        resolution=COARSE,
    )
