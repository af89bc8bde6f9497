"""The report of a case states which values were used and where they come from, in words for customers."""

import json
import re
from dataclasses import replace
from functools import cache
from html import unescape

import pytest

from app.examples import examples
from app.manual import NAMES
from app.manual.equations import equations
from app.pages import views
from app.pages.cases import solved
from app.pages.manual import chapter_page, contents_page, functions_page
from app.pages.query import pairs_of
from app.pages.results import flattened
from app.schema.fields import leaf_at
from tests.support.pages import asked

pytestmark = [pytest.mark.ci, pytest.mark.usefixtures("without_images")]

SCUFFING = "starter-industrial-scuffing"
SHORT = (SCUFFING, "starter-coupling-crowning", "starter-compressor-gear", "starter-generator-gear-drive-train")


@cache
def report(name: str) -> str:
    return views.report(asked(name), "").content.decode()


@cache
def page(name: str) -> str:
    return views.page(asked(name)).content.decode()


def rows(html: str, first: str, last: str) -> dict[str, tuple[str, ...]]:
    """Return the table rows between the headings `first` and `last`. The key of a row is its first cell."""
    part = html[html.index(f"<h2>{first}") : html.index(f"<h2>{last}")]
    found = re.findall(r"<tr>(.*?)</tr>", part, re.DOTALL)
    cells = [re.findall(r"<td[^>]*>(.*?)</td>", row, re.DOTALL) for row in found]
    texts = [tuple(unescape(re.sub(r"<[^>]+>", "", cell)).strip() for cell in row) for row in cells]
    return {row[0]: row[1:] for row in texts}


def test_inputs_say_the_value_used_and_where_it_comes_from() -> None:
    inputs = rows(report(SCUFFING), "Inputs", "Assumptions")
    assert inputs["transmitted power P"] == ("400 kW", "given")
    assert inputs["pinion torque T1"] == ("2546.48 N m", "derived")
    assert inputs["centre distance a"] == ("264.963 mm", "derived")
    assert inputs["pressure-viscosity coefficient α"] == ("17.0207 1/GPa", "assumed")
    assert inputs["oil density ρ0"] == ("843.537 kg/m³", "derived")
    assert inputs["rheology"] == ("Ree-Eyring", "assumed")
    left = unescape(re.sub(r"<[^>]+>", "", report(SCUFFING).partition("<h3>Left to their defaults")[2]))
    assert "Young's modulus E 206 GPa;" in left
    assert "bulk temperature θM (estimated)." in left


@pytest.mark.parametrize("name", SHORT[:3])
def test_no_input_is_dropped(name: str) -> None:
    """The report names every input."""
    # Given, assumed and derived inputs stand in tables, and the other inputs stand in a text.
    case = asked(name)
    part = report(name)
    part = part[part.index("<h2>Inputs") : part.index("<h2>Assumptions")]
    text = unescape(re.sub(r"<[^>]+>", "", part))
    used = flattened(solved(case.calculation, case.pairs, None).response.inputs)
    stated = (leaf_at(case.calculation.request, path) for path, value in used.items() if value is not None)
    titles = {leaf.title.partition(",")[0] for leaf in stated if leaf}
    assert len(titles) > 20
    assert not {title for title in titles if f"{title} " not in text}
    assert set(re.findall(r'<td class="origin [^"]*">([^<]*)</td>', part)) <= {"given", "assumed", "derived"}


@pytest.mark.parametrize("name", SHORT)
def test_only_what_was_given_is_said_to_be_given(name: str) -> None:
    typed = {path for path, _ in pairs_of(examples()[name].request)}
    part = report(name)
    part = part[part.index("<h2>Inputs") : part.index("<h2>Assumptions")]
    cells = re.findall(r'<td class="right [^"]*\bgiven\b[^"]*">([^<]*)</td>', part)
    assert len(cells) == len({re.sub(r"\.[01]\.[01]$", "", path) for path in typed})
    assert not [cell for cell in cells if "with grade" in cell or "value" in cell]


def test_a_report_can_be_signed() -> None:
    """Each name is followed by two empty lines, for the date and the signature."""
    # The report names the REXS file of the gear unit and the SHA-256 of this file.
    names = {"author": "A. Miller", "checker": "B. Smith", "approver": "C. Jones", "revision": "B"}
    file = {"rexs_file": "unit.rexs", "rexs_sha256": "ab" * 32, "rexs_stage": "5"}
    html = views.report(asked("pahl-axial-displacement", **names, **file), "").content.decode()
    signatures = re.findall(r"<tr><td>(author|checked|approved)</td><td>([^<]*)</td>(.*?)</tr>", html)
    assert [(role, name) for role, name, _ in signatures] == [
        ("author", "A. Miller"),
        ("checked", "B. Smith"),
        ("approved", "C. Jones"),
    ]
    assert all(lines.count('class="line"') == 2 for *_, lines in signatures)
    assert "<dt>revision</dt><dd>B</dd>" in html
    assert f"unit.rexs, SHA-256 <code>{'ab' * 32}</code>" in html
    assert '<input type="hidden" name="rexs_stage" value="5">' in html


def test_the_short_form_has_what_was_given_and_no_equations() -> None:
    short = views.report(asked("pahl-axial-displacement", extent="short"), "").content.decode()
    full = report("pahl-axial-displacement")
    assert "<h2>Method" in full
    assert "<h2>Symbols" in full
    assert "<h2>Method" not in short
    assert "<h2>Results" not in short
    assert short.count("<figure") <= 4 < full.count("<figure")
    origins = set(re.findall(r'<td class="origin [^"]*">([^<]*)</td>', short))
    assert origins == {"given"}
    assert "assumed" in re.findall(r'<td class="origin [^"]*">([^<]*)</td>', full)


def test_groups_repeat_their_heading_and_name_their_parts() -> None:
    unit = report("starter-generator-gear-drive-train")
    for heading in ("pinion shaft · bearings 1", "wheel shaft · bearings 1"):
        assert re.search(rf'<thead><tr><td class="heading" colspan="4">[^<]*{heading}', unit), heading
    assert re.search(r"reaction.*?<td class=\"right\">X −?[\d.\s\u202f]+, Y ", unit)
    assert re.search(r'<td class="place">Eq. D5</td>', unit)


def test_the_page_writes_results_back_into_the_file() -> None:
    """The page of a case from a REXS file has a form that sends the request of the case."""
    # The page of a case that was not read from a file has no such form.
    file = {"rexs_sha256": "ab" * 32, "rexs_stage": "5"}
    case = replace(asked(SCUFFING, **file), pairs=[*asked(SCUFFING).pairs, ("model.lubrication", "closed_form")])
    html = views.page(case).content.decode()
    assert 'action="/v1/rexs/results?stage=5" method="post" enctype="multipart/form-data"' in html
    sent = json.loads(unescape(re.findall(r'name="request" value="([^"]*)"', html)[0]))
    assert sent["load"]["power_kw"] == 400
    assert case.report.count("rexs_stage=5") == 1
    assert "/v1/rexs/results" not in views.page(asked("pahl-axial-displacement")).content.decode()


def test_assumptions_have_units_and_reasons() -> None:
    assumed = rows(report(SCUFFING), "Assumptions", "Results")
    assert assumed["oil density at 15 °C ρ15"] == ("880 kg/m³", "by the kind of oil; few data sheets state it")
    assert assumed["Eyring stress τ0"][0] == "5 MPa"
    on_page = page(SCUFFING)
    on_page = on_page[on_page.index("<h2>Assumptions") :]
    assert re.search(r'880</td><td class="unit">kg/m³</td>', on_page)


def test_the_equations_are_those_of_every_section_that_was_asked_for() -> None:
    plain, checked = report(SCUFFING), report("starter-industrial-micropitting")
    assert "<p>Xue 25 " in plain
    assert "<h2>Method: Micropitting" not in plain
    assert "<p>Xue 25 " in checked
    numbers = {each.number for each in equations().values() if each.chapter == "micropitting"}
    assert {number for number in numbers if f"<p>{number} " in checked} == numbers
    balanced = report("starter-turbo-pair-heat")
    assert "<p>H5 " in balanced
    assert "<h2>Method: Heat balance" not in plain
    assert "°C known to about ±15 K" in balanced
    assert "°C known to about ±15 K" not in report("starter-turbo-pair-heat-measured")


def test_customers_read_secondary_source() -> None:
    assert "ISO/TS 6336-20:2017 (ISO/TR 13989-1), secondary source" in page(SCUFFING)


SECOND_HAND = re.compile(r"from memory|as read in|public implementation")


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in SHORT else pytest.mark.slow) for name in sorted(examples())]
)
def test_customers_read_nothing_from_memory(name: str) -> None:
    case = asked(name)
    shown = views.page(case)
    again = replace(case, kept=next(iter(shown.keep.values())))
    answer, table = (views.result(again, kind) for kind in ("json", "csv"))
    for text in (shown, views.report(again, ""), answer, table):
        assert not SECOND_HAND.search(text.content.decode())


def test_readers_of_the_manual_read_nothing_from_memory() -> None:
    pages = [contents_page(""), functions_page(""), *(chapter_page("", name) for name in NAMES)]
    assert [found[0] for text in pages if (found := SECOND_HAND.search(text))] == []
