"""In a real browser, the docs page shows every POST operation and runs an example without requests to other hosts."""

from collections.abc import Callable

import httpx
import pytest
from playwright.sync_api import Page

from app.calculations import CALCULATIONS
from app.examples import examples

pytestmark = pytest.mark.service


def test_docs_page_works_offline(visit: Callable[..., Page], served: httpx.Client) -> None:
    page, complaints = visit("/"), list[str]()
    page.on("console", lambda said: complaints.append(said.text) if said.type == "error" else None)
    page.goto("/docs")
    page.wait_for_selector(".opblock-post")
    operations = served.get("/openapi.json").json()["paths"].values()
    posts = sum("post" in operation for operation in operations)
    assert page.locator(".opblock-post").count() == posts > len(CALCULATIONS)
    assert complaints == []


def test_examples_can_be_chosen_and_run(visit: Callable[..., Page]) -> None:
    page = visit("/docs")
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
