"""Load distribution and transmission error agree with published examples, with measurements and with theory."""

from dataclasses import replace
from functools import cache
from math import cos, pi, radians, sin

import numpy as np
import pytest
from scipy.optimize import brentq

from benchmarks.published.standard_gears import EXAMPLE_1, example_stress, fzg_pressure
from benchmarks.published.xue import PAPER_LOAD, paper_pair
from solvers.contact import hertz
from solvers.errors import InvalidInput
from solvers.gears.inputs import GROUND_FILLET, GearPairInputs, GearTeeth
from solvers.gears.pair import gear_pair, path_of_contact
from solvers.materials import Solid
from solvers.scuffing.inputs import Load, LoadDistributionInputs, Model, Modifications, Resolution, angular_speed
from solvers.scuffing.load_balance import line_loads
from solvers.scuffing.mesh_results import standard_stiffness
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.tooth_stiffness import linear_contact_compliance
from tests.support.changes import scaled
from tests.support.gear_pairs import FZG_A, FZG_TORQUES

STEEL = Solid()
MODULUS = hertz.reduced_modulus(STEEL, STEEL)
UNIFORM = Model(tooth_stiffness="parabola", parabola_end_ratio=1.0, contact="linear")

# all stages but 6 and 12, which are statements of benchmarks/published
PITCH_PRESSURES = (144.8, 295.0, 473.2, 621.2, 773.2, 1079.3, 1232.9, 1385.1, 1538.5, 1691.0)


@pytest.mark.parametrize(
    ("torque", "pressure"), list(zip(FZG_TORQUES[:5] + FZG_TORQUES[6:11], PITCH_PRESSURES, strict=True))
)
def test_fzg_type_a_load_stages(torque: float, pressure: float) -> None:
    """A load stage is defined by the Hertzian pressure at the pitch point if one pair of teeth carries all the load."""
    assert fzg_pressure(torque) == pytest.approx(pressure, rel=3e-3)


def test_fzg_type_a_pitch_point_lies_in_double_contact() -> None:
    """At the pitch point C, two pairs of teeth share the load, because the path of contact begins just ahead of C."""
    # The pressure in the mesh is therefore lower than the nominal pressure of the load stage.
    result = solve_load_distribution(LoadDistributionInputs(FZG_A, Load(302.0, angular_speed(2250))))
    path = result.path_of_contact
    pitch_x = path.pitch_point - path.start
    assert pitch_x < path.length - path.plane.base_pitch
    share = line_loads(result.balance, np.array([pitch_x]), np.array([10e-3]))[0] * 20e-3 / result.load.normal_force
    assert 0.4 < share < 0.5
    alone = np.array([path.plane.base_pitch - 0.1e-3])
    carried = line_loads(result.balance, alone, np.array([10e-3]))[0] * 20e-3
    assert carried == pytest.approx(result.load.normal_force, rel=3e-5)  # TE is interpolated between roll positions


# ISO/TR 6336-30:2017, example 1, values as quoted in the comments of github.com/gfsReboucas/Drivetrain


def test_iso_tr_6336_30_example_1() -> None:
    """Tangential force, stiffness and contact stress agree with the example."""
    # The contact stress sigma_H0 / Z_beta is the Hertzian pressure at C under the line load F_bt / (b eps_alpha).
    path = path_of_contact(gear_pair(EXAMPLE_1))
    assert 9000 / path.pair.pinion.reference_radius == pytest.approx(127352, abs=0.5)
    stiffness = standard_stiffness(path)
    assert stiffness.single * 1e-9 == pytest.approx(12.37047, abs=6e-6)
    # The standard rounds the contact ratio: 17.46485 and 14.84512 there.
    assert stiffness.mesh * 1e-9 == pytest.approx(17.46719, abs=6e-6)
    assert stiffness.mesh * 1e-9 == pytest.approx(17.46485, rel=2e-4)
    assert stiffness.mesh_bending * 1e-9 == pytest.approx(14.84512, rel=2e-4)
    assert example_stress() == pytest.approx(1183.47, abs=0.06)


FZG_C = GearPairInputs(
    GearTeeth(16, 0.1817), GearTeeth(24, 0.1715), 4.5e-3, 14e-3, centre_distance=91.5e-3, rack_tip_radius=GROUND_FILLET
)


def test_standard_stiffness_is_that_of_the_pair_whichever_drives() -> None:
    """The stiffness does not depend on which gear drives."""
    # Gear 1 of the formula is the gear with fewer teeth. If the numbers of teeth are equal, gear 1 is the gear with the
    # larger profile shift.
    for pair in (EXAMPLE_1, FZG_C, replace(FZG_C, wheel=replace(FZG_C.wheel, teeth=16), centre_distance=None)):
        turned = replace(pair, pinion=pair.wheel, wheel=pair.pinion)
        one, other = (standard_stiffness(path_of_contact(gear_pair(each))) for each in (pair, turned))
        assert other.theoretical == one.theoretical
        assert other.mesh == pytest.approx(one.mesh, rel=1e-12)


def test_standard_stiffness_goes_with_the_modulus_of_both_bodies() -> None:
    """The stiffness is proportional to E = 2 E1 E2/(E1 + E2)."""
    # For steel on bronze of 105 GPa, E is 139.1 GPa, which is 0.675 of the value for steel on steel.
    steel, bronze = Solid(), Solid(youngs_modulus=105e9)
    both, mixed = (
        solve_load_distribution(LoadDistributionInputs(FZG_A, Load(302.0, 200.0), wheel_material=wheel)).stiffness
        for wheel in (steel, bronze)
    )
    ratio = 2 * 105 / (206 + 105)
    assert mixed.standard_single / both.standard_single == pytest.approx(ratio, rel=1e-12)
    assert mixed.standard_mesh / both.standard_mesh == pytest.approx(ratio, rel=1e-12)


def straight_mismatch(torque_factor: float) -> float:
    """Return K_H_beta of a spur pair with uniform stiffness and the mismatch of the standard's example.

    `torque_factor` multiplies the torque of the example.
    """
    gears = replace(EXAMPLE_1, helix_angle=0.0, centre_distance=None)
    path = path_of_contact(gear_pair(gears))
    inputs = LoadDistributionInputs(gears, Load(1.0, 100.0), model=UNIFORM)
    mesh = solve_load_distribution(inputs).stiffness.max * path.transverse_contact_ratio
    slope = 27.5e-6 * 14.845e9 / mesh
    torque = 1277.3e3 * 0.1 * path.pair.pinion.base_radius * torque_factor
    tilted = replace(inputs, load=Load(torque, 100.0), modifications=Modifications(helix_slope=slope))
    return solve_load_distribution(tilted).load.face_load_factor or 0.0


def test_iso_face_load_factor_of_a_straight_mismatch() -> None:
    """K_H_beta is 1 + F c_gamma b / (2 F_m) with F = 27.5 um, c_gamma = 14.845 N/(mm um) and F_m/b = 1277.3 N/mm."""
    # The difference K_H_beta - 1 is inversely proportional to the torque.
    # The flank map of 200 steps smears the two jumps of a spur gear's load over one step each.
    assert straight_mismatch(1.0) == pytest.approx(1 + 27.5 * 14.845 / (2 * 1277.3), abs=2e-4)
    assert straight_mismatch(1.0) == pytest.approx(1.160, abs=5e-4)
    assert straight_mismatch(2.0) - 1 == pytest.approx((straight_mismatch(1.0) - 1) / 2, rel=1e-9)
    # Lift-off begins at 2 for one pair; where two share, their half of the load lifts off sooner.
    assert straight_mismatch(0.05) > 2


# Other implementations


def test_din_3990_example_geometry() -> None:
    """The geometry agrees with the tests of github.com/hanslhansl/din3990."""
    # The gears have 19/104 teeth, a module of 4 mm and profile shifts of 0.5/0.15.
    gears = GearPairInputs(GearTeeth(19, 0.5), GearTeeth(104, 0.15), 4e-3, 48.64e-3, rack_tip_radius=GROUND_FILLET)
    path = path_of_contact(gear_pair(gears))
    assert path.pair.centre_distance * 1e3 == pytest.approx(248.506843355171, rel=1e-12)
    assert np.degrees(path.pair.working_pressure_angle) == pytest.approx(21.531902292465457, rel=1e-11)
    assert path.transverse_contact_ratio == pytest.approx(1.5363235945832296, rel=1e-11)


def test_ross_contact_ratio_and_hertz_stiffness() -> None:
    """Contact ratio and Hertzian stiffness agree with the tests of github.com/petrobras/ross."""
    # The gears have 62/62 teeth, a module of 2 mm and a width of 20 mm; k_H = pi E b/[4 (1 - nu^2)] = 3.5558686e9 N/m.
    path = path_of_contact(
        gear_pair(GearPairInputs(GearTeeth(62), GearTeeth(62), 2e-3, 20e-3, rack_tip_radius=GROUND_FILLET))
    )
    assert path.transverse_contact_ratio == pytest.approx(1.7897798668330458, rel=1e-11)
    assert 20e-3 / linear_contact_compliance(STEEL, STEEL) == pytest.approx(3555868607.9093266, rel=1e-3)


GEARPIE = {
    "C14": GearPairInputs(GearTeeth(16, 0.1817), GearTeeth(24, 0.1715), 4.5e-3, 14e-3, rack_tip_radius=0.38),
    "H501": GearPairInputs(
        GearTeeth(20, 0.1809), GearTeeth(30, 0.0891), 3.5e-3, 23e-3, helix_angle=radians(15), rack_tip_radius=0.38
    ),
    "H701": GearPairInputs(
        GearTeeth(28, 0.2290), GearTeeth(42, 0.1489), 2.5e-3, 17e-3, helix_angle=radians(15), rack_tip_radius=0.38
    ),
}


@pytest.mark.parametrize(("name", "published"), [("C14", 0.1986), ("H501", 0.1890), ("H701", 0.1425)])
def test_gearpie_loss_factor_of_rigid_teeth(name: str, published: float) -> None:
    """The loss factors agree with github.com/cfernandesFEUP/GEARpie."""
    # GEARpie shares the load in proportion to the contact length, as a uniform stiffness does.
    result = solve_load_distribution(LoadDistributionInputs(GEARPIE[name], PAPER_LOAD, model=UNIFORM))
    assert result.friction_loss.loss_factor == pytest.approx(published, abs=6e-5)


def test_gearpie_loss_factor_of_the_spur_pair_is_ohlendorfs() -> None:
    """The loss factor is Ohlendorf's H_V = pi (u + 1)/(z_1 u) (1 - eps_alpha + eps_1^2 + eps_2^2)."""
    # The formula is exact if the pairs of teeth share the load equally.
    result = solve_load_distribution(LoadDistributionInputs(GEARPIE["C14"], PAPER_LOAD, model=UNIFORM))
    path = result.path_of_contact
    pitch = path.plane.base_pitch
    recess, approach = (path.end - path.pitch_point) / pitch, (path.pitch_point - path.start) / pitch
    ohlendorf = pi * (1.5 + 1) / (16 * 1.5) * (1 - path.transverse_contact_ratio + recess**2 + approach**2)
    # What is left is one trapezium over the kink at the pitch point.
    assert result.friction_loss.loss_factor == pytest.approx(ohlendorf, rel=5e-5)


def test_gearpie_single_stiffness_of_the_spur_pair() -> None:
    """With linear contact, the stiffness of C14 is within 6 % of GEARpie's 15.60 N/(mm um)."""
    # GEARpie has another tooth model. Without the Hertzian contact, it gives 16.35 N/(mm um).
    stiff = solve_load_distribution(LoadDistributionInputs(GEARPIE["C14"], PAPER_LOAD, model=Model(contact="linear")))
    soft = solve_load_distribution(LoadDistributionInputs(GEARPIE["C14"], PAPER_LOAD))
    assert stiff.stiffness.max * 1e-9 == pytest.approx(15.60, rel=0.06)
    assert soft.stiffness.max < stiff.stiffness.max


def test_gearpie_h951_has_no_tip_clearance() -> None:
    """Without tip shortening, the profile shifts 1.6915/2.0003 leave a tip clearance of -0.58 mm."""
    # The gears have the backlash-free centre distance.
    teeth = GearTeeth(38, 1.6915), GearTeeth(57, 2.0003)
    gears = GearPairInputs(*teeth, 1.75e-3, 21.2418e-3, helix_angle=radians(15), rack_tip_radius=0.38)
    with pytest.raises(InvalidInput, match=r"0\.58") as refusal:
        solve_load_distribution(LoadDistributionInputs(gears, PAPER_LOAD))
    assert refusal.value.code == "no_tip_clearance"


# Directions of the transmission error


@cache
def variation(overlap: float) -> float:
    """Return the peak-to-peak transmission error of pair 1, divided by the mean transmission error."""
    # The stiffness is uniform. The face width is chosen for the given overlap ratio.
    wider = overlap * pi * 3e-3 / sin(radians(9.8)) / 20e-3
    inputs = scaled(paper_pair(1, model=UNIFORM), wider, "load.pinion_torque", "gears.face_width")
    result = solve_load_distribution(replace(inputs, resolution=Resolution(profile_points=11, face_points=11)))
    return result.transmission_error.peak_to_peak / result.transmission_error.mean


@pytest.mark.parametrize("overlap", [1.0, 2.0])
def test_transmission_error_is_constant_for_an_integer_overlap_ratio(overlap: float) -> None:
    assert variation(overlap) < 1e-9


def test_transmission_error_is_constant_for_an_integer_transverse_contact_ratio() -> None:
    inputs = paper_pair(1, model=UNIFORM)

    def taller(addendum: float) -> GearPairInputs:
        teeth = {"addendum": addendum, "dedendum": addendum + 0.25}
        return replace(inputs.gears, pinion=GearTeeth(23, **teeth), wheel=GearTeeth(30, **teeth), rack_tip_radius=0.2)

    def excess(addendum: float) -> float:
        return path_of_contact(gear_pair(taller(addendum))).transverse_contact_ratio - 2

    addendum = brentq(excess, 1.0, 1.5, xtol=1e-15)
    error = solve_load_distribution(replace(inputs, gears=taller(addendum))).transmission_error
    assert error.peak_to_peak / error.mean < 1e-9


def test_transmission_error_peaks_near_overlap_ratios_of_one_half_and_three_halves() -> None:
    for peak, lower, upper in ((0.5, 0.05, 0.95), (1.5, 1.05, 1.95)):
        scan = np.linspace(lower, upper, 37)
        values = [variation(float(overlap)) for overlap in scan]
        # Between the fractions f_alpha = 0.59 and 1 - f_alpha the spread of the length has a plateau around the peak.
        assert scan[int(np.argmax(values))] == pytest.approx(peak, abs=0.11)
    assert variation(1.5) < 0.5 * variation(0.5)


def test_normal_force_is_larger_than_the_tangential_by_the_base_helix() -> None:
    load = solve_load_distribution(paper_pair(3)).load
    base_helix = np.arcsin(np.sin(radians(20.2)) * np.cos(radians(20)))
    assert load.normal_force * cos(base_helix) == pytest.approx(load.tangential_force, rel=1e-12)
