"""Curves over the face at equidistant stations, linear between them: mean, slope and crown by exact integrals."""

import numpy as np

from solvers.arrays import FloatArray


def face_mean(values: FloatArray) -> float:
    """Mean over the face."""
    return float(np.trapezoid(values) / (values.size - 1))


def face_slope(values: FloatArray) -> float:
    """Rise from y = 0 to b of the straight line of least squares: 12 int (eta - 1/2) v d eta (Eq. D13)."""
    eta, value, weight = _gauss(values)
    return float(12 * np.sum(weight * (eta - 0.5) * value))


def face_crown(values: FloatArray) -> float:
    """C of C (2 eta - 1)^2 by least squares: (15/2) int P2(2 eta - 1) v d eta, P2 = (3 t^2 - 1) / 2 (Eq. D13)."""
    eta, value, weight = _gauss(values)
    return float(7.5 * np.sum(weight * (1.5 * (2 * eta - 1) ** 2 - 0.5) * value))


def _gauss(values: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Two Gauss points an interval, exact up to cubes: places, values there and weight."""
    steps = values.size - 1
    shares = np.array([0.5 - 0.5 / np.sqrt(3), 0.5 + 0.5 / np.sqrt(3)])
    eta = (np.arange(steps)[:, None] + shares) / steps
    value = values[:-1, None] + shares * np.diff(values)[:, None]
    return eta, value, 0.5 / steps
