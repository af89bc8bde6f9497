"""The worked example has the expected derivatives of its main results and the expected uncertain inputs."""

from dataclasses import replace
from math import prod
from typing import NamedTuple

import numpy as np
import pytest

from solvers.drive_train.gap.balance import uniform_force
from solvers.drive_train.inputs import DriveTrainInputs, Effects, RigidBearing
from solvers.drive_train.outcome import outcome, outcome_of
from solvers.drive_train.prepared import prepare, settle
from solvers.drive_train.states import solve
from solvers.drive_train.uncertainty import uncertain_inputs
from solvers.scuffing.inputs import LeadCurve, Resolution
from solvers.scuffing.safety import safety_factor
from tests.support.changes import changed, value_at
from tests.support.drive_trains import COUPLING, GROUND, turbo_gear
from tests.support.properties import first

SHAPE = "mesh.distribution.modifications"
STEP = 1e-3  # of a tolerance


class Derivative(NamedTuple):
    """Changes of K_H_beta and of the safety factor at the hottest place, if an input changes by one tolerance.

    `kink` is True if the largest load changes by different amounts for a step up and a step down.
    """

    face_load_factor: float
    safety: float
    kink: bool


def derivative(inputs: DriveTrainInputs, name: str, tolerance: float) -> Derivative:
    """Compute central differences at the places where the unchanged unit has its maxima (envelope theorem).

    At fixed places, the differences have no jumps due to a maximum that moves between points of the face. Only `kink`
    compares the largest loads wherever they are.
    """
    base = outcome(inputs)
    place = int(np.argmax(base.shares))
    hottest = np.unravel_index(int(np.argmax(base.temperature)), base.temperature.shape)
    factors, safeties, moves = [], [], []
    for sign in (1.0, -1.0):
        unit = changed(inputs, {name: float(value_at(inputs, name)) + sign * STEP * tolerance})
        side = outcome(unit, base.gap)
        factors.append(float(side.shares[place]))
        safety = safety_factor(side.limit, unit.mesh.temperatures.oil, float(side.temperature[hottest]))
        safeties.append(safety or 0.0)
        moves.append(abs(float(side.shares.max() - base.shares.max())))
    return Derivative(
        (factors[0] - factors[1]) / (2 * STEP),
        (safeties[0] - safeties[1]) / (2 * STEP),
        abs(moves[0] - moves[1]) > 0.1 * max(moves) + 1e-8,
    )


# input, tolerance, change of K_Hb and of the safety over the flank
LOCAL = [
    ("couplings.0.friction.coefficient", 0.05, 0.008, -0.016),
    ("heat.wall_response", 0.1, 0.012, -0.009),
    ("heat.pinion_bulk", 5.0, 0.007, 0.005),
    ("heat.wheel_bulk", 5.0, -0.007, -0.005),
    (f"{SHAPE}.helix_slope", 5e-6, -0.014, 0.026),
    (f"{SHAPE}.lead_crowning", 2e-6, 0.026, -0.007),
    ("pinion_shaft.bearings.1.radial_clearance", 15e-6, 0.017, -0.030),
    ("pinion_shaft.bearings.0.radial_clearance", 15e-6, -0.008, 0.015),
    ("wheel_shaft.bearings.0.radial_clearance", 15e-6, -0.011, 0.020),
    ("mesh.distribution.friction_coefficient", 0.005, 0.0, -0.118),
    ("mesh.temperatures.bulk", 5.0, 0.0, -0.099),
    ("mesh.temperatures.scuffing", 10.0, 0.0, 0.108),
]


@pytest.mark.parametrize(("name", "tolerance", "factor", "safety"), first(4, LOCAL))
def test_derivatives_of_the_corrected_unit(name: str, tolerance: float, factor: float, safety: float) -> None:
    found = derivative(turbo_gear(GROUND), name, tolerance)
    assert found.face_load_factor == pytest.approx(factor, abs=0.0012)
    assert found.safety == pytest.approx(safety, abs=0.0011)
    assert not found.kink


def test_viscosity_of_all_films_and_the_offset() -> None:
    """If the viscosity of all films rises by 2 mPa s, K_H_beta changes by -0.0035 and the safety factor by +0.0061."""
    # If the machine stands 100 um higher, K_H_beta changes by +0.001.
    inputs = turbo_gear(GROUND)
    names = [f"{shaft}.bearings.{k}.viscosity" for shaft in ("pinion_shaft", "wheel_shaft") for k in (0, 1)]
    found = [derivative(inputs, name, 2e-3) for name in names]
    assert sum(one.face_load_factor for one in found) == pytest.approx(-0.0035, abs=3e-4)
    assert sum(one.safety for one in found) == pytest.approx(0.0061, abs=3e-4)
    assert derivative(inputs, "couplings.0.offset.1", 100e-6).face_load_factor == pytest.approx(0.001, abs=5e-4)


def test_an_edge_maximum_is_smooth() -> None:
    """The unit without lead correction (row 5) has its largest load at the edge of the face."""
    # The derivative of this load with respect to the coefficient of friction is the same for steps of 1e-3, 1e-5 and
    # 1e-7. K_H_beta has the same derivative.
    name = "couplings.0.friction.coefficient"
    slopes = [derivative(turbo_gear(), name, change).face_load_factor / change for change in (1.0, 1e-2, 1e-4)]
    assert slopes == pytest.approx([slopes[0]] * 3, rel=1e-4)
    factors = [outcome(changed(turbo_gear(), {name: 0.15 + step})).face_load_factor or 0.0 for step in (1e-4, -1e-4)]
    assert slopes[0] == pytest.approx((factors[0] - factors[1]) / 2e-4, rel=1e-3)


def test_gap_at_a_station_moves_the_load_as_the_derivative_says() -> None:
    """The derivative predicts how the load at the end of the face changes with the gap at one of eleven stations."""
    # The load is divided by its mean over the face.
    resolution = Resolution(roll_positions=48, slices=40, profile_points=61, face_points=61, feature_points=5)
    inputs = changed(turbo_gear(), {"face_stations": 11, "mesh.distribution.resolution": resolution})
    prepared = prepare(inputs)
    found = settle(inputs, prepared)
    assert int(np.argmax(outcome_of(inputs, prepared, found).shares)) == 60
    by_gap = found.by_gap[-1] / uniform_force(prepared.meshes[0].transmitted, 11)[-1]
    step, place = 1e-8, 4
    position = tuple(float(y) for y in prepared.unit.stations)
    hat = tuple(step * (k == place) for k in range(11))
    lifted = changed(inputs, {f"{SHAPE}.lead_curve": LeadCurve(position, hat)})
    forces = [solve(unit).misalignment.curves.line_force for unit in (inputs, lifted)]
    share = [force[-1] / np.trapezoid(force, dx=0.1) for force in forces]
    assert (share[1] - share[0]) / step == pytest.approx(by_gap[place], rel=1e-4)
    assert by_gap.sum() == pytest.approx(0.0, abs=1e-9 * np.abs(by_gap).max())


def test_uncertain_inputs() -> None:
    inputs = turbo_gear()
    response, pinion, wheel, friction, offset, thrust = uncertain_inputs(inputs)
    assert (response.names, response.values) == (("heat.wall_response",), ((0.3,), (1.0,)))
    for shaft, clearances, own in (("pinion", pinion, 130e-6), ("wheel", wheel, 150e-6)):
        assert clearances.names == tuple(f"{shaft}_shaft.bearings.{k}.radial_clearance" for k in (0, 1))
        assert np.array(clearances.values) == pytest.approx(own * np.array([[1.1, 0.9], [0.9, 1.1]]))
    assert (friction.names, friction.values) == (("couplings.0.friction.coefficient",), ((0.05,), (0.25,)))
    assert offset.names == ("couplings.0.offset.0", "couplings.0.offset.1")
    assert offset.values == ((0.0, 400e-6), (-400e-6, 0.0), (0.0, -400e-6), (400e-6, 0.0))
    assert (thrust.names, thrust.values) == (("couplings.0.thrust_fraction",), ((0.0,), (1.0,)))
    assert prod(len(each.values) for each in uncertain_inputs(inputs)) == 128


def test_uncertain_inputs_leave_out_what_moves_nothing() -> None:
    inputs = turbo_gear()
    assert uncertain_inputs(replace(inputs, effects=Effects(False, False, False))) == ()
    aligned = changed(inputs, {"couplings.0.offset": (0.0, 0.0)})
    assert not [name for one in uncertain_inputs(aligned) for name in one.names if "offset" in name]
    rigid = changed(inputs, {"pinion_shaft.bearings": (RigidBearing(0.22), RigidBearing(0.62))})
    assert not [name for one in uncertain_inputs(rigid) for name in one.names if name.startswith("pinion_shaft")]


def test_two_couplings_move_together() -> None:
    inputs = turbo_gear()
    both = replace(inputs, couplings=(COUPLING, replace(COUPLING, shaft="wheel", offset=(1e-4, 0.0))))
    *_, friction, offset, thrust = uncertain_inputs(both)
    assert friction.values == ((0.05, 0.05), (0.25, 0.25))
    assert offset.values[1] == (-400e-6, 0.0, 0.0, 1e-4)
    assert thrust.names == ("couplings.0.thrust_fraction", "couplings.1.thrust_fraction")
    assert prod(len(each.values) for each in uncertain_inputs(both)) == 128
