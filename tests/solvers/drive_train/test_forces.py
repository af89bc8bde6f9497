"""The stated forces of bearings, mesh, weight, couplings, sleeves and collar are in balance on both shafts."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from solvers.coupling.inputs import Friction
from solvers.drive_train.inputs import Arrangement, DriveTrainInputs, Shaft
from solvers.drive_train.results import DriveTrainResult
from solvers.drive_train.states import solve
from solvers.gears.pair import meshing_path
from tests.support.drive_trains import COUPLING, GROUND, turbo_gear

GRAVITY = 9.80665
COLLAR = 0.128  # m
WHEEL_COUPLING = replace(COUPLING, shaft="wheel", position=0.88, machine_side="plus", offset=(200e-6, -100e-6))


def unit(fraction: float, collar: float | None = None) -> DriveTrainInputs:
    """Return the example with an elastic-plastic coupling on either shaft."""
    # The coupling model computes the friction of the pinion's coupling. This coupling pushes with the share `fraction`
    # of its thrust limit.
    couplings = (
        replace(COUPLING, friction=Friction(), thrust_fraction=fraction),
        replace(WHEEL_COUPLING, thrust_fraction=-0.5),
    )
    return replace(
        turbo_gear(GROUND),
        couplings=couplings,
        collar_radius=collar,
        coupling_friction="elastic_plastic",
        arrangement=Arrangement(wheel_angle=0.4),
    )


def weight(shaft: Shaft) -> tuple[float, float]:
    """Return the weight [N] of all cylinders of a shaft, and the moment of this weight about Z = 0 [N m]."""
    total, moment, start = 0.0, 0.0, shaft.start
    for part in shaft.sections:
        own = GRAVITY * shaft.density * pi / 4 * (part.outer_diameter**2 - part.inner_diameter**2) * part.length
        total, moment, start = total + own, moment + own * (start + part.length / 2), start + part.length
    return total, moment


def sums(inputs: DriveTrainInputs, found: DriveTrainResult, index: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the sum of all forces (X, Y) [N] and the sum of all moments [N m] on one shaft."""
    # The moments are conjugate to the slopes: a force F at the position Z contributes Z F. Couples are included.
    shaft, result, coupling = inputs.shafts[index], found.shafts[index], found.couplings[index]
    path, sign = meshing_path(inputs.mesh.distribution.gears), (1.0, -1.0)[index]
    angle, working = inputs.arrangement.wheel_angle, path.pair.working_pressure_angle
    radial = np.array([np.cos(angle), np.sin(angle)])
    tangential = np.array([-radial[1], radial[0]])
    curves = found.misalignment.curves
    widths = np.full(curves.position.size, curves.position[1])
    widths[0] = widths[-1] = widths[0] / 2
    stations = curves.line_force * widths
    transverse = -sign * (np.cos(working) * tangential + np.sin(working) * radial)
    arm = (path.pair.pinion_working_radius, -path.pair.wheel_working_radius)[index] * radial
    down, gravity = np.array([0.0, -1.0]), weight(shaft)
    own = inputs.couplings[index]
    force = stations.sum() * transverse + gravity[0] * down + np.array(coupling.force)
    couple = (stations @ curves.z) * transverse + gravity[1] * down + own.position * np.array(coupling.force)
    couple -= result.thrust.mesh * arm
    couple += np.array([coupling.moment[1], -coupling.moment[0]])
    if inputs.collar_radius is not None:
        touching = inputs.collar_radius - (0.0 if index == 0 else path.pair.centre_distance)
        couple -= result.thrust.collar * touching * radial
    for bearing, given in zip(result.bearings, shaft.bearings, strict=True):
        force += np.array(bearing.reaction)
        couple += given.position * np.array(bearing.reaction)
    return force, couple


@pytest.mark.parametrize("fraction", [0.0, 0.6, -1.0])
@pytest.mark.parametrize("collar", [None, COLLAR])
def test_what_is_told_of_a_shaft_is_in_balance(fraction: float, collar: float | None) -> None:
    """The forces and moments on a shaft add up to zero, within 1e-9 of the tooth force and of its moment."""
    # If the sleeve of 12 kg were left out, 118 N would remain, which is 1e-3 of the tooth force.
    inputs = unit(fraction, collar)
    found = solve(inputs)
    tooth = 12e6 / (10000 * pi / 30) / meshing_path(inputs.mesh.distribution.gears).pair.pinion.base_radius
    for index in (0, 1):
        force, couple = sums(inputs, found, index)
        assert force / tooth == pytest.approx([0.0, 0.0], abs=1e-9)
        assert couple / (tooth * 0.2) == pytest.approx([0.0, 0.0], abs=1e-9)


@pytest.mark.parametrize("fraction", [0.0, 0.6, 1.0, -1.0])
def test_collar_coupling_and_mesh_hold_each_other_along_the_pinion(fraction: float) -> None:
    found = solve(unit(fraction, COLLAR))
    pinion, wheel = (shaft.thrust for shaft in found.shafts)
    thrust = fraction * found.couplings[0].thrust_limit
    assert found.couplings[0].thrust == pytest.approx(thrust, rel=1e-12)
    assert pinion.collar + thrust + pinion.mesh == pytest.approx(0.0, abs=1e-9 * pinion.mesh)
    assert wheel.collar == pytest.approx(-pinion.collar, rel=1e-12)
    assert found.couplings[1].thrust == pytest.approx(-0.5 * found.couplings[1].thrust_limit, rel=1e-12)
