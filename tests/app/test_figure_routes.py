"""Every figure has an address at which the service draws it, in several formats and two themes."""

import csv
import io
from typing import Any

import httpx
import pytest

from app.calculations import CALCULATIONS
from app.examples import examples
from tests.support.requests import Post, changed, refusals

pytestmark = pytest.mark.ci

COUPLING = examples()["pahl-heavily-crowned"].request
LOADS = "/v1/coupling/figures/tooth-loads"


def test_list_names_every_figure(client: httpx.Client) -> None:
    listed = client.get("/v1/figures").json()
    assert [(item["endpoint"], item["name"]) for item in listed] == [
        (calculation.path, figure.name) for calculation in CALCULATIONS for figure in calculation.figures
    ]
    assert all(item["formats"] == ["svg", "png", "pdf", "csv"] for item in listed)
    assert all(item["title"] and item["source"] for item in listed)


@pytest.mark.parametrize(
    ("image_format", "media_type"),
    [("svg", "image/svg+xml"), ("png", "image/png"), ("pdf", "application/pdf"), ("csv", "text/csv; charset=utf-8")],
)
def test_figure_in_every_format_with_equal_bytes(post: Post, image_format: str, media_type: str) -> None:
    first, second = (post(f"{LOADS}.{image_format}", COUPLING) for _ in range(2))
    assert first.status_code == 200, first.text
    assert first.headers["content-type"] == media_type
    assert first.content == second.content
    assert "default-src 'none'" in first.headers["content-security-policy"]


def test_detail_is_ignored_and_numbers_are_the_endpoints(post: Post) -> None:
    answer = post("/v1/coupling", COUPLING).json()["load_distribution"]["curves"]
    response = post(f"{LOADS}.csv", {**COUPLING, "detail": "summary"})
    rows = list(csv.reader(io.StringIO(response.text)))[1:]
    assert [float(row[1]) for row in rows] == answer["tangential_force_n"]


def test_themes(post: Post) -> None:
    plain, light, dark = (post(f"{LOADS}.svg{query}", COUPLING) for query in ("", "?theme=light", "?theme=dark"))
    assert plain.content == light.content != dark.content
    assert post(f"{LOADS}.svg?theme=pink", COUPLING).status_code == 422


@pytest.mark.parametrize("address", ["tooth-loads.gif", "none.svg", "losses.svg.gz"])
@pytest.mark.parametrize("body", [COUPLING, {}])
def test_unknown_figure_or_format_lists_what_there_is(post: Post, address: str, body: Any) -> None:
    response = post(f"/v1/coupling/figures/{address}", body)
    assert response.status_code == 404
    assert response.headers["content-type"] == "application/problem+json"
    for word in ("friction-regime", "tooth-loads", "svg", "csv"):
        assert word in response.json()["detail"]


def test_wrong_input_is_a_problem_as_at_the_endpoint(post: Post) -> None:
    body = changed(COUPLING, {"operation.torque_n_m": -1})
    own, figure = (post(address, body) for address in ("/v1/coupling", f"{LOADS}.svg"))
    assert figure.status_code == own.status_code == 422
    assert figure.json()["errors"] == own.json()["errors"]


def test_a_figure_that_the_case_does_not_have_names_the_field(post: Post) -> None:
    response = post("/v1/scuffing/line-contact/figures/heat.svg", examples()["xue-line-contact-isothermal"].request)
    assert refusals(response) == [("isothermal", "model.thermal")]


def test_a_case_without_solution_is_a_problem(post: Post) -> None:
    contact = {"line_load_n_per_mm": 68.0028, "radius_mm": 5, "speed_1_m_per_s": 10.5, "speed_2_m_per_s": 9.5}
    body = {"contact": contact, "lubricant": {"viscosity_pa_s": 0.08}, "model": {"rheology": "newtonian"}}
    assert post("/v1/scuffing/line-contact", body).json()["status"] == "no_solution"
    assert refusals(post("/v1/scuffing/line-contact/figures/contact.svg", body))[0][0] == "no_solution"
