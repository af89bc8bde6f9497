"""Thermal growth of the pinion's flanks along the face, and the lead correction that compensates this growth.

A heated body keeps its shape and grows. A point moves radially by eps times its distance from the axis, and axially by
eps times its distance from the end z = 0; no angle changes. Along the transverse line of action a flank moves by

 d(z) = eps(z) s_C + tan(beta_b) integral_0^z eps dz',    eps = alpha_L dT,    s_C = r_w sin(alpha_wt).

Here alpha_L is the coefficient of thermal expansion, dT is the temperature rise, r_w is the working pitch radius,
alpha_wt is the working transverse pressure angle, and beta_b is the base helix angle. The first term is the growth of
the radius. The second term is the growth in length, which shifts the helix. The derivation is our own.
"""

from math import sin, tan

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.gears.pair import GearPair
from solvers.quantity import quantity, record

EXPANSION = 12e-6  # thermal expansion of steel, 1/K


@record
class LeadCurves:
    """Curves along the face, (slices,) [m]."""

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
    correction: FloatArray = quantity(
        "lead correction", "C", unit="um", text="lead correction that compensates the thermal growth", axis="position"
    )


@record(equation="P12")
class LeadCorrection:
    """Range of the thermal growth, and slope and crown of the correction [m].

    Of the least-squares parabola: its rise from the end that meshes first, its middle above the mean of its ends.
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
    """Lead correction for teeth that warm as much as the gas [m] (Eq. P12).

    If they warm by a share, times that share, which is known by measurement alone.
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
    """Growth in length [m] from z = 0 to each position; the strain is linear between positions."""
    parts = 0.5 * (strain[1:] + strain[:-1]) * np.diff(position)
    elongation: FloatArray = strain[0] * position[0] + np.concatenate([[0.0], np.cumsum(parts)])
    return elongation
