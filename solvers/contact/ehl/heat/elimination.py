"""The linearised heat of one column solved: tridiagonal, with a rank-one part for the stress that the column shares."""

from solvers.arrays import FloatArray
from solvers.compiled import inlined_kernel
from solvers.contact.ehl.film.fluxes import BY_G, BY_H, BY_P
from solvers.contact.ehl.film.shear import Film
from solvers.contact.ehl.heat.balance import HEATING, Heat


@inlined_kernel
def factor_column(i: int, film: Film, heat: Heat) -> None:
    """Thomas factorisation of column i with its four responses, and the Sherman-Morrison term of the rank-one part.

    In place: `pivot` becomes the inverse pivots, `lower` and `upper` the factors by which a row takes part in the next
    and in the one before. The rank-one part carries what keeps a sliding film from running away: warmer oil shears at
    less stress.
    """
    column, by_temperature = heat.column, film.mid.by_temperature
    lower, pivot, upper, responses = column.lower, column.pivot, column.upper, column.responses
    m = film.shear.stress.shape[1]
    inverse = 1.0 / pivot[i, 0]
    pivot[i, 0] = inverse
    for k in range(1, m + 1):
        passed_on = lower[i, k] * inverse
        inverse = 1.0 / (pivot[i, k] - passed_on * upper[i, k - 1])
        upper[i, k - 1] *= pivot[i, k - 1]
        lower[i, k], pivot[i, k] = passed_on, inverse
        for c in range(4):
            responses[i, k, c] += passed_on * responses[i, k - 1, c]
    heating, p, g, h = 0.0, 0.0, 0.0, 0.0
    shared, by_p, by_g, by_h = 1.0, 0.0, 0.0, 0.0
    for k in range(m, -1, -1):
        inverse, passed_back = pivot[i, k], upper[i, k]
        heating = responses[i, k, HEATING] * inverse + passed_back * heating
        p = responses[i, k, BY_P] * inverse + passed_back * p
        g = responses[i, k, BY_G] * inverse + passed_back * g
        h = responses[i, k, BY_H] * inverse + passed_back * h
        responses[i, k, HEATING], responses[i, k, BY_P] = heating, p
        responses[i, k, BY_G], responses[i, k, BY_H] = g, h
        shared += by_temperature[i, k] * heating
        by_p += by_temperature[i, k] * p
        by_g += by_temperature[i, k] * g
        by_h += by_temperature[i, k] * h
    sherman = 1.0 / shared
    column.sherman[i] = sherman
    for k in range(m + 1):
        heating = responses[i, k, HEATING] * sherman
        responses[i, k, BY_P] -= heating * by_p
        responses[i, k, BY_G] -= heating * by_g
        responses[i, k, BY_H] -= heating * by_h


@inlined_kernel
def solve_column(i: int, film: Film, heat: Heat, vector: FloatArray) -> None:
    """Solve the linearised column i for row i of `vector` (n, k), in place."""
    column, by_temperature = heat.column, film.mid.by_temperature
    lower, pivot, upper, responses = column.lower, column.pivot, column.upper, column.responses
    m = vector.shape[1] - 1
    value = vector[i, 0]
    for k in range(1, m + 1):
        value = vector[i, k] + lower[i, k] * value
        vector[i, k] = value
    value, shared = 0.0, 0.0
    for k in range(m, -1, -1):
        value = vector[i, k] * pivot[i, k] + upper[i, k] * value
        vector[i, k] = value
        shared += by_temperature[i, k] * value
    shared *= column.sherman[i]
    for k in range(m + 1):
        vector[i, k] -= responses[i, k, HEATING] * shared
