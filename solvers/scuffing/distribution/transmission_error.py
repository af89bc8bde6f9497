"""Transmission error over one base pitch: its variation and its mesh harmonics."""

import numpy as np
from numpy.typing import NDArray

from solvers.arrays import FloatArray, frozen
from solvers.scuffing.balance.load_balance import LoadBalance
from solvers.scuffing.results import ErrorCurves, TransmissionError

HARMONICS = 5


def transmission_error(balance: LoadBalance) -> TransmissionError:
    """TE along the transverse line of action [m]; means and harmonics by trapezia over the roll positions.

    The trapezia honour the jumps of spur gears, which stand twice in the grid.
    """
    error, phase = balance.transmission_error, balance.rolls.phase
    return TransmissionError(
        peak_to_peak=float(np.ptp(error)),
        mean=period_mean(error, phase),
        min=float(error.min()),
        max=float(error.max()),
        harmonics=frozen(2 * np.abs(_fourier(error, phase))),
        curves=ErrorCurves(frozen(phase / phase[-1]), frozen(error)),
    )


def period_mean(values: FloatArray, phase: FloatArray) -> float:
    """Mean over one base pitch."""
    return float(np.trapezoid(values, phase) / phase[-1])


def _fourier(values: FloatArray, phase: FloatArray) -> NDArray[np.complex128]:
    """Complex Fourier coefficients c_1, c_2, ... of a function of the roll position; wave k is the first to the k."""
    waves = np.cumprod(np.tile(np.exp(-2j * np.pi * phase / phase[-1]), (HARMONICS, 1)), axis=0)
    return np.asarray(np.trapezoid((values - values.mean()) * waves, phase) / phase[-1])
