"""The table of a chain of pockets, as the compiled kernels of its steps share it.

One array for all: of a group of arrays every kernel it is handed to counts each one up and down, which cost a quarter
of the march.
"""

import numpy as np

from solvers.arrays import FloatArray

PRESSURE, CONTENT = range(2)  # of a state, and columns of Newton's blocks
MASS, HEAT = range(2)  # of flows and balances, and rows of Newton's blocks
START, END = range(2)  # of a step

# Columns of the table, a row a pocket, two each. States (pressure [Pa], mass [kg/m]): OLD and NEW of a step, TRIAL of
# Newton's method. AREA at the start and the end of the step [m^2]; FLOW of mass and heat through the face below the
# pocket towards the high end [kg/s, W]; LEAK outwards [kg/(s m), W/m]; RESIDUAL and CORRECTION of Newton's method.
OLD, NEW, TRIAL, AREA, FLOW, LEAK, RESIDUAL, CORRECTION = range(0, 16, 2)
# Four each: Newton's blocks of two by two, by the pocket below, the pocket itself and the one above.
LOWER, DIAGONAL, UPPER = range(16, 28, 4)
# One each: the radial gap [m] and the section of the face below [m^2], at the end of the step.
GAP, OPENING = 28, 29
COLUMNS = 30


def empty_pockets(pockets: int) -> FloatArray:
    """A table for so many pockets, and a row more for the face above the last."""
    return np.zeros((pockets + 1, COLUMNS))
