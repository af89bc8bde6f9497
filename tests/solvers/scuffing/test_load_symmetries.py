"""Random loaded pairs are compared with their mirror images in every number of the load distribution."""

from dataclasses import replace

import numpy as np
import pytest

from solvers.arrays import FloatArray
from solvers.scuffing.contact_lines import line_count, line_ends
from solvers.scuffing.inputs import LeadCurve, Load, LoadDistributionInputs, Modifications, Resolution
from solvers.scuffing.load_balance import line_loads
from solvers.scuffing.model import mesh_of, solve
from tests.support.answers import differences
from tests.support.changes import changed
from tests.support.flanks import draw_flank
from tests.support.properties import seeds

COARSE = Resolution(roll_positions=40, slices=25, profile_points=21, face_points=11, feature_points=11)
DIAGONAL = "^feature_line"  # of the flank; its mirror image is the other one
FACE = r"max_at\.face_fraction$"  # of two places that are loaded alike the first is told
PARTLY_LOADED = 1e-5  # lines loaded in part are cut anew until TE moves by less than 1e-6 of the approach


def draw_load(random: np.random.Generator) -> LoadDistributionInputs:
    """Draw a flank with in-plane deviation, out-of-plane deviation and lead curve."""
    inputs = draw_flank(random)
    width, points = inputs.gears.face_width, int(random.integers(2, 7))
    amplitude = inputs.gears.normal_module * 10 ** random.uniform(-4, -2)
    positions = np.sort(random.uniform(0, width, points)).tolist()
    gaps = (amplitude * random.uniform(-1, 1, points)).tolist()
    return changed(
        inputs,
        {
            "resolution": COARSE,
            "model.contact": str(random.choice(["linear", "hertzian"])),
            "model.section": str(random.choice(["normal", "transverse"])),
            "modifications.in_plane_deviation": amplitude * random.uniform(-1, 1),
            "modifications.out_of_plane_deviation": amplitude * random.uniform(-1, 1),
            "modifications.lead_curve": LeadCurve(tuple(positions), tuple(gaps)),
        },
    )


def face_turned(inputs: LoadDistributionInputs) -> LoadDistributionInputs:
    """Return the inputs with the face counted from its other end."""
    shape, width = inputs.modifications, inputs.gears.face_width
    curve = shape.lead_curve
    turned = replace(
        shape,
        helix_slope=-shape.helix_slope,
        in_plane_deviation=-shape.in_plane_deviation,
        out_of_plane_deviation=-shape.out_of_plane_deviation,
        lead_curve=LeadCurve(tuple(width - y for y in reversed(curve.position)), curve.gap[::-1]),
    )
    return replace(inputs, modifications=turned)


@seeds(40, 1000)
def test_a_spur_pair_counted_from_its_other_end(random: np.random.Generator) -> None:
    inputs = changed(draw_load(random), {"gears.helix_angle": 0.0})

    def expected(name: str, values: FloatArray, _: str | None) -> FloatArray:
        return values[:, ::-1] if name.startswith("flank.") and values.ndim == 2 else values

    one, other = solve(inputs), solve(face_turned(inputs))
    partly = one.load.contact_fraction < 1.0
    tolerance = PARTLY_LOADED if partly else 1e-9
    assert not differences(one, other, expected, without=f"{DIAGONAL}|{FACE}", tolerance=tolerance)
    for place in (other.load.max_at, other.pressure.max_at):
        if place is not None:
            plane = one.path_of_contact.plane
            x, y = place.profile_fraction * plane.path_length, (1.0 - place.face_fraction) * plane.face_width
            image, own = line_loads(one.balance, x, y), line_loads(other.balance, x, plane.face_width - y)
            assert image == pytest.approx(own, rel=10 * tolerance), "the place of the largest, or one as loaded"


@seeds(40, 1000)
def test_a_pair_of_the_other_hand(random: np.random.Generator) -> None:
    """The face is measured from the end that meshes first. The sign of the helix angle therefore has no effect."""
    # With a negative helix angle, there were once no contact lines across the face.
    inputs = draw_load(random)
    image = changed(inputs, {"gears.helix_angle": -inputs.gears.helix_angle})
    assert not differences(solve(inputs), solve(image), tolerance=0.0)


@seeds(40, 1000)
def test_a_line_that_touches_in_a_corner_leads_no_teeth(random: np.random.Generator) -> None:
    """Rounding errors once decided whether a line that only touches a corner counts."""
    # The mean mesh stiffnesses of similar pairs then differed by 0.2 %.
    inputs = draw_load(random)
    mesh = mesh_of(inputs)
    plane, rolls = mesh.mesh.plane, mesh.rolls
    lines = np.add.outer(rolls.phase, plane.base_pitch * np.arange(line_count(plane))).ravel()
    sides = np.repeat(rolls.side, line_count(plane))
    ends = np.array([line_ends(plane, line, side) for line, side in zip(lines, sides, strict=True)])
    lengths = ends[:, 1] - ends[:, 0]
    assert not lengths[lengths > 0.0].min() < 1e-9 * plane.face_width


@seeds(40, 1000)
def test_the_next_pitch_is_like_the_one_before(random: np.random.Generator) -> None:
    balance = solve(draw_load(random)).balance
    if balance.mesh.plane.tan_base_helix > 0.0:  # a spur pair's errors jump there
        for error in (balance.transmission_error, balance.unloaded_error):
            scale = np.abs(balance.transmission_error).max()
            assert error[-1] == pytest.approx(error[0], abs=PARTLY_LOADED * scale)


def test_a_crest_narrower_than_a_slice_carries_a_light_load_alone() -> None:
    """The crest lies between the places where the solver once searched for loaded parts of a line."""
    # The solver then found no solution or a lower crest.
    inputs = changed(draw_flank(np.random.default_rng(0)), {"gears.helix_angle": 0.0, "resolution": COARSE})
    width = inputs.gears.face_width
    middle, half = 12.5 / 25 * width, 0.45 / 25 * width
    crest = LeadCurve((0.2 * width, middle - half, middle, middle + half), (0.0, 3e-6, -1e-6, 3e-6))
    torque = 2e-5 * width * inputs.gears.normal_module * 1e9
    shape = {"modifications": Modifications(lead_curve=crest), "load": Load(torque, 200.0)}
    result = solve(changed(inputs, shape))
    assert result.load.max_at is not None
    assert result.load.max_at.face_fraction == pytest.approx(0.5, abs=0.02)


def test_two_crests_of_a_lead_curve_carry_whatever_the_number_of_slices() -> None:
    """The slices once lay beside one of the crests."""
    # There was then no balance, or the other crest carried 50 % more load.
    inputs = changed(draw_load(np.random.default_rng([38, 72])), {"gears.helix_angle": 0.0})
    loads = [
        solve(changed(inputs, {"resolution.slices": slices})).load.max_line_load for slices in (15, 25, 31, 51, 201)
    ]
    assert loads == pytest.approx([loads[-1]] * len(loads), rel=0.05)
