"""Double-helical units: limits of a single helix, symmetries, the axial balance, and what a tilted coupling holds."""

import re
from dataclasses import replace
from math import asin, cos, pi, tan

import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st

from solvers.arrays import FloatArray
from solvers.drive_train.gap.balance import uniform_force
from solvers.drive_train.gap.face_curves import face_mean
from solvers.drive_train.inputs import DriveTrainInputs, Effects, LinearBearing, Shaft, ShaftSection
from solvers.drive_train.prepared import prepare
from solvers.drive_train.results import DriveTrainResult, HelixResult
from solvers.drive_train.states import solve
from solvers.errors import InvalidInput, NoSolution
from tests.support.answers import differences
from tests.support.changes import changed
from tests.support.double_helicals import double_helical, double_helical_units
from tests.support.drive_trains import NO_EFFECTS
from tests.support.properties import examples
from tests.support.random_units import mirrored, reversed_ends, rotated

FEW, MANY = 6, 100
ROUNDING = r"convergence\.residual$"
GEARS = "mesh.distribution.gears"
LOAD = "mesh.distribution.load"


def solved(inputs: DriveTrainInputs) -> DriveTrainResult:
    """Solve a drawn unit; drawn again if a helix lifts off."""
    try:
        return solve(inputs)
    except NoSolution as failure:
        assume(failure.code != "helix_unloaded")
        raise


def helices(result: DriveTrainResult) -> tuple[HelixResult, HelixResult]:
    assert result.helices is not None
    one, two = result.helices
    return one, two


def single(inputs: DriveTrainInputs, helix: int, share: float) -> DriveTrainInputs:
    """Return the single-helical unit of one helix alone, under a share of the torque."""
    gears, given = inputs.mesh.distribution.gears, inputs.mesh.distribution
    assert gears.gap_width is not None
    hand = inputs.arrangement.hand
    other = "left" if hand == "right" else "right"
    shape = given.modifications if helix == 0 else given.modifications.of_second_helix
    alone = replace(gears, gap_width=None)
    return replace(
        changed(
            inputs,
            {
                GEARS: alone,
                f"{LOAD}.pinion_torque": share * given.load.torque,
                f"{LOAD}.axial_force": 0.0,
                "mesh.distribution.modifications": replace(shape, second_helix=None),
                "arrangement.hand": hand if helix == 0 else other,
            },
        ),
        face_start=inputs.face_start + helix * (gears.face_width + gears.gap_width),
        pumping=replace(inputs.pumping, gears=replace(inputs.pumping.gears, gap_width=None)),
        floating_shaft=None,
    )


@examples(FEW, MANY, double_helical_units())
def test_without_shafts_each_helix_is_a_single_one_at_half_the_power(inputs: DriveTrainInputs) -> None:
    inputs = replace(inputs, effects=NO_EFFECTS)
    for k, helix in enumerate(helices(solve(inputs))):
        alone = solve(single(inputs, k, 0.5))
        for name in ("load", "flash", "safety"):
            assert not differences(getattr(alone, name), getattr(helix, name), tolerance=1e-12)
        assert helix.misalignment.recommended_helix_slope == alone.misalignment.recommended_helix_slope


@examples(FEW, MANY, double_helical_units(), st.sampled_from([0, 1]))
def test_a_helix_that_carries_all_is_the_single_helical_unit(inputs: DriveTrainInputs, helix: int) -> None:
    """Couplings act as they do, but for their thrust: the external force alone unloads the other helix."""
    inputs = changed(inputs, {f"couplings.{k}.thrust_fraction": 0.0 for k in range(len(inputs.couplings))})
    axial = solve(replace(inputs, effects=NO_EFFECTS)).axial
    assert axial is not None
    force = (1 - 2e-8) * axial.unloading_force
    results = [solved_or_none(changed(inputs, {f"{LOAD}.axial_force": sign * force})) for sign in (1.0, -1.0)]
    carried = next(r for r in results if r is None or helices(r)[helix].share > 0.5)
    assume(carried is not None)
    assert carried is not None
    own, alone = helices(carried)[helix], solve(single(inputs, helix, 1.0))
    assert own.misalignment.shaft_slope == pytest.approx(alone.misalignment.shaft_slope, abs=2e-11, rel=2e-6)
    assert own.load.face_load_factor == pytest.approx(alone.load.face_load_factor, rel=1e-5)
    assert own.load.max_pressure == pytest.approx(alone.load.max_pressure, rel=1e-5)
    for one, other in zip(carried.couplings, alone.couplings, strict=True):
        assert one.tilt == pytest.approx(other.tilt, rel=1e-5, abs=1e-9)


def solved_or_none(inputs: DriveTrainInputs) -> DriveTrainResult | None:
    try:
        return solve(inputs)
    except (NoSolution, InvalidInput):
        return None


@examples(FEW, MANY, double_helical_units(), st.floats(-3.0, 3.0))
def test_a_unit_that_is_turned(inputs: DriveTrainInputs, angle: float) -> None:
    one, other = solved(inputs), solved(rotated(inputs, angle))
    assert not differences(one.axial, other.axial)
    for before, after in zip(helices(one), helices(other), strict=True):
        assert not differences(before, after)


@examples(FEW, MANY, double_helical_units())
def test_a_unit_in_a_mirror_beside_it(inputs: DriveTrainInputs) -> None:
    """Rotation and hands change; leading stays leading."""
    one, other = solved(inputs), solved(mirrored(inputs))
    assert not differences(one.axial, other.axial)
    for before, after in zip(helices(one), helices(other), strict=True):
        assert not differences(before, after, without="^hand$")


@examples(FEW, MANY, double_helical_units())
def test_a_unit_in_a_mirror_before_its_end(inputs: DriveTrainInputs) -> None:
    """The helices change places; thrusts change sign; the helix at the lower Z keeps its hand."""
    one = solved(inputs)
    shape = inputs.mesh.distribution.modifications
    assert shape.second_helix is not None
    turned_shape = replace(
        shape.of_second_helix,
        in_plane_deviation=shape.in_plane_deviation,
        second_helix=replace(shape.second_helix, helix_slope=shape.helix_slope, lead_crowning=shape.lead_crowning),
    )
    image = reversed_ends(inputs)
    gears = inputs.mesh.distribution.gears
    image = changed(
        replace(image, face_start=-inputs.face_start - gears.total_width),
        {
            "arrangement.hand": inputs.arrangement.hand,
            f"{LOAD}.axial_force": -inputs.mesh.distribution.load.axial_force,
            "mesh.distribution.modifications": turned_shape,
        },
    )
    other = solved(image)
    assert one.axial is not None
    assert other.axial is not None
    assert other.axial.apex == one.axial.apex
    assert other.axial.float == pytest.approx(-(one.axial.float or 0.0), abs=1e-12)
    assert other.axial.force == pytest.approx(-one.axial.force, abs=1e-6)

    def expected(name: str, values: FloatArray, _: str | None) -> FloatArray:
        if name == "axial_force" or re.search(r"curves\.z$", name):
            return -values
        return -(values + gears.face_width) if name == "start" else values

    for before, after in zip(helices(one), reversed(helices(other)), strict=True):
        assert not differences(before, after, expected, without="^hand$", tolerance=1e-8)


@examples(FEW, MANY, double_helical_units(), st.floats(-0.9, 0.9))
def test_the_share_follows_from_the_axial_balance(inputs: DriveTrainInputs, part: float) -> None:
    """q = -s_f F_ext/(F_bt d_Z); shares add up to 1, and the mesh's axial force on the floating shaft is -F_ext."""
    axial = solve(replace(inputs, effects=NO_EFFECTS)).axial
    assert axial is not None
    inputs = changed(replace(inputs, couplings=()), {f"{LOAD}.axial_force": part * axial.unloading_force})
    result = solved(replace(inputs, effects=NO_EFFECTS))
    one, two = helices(result)
    assert result.axial is not None
    assert one.share + two.share == pytest.approx(1.0, abs=1e-15)
    assert max(one.share, two.share) == pytest.approx((1 + abs(part)) / 2, rel=1e-12)
    on_pinion = one.axial_force + two.axial_force
    sign = 1.0 if result.axial.floating_shaft == "pinion" else -1.0
    assert sign * on_pinion == pytest.approx(-result.axial.force, abs=1e-9 * axial.unloading_force)
    floating = result.shafts[0 if sign > 0.0 else 1].thrust
    assert floating.mesh == pytest.approx(-result.axial.force)
    assert floating.lower is None


def test_the_share_of_a_locked_coupling_in_one_line() -> None:
    """q = tau mu r_b/(r_o cos alpha tan beta_b): torque, speed, module and width cancel."""
    inputs = double_helical()
    for torque in (1.0, 0.3):
        given = changed(
            inputs,
            {
                "couplings.0.thrust_fraction": -1.0,
                f"{LOAD}.pinion_torque": torque * inputs.mesh.distribution.load.torque,
                "mesh.distribution.resolution.roll_positions": 24,
            },
        )
        result = solve(replace(given, effects=Effects(thermal=False)))
        pair = result.mesh.path_of_contact.pair
        q = 0.15 * pair.pinion.base_radius / (0.09 * cos(pi / 9) * tan(pair.base_helix_angle))
        assert helices(result)[0].share == pytest.approx((1 + q) / 2, rel=1e-9)
        assert q == pytest.approx(0.405, abs=1e-3)


def symmetric(inputs: DriveTrainInputs) -> DriveTrainInputs:
    """Return the unit with a stiff torsion, no weight, and shafts and bearings that are symmetric about the gap."""
    gears = inputs.mesh.distribution.gears
    middle = inputs.face_start + gears.total_width / 2
    core = gears.total_width
    shafts = []
    for diameter, heart in ((0.15, 0.17), (0.2, 0.4)):
        sections = (ShaftSection(0.3, diameter), ShaftSection(core, heart), ShaftSection(0.3, diameter))
        stiff = ((4e8, 0.0), (0.0, 6e8))
        bearings = tuple(LinearBearing(middle + side * (core / 2 + 0.1), stiff) for side in (-1.0, 1.0))
        start = middle - core / 2 - 0.3
        shafts.append(Shaft(sections, bearings, start=start, torque_position=start, poisson_ratio=0.0))
    return replace(
        changed(inputs, {"arrangement.gravity_factor": 0.0, "couplings": (), f"{LOAD}.axial_force": 0.0}),
        pinion_shaft=shafts[0],
        wheel_shaft=shafts[1],
    )


@examples(FEW, MANY, double_helical_units())
def test_a_symmetric_unit_bends_both_helices_alike(inputs: DriveTrainInputs) -> None:
    """Without torsion both gaps are the same curve, the axes do not tilt and nothing floats."""
    inputs = symmetric(inputs)
    system = prepare(inputs).unit
    force = uniform_force(1e5, system.stations.size, (0.5, 0.5))
    bending = np.zeros(system.count)
    for side in system.shafts:
        bending += side.reading(side.motion(side.loads[:, :, : system.count] @ force))[: system.count]
    one, two = bending[system.on_face(0)], bending[system.on_face(1)]
    assert one == pytest.approx(two, abs=1e-12 * float(np.abs(bending).max()) + 1e-18)
    loads = [state.load for state in system.bearings(force)]
    assert loads[0] == pytest.approx(loads[1], rel=1e-9, abs=1e-6)


@examples(FEW, MANY, double_helical_units())
def test_wind_up_is_three_quarters_and_one_quarter(inputs: DriveTrainInputs) -> None:
    """Torque enters at one end: the near helix winds up by 3/4 of T b r_b/(G J), the far one by 1/4."""
    inputs = symmetric(inputs)
    prepared = prepare(inputs)
    system, pair = prepared.unit, prepared.path.pair
    torque = inputs.mesh.distribution.load.torque
    force = uniform_force(torque / pair.pinion.base_radius, system.stations.size, (0.5, 0.5))
    side, gears = system.shafts[0], inputs.mesh.distribution.gears
    twist = side.torques.T @ (side.model.torsion @ (side.torques[:, : system.count] @ force))
    stiffness = 206e9 / 2 * pi / 32 * 0.17**4  # G J of the section under both helices; nu is 0 here
    whole = torque * gears.face_width * pair.pinion.base_radius / stiffness
    near, far = (twist[system.on_face(k)] for k in range(2))
    fine = system.stations.size
    assert np.ptp(near) == pytest.approx(0.75 * whole, rel=2 / fine**2 + 1e-12)
    assert np.ptp(far) == pytest.approx(0.25 * whole, rel=2 / fine**2 + 1e-12)
    assert gears.gap_width is not None
    apart = torque * pair.pinion.base_radius * (gears.face_width + gears.gap_width) / (2 * stiffness)
    assert abs(face_mean(near) - face_mean(far)) == pytest.approx(apart, rel=1e-9)


@examples(FEW, MANY, double_helical_units())
def test_the_flexibility_is_symmetric_and_holds_the_shafts_in_balance(inputs: DriveTrainInputs) -> None:
    system = prepare(inputs).unit
    count = system.count
    elastic = system.elastic[:count, :count]
    assert elastic == pytest.approx(elastic.T, abs=1e-14 * float(np.abs(elastic).max()))
    assert np.linalg.eigvalsh(elastic).min() > -1e-12 * np.abs(elastic).max()
    balance = solved(inputs).balance
    assert balance.force_error is not None
    assert balance.moment_error is not None
    assert balance.force_error < 1e-11
    assert balance.moment_error < 1e-11


# What a coupling that tilts holds along the shaft


def thrust_left(tilts: FloatArray, axial: FloatArray, teeth: int = 60, turns: int = 4, steps: int = 720) -> FloatArray:
    """Mean thrust over the limit of teeth that are springs with friction, by stepping through the last turns.

    `tilts` are over the tilt at which teeth begin to slide; `axial` (turns * steps,) is the motion along the shaft over
    the displacement at which they do.
    """
    angle = 2 * pi * np.arange(turns * steps) / steps
    place = 2 * pi * np.arange(teeth) / teeth
    thrusts = []
    for tilt in tilts:
        moved = axial[:, None] + tilt * np.sin(angle[:, None] + place)
        force, course = np.zeros(teeth), []
        for change in np.diff(moved, axis=0, prepend=moved[:1]):
            force = np.clip(force + change, -1.0, 1.0)
            course.append(force.mean())
        thrusts.append(np.array(course))
    return np.array(thrusts)


def test_a_tilted_hub_holds_what_its_tilt_leaves() -> None:
    """After a slow shift, 1 - delta/delta_0 of the limit stays, and nothing beyond delta_0 (Eq. D21)."""
    tilts = np.array([0.1, 0.25, 0.5, 0.75, 0.9, 1.0, 3.0])
    shift = np.minimum(np.arange(4 * 720) / 720, 2.0) * 2.0
    kept = thrust_left(tilts, shift)[:, -1]
    assert kept == pytest.approx(np.maximum(1.0 - tilts, 0.0), abs=2e-3)


def test_running_axial_motion_over_sliding_hubs() -> None:
    """At the part e/(r_o delta) of the tilt's speed the thrust is (2/pi) asin of this part of the limit (Eq. D21)."""
    tilt, steps = 60.0, 720
    for part in (0.1, 0.4):
        steady = np.cumsum(np.full(4 * steps, part * tilt * 2 * pi / steps))
        thrust = thrust_left(np.array([tilt]), steady)[0, -steps:].mean()
        assert thrust == pytest.approx(2 / pi * asin(part), abs=2e-3)


def test_refusals() -> None:
    plain = double_helical()
    for values, code in (
        ({f"{GEARS}.helix_angle": 0.0}, "double_helical_spur"),
        ({"collar_radius": 0.125}, "thrust_collar_double_helical"),
        ({"face_start": 0.6}, "face_outside"),
        ({"pinion_shaft.torque_position": 0.46}, "torque_position"),
    ):
        with pytest.raises(InvalidInput) as refused:
            solve(changed(plain, values))
        assert refused.value.code == code
    with pytest.raises(NoSolution, match=r"61\.2 kN .* 50\.16 kN") as unloaded:
        solve(changed(plain, {f"{LOAD}.axial_force": 61.2e3}))
    assert unloaded.value.code == "helix_unloaded"
