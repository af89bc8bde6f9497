"""A new user comes from the start page to a printed report with nothing but what the pages show."""

import re
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

pytestmark = pytest.mark.service

CLICKS = 5  # the page, which of torque and power, two sections, the report
MOST_SECONDS = 180.0
SECONDS_A_FIELD = 6.0  # to read a label and type a number
SECONDS_A_CLICK = 4.0  # to find what to click


class User:
    """Click and type by visible labels, and count the clicks and the fields."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.clicks = 0
        self.fields = 0

    def click(self, target: Locator) -> None:
        """Click a visible target."""
        expect(target).to_be_visible()
        target.click()
        self.clicks += 1

    def open(self, section: str) -> None:
        """Unfold a section of the form."""
        self.click(self.page.locator("#form summary .name").get_by_text(section, exact=True))

    def fill(self, label: str, text: str) -> None:
        """Type a text into the field with this label."""
        self.page.get_by_role("textbox", name=re.compile(rf"^{label}( |,|$)")).locator("visible=true").first.fill(text)
        self.fields += 1

    def choose(self, label: str, text: str) -> None:
        """Choose an entry from the menu with this label."""
        menu = self.page.get_by_role("combobox", name=re.compile(rf"^{label}( |,|$)"))
        menu.locator("visible=true").first.select_option(label=text)
        self.fields += 1


def test_from_the_start_to_a_printed_report(visit: Callable[..., Page], tmp_path: Path) -> None:
    started = time.monotonic()
    page = visit("/")
    user = User(page)
    user.click(page.get_by_role("link", name="Scuffing of gears", exact=True).last)
    user.fill("number of teeth, pinion", "25")
    user.fill("number of teeth, wheel", "78")
    user.fill("module", "5")
    user.fill("face width", "90")
    user.click(page.get_by_role("radio", name="transmitted power"))
    user.fill("transmitted power", "400")
    user.fill("pinion speed", "1500")
    user.open("modifications")
    user.fill("helix crowning", "8")
    user.fill("tip relief", "25")
    user.open("oil")
    user.choose("ISO viscosity grade", "320")
    expect(page.locator(".card")).to_have_count(5)
    expect(page.locator(".finding")).to_contain_text("No verdict: no scuffing temperature")
    user.click(page.get_by_role("link", name="Report", exact=True))
    expect(page.locator("body")).to_contain_text("320")
    file = tmp_path / "report.pdf"
    page.pdf(path=file)
    assert file.read_bytes().startswith(b"%PDF")
    human = user.clicks * SECONDS_A_CLICK + user.fields * SECONDS_A_FIELD
    assert user.clicks == CLICKS
    assert human + time.monotonic() - started < MOST_SECONDS
