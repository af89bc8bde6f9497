"""In a real browser the pages are filled, read, shared and printed, also without script, by keyboard and on a phone."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page, Route, expect

from app.calculations import BY_PATH
from app.examples import examples
from app.pages.query import link, pairs_of
from tests.rexs.units import turbo_unit
from tests.support.browsing import DESK, PHONE, address_of, hold_scripts, overflow, violations
from tests.support.lists import LISTS
from tests.support.server import wait_until

pytestmark = pytest.mark.service

STARTERS = [example.name for example in examples().values() if example.starter]
COUPLING = "pahl-axial-displacement"
SCUFFING = "xue-pair-1-scuffing"
MOST_PAGES = 10
"""Largest number of pages of a printed report, as a drive train needs it at true size.

If a page were wider than the paper, the browser would shrink the page and its text.
"""
MOST_HEIGHT = 4000  # pixels of the page of a scuffing case
SUBSCRIPT = 8
"""Subscripts are in smaller type: a text with at most this number of characters may be lower than 7 points."""


def value_of(page: Page, path: str) -> str:
    return page.locator(f'[data-path="{path}"]').text_content() or ""


def test_fill_and_read_a_result(visit: Callable[..., Page]) -> None:
    page = visit("/coupling")
    given = {"number of teeth": 52, "module": "3,0", "transmitted torque": 3000, "speed": 1910, "misalignment": 0.05}
    for label, text in given.items():
        page.get_by_label(re.compile(rf"^{label} ")).first.fill(str(text))
    expect(page.locator(".card").first).to_be_visible()
    expect(page).to_have_url(re.compile(r"operation\.misalignment_deg=0\.05"))
    assert float(value_of(page, "geometry.pitch_radius_mm")) == pytest.approx(78)
    page.get_by_label(re.compile(r"^module ")).fill("6")
    expect(page.locator('[data-path="geometry.pitch_radius_mm"]')).to_have_text("156")


BESIDE_CALCULATE = "getComputedStyle(document.querySelector('.submit'), '::after').content"


def test_while_it_calculates_the_form_says_so(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING))
    page.evaluate("document.getElementById('result').setAttribute('aria-busy', 'true')")  # as the script does
    assert page.evaluate(BESIDE_CALCULATE) == '"calculating …"'
    expect(page.locator(".submit")).to_be_in_viewport()


def test_live_result_keeps_what_is_typed_and_the_latest_wins(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING))
    field = page.locator('[name="operation.torque_n_m"]')
    for text in ("1000", "2000", "4500"):
        field.fill(text)
        page.wait_for_timeout(400)
    expect(page).to_have_url(re.compile("torque_n_m=4500"))
    expect(page.locator("#result")).not_to_have_class(re.compile("old"))
    assert page.evaluate(BESIDE_CALCULATE) == "none"
    assert field.input_value() == "4500"
    mean = float(value_of(page, "load_distribution.mean_tangential_force_n").replace(" ", ""))
    assert mean == pytest.approx(4500 / 0.078 / 52, rel=1e-3)


def test_what_is_typed_before_the_script_arrives_is_calculated(visit: Callable[..., Page]) -> None:
    page = visit("/")
    arrive = hold_scripts(page)
    page.goto(address_of(COUPLING), wait_until="commit")
    page.locator('[name="operation.torque_n_m"]').fill("4500")
    arrive()
    expect(page).to_have_url(re.compile("torque_n_m=4500"))
    mean = float(value_of(page, "load_distribution.mean_tangential_force_n").replace(" ", ""))
    assert mean == pytest.approx(4500 / 0.078 / 52, rel=1e-3)


def test_an_example_chosen_before_the_script_arrives_is_opened_and_can_be_left(visit: Callable[..., Page]) -> None:
    page = visit("/")
    arrive = hold_scripts(page)
    page.goto("/coupling", wait_until="commit")
    page.get_by_label("Example").select_option(COUPLING)
    arrive()
    expect(page.locator(".card").first).to_be_visible()
    page.go_back(wait_until="load")
    page.wait_for_timeout(1000)
    assert page.url.endswith("/coupling")


def test_follow_a_warning_to_its_field(visit: Callable[..., Page]) -> None:
    page = visit(address_of("starter-coupling-at-its-limits"))
    link_to_field = page.locator(".warning a").first
    target = (link_to_field.get_attribute("href") or "").removeprefix("#")
    link_to_field.click()
    assert page.evaluate("document.activeElement.id") == target
    expect(page.locator(f'[id="{target}"]')).to_be_in_viewport()


def test_a_wrong_field_is_told_at_the_field_and_on_top(visit: Callable[..., Page]) -> None:
    page = visit(address_of(SCUFFING))
    page.locator('[name="gears.pinion.teeth"]').fill("abc")
    expect(page.locator(".problem")).to_be_visible()
    expect(page.locator('[id="f.gears.pinion.teeth-fault"]')).to_be_visible()
    assert page.locator('[name="gears.pinion.teeth"]').get_attribute("aria-invalid") == "true"
    page.locator(".problem a").first.click()
    assert page.evaluate("document.activeElement.name") == "gears.pinion.teeth"
    page.locator('[name="gears.pinion.teeth"]').fill("23")
    expect(page.locator(".card").first).to_be_visible()
    expect(page.locator('[id="f.gears.pinion.teeth-fault"]')).to_be_hidden()


def test_after_an_error_the_last_good_result_stays(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING))
    field = page.locator('[name="operation.torque_n_m"]')
    field.fill("200,000")
    expect(page.locator(".problem")).to_contain_text("200,000 may mean 200000 or 200")
    expect(page.locator(".problem")).to_contain_text("transmitted torque")
    expect(page.locator(".card").first).to_be_visible()
    expect(page.locator("#result")).to_have_class(re.compile("old"))
    field.fill("2 000")
    expect(page.locator(".problem")).to_have_count(0)
    expect(page.locator("#result")).not_to_have_class(re.compile("old"))
    field.press("Escape")
    expect(page.locator('[id="f.operation.torque_n_m-help"]')).to_be_hidden()


def test_nothing_is_wrong_before_the_first_calculation(visit: Callable[..., Page]) -> None:
    page = visit("/coupling")
    with page.expect_response(lambda answer: answer.status == 422):
        page.locator('[name="coupling.teeth"]').fill("40")
    expect(page.locator("#result")).not_to_have_class(re.compile("old"))
    expect(page.locator(".wrong")).to_have_count(0)
    expect(page.locator(".problem")).to_have_count(0)
    page.get_by_role("button", name="Calculate", exact=True).click()
    expect(page.locator(".problem")).to_be_visible()
    expect(page.locator('[name="coupling.module_mm"]')).to_be_focused()


def test_calculate_pressed_while_a_request_runs_is_remembered(visit: Callable[..., Page]) -> None:
    page = visit("/coupling")
    held: list[Route] = []

    def hold(route: Route) -> None:
        held.append(route)

    page.route("**/coupling?*", hold, times=1)
    with page.expect_request("**/coupling?*"):
        page.locator('[name="coupling.teeth"]').fill("40")
    page.get_by_role("button", name="Calculate", exact=True).click()
    expect(page.locator("#state")).to_have_text("calculating …")
    held[0].continue_()
    expect(page.locator(".problem")).to_be_visible()
    expect(page.locator('[name="coupling.module_mm"]')).to_be_focused()


def test_calculate_on_an_empty_form_says_what_is_missing(visit: Callable[..., Page]) -> None:
    page = visit("/coupling")
    page.get_by_role("button", name="Calculate", exact=True).click()
    expect(page.locator(".problem")).to_contain_text("number of teeth")
    expect(page.locator('[name="coupling.teeth"]')).to_be_focused()
    assert page.url.endswith("/coupling")


def test_typed_numbers_are_read_as_meant_or_asked_back(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING))
    field = page.locator('[name="operation.torque_n_m"]')
    field.fill("3,5 kNm")
    expect(page).to_have_url(re.compile("torque_n_m=3500&"))
    assert field.input_value() == "3,5 kNm"
    field.fill("3.500")
    expect(page.locator('[id="f.operation.torque_n_m-fault"]')).to_have_text(re.compile("may mean 3500 or 3.5;"))
    page.reload()
    assert field.input_value() == "3.500"
    expect(page.locator('[id="f.operation.torque_n_m-fault"]')).to_have_text(re.compile("may mean 3500 or 3.5;"))
    field.fill("3 500")
    expect(page.locator(".card").first).to_be_visible()


def test_numbers_of_a_link_are_not_asked_back(visit: Callable[..., Page]) -> None:
    link_of_case = re.sub(r"torque_n_m=[\d.]+", "torque_n_m=999.125", address_of(COUPLING))
    page = visit(link_of_case)
    assert page.locator('[name="operation.torque_n_m"]').input_value() == "999.125"
    page.locator('[name="operation.speed_rpm"]').fill("1 920")
    expect(page).to_have_url(re.compile("torque_n_m=999.125&.*speed_rpm=1920"))
    expect(page.locator(".problem")).to_have_count(0)


def test_values_of_a_list_are_counted_as_they_are_read(visit: Callable[..., Page]) -> None:
    page = visit("/coupling")
    page.locator('[data-section="coupling"]').evaluate("part => { part.open = true; }")
    for text, values in LISTS:
        if values is not None and "°" not in text:
            page.locator('[name="coupling.pitch_errors_um"]').fill(text)
            shown = page.locator('[id="f.coupling.pitch_errors_um-count"]')
            expect(shown).to_have_text(f"{len(values)} values")


def test_cards_stay_in_sight(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING), viewport=DESK)
    page.locator(".chart").nth(2).scroll_into_view_if_needed()
    page.mouse.wheel(0, 600)
    expect(page.locator(".card").first).to_be_in_viewport()
    phone = visit(address_of(COUPLING), viewport=PHONE)
    phone.locator('[name="coupling.teeth"]').scroll_into_view_if_needed()
    expect(phone.locator(".jump .headline")).to_be_in_viewport()


def test_project_and_author_are_put_on_the_report(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING))
    page.get_by_role("link", name="Report", exact=True).click()
    page.get_by_label("project").fill("Mill 7")
    page.get_by_label("notes").fill("first line\nsecond line")
    page.get_by_role("button", name="Put on the report").click()
    expect(page.locator("header")).to_contain_text("Mill 7")
    expect(page.locator("header")).to_contain_text("second line")
    page.emulate_media(media="print")
    expect(page.locator(".fill")).to_be_hidden()
    page.emulate_media(media="screen")
    page.locator(".fill summary").click()
    page.get_by_role("link", name="Back to the case").click()
    expect(page.locator(".card").first).to_be_visible()


def test_home_asks_a_question_of_each_model(visit: Callable[..., Page]) -> None:
    page = visit("/")
    assert page.locator(".model h2").all_inner_texts()[0].startswith("Drive train")
    assert page.locator(".model .question").count() == 4
    assert all(text.endswith("?") for text in page.locator(".model .question").all_inner_texts())
    assert page.locator(".model a:visible").count() == 8  # the question and its picture
    page.locator(".question a", has_text="share the load").click()
    expect(page.locator(".card").first).to_be_visible()


def test_share_a_link(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING))
    page.locator('[name="operation.torque_n_m"]').fill("3500")
    expect(page.locator("#copy")).to_have_attribute("href", re.compile("torque_n_m=3500"))
    page.locator("#copy").click()
    expect(page.locator("#state")).to_have_text("Link copied.")
    copied = page.evaluate("navigator.clipboard.readText()")
    other = visit(copied)
    assert other.locator('[name="operation.torque_n_m"]').input_value() == "3500"
    assert value_of(other, "axial_thrust.force_n") == value_of(page, "axial_thrust.force_n")


def test_compare(visit: Callable[..., Page]) -> None:
    page = visit(address_of(SCUFFING))
    page.locator("#pin").click()
    expect(page.locator(".before").first).to_contain_text("no change")
    page.locator('[data-section="modifications"] > summary').click()
    page.locator('[name="modifications.profile_crowning_um"]').fill("10")
    expect(page.locator(".before").first).to_contain_text(re.compile(r"[+−][\d.]+ %"))
    assert "dashed: variant A" in (page.locator(".chart img").first.get_attribute("alt") or "")
    differing = page.locator(".differences tbody tr")
    assert differing.count() == 1
    name, _, *values = differing.inner_text().split("\t")
    assert (name, values) == ("profile crowning", ["0", "10", "µm", "from zero"])
    expect(page.locator(".card .was").first).to_be_visible()
    parts = page.locator(".finding, .differences, .cards, #figures, #all")
    order = ["finding near", "cards", "panel differences", "charts", "panel"]
    assert parts.evaluate_all("parts => parts.map(part => part.className)") == order
    page.get_by_role("link", name="Report", exact=True).click()
    expect(page.locator("body")).to_contain_text("Compared with variant A")
    assert page.get_by_text("variant A → this case").count() == 5
    assert page.locator('figure img[alt*="variant A"]').count() > 3
    page.go_back()
    page.get_by_role("link", name="End comparison").click()
    assert page.locator(".before").count() == 0
    assert page.locator('[name="modifications.profile_crowning_um"]').input_value() == "10"


@pytest.mark.parametrize("name", ["xue-pair-4-helix-slope-40", "pahl-sleeve-orbit", "starter-turbo-gear-drive-train"])
def test_the_change_is_on_the_screen(visit: Callable[..., Page], name: str) -> None:
    example = examples()[name]
    path, pairs = example.endpoint.removeprefix("/v1"), pairs_of(example.request)
    page = visit(link(path, pairs, ref=link("", pairs)[1:]), viewport=DESK)
    page.locator("#all > summary").click()
    table = page.get_by_role("region", name="Main results")
    assert table.evaluate("part => part.scrollWidth - part.clientWidth") == 0
    assert all(page.locator(".list").evaluate_all("lists => lists.map(each => !each.open)"))
    assert page.locator(".differences").inner_text().endswith("None yet: change the form.")
    cards = page.locator(".cards")
    table.scroll_into_view_if_needed()
    page.mouse.wheel(0, 800)
    assert cards.evaluate(
        "part => document.elementFromPoint(part.getBoundingClientRect().x + 40, 20).closest('.cards')"
    )


def test_values_under_pointer_and_keys(visit: Callable[..., Page]) -> None:
    page = visit(address_of(SCUFFING))
    plot = page.locator("#figure-contact-temperature .plot")
    reading = page.locator("#figure-contact-temperature .reading")
    plot.hover(position={"x": 200, "y": 150})
    expect(reading).to_contain_text("Blok")
    plot.focus()
    before = reading.inner_text()
    page.keyboard.press("ArrowRight")
    expect(reading).not_to_have_text(before)


LOADED = """async images => {
  for (const image of images) { image.loading = "eager"; await image.decode(); }
  return images.map(image => [image.naturalWidth, new URL(image.currentSrc).search.includes("theme=dark")]);
}"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_figures_are_images_in_the_theme_of_the_system(visit: Callable[..., Page], scheme: str) -> None:
    page = visit(address_of(SCUFFING), color_scheme=scheme)
    loaded = page.locator(".chart img").evaluate_all(LOADED)
    assert len(loaded) >= 5
    for width, dark in loaded:
        assert width > 400
        assert dark == (scheme == "dark")


def test_the_theme_in_the_address_counts_before_that_of_the_system(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING) + "&theme=light", color_scheme="dark")
    loaded = page.locator(".chart img").evaluate_all(LOADED)
    assert loaded
    assert not any(dark for _, dark in loaded)


def test_values_of_a_figure_as_a_table(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING))
    values = page.locator("#figure-tooth-loads .values")
    values.locator("summary").click()
    expect(values.locator("th").first).to_contain_text("tooth position")
    assert values.locator("tbody tr").count() == 52
    assert violations(page) == []


def test_an_example_is_loaded_from_the_menu(visit: Callable[..., Page]) -> None:
    page = visit("/pumping")
    page.locator("#example").select_option("milian-table-1")
    page.wait_for_url(re.compile(r"gears\.pinion\.teeth"))
    expect(page.locator(".card").first).to_be_visible()
    expect(page.get_by_role("button", name="Load")).to_have_count(0)  # the menu loads by itself
    page.go_back()
    expect(page.locator(".empty")).to_be_visible()


def test_without_script(visit: Callable[..., Page]) -> None:
    page = visit(address_of(SCUFFING), java_script_enabled=False)
    page.locator('[name="load.power_kw"]').fill("60")
    page.get_by_role("button", name="Calculate", exact=True).click()
    assert "load.power_kw=60" in page.url
    assert "pick" not in page.url
    assert "=&" not in page.url
    assert page.locator(".card").count() == 5
    assert page.locator(".chart img").count() >= 5


PARTED = """all => all.filter(each => {
  const rows = [...each.children].map(unit => unit.getBoundingClientRect().top - each.getBoundingClientRect().top);
  return rows.some(below => below > 25) || each.scrollWidth > each.clientWidth;
}).map(each => each.innerText)"""


@pytest.mark.parametrize("name", [name for name in STARTERS if examples()[name].endpoint == "/v1/scuffing"])
def test_a_page_is_short_and_no_number_is_parted_from_its_unit(visit: Callable[..., Page], name: str) -> None:
    page = visit(address_of(name), viewport=DESK)
    page.locator("#figures img").evaluate_all(LOADED)
    assert page.evaluate("document.scrollingElement.scrollHeight") <= MOST_HEIGHT
    for window in (DESK, PHONE):
        page.set_viewport_size(window)
        assert page.locator(".card .value").evaluate_all(PARTED) == []
        assert overflow(page) == 0


def test_a_section_that_is_filled_in_says_yes_and_no_empties_it(visit: Callable[..., Page]) -> None:
    page = visit(address_of(SCUFFING))
    section, stage = page.locator('[data-section="micropitting"]'), '[name="micropitting.failure_load_stage"]'
    switch = section.locator('select[name="micropitting"]')
    section.locator("summary").first.click()
    assert switch.input_value() == ""
    section.locator(stage).fill("8")
    expect(page.locator(".card", has_text="micropitting")).to_be_visible()
    expect(switch).to_have_value("on")
    switch.select_option("")
    expect(page.locator(".card", has_text="micropitting")).to_have_count(0)
    expect(section.locator(stage)).to_have_value("")


def test_a_long_case_is_posted(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING))
    page.locator('[name="coupling.teeth"]').fill("400")
    errors = " ".join(f"{0.123456789 * (index % 7):.12f}" for index in range(400))
    page.locator('[name="coupling.pitch_errors_um"]').fill(errors)
    expect(page.locator('[id="f.coupling.pitch_errors_um-count"]')).to_have_text("400 values")
    expect(page.locator(".tools")).to_contain_text("too long for a link")
    loaded = page.locator(".chart img").evaluate_all(LOADED)
    assert len(loaded) == len(BY_PATH["/v1/coupling"].figures)
    assert all(width > 400 for width, _ in loaded)
    assert page.url.endswith("/coupling?unlinked=on")  # no longer the case from which this one was made
    with page.expect_download() as download:
        page.get_by_role("button", name="Save as a file").click()
    page.get_by_role("button", name="Report", exact=True).click()
    expect(page.locator("h2").first).to_contain_text("Verdict")
    page.goto("/coupling?unlinked=on")
    expect(page.locator(".warning")).to_contain_text("does not contain the case")
    page.locator(".open-file input").set_input_files(download.value.path())
    page.get_by_role("button", name="Open", exact=True).click()
    assert page.locator('[name="coupling.teeth"]').input_value() == "400"
    expect(page.locator(".card").first).to_be_visible()
    page.goto(address_of(COUPLING))
    page.locator('[name="operation.torque_n_m"]').fill("3100")
    expect(page).to_have_url(re.compile("torque_n_m=3100"))


def test_a_comparison_too_long_for_a_link_leaves_no_address_of_another_case(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING))
    page.locator('[name="coupling.teeth"]').fill("400")
    errors = " ".join(f"{1.12345 + 0.1 * (index % 7):.5f}" for index in range(400))
    page.locator('[name="coupling.pitch_errors_um"]').fill(errors)
    expect(page).to_have_url(re.compile("pitch_errors_um"))
    page.locator("#pin").click()
    expect(page.locator(".before").first).to_be_visible()
    page.locator('[name="operation.torque_n_m"]').fill("3100")
    expect(page.locator(".differences")).to_contain_text("3100")
    assert page.url.endswith("/coupling?unlinked=on")


def test_keyboard_alone(visit: Callable[..., Page]) -> None:
    page = visit(address_of(COUPLING))
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.className") == "skip"
    for _ in range(80):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.name") == "operation.torque_n_m":
            break
    assert page.evaluate("document.activeElement.name") == "operation.torque_n_m"
    expect(page.locator('[id="f.operation.torque_n_m-help"]')).to_be_visible()
    page.keyboard.press("Control+a")
    page.keyboard.type("2500")
    page.keyboard.press("Enter")
    expect(page).to_have_url(re.compile("torque_n_m=2500"))


@pytest.mark.parametrize("name", STARTERS)
def test_a_phone_needs_no_sideways_scrolling(visit: Callable[..., Page], name: str) -> None:
    page = visit(address_of(name), viewport=PHONE)
    assert overflow(page) == 0
    page.evaluate("document.querySelectorAll('#form details, #result details').forEach(part => part.open = true)")
    assert overflow(page) == 0
    cut = "[...document.querySelectorAll('.named td')].filter(cell => cell.getBoundingClientRect().right > 360).length"
    assert page.evaluate(cut) == 0
    top: float = page.locator("#result").bounding_box()["y"]  # type: ignore[index]
    assert top < page.locator("#form").bounding_box()["y"]  # type: ignore[index]


OVERLAPPING = """() => {
  const drawn = [...document.querySelectorAll(".method math")].map(each => each.getBoundingClientRect());
  return drawn.filter((each, index) => drawn.slice(index + 1).some(other => each.left < other.right - 1
    && other.left < each.right - 1 && each.top < other.bottom - 1 && other.top < each.bottom - 1)).length;
}"""


@pytest.mark.parametrize("name", sorted(examples()))
def test_reports_print_on_ten_pages(visit: Callable[..., Page], name: str, tmp_path: Path) -> None:
    page = visit(address_of(name, "/report"))
    cut = page.evaluate("[...document.images].filter(image => !image.complete || image.naturalWidth === 0).length")
    assert cut == 0
    assert page.evaluate(OVERLAPPING) == 0
    for paper in ("A4", "Letter"):
        file = tmp_path / f"{paper}.pdf"
        page.pdf(path=file, format=paper)
        pages = len(re.findall(rb"/Type\s*/Page\b", file.read_bytes()))
        assert 1 <= pages <= MOST_PAGES


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(examples()))
def test_texts_of_figures_are_seven_points_high_in_a_printed_report(
    visit: Callable[..., Page], name: str, tmp_path: Path
) -> None:
    page = visit(address_of(name, "/report"))
    page.evaluate("document.body.replaceChildren(...document.querySelectorAll('figure'))")
    figures = page.evaluate("document.images.length")
    file = tmp_path / "report.pdf"
    page.pdf(path=file, format="A4")
    found = dict[str, float]()

    def measure(text: str, page_matrix: list[float], text_matrix: list[float], _: object, size: float) -> None:
        up = np.array(text_matrix[2:4]) @ np.reshape(page_matrix[:4], (2, 2))
        if text.strip():
            found[text.strip()] = min(found.get(text.strip(), np.inf), size * float(np.linalg.norm(up)))

    for sheet in pytest.importorskip("pypdf").PdfReader(file).pages:
        sheet.extract_text(visitor_text=measure)
    assert len(found) > 5 * figures > 0
    low = {text: height for text, height in found.items() if height < 7.0}
    assert all(len(text) <= SUBSCRIPT and height >= 4.9 for text, height in low.items()), low


COVERED = """id => {
  const help = document.getElementById(id).getBoundingClientRect();
  const others = [...document.querySelectorAll("#form :is(input, select)")].filter(field => field.offsetParent);
  return others.map(field => field.getBoundingClientRect()).filter(field =>
    field.left < help.right && field.right > help.left && field.top < help.bottom && field.bottom > help.top).length;
}"""


@pytest.mark.parametrize("viewport", [PHONE, DESK])
@pytest.mark.parametrize("name", ["gears.wheel.teeth", "gears.pinion.profile_shift", "load.pinion_speed_rpm"])
def test_the_help_of_a_field_covers_no_field(visit: Callable[..., Page], name: str, viewport: dict[str, int]) -> None:
    page = visit(address_of(SCUFFING), viewport=viewport)
    page.locator(f'[name="{name}"]').focus()
    expect(page.locator(f'[id="f.{name}-help"]')).to_be_visible()
    assert page.evaluate(COVERED, f"f.{name}-help") == 0
    assert overflow(page) == 0


@pytest.mark.parametrize("touch", [False, True], ids=["mouse", "touch"])
def test_a_choice_below_an_open_help_is_hit(visit: Callable[..., Page], touch: bool) -> None:
    """The help between the two choices closes only after the button is released, and only then the layout moves."""
    page = visit(address_of(SCUFFING), viewport=PHONE, has_touch=touch, is_mobile=touch)
    choice = page.locator("fieldset.choice").first
    one, other = choice.locator("label.pick").nth(0), choice.locator("label.pick").nth(1)
    one.locator("input").check()
    # Faults at the fields move what is below them.
    wait_until(lambda: page.evaluate("running === null && shown === caseOf(form)"))
    choice.locator(".field input:visible").first.focus()
    expect(choice.locator(".help").first).to_be_visible()
    other.scroll_into_view_if_needed()
    box = other.bounding_box()
    assert box
    x, y = box["x"] + 12.0, box["y"] + box["height"] / 2.0
    if touch:
        page.touchscreen.tap(x, y)
    else:
        page.mouse.move(x, y)
        page.mouse.down()
        page.wait_for_timeout(100)
        page.mouse.up()
    expect(other.locator("input")).to_be_checked()
    expect(choice.locator(".help").first).to_be_hidden()


@pytest.mark.slow
def test_the_bar_of_a_phone_jumps_to_where_each_part_begins(visit: Callable[..., Page]) -> None:
    page = visit(address_of(SCUFFING), viewport=PHONE)
    for name, part in (("Inputs", "form"), ("Results", "result"), ("Figures", "figures"), ("Values", "all")):
        page.locator(".jump a", has_text=name).click()
        page.wait_for_function(
            "id => Math.abs(document.getElementById(id).getBoundingClientRect().top) < 100", arg=part
        )


@pytest.mark.slow
def test_back_from_a_study_returns_to_the_edited_case(visit: Callable[..., Page]) -> None:
    page = visit(address_of("starter-high-speed-scuffing"))
    page.locator('[name="load.power_kw"]').fill("11000")
    expect(page.locator("#copy")).to_have_attribute("href", re.compile("power_kw=11000"))
    page.get_by_role("link", name="How much load does a hotter oil leave?").click()
    expect(page).to_have_url(re.compile(r"/vary\?.*power_kw=11000"))
    page.go_back()
    expect(page.locator('[name="load.power_kw"]')).to_have_value("11000")
    expect(page.locator(".card")).to_have_count(3)


@pytest.mark.slow
def test_a_named_case_is_saved_as_a_file_and_opened_from_the_start_page(
    visit: Callable[..., Page], tmp_path: Path
) -> None:
    page = visit(address_of(COUPLING))
    page.get_by_label("Title of the case").fill("Mill 7")
    expect(page.locator("#copy")).to_have_attribute("href", re.compile(r"Mill(\+|%20)7"))
    with page.expect_download() as saving:
        page.get_by_role("link", name="Save").click()
    saving.value.save_as(tmp_path / saving.value.suggested_filename)
    start = visit("/")
    start.locator("input[type=file]").last.set_input_files(tmp_path / "Mill 7.json")
    start.get_by_role("button", name="Open").last.click()
    expect(start.get_by_label("Title of the case")).to_have_value("Mill 7")
    expect(start.locator(".card").first).to_be_visible()


def test_back_from_a_calculation_returns_to_the_gear_unit(visit: Callable[..., Page]) -> None:
    page = visit("/")
    file = {"name": "unit.rexs", "mimeType": "application/xml", "buffer": turbo_unit().xml()}
    page.locator("#rexs-file").set_input_files(file)
    page.locator("form", has=page.locator("#rexs-file")).get_by_role("button", name="Open").click()
    expect(page.get_by_role("heading", name="Stages")).to_be_visible()
    page.get_by_role("link", name="Load distribution").first.click()
    expect(page.locator('[name="gears.pinion.teeth"]')).to_be_visible()
    page.go_back()
    expect(page.get_by_role("heading", name="Stages")).to_be_visible()
    page.reload()
    expect(page.get_by_role("heading", name="Stages")).to_be_visible()


@pytest.mark.parametrize("size", [PHONE, DESK], ids=lambda size: f"{size['width']} px")
def test_a_result_leads_to_the_place_that_names_it(visit: Callable[..., Page], size: dict[str, int]) -> None:
    page = visit(address_of("pahl-axial-displacement"), viewport=size)
    everything = page.locator("#all")
    everything.evaluate("all => [all, ...all.querySelectorAll('details')].forEach(each => { each.open = true; })")
    row = everything.locator("tr", has_text="contact shift moment")
    expect(row).to_be_visible()
    row.locator(".place a").click()
    expect(page.locator(".landed:visible")).to_have_count(1)
    expect(page.locator(".landed:visible")).to_contain_text("contact shift moment")
