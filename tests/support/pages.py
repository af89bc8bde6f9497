"""What tests of pages share: what a link or an example asks for, and what a page of a case or of a study answers."""

import re
from html import unescape
from typing import Any

from app.calculations import BY_PATH
from app.examples import examples
from app.pages import views
from app.pages.cases import Asked
from app.pages.query import pairs_of, pairs_of_query, split_views
from app.pages.studies import page as pages
from app.pages.studies.page import StudyPage
from app.pages.templating import page_path
from tests.support import studies

MOST, DEADLINE_S = 2500, 30.0


def asked(name: str, **said: str) -> Asked:
    """The page of an example; `said` is what its query says beside the case."""
    example = examples()[name]
    return Asked(page_path(BY_PATH[example.endpoint]), pairs_of(example.request), said)


def asked_by(address: str) -> Asked:
    """What a link asks for."""
    path, _, query = address.partition("?")
    return Asked(path, *split_views(pairs_of_query(query)))


def html_of(found: Asked, status: int = 200) -> str:
    """The page of a case."""
    shown = views.page(found)
    assert shown.status == status
    return shown.content.decode()


def checked(page: type[StudyPage], found: Asked) -> StudyPage:
    """The study that is asked for; raises what refuses it."""
    return pages.checked(page, found, MOST, DEADLINE_S)


def opened(page: type[StudyPage], found: Asked, status: int = 200) -> str:
    """The page of a study before its lines come."""
    shown = pages.opened(page, found, MOST, DEADLINE_S)
    assert shown.status == status
    return (shown.head + shown.tail).decode()


def whole(study: StudyPage, lines: list[dict[str, Any]]) -> str:
    """The page of a study with its lines, as its reader sees the texts."""
    return unescape(pages.drawn(study, lines).decode())


def fault_at(html: str, control: str) -> str:
    """What a page says is wrong at a control."""
    found = re.search(rf'id="f\.{re.escape(control)}-fault"(?! hidden)[^>]*>([^<]*)<', html)
    assert found, re.findall(r'<div class="problem".*?</div>', html, re.DOTALL)
    return unescape(found[1])


def lines_of(study: StudyPage) -> list[dict[str, Any]]:
    """Every line of a study, calculated in this process, as a client reads it."""
    return studies.lines_of(study.study)
