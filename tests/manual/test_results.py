"""Every result names the place in the manual that says how the result is computed, and links to this place."""

import re
from pathlib import Path
from random import Random

import pytest

from app.calculations import CALCULATIONS, Calculation
from app.examples import examples
from app.manual import NAMES, chapters
from app.manual.results import place_of
from app.pages.cases import Asked
from app.pages.manual import chapter_page, symbols_of
from app.pages.query import pairs_of
from app.pages.results import NOT_RESULTS
from app.schema.fields import Leaf, leaves
from tests.support.pages import html_of

DRAWN = 10


def listed(calculation: Calculation) -> list[Leaf]:
    """Return the fields that stand in the tables of results and of derived numbers."""
    shown = [leaf for leaf in leaves(calculation.response) if leaf.path.split(".")[0] not in NOT_RESULTS - {"derived"}]
    return [leaf for leaf in shown if leaf.is_scalar or (leaf.declared.index and not leaf.axes)]


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_every_result_names_its_place_in_the_manual(calculation: Calculation) -> None:
    assert [leaf.path for leaf in listed(calculation) if place_of(leaf.declared) is None] == []


def test_every_place_is_on_its_page() -> None:
    anchors = {name: set(re.findall(r'\bid="([^"]+)"', chapter_page("", name))) for name in NAMES}
    for calculation in CALCULATIONS:
        for leaf in listed(calculation):
            place = place_of(leaf.declared)
            assert place
            assert place.address.partition("#")[2] in anchors[place.chapter], place.address


def test_ten_drawn_numbers_of_a_page_lead_to_their_equations() -> None:
    html = html_of(Asked("/coupling", pairs_of(examples()["pahl-axial-displacement"].request)))
    table = html.partition('<details class="panel" id="all"')[2].partition('<p class="curves">')[0]
    rows = re.findall(r'data-path="([^"]+)".*?<td class="place"><a href="([^"]+)">([^<]+)</a></td>', table, re.DOTALL)
    assert len(rows) == table.count("data-path=")
    for _, address, text in Random(46).sample(rows, DRAWN):
        chapter, _, anchor = address.removeprefix("/manual/").partition("#")
        assert f'id="{anchor}"' in chapter_page("", chapter)
        assert text.startswith(("Eq. ", "section "))


@pytest.mark.parametrize("name", sorted(set(NAMES) - {"first-pair", "service", "spectrum", "fields"}))
def test_a_chapter_lists_its_symbols(name: str) -> None:
    symbols = symbols_of(chapters()[name])
    assert len(symbols) > 3
    assert len({(each.declared.symbol, each.declared.title) for each in symbols}) == len(symbols)
    assert 'href="#symbols"' in chapter_page("", name)


@pytest.mark.parametrize(
    "hard",
    [
        "shears at less",
        "rought back through all of this at its own failing stage",
        "are in the limit temperature or nowhere",
        "a limit of validity is left",
        "each sentence is half right",
        "a bend above 1",
        "no end becomes sonic",
    ],
)
def test_sentences_that_had_to_be_read_twice_are_gone(hard: str) -> None:
    files = (Path(__file__).parents[2] / "app").rglob("*")
    texts = [path.read_text("utf-8") for path in files if path.suffix in {".py", ".md", ".html", ".json"}]
    assert not [text for text in texts if hard in text]
