"""Mean, slope and crown of curves over the face.

A curve is given by values at equidistant stations, and is linear between them. Its integrals are exact.
"""

import numpy as np

from solvers.arrays import FloatArray


def face_mean(values: FloatArray) -> float:
    """Return the mean over the face."""
    return float(np.trapezoid(values) / (values.size - 1))


def face_slope(values: FloatArray) -> float:
    """Compute the slope of a curve: the rise of the least-squares straight line over the whole face (Eq. D13)."""
    eta, value, weight = _gauss(values)
    return float(12 * np.sum(weight * (eta - 0.5) * value))


def face_crown(values: FloatArray) -> float:
    """Compute the crown of a curve: the height C of the parabola C (2 eta - 1)^2 with the best least-squares fit.

    Eq. D13. Returns height C, in the unit of the values v. The height is (15/2) int P2(2 eta - 1) v d eta with eta =
    y/b. Here P2(t) is (3 t^2 - 1) / 2.
    """
    eta, value, weight = _gauss(values)
    return float(7.5 * np.sum(weight * (1.5 * (2 * eta - 1) ** 2 - 0.5) * value))


def _gauss(values: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Return positions, values and weight of two Gauss points per interval of a piecewise linear curve."""
    steps = values.size - 1
    shares = np.array([0.5 - 0.5 / np.sqrt(3), 0.5 + 0.5 / np.sqrt(3)])
    eta = (np.arange(steps)[:, None] + shares) / steps
    value = values[:-1, None] + shares * np.diff(values)[:, None]
    return eta, value, 0.5 / steps
