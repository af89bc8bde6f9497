"""Thermal growth of the pinion's flanks along the face, and the lead correction that undoes it (own derivation)."""

from dataclasses import dataclass
from math import cos, sin

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.gears.pair import GearPair

EXPANSION = 12e-6  # of steel, 1/K


@dataclass(frozen=True, slots=True)
class LeadCorrection:
    """Growth normal to the flank and its correction over the face [m].

    `slope` and `crown` describe the parabola fitted to the correction by least squares: its rise from the end that meshes
    first to the other, and the height of its middle above its ends. `range` is that of the growth.
    """

    position: FloatArray
    growth: FloatArray
    correction: FloatArray
    range: float
    slope: float
    crown: float


def growth_per_kelvin(pair: GearPair) -> float:
    """Growth of a pinion flank in its transverse normal at the pitch point [m/K]: of the blank and of half the tooth."""
    radius, angle = pair.pinion_working_radius, pair.working_pressure_angle
    half_thickness = radius * pair.pinion.half_tooth_angle(radius)
    return EXPANSION * (radius * sin(angle) + half_thickness * cos(angle))


def lead_correction(
    pair: GearPair, position: FloatArray, temperature_rise: FloatArray, *, wall_response: float = 1.0
) -> LeadCorrection:
    """Correction for a metal that is `wall_response` kelvin warmer for each kelvin of gas [position, rise: (slices,)]."""
    growth = growth_per_kelvin(pair) * wall_response * temperature_rise
    correction = -(growth - growth.min())
    place = position / pair.inputs.face_width - 0.5
    if position.size >= 3:
        curvature, slope, _ = np.polyfit(place, correction, 2)
    else:
        curvature, slope = 0.0, (correction[-1] - correction[0]) / max(place[-1] - place[0], 1.0 / position.size)
    return LeadCorrection(
        position=frozen(position),
        growth=frozen(growth),
        correction=frozen(correction),
        range=float(np.ptp(growth)),
        slope=float(slope),
        crown=float(-curvature / 4),
    )
