"""In a real browser a study draws its figure as points arrive, opens cases of points, and can be stopped and shared."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from app.pages.study_links import STUDIES
from tests.support.browsing import address_of, hold_scripts
from tests.support.server import wait_for_metric

pytestmark = pytest.mark.service

MAP, THRUST = (
    next(each.address for each in STUDIES if words in each.title) for words in ("forgives", "by axial velocity")
)
SLOW = re.sub(r"x\.count=\d+", "x.count=300", re.sub(r"y\.count=\d+", "y.count=8", MAP))
COUPLING = "pahl-axial-displacement"
GRINDING = address_of("starter-turbo-gear-drive-train", "/design")


def test_from_a_case_to_a_curve_and_back_to_the_case_of_a_point(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING))
    page.get_by_role("link", name="Vary").click()
    page.locator("select[name=x]").select_option("operation.misalignment_deg")
    expect(page.locator(".frame .chart img").last).to_be_visible()
    expect(page).to_have_url(re.compile(r"x=operation\.misalignment_deg"))
    page.locator('[name="x.to"]').fill("0,2")
    page.get_by_role("button", name="Calculate").click()
    expect(page).to_have_url(re.compile(r"x\.to=0\.2"))
    plot = page.locator("#figure-curve .plot")
    box = plot.bounding_box()
    assert box is not None
    plot.hover(position={"x": box["width"] / 2, "y": box["height"] / 2})
    reading = page.locator("#figure-curve .reading")
    expect(reading).to_contain_text("thrust to be held")
    said = reading.inner_text()
    plot.click(position={"x": box["width"] / 2, "y": box["height"] / 2})
    expect(page.locator(".card").first).to_be_visible()
    chosen = page.locator('[name="operation.misalignment_deg"]').input_value()
    assert float(chosen) == pytest.approx(float(re.findall(r"misalignment ([\d.]+)", said)[0]), rel=1e-4)
    thrust = "".join(page.locator('[data-path="axial_thrust.design_force_n"]').all_text_contents()[0].split())
    assert float(thrust) == pytest.approx(float(re.findall(r"thrust to be held ([\d.]+)", said)[0]), rel=1e-3)


def test_a_quantity_chosen_before_the_script_arrives_is_varied_and_the_page_can_be_left(
    visit: Callable[..., Page],
) -> None:
    page = visit("/")
    arrive = hold_scripts(page)
    page.goto(address_of(COUPLING, "/vary"), wait_until="commit")
    page.locator("select[name=x]").select_option("operation.misalignment_deg")
    arrive()
    expect(page.locator(".frame .chart img").last).to_be_visible()
    page.go_back(wait_until="load")
    page.wait_for_timeout(1000)
    assert "&x=" not in page.url
    expect(page.locator("select[name=x]")).to_have_value("")


def test_a_range_typed_before_the_script_arrives_is_kept(visit: Callable[..., Page]) -> None:
    page = visit("/")
    arrive = hold_scripts(page)
    page.goto(address_of(COUPLING, "/vary"), wait_until="commit")
    page.locator("select[name=x]").select_option("operation.misalignment_deg")
    page.locator('[name="x.to"]').fill("0.2")
    arrive()
    page.wait_for_load_state("load")
    page.get_by_role("button", name="Calculate").click()
    expect(page).to_have_url(re.compile(r"x\.to=0\.2"))


def test_the_figure_grows_while_points_come_and_stop_ends_it(visit: Callable[..., Page], server: str) -> None:
    page = visit("/")
    page.goto(SLOW, wait_until="commit")
    done = page.locator(".frame:visible .progress")
    expect(done).to_contain_text("of 2400 points")
    first = done.inner_text()
    expect(done).not_to_have_text(first)
    assert page.locator(".frame:visible").count() == 1
    page.locator("#stop").click()
    expect(page.locator("#state")).to_contain_text("Stopped")
    expect(page.locator(".frame:visible .chart img")).to_be_visible()
    wait_for_metric(server, "tribodrive_studies", 0)


def test_what_to_grind_shows_the_best_so_far_and_keeps_it_when_it_is_stopped(visit: Callable[..., Page]) -> None:
    page = visit("/")
    page.goto(GRINDING, wait_until="commit")
    expect(page.locator(".frame:visible .progress")).to_contain_text(re.compile("[1-9][0-9]* of 656 points"))
    expect(page.locator(".frame:visible h2", has_text="Best so far")).to_be_visible()
    page.locator("#stop").click()
    expect(page.locator("#state")).to_contain_text("Stopped")
    lead = page.locator(".frame:visible").get_by_role("link", name="Open the unit ground so")
    lead.click()
    expect(page.locator(".card").first).to_be_visible()


def test_a_map_opens_the_case_of_a_point_by_keyboard(visit: Callable[..., Page]) -> None:
    page = visit(MAP)
    page.locator("#figure-map .plot").focus()
    for key in ("ArrowRight", "ArrowRight", "ArrowUp"):
        page.keyboard.press(key)
    expect(page.locator("#figure-map .reading")).to_contain_text("helix slope -15 µm, helix crowning 3 µm")
    page.keyboard.press("Enter")
    expect(page.locator(".card").first).to_be_visible()
    assert page.locator('[name="modifications.helix_slope_um"]').input_value() == "-15"
    assert page.locator('[name="modifications.lead_crowning_um"]').input_value() == "3"


def test_without_script(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING), java_script_enabled=False)
    page.get_by_role("link", name="Vary").click()
    page.locator("select[name=x]").select_option("operation.torque_n_m")
    page.get_by_role("button", name="Calculate").click()
    expect(page.locator(".frame:visible .chart img")).to_have_count(1)
    page.locator("summary", has_text="Points").click()
    page.get_by_role("link", name="open the case at").nth(3).click()
    expect(page.locator(".card").first).to_be_visible()


def test_share_and_download(visit: Callable[..., Page], tmp_path: Path) -> None:
    page = visit(THRUST)
    page.locator("#copy").click()
    expect(page.locator("#state")).to_have_text("Link copied.")
    assert visit(page.evaluate("navigator.clipboard.readText()")).locator("#figure-family").count() == 1
    lines = page.request.get(page.get_by_role("link", name="NDJSON").get_attribute("href") or "").text().splitlines()
    assert json.loads(lines[-1])["type"] == "end"
    with page.expect_download() as download:
        page.get_by_label(re.compile("as PDF")).first.click()
    file = tmp_path / "figure.pdf"
    download.value.save_as(file)
    assert file.read_bytes().startswith(b"%PDF")


def test_the_start_page_leads_to_the_crowning_that_forgives(visit: Callable[..., Page]) -> None:
    page = visit("/")
    page.locator("summary", has_text="Calculations and examples").last.click()
    page.get_by_role("link", name="Which crowning forgives").click()
    expect(page.locator("#figure-map")).to_be_visible()
    expect(page.locator("#figure-worst")).to_be_visible()


def test_which_input_matters_leads_to_its_curve(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING), java_script_enabled=False)
    page.get_by_role("link", name="What matters").click()
    expect(page.locator("#figure-influence")).to_be_visible()
    first = page.locator(".results tbody a").first
    expect(first).to_have_text("coefficient of friction")
    first.click()
    expect(page.locator("#figure-curve")).to_be_visible()
