"""The views of a case: page, answer, figure and report. Workers make the views and return the views as bytes."""

import json
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from http import HTTPStatus
from typing import Any, Literal

from app.calculations import BY_PATH, Calculation, card_of
from app.errors import Unreadable
from app.evaluate import written as json_written
from app.figures import Format, written
from app.pages import csv
from app.pages import report as reports
from app.pages.carried import offers, use_in, uses
from app.pages.cases import REFUSED, Asked, FormFault, SolvedCase, faults_of, key_of, solved
from app.pages.charts import figure_of, figures_of, for_phones, linked, values_of
from app.pages.form import FormState, form
from app.pages.manual import chapter_of
from app.pages.pair_path import assumed_of, path_of
from app.pages.query import Pairs, excluded, link, with_pairs_apart
from app.pages.results import (
    assumptions,
    beside,
    cards,
    conclusion,
    differences,
    differing,
    groups,
    parts,
    resolved,
    verdict,
    warned,
)
from app.pages.study_links import studies_of_case, study_links
from app.pages.templating import example_link, examples_of, page_path, rendered
from app.pages.typed import as_typed, question
from app.pages.typesetting import NO_VALUE
from app.pages.variants import variants_of, with_this
from app.schema.fields import headlines, is_below, leaf_at

FIRST_FIGURES = 4  # figures that a page shows; the others are folded


@dataclass(frozen=True, slots=True)
class Shown:
    """A view as bytes. `keep` holds the answers that the service stores for later views, under their keys."""

    content: bytes
    status: int = 200
    keep: dict[str, bytes] = field(default_factory=dict)


def page(asked: Asked) -> Shown:
    """Return the page of a case: the form and the result, or the form and its faults."""
    if not asked.pairs and not asked.pressed:
        return form_page(asked)
    texts = _texts(asked)
    try:
        case, variant, trouble = _both(asked)
    except REFUSED as error:
        faults = _asked_back(asked.pairs, faults_of(error, asked.calculation))
        said = {path: "; ".join(fault.message for fault in faults if fault.path == path) for path, _ in faults}
        return _page(asked, FormState(texts, said), 400 if isinstance(error, Unreadable) else 422, faults=faults)
    response = case.response
    asked = replace(asked, answered=(response.case, variant.response.case if variant else ""))
    answer = _answered(asked, case, variant, trouble)
    return _page(
        asked,
        FormState(texts, {}, resolved(response), {assumption.field for assumption in response.assumptions}),
        keep=_keep(asked, case, variant),
        **answer,
        charts=[linked(declaration, figure, asked) for declaration, figure in answer["figures"]],
        ready=studies_of_case(asked.calculation, asked.pairs, response.inputs, resolved(response), asked.carried),
        curves=csv.curves(response),
        sent=reports.body_of(case),
        code={
            "Python": reports.for_python(reports.LOCAL + asked.root, case),
            "curl": reports.for_shell(reports.LOCAL + asked.root, case),
        },
    )


def summary(asked: Asked) -> Shown:
    """Return the verdict and the headline numbers of a case, or why it is refused, as JSON."""
    try:
        case = solved(asked.calculation, asked.pairs, asked.kept, "summary")
    except REFUSED as error:
        reasons = [fault.message for fault in faults_of(error, asked.calculation)]
        return Shown(json.dumps({"trouble": "; ".join(dict.fromkeys(reasons))}).encode())
    response = case.response
    tiles = cards(response, resolved(response))
    found = [{"label": each.label, "text": each.value, "unit": each.unit, "level": each.level} for each in tiles]
    said = {"trouble": "", "verdict": verdict(response).text, "cards": found}
    return Shown(json.dumps(said).encode(), keep=_keep(asked, case))


def handed_on(asked: Asked, other: str) -> Shown:
    """Return the address of the page of the calculation `other`, to which the answer of the case hands on its results.

    If the case is refused or has no solution, return its page, which says why.
    """
    try:
        case = solved(asked.calculation, asked.pairs, asked.kept)
    except REFUSED:
        return page(asked)
    if case.response.status == "no_solution":
        return page(asked)
    return Shown(
        use_in(asked, BY_PATH[other], case.response).address.encode(), HTTPStatus.SEE_OTHER, _keep(asked, case)
    )


def form_page(asked: Asked) -> Shown:
    """Return the page with the form as it was filled in, without an answer."""
    return _page(asked, FormState(_texts(asked)))


def _texts(asked: Asked) -> dict[str, str]:
    """Return the texts of the form's fields."""
    return {name: as_typed(text) for name, text in with_pairs_apart(asked.calculation.request, asked.pairs)}


def _deciding(calculation: Calculation) -> frozenset[str]:
    """Return the inputs without which a headline number has no value."""
    needed = (leaf_at(calculation.request, leaf.view.needs or "") for leaf in headlines(calculation.response))
    return frozenset(path for leaf in needed if leaf for path in (leaf.path, *excluded(leaf.path, leaf)))


def result(asked: Asked, media: Literal["json", "csv"]) -> Shown:
    """Return the JSON answer of the API, or a CSV table. The table contains all values, or only one curve."""
    case = solved(asked.calculation, asked.pairs, asked.kept, "curves" if media == "json" else "fields")
    if media == "json":
        content = json_written(case.response)
    elif (path := asked.views.get("curve")) is None:
        content = csv.values(case, asked.title)
    else:
        content = csv.curve(case.response, path)
    return Shown(content, keep=_keep(asked, case))


def figure(asked: Asked, name: str, image_format: Format | Literal["json"]) -> Shown:
    """Return the file of a figure: an image, or a JSON file of the values that the script of the pages needs."""
    case, variant, _ = _both(asked)
    declaration = next(declaration for declaration in asked.calculation.figures if declaration.name == name)
    data = figure_of(declaration, case, variant)
    if image_format == "json":
        return Shown(values_of(data), keep=_keep(asked, case, variant))
    placed = for_phones(data) if asked.views.get("narrow") else data
    content = written(placed, image_format, asked.theme or "light")
    return Shown(content, keep=_keep(asked, case, variant))


def report(
    asked: Asked,
    host: str,
    study: dict[str, Any] | None = None,
    steps: Sequence[dict[str, Any]] = (),
    sheet: Any = None,
) -> Shown:
    """Return the report of a case, with what belongs to it.

    `study` is a section about a study, `steps` are other calculations of the same gear pair, and `sheet` is the table
    of what to grind.
    """
    try:
        case, variant, trouble = _both(asked)
    except REFUSED:
        return page(asked)
    content = rendered(
        "report.html",
        asked.root,
        asked=asked,
        calculation=asked.calculation,
        **_answered(asked, case, variant, trouble, compute=True),
        study=study,
        steps=steps,
        sheet=sheet,
        **reports.context(asked, case, host),
    )
    return Shown(content.encode(), keep=_keep(asked, case, variant))


def _asked_back(pairs: Pairs, faults: list[FormFault]) -> list[FormFault]:
    """Return the faults; if the text of a field has two readings, replace the faults of this field by a question."""
    asked = {name: question(text) for name, text in pairs if question(text)}
    named = ((next((name for name in asked if is_below(fault.path, name)), ""), fault) for fault in faults)
    return [*dict.fromkeys(FormFault(name, asked[name]) if name else fault for name, fault in named)]


def _keep(asked: Asked, case: SolvedCase, variant: SolvedCase | None = None) -> dict[str, bytes]:
    """Return the answers that the service shall store, under their keys."""
    keep = {}
    for pairs, kept, answered in (asked.pairs, asked.kept, case), (asked.ref_pairs, asked.kept_ref, variant):
        if answered is not None and kept is None:
            keep[key_of(asked.path, pairs)] = answered.kept
        if answered is not None and asked.too_long:
            keep[key_of(asked.path, [("case", answered.response.case)])] = answered.kept
    return keep


def _page(
    asked: Asked, state: FormState, status: int = 200, keep: dict[str, bytes] | None = None, **answer: Any
) -> Shown:
    calculation, typical = asked.calculation, assumed_of(asked)
    rules = {name: rule.rule for name, rule in typical.fields.items()} if typical else {}
    state = replace(state, deciding=_deciding(calculation), endpoint=calculation.path, rules=rules)
    context = {"faults": [], "response": None, "compared": False, "cards": (), "trouble": "", **answer}
    content = rendered(
        "calculation.html",
        asked.root,
        asked=asked,
        calculation=calculation,
        chapter=chapter_of(calculation).name,
        sections=form(calculation.request, state),
        examples=[(example, example_link(calculation, example)) for example in examples_of(calculation)],
        studies=study_links(calculation),
        subject=card_of(calculation).subject,
        uses=[] if asked.too_long else uses(asked, context["response"]),
        offers=[] if asked.too_long else offers(asked),
        first_figures=FIRST_FIGURES,
        headlines=headlines(calculation.response),
        path=[] if asked.too_long else path_of(asked),
        typical=typical,
        **context,
    )
    return Shown(content.encode(), status, keep or {})


def _answered(
    asked: Asked, case: SolvedCase, variant: SolvedCase | None, trouble: str, *, compute: bool = False
) -> dict[str, Any]:
    """Return the template's variables for the answer of a case and for the comparison of the case with the variant."""
    figures, missing = figures_of(case, variant, compute=compute)
    request, response, before = type(case.request), case.response, variant.response if variant else None
    derived = groups(response.derived) if response.derived else {}
    tables, alike = groups(response, before), 0
    if before is not None:
        tables, alike = differing(tables)
    return {
        "response": response,
        "cards": cards(response, resolved(response), before),
        "verdict": verdict(response),
        "conclusion": conclusion(response),
        "warned": warned(request, response),
        "variants": variants_of(asked, case, variant),
        "another": link(asked.path, asked.pairs, ref=asked.ref, also=with_this(asked), theme=asked.theme),
        "assumed": assumptions(request, response),
        "groups": tables,
        "parts": parts(response, tables),
        "alike": alike,
        "beside": beside(response) if response.status != "no_solution" else [],
        "derived": [row for rows in derived.values() for row in rows if row.value != NO_VALUE],
        "elsewhere": _elsewhere(asked),
        "compared": variant is not None,
        "trouble": trouble,
        "figures": figures,
        "missing": missing,
        "differences": differences(request, response, before) if before else [],
    }


def _elsewhere(asked: Asked) -> list[tuple[str, str, list[str]]]:
    """Return the other calculations whose pages show further figures of the case."""
    pages, declarations = [], asked.calculation.figures
    for path in dict.fromkeys(declaration.shown_at for declaration in declarations if declaration.shown_at):
        other = BY_PATH[path]
        pairs = [(name, text) for name, text in asked.pairs if leaf_at(other.request, name)]
        address = link(page_path(other), pairs, theme=asked.theme)
        titles = [declaration.title for declaration in declarations if declaration.shown_at == path]
        pages.append((other.title, address, titles))
    return pages


def _both(asked: Asked) -> tuple[SolvedCase, SolvedCase | None, str]:
    """Return the case, the variant for comparison with the case, and the reason why the variant cannot be computed.

    The variant is None if the query names no variant, or if the variant cannot be computed. The reason is empty if the
    variant can be computed, or if the query names no variant.
    """
    case = solved(asked.calculation, asked.pairs, asked.kept)
    if not asked.ref and asked.kept_ref is None:
        return case, None, ""
    try:
        return case, solved(asked.calculation, asked.ref_pairs, asked.kept_ref), ""
    except REFUSED as error:
        return case, None, faults_of(error, asked.calculation)[0].message
