"""The coupling model agrees with the bounds of a hand method for turbomachinery couplings and with measured friction.

Bloch, Improving Machinery Reliability, pp. 208-210, explains the hand method with a torque of 21,806 N m (193,000 lb
in), a pitch diameter of 228.6 mm, a face width of 33.0 mm, a coefficient of friction of 0.3, a misalignment of 0.057
degrees and a pressure angle of 20 degrees. The moments of the hand method are bounds: the contact is at the end of the
tooth, and the worst teeth carry the whole load. The book does not state the number of teeth; 72 teeth of diametral
pitch 8 agree with the diameter.

Calistrat, J. Mech. Des. 103 (1981), p. 54, states coefficients of friction of high-speed gear couplings of up to 0.16;
usually they are far lower.
"""

from math import cos, radians

import numpy as np
import pytest

from benchmarks.published.bloch import DIAMETER, END_CONTACT, FACE, TORQUE, bloch
from solvers.coupling.inputs import MixedFrictionCurve
from solvers.coupling.lubrication import mixed_friction, regime_friction

COSINE = cos(radians(20.0))
SOFT, STIFF = 1e5, 1e14  # tooth stiffness [N/m]: equal loads, load on the worst teeth alone


def test_axial_force_reaches_its_bound() -> None:
    fast, slow = (bloch(axial_velocity=velocity).axial_thrust for velocity in (1.0, 5e-3))
    assert fast.force == pytest.approx(fast.coaxial_limit, rel=1e-3)
    assert 0.0 < slow.force < slow.coaxial_limit


@pytest.mark.parametrize(("stiffness", "moment"), [(SOFT, 4165.0), (STIFF, 6542.0)])
def test_friction_moment_reaches_both_bounds(stiffness: float, moment: float) -> None:
    # The hand method takes the tangential force for the normal one, a factor cos(alpha). Loaded teeth stand within
    # half a pitch (2.5 degrees) of the tilt position, hence 1 - cos(2.5 deg) = 1e-3.
    assert bloch(END_CONTACT, stiffness).losses.friction_moment * COSINE == pytest.approx(moment, rel=1e-3)


def test_contact_shift_moment_stays_below_its_bound_and_halves_with_equal_loads() -> None:
    bound = TORQUE * FACE / DIAMETER
    assert 0.0 < bloch().losses.contact_shift_moment < bound
    assert bloch(END_CONTACT, SOFT).losses.contact_shift_moment == pytest.approx(bound / 2, rel=1e-3)


def test_a_turning_misaligned_coupling_resists_axial_motion_far_less_than_a_standing_one() -> None:
    # A direction that measurements fix, without a number; Pahl's Fig. 18 shows a tenth.
    turning = bloch(axial_velocity=1e-3)
    assert turning.kinematics.max_sliding_velocity > 10 * 1e-3
    assert turning.axial_thrust.force < 0.1 * turning.axial_thrust.breakaway_force


def test_friction_never_exceeds_what_calistrat_measured() -> None:
    law = MixedFrictionCurve()
    for overlap in np.geomspace(0.01, 100.0, 41):
        for capacity in np.geomspace(1e-4, 100.0, 41):
            for velocity in (0.0, 0.05, 0.11, 0.3):
                assert regime_friction(overlap, capacity, mixed_friction(law, velocity), law.lowest) <= 0.16
