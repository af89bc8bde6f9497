"""Every published statement in the comparison table of the pages holds."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from solvers.published import STATEMENTS, Statement

ROOT = Path(__file__).parents[2]
CITED = re.compile(r"(\w*)[ ,\"]*Eqs?\. (\d+)(?:( and |, |-)(\d+))?")

NAMED = [
    pytest.param(statement, id=f"{model}-{number}")
    for model, statements in STATEMENTS.items()
    for number, statement in enumerate(statements)
]


@pytest.mark.parametrize("statement", NAMED)
def test_statement_holds(statement: Statement) -> None:
    row = statement.row()
    assert row.holds, f"{row.statement} ({row.source}): printed {row.printed}, computed {row.computed:g} {row.unit}"


def test_every_model_has_statements_from_its_paper_and_from_elsewhere() -> None:
    papers = {"coupling": "Pahl", "pumping": "Milian", "scuffing": "Xue"}
    for model, paper in papers.items():
        sources = [statement.source for statement in STATEMENTS[model]]
        assert sum(source.startswith(paper) for source in sources) >= 10
        assert any(not source.startswith(paper) for source in sources)


def test_a_statement_that_is_not_reproduced_says_why() -> None:
    missed = [
        s for statements in STATEMENTS.values() for s in statements if s.number and not s.least <= s.number <= s.most
    ]
    assert missed
    assert all(statement.remark for statement in missed)


def equations(folder: str) -> Iterator[tuple[str, int]]:
    """Yield paper and number of every equation that the Python files in a folder name.

    The solvers need not name the paper, because the path of the file determines the paper.
    """
    for path in (ROOT / folder).rglob("*.py"):
        paper = "Milian" if "pumping" in str(path.relative_to(ROOT)) else "Xue"
        for word, first, joint, last in CITED.findall(path.read_text("utf-8")):
            numbers = range(int(first), int(last) + 1) if joint == "-" else {int(first), int(last or first)}
            yield from ((paper if folder == "solvers" else word, number) for number in numbers)


def test_every_equation_that_the_solvers_cite_is_named_by_a_test() -> None:
    cited, tested = set(equations("solvers")), set(equations("tests"))
    assert len(cited) > 25
    assert sorted(cited - tested) == []
