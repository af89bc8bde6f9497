"""The report of a case with the other calculations of its gear pair: one document for all steps of the path."""

from collections.abc import Sequence
from typing import Any

from app.calculations import BY_PATH, card_of
from app.pages.carried import carried_to, missing
from app.pages.cases import REFUSED, Asked, faults_of, solved
from app.pages.charts import figures_of
from app.pages.pair_path import PUMPING, SCUFFING, TRAIN, WITH_PAIR
from app.pages.results import cards, conclusion, resolved, verdict
from app.pages.studies.design import grinding_sheet
from app.pages.studies.page import Table
from app.pages.views import Shown, report

QUESTIONS = {SCUFFING: "Safe?", PUMPING: "Choked?"}
MOST_FIGURES = 4  # of each other calculation


def others_of(asked: Asked) -> list[Asked]:
    """Return the cases of the other calculations that the report of a case contains; none unless it asks for them."""
    if asked.views.get("extent") != WITH_PAIR or card_of(asked.calculation).subject != "pair":
        return []
    return [carried_to(asked, BY_PATH[path]) for path in QUESTIONS if path != asked.calculation.path]


def report_of(asked: Asked, host: str, others: Sequence[Asked]) -> Shown:
    """Return the report of a case with other calculations of the pair. The answers are kept with the cases."""
    return report(asked, host, steps=[_step(other) for other in others], sheet=_sheet(asked) if others else None)


def _step(there: Asked) -> dict[str, Any]:
    """Return what the report says of another calculation of the pair, or why there is nothing to say."""
    calculation, path = there.calculation, there.calculation.path
    step = {"question": QUESTIONS[path], "title": calculation.title, "address": there.page, "trouble": "", "cards": ()}
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
        "verdict": verdict(response).text or response.warnings[0].message,
        "conclusion": conclusion(response),
        "cards": tiles,
        "warnings": response.warnings,
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
    return None if case.response.status == "no_solution" else grinding_sheet(case)
