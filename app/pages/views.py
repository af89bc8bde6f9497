"""One view of one case, from its fields to bytes; runs in a worker."""

from dataclasses import dataclass, field, replace
from typing import Any, Literal, NamedTuple, get_args

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.errors import InvalidBody, Unprocessable, Unreadable
from app.evaluate import written as json_written
from app.figures.data import Figure, ThemeName
from app.figures.declaration import Declaration
from app.figures.rendering import Format, written
from app.pages import csv
from app.pages import report as reports
from app.pages.answers import key_of
from app.pages.cases import Case, Fault, faults_of, solved
from app.pages.charts import Chart, charts, data_address, figure_of, linked, values_of
from app.pages.code import for_python, for_shell, given
from app.pages.form import State, anchor, form
from app.pages.links import IMAGE_FORMATS, Links, example_link, examples_of
from app.pages.manual import chapter_of
from app.pages.query import Pairs, ambiguity, body_of, link, normalised, pairs_of_query, split_views
from app.pages.results import assumptions, cards, differences, entries, groups, resolved
from app.pages.study_links import studies_of_case, study_links
from app.pages.templating import page_path, rendered
from app.pages.typesetting import NO_VALUE
from app.schema.fields import branches, headlines, leaf_at
from app.schema.reading import validated
from app.sources import changes_since

BY_PAGE = {page_path(calculation): calculation for calculation in CALCULATIONS}
LOCAL = "http://localhost:8000"
LANGUAGES = (("Python", for_python), ("curl", for_shell))
REFUSED = (Unreadable, InvalidBody, Unprocessable)


@dataclass(frozen=True, slots=True)
class Asked:
    """A case to look at; `kept` and `kept_ref` are the answers of it and of its variant, if they are still known.

    `root` is the prefix that a proxy puts before the addresses of the service.
    """

    path: str
    pairs: Pairs
    views: dict[str, str] = field(default_factory=dict)
    kept: bytes | None = None
    kept_ref: bytes | None = None
    root: str = ""

    @property
    def calculation(self) -> Calculation:
        """What it is a case of."""
        return BY_PAGE[self.path]

    @property
    def body(self) -> dict[str, Any]:
        """The request body that the fields make; raises Unreadable."""
        return body_of(self.calculation.request, self.pairs)

    @property
    def case(self) -> dict[str, Any]:
        """The request with its defaults; as far as it is given where it is incomplete or refused."""
        try:
            return validated(self.calculation.request, self.body).model_dump()
        except InvalidBody:
            return self.body

    @property
    def theme(self) -> ThemeName | None:
        """The theme asked for; a page without one follows the reader's system."""
        return next((theme for theme in get_args(ThemeName) if theme == self.views.get("theme")), None)

    @property
    def title(self) -> str:
        """What its author calls the case."""
        return self.views.get("title", "")

    @property
    def outdated(self) -> list[str]:
        """What has changed since the link was made, as far as it names the solvers' sources."""
        return changes_since(self.views.get("sources", ""))

    @property
    def links(self) -> Links:
        """Where the views of the case are."""
        return Links(self.path, self.pairs, self.views.get("ref", ""), self.views.get("theme", ""), title=self.title)


@dataclass(frozen=True, slots=True)
class Shown:
    """A view; `keep` are answers to be kept, by their keys."""

    content: bytes
    status: int = 200
    keep: dict[str, bytes] = field(default_factory=dict)


def ref_pairs(calculation: Calculation, views: dict[str, str]) -> Pairs:
    """The fields of the variant to compare with."""
    return split_views(normalised(calculation.request, pairs_of_query(views.get("ref", ""))))[0]


def page(asked: Asked) -> Shown:
    """The page of a case: form and result, or the form and what is wrong with it."""
    if not asked.pairs:
        return form_page(asked)
    try:
        case = solved(asked.calculation, asked.pairs, asked.kept)
    except REFUSED as error:
        texts = dict(asked.pairs)
        faults = [
            Fault(path, ambiguity(texts.get(path, "")) or message)
            for path, message in faults_of(error, asked.calculation)
        ]
        state = State(dict(asked.pairs), _by_field(faults))
        return _page(asked, state, 400 if isinstance(error, Unreadable) else 422, faults=faults)
    variant, trouble = _variant(asked)
    links = replace(asked.links, case=case.response.case, ref_case=variant.response.case if variant else "")
    figures, missing = charts(
        _own_figures(asked),
        case,
        variant,
        lambda declaration, data: linked(declaration, data, links.image, asked.theme),
    )
    before = variant.response if variant else None
    used, assumed = resolved(case.response), assumptions(type(case.request), case.response)
    state = State(dict(asked.pairs), {}, used, {each.path for each in assumed})
    shown = _page(
        asked,
        state,
        links=links,
        response=case.response,
        cards=cards(case.response, used, before),
        assumed=assumed,
        groups=groups(case.response, before),
        derived=_derived(case),
        charts=figures,
        missing=missing,
        elsewhere=_elsewhere(asked),
        ready=studies_of_case(asked.calculation, asked.pairs, case.response.inputs),
        compared=before is not None,
        differences=differences(type(case.request), case.response, before) if before else None,
        trouble=trouble,
        curves=_curves(case),
        code=[(name, write(LOCAL + asked.root, case.calculation, given(case.request))) for name, write in LANGUAGES],
    )
    return replace(shown, keep=_keep(asked, case, variant, by_case=links.too_long))


def _own_figures(asked: Asked) -> list[Declaration]:
    """The figures that page and report show; those of other pages are a link."""
    return [each for each in asked.calculation.figures if not each.shown_at]


def _elsewhere(asked: Asked) -> list[tuple[str, str, list[str]]]:
    """The calculations whose pages show other figures of the case: title, address of the case there, the figures."""
    titles = dict[str, list[str]]()
    for each in asked.calculation.figures:
        if each.shown_at:
            titles.setdefault(each.shown_at, []).append(each.title)
    found = []
    for path, names in titles.items():
        other = BY_PATH[path]
        pairs = [(name, text) for name, text in asked.pairs if leaf_at(other.request, name)]
        found.append((other.title, link(page_path(other), pairs, theme=asked.views.get("theme", "")), names))
    return found


def form_page(asked: Asked) -> Shown:
    """The page with the form as it was filled in, and no answer."""
    return _page(asked, State(dict(asked.pairs)))


def result(asked: Asked, media: Literal["json", "csv"]) -> Shown:
    """The answer of the API, or its values as a table, or one of its curves."""
    case = solved(asked.calculation, asked.pairs, asked.kept)
    if media == "json":
        content = json_written(case.response, "curves")
    elif (path := asked.views.get("curve")) is None:
        content = csv.values(case, asked.title)
    else:
        found = csv.curve(case.response, path)
        if found is None:
            raise Unprocessable("unknown_curve", f"There are {', '.join(_curves(case))}", "curve")
        content = found
    return Shown(content, keep=_keep(asked, case))


def figure(asked: Asked, name: str, image_format: Format | Literal["json"]) -> Shown:
    """One figure as a file; as JSON what the script of the pages needs of it."""
    case = solved(asked.calculation, asked.pairs, asked.kept)
    variant, _ = _variant(asked)
    declaration = next(each for each in asked.calculation.figures if each.name == name)
    data = figure_of(declaration, case, variant)
    content = values_of(data) if image_format == "json" else written(data, image_format, asked.theme or "light")
    return Shown(content, keep=_keep(asked, case, variant))


class StudySection(NamedTuple):
    """What a report says of a study: figures by their names, tables as the study's page has them, the link to it."""

    title: str
    progress: str
    remarks: tuple[str, ...]
    figures: dict[str, Figure]
    tables: tuple[Any, ...]
    link: str

    @property
    def charts(self) -> list[Chart]:
        """The figures as they are printed."""
        return [_chart(name, figure) for name, figure in self.figures.items()]


def report(asked: Asked, host: str, study: StudySection | None = None) -> Shown:
    """The report of a case, with a section about a study; an input that cannot be computed is shown on its page.

    `host` is what addresses on it begin with; without one the link is relative, and the command asks this machine.
    """
    try:
        case = solved(asked.calculation, asked.pairs, asked.kept)
    except REFUSED:
        return page(asked)
    variant, trouble = _variant(asked)
    before = variant.response if variant else None
    figures, missing = charts(_own_figures(asked), case, variant, _printed, compute=True)
    own = "" if asked.links.too_long else host + asked.root + asked.links.page
    try:
        context = reports.context(case, asked.views, (host or LOCAL) + asked.root, own)
    except ValueError as error:
        raise Unprocessable("too_long", str(error), None) from error
    content = rendered(
        "report.html",
        asked.root,
        asked=asked,
        calculation=asked.calculation,
        response=case.response,
        cards=cards(case.response, resolved(case.response), before),
        assumed=assumptions(type(case.request), case.response),
        groups=groups(case.response, before),
        compared=before is not None,
        differences=differences(type(case.request), case.response, before) if before else None,
        trouble=trouble,
        derived=_derived(case),
        charts=figures,
        missing=missing,
        elsewhere=_elsewhere(asked),
        outdated=asked.outdated,
        study=study,
        host=host,
        **context,
    )
    return Shown(content.encode(), keep=_keep(asked, case, variant))


def _printed(declaration: Declaration, data: Figure | None) -> Chart:
    """A figure as a part of the report."""
    assert data is not None
    return _chart(declaration.name, data)


def _chart(name: str, figure: Figure) -> Chart:
    return Chart(name, figure.title, figure.subtitle, data_address(written(figure, "svg", "light")))


def case_key(path: str, case: str) -> str:
    """What an answer of a page's calculation is kept under that is asked for by its hash."""
    return key_of(path, [("case", case)])


def _keep(asked: Asked, case: Case, variant: Case | None = None, *, by_case: bool = False) -> dict[str, bytes]:
    """Answers that were not kept yet, by the keys of their fields; all of them by their hash too if asked for."""
    keep = {key_of(asked.path, asked.pairs): case.kept} if case.fresh else {}
    if variant is not None and variant.fresh:
        keep[key_of(asked.path, ref_pairs(asked.calculation, asked.views))] = variant.kept
    if by_case:
        keep |= {case_key(asked.path, each.response.case): each.kept for each in (case, variant) if each is not None}
    return keep


def _page(asked: Asked, state: State, status: int = 200, **found: Any) -> Shown:
    calculation = asked.calculation
    context = {
        "faults": [],
        "response": None,
        "compared": False,
        "cards": (),
        "trouble": "",
        "links": asked.links,
        **found,
    }
    sections = form(calculation.request, state)
    content = rendered(
        "calculation.html",
        asked.root,
        calculation=calculation,
        path=asked.path,
        chapter=chapter_of(calculation).name,
        sections=sections,
        outdated=asked.outdated,
        theme=asked.views.get("theme", ""),
        case_title=asked.title,
        ref=asked.views.get("ref", ""),
        examples=[(example, example_link(calculation, example)) for example in examples_of(calculation)],
        formats=IMAGE_FORMATS,
        studies=study_links(calculation),
        headlines=headlines(calculation.response),
        field_link=lambda path: _place(calculation, path),
        field_title=lambda path: title_of(calculation, path),
        **context,
    )
    return Shown(content.encode(), status)


def _variant(asked: Asked) -> tuple[Case | None, str]:
    """The case to compare with, or why it cannot be computed."""
    if not asked.views.get("ref") and asked.kept_ref is None:
        return None, ""
    try:
        return solved(asked.calculation, ref_pairs(asked.calculation, asked.views), asked.kept_ref), ""
    except REFUSED as error:
        return None, faults_of(error, asked.calculation)[0].message


def _by_field(faults: list[Fault]) -> dict[str, str]:
    """Messages by the path of their field; several messages of one field are joined."""
    found: dict[str, str] = {}
    for fault in faults:
        if fault.path:
            found[fault.path] = f"{found[fault.path]}; {fault.message}" if fault.path in found else fault.message
    return found


def _derived(case: Case) -> tuple[Any, ...]:
    """Title, symbol, value and unit of what was computed before the physics."""
    if case.response.derived is None:
        return ()
    return tuple(row for group in groups(case.response.derived) for row in group.rows if row.value != NO_VALUE)


def _curves(case: Case) -> list[str]:
    """What `curve=` can name."""
    return list(
        dict.fromkeys(
            e.path.rpartition(".")[0] if "." in e.path else e.path
            for _, e in entries(case.response)
            if e.leaf.dimensions == 1 and e.value is not None and e.leaf.kind in {"number", "integer"}
        )
    )


def _place(calculation: Calculation, path: str) -> str:
    """Where on the page the field is, or the next section above it."""
    known = branches(calculation.request)
    while path and leaf_at(calculation.request, path) is None and path not in known:
        path = path.rpartition(".")[0]
    return f"#{anchor(path)}" if path else "#form"


def title_of(calculation: Calculation, path: str) -> str:
    """What people call the field; a section is called by those around it too."""
    leaf = leaf_at(calculation.request, path)
    if leaf is not None:
        return leaf.title
    parts, known = path.split("."), branches(calculation.request)
    around = [".".join(parts[: end + 1]) for end in range(len(parts))]
    return ", ".join(known[each].title for each in around if each in known) or path
