"""Printed reports have the pages they promise, in a browser."""

import re

import pytest
from playwright.sync_api import Browser

from app.pages import views
from app.pages.cases import Asked
from tests.support.pages import asked

pytestmark = pytest.mark.service

PAGE = re.compile(rb"/Type\s*/Page[^s]")


@pytest.mark.parametrize("name", ["starter-industrial-scuffing", "pahl-axial-displacement"])
def test_the_short_form_has_two_pages(browser: Browser, name: str) -> None:
    case = asked(name, extent="short", author="A. Miller")
    if case.path == "/scuffing":
        case = Asked(case.path, [*case.pairs, ("model.lubrication", "closed_form")], case.views)
    page = browser.new_page()
    page.set_content(views.report(case, "").content.decode())
    assert len(PAGE.findall(page.pdf(prefer_css_page_size=True))) == 2
    page.close()
