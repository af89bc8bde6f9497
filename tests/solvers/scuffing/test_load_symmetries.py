"""Mirror images of random pairs under load: every number of the load distribution, not those that one thinks of."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from solvers.arrays import FloatArray
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.scuffing.inputs import LeadCurve, Load, LoadDistributionInputs, Model, Modifications, Resolution
from solvers.scuffing.model import solve
from tests.support.answers import differences
from tests.support.changes import changed
from tests.support.flanks import draw_flank
from tests.support.properties import seeds

COARSE = Resolution(roll_positions=40, slices=25, profile_points=21, face_points=11, feature_points=11)
DIAGONAL = "^feature_line"  # of the flank; its mirror image is the other one
PARTLY_LOADED = 1e-5  # lines loaded in part are cut anew until TE moves by less than 1e-6 of the approach


def draw_load(random: np.random.Generator) -> LoadDistributionInputs:
    """A flank with every error that its face can have."""
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
    """The flank counted from the other end of the face."""
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
        if name in {"load.max_at.face_fraction", "pressure.max_at.face_fraction"}:
            return 1.0 - values
        return values[:, ::-1] if name.startswith("flank.") and values.ndim == 2 else values

    one, other = solve(inputs), solve(face_turned(inputs))
    partly = one.load.contact_fraction < 1.0
    assert not differences(one, other, expected, without=DIAGONAL, tolerance=PARTLY_LOADED if partly else 1e-9)


@seeds(40, 1000)
def test_a_pair_of_the_other_hand(random: np.random.Generator) -> None:
    """The face is counted from the end that meshes first, so a mirror changes nothing; a negative helix had no lines."""
    inputs = draw_load(random)
    image = changed(inputs, {"gears.helix_angle": -inputs.gears.helix_angle})
    assert not differences(solve(inputs), solve(image), tolerance=0.0)


@pytest.mark.parametrize("size", [0.65, 0.6534103004529722, 1.0, 1.3])
def test_a_line_that_touches_in_a_corner_leads_no_teeth(size: float) -> None:
    """Rounding decided whether it counts in the mean mesh stiffness: 1.3245 or 1.3224e10 Pa by the size of the pair."""
    gears = GearPairInputs(GearTeeth(23), GearTeeth(61), 2e-3 * size, 60e-3 * size, helix_angle=0.55)
    shape = Modifications(helix_slope=-0.1e-6 * size)
    inputs = LoadDistributionInputs(gears, Load(8.5 * size**3, 200.0), shape, model=Model(contact="linear"))
    assert unloaded(inputs) == pytest.approx(unloaded(changed_size(inputs, 1 / size)), rel=1e-9)
