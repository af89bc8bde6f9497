"""Statements with numbers from papers, books and standards, and the numbers that the solvers compute for comparison.

`STATEMENTS` holds all statements. Both the pages of the service and the tests use `STATEMENTS`.
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
