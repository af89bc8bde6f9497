"""What papers, books and standards say in numbers, beside what the solvers compute: one table for pages and tests."""

from solvers.published import coupling, micropitting, pumping, scuffing
from solvers.published.statement import Row, Statement

STATEMENTS: dict[str, tuple[Statement, ...]] = {
    "coupling": coupling.STATEMENTS,
    "pumping": pumping.STATEMENTS,
    "scuffing": scuffing.STATEMENTS,
    "micropitting": micropitting.STATEMENTS,
}

__all__ = ["STATEMENTS", "Row", "Statement"]
