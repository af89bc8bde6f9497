"""A new kind of study needs one module in `app.studies.kinds` and one template. No other file names the study."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from fastapi import FastAPI
from jinja2 import ChoiceLoader, FileSystemLoader, PackageLoader

from app.http.routes import studies
from app.pages import study_kinds, templating
from app.pages.query import split_views
from app.pages.study_links import study_links
from app.studies import kinds
from tests.support import pages as support
from tests.support.pages import asked, fault_at, opened

TWICE = '''
"""Twice: an output at the case, and with one input doubled."""

from typing import Annotated, Any

from app.pages.studies.controls import Control
from app.pages.studies.page import Controls, Result, StudyPage
from app.pages.study_kinds import StudyLink
from app.schema.quantities import Input
from app.studies import runner
from app.studies.fields import value_at
from app.studies.requests import FieldPath, StudyRequest
from app.studies.runner import Study

DOUBLED = Control("doubled", "path", "operation.torque_n_m", str, label="field")


class TwiceRequest(StudyRequest):
    """An input that is doubled."""

    path: Annotated[FieldPath, Input("doubled field")]


class Twice(Study):
    """Two points: the case, and the case with one input doubled."""

    path = "/v1/twice"
    summary = "One input doubled"
    answer = "a line with both values"
    model = TwiceRequest

    def _planned(self, base: Any, most: int) -> int:
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

    link = StudyLink("twice", "Twice", "an output with one input doubled", place=6)
    question = "what if it doubles?"
    about = "One input is doubled."
    names = frozenset({DOUBLED.name})
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


PAGE = TwicePage
'''
TEMPLATE = '<div class="frame"><p class="twice">{{ page.output.title }}: {{ found.progress }}</p></div>'


@pytest.fixture
def page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """Add the module and the template of a new kind of study, and yield the page of this study."""
    (tmp_path / "twice.py").write_text(TWICE, "utf-8")
    (tmp_path / "twice.html").write_text(TEMPLATE, "utf-8")
    monkeypatch.setattr(kinds, "__path__", [*kinds.__path__, str(tmp_path)])
    loader = ChoiceLoader([PackageLoader("app.pages"), FileSystemLoader(tmp_path)])
    caches = (study_kinds.study_pages, study_kinds.control_names)
    for cache in caches:
        cache.cache_clear()
    monkeypatch.setattr(templating._environment(""), "loader", loader)
    yield study_kinds.study_page("twice")
    monkeypatch.undo()
    del sys.modules[f"{kinds.__name__}.twice"]
    templating._environment.cache_clear()
    for cache in caches:
        cache.cache_clear()


def test_it_has_its_link_behind_the_others_and_its_controls_are_no_fields_of_a_case(page: Any) -> None:
    case = asked("pahl-heavily-crowned")
    assert [each.name for each in study_links(case.calculation)][-1] == page.link.name == "twice"
    assert split_views([*case.pairs, ("doubled", "operation.speed_rpm")])[1] == {"doubled": "operation.speed_rpm"}


def test_its_endpoint_is_made_of_its_kind(page: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    service = FastAPI()
    monkeypatch.setattr(studies, "router", service.router)
    studies._add(page)
    operation = service.openapi()["paths"]["/v1/twice"]["post"]
    assert (operation["operationId"], operation["summary"]) == ("twice", "One input doubled")
    assert "parameters" not in operation
    assert list(operation["responses"]["200"]["content"]) == ["application/x-ndjson"]


def test_it_is_solved_and_drawn_by_its_template(page: Any) -> None:
    found = support.checked(page, asked("pahl-heavily-crowned"))
    lines = support.lines_of(found)
    once, twice = lines[-1]["values"]
    assert twice > 1.5 * once > 0.0
    assert f'<p class="twice">{found.output.title}: {once:.6g} then {twice:.6g}</p>' in support.whole(found, lines)


def test_what_is_refused_stands_at_its_control(page: Any) -> None:
    html = opened(page, asked("pahl-heavily-crowned", doubled="operation"), 422)
    assert "operation is a section" in fault_at(html, "doubled")
