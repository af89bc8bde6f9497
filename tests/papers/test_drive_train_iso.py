"""The deflections of shafts are compared with ISO 6336-1, method C, and computed for example 1 of ISO/TR 6336-30.

The standard gives f_sh = (F_m/b) 0.023 (|B* + K' l s/d^2 (d/d_sh)^4 - 0.3| + 0.3)(b/d)^2, with f_sh in um and F_m/b in
N/mm. This formula is taken from public implementations of DIN 3990. The numbers of the example are taken from
gfsReboucas/Drivetrain.
"""

from dataclasses import replace
from math import cos, pi, radians

import numpy as np
import pytest

from benchmarks.published.standard_gears import EXAMPLE_1
from solvers.drive_train.gap.balance import uniform_force
from solvers.drive_train.inputs import Arrangement, DriveTrainInputs, Effects, RigidBearing, Shaft, ShaftSection
from solvers.drive_train.outcome import outcome
from solvers.drive_train.prepared import prepare
from solvers.drive_train.shafts.shaft import second_moment, shaft_model
from solvers.scuffing.inputs import Load, LoadDistributionInputs
from tests.support.changes import changed
from tests.support.drive_trains import turbo_gear

E = 206e9
SOLID = 0.023e-6 * 1e-3  # f_sh/(F_m/b) in m per N/m
GEARS = replace(EXAMPLE_1, rack_tip_radius=0.3)
DIAMETER = 17 * 8e-3 / cos(radians(15.8))


def test_torsion_part_of_f_sh() -> None:
    """A solid pinion with b = d twists by 4/(pi G) = 0.01607 um per N/mm of line load."""
    # The standard's value 0.7 x 0.023 is 0.01610 um per N/mm.
    shaft = Shaft((ShaftSection(0.1, 0.1),), (RigidBearing(0.0), RigidBearing(0.1)), torque_position=0.0)
    model = shaft_model(shaft, 0.0, np.linspace(0.0, 0.1, 41))
    force, radius = 1e5, 0.05
    twist = model.torsion @ (uniform_force(force, 41) * radius)
    per_load = float(np.ptp(twist)) * radius / (force / 0.1)
    assert per_load * 1e9 == pytest.approx(0.01607, rel=3e-4)
    assert per_load == pytest.approx(4 / (pi * E / 2.6), rel=1e-9)
    assert per_load == pytest.approx(0.7 * SOLID, rel=3e-3)


def test_tilt_part_of_f_sh() -> None:
    """A force F at a small distance s from the middle of a solid shaft causes the slope 64/(6 pi E) F l s/d^4 there."""
    # In the standard's formula, this slope corresponds to K' = 0.717.
    span, off, diameter, force = 0.6, 0.02, 0.1e-6, 1.0
    shaft = Shaft((ShaftSection(span, diameter),), (RigidBearing(0.0), RigidBearing(span)), torque_position=0.0)
    place = span / 2 + off
    model = shaft_model(shaft, 0.0, np.array([place]))
    load = np.zeros(2 * model.z.size)
    load[model.node(place)] = force
    slope = abs(float((model.flexibility @ load)[model.z.size + model.node(place)]))
    arms = place * (span - place) * abs(span - 2 * place)
    assert slope == pytest.approx(force * arms / (3 * E * second_moment(shaft.sections[0]) * span), rel=1e-8)
    # To first order in s this is F l s/(6 E I), in the standard's terms 0.023 K' (F/b) (l s/d^2)(b/d)^2 / b.
    first_order = 64 / (6 * pi * E) * force * span * off / diameter**4
    assert slope == pytest.approx(first_order, rel=0.005)
    assert 64 / (6 * pi * E) / SOLID == pytest.approx(0.717, abs=5e-4)


def example_1(*, torque_at_far_end: bool) -> DriveTrainInputs:
    """Return a unit with the gears of the example, rigid bearings, an elastic pinion shaft and a rigid wheel shaft."""
    # The pinion shaft is solid, has the reference diameter of the pinion, and is twice as long as the face.
    pinion = Shaft(
        (ShaftSection(0.2, DIAMETER),),
        (RigidBearing(0.0), RigidBearing(0.2)),
        torque_position=0.15 if torque_at_far_end else 0.05,
        density=0.0,
    )
    wheel = replace(pinion, youngs_modulus=1e30)
    return replace(
        changed(turbo_gear(), {"mesh.distribution": LoadDistributionInputs(GEARS, Load(9000.0, 100.0))}),
        face_start=0.05,
        pinion_shaft=pinion,
        wheel_shaft=wheel,
        couplings=(),
        arrangement=Arrangement(hand="left"),  # y runs along Z
        effects=Effects(coupling=False, thermal=False),
    )


@pytest.mark.parametrize(("far", "gap", "factor"), [(True, 10.88, 1.0931), (False, 11.85, 1.1009)])
def test_own_shafts_of_example_1(far: bool, gap: float, factor: float) -> None:
    """The range of the gap at uniform load is 10.88 um if torque enters at y = b, and 11.85 um if it enters at y = 0.

    In both cases, the range of the twist alone is 9.61 um.
    """
    inputs = example_1(torque_at_far_end=far)
    prepared = prepare(inputs)
    side = prepared.unit.shafts[0]
    force = uniform_force(prepared.meshes[0].prepared.tangential_force, 41)
    motion = prepared.unit.motion(force)[0]
    twist = side.torques.T @ (side.model.torsion @ (side.torques @ force))
    assert np.ptp(twist) * 1e6 == pytest.approx(9.61, abs=0.03)
    assert np.ptp(motion) * 1e6 == pytest.approx(gap, abs=0.05)
    assert outcome(inputs).face_load_factor == pytest.approx(factor, abs=0.002)
