"""Users complete tasks over several pages with the keyboard at the desk and by touch on a phone."""

import re
from collections.abc import Callable
from hashlib import sha256
from typing import Any
from urllib.parse import urlencode

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.rexs.units import turbo_unit
from tests.support.browsing import address_of, overflow

pytestmark = pytest.mark.service

DESK: dict[str, Any] = {"viewport": {"width": 1280, "height": 800}}
PHONE: dict[str, Any] = {"viewport": {"width": 360, "height": 740}, "has_touch": True, "is_mobile": True}
LEAST_LETTERS = 9.0  # px, of the texts of figures on a phone
WINDOWS = pytest.mark.parametrize("window", [DESK, PHONE], ids=["desk", "phone"])


def act(page: Page, window: dict[str, Any], name: str) -> None:
    """Open the list of other calculations, or follow a link in the list.

    On a phone this is done by touch, at the desk with the keyboard.
    """
    target = page.locator(".carried").get_by_text(name, exact=True).locator("visible=true").first
    if window is PHONE:
        target.tap()
    else:
        target.focus()
        page.keyboard.press("Enter")


@WINDOWS
def test_from_scuffing_to_whether_it_is_choked_nothing_is_typed(
    visit: Callable[..., Page], window: dict[str, Any]
) -> None:
    page = visit(f"{address_of('starter-industrial-scuffing')}&model.lubrication=closed_form", **window)
    act(page, window, "Use this pair in …")
    act(page, window, "Pumping between gear teeth")
    expect(page.locator(".finding")).to_contain_text("Not choked")
    expect(page.locator(".cards")).to_contain_text("axial choking")
    assert overflow(page) <= 0
    act(page, window, "Use this pair in …")
    act(page, window, "Scuffing of gears")
    expect(page.locator('[name="lubricant.iso_vg"]').first).to_have_value("320")
    expect(page.locator(".card").first).to_be_visible()


@WINDOWS
def test_the_top_of_the_coupling_answers_the_question(visit: Callable[..., Page], window: dict[str, Any]) -> None:
    page = visit(address_of("pahl-axial-displacement"), **window)
    expect(page.locator(".finding")).to_contain_text("Permissible")
    for text in ("Free axially", "a misalignment up to"):
        expect(page.locator(".conclusion")).to_contain_text(text)
    expect(page.locator(".cards")).to_contain_text("permissible misalignment")
    assert overflow(page) <= 0


@WINDOWS
def test_a_report_is_filled_in_for_its_signatures(visit: Callable[..., Page], window: dict[str, Any]) -> None:
    page = visit(address_of("pahl-axial-displacement", "/report"), **window)
    for label, text in (("revision", "B"), ("author", "J. Doe"), ("approved by", "C. Jones")):
        page.get_by_label(label, exact=True).fill(text)
    page.get_by_label("length").select_option("short")
    page.get_by_role("button", name="Put on the report").press("Enter")
    expect(page.locator(".signatures")).to_contain_text("J. Doe")
    assert page.locator(".signatures .line").count() == 6
    expect(page.get_by_role("heading", name="Results")).to_have_count(0)
    assert overflow(page) <= 0


@pytest.mark.parametrize("name", ["xue-pair-1-scuffing", "starter-industrial-scuffing"])
def test_figures_are_whole_on_a_phone_and_their_texts_can_be_read(visit: Callable[..., Page], name: str) -> None:
    page = visit(address_of(name), **PHONE)
    plot = page.locator(".plot").first
    plot.scroll_into_view_if_needed()
    width: float = plot.locator("img").evaluate("image => image.getBoundingClientRect().width")
    assert width / (3.9 * 72.0) * 8.0 >= LEAST_LETTERS
    plot.hover(position={"x": 180, "y": 160})  # where the narrow image has its axes
    expect(plot.locator(".cursor, .ring").first).to_be_visible()
    image = plot.locator("img").evaluate("async image => { await image.decode(); return image.currentSrc; }")
    assert "narrow=on" in image
    for each in page.locator(".plot").all():
        assert each.evaluate("plot => plot.scrollWidth <= plot.clientWidth")
    assert overflow(page) <= 0


def test_no_empty_line_below_a_figure_and_no_empty_column(visit: Callable[..., Page]) -> None:
    page = visit(address_of("pahl-axial-displacement"), **DESK)
    page.locator(".plot img").first.scroll_into_view_if_needed()
    charts = page.locator("#figures").bounding_box()
    boxes = [box for chart in page.locator("#figures .chart").all() if (box := chart.bounding_box())]
    assert charts
    assert max(box["x"] + box["width"] for box in boxes) >= charts["x"] + charts["width"] - 1.0
    for chart in page.locator(".chart").all()[:2]:
        image, caption = chart.locator("img").bounding_box(), chart.locator("figcaption").bounding_box()
        assert image
        assert caption
        assert caption["y"] - image["y"] - image["height"] < 8.0
        assert caption["height"] < 45.0


def test_what_is_scrolled_to_is_not_below_the_cards(visit: Callable[..., Page]) -> None:
    page = visit(address_of("pahl-axial-displacement"), **DESK)
    page.locator(".jump a", has_text=re.compile("Values|Figures")).first.evaluate("link => link.click()")
    page.wait_for_timeout(500)
    target, cards = page.locator("#figures").bounding_box(), page.locator(".result > .cards").bounding_box()
    assert target
    assert cards
    below = cards["y"] + cards["height"]
    assert below <= target["y"] + 1.0 or below <= 0.0


def follow(link: Locator, window: dict[str, Any]) -> None:
    """Follow a link or press a button: by touch on a phone, with the keyboard at the desk."""
    if window is PHONE:
        link.tap()
    else:
        link.press("Enter")


@WINDOWS
def test_the_file_that_a_stage_was_read_from_stands_on_its_report_untyped(
    visit: Callable[..., Page], window: dict[str, Any]
) -> None:
    content = turbo_unit().xml()
    page = visit("/", **window)
    page.locator("#rexs-file").set_input_files(
        {"name": "mill 7.rexs", "mimeType": "application/xml", "buffer": content}
    )
    opening = page.locator("form", has=page.locator("#rexs-file"))
    follow(opening.get_by_role("button", name="Open"), window)
    expect(page.locator(".lead")).to_contain_text("mill 7.rexs")
    follow(page.locator("main").get_by_role("link", name="Load distribution").first, window)
    expect(page.locator(".card").first).to_be_visible()
    follow(page.get_by_role("link", name="Report", exact=True), window)
    expect(page.locator("header")).to_contain_text(f"mill 7.rexs, SHA-256 {sha256(content).hexdigest()}")
    expect(page.get_by_label("name of the REXS file")).to_have_value("mill 7.rexs")


@WINDOWS
def test_the_report_of_a_study_tells_how_many_points_are_calculated(
    visit: Callable[..., Page], window: dict[str, Any]
) -> None:
    said = {"t0": "operation.misalignment_deg", "t0.by": "0.01", "show": "axial_thrust.design_force_n"}
    said |= {"limit": "1500", "machines": "4096"}
    page = visit("/", **window)
    page.goto(f"{address_of('pahl-axial-displacement', '/spectrum/report')}&{urlencode(said)}", wait_until="commit")
    bar = page.locator("progress:visible")
    expect(page.locator(".progress:visible")).to_contain_text(re.compile("[1-9][0-9]* of [1-9][0-9]* points"))
    done, total = (float(bar.get_attribute(name) or 0) for name in ("value", "max"))
    assert 0.0 < done <= total
    assert overflow(page) <= 0
    expect(page.get_by_role("heading", name="Load spectrum")).to_be_visible()
    expect(bar).to_have_count(0)
    assert page.locator("h1").count() == 1
