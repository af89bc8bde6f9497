"""Estimates of ISO/TS 6336-20: mean friction, scuffing temperature from an FZG test, bulk temperature, risk class.

The formulas, the load factors and the upper limit of 50 m/s for the speed follow a public implementation of the
standard. The lower limit of 150 N/mm for the line load is quoted from a secondary source and was not verified against
the standard. The coefficient of friction for the losses is Schlenk's.
"""

from typing import Literal

from solvers.gears.pair import PathOfContact
from solvers.lubricants import OilKind
from solvers.scuffing.inputs import LoadDistributionInputs, OilSupply

ScuffingRisk = Literal["high", "moderate", "low"]

OIL_SUPPLY_FACTOR: dict[OilSupply, float] = {"spray": 1.2, "dip": 1.0, "submerged": 0.2}  # X_S
OIL_KIND_FACTOR: dict[OilKind, float] = {"mineral": 1.0, "pao": 0.8, "polyglycol": 0.7, "ester": 1.0}  # factor in X_L
OIL_KIND_LOSS_FACTOR: dict[OilKind, float] = {"mineral": 1.0, "pao": 0.8, "polyglycol": 0.7, "ester": 0.8}  # X_L
LEAST_LINE_LOAD = 150.0  # N/mm, lower limit in both friction laws
FASTEST_PITCH_LINE = 50.0  # m/s, upper limit of v_t in both friction laws
TEST_TEMPERATURE = 363.15  # K, oil temperature in the FZG test A/8.3/90
FLASH_SHARE = 0.47  # ratio of the rise of the bulk temperature to the mean flash temperature, if X_S = 1
HIGH_RISK_BELOW, LOW_RISK_ABOVE = 1.0, 2.0  # limits of the safety factor; quoted, not verified against the standard


def lubricant_factor(viscosity: float, kind: OilKind) -> float:
    """Compute the lubricant factor, a factor of the mean coefficient of friction that `mean_friction` returns.

    X_L = eta_oil^-0.05 with eta_oil in mPa s (Eq. R6). For polyalphaolefins this value is multiplied by 0.8, and for
    polyglycols by 0.7. For esters no multiplier is known; esters are treated as mineral oils.
    """
    return float(OIL_KIND_FACTOR[kind] * (viscosity * 1e3) ** -0.05)


def roughness_factor(roughness_1: float, roughness_2: float) -> float:
    """Compute the roughness factor in the formula of the mean coefficient of friction [-].

    X_R = [(Ra_1 + Ra_2)/2]^0.25 with Ra in micrometres (Eq. R7).
    """
    return float(((roughness_1 + roughness_2) / 2 * 1e6) ** 0.25)


def pitch_line_velocity(inputs: LoadDistributionInputs, path: PathOfContact) -> float:
    """Return the circumferential speed of the working pitch circles [m/s]."""
    return inputs.load.pinion_speed * path.pair.pinion_working_radius


def mean_friction(inputs: LoadDistributionInputs, path: PathOfContact, factor: float, face_load_factor: float) -> float:
    """Compute the mean coefficient of friction for the flash temperature [-].

    mu = 0.060 [w_Bt/(v_SigmaC rho_relC)]^0.2 X_L X_R (Eq. R5), with w_Bt = K_A K_v K_gamma K_Hbeta K_Halpha F_t/b. A
    value of w_Bt below 150 N/mm is raised to 150 N/mm. v_SigmaC is the sum of the tangential speeds at the pitch point,
    and rho_relC is the reduced radius at the pitch point. F_t acts at the reference circle; the transverse load factor
    K_Halpha is 1.
    """
    load, width = inputs.load, inputs.gears.face_width
    line_load = face_load_factor * load.contact_torque / path.pair.pinion.reference_radius / width
    return 0.060 * _load_and_speed(inputs, path, line_load) * factor * _rough(inputs)


def loss_friction(inputs: LoadDistributionInputs, path: PathOfContact, viscosity: float, kind: OilKind) -> float:
    """Compute Schlenk's mean coefficient of friction for the losses [-].

    mu = 0.048 [w_bt/(v_SigmaC rho_redC)]^0.2 eta_oil^-0.05 Ra^0.25 X_L (Eq. R10). Here w_bt = F_bt/b follows from the
    transmitted torque; values below 150 N/mm are raised to 150 N/mm. F_bt acts at the base circle and does not contain
    load factors. v_SigmaC is the sum of the tangential speeds at the pitch point, and rho_redC is the reduced radius at
    the pitch point. X_L is 1 for mineral oils, 0.8 for polyalphaolefins and 0.7 for polyglycols; for esters 0.8 is
    assumed.
    """
    line_load = inputs.load.helix_torque / path.pair.pinion.base_radius / inputs.gears.face_width
    oil = OIL_KIND_LOSS_FACTOR[kind] * float((viscosity * 1e3) ** -0.05)
    return 0.048 * _load_and_speed(inputs, path, line_load) * oil * _rough(inputs)


def _load_and_speed(inputs: LoadDistributionInputs, path: PathOfContact, line_load: float) -> float:
    """Return [w/(v_SigmaC rho_C)]^0.2 for a line load w [N/m].

    The formula uses w in N/mm; values of w below 150 N/mm are raised to 150 N/mm. v_SigmaC [m/s] is the sum of the
    tangential speeds at the pitch point. If the pitch-line velocity exceeds 50 m/s, v_SigmaC is computed for a
    pitch-line velocity of 50 m/s. rho_C is the reduced radius at the pitch point [mm].
    """
    pair, pitch = path.pair, path.pitch_point
    speed = inputs.load.pinion_speed * min(1.0, FASTEST_PITCH_LINE / pitch_line_velocity(inputs, path))
    speeds = speed * (pitch + pair.pinion.teeth / pair.wheel.teeth * (pair.line_of_action - pitch))
    radius = pitch * (pair.line_of_action - pitch) / (pair.line_of_action * path.plane.cos_base_helix) * 1e3
    return float((max(line_load * 1e-3, LEAST_LINE_LOAD) / (speeds * radius)) ** 0.2)


def _rough(inputs: LoadDistributionInputs) -> float:
    return roughness_factor(inputs.pinion_material.roughness, inputs.wheel_material.roughness)


def scuffing_temperature(stage: int, structure_factor: float, factor: float) -> float:
    """Compute the scuffing temperature of an oil from the load stage at which the oil fails in the FZG test A/8.3/90.

    The scuffing temperature is 80 + (0.85 + 1.4 X_W) X_L S^2 in C (Eq. R9).
    """
    return 80.0 + (0.85 + 1.4 * structure_factor) * factor * stage**2 + 273.15


def bulk_temperature(oil: float, supply: OilSupply, mean_flash: float) -> float:
    """Compute the bulk temperature from the mean flash temperature [K].

    The bulk temperature is the oil temperature plus 0.47 X_S times the mean flash temperature (Eq. R8).
    """
    return oil + FLASH_SHARE * OIL_SUPPLY_FACTOR[supply] * mean_flash


def scuffing_risk(safety: float) -> ScuffingRisk:
    """Return the risk class by ISO/TS 6336-20 for a safety factor that was computed with Blok's flash temperature.

    The risk is high below 1, low above 2, and moderate in between. These limits are quoted from a secondary source.
    """
    if safety < HIGH_RISK_BELOW:
        return "high"
    return "low" if safety > LOW_RISK_ABOVE else "moderate"
