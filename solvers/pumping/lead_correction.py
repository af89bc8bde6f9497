"""Thermal growth of the pinion's flanks along the face, and the lead correction that undoes it (own derivation)."""

from dataclasses import dataclass
from math import cos, sin

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.gears.pair import GearPair

EXPANSION = 12e-6  # of steel, 1/K


@dataclass(frozen=True, slots=True)
class LeadCurves:
    """Growth normal to the flank and its correction at positions along the face [m], each (slices,)."""

    position: FloatArray
    growth: FloatArray
    correction: FloatArray


@dataclass(frozen=True, slots=True)
class LeadCorrection:
    """Range of the growth [m], and slope and crown of the parabola fitted to the correction by least squares [m].

    Slope is its rise from the end that meshes first to the other, crown the height of its middle above its ends.
    """

    range: float
    slope: float
    crown: float
    curves: LeadCurves


def growth_per_kelvin(pair: GearPair) -> float:
    """Growth of a pinion flank in its normal at the pitch point [m/K]: that of the blank and of half the tooth."""
    radius, angle = pair.pinion_working_radius, pair.working_pressure_angle
    half_thickness = radius * pair.pinion.half_tooth_angle(radius)
    return EXPANSION * (radius * sin(angle) + half_thickness * cos(angle))


def lead_correction(pair: GearPair, position: FloatArray, temperature_rise: FloatArray) -> LeadCorrection:
    """Correction for metal that warms as much as the gas; position [m] and rise [K] are (slices,).

    It scales with the wall's response, which only measurements give.
    """
    growth = growth_per_kelvin(pair) * temperature_rise
    correction = -(growth - growth.min())
    place = position / pair.inputs.face_width - 0.5
    degree = min(position.size - 1, 2)
    curvature, slope, _ = np.concatenate([np.zeros(2 - degree), np.polyfit(place, correction, degree)])
    return LeadCorrection(
        range=float(np.ptp(growth)),
        slope=float(slope),
        crown=float(-curvature / 4),
        curves=LeadCurves(frozen(position), frozen(growth), frozen(correction)),
    )
