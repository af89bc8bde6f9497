"""The words on the pages agree with the numbers, and the pages do not show names of the interface."""

import re
from dataclasses import replace
from html import unescape
from typing import Any

import numpy as np
import pytest

from app.calculations import BY_PATH, CALCULATIONS, CARDS, card_of
from app.examples import examples
from app.figures.data import Axis
from app.figures.studies import Coordinate, Grid, answer
from app.figures.wording import to_digits
from app.models.card import Calculation, Card
from app.pages import overview
from app.pages.cases import Asked, solved
from app.pages.overview import start_page, unit_page
from app.pages.query import WRITTEN, from_form, link, pairs_of
from app.pages.results import cards, conclusion, verdict, verdicts
from app.pages.studies.sensitivity import SensitivityPage
from app.pages.study_links import studies_of_case
from app.pages.templating import ASSETS, by_model, examples_of, page_path
from app.pages.typesetting import together
from tests.support.pages import asked, asked_by, checked, html_of, lines_of, whole
from tests.support.requests import changed

SCUFFING, COUPLING = "starter-industrial-scuffing", "pahl-axial-displacement"
CLOSED = {"model": {"lubrication": "closed_form"}}


def compared(name: str, changes: dict[str, Any]) -> str:
    """Return the page that compares a changed example with the example.

    Scuffing examples use the closed form of the lubrication on both sides of the comparison.
    """
    example = examples()[name]
    base = changed(example.request, CLOSED) if example.endpoint == "/v1/scuffing" else example.request
    ref = link("", pairs_of(base)).removeprefix("?")
    path = example.endpoint.removeprefix("/v1")
    return html_of(Asked(path, pairs_of(changed(base, changes)), {"ref": ref}))


def change_of(html: str, path: str) -> str:
    """Return the change of the number at `path`, as the table of results states the change."""
    (row,) = re.findall(rf'data-path="{re.escape(path)}".*?</tr>', html, re.DOTALL)
    return re.findall(r'<td class="right">([^<]*)</td></tr>', row)[0]


def test_temperatures_change_by_differences_and_lengths_by_shares() -> None:
    temperatures = examples()[SCUFFING].request["temperatures"]
    html = compared(SCUFFING, {"temperatures": {**temperatures, "oil_c": temperatures["oil_c"] - 20.0}})
    (oil,) = re.findall(r"<tr><td[^>]*>oil temperature.*?</tr>", html, re.DOTALL)
    assert "−20 K" in oil
    assert re.fullmatch(r"−[\d.]+ K", change_of(html, "contact_temperature.blok_max_c"))
    assert change_of(html, "film.dowson_higginson_min_um").endswith(" %")


def test_angles_change_by_differences() -> None:
    operation = {**examples()[COUPLING].request["operation"], "misalignment_deg": 0.1}
    coupling = compared(COUPLING, {"operation": operation})
    (angle,) = re.findall(r"<tr><td[^>]*>misalignment<.*?</tr>", coupling, re.DOTALL)
    assert "+0.05°" in angle


@pytest.mark.ci
def test_a_step_of_a_temperature_is_in_kelvins() -> None:
    base = asked(SCUFFING, show="contact_temperature.blok_max_c")
    closed = Asked(base.path, [*base.pairs, ("model.lubrication", "closed_form")], base.views)
    study = checked(SensitivityPage, closed)
    page = whole(study, lines_of(study))
    assert re.search(r"oil temperature</a></td><td[^>]*>[\d.]+</td><td[^>]*>°C</td><td[^>]*>±[\d.]+ K<", page)
    assert "lowered, K<" in page


@pytest.mark.parametrize("typed", ["2 K", "2 °C", "2"])
def test_a_deviation_of_a_temperature_is_typed_in_kelvins(typed: str) -> None:
    said = [("t0", "temperatures.oil_c"), ("t0.by", typed), (WRITTEN, "")]
    assert dict(from_form(BY_PATH["/v1/scuffing"].request, said))["t0.by"] == "2"


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (266.7, 3.7, "267"),
        (266.7, 37.0, "270"),
        (266.7, 0.0, "267"),
        (266.7, 180.0, "300"),
        (0.01234, 2e-5, "0.0123"),
        (0.0, 1.0, "0"),
    ],
)
def test_a_number_has_the_digits_that_its_error_leaves(value: float, error: float, text: str) -> None:
    assert to_digits(value, error) == text


def coupling(**changes: Any) -> Any:
    return solved(BY_PATH["/v1/coupling"], pairs_of(changed(examples()[COUPLING].request, changes)), None).response


def pumping(name: str) -> Any:
    return solved(BY_PATH["/v1/pumping"], pairs_of(examples()[name].request), None).response


def test_the_top_of_the_coupling_judges_thrust_and_misalignment_and_answers_the_question() -> None:
    slides = coupling()
    judged = verdicts(slides)
    assert "give the shaft diameter" in judged["axial_thrust.design_force_n"].text
    assert judged["limits.allowable_misalignment_deg"].level == "good"
    said = conclusion(slides)
    assert said.startswith("Free axially: its thrust in motion is 9.2")
    assert slides.lubrication.regime.name in verdict(slides).text
    assert "permits a misalignment up to" in said
    assert "limits.allowable_misalignment_deg" in {row.path for row in cards(slides, {})}
    assert together(said) in unescape(re.sub(r"<[^>]+>", "", html_of(asked(COUPLING))))


def test_a_thrust_without_axial_velocity_is_said() -> None:
    """Two meshes in a Z push each other although the shafts do not move axially."""
    response = solved(BY_PATH["/v1/coupling"], pairs_of(examples()["pahl-z-arrangement"].request), None).response
    assert conclusion(response).startswith("Free axially: its thrust in motion is 4.42 %")
    still = coupling(**{"operation.axial_velocity_mm_per_s": 0.0})
    assert conclusion(still).startswith("Free axially: without axial velocity it has no thrust in motion.")


@pytest.mark.parametrize(("diameter", "level", "words"), [(30.0, "good", "below"), (150.0, "bad", "exceeds")])
def test_thrust_is_compared_with_the_customary_one(diameter: float, level: str, words: str) -> None:
    operation = {**examples()[COUPLING].request["operation"], "shaft_diameter_mm": diameter}
    judged = verdicts(coupling(operation=operation))["axial_thrust.design_force_n"]
    assert judged.level == level
    assert judged.text.startswith(words)


def test_a_doubtful_verdict_is_on_the_cards_and_in_the_answer() -> None:
    found = pumping("milian-table-1")
    assert found.pinion_spaces
    assert "doubtful" not in verdicts(found)["pinion_spaces.peak_axial_mach"].text
    choking = found.choking.model_copy(update={"inflow": "doubtful", "inflow_mach": 0.98, "inflow_uncertainty": 0.07})
    inside = found.pinion_spaces.model_copy(update={"peak_axial_mach": 1.26})
    doubtful = found.model_copy(update={"choking": choking, "pinion_spaces": inside})
    judged = verdicts(doubtful)["pinion_spaces.peak_axial_mach"]
    assert judged.level == "near"
    assert "inflow doubtful (Ma 0.98)" in judged.text
    assert "inside the spaces of the pinion the gas is faster than sound" in judged.text
    assert verdict(doubtful).text.startswith("Doubtful whether choked, with ")
    assert "the inflow at the ends (Ma 0.98 ± 7 %)" in verdict(doubtful).text
    (card,) = [row for row in cards(doubtful, {}) if row.path == "pinion_spaces.peak_axial_mach"]
    assert (card.level, card.remark) == (judged.level, f"{judged.text}; see the warnings")


def test_choking_of_any_gear_is_on_the_card() -> None:
    found = pumping("milian-table-1")
    space = found.pinion_spaces or found.wheel_spaces
    assert space
    changes = {
        "pinion_spaces": space,
        "wheel_spaces": space,
        "choking": found.choking.model_copy(update={"inflow": "choked"}),
    }
    choked = found.model_copy(update=changes)
    (card,) = [row for row in cards(choked, {}) if row.path.endswith("peak_axial_mach")]
    assert card.level == "bad"
    assert "inflow choked" in card.remark
    assert verdict(choked).text.startswith("Choked: the inflow at the ends")


@pytest.mark.parametrize(("word", "level"), [("choked", "bad"), ("doubtful", "near"), ("not choked", "good")])
@pytest.mark.parametrize(
    ("flow", "path"),
    [("outflow", "peak_axial_mach"), ("inflow", "peak_axial_mach"), ("clearances", "peak_pressure_ratio")],
)
def test_a_choked_flow_is_bad_and_a_doubtful_one_nearly(flow: str, path: str, word: str, level: str) -> None:
    found = pumping("milian-table-1")
    choking = found.choking.model_copy(update=dict.fromkeys(("outflow", "inflow", "clearances"), "not choked"))
    choking = choking.model_copy(update={flow: word})
    calm = found.pinion_spaces.model_copy(update={"peak_axial_mach": 0.5})
    judged = verdicts(found.model_copy(update={"choking": choking, "pinion_spaces": calm}))
    assert judged[f"pinion_spaces.{path}"].level == level


POWER = Coordinate(Axis("power", unit="kW"), np.array([100.0, 200.0, 300.0, 400.0]))


@pytest.mark.parametrize(
    ("limit", "said"),
    [
        (1.0, "The safety crosses its limit 1 at about 240 kW; it is above the limit at 100 kW; greatest 3 at power"),
        (0.1, "The safety is above its limit 0.1 at every point; greatest 3 at power 100 kW, where its"),
        (5.0, "The safety is above its limit 5 at no point; greatest 3 at power 100 kW, where its"),
        (None, "The safety goes from 3 at 100 kW to 0.4 at 400 kW; greatest 3 at power 100 kW, where its"),
    ],
)
def test_a_sweep_answers_in_a_sentence(limit: float | None, said: str) -> None:
    safety = np.array([3.0, 1.3, 0.5, 0.4])
    assert answer(Grid(POWER, None, Axis("safety"), safety, greatest=True, limit=limit)).startswith(said)


def test_ready_questions_open_around_the_own_values() -> None:
    request = BY_PATH["/v1/scuffing"]
    body = changed(examples()[SCUFFING].request, {"load": {"power_kw": None, "pinion_torque_n_m": 400.0}})
    known = studies_of_case(request, pairs_of(body), body, {"load.power_kw": 60.0})
    (hotter,) = [each for each in known if each.title.startswith("How much load")]
    views = asked_by(hotter.address).views
    assert (views["x"], views["x.from"], views["x.to"]) == ("load.power_kw", "30", "90")
    assert "y.from" not in views
    assert not [each for each in studies_of_case(request, pairs_of(body), body) if each.title == hotter.title]


WORDS = re.compile(r"/v1/|\b[a-z]+(?:_[a-z0-9]+)+\b|\b[a-z]+(?:\.[a-z]+)*\.[a-z]+_[a-z_]+")


def text_of(html: str) -> str:
    """Return the text that a reader sees on a page, without blocks of code."""
    plain = re.sub(r"<(script|style|pre)\b.*?</\1>", " ", html, flags=re.DOTALL)
    return unescape(re.sub(r"<[^>]+>", " ", re.sub(r"</?(i|sub|span)\b[^>]*>", "", plain)))


@pytest.mark.ci
@pytest.mark.parametrize("calculation", CALCULATIONS, ids=page_path)
def test_no_page_has_a_name_of_the_interface(calculation: Any) -> None:
    example = min(examples_of(calculation), key=lambda each: "gas_dynamics" in str(each.request))
    model = calculation.request.model_fields.get("model")
    closed = {"lubrication": "closed_form"} if model and "lubrication" in str(model.annotation.model_fields) else {}
    request = changed(example.request, {"model": {**example.request.get("model", {}), **closed}})
    html = html_of(Asked(page_path(calculation), pairs_of(request)))
    assert not WORDS.findall(text_of(html))


def test_the_page_of_a_gear_unit_has_no_name_of_the_interface() -> None:
    requests = {"/v1/scuffing": examples()[SCUFFING].request}
    missing = [
        {"field": "gears.normal_backlash_mm", "message": "needed"},
        {"field": "/v1/drive-train", "message": "no"},
    ]
    assumed = [{"field": "gears.pinion.profile_shift", "value": 0.0, "reason": "none given"}]
    stage = {"id": 1, "name": "", "requests": requests, "cases": [], "spectra": {}, "ignored": [], "helices": []}
    unit: dict[str, Any] = {"version": "1.4", "application": "", "name": "", "findings": []}
    unit["stages"] = [stage | {"missing": missing, "assumed": assumed}]
    text = text_of(unit_page("", unit))
    assert "normal backlash: needed" in text
    assert "profile shift" in text
    assert not WORDS.findall(text)


def test_the_pictures_of_the_start_page_are_stored_and_there_at_once() -> None:
    page = start_page.__wrapped__("")
    shown = re.findall(r'(?:src|srcset)="/static/(start-[a-z-]+\.svg)\?', page)
    assert len(shown) == 2 * page.count("<picture>") == 2 * len(by_model())
    assert "loading=" not in page
    for name in shown:
        assert ASSETS[name].rstrip().endswith(b"</svg>")
        assert len(ASSETS[name]) < 300_000
    for address in ("/pair", "/coupling/recommendation", "#rexs-file"):
        assert f'href="{address}"' in page.partition('class="begin"')[2].partition("</p>")[0]


def test_a_model_without_a_start_figure_stands_on_the_start_page(monkeypatch: pytest.MonkeyPatch) -> None:
    pictures = start_page.__wrapped__("").count("<picture>")
    (bare,) = (card for card in CARDS if card.name == "pumping")

    def shown_by(calculation: Calculation) -> Card:
        card = card_of(calculation)
        return replace(card, start_figure="") if card is bare else card

    monkeypatch.setattr(overview, "card_of", shown_by)
    page = start_page.__wrapped__("")
    assert page.count("<picture>") == pictures - 1
    assert all(calculation.title in page for calculation in CALCULATIONS)
