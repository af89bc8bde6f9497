"""Thermal growth of the pinion's flanks along the face, and the lead correction that undoes it (own derivation).

Heating enlarges a body in proportion: every point moves by eps times its distance from the axis and from the end z = 0,
and no angle changes. Along the transverse line of action that is

 d(z) = eps(z) s_C + tan(beta_b) integral_0^z eps dz',    eps = alpha_L dT,    s_C = r_w sin(alpha_wt).

The first term is the growth of the radius, the second the growth in length, which shifts the helix.
"""

from math import sin, tan

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.gears.pair import GearPair
from solvers.quantity import quantity, record

EXPANSION = 12e-6  # of steel, 1/K


@record
class LeadCurves:
    """Along the face, each (slices,) [m]: positions, growth d, its radial part alone, the correction."""

    position: FloatArray = quantity("position on the pinion", "z", unit="mm", text="from the end that meshes first")
    growth: FloatArray = quantity(
        "thermal growth",
        "d",
        unit="um",
        text="thermal growth along the transverse line of action, of radius and length",
        axis="position",
    )
    radial_only: FloatArray = quantity(
        "radial thermal growth", "d_r", unit="um", text="the part of the larger radius alone", axis="position"
    )
    correction: FloatArray = quantity("lead correction", "C", unit="um", text="what undoes the growth", axis="position")


@record
class LeadCorrection:
    """Range of the growth [m], and slope and crown of the parabola fitted to the correction by least squares [m].

    Slope is its rise from the end that meshes first to the other, crown the height of its middle above its ends.
    """

    range: float = quantity("range of the thermal growth", "C_r", unit="um")
    slope: float = quantity(
        "slope of the lead correction", "C_H", unit="um", text="rise of the fitted parabola, front to rear"
    )
    crown: float = quantity(
        "crown of the lead correction", "C_c", unit="um", text="height of its middle above its ends"
    )
    curves: LeadCurves = quantity("along the pinion's face", detail="curves")


def lead_correction(pair: GearPair, position: FloatArray, temperature_rise: FloatArray) -> LeadCorrection:
    """Correction for metal that warms as much as the gas; position [m] and rise [K] are (slices,) (Eq. P12).

    It scales with the wall's response, which only measurements give.
    """
    strain = EXPANSION * temperature_rise
    radial = strain * pair.pinion_working_radius * sin(pair.working_pressure_angle)
    growth = radial + tan(pair.base_helix_angle) * _elongation(position, strain)
    correction = -(growth - growth.min())
    place = position / pair.inputs.face_width - 0.5
    degree = min(position.size - 1, 2)
    curvature, slope, _ = np.concatenate([np.zeros(2 - degree), np.polyfit(place, correction, degree)])
    return LeadCorrection(
        range=float(np.ptp(growth)),
        slope=float(slope),
        crown=float(-curvature / 4),
        curves=LeadCurves(frozen(position), frozen(growth), frozen(radial), frozen(correction)),
    )


def _elongation(position: FloatArray, strain: FloatArray) -> FloatArray:
    """Integral of the strain from the end of the face to each position [m]: linear between positions and over grooves.

    Between the end and the first position the strain is that of the first.
    """
    parts = 0.5 * (strain[1:] + strain[:-1]) * np.diff(position)
    elongation: FloatArray = strain[0] * position[0] + np.concatenate([[0.0], np.cumsum(parts)])
    return elongation
