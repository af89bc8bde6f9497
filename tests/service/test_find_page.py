"""In a real browser three questions are asked backwards; each is answered in under a minute, also on a phone."""

import re
from collections.abc import Callable
from time import monotonic
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.support.browsing import DESK, PHONE, address_of, overflow, violations

pytestmark = pytest.mark.service

LONGEST_S = 60.0
QUESTIONS = {
    "flow": (
        "starter-turbo-pair-heat",
        {"x": "cooling.gear_flow_l_per_min", "show": "heat.band.safety.0"},
        "1.5",
        r"at the worst end is 1.5 there, and more beyond\.$",
    ),
    "grade": (
        "starter-industrial-micropitting",
        {"x": "lubricant.iso_vg", "show": "micropitting.local.safety"},
        "1.2",
        r"^ISO viscosity grade \d+ or more: ",
    ),
    "crowning": (
        "starter-industrial-gear-loads",
        {"x": "modifications.lead_crowning_um", "show": "pressure.max_mpa", "goal": "least"},
        "",
        r"^Helix crowning .* is least there, ",
    ),
}


@pytest.mark.parametrize("window", [DESK, PHONE], ids=["desk", "phone"])
@pytest.mark.parametrize("name", QUESTIONS)
def test_a_question_asked_backwards(visit: Callable[..., Page], name: str, window: dict[str, Any]) -> None:
    example, choices, wanted, sentence = QUESTIONS[name]
    page = visit(address_of(example), viewport=window)
    page.get_by_role("link", name="Find", exact=True).click()
    begun = monotonic()
    for control, choice in choices.items():
        page.locator(f'select[name="{control}"]').select_option(choice)
    if wanted:
        page.locator('input[name="wanted"]').fill(wanted)
    page.get_by_role("button", name="Calculate").click()
    expect(page.locator(".conclusion").last).to_have_text(re.compile(sentence), timeout=1000 * LONGEST_S)
    assert monotonic() - begun < LONGEST_S
    expect(page.locator(".frame .chart img").last).to_be_visible()
    assert overflow(page) <= 0
    assert violations(page) == []
    if name == "grade":
        expect(page.locator(".frame").last).to_contain_text("belongs to the oil of the case")
        page.get_by_role("link", name="Compare oils with stages of their own").last.click()
        expect(page.locator(".conclusion").last).to_contain_text("oil", timeout=1000 * LONGEST_S)
    else:
        page.get_by_role("link", name=re.compile("Open the case with")).last.click()
        expect(page.locator(".card").first).to_be_visible(timeout=1000 * LONGEST_S)
