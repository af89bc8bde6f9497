"""Integral temperature method of ISO/TS 6336-21 (ISO/TR 13989-2)."""

from math import cos, sin, sqrt, tan
from typing import NamedTuple

from solvers.scuffing.inputs import ScuffingTest
from solvers.scuffing.load_factors.method_b import MM, STIFFNESS, UM, nominal_line_load, stiffness_of
from solvers.scuffing.micropitting.mean_values import helical_load_factor
from solvers.scuffing.standard.mesh import StandardMesh
from solvers.scuffing.standard.results import IntegralMethod
from solvers.scuffing.thermal.practice import FASTEST_PITCH_LINE, LEAST_LINE_LOAD, OIL_KIND_FACTOR

BULK_SHARE = 0.7  # C_1
INTEGRAL_SHARE = 1.5  # C_2
RELIEVED_GRADE = 6  # tip relief counts for this grade and finer ones
LARGEST_CONTACT_RATIO = 3.0  # the contact ratio factor has no formula beyond
TEST_TORQUE = (3.3, 13.7, 35.3, 60.8, 94.1, 135.3, 183.4, 239.3, 302.0, 372.6, 450.1, 534.5)
"""Pinion torque of the load stages 1 to 12 of the FZG test A/8.3/90 [N m] (ISO 14635-1)."""


class AddendumContact(NamedTuple):
    """The pair by gears: gear 1 has fewer teeth, whichever drives."""

    pinion: float  # addendum contact ratio eps_1
    wheel: float  # addendum contact ratio eps_2
    pinion_drives: bool
    tip: float  # distance of the tip of gear 1 from A, m
    pinion_relief: float  # tip relief C_a1, um
    wheel_relief: float  # tip relief C_a2, um

    @property
    def approach(self) -> float:
        """Addendum contact ratio of the driven gear."""
        return self.wheel if self.pinion_drives else self.pinion

    @property
    def recess(self) -> float:
        """Addendum contact ratio of the driving gear."""
        return self.pinion if self.pinion_drives else self.wheel


def addendum_contact(mesh: StandardMesh) -> AddendumContact:
    """Return the pair by gears; the standard counts the gear with fewer teeth as the pinion."""
    path, changes = mesh.path, mesh.given.modifications
    pair, pitch = path.pair, path.plane.base_pitch
    approach, recess = (path.pitch_point - path.start) / pitch, (path.end - path.pitch_point) / pitch
    tip_relief, root_relief = changes.tip_relief / UM, changes.root_relief / UM
    if pair.pinion.teeth <= pair.wheel.teeth:
        return AddendumContact(
            recess, approach, pinion_drives=True, tip=path.length, pinion_relief=tip_relief, wheel_relief=root_relief
        )
    return AddendumContact(
        approach, recess, pinion_drives=False, tip=0.0, pinion_relief=root_relief, wheel_relief=tip_relief
    )


def solve_integral(mesh: StandardMesh, test: ScuffingTest | None) -> IntegralMethod | None:
    """Integral temperature method; None if C is not on the path, above eps_alpha = 3, and next to a base circle."""
    ends, path = addendum_contact(mesh), mesh.path
    edge = mesh.reduced_radius(ends.tip) * MM
    beyond = path.transverse_contact_ratio >= LARGEST_CONTACT_RATIO
    if min(ends.pinion, ends.wheel) <= 0.0 or beyond or edge < path.plane.least_radius:
        return None
    helical = helical_load_factor(path.total_contact_ratio)
    roughness = 2.2 * (mesh.roughness / mesh.pitch_radius) ** 0.25
    oil_factor = OIL_KIND_FACTOR[mesh.oil.kind]
    friction = mean_friction(mesh, helical, roughness * oil_factor)
    running_in = 1.0 + (1.0 - mesh.asked.running_in) * 30.0 * mesh.roughness / mesh.pitch_radius
    optimal = optimal_relief(mesh)
    relief = relief_factor(mesh, ends, optimal)
    approach = approach_factor(ends)
    geometry, angle, elastic = (
        geometry_factor(mesh, ends),
        angle_factor(mesh),
        float(mesh.thermo_elastic_factor(ends.tip)),
    )
    load = (helical * mesh.line_load) ** 0.75 * sqrt(mesh.velocity) / mesh.centre_distance**0.25
    tip_flash = friction * elastic * geometry * angle * load * running_in / (approach * relief)
    contact_ratio = contact_ratio_factor(ends.pinion, ends.wheel)
    flash = tip_flash * contact_ratio
    oil = mesh.temperatures.oil
    bulk = oil + BULK_SHARE * mesh.supply_factor * flash
    integral = bulk + INTEGRAL_SHARE * flash
    limits = None if test is None else scuffing_integral(mesh, test, oil_factor)
    limit = None if limits is None else limits.scuffing
    return IntegralMethod(
        friction_coefficient=friction,
        lubricant_factor=oil_factor,
        roughness_factor=roughness,
        helical_factor=helical,
        running_in_factor=running_in,
        thermo_elastic_factor=elastic,
        approach_factor=approach,
        geometry_factor=geometry,
        angle_factor=angle,
        contact_ratio_factor=contact_ratio,
        tip_relief_factor=relief,
        optimal_relief=optimal * UM,
        tip_flash=tip_flash,
        mean_flash=flash,
        bulk=bulk,
        integral=integral,
        test_bulk=None if limits is None else limits.bulk,
        test_flash=None if limits is None else limits.flash,
        scuffing=limit,
        safety=None if limit is None else (limit - 273.15) / (integral - 273.15),
        load_safety=None if limit is None or integral <= oil else (limit - oil) / (integral - oil),
    )


def mean_friction(mesh: StandardMesh, helical: float, factors: float) -> float:
    """Mean coefficient of friction (Eq. T10); `factors` is X_R X_L.

    0.045 [w_Bt K_Bgamma/(v_SigmaC rho_redC)]^0.2 eta_oil^-0.05 X_R X_L, v_SigmaC = 2 v tan alpha_wt cos alpha_t.
    """
    pair = mesh.path.pair
    velocity = min(mesh.velocity, FASTEST_PITCH_LINE)
    # Printed numbers need v at the working pitch circle here too: 158.1 C; at the reference circle it is 157.5 C.
    speeds = 2 * velocity * tan(pair.working_pressure_angle) * cos(pair.transverse_pressure_angle)
    load = max(mesh.line_load, LEAST_LINE_LOAD) * helical
    return float(0.045 * (load / (speeds * mesh.pitch_radius)) ** 0.2 * mesh.oil.viscosity**-0.05 * factors)


def angle_factor(mesh: StandardMesh) -> float:
    """Pressure angle factor X_alphabeta [-] (Eq. T11)."""
    pair = mesh.path.pair
    working, normal, helix = pair.working_pressure_angle, pair.inputs.normal_pressure_angle, pair.inputs.helix_angle
    turned = (sin(working) * cos(normal) * cos(helix)) ** 0.25
    return float(1.22 * turned / sqrt(cos(working) * cos(pair.transverse_pressure_angle)))


def geometry_factor(mesh: StandardMesh, ends: AddendumContact) -> float:
    """Geometry factor X_BE at the pinion's tip [-] (Eq. T12).

    0.51 sqrt(u + 1) |sqrt rho_E1 - sqrt(rho_E2/u)|/(rho_E1 rho_E2)^0.25.
    """
    radii = [float(each) for each in mesh.radii(ends.tip)]
    first, second = radii if ends.pinion_drives else radii[::-1]
    teeth = mesh.path.pair.pinion.teeth, mesh.path.pair.wheel.teeth
    ratio = max(teeth) / min(teeth)
    return 0.51 * sqrt(ratio + 1) * abs(sqrt(first) - sqrt(second / ratio)) / sqrt(sqrt(first * second))


def approach_factor(ends: AddendumContact) -> float:
    """Approach factor X_Q [-] (Eq. T13): 1 up to eps_f/eps_a = 1.5, 0.6 from 3, linear between."""
    return 1.4 - 4.0 / 15.0 * min(max(ends.approach / ends.recess, 1.5), 3.0)


def optimal_relief(mesh: StandardMesh) -> float:
    """Optimal tip relief C_eff = K_A K_gamma F_t/(b c) [um] (Eq. T14); c is c' of spur, c_gamma of helical gears."""
    stiffness = stiffness_of(mesh.given, mesh.path)
    spring = stiffness.mesh if mesh.path.plane.tan_base_helix else stiffness.single
    return nominal_line_load(mesh.given, mesh.path) / (spring / STIFFNESS)


def relief_factor(mesh: StandardMesh, ends: AddendumContact, optimal: float) -> float:
    """Tip relief factor X_Ca [-] (Eq. T15); 1 for flanks coarser than grade 6.

    1 + (0.06 + 0.18 C_a/C_eff) eps + (0.02 + 0.69 C_a/C_eff) eps^2, eps the larger addendum contact ratio.
    """
    if mesh.grade > RELIEVED_GRADE or optimal <= 0.0:
        return 1.0
    longer = ends.pinion > (1.5 if ends.pinion_drives else 2.0 / 3.0) * ends.wheel
    part = min((ends.pinion_relief if longer else ends.wheel_relief) / optimal, 1.0)
    ratio = max(ends.pinion, ends.wheel)
    return 1.0 + (0.06 + 0.18 * part) * ratio + (0.02 + 0.69 * part) * ratio**2


def contact_ratio_factor(pinion: float, wheel: float) -> float:
    """Contact ratio factor X_eps of the addendum contact ratios eps_1, eps_2 > 0, sum below 3 [-] (Eq. T16)."""
    total, squares = pinion + wheel, (pinion**2, wheel**2)
    if total < 1.0:
        value = sum(squares)
    elif total < 2.0 and max(pinion, wheel) < 1.0:
        value = 0.70 * sum(squares) - 0.22 * total + 0.52 - 0.60 * pinion * wheel
    else:
        longer, shorter = max(pinion, wheel), min(pinion, wheel)
        if total < 2.0:
            value = 0.18 * longer**2 + 0.70 * shorter**2 + 0.82 * longer - 0.52 * shorter - 0.30 * pinion * wheel
        else:
            value = 0.44 * longer**2 + 0.59 * shorter**2 + 0.30 * longer - 0.30 * shorter - 0.15 * pinion * wheel
    return value / (2.0 * total * pinion)


class StageTemperatures(NamedTuple):
    """Temperatures in the scuffing test of the oil [K]."""

    bulk: float
    flash: float
    scuffing: float


def scuffing_integral(mesh: StandardMesh, test: ScuffingTest, oil_factor: float) -> StageTemperatures:
    """Scuffing integral temperature theta_MT + 1.5 X_W theta_flaintT [K] (Eq. T17).

    theta_MT = 80 + 0.23 T_1T X_L, theta_flaintT = 0.2 T_1T (100/nu_40)^0.02 X_L; beyond stage 12 T_1T is 3.726 S^2.
    """
    stage, thick = test.fzg_stage, mesh.oil.kinematic_viscosity_40
    torque = TEST_TORQUE[stage - 1] if stage <= len(TEST_TORQUE) else 3.726 * stage**2
    bulk = 80.0 + 0.23 * torque * oil_factor + 273.15
    flash = 0.2 * torque * oil_factor * (1.0 if thick is None else (100.0 / thick) ** 0.02)
    return StageTemperatures(bulk, flash, bulk + INTEGRAL_SHARE * test.structure_factor * flash)
