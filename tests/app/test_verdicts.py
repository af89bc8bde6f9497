"""The first sentence of a result is its verdict; tiles, warnings and the parts of a page say what they are about."""

import json
import re
from html import unescape
from typing import Any

import pytest

from app.calculations import BY_PATH, CALCULATIONS
from app.examples import examples
from app.models.card import Calculation, Verdict
from app.pages import views
from app.pages.cases import Asked, solved
from app.pages.form import FormSection, FormState, form
from app.pages.query import pairs_of
from app.pages.results import cards, conclusion, groups, parts, resolved, verdict, warned
from app.pages.typesetting import together
from app.schema.answers import Notice
from tests.support.pages import asked, html_of
from tests.support.requests import changed

LIMITS, TURBO, UNIT = "starter-coupling-at-its-limits", "starter-turbo-coupling", "starter-turbo-gear-drive-train"
SCUFFING = "starter-industrial-scuffing"
CLOSED = {"model": {"lubrication": "closed_form"}}


def answer(name: str, **changes: Any) -> Any:
    """Return the answer of a changed example."""
    example = examples()[name]
    return solved(BY_PATH[example.endpoint], pairs_of(changed(example.request, changes)), None).response


def without(name: str, *prefixes: str) -> Any:
    """Return the answer of an example without the fields whose names begin so."""
    example = examples()[name]
    left = [pair for pair in pairs_of(example.request) if not pair[0].startswith(prefixes)]
    return solved(BY_PATH[example.endpoint], left, None).response


def text_of(html: str) -> str:
    """Return the text of a page, its numbers with plain blanks before their units."""
    return unescape(re.sub(r"<[^>]+>", "", html)).replace("\u00a0", " ")


def warning(rank: str, code: str, message: str = "", field: str | None = None) -> Notice:
    return Notice.model_validate({"rank": rank, "code": code, "message": message or code, "field": field})


def tiles(response: Any) -> dict[str, Any]:
    return {row.path: row for row in cards(response, resolved(response))}


def test_a_coupling_beyond_its_limits_says_so_first() -> None:
    found = answer(LIMITS)
    said = "Not permissible: the teeth slide at 7.9 times the limit; contact leaves the tooth face."
    assert verdict(found) == Verdict("bad", said)
    page = html_of(asked(LIMITS))
    assert text_of(page[page.index('id="result"') :]).split(">", 1)[1].strip().startswith(said)
    assert "does not lock axially" not in page
    order = [page.index(f'class="{name}') for name in ("finding bad", "cards", "warnings", "tools", "charts")]
    assert order == sorted(order)


def test_the_turbo_coupling_is_permissible_and_free_axially() -> None:
    found = answer(TURBO)
    assert verdict(found).text.startswith("Permissible without full film: the teeth slide at 68.5 % of the limit")
    assert conclusion(found).startswith("Free axially: its thrust in motion is 1.41 %")


@pytest.mark.parametrize(("capacity", "level"), [(0.05, "near"), (0.79, "near"), (0.953, "good")])
def test_verdict_and_tile_judge_the_film_alike(capacity: float, level: str) -> None:
    found, path = answer(TURBO), "lubrication.load_capacity_coefficient"
    film = found.lubrication.model_copy(update={"load_capacity_coefficient": capacity})
    found = found.model_copy(update={"lubrication": film, "warnings": []})
    assert (verdict(found).level, tiles(found)[path].level) == (level, level)


def test_sticking_teeth_come_first() -> None:
    operation = {**examples()[TURBO].request["operation"], "misalignment_deg": 0.0, "axial_velocity_mm_per_s": 0.0}
    assert verdict(answer(TURBO, operation=operation)).text.startswith("Locks axially: its teeth stick up to")


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_every_answer_has_a_verdict(calculation: Calculation) -> None:
    """An answer of a calculation without a verdict would begin with its tiles."""
    name = min(
        (each for each in examples().values() if each.endpoint == calculation.path), key=lambda each: len(str(each))
    ).name
    level, said = verdict(answer(name))
    assert level in {"plain", "good", "near", "bad"}
    assert re.match(r"[A-Z\d].*\.$", said)


@pytest.mark.parametrize("load", [{"power_kw": 0.0}, {"power_kw": 1e-6}])
def test_a_pair_without_load_has_a_verdict(load: dict[str, float]) -> None:
    for name in ("xue-pair-1", "xue-pair-1-scuffing"):
        request = examples()[name].request
        assert verdict(answer(name, load={**request["load"], **load})).text.endswith(".")


def test_flanks_without_load_do_not_scuff() -> None:
    for name, load in ((SCUFFING, "load"), (UNIT, "operation")):
        said = answer(name, **CLOSED, **{load: {**examples()[name].request[load], "power_kw": 0.0}})
        assert verdict(said).text.startswith("No load: nothing presses the flanks together.")
        assert "risk" not in verdict(said).text


def test_no_torque_and_no_speed_have_a_verdict() -> None:
    operation = examples()[TURBO].request["operation"]
    for change in ({"torque_n_m": 0.0}, {"speed_rpm": 0.0}):
        assert verdict(answer(TURBO, operation={**operation, **change})).text.endswith(".")


@pytest.mark.parametrize(
    ("least", "band", "level", "said", "tile"),
    [
        (0.9, None, "bad", "High risk of scuffing: S_B 0.9.", "high risk of scuffing"),
        (1.6, [1.4, 1.8], "near", "Moderate risk of scuffing: S_B 1.6, at worst 1.4.", "at worst 1.4: moderate"),
        (1.2, [0.9, 1.8], "bad", "High risk of scuffing: S_B 1.2, at worst 0.9.", "at worst 0.9: high"),
        (2.5, [2.1, 2.8], "good", "Low risk of scuffing: S_B 2.5, at worst 2.1.", "at worst 2.1: low"),
    ],
)
@pytest.mark.parametrize(("name", "path"), [("xue-pair-1-scuffing", "safety.blok_factor"), (UNIT, "safety.minimum")])
def test_scuffing_has_one_scale_of_words(
    name: str, path: str, least: float, band: list[float] | None, level: str, said: str, tile: str
) -> None:
    """The band stands once: the value on the tile, the worse end behind it."""
    found = answer(name, **(CLOSED if name != UNIT else {}))
    heat = answer_heat(band)
    safety = found.safety.model_copy(update={path.rpartition(".")[2]: least})
    found = found.model_copy(update={"safety": safety, "heat": heat, "warnings": []})
    assert verdict(found) == Verdict(level, said)
    shown = tiles(found)[path]
    assert (shown.value, shown.level, shown.remark) == (f"{least:g}", level, tile)


class _Band:
    def __init__(self, safety: list[float] | None) -> None:
        self.safety = safety


class _Heat:
    def __init__(self, band: list[float] | None) -> None:
        self.band = _Band(band)
        self.model_fields_set = frozenset[str]()


def answer_heat(band: list[float] | None) -> Any:
    """Return a heat balance that has nothing but a band."""
    return _Heat(band) if band else None


def test_an_invalid_result_says_so_first_and_a_doubtful_one_last() -> None:
    found = answer("xue-pair-1-scuffing")
    doubtful = found.model_copy(update={"warnings": [warning("doubtful", "low_peclet")]})
    assert verdict(doubtful) == Verdict("near", "Moderate risk of scuffing: S_B 1.02. Doubtful: low Péclet number.")
    invalid = found.model_copy(update={"warnings": [warning("invalid", "x", "the loop is unstable: gain 2. More")]})
    said = verdict(invalid)
    assert said.level == "bad"
    assert said.text.startswith("Not valid: the loop is unstable: gain 2. Moderate risk")
    noted = found.model_copy(update={"warnings": [warning("note", "no_band")]})
    assert verdict(noted) == verdict(found.model_copy(update={"warnings": []}))


def test_an_invalid_result_says_so_unless_the_verdict_names_it() -> None:
    found = answer(LIMITS)
    unstable = found.model_copy(
        update={"warnings": [*found.warnings, warning("invalid", "unstable_regime", "the friction is unstable")]}
    )
    assert verdict(unstable).text.startswith("Not valid: the friction is unstable. Not permissible: ")
    assert verdict(found).text.startswith("Not permissible: ")
    pair = answer("xue-pair-1-scuffing")
    bad = {"safety": pair.safety.model_copy(update={"blok_factor": 0.9})}
    high = pair.model_copy(update={**bad, "warnings": [warning("invalid", "x", "the loop is unstable")]})
    assert verdict(high) == Verdict("bad", "Not valid: the loop is unstable. High risk of scuffing: S_B 0.9.")


def test_a_verdict_that_is_missing_says_why() -> None:
    dry = without(SCUFFING, "lubricant.", "cooling.")
    assert verdict(dry) == Verdict("plain", "No verdict: no oil.")
    assert tiles(dry)["contact_temperature.blok_max_c"].remark == "no value; the warnings say why"
    for name, hottest in (("xue-pair-1-scuffing", "158 °C"), (UNIT, "129 °C")):
        said = verdict(without(name, "temperatures.scuffing", "micropitting."))
        assert said.text.startswith(f"No verdict: no scuffing temperature. The contact reaches {hottest}.")
    bare = without(UNIT, "lubricant.", "thermal.pinion_bulk", "thermal.wheel_bulk", "temperatures.scuffing")
    assert verdict(bare).text.startswith("No verdict: no oil.")
    cold = without("starter-turbo-gear-warm-up", "temperatures.scuffing")
    assert verdict(cold).text.startswith("The bodies differ by ")


def test_pages_of_units_without_a_scuffing_temperature_answer() -> None:
    pairs = [pair for pair in pairs_of(examples()[UNIT].request) if not pair[0].startswith("temperatures.scuffing")]
    unit = Asked("/drive-train", pairs)
    said = unescape(html_of(unit)).replace("\u00a0", " ")
    assert "No verdict: no scuffing temperature" in said
    assert "no value; the warnings say why" not in said
    summary = json.loads(views.summary(unit).content)
    assert summary["verdict"].startswith("No verdict: no scuffing temperature.")


def test_a_report_without_solution_says_so_and_has_no_tiles() -> None:
    contact = {"line_load_n_per_mm": 68.0028, "radius_mm": 5, "speed_1_m_per_s": 10.5, "speed_2_m_per_s": 9.5}
    body = {"contact": contact, "lubricant": {"viscosity_pa_s": 0.08}, "model": {"rheology": "newtonian"}}
    unsolved = Asked("/scuffing/line-contact", pairs_of(body))
    html = views.report(unsolved, "").content.decode()
    assert 'class="conclusion finding bad">No solution: ' in html
    assert '<div class="card ' not in html
    assert json.loads(views.summary(unsolved).content)["verdict"].startswith("No solution: ")


def test_only_the_tiles_that_a_warning_touches_point_to_it() -> None:
    found = answer("starter-industrial-scuffing", **CLOSED)
    cool = found.model_copy(update={"warnings": [warning("doubtful", "edge_load")]})
    pointing = {path for path, row in tiles(cool).items() if "see the warnings" in row.remark}
    assert pointing == {"load.face_load_factor"}
    assert tiles(cool)["safety.blok_factor"].level == "good"
    unknown = found.model_copy(update={"warnings": [warning("doubtful", "of_a_later_version")]})
    assert all("see the warnings" in row.remark for row in tiles(unknown).values())
    noted = found.model_copy(update={"warnings": [warning("note", "edge_load")]})
    assert not any("see the warnings" in row.remark for row in tiles(noted).values())


def test_warnings_touch_tiles_that_there_are() -> None:
    for calculation in CALCULATIONS:
        response = calculation.response
        for paths in calculation.words.touches.values():
            assert {*paths} <= {leaf.path for leaf in form_leaves(response)}


def form_leaves(response: type[Any]) -> tuple[Any, ...]:
    from app.schema.fields import leaves  # noqa: PLC0415  only here

    return leaves(response)


def test_load_temperature_and_micropitting_have_tiles() -> None:
    plain = tiles(answer("starter-industrial-scuffing", **CLOSED))
    assert "micropitting.local.safety" not in plain
    assert plain["load.face_load_factor"].remark == "the whole contact carries"
    assert plain["contact_temperature.bulk_c"].unit == "°C"
    checked = tiles(answer("starter-industrial-micropitting", **CLOSED))["micropitting.local.safety"]
    assert checked.level in {"near", "bad"}
    unit = tiles(answer(UNIT))
    assert unit["derived.temperatures.bulk_c"].value == "87.5"


def test_equal_warnings_stand_once_with_the_bearings_that_they_mean() -> None:
    request = BY_PATH["/v1/drive-train"].request
    thin = [
        warning("doubtful", "thin_film", "the film is thin", f"{shaft}_shaft.bearings.{bearing}.radial_clearance_um")
        for shaft, bearing in (("pinion", 0), ("wheel", 1))
    ]
    found = answer(UNIT).model_copy(update={"warnings": [*thin, warning("note", "solid_wheel")]})
    first, second = warned(request, found)
    assert (first.rank, first.code, [*first.said]) == ("doubtful", "thin_film", ["the film is thin"])
    places = [place for _, place in first.said["the film is thin"]]
    assert [place.rpartition(", radial")[0] for place in places] == [
        "pinion shaft, bearing 1",
        "wheel shaft, bearing 2",
    ]
    assert second.code == "solid_wheel"


def test_numbers_stay_with_their_units() -> None:
    assert together("of -12 000 N m at 125 m/s, 3 of 5") == "of −12\u00a0000\u00a0N\u00a0m at 125\u00a0m/s, 3 of 5"
    assert together("ISO/TS 6336-20 and -21, ISO/TR 13989-1 and -2") == "ISO/TS 6336-20 and -21, ISO/TR 13989-1 and -2"
    assert together("between -1 and -2") == "between −1 and −2"


def test_all_results_are_in_three_parts_without_loss() -> None:
    found = answer("starter-industrial-scuffing", **CLOSED)
    tables = groups(found)
    divided = parts(found, tables)
    assert [part.title.partition(":")[0] for part in divided] == ["Main results", "All other results", "Numerics"]
    of_parts = [row.path for part in divided for rows in part.groups.values() for row in rows]
    assert sorted(of_parts) == sorted(row.path for rows in tables.values() for row in rows)
    main, _, numerics = ({row.path for rows in part.groups.values() for row in rows} for part in divided)
    assert {"safety.blok_factor", "load.face_load_factor", "friction_loss.power_w"} <= main
    assert numerics == {"load.balance_error", "unsolved_points"}


def test_a_page_has_four_figures_and_folds_the_others() -> None:
    example = examples()["starter-industrial-scuffing"]
    page = html_of(Asked("/scuffing", pairs_of(changed(example.request, CLOSED))))
    shown, folded = page.split('<details class="more-figures">')
    assert shown.count('<figure class="chart"') == 4
    assert folded.count('<figure class="chart"') == 2
    assert 'narrow=on" media="(max-width: 40rem)"' in shown.replace("&amp;", "&")


def sections(blocks: tuple[Any, ...]) -> Any:
    for block in blocks:
        if isinstance(block, FormSection):
            yield block
            yield from sections(block.blocks)


def test_a_solved_form_folds_options_and_the_items_of_lists() -> None:
    found = answer(UNIT)
    texts = dict(pairs_of(examples()[UNIT].request))
    request = BY_PATH["/v1/drive-train"].request
    solved_form = {part.path: part for part in sections(form(request, FormState(texts, {}, resolved(found))))}
    assert not solved_form["pinion_shaft.bearings.0"].open
    assert solved_form["pinion_shaft"].open
    faulty = form(request, FormState(texts, {"pinion_shaft.bearings.0.width_mm": "no"}, resolved(found)))
    assert {part.path: part for part in sections(faulty)}["pinion_shaft.bearings.0"].open


@pytest.mark.ci
def test_a_report_prints_no_address_of_this_computer_and_says_how_to_get_a_pdf() -> None:
    example = asked("pahl-sleeve-orbit")
    html = views.report(example, "http://127.0.0.1:8123").content.decode()
    printed = re.sub(
        r'<div class="wide unprinted">.*?</div>|<details class="fill".*?</details>', "", html, flags=re.DOTALL
    )
    assert "127.0.0.1" in html
    assert "127.0.0.1" not in printed
    assert "Save as PDF" in html
    assert "SHA-256" not in html
    assert "SHA-256" in views.report(asked("pahl-sleeve-orbit", rexs_sha256="ab" * 32), "").content.decode()


def test_help_names_its_source_as_a_link_and_is_never_empty() -> None:
    page = html_of(asked("pahl-sleeve-orbit"))
    assert "Where it is declared" not in page
    assert re.search(r'<a href="/manual/fields[^"]*"[^>]*>Source: [^<]+</a>', page)
    assert not re.search(r'<span class="help"[^>]*>\s*</span>', page)


def test_examples_have_titles_of_their_own() -> None:
    by_title = {each.title: each for each in examples().values()}
    assert len(by_title) == len(examples())
    pairs = [
        title for title in by_title if title.startswith("Gear pair 1") and by_title[title].endpoint == "/v1/scuffing"
    ]
    assert len({title.partition(":")[0] for title in pairs}) == 2
