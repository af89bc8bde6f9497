"""A report that a browser prints has the promised number of pages."""

import re

import pytest
from playwright.sync_api import Browser

from app.pages import views
from app.pages.cases import Asked
from tests.support.pages import asked

pytestmark = pytest.mark.service

PAGE = re.compile(rb"/Type\s*/Page[^s]")


TRAIN = pytest.param("starter-turbo-gear-drive-train", "short", 2, marks=pytest.mark.slow)


@pytest.mark.parametrize(
    ("name", "extent", "pages"),
    [
        ("starter-industrial-scuffing", "short", 2),
        ("starter-industrial-scuffing", "", 4),
        ("pahl-axial-displacement", "short", 2),
        TRAIN,
    ],
)
def test_a_report_has_its_pages(browser: Browser, name: str, extent: str, pages: int) -> None:
    case = asked(name, extent=extent, author="A. Miller")
    if case.path == "/scuffing":
        case = Asked(case.path, [*case.pairs, ("model.lubrication", "closed_form")], case.views)
    page = browser.new_page()
    page.set_content(views.report(case, "").content.decode())
    assert len(PAGE.findall(page.pdf(prefer_css_page_size=True))) == pages
    page.close()
