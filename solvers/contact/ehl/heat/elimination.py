"""The linearised heat of one column solved: tridiagonal, with a rank-one part for the stress that the column shares."""

from solvers.arrays import FloatArray
from solvers.compiled import inlined_kernel
from solvers.contact.ehl.film.fluxes import BY_G, BY_H, BY_P
from solvers.contact.ehl.film.shear import Film
from solvers.contact.ehl.heat.balance import HEATING, Heat


@inlined_kernel
def factor_column(i: int, film: Film, heat: Heat) -> None:
    """Thomas factorisation of column i with its four responses, and the Sherman-Morrison term of the rank-one part.

    The rank-one part carries what keeps a sliding film from running away: warmer oil shears at less stress.
    """
    m = film.shear.stress.shape[1]
    column = heat.column
    responses = column.responses[i]
    for c in range(1, 4):
        for k in range(m + 1):
            responses[k, c] = -responses[k, c]
    column.pivot[i, 0] = 1.0 / column.pivot[i, 0]
    for k in range(1, m + 1):
        column.lower[i, k] *= -column.pivot[i, k - 1]
        column.upper[i, k - 1] = -column.upper[i, k - 1]
        column.pivot[i, k] = 1.0 / (column.pivot[i, k] - column.lower[i, k] * column.upper[i, k - 1])
        for c in range(4):
            responses[k, c] -= column.lower[i, k] * responses[k - 1, c]
    for c in range(4):
        responses[m, c] *= column.pivot[i, m]
    for k in range(m - 1, -1, -1):
        for c in range(4):
            responses[k, c] = (responses[k, c] - column.upper[i, k] * responses[k + 1, c]) * column.pivot[i, k]
    by_temperature = film.mid.by_temperature[i]
    heating, p, g, h = 1.0, 0.0, 0.0, 0.0
    for k in range(m + 1):
        heating += by_temperature[k] * responses[k, HEATING]
        p += by_temperature[k] * responses[k, BY_P]
        g += by_temperature[k] * responses[k, BY_G]
        h += by_temperature[k] * responses[k, BY_H]
    column.sherman[i] = 1.0 / heating
    for k in range(m + 1):
        responses[k, BY_P] -= responses[k, HEATING] * p / heating
        responses[k, BY_G] -= responses[k, HEATING] * g / heating
        responses[k, BY_H] -= responses[k, HEATING] * h / heating


@inlined_kernel
def solve_column(i: int, film: Film, heat: Heat, vector: FloatArray) -> None:
    """Solve the linearised column i for row i of `vector` (n, k), in place."""
    column, by_temperature = heat.column, film.mid.by_temperature
    m = vector.shape[1] - 1
    row, lower, upper, pivot = vector[i], column.lower[i], column.upper[i], column.pivot[i]
    for k in range(1, m + 1):
        row[k] -= lower[k] * row[k - 1]
    row[m] *= pivot[m]
    total = by_temperature[i, m] * row[m]
    for k in range(m - 1, -1, -1):
        row[k] = (row[k] - upper[k] * row[k + 1]) * pivot[k]
        total += by_temperature[i, k] * row[k]
    total *= column.sherman[i]
    for k in range(m + 1):
        row[k] -= column.responses[i, k, HEATING] * total
