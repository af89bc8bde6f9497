"""The docs page in a real browser without any other host: it shows every operation and its examples."""

from collections.abc import Iterator

import httpx
import pytest
from playwright.sync_api import Browser, Page

from app.calculations import CALCULATIONS
from app.examples import examples

pytestmark = pytest.mark.service


@pytest.fixture(scope="module")
def page(browser: Browser) -> Iterator[Page]:
    page = browser.new_page()
    yield page
    page.close()


def test_docs_page_works_offline(page: Page, server: str) -> None:
    requested: list[str] = []
    complaints: list[str] = []
    page.on("request", lambda request: requested.append(request.url))
    page.on("console", lambda message: complaints.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto(f"{server}/docs")
    page.wait_for_selector(".opblock-post")
    operations = httpx.get(f"{server}/openapi.json").json()["paths"].values()
    posts = sum("post" in operation for operation in operations)
    assert page.locator(".opblock-post").count() == posts > len(CALCULATIONS)
    assert [url for url in requested if not url.startswith((server, "data:"))] == []
    assert complaints == []


def test_examples_can_be_chosen_and_run(page: Page, server: str) -> None:
    page.goto(f"{server}/docs")
    calculation = CALCULATIONS[0]
    block = page.locator(f"#operations-{calculation.path.split('/')[2]}-coupling")
    block.locator(".opblock-summary").click()
    titles = block.locator(".examples-select option").all_inner_texts()
    assert set(titles) == {each.title for each in examples().values() if each.endpoint == calculation.path}
    block.get_by_role("button", name="Try it out").click()
    block.get_by_role("button", name="Execute").click()
    status = block.locator(".live-responses-table .response .response-col_status").first
    status.wait_for()
    assert status.inner_text().startswith("200")
