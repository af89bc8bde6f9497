"""Estimates of ISO/TR 13989-1: mean friction, scuffing temperature of an FZG stage, bulk temperature, risk.

The formulas, load factors and the bound of 50 m/s on the speed follow a public implementation of the standard; the
bound of 150 N/mm on the line load is quoted, not verified against the standard. The friction of the losses is
Schlenk's.
"""

from typing import Literal

from solvers.gears.pair import PathOfContact
from solvers.lubricants import OilKind
from solvers.scuffing.inputs import LoadDistributionInputs, OilSupply

ScuffingRisk = Literal["high", "moderate", "low"]

OIL_SUPPLY_FACTOR: dict[OilSupply, float] = {"spray": 1.2, "dip": 1.0, "submerged": 0.2}  # X_S
OIL_KIND_FACTOR: dict[OilKind, float] = {"mineral": 1.0, "pao": 0.8, "polyglycol": 0.7, "ester": 1.0}  # X_L
OIL_KIND_LOSS_FACTOR: dict[OilKind, float] = {"mineral": 1.0, "pao": 0.8, "polyglycol": 0.7, "ester": 0.8}  # X_L
LEAST_LINE_LOAD = 150.0  # N/mm, of both friction laws
FASTEST_PITCH_LINE = 50.0  # m/s, of v_t in both friction laws
TEST_TEMPERATURE = 363.15  # K, of the oil in A/8.3/90
FLOODED_UP_TO = 60.0  # m/s, pitch-line velocity beyond which the estimated bulk is a lower bound
FLASH_SHARE = 0.47  # of the mean flash temperature that the bulk takes on
HIGH_RISK_BELOW, LOW_RISK_ABOVE = 1.0, 2.0  # the standard's, quoted, not verified against it


def lubricant_factor(viscosity: float, kind: OilKind) -> float:
    """X_L = eta_oil^-0.05, eta_oil in mPa s, times 0.8 for polyalphaolefins and 0.7 for polyglycols (Eq. R6).

    viscosity [Pa s] at the oil temperature. For esters no factor is known; they count as mineral oils.
    """
    return float(OIL_KIND_FACTOR[kind] * (viscosity * 1e3) ** -0.05)


def roughness_factor(roughness_1: float, roughness_2: float) -> float:
    """X_R = [(Ra_1 + Ra_2)/2]^0.25, Ra in micrometres; roughness [m] (Eq. R7)."""
    return float(((roughness_1 + roughness_2) / 2 * 1e6) ** 0.25)


def pitch_line_velocity(inputs: LoadDistributionInputs, path: PathOfContact) -> float:
    """Speed of the working pitch circles [m/s]."""
    return inputs.load.pinion_speed * path.pair.pinion_working_radius


def mean_friction(inputs: LoadDistributionInputs, path: PathOfContact, factor: float, face_load_factor: float) -> float:
    """Mean coefficient of friction mu = 0.060 [w_Bt/(v_SigmaC rho_relC)]^0.2 X_L X_R (Eq. R5).

    w_Bt = K_A K_v K_gamma K_Hbeta K_Halpha F_t/b [N/mm], at least 150 N/mm, with F_t at the reference circle and
    K_Halpha taken as 1; `factor` is X_L. The speed must not be 0.
    """
    load, width = inputs.load, inputs.gears.face_width
    line_load = face_load_factor * load.contact_factor * load.torque / path.pair.pinion.reference_radius / width
    return 0.060 * _load_and_speed(inputs, path, line_load) * factor * _rough(inputs)


def loss_friction(inputs: LoadDistributionInputs, path: PathOfContact, viscosity: float, kind: OilKind) -> float:
    """Schlenk's mean coefficient of the losses mu = 0.048 [w_bt/(v_SigmaC rho_redC)]^0.2 eta_oil^-0.05 Ra^0.25 X_L.

    w_bt = F_bt/b of the transmitted torque [N/mm], at least 150 N/mm, with F_bt at the base circle and without load
    factors; viscosity [Pa s] at the oil temperature; X_L 1 for mineral oils, 0.8 for polyalphaolefins, 0.7 for
    polyglycols; for esters 0.8 is assumed. The speed must not be 0. Eq. R10.
    """
    line_load = inputs.load.torque / path.pair.pinion.base_radius / inputs.gears.face_width
    oil = OIL_KIND_LOSS_FACTOR[kind] * float((viscosity * 1e3) ** -0.05)
    return 0.048 * _load_and_speed(inputs, path, line_load) * oil * _rough(inputs)


def _load_and_speed(inputs: LoadDistributionInputs, path: PathOfContact, line_load: float) -> float:
    """Return [w/(v_SigmaC rho_C)]^0.2 of a line load w [N/m] that counts as at least 150 N/mm.

    v_SigmaC is the sum of the tangential speeds at the pitch point [m/s], of a pitch-line velocity of at most 50 m/s;
    rho_C is the reduced radius there [mm].
    """
    pair, pitch = path.pair, path.pitch_point
    speed = inputs.load.pinion_speed * min(1.0, FASTEST_PITCH_LINE / pitch_line_velocity(inputs, path))
    speeds = speed * (pitch + pair.pinion.teeth / pair.wheel.teeth * (pair.line_of_action - pitch))
    radius = pitch * (pair.line_of_action - pitch) / (pair.line_of_action * path.plane.cos_base_helix) * 1e3
    return float((max(line_load * 1e-3, LEAST_LINE_LOAD) / (speeds * radius)) ** 0.2)


def _rough(inputs: LoadDistributionInputs) -> float:
    return roughness_factor(inputs.pinion_material.roughness, inputs.wheel_material.roughness)


def scuffing_temperature(stage: int, structure_factor: float, factor: float) -> float:
    """Scuffing temperature [K] of an oil that fails stage S of FZG A/8.3/90: 80 + (0.85 + 1.4 X_W) X_L S^2 in C.

    Eq. R9.
    """
    return 80.0 + (0.85 + 1.4 * structure_factor) * factor * stage**2 + 273.15


def bulk_temperature(oil: float, supply: OilSupply, mean_flash: float) -> float:
    """Bulk = oil + 0.47 X_S times the mean flash temperature [K] (Eq. R8)."""
    return oil + FLASH_SHARE * OIL_SUPPLY_FACTOR[supply] * mean_flash


def scuffing_risk(safety: float) -> ScuffingRisk:
    """The standard's word for a safety factor by Blok: high below 1, low above 2 (secondary source)."""
    if safety < HIGH_RISK_BELOW:
        return "high"
    return "low" if safety > LOW_RISK_ABOVE else "moderate"
