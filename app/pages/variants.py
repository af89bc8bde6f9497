"""Three or more variants of a case in a small table: the inputs that differ and the headline numbers."""

from collections.abc import Iterable
from functools import lru_cache
from typing import Any, NamedTuple

from app.calculations import BY_PATH
from app.pages.cases import REFUSED, Asked, SolvedCase, faults_of, solved
from app.pages.query import Pairs, normalised, pairs_of_query, split_views
from app.pages.results import DIGITS, ResultRow, resolved, row_of, values_by_path
from app.schema.fields import headlines, leaf_at

SEPARATOR = "|"
"""Separator of the queries in the query field `also`. Each of these queries describes a further variant."""
MOST = 5  # largest number of further variants
NAMES = "BCDEFG"
KEPT = 64  # number of variants whose inputs and results a worker keeps


class VariantColumn(NamedTuple):
    """A variant of a case: its name, its address, its inputs and its results.

    If the variant has no values, `trouble` says why.
    """

    name: str
    address: str
    inputs: dict[str, Any]
    results: dict[str, Any]
    trouble: str = ""


class VariantRow(NamedTuple):
    """One row of the table of variants: a quantity, and one text for each variant."""

    row: ResultRow
    texts: list[str]


class Variants(NamedTuple):
    """The table of the variants. Each variant is a column; each input and each result that differs is a row."""

    columns: list[VariantColumn]
    inputs: list[VariantRow]
    results: list[VariantRow]


def queries_of(asked: Asked) -> list[str]:
    """Return the queries of the further variants, that is, of all variants except the first."""
    return [query for query in asked.views.get("also", "").split(SEPARATOR) if query][:MOST]


def with_this(asked: Asked) -> str:
    """Return the text of the query field `also`, with the case added as a further variant."""
    queries = queries_of(asked)
    return SEPARATOR.join([*queries, asked.query]) if len(queries) < MOST and asked.query not in queries else ""


def variants_of(asked: Asked, case: SolvedCase, first: SolvedCase | None) -> Variants | None:
    """Return one table with the first variant, the further variants and the case.

    Return None if there is no first variant or no further variant.
    """
    queries = queries_of(asked)
    if first is None or not queries:
        return None
    columns = [_column("variant A", asked, asked.ref, first)]
    for name, query in zip(NAMES, queries, strict=False):
        columns.append(_of_query(f"variant {name}", asked, query))
    columns.append(_column("this case", asked, asked.query, case))
    return _table(asked, columns)


def _of_query(name: str, asked: Asked, query: str) -> VariantColumn:
    try:
        inputs, results = _numbers(asked.path, query)
    except REFUSED as error:
        return VariantColumn(name, f"{asked.path}?{query}", {}, {}, faults_of(error, asked.calculation)[0].message)
    return VariantColumn(name, f"{asked.path}?{query}", inputs, results)


@lru_cache(maxsize=KEPT)
def _numbers(path: str, query: str) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return the inputs and the results of a variant; raise the same errors as `solved`.

    Inputs and results are cached because the page needs them again after every edit of the case.
    """
    calculation = BY_PATH[f"/v1{path}"]
    pairs: Pairs = split_views(normalised(calculation.request, pairs_of_query(query)))[0]
    response = solved(calculation, pairs, None, "summary").response
    return resolved(response), values_by_path(response)


def _column(name: str, asked: Asked, query: str, case: SolvedCase) -> VariantColumn:
    return VariantColumn(name, f"{asked.path}?{query}", resolved(case.response), values_by_path(case.response))


def _table(asked: Asked, columns: list[VariantColumn]) -> Variants:
    """Return the table of the inputs and the headline numbers that differ between variants."""
    filled = [column for column in columns if not column.trouble]
    request, response = asked.calculation.request, asked.calculation.response
    paths = dict.fromkeys(path for column in filled for path in column.inputs)
    differing = [path for path in paths if len({repr(column.inputs.get(path)) for column in filled}) > 1]
    inputs = [row_of(leaf, path) for path in differing if (leaf := leaf_at(request, path))]
    results = [row_of(leaf, leaf.path) for leaf in headlines(response)]
    found = [VariantRow(row, _texts(row, (column.results for column in columns))) for row in results]
    return Variants(
        columns,
        [VariantRow(row, _texts(row, (column.inputs for column in columns))) for row in inputs],
        [row for row in found if len(set(row.texts)) > 1],
    )


def _texts(row: ResultRow, columns: Iterable[dict[str, Any]]) -> list[str]:
    return [row_of(row.leaf, row.path, values.get(row.path), digits=DIGITS + 1).value for values in columns]
