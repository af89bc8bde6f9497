"""Return the worked example of a double-helical turbo gear, and random double-helical units."""

from dataclasses import replace
from math import radians

from hypothesis import strategies as st

from solvers.drive_train.inputs import DriveTrainInputs, JournalBearing, Shaft, ShaftSection
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.pumping.inputs import PumpingModel, PumpingSetup
from solvers.scuffing.inputs import Modifications, SecondHelix
from tests.support.changes import changed
from tests.support.drive_trains import turbo_gear
from tests.support.random_units import units

RELIEVED = Modifications(tip_relief=15e-6, root_relief=15e-6, tip_relief_length=5e-3, root_relief_length=5e-3)
TORSION_PINION, TORSION_WHEEL = (
    teeth * 5.5e-3 / 0.8829475928589269 - 1.25 * 5.5e-3 for teeth in (39, 130)
)  # d - 1.25 m_n at 28 degrees


def _shaft(start: float, mm: list[tuple[float, float]], **more: object) -> Shaft:
    return Shaft(tuple(ShaftSection(length * 1e-3, d * 1e-3) for length, d in mm), start=start, **more)


def double_helical(modifications: Modifications = RELIEVED) -> DriveTrainInputs:
    """Return a unit of 12 MW at 10,000 1/min, 39/130 teeth of 28 degrees, two helices of 110 mm and a gap of 60 mm."""
    gears = GearPairInputs(
        GearTeeth(39),
        GearTeeth(130),
        5.5e-3,
        0.11,
        helix_angle=radians(28.0),
        gap_width=0.06,
        rack_tip_radius=0.38,
    )
    core, rim = TORSION_PINION * 1e3, TORSION_WHEEL * 1e3
    pinion = [(150, 130), (140, 160), (30, 190), (110, core), (60, 222), (110, core), (30, 190), (150, 160)]
    wheel = [(170, 200), (30, 260), (280, 720), (30, 260), (350, 200)]
    assert rim > 720
    plain = turbo_gear()
    return replace(
        changed(plain, {"mesh.distribution.gears": gears, "mesh.distribution.modifications": modifications}),
        pumping=PumpingSetup(
            replace(gears, rack_tip_radius=0.25), normal_backlash=0.3e-3, model=PumpingModel(slices=100)
        ),
        pinion_shaft=_shaft(
            0.0,
            pinion,
            torque_position=0.02,
            bearings=tuple(JournalBearing(z, 0.16, 0.11, 0.014, 130e-6) for z in (0.22, 0.7)),
        ),
        wheel_shaft=_shaft(
            0.12,
            wheel,
            torque_position=0.96,
            bearings=tuple(JournalBearing(z, 0.2, 0.14, 0.018, 150e-6) for z in (0.21, 0.71)),
        ),
        coupling_friction="elastic_plastic",
    )


def ground(first: float, second: float, crown: float = 4.0) -> Modifications:
    """Return the example's modifications with a helix slope of each helix and a crown of both [um]."""
    shape = replace(RELIEVED, helix_slope=first * 1e-6, lead_crowning=crown * 1e-6)
    return replace(shape, second_helix=SecondHelix(helix_slope=second * 1e-6))


@st.composite
def double_helical_units(draw: st.DrawFn) -> DriveTrainInputs:
    """Draw double-helical units: the face of a random helical unit is two helices and a gap."""
    inputs = draw(units().filter(lambda unit: unit.mesh.distribution.gears.helix_angle > 0.0))
    whole = inputs.mesh.distribution.gears
    gap = draw(st.floats(0.0, 0.4)) * whole.face_width
    gears = replace(whole, face_width=(whole.face_width - gap) / 2, gap_width=gap, helix_angle=radians(25.0))
    other = SecondHelix(draw(st.floats(-2e-5, 4e-5)), draw(st.floats(0.0, 1e-5)))
    slope = draw(st.floats(-2e-5, 4e-5))
    shape = replace(inputs.mesh.distribution.modifications, helix_slope=slope, second_helix=other)
    return replace(
        changed(inputs, {"mesh.distribution.gears": gears, "mesh.distribution.modifications": shape}),
        floating_shaft=draw(st.sampled_from([None, "pinion", "wheel"])),
        pumping=replace(inputs.pumping, gears=replace(gears, rack_tip_radius=0.25), model=PumpingModel(slices=12)),
    )
