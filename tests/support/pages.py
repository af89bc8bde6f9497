"""Request pages of cases and of studies, and return their HTML.

The request comes from an example or from a link.
"""

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
    """Return the request for the page of an example; `said` holds the fields of the query besides those of the case."""
    example = examples()[name]
    return Asked(page_path(BY_PATH[example.endpoint]), pairs_of(example.request), said)


def asked_by(address: str) -> Asked:
    """Return the request that a link makes."""
    path, _, query = address.partition("?")
    return Asked(path, *split_views(pairs_of_query(query)))


def html_of(found: Asked, status: int = 200) -> str:
    """Return the HTML of the page of a case, which must have the given HTTP status."""
    shown = views.page(found)
    assert shown.status == status
    return shown.content.decode()


def checked(page: type[StudyPage], found: Asked) -> StudyPage:
    """Return the study page for a request. If the study is refused, raise the error that says why."""
    return pages.checked(page, found, MOST, DEADLINE_S)


def opened(page: type[StudyPage], found: Asked, status: int = 200) -> str:
    """Return the HTML of a study page without the result. The page must have the given HTTP status."""
    shown = pages.opened(page, found, MOST, DEADLINE_S)
    assert shown.status == status
    return (shown.head + shown.tail).decode()


def whole(study: StudyPage, lines: list[dict[str, Any]]) -> str:
    """Return the HTML of a study's result. Escaped characters are replaced by the characters that a reader sees."""
    return unescape(pages.drawn(study, lines).decode())


def fault_at(html: str, control: str) -> str:
    """Return the message that a page shows at a control with a fault."""
    found = re.search(rf'id="f\.{re.escape(control)}-fault"(?! hidden)[^>]*>([^<]*)<', html)
    assert found, re.findall(r'<div class="problem".*?</div>', html, re.DOTALL)
    return unescape(found[1])


def lines_of(study: StudyPage) -> list[dict[str, Any]]:
    """Calculate a study in this process, and return every line of its answer as a client reads it."""
    return studies.lines_of(study.study)
