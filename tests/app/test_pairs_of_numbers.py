"""Two numbers that belong together, such as the ends of a range, have a field each; a link keeps both in one field."""

import re
from html import unescape

import pytest

from app.calculations import BY_PATH
from app.pages import views
from app.pages.cases import Asked
from app.pages.query import body_of, from_form, normalised, with_pairs_apart
from tests.support.pages import asked, html_of

RANGE = "operation.misalignment_range_deg"
CROWNING = BY_PATH["/v1/coupling/recommendation"].request
TRAIN = BY_PATH["/v1/drive-train"].request


def fields_of(html: str, name: str) -> list[str]:
    """Return the texts of the two fields."""
    found = re.findall(rf'<input [^>]*name="{re.escape(name)}\.[01]"[^>]*>', html)
    return [re.search(r'value="([^"]*)"', each)[1] for each in found]  # type: ignore[index]


@pytest.mark.parametrize(
    ("typed", "kept"),
    [(("0.05", "0.09"), [0.05, 0.09]), (("0,05", "0,09"), [0.05, 0.09]), (("0.05°", "1.234"), [0.05, "1.234?"])],
)
def test_two_fields_are_one_range(typed: tuple[str, str], kept: list[object]) -> None:
    sent = [("written", ""), *((f"{RANGE}.{place}", text) for place, text in enumerate(typed))]
    pairs = normalised(CROWNING, from_form(CROWNING, sent))
    assert body_of(CROWNING, pairs) == {"operation": {"misalignment_range_deg": kept}}


def test_a_link_fills_in_both_fields() -> None:
    here = asked("starter-coupling-crowning")
    assert fields_of(html_of(here), RANGE) == ["0.05", "0.09"]
    apart = with_pairs_apart(CROWNING, here.pairs)
    assert dict(normalised(CROWNING, apart)) == dict(here.pairs)


def test_the_field_that_is_empty_is_named() -> None:
    here = asked("starter-coupling-crowning")
    pairs = [(name, text) for name, text in here.pairs if name != RANGE]
    html = unescape(html_of(Asked(here.path, [*pairs, (f"{RANGE}.1", "0.09")]), 422))
    assert re.search(rf'id="f\.{re.escape(RANGE)}\.0-fault"(?! hidden)', html)
    assert not re.search(rf'id="f\.{re.escape(RANGE)}\.1-fault"(?! hidden)', html)
    assert fields_of(html, RANGE) == ["", "0.09"]
    blank = views.form_page(Asked(here.path, [])).content.decode()
    assert 'placeholder="smallest"' in blank
    assert 'placeholder="largest"' in blank


def test_one_component_of_an_offset_is_enough() -> None:
    pairs = normalised(TRAIN, [("couplings.0.offset_um.1", "400")])
    assert body_of(TRAIN, pairs) == {"couplings": [{"offset_um": [0.0, 400]}]}
