"""Results for the mesh from the balanced load: load sharing, stiffness, transmission error, friction loss.

Eq. 15 is an equation of the paper. The formulas for the load sharing X_Gamma and the buttressing factor X_but are
general knowledge about ISO/TR 13989-1. They were not compared with the text of this standard.
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


def iso_load_sharing(path: PathOfContact, x: FloatArray) -> FloatArray | None:
    """Return the load sharing at distances x [m] from A, or None if ISO/TR 13989-1 has no diagram for the pair.

    The result is the load sharing factor X_Gamma times the buttressing factor X_but. If eps_gamma is below 2, X_Gamma
    is that of spur gears of quality 7 or better. Otherwise X_Gamma is 1 / eps_alpha. The standard has no diagram for
    eps_alpha < 1, and no diagram for spur gears with eps_alpha >= 2.
    """
    ratio = path.transverse_contact_ratio
    if ratio < 1.0 or (path.overlap_ratio == 0.0 and ratio >= 2.0):
        return None
    if path.total_contact_ratio < 2.0:
        shared = _narrow(x, path.length, path.length - path.plane.base_pitch)
    else:
        shared = np.full_like(x, 1.0 / ratio)
    return shared * _buttressing(path, x)


def _narrow(x: FloatArray, length: float, double: float) -> FloatArray:
    """Return the load sharing factor of narrow gears.

    The factor rises from 1/3 at A to 2/3 at B, is 1 between B and D, and falls from 2/3 at D to 1/3 at E. The distance
    from A to B is `double` [m].
    """
    from_end = np.minimum(x, length - x)
    with_mate = 1 / 3 + from_end / (3 * double) if double > 0.0 else np.ones_like(x)
    return np.where(from_end < double, with_mate, 1.0)


def _buttressing(path: PathOfContact, x: FloatArray) -> FloatArray:
    """Return the buttressing factor of helical teeth; the factor is 1 for spur gears.

    Helical teeth carry more load near the ends A and E of the path of contact than in the middle. At A and E, the
    factor is 1 + 0.3 min(eps_beta, 1). Towards the middle, the factor falls linearly, and reaches 1 where the profile
    parameter Gamma differs by 0.2 sin beta_b from its value at A or E (Eq. 15).
    """
    plane = path.plane
    ramp = 0.2 * plane.tan_base_helix * plane.cos_base_helix * path.pitch_point
    if ramp == 0.0:
        return np.ones_like(x)
    from_end = np.minimum(x, path.length - x)
    return 1.0 + 0.3 * min(path.overlap_ratio, 1.0) * np.maximum(1.0 - from_end / ramp, 0.0)


@dataclass(frozen=True, slots=True)
class StandardStiffness:
    """Stiffness by ISO 6336-1, method B [Pa].

    `theoretical` is c'_th, the theoretical stiffness of one pair of teeth, and `single` is c', the stiffness of one
    pair of teeth. `mesh` is c_gamma_alpha and `mesh_bending` is c_gamma_beta, both of them stiffnesses of the mesh.
    """

    theoretical: float
    single: float
    mesh: float
    mesh_bending: float


def standard_stiffness(
    path: PathOfContact, line_load: float = REFERENCE_LOAD, youngs_modulus: float = STEEL
) -> StandardStiffness:
    """Compute the stiffness of teeth and mesh by ISO 6336-1, method B.

    Parameters
    ----------
    path : PathOfContact
        Path of contact of the pair.
    line_load : float, optional
        Line load F_t K_A/b [N/m].
    youngs_modulus : float, optional
        Young's modulus of the gears E [Pa].

    Returns
    -------
    StandardStiffness
        Stiffness of one pair of teeth and of the mesh [Pa].

    Notes
    -----
    Eq. L16: c' = c'_th C_M C_R C_B cos beta, c_ga = c' (0.75 eps_alpha + 0.25), c_gb = 0.85 c_ga, with

    1/c'_th = 0.04723 + 0.15551/z_n1 + 0.25791/z_n2 - 0.00635 x1 - 0.11654 x1/z_n1 - 0.00193 x2 - 0.24188 x2/z_n2
              + 0.00529 x1^2 + 0.00182 x2^2 [mm um/N].

    C_M is the ratio of measured to theoretical stiffness, C_R is the factor of the gear disc, and C_B is the factor of
    the basic rack. Gear 1 is the gear with fewer teeth, even if the other gear drives. If both gears have the same
    number of teeth, gear 1 is the gear with the larger profile shift (our choice). For materials other than steel, c'
    is multiplied by E/206 GPa. At line loads below 100 N/mm, c' is proportional to the fourth root of the line load.
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
    """Return the line load F_t K_A/b [N/m], with F_t at the reference circle.

    Without load, return `REFERENCE_LOAD`.
    """
    tangential = load.application_factor * load.helix_torque / path.pair.pinion.reference_radius
    return tangential / path.plane.face_width if tangential > 0.0 else REFERENCE_LOAD


def _rack_factor(pair: GearPair) -> float:
    """Return C_B = [1 + 0.5 (1.2 - h_fP)][1 - 0.02 (20 - alpha_n)].

    h_fP is the mean of the dedenda of both gears, in normal modules. alpha_n is the normal pressure angle in degrees.
    """
    dedendum = (pair.inputs.pinion.dedendum + pair.inputs.wheel.dedendum) / 2
    return (1 + 0.5 * (1.2 - dedendum)) * (1 - 0.02 * (20 - degrees(pair.inputs.normal_pressure_angle)))


def mesh_stiffness(balance: LoadBalance, tangential_force: float) -> FloatArray | None:
    """Compute the stiffness of the mesh at every roll position.

    Parameters
    ----------
    balance : LoadBalance
        The balanced mesh.
    tangential_force : float
        Transverse tooth force F_bt [N].

    Returns
    -------
    ndarray or None
        Stiffness c_gamma [Pa]; None without load.

    Notes
    -----
    c_gamma = F_bt / [b (TE - TE_unloaded)] (Eq. L15).
    """
    if balance.force == 0.0:
        return None
    approach = balance.transmission_error - balance.unloaded_error
    return np.asarray(tangential_force / (balance.mesh.plane.face_width * approach))


def stiffness(
    path: PathOfContact, balance: LoadBalance, inputs: LoadDistributionInputs, mean_load: float, tangential_force: float
) -> Stiffness:
    """Return the stiffness of the mesh, and the stiffness of one pair of teeth along the path of contact.

    The stiffness of one pair is the secant stiffness at the mean line load `mean_load` [N/m], or at `REFERENCE_LOAD` if
    `mean_load` is 0.
    """
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
    """Compute extremes, mean and harmonics of the transmission error.

    Parameters
    ----------
    balance : LoadBalance
        The balanced mesh.

    Returns
    -------
    TransmissionError
        Transmission error along the transverse line of action [m].

    Notes
    -----
    Eq. L18. Mean and harmonics are integrals by the trapezoidal rule over the roll positions. If the transmission error
    of a spur gear jumps at a roll position, the position occurs twice: with the value before the jump and with the
    value after the jump. Jumps therefore cause no error of the integrals.
    """
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
    """Compute friction power, loss factor and efficiency of the mesh.

    Parameters
    ----------
    path : PathOfContact
        Path of contact of the pair.
    balance : LoadBalance
        The balanced mesh.
    load : Load
        Torque, speed and load factors.
    friction_coefficient : float or None
        Mean coefficient of friction f [-].

    Returns
    -------
    FrictionLoss
        Friction power [W], loss factor and efficiency [-]. Without load, the power is 0, and loss factor and efficiency
        are None. Without a coefficient of friction, power and efficiency are None.

    Notes
    -----
    Eq. L19: P_V = f/p_bt int sum_j int w |u1 - u2| dl dphase with u1 - u2 = (omega_1 + omega_2)(s - s_C), and
    H_V = P_V / (f P). The sum is taken over the contact lines j, and P is the transmitted power. Here p_bt is the
    transverse base pitch, w is the line load, s is the distance of the contact from the pinion's base tangent point,
    and s_C is the distance of the pitch point from the pinion's base tangent point. The load factors are not used for
    friction power and efficiency, because they raise only the load of the contacts, not the transmitted power.
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
