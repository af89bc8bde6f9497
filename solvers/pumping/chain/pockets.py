"""The pockets of a chain, as the compiled kernels of its steps share them."""

from typing import NamedTuple

import numpy as np

from solvers.arrays import FloatArray

PRESSURE, CONTENT = range(2)  # of a pocket, and columns of Newton's blocks
MASS, HEAT = range(2)  # of flows and balances, and rows of Newton's blocks
START, END = range(2)  # of a step


class Pockets(NamedTuple):
    """Arrays of a chain.

    `old` and `new` (pockets, 2): pressure [Pa], mass [kg/m]; `area` (pockets, 2) at the start and the end of the step
    [m^2] and `gap` [m] at its end; `opening` (faces) [m^2]; `flow` (faces, 2) mass and heat towards the high end
    [kg/s, W], `leak` (pockets, 2) outwards [kg/(s m), W/m]; `residual` (pockets, 2), `lower`, `diagonal`, `upper`
    (pockets, 2, 2) and `correction` (pockets, 2) of Newton's method, `trial` (pockets, 2) its candidate, `error` (1,)
    its largest residual relative to the ambient content. Kernels unpack what their loops use: an array fetched from
    here within a loop is counted up and down each time, which cost half of the march.
    """

    old: FloatArray
    new: FloatArray
    area: FloatArray
    gap: FloatArray
    opening: FloatArray
    flow: FloatArray
    leak: FloatArray
    residual: FloatArray
    lower: FloatArray
    diagonal: FloatArray
    upper: FloatArray
    correction: FloatArray
    trial: FloatArray
    error: FloatArray


def empty_pockets(pockets: int) -> Pockets:
    """Arrays for so many pockets."""
    two, blocks = (pockets, 2), (pockets, 2, 2)
    return Pockets(
        old=np.zeros(two),
        new=np.zeros(two),
        area=np.zeros(two),
        gap=np.zeros(pockets),
        opening=np.zeros(pockets + 1),
        flow=np.zeros((pockets + 1, 2)),
        leak=np.zeros(two),
        residual=np.zeros(two),
        lower=np.zeros(blocks),
        diagonal=np.zeros(blocks),
        upper=np.zeros(blocks),
        correction=np.zeros(two),
        trial=np.zeros(two),
        error=np.zeros(1),
    )
