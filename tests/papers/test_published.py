"""Every published statement holds."""

import pytest

from benchmarks.published import STATEMENTS, Statement

NAMED = [
    pytest.param(statement, id=f"{model}-{number}")
    for model, statements in STATEMENTS.items()
    for number, statement in enumerate(statements)
]


@pytest.mark.parametrize("statement", NAMED)
def test_statement_holds(statement: Statement) -> None:
    row = statement.row()
    assert row.holds, f"{row.statement} ({row.source}): expected {row.expected}, computed {row.computed:g} {row.unit}"


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
