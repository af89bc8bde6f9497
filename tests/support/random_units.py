"""Random gear units, and functions that rotate or mirror a gear unit."""

from dataclasses import replace
from math import pi, radians

import numpy as np
from hypothesis import strategies as st

from solvers.arrays import FloatArray
from solvers.coupling.inputs import Friction
from solvers.drive_train.inputs import (
    Arrangement,
    Bearing,
    DriveTrainInputs,
    Heat,
    JournalBearing,
    LinearBearing,
    RigidBearing,
    Shaft,
    ShaftSection,
    UnitCoupling,
    Vector2,
)
from solvers.gears.inputs import GearTeeth
from solvers.scuffing.inputs import Resolution
from tests.support.changes import changed, value_at
from tests.support.drive_trains import COUPLING, GROUND, turbo_gear

COARSE = Resolution(roll_positions=24, slices=20, profile_points=31, face_points=31, feature_points=5)


def _bearings(draw: st.DrawFn, first: float, second: float, kind: str) -> tuple[Bearing, Bearing]:
    built: list[Bearing] = []
    for position in (first, second):
        offset = (draw(st.floats(-2e-5, 2e-5)), draw(st.floats(-2e-5, 2e-5)))
        if kind == "journal":
            diameter = draw(st.floats(0.12, 0.2))
            viscosity, clearance = draw(st.floats(0.008, 0.03)), draw(st.floats(1e-3, 2e-3)) * diameter / 2
            built.append(JournalBearing(position, diameter, 0.6 * diameter, viscosity, clearance, offset=offset))
        elif kind == "linear":
            stiff, cross = draw(st.floats(2e8, 2e9)), draw(st.floats(-1e8, 1e8))
            built.append(LinearBearing(position, ((stiff, cross), (-0.7 * cross, 1.4 * stiff)), offset=offset))
        else:
            built.append(RigidBearing(position, offset=offset))
    return built[0], built[1]


@st.composite
def units(draw: st.DrawFn) -> DriveTrainInputs:
    """Draw the inputs of a gear unit.

    Gears, modifications, torque, bearings, directions and rotation are random. A coupling is on one shaft or on none.
    """
    plain = turbo_gear()
    helix = draw(st.sampled_from([0.0, 8.0, 11.5, 20.0]))
    gears = replace(
        plain.mesh.distribution.gears,
        pinion=GearTeeth(draw(st.integers(30, 45))),
        wheel=GearTeeth(draw(st.integers(70, 140))),
        helix_angle=radians(helix),
        face_width=draw(st.floats(0.12, 0.22)),
    )
    shape = replace(GROUND, helix_slope=draw(st.floats(-5e-5, 8e-5)), lead_crowning=draw(st.floats(0.0, 1e-5)))
    torque = plain.mesh.distribution.load.pinion_torque * draw(st.floats(0.2, 1.2)) * gears.face_width / 0.22
    values = {"gears": gears, "modifications": shape, "resolution": COARSE, "load.pinion_torque": torque}
    low, high = 0.32 - draw(st.floats(0.06, 0.12)), 0.32 + gears.face_width + draw(st.floats(0.06, 0.12))
    shafts = []
    for diameter, core in ((0.15, 0.17), (0.2, 0.4)):
        kind = draw(st.sampled_from(["journal", "linear", "rigid"]))
        sections = (
            ShaftSection(0.32, diameter, draw(st.floats(0.0, 0.05))),
            ShaftSection(gears.face_width, core),
            ShaftSection(0.35, diameter),
        )
        built = _bearings(draw, low, high, kind)
        shafts.append(Shaft(sections, built, torque_position=draw(st.sampled_from([0.03, 0.75]))))
    couplings: tuple[UnitCoupling, ...] = ()
    driven = draw(st.sampled_from([None, "pinion", "wheel"]))
    if driven is not None:
        couplings = (
            replace(
                COUPLING,
                shaft=driven,
                position=0.03,
                friction=Friction(draw(st.floats(0.03, 0.25))),
                offset=(draw(st.floats(-4e-4, 4e-4)), draw(st.floats(-4e-4, 4e-4))),
                slope=(draw(st.floats(-3e-4, 3e-4)), draw(st.floats(-3e-4, 3e-4))),
                thrust_fraction=draw(st.sampled_from([0.0, 0.5, -0.8])),
            ),
        )
    return replace(
        changed(plain, {f"mesh.distribution.{name}": value for name, value in values.items()}),
        pinion_shaft=shafts[0],
        wheel_shaft=shafts[1],
        couplings=couplings,
        heat=Heat(0.0, pinion_bulk=365.0, wheel_bulk=355.0),
        arrangement=Arrangement(
            hand=draw(st.sampled_from(["right", "left"])),
            rotation=draw(st.sampled_from(["counterclockwise", "clockwise"])),
            wheel_angle=draw(st.floats(-pi, pi)),
            gravity_angle=draw(st.floats(-pi, pi)),
        ),
        coupling_friction=draw(st.sampled_from(["elastic_plastic", "sliding"])),
        bearing_film="finite",
        face_stations=21,
    )


def rotated(inputs: DriveTrainInputs, angle: float) -> DriveTrainInputs:
    """Return the whole unit, rotated about Z by an angle [rad]."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    own = inputs.arrangement
    arrangement = replace(own, wheel_angle=own.wheel_angle + angle, gravity_angle=own.gravity_angle + angle)
    return _mapped(inputs, turn, arrangement)


def mirrored(inputs: DriveTrainInputs) -> DriveTrainInputs:
    """Return the mirror image of the whole unit; the mirror is the plane X = 0."""
    own = inputs.arrangement
    arrangement = Arrangement(
        hand="left" if own.hand == "right" else "right",
        rotation="clockwise" if own.rotation == "counterclockwise" else "counterclockwise",
        wheel_angle=pi - own.wheel_angle,
        gravity_angle=pi - own.gravity_angle,
    )
    return _spur_face_reversed(_mapped(inputs, np.diag([-1.0, 1.0]), arrangement))


def _spur_face_reversed(image: DriveTrainInputs) -> DriveTrainInputs:
    """Return the mirrored unit, with the opposite helix slope if the gears are a spur pair."""
    # The face of a spur pair begins at the end that the rotation determines. In a mirrored unit, this is the other end.
    slope = "mesh.distribution.modifications.helix_slope"
    is_spur = image.mesh.distribution.gears.helix_angle == 0.0
    return changed(image, {slope: -value_at(image, slope)}) if is_spur else image


def reversed_ends(inputs: DriveTrainInputs) -> DriveTrainInputs:
    """Return the mirror image of the whole unit; the mirror is the plane Z = 0."""
    # The slopes of the machines' axes and the thrust fractions of the couplings change their sign.
    width = inputs.mesh.distribution.gears.face_width
    hand = "left" if inputs.arrangement.hand == "right" else "right"
    shafts = [
        replace(
            shaft,
            start=-shaft.end,
            sections=shaft.sections[::-1],
            bearings=tuple(replace(bearing, position=-bearing.position) for bearing in shaft.bearings),
            torque_position=None if shaft.torque_position is None else -shaft.torque_position,
        )
        for shaft in inputs.shafts
    ]
    image = replace(
        inputs,
        face_start=-inputs.face_start - width,
        pinion_shaft=shafts[0],
        wheel_shaft=shafts[1],
        couplings=tuple(
            replace(
                one,
                position=-one.position,
                machine_side="plus" if one.machine_side == "minus" else "minus",
                slope=(-one.slope[0], -one.slope[1]),
                thrust_fraction=-one.thrust_fraction,
            )
            for one in inputs.couplings
        ),
        arrangement=replace(inputs.arrangement, hand=hand),
    )
    return _spur_face_reversed(image)


def _mapped(inputs: DriveTrainInputs, matrix: FloatArray, arrangement: Arrangement) -> DriveTrainInputs:
    """Transform all vectors and stiffnesses in X and Y with an orthogonal matrix, and replace the arrangement."""

    def vector(one: Vector2) -> Vector2:
        x, y = (matrix @ one).tolist()
        return x, y

    def bearing(one: Bearing) -> Bearing:
        moved = replace(one, offset=vector(one.offset))
        if isinstance(moved, LinearBearing):
            stiffness = matrix @ np.array(moved.stiffness) @ matrix.T
            return replace(moved, stiffness=tuple(map(tuple, stiffness.tolist())))
        return moved

    shafts = [replace(shaft, bearings=tuple(bearing(one) for one in shaft.bearings)) for shaft in inputs.shafts]
    couplings = tuple(replace(one, offset=vector(one.offset), slope=vector(one.slope)) for one in inputs.couplings)
    return replace(inputs, pinion_shaft=shafts[0], wheel_shaft=shafts[1], couplings=couplings, arrangement=arrangement)
