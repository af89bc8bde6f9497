"""Results for the mesh from the balanced load: load sharing, stiffness, transmission error, friction loss.

Eq. 15 is an equation of the paper. The formulas for the load sharing X_Gamma and the buttressing factor X_but are
general knowledge about ISO/TS 6336-20. They were not compared with the text of this standard.
"""

from dataclasses import dataclass
from math import cos, degrees

import numpy as np
from numpy.typing import NDArray

from solvers.arrays import FloatArray, frozen, without_rounding
from solvers.gears.pair import GearPair, PathOfContact
from solvers.scuffing.inputs import Load, LoadDistributionInputs
from solvers.scuffing.load_balance import LoadBalance
from solvers.scuffing.results import ErrorCurves, FrictionLoss, Stiffness, StiffnessCurves, TransmissionError
from solvers.scuffing.tooth_stiffness import single_stiffness

CURVE_POINTS = 101  # number of points of the stiffness curve, one per percent of the path
REFERENCE_LOAD = 100e3  # N/m, line load for which ISO 6336-1 states c'; used if there is no load
STEEL = 206e9  # Pa, modulus for which ISO 6336-1 states c'
DISC_FACTOR = 1.0  # C_R of solid discs
MEASURED_FRACTION = 0.8  # C_M: ratio of measured to theoretical stiffness
HARMONICS = 5  # number of harmonics, chosen
BEST_GRADE = 7  # finer quality grades have the load sharing of this grade


def iso_load_sharing(path: PathOfContact, x: FloatArray, quality_grade: int = BEST_GRADE) -> FloatArray | None:
    """Load sharing X_Gamma X_but of ISO/TS 6336-20 at x [m] from A; None where it has no diagram.

    eps_gamma below 2: as spur gears of the grade (finer ones as 7); else 1/eps_alpha. No diagram for eps_alpha < 1, or
    spur gears >= 2.
    """
    ratio = path.transverse_contact_ratio
    if ratio < 1.0 or (path.overlap_ratio == 0.0 and ratio >= 2.0):
        return None
    if path.total_contact_ratio < 2.0:
        shared = spur_load_sharing(path, x, quality_grade)
    else:
        shared = np.full_like(x, 1.0 / ratio)
    return shared * buttressing(path, x, path.overlap_ratio)


def spur_load_sharing(path: PathOfContact, x: FloatArray, quality_grade: int) -> FloatArray:
    """Load sharing of unmodified spur gears at x [m] from A (Eq. M12).

    (Q - 2)/15 at A, 1/3 more at B, 1 between B and D, mirrored to E. Formulas 46 to 48 of ISO/TR 15144-1.
    """
    inner, outer = path.length - path.plane.base_pitch, path.plane.base_pitch
    outside = np.maximum(inner - x, x - outer)  # distance outside the stretch with one pair in contact; negative inside
    if inner <= 0.0:
        return np.ones(np.shape(x))
    base = (max(quality_grade, BEST_GRADE) - 2) / 15
    return np.where(outside > 0.0, base + (inner - outside) / (3 * inner), 1.0)


def buttressing(path: PathOfContact, x: FloatArray, overlap_ratio: float) -> FloatArray:
    """Buttressing factor of helical teeth: 1 + 0.3 min(eps_beta, 1) at A and E, linear to 1 (Eq. 15).

    It reaches 1 where Gamma differs by 0.2 sin beta_b.
    """
    plane = path.plane
    ramp = 0.2 * plane.tan_base_helix * plane.cos_base_helix * path.pitch_point
    if ramp == 0.0:
        return np.ones_like(x)
    from_end = np.minimum(x, path.length - x)
    return 1.0 + 0.3 * min(overlap_ratio, 1.0) * np.maximum(1.0 - from_end / ramp, 0.0)


@dataclass(frozen=True, slots=True)
class StandardStiffness:
    """Stiffness by ISO 6336-1, method B [Pa]: c'_th, c', c_gamma_alpha (`mesh`), c_gamma_beta (`mesh_bending`)."""

    theoretical: float
    single: float
    mesh: float
    mesh_bending: float


def standard_stiffness(
    path: PathOfContact, line_load: float = REFERENCE_LOAD, youngs_modulus: float = STEEL
) -> StandardStiffness:
    """Stiffness of teeth and mesh by ISO 6336-1, method B [Pa] (Eq. L16).

    c' = c'_th C_M C_R C_B cos beta, c_ga = c' (0.75 eps_alpha + 0.25), c_gb = 0.85 c_ga, with

    1/c'_th = 0.04723 + 0.15551/z_n1 + 0.25791/z_n2 - 0.00635 x1 - 0.11654 x1/z_n1 - 0.00193 x2 - 0.24188 x2/z_n2
              + 0.00529 x1^2 + 0.00182 x2^2 [mm um/N].

    Gear 1 has fewer teeth, whichever drives, or the larger profile shift (our choice). Times E/206 GPa; below 100 N/mm,
    c' is proportional to the fourth root of the line load.
    """
    inputs = path.pair.inputs
    virtual = cos(path.pair.base_helix_angle) ** 2 * cos(inputs.helix_angle)
    first, second = sorted((inputs.pinion, inputs.wheel), key=lambda gear: (gear.teeth, -gear.profile_shift))
    z1, z2 = first.teeth / virtual, second.teeth / virtual
    x1, x2 = first.profile_shift, second.profile_shift
    flexibility = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 - 0.11654 * x1 / z1
    flexibility += -0.00193 * x2 - 0.24188 * x2 / z2 + 0.00529 * x1**2 + 0.00182 * x2**2
    theoretical = 1e9 / flexibility
    rack = _rack_factor(path.pair)
    light = min(line_load / REFERENCE_LOAD, 1.0) ** 0.25
    material = youngs_modulus / STEEL
    single = theoretical * material * MEASURED_FRACTION * DISC_FACTOR * rack * cos(inputs.helix_angle) * light
    mesh = single * (0.75 * path.transverse_contact_ratio + 0.25)
    return StandardStiffness(theoretical, single, mesh, 0.85 * mesh)


def _standard_line_load(path: PathOfContact, load: Load) -> float:
    """Line load F_t K_A/b [N/m] at the reference circle; `REFERENCE_LOAD` without load."""
    tangential = load.application_factor * load.helix_torque / path.pair.pinion.reference_radius
    return tangential / path.plane.face_width if tangential > 0.0 else REFERENCE_LOAD


def _rack_factor(pair: GearPair) -> float:
    """C_B = [1 + 0.5 (1.2 - h_fP)][1 - 0.02 (20 - alpha_n)], mean dedendum in modules, alpha_n in degrees."""
    dedendum = (pair.inputs.pinion.dedendum + pair.inputs.wheel.dedendum) / 2
    return (1 + 0.5 * (1.2 - dedendum)) * (1 - 0.02 * (20 - degrees(pair.inputs.normal_pressure_angle)))


def mesh_stiffness(balance: LoadBalance, tangential_force: float) -> FloatArray | None:
    """Stiffness c_gamma = F_bt/[b (TE - TE_unloaded)] at every roll position [Pa]; None without load (Eq. L15)."""
    if balance.force == 0.0:
        return None
    approach = balance.transmission_error - balance.unloaded_error
    return np.asarray(tangential_force / (balance.mesh.plane.face_width * approach))


def stiffness(
    path: PathOfContact, balance: LoadBalance, inputs: LoadDistributionInputs, mean_load: float, tangential_force: float
) -> Stiffness:
    """Stiffness of the mesh, and of one pair along the path: secant at `mean_load` [N/m], else `REFERENCE_LOAD`."""
    secant_load = mean_load if mean_load > 0.0 else REFERENCE_LOAD
    single = single_stiffness(balance.mesh.compliance, secant_load)
    x = np.linspace(0.0, path.length, single.size)
    pitch_x = path.pitch_point - path.start
    curve = np.linspace(0.0, path.length, CURVE_POINTS)
    mesh = mesh_stiffness(balance, tangential_force)
    moduli = inputs.pinion_material.youngs_modulus, inputs.wheel_material.youngs_modulus
    standard = standard_stiffness(path, _standard_line_load(path, inputs.load), 2 * moduli[0] * moduli[1] / sum(moduli))
    return Stiffness(
        max=float(single.max()),
        max_at_gamma=without_rounding(float(path.profile_parameter(x[np.argmax(single)])), 1.0),
        approach=float(single[0]),
        pitch=float(np.interp(pitch_x, x, single)) if 0.0 <= pitch_x <= path.length else None,
        recess=float(single[-1]),
        mean_mesh=None if mesh is None else period_mean(mesh, balance.rolls.phase),
        standard_single=standard.single,
        standard_mesh=standard.mesh,
        secant_load=secant_load,
        curves=StiffnessCurves(frozen(path.profile_parameter(curve)), frozen(np.interp(curve, x, single))),
    )


def transmission_error(balance: LoadBalance) -> TransmissionError:
    """Extremes, mean and harmonics of the transmission error, trapezoidal over both sides of jumps [m] (Eq. L18)."""
    error, phase = balance.transmission_error, balance.rolls.phase
    return TransmissionError(
        peak_to_peak=float(np.ptp(error)),
        mean=period_mean(error, phase),
        min=float(error.min()),
        max=float(error.max()),
        harmonics=frozen(2 * np.abs(_fourier(error, phase))),
        curves=ErrorCurves(frozen(phase / phase[-1]), frozen(error)),
    )


def period_mean(values: FloatArray, phase: FloatArray) -> float:
    """Return the mean over one base pitch of values that are given at the roll positions."""
    return float(np.trapezoid(values, phase) / phase[-1])


def _fourier(values: FloatArray, phase: FloatArray) -> NDArray[np.complex128]:
    """Return the complex Fourier coefficients c_1, c_2, ... of a function of the roll position."""
    # The wave of order k is the wave of order 1 raised to the power k.
    waves = np.cumprod(np.tile(np.exp(-2j * np.pi * phase / phase[-1]), (HARMONICS, 1)), axis=0)
    return np.asarray(np.trapezoid((values - values.mean()) * waves, phase) / phase[-1])


def friction_loss(
    path: PathOfContact, balance: LoadBalance, load: Load, friction_coefficient: float | None
) -> FrictionLoss:
    """Friction power [W], loss factor and efficiency of the mesh (Eq. L19).

    P_V = f/p_bt int sum_j int w |u1 - u2| dl dphase, u1 - u2 = (omega_1 + omega_2)(s - s_C), H_V = P_V/(f P). Load
    factors raise contacts, not power, and are left out. Without load the power is 0 and the rest None; without
    friction, power and efficiency are None.
    """
    if balance.force == 0.0:
        return FrictionLoss(friction_coefficient, loss_factor=None, power=0.0, efficiency=None)
    speed_ratio = path.pair.pinion.teeth / path.pair.wheel.teeth
    moment = period_mean(balance.survey.friction_moment, balance.rolls.phase) / load.contact_factor
    loss_factor = moment * (1 + speed_ratio) / load.helix_torque
    if friction_coefficient is None:
        return FrictionLoss(None, loss_factor=loss_factor, power=None, efficiency=None)
    return FrictionLoss(
        friction_coefficient,
        loss_factor=loss_factor,
        power=friction_coefficient * moment * load.pinion_speed * (1 + speed_ratio),
        efficiency=1.0 - friction_coefficient * loss_factor,
    )
