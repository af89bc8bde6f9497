"""The pages of cases show the answers of the API.

The query of a page contains the case. The form has every field of the request. An error message stands at the field
that is wrong.
"""

import json
import re
import shlex
from functools import cache
from html import unescape
from types import SimpleNamespace
from typing import Any

import httpx
import pytest
from fastapi import Request
from fastapi.responses import HTMLResponse
from hypothesis import strategies as st

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.errors import DeadlineExceeded, Unprocessable, Unreadable
from app.evaluate import evaluate, written
from app.examples import examples
from app.http.routes.pages import failed
from app.pages import csv, views
from app.pages.cases import Asked, solved
from app.pages.form import FormState, form
from app.pages.query import MATRIX, body_of, link, normalised, pairs_of, pairs_of_query
from app.pages.results import NOT_RESULTS
from app.pages.templating import page_path
from app.schema.fields import ITEM, leaves
from app.sources import SHORT_SOURCES
from tests.support import properties
from tests.support.forms import read_form
from tests.support.pages import asked, asked_by, fault_at, html_of
from tests.support.properties import one_per_endpoint
from tests.support.requests import GONE, changed, value_at

IDS = [each.request.__name__ for each in CALCULATIONS]
# One quick case of each endpoint.
CASES = (
    "pahl-axial-displacement",
    "pahl-sleeve-orbit",
    "pahl-recommended-crowning",
    "milian-table-1",
    "fzg-type-a",
    "xue-pair-1-scuffing",
    "xue-line-contact-isothermal",
)
SCUFFING = BY_PATH["/v1/scuffing"].request
COUPLING = "pahl-axial-displacement"
QUERY = link("", pairs_of(examples()[COUPLING].request))


@cache
def page(name: str) -> str:
    return html_of(asked(name))


@cache
def empty(calculation: Calculation) -> str:
    """Return the page of a calculation as it is before a user types anything."""
    return html_of(Asked(page_path(calculation), []))


@pytest.mark.parametrize("name", one_per_endpoint(examples()))
def test_an_examples_link_is_its_request(name: str) -> None:
    example = examples()[name]
    model = BY_PATH[example.endpoint].request
    query = link("", pairs_of(example.request)).removeprefix("?")
    pairs = normalised(model, pairs_of_query(query))
    assert model.model_validate(body_of(model, pairs)) == model.model_validate(example.request)


@pytest.mark.parametrize("name", CASES)
def test_a_pages_answer_is_the_apis(name: str) -> None:
    example = examples()[name]
    calculation = BY_PATH[example.endpoint]
    api = written(evaluate(calculation, calculation.request.model_validate(example.request)))
    assert views.result(asked(name), "json").content == api


@pytest.mark.parametrize("name", CASES)
def test_every_number_of_the_answer_is_on_the_page(name: str) -> None:
    answer = json.loads(views.result(asked(name), "json").content)
    shown = dict(re.findall(r'data-path="([^"]+)">([^<]*)<', page(name)))
    numbers = dict(scalars({key: value for key, value in answer.items() if key not in NOT_RESULTS}))
    assert numbers
    for path, value in numbers.items():
        if value is None and path not in shown:
            continue  # a section that the case does not have
        text = unescape(shown[path]).replace("−", "-").replace(" ", "").replace("\u202f", "")
        if isinstance(value, float) and 1e-3 <= abs(value) < 1e6:
            percent = 100.0 if path.endswith("contact_fraction") else 1.0
            assert float(text) == pytest.approx(percent * value, rel=6e-5, abs=0.5 if abs(value) >= 1e5 else 0), path


def scalars(value: Any, path: str = "") -> list[tuple[str, Any]]:
    if isinstance(value, dict):
        return [pair for name, item in value.items() for pair in scalars(item, f"{path}.{name}" if path else name)]
    return [] if isinstance(value, list) else [(path, value)]


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=IDS)
def test_the_form_asks_for_every_field(calculation: Calculation) -> None:
    names = {name for name, _ in read_form(empty(calculation))[0]}
    for leaf in leaves(calculation.request):
        if leaf.path != "detail":
            first = ".0.0" if leaf.dimensions == MATRIX else ".0" if leaf.pair else ""
            assert leaf.path.replace(ITEM, "0") + first in names, leaf.path


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=IDS)
def test_every_control_is_labelled_and_described(calculation: Calculation) -> None:
    html = empty(calculation)
    form = html[html.index('<form id="form"') : html.index("</form>", html.index('<form id="form"'))]
    ids = set(re.findall(r'\bid="([^"]+)"', html))
    assert len(ids) == len(re.findall(r'\bid="([^"]+)"', html))
    for control in re.findall(r"<(?:input|select|textarea)\b[^>]*>", form):
        if 'type="hidden"' in control or 'type="radio"' in control:
            continue
        identifier = re.search(r'\bid="([^"]+)"', control)
        assert identifier
        assert "aria-label=" in control or f'for="{identifier[1]}"' in form, control
        described = re.search(r'aria-describedby="([^"]+)"', control)
        assert described
        assert set(described[1].split()) <= ids


@pytest.mark.parametrize("name", [name for name in CASES if examples()[name].endpoint == "/v1/scuffing"])
def test_figures_of_the_load_distribution_are_a_link_away(name: str) -> None:
    html = page(name)
    assert re.findall(r'id="figure-([^"]+)"', html)[-2:] == ["flank-pressure", "section"]
    found = re.search(r'elsewhere"><a href="([^"]+)">Load distribution</a> of this pair: ([^<]+)</p>', html)
    assert found
    assert found[2].count(" · ") == 8
    loads = asked_by(unescape(found[1]))
    assert loads.path == "/scuffing/load-distribution"
    assert 'id="figure-load-sharing"' in html_of(loads)


@pytest.mark.parametrize("name", CASES)
def test_figures_and_links_of_the_page(name: str) -> None:
    html = page(name)
    calculation = BY_PATH[examples()[name].endpoint]
    request = calculation.request.model_validate(examples()[name].request)
    shown = html.count('<figure class="chart"') + html.count('<p class="missing">')
    assert shown == sum(not each.shown_at and each.is_asked(request) for each in calculation.figures)
    assert "data:image" not in html
    names = re.findall(r'<figure class="chart" id="figure-([^"]+)"', html)
    assert names
    for drawn in names:
        address = f'{page_path(calculation)}/figures/{drawn}.svg?[^"]*'
        assert re.search(f'<img src="{address}" loading="lazy"[^>]* alt="[^"]+"', html)
        assert re.search(f'<source srcset="{address}theme=dark" media="\\(prefers-color-scheme: dark\\)"', html)
    for view in ("result.csv?", "result.json?", "report?"):
        assert f'href="{page_path(calculation)}/{view}' in html


def test_a_fault_stands_at_its_field_and_on_top_and_what_was_typed_stays() -> None:
    pairs = [
        ("gears.pinion.teeth", "abc"),
        ("gears.wheel.teeth", "30"),
        ("gears.module_mm", "3,5"),
        ("bogus.<b>", "<script>alert(1)</script>"),
    ]
    html = html_of(Asked("/scuffing", pairs), 422)
    for text in ('value="abc"', 'value="3,5"', '<a href="#f.gears.pinion.teeth">', 'aria-invalid="true"'):
        assert text in html
    for text in ("<script>alert", "<b>"):
        assert text not in html
    assert "number" in fault_at(html, "gears.pinion.teeth")


def test_a_fault_of_the_solver_stands_at_its_field() -> None:
    pairs = [*pairs_of(examples()["xue-pair-1-scuffing"].request), ("gears.centre_distance_mm", "70")]
    assert fault_at(html_of(Asked("/scuffing", pairs), 422), "gears.centre_distance_mm")


def test_exclusive_fields_are_a_choice_and_the_chosen_one_counts() -> None:
    sent = [("load.pinion_torque_n_m", "1"), ("load.power_kw", "5"), ("pick:load.pinion_torque_n_m", "load.power_kw")]
    assert normalised(SCUFFING, sent) == [("load.power_kw", "5")]
    assert 'value="load.power_kw" checked' in page("xue-pair-1-scuffing")


@pytest.mark.parametrize("path", ["/coupling", "/scuffing", "/scuffing/line-contact", "/drive-train"])
def test_the_oil_is_given_in_one_of_four_ways(path: str) -> None:
    html = empty(BY_PATH[f"/v1{path}"])
    ways = re.findall(r'type="radio" name="pick:lubricant\.\w+" value="lubricant\.(\w+)"', html)
    assert ways[:4] == ["iso_vg", "name", "viscosity_pa_s", "kinematic_viscosity_40_mm2_per_s"]
    assert ways[4:6] == ["kinematic_viscosity_100_mm2_per_s", "viscosity_index"]
    coefficients = ["pressure_viscosity_per_gpa", "pressure_viscosity_38_per_gpa"]
    assert ways[6:] == ([] if path == "/coupling" else coefficients)


def test_a_grade_leaves_out_viscosity_and_its_temperature() -> None:
    sent = [
        ("lubricant.viscosity_pa_s", "0.04"),
        ("lubricant.reference_temperature_c", "80"),
        ("lubricant.iso_vg", "46"),
    ]
    picked = ("pick:lubricant.iso_vg", "lubricant.iso_vg")
    assert normalised(SCUFFING, [*sent, picked]) == [("lubricant.iso_vg", "46")]


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("gears.module_mm", "3,5", 3.5),
        ("gears.module_mm", "3.5", 3.5),
        ("gears.module_mm", "-2e-3", -2e-3),
        ("gears.module_mm", "1,234.5", 1234.5),
        ("gears.module_mm", "1.234,5", 1234.5),
        ("gears.module_mm", "200 000", 200_000),
        ("gears.module_mm", "200,000.5", 200_000.5),
        ("gears.module_mm", "1,234,567", 1_234_567),
        ("gears.module_mm", "1 234,5", 1234.5),
        ("gears.module_mm", "0,125", 0.125),
        ("gears.module_mm", "200,000", "200,000"),
        ("gears.module_mm", "12 34", "12 34"),
        ("gears.module_mm", "nan", "nan"),
        ("gears.module_mm", "1e999", float("inf")),
        ("gears.pinion.teeth", "9" * 400, float("9" * 400)),
        ("gears.pinion.teeth", "23", 23),
        ("model.contact", "linear", "linear"),
        ("lubricant.compressible", "false", False),
        ("lubricant.compressible", "yes", "yes"),
    ],
)
def test_texts_become_values(name: str, text: str, value: object) -> None:
    read = value_at(body_of(SCUFFING, [(name, text)]), name)
    assert (read, type(read)) == (value, type(value))


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("1,2,3.5", [1, 2, 3.5]),
        ("1 2\t3.5", [1, 2, 3.5]),
        ("1\n2\r\n3.5\n", [1, 2, 3.5]),
        ("1; 2; 3.5;", [1, 2, 3.5]),
        ("1, 2, 3.5", [1, 2, 3.5]),
        ("1,5\n2,5", ["1,5", "2,5"]),  # which comma is meant cannot be known
    ],
)
def test_lists_are_pasted(text: str, values: list[object]) -> None:
    coupling = BY_PATH["/v1/coupling"].request
    assert body_of(coupling, [("coupling.pitch_errors_um", text)])["coupling"]["pitch_errors_um"] == values


def test_rows_are_counted_without_gaps() -> None:
    pumping = BY_PATH["/v1/pumping"].request
    sent = [("grooves.0.position_mm", ""), ("grooves.2.position_mm", "5"), ("grooves.10.position_mm", "9")]
    pairs = normalised(pumping, sent)
    assert body_of(pumping, pairs) == {"grooves": [{"position_mm": 5}, {"position_mm": 9}]}


def test_a_field_of_spaces_is_empty_and_spaces_around_a_value_are_no_part_of_it() -> None:
    assert normalised(SCUFFING, [("load.power_kw", " \t"), ("gears.module_mm", " 3 ")]) == [("gears.module_mm", "3")]


@pytest.mark.parametrize("query", ["a=1&a.b=2", "a.b=1&a=2", "a=1&a=2", ".a=1", ".".join("a" * 50) + "=1"])
def test_contradicting_names_are_refused(query: str) -> None:
    with pytest.raises(Unreadable):
        body_of(SCUFFING, pairs_of_query(query))


@properties.examples(15, 200, st.lists(st.tuples(st.text(max_size=12), st.text(max_size=12)), max_size=8))
def test_whatever_is_sent_gives_a_page_and_runs_nothing(sent: list[tuple[str, str]]) -> None:
    pairs = normalised(SCUFFING, [*sent, ("<i>x</i>", "<u>y</u>")])
    shown = views.page(Asked("/scuffing", pairs))
    assert shown.status in {400, 422}
    assert "<u>y</u>" not in shown.content.decode()


def test_compare_shows_both_cases() -> None:
    ref = link("", pairs_of(examples()["xue-pair-1-scuffing"].request)).removeprefix("?")
    crowned = changed(examples()["xue-pair-1-scuffing"].request, {"modifications": {"profile_crowning_um": 10}})
    shown = views.page(Asked("/scuffing", pairs_of(crowned), {"ref": ref}))
    html = shown.content.decode()
    assert len(shown.keep) == 2
    assert "variant A" in html
    assert "End comparison" in html
    assert re.search(r"this case: <strong>[+−][\d.]+ %</strong>", html)
    same = views.page(Asked("/scuffing", pairs_of(crowned), {"ref": ref}, *shown.keep.values()))
    assert same.content == shown.content
    assert same.keep == {}


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_a_page_with_a_theme_has_figures_of_that_theme_alone(theme: str) -> None:
    html = html_of(asked(COUPLING, theme=theme))
    images = re.findall(r'<img src="([^"]+)"', html)
    assert images
    assert all(image.endswith(f"&amp;theme={theme}") for image in images)
    phones = re.findall(r'<source srcset="([^"]+)" media="([^"]+)"', html)
    assert len(phones) == len(images)
    assert all(f"theme={theme}" in image and media == "(max-width: 40rem)" for image, media in phones)


@pytest.mark.ci
def test_figures_of_a_page_are_drawn_from_the_kept_answer() -> None:
    case = asked("xue-pair-1-scuffing")
    (kept,) = views.page(case).keep.values()
    again = Asked(case.path, case.pairs, {}, kept)
    for declaration in BY_PATH["/v1/scuffing"].figures:
        if declaration.asked_by or declaration.name in {"friction", "modification", "modification-traces"}:
            continue
        data = views.figure(again, declaration.name, "csv")
        assert data.content == views.figure(case, declaration.name, "csv").content
        assert data.keep == {}
        found = json.loads(views.figure(again, declaration.name, "json").content)
        assert len(found["header"]) == len(found["lines"][0])
        for panel in found["panels"]:
            left, top, width, height = panel["box"]
            assert 0.0 < left < left + width <= 1.0
            assert 0.0 < top < top + height <= 1.0
    drawn, kept_drawn = (views.figure(each, "safety", "svg").content for each in (case, again))
    assert kept_drawn == drawn


def long_case(torque: str) -> dict[str, str]:
    """Return the fields of a coupling with 400 pitch deviations, which make the case too long for a link."""
    errors = ",".join(f"{0.123456789012345 * (index % 7):.15f}" for index in range(400))
    fields = dict(pairs_of(examples()[COUPLING].request))
    return fields | {"coupling.teeth": "400", "coupling.pitch_errors_um": errors, "operation.torque_n_m": torque}


@pytest.mark.ci
def test_figures_of_a_posted_case_are_addressed_by_its_hash(client: httpx.Client) -> None:
    fields = long_case("3000")
    html = client.post("/coupling", data=fields).text
    case = client.post("/coupling/result.json", data=fields).json()["case"]
    images = [unescape(each) for each in re.findall(r'<img src="([^"]+)"', html)]
    assert len(images) == len(BY_PATH["/v1/coupling"].figures)
    for image in images:
        assert f"case={case}" in image
        answer = client.get(image)
        assert answer.status_code == 200
        assert answer.headers["content-type"] == "image/svg+xml"
    assert client.get(f"/coupling/figures/losses.csv?case={case}").status_code == 200
    compared = client.post("/coupling", data=fields | {"ref": link("", list(long_case("2000").items()))[1:]}).text
    image = unescape(re.findall(r'<img src="([^"]+)"', compared)[0])
    assert "ref_case=" in image
    assert "dashed: variant A" in client.get(image).text


def test_a_case_that_is_not_kept_any_more_is_gone(client: httpx.Client) -> None:
    case = client.post("/coupling/result.json", data=long_case("3000")).json()["case"]
    client.post("/coupling", data=long_case("3000"))
    for address in (
        "/coupling/figures/losses.svg?case=" + 64 * "0",
        f"/coupling/figures/losses.svg?case={case}&ref_case={64 * '0'}",
        f"/pumping/figures/stroke.svg?case={case}",
    ):
        answer = client.get(address)
        assert answer.status_code == 410
        assert "no longer stored" in answer.json()["detail"]


def test_missing_headline_says_what_it_needs() -> None:
    request = changed(examples()["xue-pair-1-scuffing"].request, {"temperatures.scuffing_c": GONE})
    html = html_of(Asked("/scuffing", pairs_of(request)))
    assert 'needs the <a href="#f.temperatures.scuffing_c">scuffing temperature</a>' in html


@pytest.mark.parametrize("name", CASES)
@pytest.mark.ci
def test_report_has_every_part(name: str) -> None:
    shown = views.report(asked(name, project="<b>P</b>", notes="n" * 500), "http://host")
    html = shown.content.decode()
    parts = ["Verdict", "Validity", "Figures", "Inputs", "Assumptions", "Results", "Method", "Reproduction"]
    places = [html.index(f"<h2>{part}") for part in parts]
    assert places == sorted(places)
    assert "<b>P</b>" not in html
    assert html.count("n" * 500) == 2  # on the report and in the form that fills it in
    assert not re.search(r'(?:src|href)="(?!data:|http://host/)', html)
    assert "<script" not in html


@pytest.mark.usefixtures("without_images")
def test_names_of_a_report_are_whole_or_refused() -> None:
    html = views.report(asked("fzg-type-a", project="A\u202eB\x07C", notes="one\n\x1btwo"), "").content.decode()
    assert "<dd>ABC</dd>" in html
    assert "one\ntwo</dd>" in html
    for name, longest in (("author", 200), ("notes", 2000)):
        with pytest.raises(Unprocessable, match=f"{name} has {longest + 1} characters"):
            views.report(asked("fzg-type-a", **{name: "n" * (longest + 1)}), "")


@pytest.mark.usefixtures("without_images")
def test_reports_curl_is_the_request() -> None:
    example = examples()["milian-table-1"]
    html = views.report(asked("milian-table-1"), "http://host").content.decode()
    command = re.search(r"<pre>(curl .*?)</pre>", html, re.DOTALL)
    assert command
    *_, address, _, _, _, body = shlex.split(unescape(command[1]))
    assert address == "http://host/v1/pumping"
    assert json.loads(body) == example.request


def test_every_curve_that_a_page_lists_is_a_file() -> None:
    """The shafts of a drive train and its couplings are lists; their curves are files too."""
    case = asked("starter-turbo-gear-drive-train")
    answer = solved(case.calculation, case.pairs, None, "curves").response
    listed = csv.curves(answer)
    assert {"shafts.0.curves", "shafts.1.curves"} <= {*listed}
    for path in listed:
        header, *lines = csv.curve(answer, path).decode().splitlines()
        assert "," in header
        assert lines
    assert csv.curve(answer, "shafts.0.curves") != csv.curve(answer, "shafts.1.curves")


def test_csv_of_values_and_curves() -> None:
    values = views.result(asked(COUPLING, title="=A1"), "csv").content.decode().splitlines()
    assert values[:3] == ["path,title,value,unit,symbol", "title,title,'=A1,,", "endpoint,endpoint,/v1/coupling,,"]
    assert any(re.fullmatch("case,case,[0-9a-f]{64},,", line) for line in values)
    assert "inputs.coupling.teeth,number of teeth,52,,z" in values
    (thrust,) = (line for line in values if line.startswith("axial_thrust.force_n,"))
    assert re.fullmatch(r"axial_thrust.force_n,axial thrust,7\d*\.?\d*,N,F_a\w*", thrust)
    assert len(thrust.split(",")[2].replace(".", "")) <= 6
    curves = views.result(asked(COUPLING, curve="kinematics.curves"), "csv").content.decode()
    assert curves.startswith("tooth")
    assert len(curves.splitlines()) > 50


def test_a_case_is_saved_as_a_file_and_opened_again(client: httpx.Client) -> None:
    example = examples()["xue-pair-1-scuffing"]
    query = link("", pairs_of(example.request), title="Größe 2: first try")
    page = client.get(f"/scuffing{query}").text
    address = unescape(re.search(r'href="(/scuffing/case\.json[^"]+)"', page)[1])  # type: ignore[index]
    saved = client.get(address)
    assert saved.headers["content-disposition"] == "attachment; filename*=UTF-8''Gr%C3%B6%C3%9Fe%202%20first%20try.json"
    assert saved.json() == {
        "title": "Größe 2: first try",
        "endpoint": "/v1/scuffing",
        "request": example.request,
    }
    opened = client.post("/case", files={"file": ("case.json", saved.content)}, follow_redirects=True)
    assert opened.status_code == 200
    assert "<title>Größe 2: first try: " in opened.text
    sent = [(name, text) for name, text in read_form(opened.text)[0] if name != "title"]
    assert body_of(SCUFFING, normalised(SCUFFING, sent)) == example.request


def test_a_long_case_is_opened_without_a_link(client: httpx.Client) -> None:
    fields = long_case("3000")
    saved = client.post("/coupling/case.json", data=fields)
    opened = client.post("/case", files={"file": ("case.json", saved.content)})
    assert opened.status_code == 200
    assert dict(read_form(opened.text)[0])["coupling.pitch_errors_um"].startswith("0,0.123456789012345,0.24691")


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\xff",
        b"[" * 100_000,
        b"[]",
        b'{"endpoint": "/v1/coupling"}',
        b'{"endpoint": [], "request": {}}',
        b'{"endpoint": "/v1/none", "request": {}}',
        b'{"endpoint": "/v1/coupling", "request": ' + b'{"a":' * 400 + b"1" + b"}" * 401,
    ],
)
def test_a_file_without_a_case_is_refused_in_words(client: httpx.Client, content: bytes) -> None:
    refused = client.post("/case", files={"file": ("case.json", content)})
    assert refused.status_code in {303, 400}
    assert refused.status_code == 303 or "The file" in refused.text


def test_half_a_letter_in_a_file_does_no_harm(client: httpx.Client) -> None:
    file = b'{"title": "\\ud800", "endpoint": "/v1/coupling", "request": {"\\ud800": "\\ud800"}}'
    assert client.post("/case", files={"file": ("case.json", file)}, follow_redirects=True).status_code == 422


@pytest.mark.ci
def test_pages_answer_by_get_with_their_policies(client: httpx.Client) -> None:
    strict = {"/", "/coupling", f"/coupling{QUERY}", "/manual/coupling"}
    alone = {f"/coupling/{view}{QUERY}" for view in ("report", "figures/losses.svg", "result.json")}
    for address in strict | alone:
        answer = client.get(address)
        assert answer.status_code == 200, address
        (policy,) = answer.headers.get_list("content-security-policy")
        default = "default-src 'self'; img-src 'self' data:" if address in strict else "default-src 'none'"
        assert policy.startswith(default)
        assert ("unsafe-inline" in policy) == (address in alone)
        head = client.head(address)
        assert head.status_code == 200
        assert head.content == b""


def test_an_example_of_another_model_is_refused(client: httpx.Client) -> None:
    answer = client.get("/coupling?example=milian-case-1")
    assert answer.status_code == 400
    assert "The example milian-case-1 belongs to the page /pumping" in answer.text


def test_a_chosen_number_may_have_decimals_in_a_query_as_in_json() -> None:
    for text, value in (("46.0", 46), ("47", "47")):
        assert body_of(SCUFFING, [("lubricant.iso_vg", text)]) == {"lubricant": {"iso_vg": value}}


def test_other_sites_start_no_studies(client: httpx.Client) -> None:
    address = "/coupling/vary?coupling.teeth=52"
    assert client.get(address, headers={"Sec-Fetch-Site": "cross-site"}).status_code == 403
    assert client.get(address, headers={"Sec-Fetch-Site": "same-origin"}).status_code != 403
    assert client.get("/coupling/vary", headers={"Sec-Fetch-Site": "cross-site"}).status_code == 200
    form = {"Sec-Fetch-Site": "cross-site", "Content-Type": "application/x-www-form-urlencoded"}
    assert client.post("/coupling/vary", content=address.partition("?")[2], headers=form).status_code == 403


@pytest.mark.ci
def test_no_policy_allows_scripts_in_the_page_or_another_base(client: httpx.Client) -> None:
    figure = client.post("/v1/coupling/figures/losses.svg", json=examples()[COUPLING].request)
    pages = [client.get(path) for path in ("/", "/healthz", "/docs", f"/coupling/report{QUERY}")]
    for answer in (figure, *pages):
        policy = answer.headers["content-security-policy"]
        scripts = [part for part in policy.split("; ") if part.startswith("script-src")]
        assert "base-uri 'none'" in policy
        assert "form-action" in policy
        assert not any("unsafe-inline" in part for part in scripts)


def test_empty_fields_are_dropped_by_a_redirect(client: httpx.Client) -> None:
    answer = client.get("/coupling?coupling.teeth=52&coupling.module_mm=&theme=dark&pick:x=y")
    assert answer.status_code == 303
    assert answer.headers["location"] == f"/coupling?coupling.teeth=52&theme=dark&sources={SHORT_SOURCES}"
    example = client.get(f"/coupling?example={COUPLING}")
    own = pairs_of(examples()[COUPLING].request)
    assert example.headers["location"] == link("/coupling", own, sources=SHORT_SOURCES)


def test_a_posted_form_is_the_same_page(client: httpx.Client) -> None:
    request = examples()["pahl-sleeve-orbit"].request
    posted = client.post("/coupling/sleeve-orbit", data=dict(pairs_of(request)))
    linked = client.get("/coupling/sleeve-orbit", params=pairs_of(request))
    assert posted.status_code == linked.status_code == 200
    assert posted.text == linked.text


def test_floods_of_fields_are_refused(client: httpx.Client) -> None:
    answer = client.post("/scuffing", data={f"a{index}": "1" for index in range(10_000)})
    assert answer.status_code == 400
    assert answer.headers["content-type"].startswith("text/html")
    assert "The query has more than 1000 fields" in answer.text


def test_unknown_views_are_problems(client: httpx.Client) -> None:
    for address in ("coupling/result.xml", "coupling/figures/none.svg", "coupling/figures/losses.bmp", "static/none"):
        assert client.get(f"/{address}").status_code == 404, address
    assert client.get("/coupling/result.json?coupling.teeth=abc").headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize(
    ("address", "status", "says"),
    [
        ("/nothing", 404, "There is nothing at this address"),
        ("/scuffing/nothing", 404, "There is nothing at this address"),
        ("/manual/nothing", 404, "The chapters are "),
        ("/coupling/figures/none.svg", 404, "The figures are "),
        ("/coupling/figures/losses.svg?case=0", 410, "calculate the case again"),
    ],
)
def test_a_browser_gets_a_page_where_nothing_is(client: httpx.Client, address: str, status: int, says: str) -> None:
    browser = {"Accept": "text/html,application/xhtml+xml,*/*;q=0.8"}
    found = client.get(address, headers=browser)
    assert (found.status_code, found.headers["content-type"]) == (status, "text/html; charset=utf-8")
    assert says in found.text
    for request in (client.get(address), client.get(f"/v1{address}", headers=browser)):
        assert request.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize(
    ("address", "media_type"),
    [
        ("/coupling", "text/html; charset=utf-8"),
        ("/coupling/report", "text/html; charset=utf-8"),
        ("/coupling/vary", "text/html; charset=utf-8"),
        ("/coupling/result.json", "application/problem+json"),
        ("/coupling/figures/losses.svg", "application/problem+json"),
        ("/coupling/vary.csv", "application/problem+json"),
    ],
)
def test_a_page_of_an_error_answers_where_pages_do(client: httpx.Client, address: str, media_type: str) -> None:
    answer = client.get(f"{address}?{'&'.join(f'x{place}=1' for place in range(1001))}")
    assert (answer.status_code, answer.headers["content-type"]) == (400, media_type)
    assert "The query has more than 1000 fields" in answer.text


def test_long_answers_are_compressed(client: httpx.Client) -> None:
    encodings = ("identity", "gzip")
    plain, short = (client.get(f"/coupling{QUERY}", headers={"Accept-Encoding": each}) for each in encodings)
    assert "content-encoding" not in plain.headers
    assert short.headers["content-encoding"] == "gzip"
    assert short.headers["vary"] == "Accept-Encoding"
    assert int(short.headers["content-length"]) < 0.5 * len(plain.content)
    assert short.text == plain.text


def test_assets_are_kept_by_browsers(client: httpx.Client) -> None:
    addresses = re.findall(r'(?:href|src)="(/static/[^"]+)"', client.get("/coupling").text)
    assert addresses
    for address in addresses:
        answer = client.get(address)
        assert answer.status_code == 200
        assert "immutable" in answer.headers["cache-control"]


@pytest.mark.usefixtures("without_images")
def test_a_report_tells_every_input_of_every_item() -> None:
    """A table of the report shows at most four sections of a shaft side by side."""
    # A stiffness matrix is printed row by row. The text of the link names the host, its address is whole.
    example = "starter-generator-gear-drive-train"
    html = views.report(asked(example), "http://host").content.decode()
    request = examples()[example].request
    for section in request["pinion_shaft"]["sections"]:
        if "outer_diameter_mm" in section:
            assert re.search(rf'<td class="right given">{section["outer_diameter_mm"]:g} mm</td>', html)
    assert '<td class="right">121.77 mm</td><td class="origin given, assumed">given, assumed</td>' in html
    headings = re.findall(r'<td class="heading" colspan="\d">pinion shaft · sections</td>', html)
    assert len(headings) == -(-len(request["pinion_shaft"]["sections"]) // 4)
    assert "(420, 160), (−90, 560) N/µm" in html
    link = re.search(r'<dd class="link"><a href="([^"]*)">([^<]*)</a>', html)
    assert link
    assert link[2] == "open this case on http://host"
    assert len(link[1]) > 1000


def test_a_required_field_of_no_section_stands_before_the_optional_sections() -> None:
    general, *others = (
        [each.title for each in form(BY_PATH[path].request, FormState())].index("general")
        for path in ("/v1/drive-train", "/v1/scuffing", "/v1/pumping/choking-speed")
    )
    assert general == 2  # behind the gear pair and the operating point
    assert min(others) >= 3


def test_a_missing_section_is_told_by_its_fields() -> None:
    shown = html_of(Asked("/scuffing", [("gears.pinion.teeth", "23")]), 422)
    problem = shown[shown.index('<div class="problem"') :].partition("</div>")[0]
    assert "number of teeth, wheel is required" in problem
    assert "pinion speed is required" in problem
    assert "load is required" not in problem


@pytest.mark.parametrize(("method", "again"), [("GET", True), ("POST", False)])
def test_a_page_that_took_too_long_can_be_asked_again(method: str, again: bool) -> None:
    scope = {"type": "http", "method": method, "path": "/scuffing", "root_path": "", "query_string": b"", "headers": []}
    page = failed(Request({**scope, "route": SimpleNamespace(response_class=HTMLResponse)}), DeadlineExceeded())
    assert page.status_code == 504
    assert ("Try again" in bytes(page.body).decode()) == again


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=IDS)
def test_the_help_of_a_field_speaks_of_empty_fields(calculation: Calculation) -> None:
    html = html_of(Asked(page_path(calculation), []))
    lines = re.findall(r'<span class="help" id="[^"]+">(.*?)</span>\s*(?:</span>|<a)', html)
    assert lines
    assert not [line for line in lines if re.search(r"\bnull\b", line)]
