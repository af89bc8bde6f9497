"""Lead and profile errors of gears whose temperature differs from the reference temperature of the drawings.

The model assumes that the gear bodies are as warm as the teeth. The pumped gas causes an additional temperature rise,
which varies over the face. A heated body keeps its shape and grows by the strain eps = alpha_L dT; alpha_L is the
coefficient of expansion and dT is the temperature rise. A point of the body moves away from the axis by eps times the
distance between point and axis, and moves along the axis by the integral of eps. In the direction of the line of
action, the flanks grow by
    eps_1 (s_A + x) + tan beta_b int_0^y eps_1        on the pinion
    eps_2 (N - s_A - x) - tan beta_b int_0^y eps_2    on the wheel
Here A is the start of the path of contact, s_A is the distance from the pinion's base tangent point to A, x is the
distance from A along the path of contact, y is the position on the face, N is the distance between both base tangent
points, and beta_b is the base helix angle. If both gears are equally hot, only the base pitch changes and the contact
lines stay parallel. The derivation is our own. It was checked against the numerical geometry of a heated helicoid.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.gap.face_curves import face_mean
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.gears.pair import PathOfContact
from solvers.notices import Notice
from solvers.pumping import model as pumping
from solvers.pumping.inputs import PumpingInputs, PumpingSetup
from solvers.pumping.results import SpacesResult

EXPANSION = 12e-6  # 1/K; coefficient of thermal expansion of steel


@dataclass(frozen=True, slots=True)
class GasHeat:
    """Rise of the gas temperature in the tooth spaces [K] at positions on the face [m].

    The rise is the difference from the ambient temperature. `power` [W] is the total pumping power; `powers` [W] are
    the pumping powers of pinion and wheel.
    """

    pinion_position: FloatArray
    pinion_rise: FloatArray
    wheel_position: FloatArray
    wheel_rise: FloatArray
    power: float
    powers: tuple[float, float]
    warnings: tuple[Notice, ...]


@dataclass(frozen=True, slots=True)
class ThermalLead:
    """Gap that heat causes, and temperature rise of the metal due to pumping [K].

    `lead` [m] is the gap at the stations; its mean is 0. `profile_slope` [m] is the profile slope that heat causes.
    Contact lines that are parallel without heat stay parallel only if lead and profile slope are applied together.
    `base_pitch` [m] is the growth of the pinion's base pitch minus the growth of the wheel's base pitch. `even_lead` is
    the gap that remains while the load is spread evenly. `flanks` (gears, stations) [K] are the flanks along the face;
    None if they are even.
    """

    lead: FloatArray
    profile_slope: float
    base_pitch: float
    pinion_rise: FloatArray
    wheel_rise: FloatArray
    even_lead: FloatArray
    flanks: FloatArray | None = None


@lru_cache(maxsize=64)
def gas_heat(setup: PumpingSetup, pinion_speed: float) -> GasHeat:
    """Compute the temperature rise of the gas that a gear pair pumps. Raises the errors of `pumping.solve`."""
    pumped = pumping.solve_on_slices(PumpingInputs(setup, pinion_speed))
    (at_pinion, pinion), (at_wheel, wheel) = _profile(pumped.pinion_spaces), _profile(pumped.wheel_spaces)
    spaces = (pumped.pinion_spaces, pumped.wheel_spaces)
    powers = [0.0 if result is None else setup.gears.helices * result.pumping_power for result in spaces]
    return GasHeat(
        at_pinion, pinion, at_wheel, wheel, pumped.total.pumping_power, (powers[0], powers[1]), pumped.warnings
    )


def _profile(spaces: SpacesResult | None) -> tuple[FloatArray, FloatArray]:
    """Return positions on the face, and the temperature rises of the gas at these positions.

    If the flow model does not compute temperatures, the rise is 0.
    """
    if spaces is None or spaces.profile.temperature_rise is None:
        return np.zeros(1), np.zeros(1)
    return spaces.profile.position, spaces.profile.temperature_rise


def thermal_lead(inputs: DriveTrainInputs, path: PathOfContact, stations: FloatArray) -> ThermalLead:
    """Compute the gap over the face, the profile slope and the base pitch deviation that heat causes.

    Eq. D10: lead = (mean of e over the face) - e, where e = eps_1 s_C + tan beta_b int eps_1 + eps_2 (N - s_C) - tan
    beta_b int eps_2; profile slope = -(mean eps_1 - mean eps_2) g_alpha. Here s_C is the distance from the pinion's
    base tangent point to the pitch point, and g_alpha is the length of the path of contact. The docstring of this
    module explains the other symbols.
    """
    heat, ratio = inputs.heat, path.pair.pinion.teeth / path.pair.wheel.teeth
    rises = [np.zeros(stations.size), np.zeros(stations.size)]
    responses = heat.responses(ratio)
    if any(responses):
        gas = gas_heat(inputs.pumping, inputs.mesh.distribution.load.pinion_speed)
        profiles = ((gas.pinion_position, gas.pinion_rise), (gas.wheel_position, gas.wheel_rise))
        for i, (position, rise) in enumerate(profiles):
            rises[i] = responses[i] * np.interp(stations, position, rise)
            if heat.bulk_includes_pumping:
                rises[i] -= face_mean(rises[i])
    pinion, wheel = (EXPANSION * (tooth - heat.reference + rise) for tooth, rise in zip(heat.teeth, rises, strict=True))
    difference = face_mean(pinion) - face_mean(wheel)
    excess = pinion * path.pitch_point + wheel * (path.pair.line_of_action - path.pitch_point)
    excess += path.plane.tan_base_helix * _integral(stations, pinion - wheel)
    lead = face_mean(excess) - excess
    return ThermalLead(
        lead=lead,
        even_lead=lead,
        profile_slope=-difference * path.length,
        base_pitch=difference * path.plane.base_pitch,
        pinion_rise=rises[0],
        wheel_rise=rises[1],
    )


def no_heat(stations: FloatArray) -> ThermalLead:
    """Return the thermal lead of gears at the reference temperature of the drawings: all values are zero."""
    nothing = np.zeros(stations.size)
    return ThermalLead(nothing, 0.0, 0.0, nothing, nothing, nothing)


def _integral(stations: FloatArray, values: FloatArray) -> FloatArray:
    """Return the integral from y = 0 to every station, by the trapezoidal rule."""
    return np.append(0.0, np.cumsum(np.diff(stations) * (values[1:] + values[:-1]) / 2))
