"""A new kind of study is a `Study`, a link, and a `StudyPage` with a template; each stands in a list of its package."""

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import pytest
from fastapi import FastAPI
from jinja2 import ChoiceLoader, FileSystemLoader, PackageLoader

from app.http.routes import studies
from app.pages import study_kinds, study_links, templating
from app.pages.query import split_views
from app.pages.studies import PAGES
from app.pages.studies.controls import Control
from app.pages.studies.page import Controls, Result, StudyPage
from app.pages.study_kinds import LINKS, StudyLink
from app.schema.fields import value_at
from app.schema.quantities import Input
from app.studies import runner
from app.studies.kinds import KINDS
from app.studies.requests import FieldPath, StudyRequest
from app.studies.runner import Study
from tests.support import pages as support
from tests.support.pages import asked, fault_at, opened

TEMPLATE = '<div class="frame"><p class="twice">{{ page.output.title }}: {{ found.progress }}</p></div>'
DOUBLED = Control("doubled", "path", "operation.torque_n_m", str, label="field")
TWICE = StudyLink("twice", "Twice", "an output with one input doubled", frozenset({DOUBLED.name}))


class TwiceRequest(StudyRequest):
    """An input that is doubled."""

    path: Annotated[FieldPath, Input("doubled field")]


class Twice(Study):
    """Two points: the case, and the case with one input doubled."""

    path = "/v1/twice"
    summary = "One input doubled"
    answer = "a line with both values"
    model = TwiceRequest

    def _planned(self, base: Any, _: int) -> int:
        leaf = base.leaf(self.body.path, "path")
        self.cases = [{}, {leaf.path: 2 * value_at(base.checked({}).model_dump(), leaf.path)}]
        return len(self.cases)

    async def lines(self, pool: Any, clock: Any) -> Any:
        """Both values."""
        solved = runner.in_order(pool, self.question, self.cases.__getitem__, range(2), clock)
        found = [point.out[0] async for _, points in solved for point in points]
        yield [self.header(values=found) | {"type": "end"}]


class TwicePage(StudyPage):
    """The two values."""

    link = TWICE
    question = "what if it doubles?"
    about = "One input is doubled."
    figures = ()
    template = "twice.html"
    plan = Twice

    def declared(self) -> tuple[Control, ...]:
        """The field that is doubled."""
        return (DOUBLED,)

    def body(self) -> dict[str, Any]:
        """The case, the field and the output."""
        case = {"endpoint": self.calculation.path, "request": self.asked.body, "outputs": [self.output.path]}
        return {**case, **self.given()}

    def controls(self) -> tuple[Controls, ...]:
        """The field."""
        return (Controls("Input", fields=(self.field_of(DOUBLED),)),)

    def result(self, lines: list[Any]) -> Result:
        """Both values."""
        return Result(" then ".join(f"{value:.6g}" for value in lines[-1]["values"]))


@pytest.fixture
def added(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Add the link to the new kind of study to the other links, and its template to the other templates."""
    (tmp_path / "twice.html").write_text(TEMPLATE, "utf-8")
    for module in (study_kinds, study_links):
        monkeypatch.setattr(module, "LINKS", (*study_kinds.LINKS, TWICE))
    study_kinds.control_names.cache_clear()
    loader = ChoiceLoader([PackageLoader("app.pages"), FileSystemLoader(tmp_path)])
    monkeypatch.setattr(templating._environment(""), "loader", loader)
    yield
    monkeypatch.undo()
    templating._environment.cache_clear()
    study_kinds.control_names.cache_clear()


def test_each_kind_has_a_page_and_each_page_a_link() -> None:
    assert tuple(page.plan for page in PAGES) == KINDS
    assert tuple(page.link for page in PAGES) == LINKS


@pytest.mark.usefixtures("added")
def test_it_has_its_link_behind_the_others_and_its_controls_are_no_fields_of_a_case() -> None:
    case = asked("pahl-heavily-crowned")
    assert study_links.study_links(case.calculation)[-1] is TWICE
    assert split_views([*case.pairs, ("doubled", "operation.speed_rpm")])[1] == {"doubled": "operation.speed_rpm"}


def test_its_endpoint_is_made_of_its_kind(monkeypatch: pytest.MonkeyPatch) -> None:
    service = FastAPI()
    monkeypatch.setattr(studies, "router", service.router)
    studies._add(Twice)
    operation = service.openapi()["paths"]["/v1/twice"]["post"]
    assert (operation["operationId"], operation["summary"]) == ("twice", "One input doubled")
    assert "parameters" not in operation
    assert list(operation["responses"]["200"]["content"]) == ["application/x-ndjson"]


@pytest.mark.usefixtures("added")
def test_it_is_solved_and_drawn_by_its_template() -> None:
    found = support.checked(TwicePage, asked("pahl-heavily-crowned"))
    lines = support.lines_of(found)
    once, twice = lines[-1]["values"]
    assert twice > 1.5 * once > 0.0
    assert f'<p class="twice">{found.output.title}: {once:.6g} then {twice:.6g}</p>' in support.whole(found, lines)


@pytest.mark.usefixtures("added")
def test_what_is_refused_stands_at_its_control() -> None:
    html = opened(TwicePage, asked("pahl-heavily-crowned", doubled="operation"), 422)
    assert "operation is a section" in fault_at(html, "doubled")
