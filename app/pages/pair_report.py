"""The report of a case with the other calculations of its gear pair: one document for all steps of the path."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from app.calculations import BY_PATH, card_of
from app.pages.carried import carried_to, missing
from app.pages.cases import REFUSED, Asked, SolvedCase, faults_of, solved
from app.pages.charts import figures_of
from app.pages.pair_path import PUMPING, SCUFFING, TRAIN, WITH_PAIR
from app.pages.results import cards, conclusion, resolved, verdict, warned
from app.pages.studies.design import SLOPE, grinding_sheet
from app.pages.studies.page import Table
from app.pages.views import Shown, report
from app.schema.fields import value_at

QUESTIONS = {SCUFFING: "Safe?", PUMPING: "Choked?"}
MOST_FIGURES = 4  # of each other calculation
ALONE = " (pair alone, aligned)"
WITHOUT_SLOPE = (
    "The pair alone, on aligned shafts and without helix slope: the slope takes back what shafts and heat of the unit "
    "bend, and would look wrong here."
)


def others_of(asked: Asked) -> list[Asked]:
    """Return the cases of the other calculations that the report of a case contains; none unless it asks for them."""
    if asked.views.get("extent") != WITH_PAIR or card_of(asked.calculation).subject != "pair":
        return []
    cases = [carried_to(asked, BY_PATH[path]) for path in QUESTIONS if path != asked.calculation.path]
    if asked.calculation.path != TRAIN:
        return cases
    return [replace(each, pairs=[pair for pair in each.pairs if pair[0] != SLOPE]) for each in cases]


def report_of(asked: Asked, host: str, others: Sequence[Asked]) -> Shown:
    """Return the report of a case with other calculations of the pair. The answers are kept with the cases."""
    return report(asked, host, steps=[_step(other, asked) for other in others], sheet=_sheet(asked) if others else None)


def _step(there: Asked, asked: Asked) -> dict[str, Any]:
    """Return what the report of `asked` says of another calculation of the pair, or why there is nothing to say."""
    calculation, path = there.calculation, there.calculation.path
    is_alone = path == SCUFFING and asked.calculation.path == TRAIN
    step = {
        "note": WITHOUT_SLOPE if is_alone and value_at(asked.body, SLOPE) else "",
        "question": QUESTIONS[path],
        "judged": ALONE if is_alone else "",
        "title": calculation.title,
        "address": there.page,
        "trouble": "",
        "cards": (),
    }
    if lacks := missing(there):
        return step | {"trouble": f"missing: {', '.join(lacks)}"}
    try:
        case = solved(calculation, there.pairs, there.kept)
    except REFUSED as error:
        return step | {"trouble": faults_of(error, calculation)[0].message}
    response = case.response
    figures, _ = figures_of(case, None, compute=True)
    tiles = cards(response, resolved(response))
    return step | {
        "verdict": verdict(response).text,
        "conclusion": conclusion(response),
        "cards": tiles,
        "warned": warned(calculation.request, response),
        "figures": figures[:MOST_FIGURES],
        "case": response.case,
    }


def _sheet(asked: Asked) -> Table | None:
    """Return what to grind on the gears of a unit; None for other calculations, and without a solution."""
    if asked.calculation.path != TRAIN:
        return None
    try:
        case = solved(asked.calculation, asked.pairs, asked.kept)
    except REFUSED:
        return None
    return grinding_sheet(case) if case.response.status != "no_solution" and _is_corrected(case) else None


def _is_corrected(case: SolvedCase) -> bool:
    """Whether the flanks of a case have any correction to grind."""
    given = value_at(case.request, "modifications").model_dump()
    every = given | (given.get("second_helix") or {})
    return any(value for name, value in every.items() if name.endswith("_um"))
