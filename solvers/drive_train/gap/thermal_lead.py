"""Lead and profile errors of gears that are warmer than their drawings: heat, and the gas they pump.

Heating enlarges a body in proportion: every point moves by eps = alpha_L dT times its distance from the axis and along
it. Along the line of action that is the excess eps_1 (s_A + x) + tan beta_b int_0^y eps_1 of the pinion and eps_2 (N -
s_A - x) - tan beta_b int_0^y eps_2 of the wheel. Both hot alike, nothing is left along a contact line but the base
pitch. Own derivation, checked against a brute-force helicoid.
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

EXPANSION = 12e-6  # of steel, 1/K


@dataclass(frozen=True, slots=True)
class GasHeat:
    """Rise [K] of the gas over the ambient in the spaces of pinion and wheel, at positions over the face [m].

    `power` [W] is that of both gears, `powers` of pinion and wheel.
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
    """At the stations: metal temperature rises from pumping [K], gap by heat [m], mean 0; and what does not vary there.

    profile_slope [m] belongs to the lead: only together do they leave parallel contact lines parallel. base_pitch [m]
    is by how much the pinion's base pitch grows over the wheel's.
    """

    lead: FloatArray
    profile_slope: float
    base_pitch: float
    pinion_rise: FloatArray
    wheel_rise: FloatArray


@lru_cache(maxsize=64)
def gas_heat(setup: PumpingSetup, pinion_speed: float) -> GasHeat:
    """The pumped gas; remembered, for a study varies other things most of the time.

    Raises what `pumping.solve` raises.
    """
    result = pumping.solve(PumpingInputs(setup, pinion_speed))
    (at_pinion, pinion), (at_wheel, wheel) = _profile(result.pinion_spaces), _profile(result.wheel_spaces)
    spaces = (result.pinion_spaces, result.wheel_spaces)
    powers = [0.0 if one is None else one.pumping_power for one in spaces]
    return GasHeat(
        at_pinion, pinion, at_wheel, wheel, result.total.pumping_power, (powers[0], powers[1]), result.warnings
    )


def _profile(spaces: SpacesResult | None) -> tuple[FloatArray, FloatArray]:
    """Positions and rises, no rise where the flow has no temperature of its own."""
    if spaces is None or spaces.profile.temperature_rise is None:
        return np.zeros(1), np.zeros(1)
    return spaces.profile.position, spaces.profile.temperature_rise


def thermal_lead(inputs: DriveTrainInputs, path: PathOfContact, stations: FloatArray) -> ThermalLead:
    """The gap that heat opens at the stations y [m] and what it does to the profile (Eq. D10).

    lead = -[eps_1 s_C + tan beta_b int eps_1 + eps_2 (N - s_C) - tan beta_b int eps_2] + mean;
    profile slope = -(mean eps_1 - mean eps_2) g_alpha.
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
    pinion = EXPANSION * (heat.pinion_bulk - heat.reference + rises[0])
    wheel = EXPANSION * (heat.wheel_bulk - heat.reference + rises[1])
    difference = face_mean(pinion) - face_mean(wheel)
    excess = pinion * path.pitch_point + wheel * (path.pair.line_of_action - path.pitch_point)
    excess += path.plane.tan_base_helix * _integral(stations, pinion - wheel)
    return ThermalLead(
        lead=face_mean(excess) - excess,
        profile_slope=-difference * path.length,
        base_pitch=difference * path.plane.base_pitch,
        pinion_rise=rises[0],
        wheel_rise=rises[1],
    )


def no_heat(stations: FloatArray) -> ThermalLead:
    """Gears as warm as their drawings."""
    nothing = np.zeros(stations.size)
    return ThermalLead(nothing, 0.0, 0.0, nothing, nothing)


def _integral(stations: FloatArray, values: FloatArray) -> FloatArray:
    """Integral from y = 0 to every station, by trapezia."""
    return np.append(0.0, np.cumsum(np.diff(stations) * (values[1:] + values[:-1]) / 2))
