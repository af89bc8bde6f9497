"""A page compares several variants in one table, and its form opens the section with the limit of the verdict."""

import re
from html import unescape

import pytest

from app.calculations import BY_PATH
from app.examples import examples
from app.pages import views
from app.pages.cases import Asked, solved
from app.pages.form import FormSection, FormState, form
from app.pages.query import link, pairs_of
from app.pages.typesetting import shown
from app.pages.variants import MOST, SEPARATOR, queries_of, with_this
from app.pages.views import _deciding
from app.schema.fields import leaf_at
from tests.support.pages import asked, asked_by, html_of
from tests.support.requests import changed

COUPLING = "pahl-axial-displacement"


def query(misalignment: float) -> str:
    operation = {**examples()[COUPLING].request["operation"], "misalignment_deg": misalignment}
    return link("", pairs_of(changed(examples()[COUPLING].request, {"operation": operation}))).removeprefix("?")


def table_of(html: str) -> list[list[str]]:
    """Return the rows of the table of variants. A row is a list of the texts of its cells."""
    table = html.partition('aria-label="Variants"')[2].partition("</table>")[0]
    rows = [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row, re.DOTALL) for row in table.split("</tr>")]
    return [[unescape(re.sub(r"<[^>]+>", "", cell)).strip() for cell in row] for row in rows if len(row) > 1]


def test_three_variants_stand_in_a_small_table() -> None:
    base = asked(COUPLING)
    here = Asked(base.path, base.pairs, {"ref": query(0.1), "also": query(0.2)})
    heads, *rows = table_of(html_of(here))
    assert heads == ["quantity", "symbol", "variant A", "variant B", "this case", "unit"]
    angle = next(row for row in rows if row[0] == "misalignment")
    assert angle[2:] == ["0.1", "0.2", "0.05", "°"]
    response = BY_PATH["/v1/coupling"].response
    sliding, thrust = (
        leaf_at(response, path).title
        for path in ("kinematics.max_sliding_velocity_m_per_s", "axial_thrust.design_force_n")
    )
    row = next(row for row in rows if row[0] == sliding)
    cases = [asked_by(f"/coupling?{each}").pairs for each in (query(0.1), query(0.2), here.query)]
    known = [solved(BY_PATH["/v1/coupling"], case, None).response.kinematics for case in cases]
    assert row[2:5] == [shown(each.max_sliding_velocity_m_per_s, 4) for each in known]
    assert not [row for row in rows if row[0] in {"torque", thrust}], "alike in all"


def test_keeping_a_variant_adds_it() -> None:
    base = asked(COUPLING)
    here = Asked(base.path, base.pairs, {"ref": query(0.1)})
    (address,) = re.findall(r'href="([^"]+)" title="keep this case as a further variant', html_of(here))
    kept = asked_by(unescape(address))
    assert queries_of(kept) == [here.query]
    assert kept.ref == query(0.1)
    assert queries_of(asked_by(kept.page)) == [here.query], "the link of the page keeps them"
    assert with_this(kept) == ""
    full = Asked(base.path, base.pairs, {"ref": "a", "also": SEPARATOR.join(f"x={place}" for place in range(MOST))})
    assert with_this(full) == ""


def test_a_variant_that_is_refused_is_named() -> None:
    base = asked(COUPLING)
    html = html_of(
        Asked(base.path, base.pairs, {"ref": query(0.1), "also": query(0.2).replace("teeth=52", "teeth=-1")})
    )
    assert "variant B cannot be computed" in html


def test_the_section_with_the_limit_of_the_verdict_is_open_and_near_the_top() -> None:
    calculation = BY_PATH["/v1/scuffing"]
    sections = form(calculation.request, FormState({}, deciding=_deciding(calculation)))
    places = {each.path: place for place, each in enumerate(sections)}
    needed = sum(each.needed for each in sections)
    assert places["temperatures"] == needed
    (temperatures,) = [each for each in sections if each.path == "temperatures"]
    assert temperatures.open
    (test,) = [
        each for each in temperatures.blocks if isinstance(each, FormSection) and each.path.endswith("scuffing_test")
    ]
    assert test.open, "the FZG stage is in sight"


def test_a_comparison_shows_only_what_differs() -> None:
    base = asked(COUPLING)
    html = unescape(html_of(Asked(base.path, base.pairs, {"ref": query(0.1)})))
    table = html.partition('id="all"')[2].partition('<p class="curves">Curves')[0]
    assert "no change" not in table
    assert "thrust limit of coaxial shafts" not in table, "alike in both"
    assert "largest contact travel" in table
    (alike,) = map(int, re.findall(r"(\d+) further results are alike in both", html))
    alone = html_of(base).partition('id="all"')[2].partition('<p class="curves">Curves')[0]
    rows = [text.count('data-path="') for text in (alone, table)]
    assert rows[0] == rows[1] + alike


@pytest.mark.ci
def test_every_variant_is_in_the_report() -> None:
    base = asked(COUPLING)
    also = SEPARATOR.join((query(0.2), query(0.3)))
    here = Asked(base.path, base.pairs, {"ref": query(0.1), "also": also})
    report = unescape(views.report(asked_by(here.report.replace("/report?", "?")), "").content.decode())
    table = report.partition("<h2>All variants</h2>")[2].partition("</table>")[0]
    row = next(row for row in table.split("</tr>") if "misalignment" in row)
    assert re.findall(r'<td class="right">([^<]*)</td>', row) == ["0.1", "0.2", "0.3", "0.05"]
    assert f'name="also" value="{also}"' in report, "the names of the report are added to the same variants"
