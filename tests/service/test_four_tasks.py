"""Four tasks in Chromium, on a desk and on a phone: no number is typed twice, and clicks and seconds are counted."""

import logging
import re
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.rexs.units import three_stages
from tests.service.test_new_user import User
from tests.support.browsing import DESK, PHONE, overflow

logger = logging.getLogger(__name__)
pytestmark = pytest.mark.service

WINDOWS = pytest.mark.parametrize("viewport", [DESK, PHONE], ids=["desk", "phone"])
SEARCH_MS = 600_000  # of a search on cores that others use too
PAIR = {
    "number of teeth, pinion": "39",
    "number of teeth, wheel": "130",
    "module": "6",
    "helix angle": "11.5",
    "face width": "200",
    "transmitted power": "12000",
    "pinion speed": "10000",
    "oil temperature": "55",
    "failure load stage": "7",
    "oil flow to the gears": "140",
}


class Task(User):
    """A user who types no number twice, and never sees a page that is wider than the window."""

    def __init__(self, page: Page) -> None:
        super().__init__(page)
        self.typed = list[str]()
        self.started = time.monotonic()

    def fill(self, label: str, text: str) -> None:
        """Type a text into the field with this label."""
        super().fill(label, text)
        self.typed.append(label)

    def arrived(self) -> None:
        """Check the page that is shown now."""
        assert overflow(self.page) <= 0, self.page.url

    def told(self, name: str) -> str:
        """Return clicks, fields and seconds of the task; `--log-cli-level=INFO` shows them."""
        assert len(self.typed) == len(set(self.typed)), self.typed
        return f"{name}: {self.clicks} clicks, {self.fields} fields, {time.monotonic() - self.started:.0f} s"


@WINDOWS
def test_a_turbo_pair_to_its_report(visit: Callable[..., Page], viewport: dict[str, int]) -> None:
    page = visit("/", viewport=viewport)
    user = Task(page)
    user.click(page.get_by_role("link", name="New gear pair"))
    for label, text in PAIR.items():
        user.fill(label, text)
    user.choose("ISO viscosity grade", "46")
    user.arrived()
    user.click(page.get_by_role("button", name="Is it safe?"))
    expect(page.locator(".card").first).to_be_visible()
    user.arrived()
    user.click(page.get_by_role("link", name="Add the pumping loss"))
    expect(page.locator('[name="cooling.pumping_w"]')).to_have_value(re.compile(r"^\d{4,5}"))
    path = page.get_by_role("navigation", name="Path of a gear pair")
    user.click(path.get_by_role("link", name="Choked?"))
    expect(page.locator(".finding").first).to_contain_text("hoked")
    user.arrived()
    user.click(path.get_by_role("link", name="On shafts"))
    expect(page.locator(".card").first).to_be_visible()
    expect(page.get_by_role("heading", name=re.compile(r"^Typical shafts and bearings: \d+ assumed"))).to_be_visible()
    user.arrived()
    search = path.get_by_role("link", name="What to grind").get_attribute("href") or ""
    user.clicks += 1
    page.goto(search, wait_until="commit")  # the page grows until the search has ended
    expect(page.get_by_role("heading", name="What to grind", exact=True)).to_be_visible(timeout=SEARCH_MS)
    user.arrived()
    report = page.get_by_role("link", name="One report of all steps").get_attribute("href") or ""
    user.clicks += 1
    page.goto(report)  # with the patience of a navigation: four calculations and their figures
    for text in ("Safe? ", "Choked? ", "What to grind", "Typical shafts and bearings"):
        expect(page.locator("main")).to_contain_text(text)
    user.arrived()
    assert (user.clicks, user.fields) == (7, 11)
    logger.info(user.told("turbo pair to report"))


@WINDOWS
def test_a_coupling_with_its_crowning_and_twice_the_misalignment(
    visit: Callable[..., Page], viewport: dict[str, int]
) -> None:
    page = visit("/", viewport=viewport)
    user = Task(page)
    user.click(page.get_by_role("link", name="Crowning of a coupling"))
    for label, text in {
        "number of teeth": "56",
        "module": "3",
        "transmitted torque": "3500",
        "speed": "6000",
        "range of misalignment, smallest": "0.05",
        "range of misalignment, largest": "0.09",
    }.items():
        user.fill(label, text)
    expect(page.locator(".finding").first).to_contain_text(re.compile(r"radius\s[0-9]+\smm: .* drop\s[0-9]+\sµm"))
    expect(page.locator(".cards")).to_contain_text("load concentration")
    expect(page.locator(".cards")).to_contain_text("distance to unloading")
    user.arrived()
    user.click(page.get_by_text("Use this coupling in …"))
    user.click(page.locator(".carried").get_by_role("link", name="Gear coupling", exact=True))
    expect(page.locator(".card").first).to_be_visible()
    expect(page.locator('[name="operation.misalignment_deg"]')).to_have_value("0.09")
    user.click(page.get_by_role("link", name="Compare"))
    expect(page.locator(".before").first).to_be_visible()
    user.fill("misalignment", "0.18")
    expect(page.locator(".differences")).to_contain_text("0.18")
    rows = page.locator("#all tbody tr").filter(has_text="no change")
    expect(rows).to_have_count(0)
    user.arrived()
    user.click(page.get_by_role("link", name="Report", exact=True))
    expect(page.get_by_role("heading", name="Compared with variant A")).to_be_visible()
    for text in ("0.09", "0.18"):
        expect(page.locator("main")).to_contain_text(text)
    user.arrived()
    assert (user.clicks, user.fields) == (5, 7)
    logger.info(user.told("coupling with crowning and doubled misalignment"))


@WINDOWS
def test_a_file_to_its_spectrum_and_back_into_the_file(
    visit: Callable[..., Page], viewport: dict[str, int], tmp_path: Path
) -> None:
    unit = three_stages()
    load = next(each["id"] for each in unit.components if each["type"] == "external_load")
    unit.cases = [{load: {"torque_around_u_axis": (torque, "N m")}} for torque in (3.0, 4.7)]
    content = unit.xml().replace(b"\n", b"\r\n")
    page = visit("/", viewport=viewport)
    user = Task(page)
    upload: Any = {"name": "mill 7.rexs", "mimeType": "application/xml", "buffer": content}
    page.locator("#rexs-file").set_input_files(upload)
    user.click(page.locator("form", has=page.locator("#rexs-file")).get_by_role("button", name="Open"))
    user.choose("ISO viscosity grade", "220")
    user.fill("oil temperature", "60")
    user.fill("failure load stage", "12")
    user.click(page.get_by_role("button", name="Calculate all stages"))
    expect(page.locator("#stages tbody tr td:nth-child(2)")).to_have_text([re.compile("risk")] * 3)
    user.arrived()
    spectrum = page.locator("p", has_text="Probability of scuffing with tolerances").first
    user.click(spectrum.get_by_role("link", name="Scuffing of gears"))
    expect(page.locator(".frame:visible .chart").first).to_be_visible(timeout=SEARCH_MS)
    user.arrived()
    page.go_back()
    with page.expect_download() as download:
        user.click(page.get_by_role("button", name="Write all results into the file"))
    assert download.value.suggested_filename == "mill 7.rexs"
    file = tmp_path / "written"
    download.value.save_as(file)
    lines, added = content.splitlines(keepends=True), file.read_bytes().splitlines(keepends=True)
    assert [line for line in added if b"tribodrive" not in line and b"face_load_factor" not in line] == lines
    assert all(line.endswith(b"\r\n") for line in added)
    assert file.read_bytes().count(b"custom_tribodrive_scuffing_safety_blok") == 3
    assert (user.clicks, user.fields) == (4, 3)
    logger.info(user.told("file to spectrum to write-back"))


@WINDOWS
def test_the_figure_of_a_paper_as_numbers(visit: Callable[..., Page], viewport: dict[str, int], tmp_path: Path) -> None:
    page = visit("/", viewport=viewport)
    user = Task(page)
    user.click(page.locator("nav").get_by_role("link", name="Gear coupling", exact=True))
    page.get_by_label("Example", exact=True).select_option("pahl-axial-displacement")
    user.fields += 1
    figure = page.locator("#figure-axial-thrust")
    user.click(page.get_by_text("More figures"))
    expect(figure.locator("img")).to_be_visible()
    user.arrived()
    with page.expect_download() as download:
        user.click(figure.get_by_role("link", name=re.compile("as CSV$")))
    file = tmp_path / download.value.suggested_filename
    download.value.save_as(file)
    heading, *rows = file.read_text("utf-8-sig").splitlines()
    assert "°" in heading
    assert len(rows) > 20
    assert (user.clicks, user.fields) == (3, 1)
    logger.info(user.told("figure of a paper to CSV"))
