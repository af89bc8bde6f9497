"""Numbers from papers, books and standards, beside the numbers that the solvers compute.

The pages of the service and the tests read the same table.
"""

from solvers.published import coupling, micropitting, pumping, scuffing
from solvers.published.statement import Row, Statement

STATEMENTS: dict[str, tuple[Statement, ...]] = {
    "coupling": coupling.STATEMENTS,
    "pumping": pumping.STATEMENTS,
    "scuffing": scuffing.STATEMENTS,
    "micropitting": micropitting.STATEMENTS,
}

__all__ = ["STATEMENTS", "Row", "Statement"]
