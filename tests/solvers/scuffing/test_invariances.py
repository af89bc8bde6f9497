"""Random valid pairs obey the laws of load balance, contact lengths, scaling, reversal and minimum energy."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume
from hypothesis import strategies as st

from solvers.errors import InvalidInput
from solvers.gears.inputs import GearPairInputs
from solvers.gears.pair import PathOfContact, gear_pair, path_of_contact
from solvers.scuffing.contact_lines import contact_lengths, roll_positions, total_lengths
from solvers.scuffing.inputs import Load, LoadDistributionInputs, Model
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.modification import gap, gaps_at
from solvers.scuffing.results import LoadDistribution
from tests.support.changes import scaled
from tests.support.properties import examples
from tests.support.random_pairs import AMPLITUDES, COARSE, MODELS, designs, gears

FEW, MANY = 40, 200


def path_of(inputs: GearPairInputs) -> PathOfContact:
    try:
        path = path_of_contact(gear_pair(inputs))
        contact_lengths(path)
    except InvalidInput:
        assume(False)
    return path


def solve(inputs: LoadDistributionInputs) -> LoadDistribution:
    path_of(inputs.gears)
    return solve_load_distribution(inputs)


@examples(FEW, MANY, designs())
def test_the_load_is_balanced(inputs: LoadDistributionInputs) -> None:
    result = solve(inputs)
    assert result.load.balance_error < 1e-12
    assert result.load.pair_share.sum(axis=0) == pytest.approx(1.0, rel=1e-12)
    assert np.all(result.flank.line_load >= 0)
    assert np.all(result.flank.line_load <= result.load.max_line_load * 1.2)
    assert 0 < result.load.contact_fraction <= 1 + 1e-12


@examples(FEW, MANY, gears())
def test_contact_lengths_agree_with_their_closed_forms(inputs: GearPairInputs) -> None:
    path = path_of(inputs)
    lengths, rolls = contact_lengths(path), roll_positions(path.plane, 40)
    found = total_lengths(path.plane, rolls)
    scale = lengths.maximum
    assert found.min() == pytest.approx(lengths.minimum, abs=1e-9 * scale)
    assert found.max() == pytest.approx(lengths.maximum, abs=1e-9 * scale)
    # Linear between its breakpoints, so the trapezia are exact.
    assert np.trapezoid(found, rolls.phase) / rolls.phase[-1] == pytest.approx(lengths.mean, abs=1e-8 * scale)


@examples(FEW, MANY, designs(), st.floats(0.1, 10.0))
def test_gears_of_another_size_under_the_same_stress_deform_alike(inputs: LoadDistributionInputs, size: float) -> None:
    lengths = ("gears.module", "gears.face_width", *(f"modifications.{name}" for name in AMPLITUDES))
    similar = scaled(scaled(inputs, size, *lengths), size**3, "load.pinion_torque")
    one, other = solve(inputs), solve(similar)
    # A roll position more or less in an interval is a matter of rounding; the shared ones are what is compared.
    assume(one.transmission_error.curves.error.size == other.transmission_error.curves.error.size)
    assert other.transmission_error.curves.error == pytest.approx(one.transmission_error.curves.error * size, rel=1e-8)
    assert other.load.max_line_load == pytest.approx(one.load.max_line_load * size, rel=1e-7)
    if one.pressure.max is None:
        assert other.pressure.max is None
    else:
        assert other.pressure.max == pytest.approx(one.pressure.max, rel=1e-7)
    if one.friction_loss.loss_factor is not None:
        assert other.friction_loss.loss_factor == pytest.approx(one.friction_loss.loss_factor, rel=1e-7)


@examples(FEW, MANY, designs())
def test_exchanging_driver_and_driven_mirrors_everything(inputs: LoadDistributionInputs) -> None:
    gears, shape = inputs.gears, inputs.modifications
    ratio = gears.wheel.teeth / gears.pinion.teeth
    reversed_drive = replace(
        inputs,
        gears=replace(gears, pinion=gears.wheel, wheel=gears.pinion),
        load=Load(inputs.load.pinion_torque * ratio, inputs.load.pinion_speed / ratio),
        modifications=replace(
            shape,
            tip_relief=shape.root_relief,
            root_relief=shape.tip_relief,
            profile_slope=-shape.profile_slope,
            helix_slope=-shape.helix_slope,
        ),
    )
    one, other = solve(inputs), solve(reversed_drive)
    assume(one.transmission_error.curves.error.size == other.transmission_error.curves.error.size)
    scale = max(one.load.max_line_load, 1.0)
    error = one.transmission_error
    assert other.transmission_error.min == pytest.approx(error.min, rel=1e-7, abs=1e-7 * abs(error.max))
    assert other.transmission_error.max == pytest.approx(error.max, rel=1e-7)
    assert other.transmission_error.mean == pytest.approx(error.mean, rel=1e-7, abs=1e-7 * abs(error.max))
    assert other.load.max_line_load == pytest.approx(one.load.max_line_load, rel=1e-6)
    assert other.friction_loss.power == pytest.approx(one.friction_loss.power, rel=1e-6)
    inner = slice(1, -1)  # a spur gear's jump may meet the map's first or last row from the other side
    mirrored = other.flank.line_load[::-1, ::-1]
    assert mirrored[inner] == pytest.approx(one.flank.line_load[inner], abs=1e-6 * scale)


@examples(FEW, MANY, gears(), st.floats(1.0, 1e4), MODELS)
def test_unmodified_teeth_share_as_minimum_elastic_energy_does(
    inputs: GearPairInputs, torque: float, model: Model
) -> None:
    """By Pedrero, minimum elastic energy gives the line load F v/int v dl at a point with the stiffness v."""
    # The load balance gives the same line load: v times the transmission error.
    linear = replace(model, contact="linear")
    result = solve(LoadDistributionInputs(inputs, Load(torque, 100.0), model=linear, resolution=COARSE))
    plane, table = result.path_of_contact.plane, result.balance.mesh.compliance.constant
    phase = result.balance.rolls.phase[2]  # inside the first interval: no line begins or ends here
    slices = []
    for j in range(40):
        line = phase + j * plane.base_pitch
        low, high = 0.0, plane.face_width if line <= plane.path_length else 0.0
        if plane.tan_base_helix > 0:
            low = max(0.0, (line - plane.path_length) / plane.tan_base_helix)
            high = min(plane.face_width, line / plane.tan_base_helix)
        if high > low:
            y = low + (np.arange(COARSE.slices) + 0.5) * (high - low) / COARSE.slices
            x = np.linspace(0, plane.path_length, table.size)
            v = 1 / np.interp(line - y * plane.tan_base_helix, x, table)
            slices.append((v, np.full_like(v, (high - low) / COARSE.slices / plane.cos_base_helix)))
    v, length = (np.concatenate(part) for part in zip(*slices, strict=True))
    pedrero = result.load.normal_force * v / np.sum(v * length)
    assert v * result.transmission_error.curves.error[2] == pytest.approx(pedrero, rel=1e-11)


@examples(FEW, MANY, designs())
def test_more_torque_presses_every_point_harder(inputs: LoadDistributionInputs) -> None:
    one, other = solve(inputs), solve(scaled(inputs, 1.5, "load.pinion_torque"))
    slack = 1e-9 * other.load.max_line_load
    pressed, less = other.transmission_error.curves, one.transmission_error.curves
    common = np.intersect1d(pressed.roll_position, less.roll_position)  # a bent curve has more roll positions
    errors = [curve.error[np.searchsorted(curve.roll_position, common)] for curve in (pressed, less)]
    assert np.all(errors[0] > errors[1])
    assert np.all(other.flank.line_load >= one.flank.line_load - slack)
    assert other.load.contact_fraction >= one.load.contact_fraction - 1e-12


@examples(FEW, MANY, designs())
def test_the_gap_is_linear_in_its_amplitudes(inputs: LoadDistributionInputs) -> None:
    path = path_of(inputs.gears)
    x, y = np.meshgrid(np.linspace(0, path.length, 7), np.linspace(0, inputs.gears.face_width, 5))
    single = gaps_at(gap(inputs.modifications, path), x, y)
    double = scaled(inputs, 2.0, *(f"modifications.{name}" for name in AMPLITUDES)).modifications
    assert gaps_at(gap(double, path), x, y) == pytest.approx(2 * single, rel=1e-12, abs=1e-18)


@examples(FEW, MANY, designs(), st.floats(0.5, 2.0))
def test_line_loads_scale_with_elasticity_as_they_do_with_torque(inputs: LoadDistributionInputs, factor: float) -> None:
    """If Young's moduli and the torque are multiplied by the same factor, all deflections stay the same."""
    moduli = ("pinion_material.youngs_modulus", "wheel_material.youngs_modulus")
    one, other = solve(inputs), solve(scaled(inputs, factor, *moduli, "load.pinion_torque"))
    assert other.transmission_error.curves.error == pytest.approx(one.transmission_error.curves.error, rel=1e-9)
    small = 1e-9 * other.load.max_line_load
    assert other.flank.line_load == pytest.approx(one.flank.line_load * factor, rel=1e-7, abs=small)
