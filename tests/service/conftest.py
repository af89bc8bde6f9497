"""Fixtures for tests in a browser, and for the address of a test module's own service.

A test fails if a page requests anything from another host or reports an error.
"""

from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect, sync_playwright

from tests.support.server import Server

CHROMIUM = "/usr/bin/chromium"
OPTIONS = ["--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-sync"]
SLOW_MS = 60_000


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    expect.set_options(timeout=SLOW_MS)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=OPTIONS)
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def address(service: Server) -> str:
    """Return the address of the service that the fixture `service` of the test module starts."""
    return service[1]


@pytest.fixture
def visit(browser: Browser, server: str) -> Iterator[Callable[..., Page]]:
    """Yield a function that opens an address in a new window."""
    # The test fails if a page requests anything from another host or reports an error.
    complaints: list[str] = []
    opened: list[BrowserContext] = []

    def open_page(address: str, **options: object) -> Page:
        context = browser.new_context(base_url=server, **options)
        opened.append(context)
        context.set_default_timeout(SLOW_MS)
        context.set_default_navigation_timeout(3 * SLOW_MS)  # a page of a study has arrived when that has ended
        context.grant_permissions(["clipboard-read", "clipboard-write"], origin=server)
        page = context.new_page()
        page.on("request", lambda sent: complaints.append(sent.url) if not own(sent.url) else None)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on(
            "console", lambda said: complaints.append(said.text) if "Content Security Policy" in said.text else None
        )
        page.goto(address)
        return page

    def own(url: str) -> bool:
        return url.startswith((server, "data:"))

    yield open_page
    for context in opened:
        context.close()
    assert complaints == []
