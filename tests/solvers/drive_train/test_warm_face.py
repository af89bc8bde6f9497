"""The warm face: the worked example, exact limits of the loop, and properties over random units."""

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st

from app.examples import examples as shown
from app.models.drive_train.request import DriveTrainRequest
from solvers.drive_train import solve
from solvers.drive_train.gap.face_curves import face_slope
from solvers.drive_train.gap.thermal_lead import thermal_lead
from solvers.drive_train.gap.warm_face import WarmFaces, amplification
from solvers.drive_train.inputs import DriveTrainInputs, GearBody, ShaftSection
from solvers.drive_train.prepared import settle
from solvers.drive_train.unit_heat import WarmUnit, warm_unit
from solvers.errors import InvalidInput, NoSolution
from solvers.heat_balance.convection import face_convection, recovery_rise
from solvers.heat_balance.inputs import FaceReading
from solvers.heat_balance.losses import impact_rise
from solvers.heat_balance.rings import Response
from tests.support.changes import changed
from tests.support.drive_trains import CELSIUS
from tests.support.heated_units import cooled_units
from tests.support.properties import examples
from tests.support.random_units import mirrored

FEW, MANY = 5, 60
COOLING = "mesh.cooling"
SHAPE = "mesh.distribution.modifications"
MICRON = 1e-6


@cache
def starter() -> DriveTrainInputs:
    """The turbo unit of the worked example, with the bearings and the windage of its calculation."""
    request = DriveTrainRequest.model_validate(shown()["starter-turbo-gear-heat"].request)
    return changed(request.inputs(), {"bearing_film": "short", f"{COOLING}.windage": 14622.0})


EXAMPLE = {f"{SHAPE}.helix_slope": 30e-6, f"{COOLING}.wetting_share": 0.3}


@cache
def example() -> WarmUnit:
    return warm_unit(changed(starter(), EXAMPLE))


def loop_of(warm: WarmUnit) -> WarmFaces:
    assert warm.faces is not None
    return warm.faces


def test_the_parts_of_the_worked_example() -> None:
    """Independent calculations agreed on these numbers, with a mist 0.1 K cooler: the power of the jets came later."""
    warm = example()
    loop, face = loop_of(warm), warm.face
    assert face is not None
    faces = loop.faces
    gears = faces.network.gears
    assert [rotor.geometry.root_radius for rotor in faces.rotors] == pytest.approx([0.111897, 0.390490], abs=1e-6)
    levers = loop.levers
    assert [slope for slope, _ in levers] == pytest.approx([0.31016, 0.33683], abs=1e-5)
    assert [length for _, length in levers] == pytest.approx([6.867e-3, 7.044e-3], abs=1e-6)
    assert [gear.to_body / 0.2 for gear in gears] == pytest.approx([5139.4, 17131.4], rel=1e-5)
    assert [faces.tooth_area(gear) for gear in gears] == pytest.approx([5063.8e-6, 16879.3e-6], rel=1e-5)
    assert face.along.mesh_power == pytest.approx(26758, abs=5)
    assert face.along.mist + 50 == pytest.approx(65.85, abs=0.1)
    middle = np.array([0, 20, 40])
    wanted = {
        "flanks": [[75.23, 80.31, 82.54], [72.89, 76.50, 77.09]],
        "bodies": [[71.59, 75.43, 76.06], [71.33, 74.56, 74.29]],
    }
    for name, values in wanted.items():
        found = getattr(face, name)[:, 0, middle] - CELSIUS
        assert found == pytest.approx(np.array(values), abs=0.12)
    for gear, grown in ((0, 5.20), (1, 4.21)):
        assert growth_per_skew(loop, warm, gear) == pytest.approx(grown * MICRON, rel=0.005)
    assert face_slope(loop.gas_leads[0]) == pytest.approx(-4.02 * MICRON, abs=0.1 * MICRON)


def test_the_heat_of_the_worked_example() -> None:
    """Source, to oil, to mist, by faces and ends of teeth, into the shafts [W], and the coefficients behind them."""
    faces, face = loop_of(example()).faces, example().face
    assert face is not None
    along, network, width = face.along, faces.network, 0.2
    weights = faces.mass.sum(axis=0)
    wanted = ((13816, 13488, 417, 121, -210), (14416, 13052, 484, 900, -20))
    coefficients = ((251.14, 614.2, 7.542), (556.19, 473.0, 7.045))
    for gear, (powers, (air, disc, rise)) in enumerate(zip(wanted, coefficients, strict=True)):
        wheel, body = network.gears[gear], faces.responses[gear]
        flanks, teeth, mist = along.flanks[gear], along.bodies[gear], along.mist
        recovered = recovery_rise(wheel.flanks.speed, wheel.tip_radius)
        rim = network.mist_convection_factor * wheel.rim / (2 * width)
        face_transfer = network.mist_convection_factor * face_convection(wheel.flanks.speed, wheel.tip_radius)
        assert (rim, face_transfer, recovered) == pytest.approx((air, disc, rise), rel=2e-4)
        share = network.mesh.share_to_pinion if gear == 0 else 1 - network.mesh.share_to_pinion
        source = share * along.mesh_power + network.pumping_to_teeth * wheel.pumping
        impact = impact_rise(network.oil, network.spray.velocity, network.spray.jet)
        side = np.array([network.cooling(gear, 0 * loop_of(example()).rises + rise).conductance for rise in flanks])
        side, tooth = side / (2 * width), wheel.to_body / width
        oil = weights @ (side * (flanks - impact) + side * tooth / (side + tooth) * (teeth - impact))
        to_mist = weights @ (rim * (flanks + teeth - 2 * (mist + recovered)))
        inner = np.maximum(faces.rotors[gear].shaft_radii, faces.rotors[gear].geometry.root_radius)
        ring = face_transfer * np.pi * (wheel.tip_radius**2 - inner**2) * (teeth[[0, -1]] - mist - recovered / 2)
        sources = faces.sources(gear, teeth, mist)
        by_faces = body.to_air @ sources + ring.sum()
        shafts = float((body.to_journals @ sources).sum())
        found = (source, float(oil), float(to_mist), float(by_faces), shafts)
        assert sum(found[1:]) == pytest.approx(source, rel=1e-9)
        assert found == pytest.approx(powers, abs=25)  # the mist is 0.1 K warmer than in the example


def growth_per_skew(loop: WarmFaces, warm: WarmUnit, gear: int) -> float:
    """Half the slope of the growth [m] of a gear under a load that rises from 0 to twice its mean over the face."""
    face = warm.face
    assert face is not None
    skew = loop.at_nodes(np.linspace(-1.0, 1.0, 41)[None])[:, None]
    flanks, bodies = loop.faces.by_load(face.along, skew)
    sources = np.concatenate([bodies[gear], np.zeros((4, 1))])
    response = loop.faces.responses[gear]
    growth = loop.growth(gear, (flanks[gear] + bodies[gear]) / 2, response, sources)
    return face_slope(loop.ordered(growth[:, 0])[0]) / 2


def test_the_results_of_the_worked_example() -> None:
    result = solve(changed(starter(), EXAMPLE))
    heat, safety = result.heat, result.safety
    assert heat is not None
    assert safety is not None
    face = heat.face
    assert face is not None
    assert face.gain == pytest.approx(0.314, abs=0.008)
    assert face.amplification == pytest.approx(1.458, rel=0.015)
    assert face.end_amplification == pytest.approx(1.366, rel=0.02)
    assert face.largest_eigenvalue == pytest.approx(0.321, abs=0.008)
    warm = example()
    assert warm.face is not None
    others = np.sort(np.linalg.eigvals(loop_of(warm).loop(warm.equilibrium, warm.face.along)).real)[::-1]
    assert others[1:4] == pytest.approx([0.232, 0.146, 0.106], abs=0.008)
    assert face.lead_slope == pytest.approx(-4.17 * MICRON, abs=0.15 * MICRON)
    assert face.lead_crown == pytest.approx(0.53 * MICRON, abs=0.15 * MICRON)
    assert result.misalignment.thermal_slope == pytest.approx(-8.19 * MICRON, abs=0.2 * MICRON)
    assert result.misalignment.shaft_slope == pytest.approx(-32.19 * MICRON, abs=0.2 * MICRON)
    assert result.load.face_load_factor == pytest.approx(1.158, rel=0.006)
    assert face.uniform_heat.face_load_factor == pytest.approx(1.107, rel=0.006)
    assert safety.blok_flank == pytest.approx(2.191, rel=0.008)
    assert face.uniform_heat.blok_flank == pytest.approx(2.324, rel=0.008)
    assert result.derived.temperatures.bulk == pytest.approx(np.mean([face.pinion.flank, face.wheel.flank]), abs=0.2)


def test_the_starter_as_ground() -> None:
    """50 µm and a wetting share of 0.5: K 1.078 with even slices, 1.236 with even heat, 1.278 with its own."""
    result, even = solve(starter()), solve(replace(starter(), face_heat="uniform"))
    assert result.heat is not None
    face = result.heat.face
    assert face is not None
    assert even.load.face_load_factor == pytest.approx(1.078, rel=0.002)
    assert face.uniform_heat.face_load_factor == pytest.approx(1.236, rel=0.003)
    assert result.load.face_load_factor == pytest.approx(1.278, rel=0.003)
    assert result.heat.band is not None
    low, high = result.heat.band.amplification or (np.nan, np.nan)
    assert low == pytest.approx(1.16, abs=0.01)
    assert low < (face.amplification or np.nan) < high
    assert even.heat is not None
    assert even.heat.face is None


@pytest.mark.parametrize(("wetting", "gain"), [(1.0, 0.18), (0.5, 0.23), (0.35, 0.28), (0.25, 0.35), (0.17, 0.43)])
def test_the_gain_of_the_starter_falls_with_its_oil(wetting: float, gain: float) -> None:
    warm = warm_unit(changed(starter(), {f"{COOLING}.wetting_share": wetting, f"{COOLING}.band": False}))
    assert warm.face is not None
    assert warm.face.amplification.gain[0] == pytest.approx(gain, abs=0.01)


def test_readings_along_the_face() -> None:
    """Two thermocouples in the body of the pinion, under the load of even slices."""
    readings = tuple(
        FaceReading("pinion", "body", place, value + CELSIUS) for place, value in ((0.02, 77.95), (0.18, 69.57))
    )
    warm, even = warm_unit(starter()), warm_unit(replace(starter(), face_heat="uniform"))
    assert loop_of(warm).fit(readings, even.equilibrium) == pytest.approx((0.330, 0.250), abs=1e-3)
    alone = loop_of(warm).fit(readings[:1], even.equilibrium)
    assert alone[1] == 0.0
    fitted = solve(changed(starter(), {f"{COOLING}.measured.face": readings}))
    assert fitted.heat is not None
    face = fitted.heat.face
    assert face is not None
    assert face.reading_deviation == pytest.approx(0.0, abs=0.01)
    assert face.jet_skew == pytest.approx(0.09, abs=0.02)
    assert fitted.heat.wetting_share == pytest.approx(0.329, abs=2e-3)


@pytest.mark.parametrize("gain", [0.13, 0.5, 0.96])
def test_free_slices_of_even_stiffness(gain: float) -> None:
    """Where every station heats and yields alone, A = 1/(1 - g)."""
    without_mean = np.eye(41) - np.append([0.5], np.append(np.ones(39), 0.5)) / 40
    found = amplification(gain * without_mean, -2.0 * without_mean, 1)
    assert found.skew[0] == pytest.approx(1 / (1 - gain), rel=1e-12)
    assert found.gain[0] == pytest.approx(gain, rel=1e-12)
    assert found.end[0] == pytest.approx(1 / (1 - gain), rel=1e-12)
    assert amplification(1.01 * without_mean, -without_mean, 1).skew == (None,)


def settled(inputs: DriveTrainInputs) -> WarmUnit:
    """Solve a drawn unit; drawn again if it has no solution."""
    inputs = changed(inputs, {f"{COOLING}.band": False})
    try:
        return warm_unit(inputs)
    except (NoSolution, InvalidInput):
        assume(False)
        raise


@st.composite
def warm_units(draw: st.DrawFn) -> DriveTrainInputs:
    """Draw cooled units, of which some wheels have a rim on a web."""
    inputs = draw(cooled_units())
    if draw(st.booleans()):
        rim = draw(st.floats(0.02, 0.06))
        wheel = replace(inputs.wheel_shaft, gear_body=GearBody(rim, draw(st.floats(0.02, 0.1)), 0.24))
        inputs = replace(inputs, wheel_shaft=wheel)
    return inputs


@examples(FEW, MANY, warm_units())
def test_heat_is_kept_and_the_loop_closes(inputs: DriveTrainInputs) -> None:
    """Supplied heat is removed, and load and temperatures belong to each other."""
    warm = settled(inputs)
    loop, face = loop_of(warm), warm.face
    assert face is not None
    assert abs(face.along.balance_error) < 1e-9
    again = loop.faces.solve(loop.at_nodes(loop.relative_load(face.equilibrium)))
    assert again.flanks == pytest.approx(face.along.flanks, abs=1e-6)


@examples(FEW, MANY, warm_units())
def test_a_mirrored_unit_has_the_same_warm_face(inputs: DriveTrainInputs) -> None:
    one, other = settled(inputs).face, settled(mirrored(inputs)).face
    assert one is not None
    assert other is not None
    turned = slice(None, None, -1 if inputs.mesh.distribution.gears.helix_angle == 0.0 else 1)  # y of a spur pair
    assert other.flanks[..., turned] == pytest.approx(one.flanks, abs=1e-6)
    assert other.leads[..., turned] == pytest.approx(one.leads, abs=1e-14)
    assert other.amplification.largest_eigenvalue == pytest.approx(one.amplification.largest_eigenvalue, rel=1e-7)


@examples(FEW, MANY, warm_units(), st.floats(-20.0, 40.0), st.floats(-20.0, 40.0))
def test_even_bodies_have_the_lead_of_free_slices(inputs: DriveTrainInputs, pinion: float, wheel: float) -> None:
    """Two bodies at temperatures of their own, the same everywhere: D10."""
    warm = settled(inputs)
    loop = loop_of(warm)
    growth: Any = 0.0
    for gear, rise in ((0, pinion), (1, wheel)):
        body: Response = loop.faces.responses[gear]
        held = loop.faces.sources(gear, np.ones(loop.faces.nodes), 0.0) != 0.0
        sources = np.where(held, rise, 0.0)
        sources[-4:-2] = rise
        growth = growth + loop.growth(gear, np.full(loop.faces.nodes, rise), body, sources)
    reference = inputs.heat.reference
    heat = replace(
        inputs.heat,
        wall_response=0.0,
        wall_response_wheel=0.0,
        pinion_bulk=reference + pinion,
        wheel_bulk=reference + wheel,
    )
    position = loop.ordered(loop.faces.position.ravel())[0]
    wanted = thermal_lead(replace(inputs, heat=heat), loop.prepared.path, np.linspace(0.0, position[-1], 5)).lead
    assert loop.gaps(np.asarray(growth))[0][[0, -1]] == pytest.approx(wanted[[0, -1]], abs=1e-10)


@examples(FEW, MANY, warm_units())
def test_growth_is_in_proportion_to_the_friction(inputs: DriveTrainInputs) -> None:
    """At given temperatures the loop is in proportion to the power of the mesh (Eq. W8)."""
    warm = settled(inputs)
    loop, face = loop_of(warm), warm.face
    assert face is not None
    once = loop.loop(face.equilibrium, face.along)
    twice = loop.loop(face.equilibrium, replace(face.along, mesh_power=2 * face.along.mesh_power))
    assert twice == pytest.approx(2 * once, rel=1e-9, abs=1e-12)


def test_without_friction_there_is_no_loop() -> None:
    warm = warm_unit(changed(starter(), {"mesh.friction": "given", "mesh.distribution.friction_coefficient": 1e-9}))
    assert warm.face is not None
    assert warm.face.amplification.gain[0] == pytest.approx(0.0, abs=1e-5)
    warm = example()
    loop = loop_of(warm)
    flooded = replace(loop.network, spray=replace(loop.network.spray, flow=1e3, fling_off_factor=1e6))
    found = replace(loop, network=flooded).amplified(warm.equilibrium, loop.relative_load(warm.equilibrium))
    assert found.gain[0] == pytest.approx(0.0, abs=1e-5)


def test_an_even_load_has_the_flanks_of_the_network() -> None:
    warm = warm_unit(changed(starter(), {f"{COOLING}.band": False}))
    loop, heat = loop_of(warm), warm.heat
    even = loop.faces.solve(np.ones(loop.faces.nodes))
    means = [loop.faces.mean(flank) + loop.network.oil.inlet for flank in even.flanks]
    assert means == pytest.approx([heat.pinion.flank, heat.wheel.flank], abs=0.6)


def test_a_rotor_that_is_symmetric_is_warm_symmetrically() -> None:
    """The same shaft on both sides and the same journals: T(y) = T(b - y) under an even load."""
    inputs = starter()
    middle = inputs.face_start + inputs.mesh.distribution.gears.face_width / 2
    shafts = []
    for shaft in inputs.shafts:
        first, second = (
            replace(bearing, position=middle + sign * 0.2)
            for bearing, sign in zip(shaft.bearings, (-1.0, 1.0), strict=True)
        )
        shafts.append(replace(shaft, start=middle - 0.4, sections=(ShaftSection(0.8, 0.16),), bearings=(first, second)))
    symmetric = replace(
        inputs,
        pinion_shaft=replace(shafts[0], torque_position=middle - 0.3),
        wheel_shaft=replace(shafts[1], torque_position=middle - 0.3),
        couplings=(),
    )
    loop = loop_of(warm_unit(changed(symmetric, {f"{COOLING}.band": False})))
    rises = np.array(loop.rises)
    rises[[6, 8]] = rises[[5, 7]]
    even = replace(loop, rises=rises).faces.solve(np.ones(loop.faces.nodes))
    for values in (even.flanks, even.bodies):
        assert values[:, ::-1] == pytest.approx(values, abs=1e-9)


def test_two_opposite_starts_and_substitution_reach_the_same_load() -> None:
    """Stable units have one load; substitution reaches it at the rate of the largest eigenvalue."""
    warm = example()
    loop, face = loop_of(warm), warm.face
    assert face is not None
    load = loop.relative_load(face.equilibrium)
    for sign in (-0.8, 0.8):
        skewed = np.array(face.equilibrium.loads)
        skewed[:41] *= 1 + sign * np.linspace(-1.0, 1.0, 41)
        found = loop.solve(replace(face.equilibrium, loads=skewed))
        assert loop.relative_load(found.equilibrium) == pytest.approx(load, abs=1e-7)
    errors = []
    tried = load + 1e-3 * np.linspace(-1.0, 1.0, 41)
    for _ in range(7):
        heated = loop.heated(loop.faces.solve(loop.at_nodes(tried)))
        tried = loop.relative_load(settle(loop.inputs, heated, face.equilibrium.gap))
        errors.append(float(np.abs(tried - load).max()))
    assert errors[-1] / errors[-2] == pytest.approx(face.amplification.largest_eigenvalue, abs=0.01)


def test_amplification_is_that_of_the_answer() -> None:
    """A skew of the gap by 1 µm moves that of the load A times as far as it would without the loop."""
    warm = example()
    loop, step = loop_of(warm), 1e-6

    def skew(slope: float) -> float:
        meshes = tuple(
            replace(mesh, fixed=mesh.fixed + slope * np.linspace(-0.5, 0.5, mesh.fixed.size))
            for mesh in loop.prepared.meshes
        )
        moved = replace(loop, prepared=replace(loop.prepared, meshes=meshes))
        load = moved.relative_load(moved.solve(warm.equilibrium).equilibrium)[0]
        return float(np.trapezoid(load * np.linspace(-0.5, 0.5, 41)))

    by_answer = (skew(step) - skew(-step)) / (2 * step)
    alone = loop.by_gap(warm.equilibrium) @ np.linspace(-0.5, 0.5, 41)
    assert warm.face is not None
    without = np.trapezoid(alone * np.linspace(-0.5, 0.5, 41))
    assert by_answer / without == pytest.approx(warm.face.amplification.skew[0], rel=2e-3)


@pytest.mark.parametrize(
    ("values", "code"),
    [
        ({"wheel_shaft.gear_body": GearBody(0.4, 0.04, 0.3)}, "gear_body"),
        ({"wheel_shaft.gear_body": GearBody(0.04, 0.3, 0.3)}, "gear_body"),
        (
            {f"{COOLING}.jet_distribution.position": (0.0, 0.1), f"{COOLING}.jet_distribution.weight": (1.0,)},
            "jet_distribution",
        ),
        (
            {f"{COOLING}.jet_distribution.position": (0.0, 0.3), f"{COOLING}.jet_distribution.weight": (1.0, 1.0)},
            "jet_distribution",
        ),
        ({"mesh.temperatures.bulk": 360.0, "face_heat": "profile"}, "face_heat_needs_balance"),
        ({f"{COOLING}.measured.face": (FaceReading("pinion", "body", 0.3, 350.0),)}, "reading_outside"),
        ({f"{COOLING}.measured.face": (FaceReading("pinion", "body", 0.1, 350.0, helix=2),)}, "reading_outside"),
    ],
)
def test_refusals(values: dict[str, Any], code: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        solve(changed(starter(), values))
    assert refused.value.code == code
