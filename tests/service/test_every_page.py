"""Every kind of page fits the windows of a phone and a desktop, and is accessible in light and dark colours.

Without script, every page still fits the window of a phone. The browser is Chromium.
"""

from collections.abc import Callable

import pytest
from playwright.sync_api import Page

from app.calculations import CALCULATIONS, Calculation
from app.examples import examples
from app.manual import NAMES
from app.pages.study_links import studies_of, study_links
from app.pages.templating import example_link, examples_of, page_path
from tests.rexs.units import three_stages, turbo_unit
from tests.support.browsing import DESK, PHONE, address_of, overflow, violations

pytestmark = pytest.mark.service

READING = ("/", "/docs", "/manual", "/manual/functions", *(f"/manual/{name}" for name in NAMES))
OPEN = "document.querySelectorAll('details').forEach(part => { part.open = true; })"


def pages_of(calculation: Calculation) -> dict[str, str]:
    """Return the addresses of the pages of a calculation.

    These pages are the form, the first example, an error, a comparison, the report and the studies.
    """
    path, case = page_path(calculation), example_link(calculation, examples_of(calculation)[0])
    query = case.partition("?")[2]
    field = query.partition("=")[0]
    found = {
        "form": path,
        "result": case,
        "error": f"{path}?{field}=abc",
        "compare": f"{case}&ref={query.replace('&', '%26')}",
        "report": f"{path}/report?{query}",
    }
    for study in studies_of(calculation)[:1]:
        found["curve or map"] = study.address
    for study_link in study_links(calculation):
        found[study_link.label] = f"{path}/{study_link.name}"
        found[f"{study_link.label} of a case"] = (
            f"{path}/{study_link.name}?{query}{'&trials=3' * (study_link.name == 'design')}"
        )
    return found


PAGES = {f"{page_path(each)[1:]}, {kind}": address for each in CALCULATIONS for kind, address in pages_of(each).items()}
PAGES |= {example.title: address_of(example.name) for example in examples().values() if example.starter}
PAGES |= {address: address for address in READING}


def faults(page: Page) -> dict[str, object]:
    """Return what is too wide or not accessible on a page, in the windows of a phone and of a desktop."""
    found = dict[str, object]()
    for size in (PHONE, DESK):
        page.set_viewport_size(size)
        found |= {f"{size['width']} px, {each}": html for each, html in violations(page)}
        if overflow(page) > 0:
            found[f"wider than {size['width']} px"] = overflow(page)
    return found


def kind_of(name: str) -> str:
    """Return what a page is: the kind behind the comma, a page to read, or an example."""
    return "reading" if name.startswith("/") else name.partition(", ")[2]


FIRST = {kind_of(name): name for name in reversed(PAGES)}.values()
ONE_OF_EACH_KIND = [pytest.param(name, marks=pytest.mark.ci if name in FIRST else ()) for name in PAGES]


@pytest.mark.parametrize("scheme", ["light", pytest.param("dark", marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", ONE_OF_EACH_KIND)
def test_a_page_fits_and_everybody_can_use_it(visit: Callable[..., Page], name: str, scheme: str) -> None:
    page = visit(PAGES[name], color_scheme=scheme)
    if name == "/docs":
        page.locator(".opblock-summary-control").first.click()
        page.get_by_role("button", name="Try it out").click()
        page.get_by_role("button", name="Execute").wait_for()
    page.evaluate(OPEN)
    assert faults(page) == {}


@pytest.mark.parametrize("name", PAGES)
def test_a_page_fits_a_phone_without_script(visit: Callable[..., Page], name: str) -> None:
    page = visit(PAGES[name], viewport=PHONE, java_script_enabled=False)
    assert overflow(page) <= 0
    assert page.locator("h1").count() == 1


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("unit", [turbo_unit, three_stages])
def test_the_page_of_a_gear_unit(visit: Callable[..., Page], unit: Callable[[], object], scheme: str) -> None:
    page = visit("/", color_scheme=scheme)
    file = {"name": "unit.rexs", "mimeType": "application/xml", "buffer": unit().xml()}  # type: ignore[attr-defined]
    page.locator("#rexs-file").set_input_files(file)
    page.locator("form", has=page.locator("#rexs-file")).get_by_role("button", name="Open").click()
    page.get_by_role("heading", name="Stages").wait_for()
    page.evaluate(OPEN)
    assert faults(page) == {}
