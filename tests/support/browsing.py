"""The browser tests share these helpers for addresses, sideways scrolling, delayed scripts and accessibility."""

from collections.abc import Callable

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, Route

from app.calculations import BY_PATH
from app.examples import examples
from app.pages.templating import example_link

PHONE = {"width": 360, "height": 740}
DESK = {"width": 1400, "height": 900}


def address_of(name: str, view: str = "") -> str:
    """Return the address of the page of an example, or the address of another view of the page, such as "/report"."""
    example = examples()[name]
    return example_link(BY_PATH[example.endpoint], example).replace("?", f"{view}?", 1)


def overflow(page: Page) -> int:
    """Return by how many pixels a page is wider than its window."""
    width: int = page.evaluate("document.scrollingElement.scrollWidth - window.innerWidth")
    return width


def hold_scripts(page: Page) -> Callable[[], None]:
    """Hold back the scripts of the pages opened from now on. The returned function lets the scripts arrive."""
    held: list[Route] = []
    arrived: list[bool] = []

    def hold(route: Route) -> None:
        if arrived:
            route.continue_()
        else:
            held.append(route)

    def arrive() -> None:
        arrived.append(True)
        for route in held:
            route.continue_()

    page.route("**/*.js*", hold)
    return arrive


def violations(page: Page) -> list[tuple[str, str]]:
    """Return all violations that the accessibility checker reports: the rule and the HTML of the first element."""
    found = Axe().run(page).response["violations"]
    return [(each["id"], each["nodes"][0]["html"]) for each in found]
