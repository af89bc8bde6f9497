"""Mesh stiffness: that of the loaded contact lines, and that of ISO 6336-1 to hold it against."""

from dataclasses import dataclass
from math import cos, degrees

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.gears.pair import GearPair
from solvers.gears.path_of_contact import PathOfContact
from solvers.scuffing.balance.load_balance import LoadBalance
from solvers.scuffing.distribution.transmission_error import period_mean
from solvers.scuffing.inputs import Load
from solvers.scuffing.results import Stiffness, StiffnessCurves
from solvers.scuffing.teeth.stiffness import single_stiffness

CURVE_POINTS = 101
REFERENCE_LOAD = 100e3  # N/m, for which ISO 6336-1 states c'; stands in where there is no load
DISC_FACTOR = 1.0  # C_R: solid discs
MEASURED_FRACTION = 0.8  # C_M


@dataclass(frozen=True, slots=True)
class StandardStiffness:
    """ISO 6336-1 method B: theoretical c'_th, single c', mesh c_gamma_alpha and c_gamma_beta [Pa]."""

    theoretical: float
    single: float
    mesh: float
    mesh_bending: float


def standard_stiffness(path: PathOfContact, line_load: float = REFERENCE_LOAD) -> StandardStiffness:
    """Stiffness by ISO 6336-1: c' = c'_th C_M C_R C_B cos beta, c_ga = c' (0.75 eps_alpha + 0.25), c_gb = 0.85 c_ga.

    1/c'_th = 0.04723 + 0.15551/z_n1 + 0.25791/z_n2 - 0.00635 x1 - 0.11654 x1/z_n1 - 0.00193 x2 - 0.24188 x2/z_n2
              + 0.00529 x1^2 + 0.00182 x2^2 [mm um/N]; C_B for the basic rack.

    Below a line load F_t K_A/b [N/m] of 100 N/mm c' falls with its fourth root.
    """
    inputs = path.pair.inputs
    virtual = cos(path.pair.base_helix_angle) ** 2 * cos(inputs.helix_angle)
    z1, z2 = inputs.pinion.teeth / virtual, inputs.wheel.teeth / virtual
    x1, x2 = inputs.pinion.profile_shift, inputs.wheel.profile_shift
    flexibility = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 - 0.11654 * x1 / z1
    flexibility += -0.00193 * x2 - 0.24188 * x2 / z2 + 0.00529 * x1**2 + 0.00182 * x2**2
    theoretical = 1e9 / flexibility
    rack = _rack_factor(path.pair)
    light = min(line_load / REFERENCE_LOAD, 1.0) ** 0.25
    single = theoretical * MEASURED_FRACTION * DISC_FACTOR * rack * cos(inputs.helix_angle) * light
    mesh = single * (0.75 * path.transverse_contact_ratio + 0.25)
    return StandardStiffness(theoretical, single, mesh, 0.85 * mesh)


def _standard_line_load(path: PathOfContact, load: Load) -> float:
    """F_t K_A/b [N/m] with F_t at the reference circle; without load the one c' is stated for."""
    tangential = load.application_factor * load.pinion_torque / path.pair.pinion.reference_radius
    return tangential / path.plane.face_width if tangential > 0.0 else REFERENCE_LOAD


def _rack_factor(pair: GearPair) -> float:
    """C_B = [1 + 0.5 (1.2 - h_fP)][1 - 0.02 (20 - alpha_n)], the mean of the two gears'."""
    dedendum = (pair.inputs.pinion.dedendum + pair.inputs.wheel.dedendum) / 2
    return (1 + 0.5 * (1.2 - dedendum)) * (1 - 0.02 * (20 - degrees(pair.inputs.normal_pressure_angle)))


def mesh_stiffness(balance: LoadBalance, tangential_force: float) -> FloatArray | None:
    """c_gamma(phase) = F_bt / [b (TE - TE_unloaded)] [Pa]; None without load."""
    if balance.force == 0.0:
        return None
    approach = balance.transmission_error - balance.unloaded_error
    return np.asarray(tangential_force / (balance.mesh.plane.face_width * approach))


def stiffness(
    path: PathOfContact, balance: LoadBalance, load: Load, mean_load: float, tangential_force: float
) -> Stiffness:
    """Stiffness of one pair along the path, secant at the mean line load [N/m] if any, and of the mesh."""
    secant_load = mean_load if mean_load > 0.0 else REFERENCE_LOAD
    single = single_stiffness(balance.mesh.compliance, secant_load)
    x = np.linspace(0.0, path.length, single.size)
    pitch_x = path.pitch_point - path.start
    curve = np.linspace(0.0, path.length, CURVE_POINTS)
    mesh = mesh_stiffness(balance, tangential_force)
    standard = standard_stiffness(path, _standard_line_load(path, load))
    return Stiffness(
        max=float(single.max()),
        max_at_gamma=float(path.profile_parameter(x[np.argmax(single)])),
        approach=float(single[0]),
        pitch=float(np.interp(pitch_x, x, single)) if 0.0 <= pitch_x <= path.length else None,
        recess=float(single[-1]),
        mean_mesh=None if mesh is None else period_mean(mesh, balance.rolls.phase),
        standard_single=standard.single,
        standard_mesh=standard.mesh,
        secant_load=secant_load,
        curves=StiffnessCurves(frozen(path.profile_parameter(curve)), frozen(np.interp(curve, x, single))),
    )
