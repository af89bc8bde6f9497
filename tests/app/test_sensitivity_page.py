"""The page of a sensitivity study shows the numbers of the study, and each row of its table links to a curve."""

import asyncio
import re
from collections.abc import Callable
from dataclasses import replace
from html import unescape
from typing import Any

import httpx
import pytest

from app.pages.cases import Asked
from app.pages.studies import page as pages
from app.pages.studies import stream
from app.pages.studies.sensitivity import MOST_ROWS, SensitivityPage
from app.pages.studies.sweep import SweepPage
from app.pages.typesetting import shown
from tests.support.pages import asked, asked_by, checked, lines_of, opened, whole

COUPLING = "pahl-axial-displacement"


def result_of(found: Asked) -> tuple[list[dict[str, Any]], str]:
    study = checked(SensitivityPage, found)
    lines = lines_of(study)
    return lines, whole(study, lines)


@pytest.mark.parametrize(
    "name",
    [
        COUPLING,
        "milian-table-1-incompressible",
        "fzg-type-a",
        pytest.param("pahl-sleeve-orbit", marks=pytest.mark.slow),
    ],
)
@pytest.mark.ci
def test_the_table_says_what_the_study_says(name: str) -> None:
    found = asked(name)
    lines, page = result_of(found)
    moved = [line for line in lines[:-1] if line["range"] is not None]
    rows = re.findall(r'<tr><td><a href="([^"]+)">([^<]+)</a></td>(.*?)</tr>', page, re.DOTALL)
    assert len(rows) == min(len(moved), MOST_ROWS)
    for line, (address, _, cells) in zip(moved, rows, strict=False):
        assert all(f">{shown(line[name], 4)}<" in cells for name in ("lowered", "raised", "range"))
        assert f">{shown(line['elasticity'], 3)}<" in cells
        curve = asked_by(address)
        assert (curve.path, curve.pairs) == (f"{found.path}/vary", found.pairs)
        assert curve.views["x"] == line["path"]
    first = replace(asked_by(rows[0][0]), path=found.path)
    assert checked(SweepPage, first).study.total > 1


def test_the_figure_shows_the_most_influential_first() -> None:
    lines, page = result_of(asked(COUPLING))
    alt = re.findall(r'alt="([^"]+)"', page)[0]
    first = "coefficient of friction, transmitted torque and number of teeth first"
    assert alt.startswith(f"What moves the thrust to be held most. 8186\xa0N now; {first}")
    assert [line["path"] for line in lines[:3]] == ["friction.coefficient", "operation.torque_n_m", "coupling.teeth"]


def test_a_case_without_the_output_says_so() -> None:
    study = checked(SensitivityPage, asked(COUPLING))
    *lines, end = lines_of(study)
    nothing = [{**line, "range": None, "derivative": None} for line in lines]
    without = {**end, "outputs": [{**end["outputs"][0], "value": None}]}
    assert "The case has no value of the thrust to be held" in whole(study, [*nothing, without])
    still = [{**line, "range": 0.0, "derivative": 0.0} for line in lines]
    assert "No input changes the thrust to be held" in whole(study, [*still, end])


@pytest.mark.parametrize(
    ("output", "message"), [("axial_thrust", "is a section"), ("<script>", "there is no <script>")]
)
def test_a_wrong_output_is_refused(output: str, message: str) -> None:
    html = opened(SensitivityPage, asked(COUPLING, show=output), 422)
    assert "<script>" not in html.partition("<body>")[2]
    assert message in unescape(html)


def test_the_page_by_its_address(client: httpx.Client) -> None:
    page = client.get(asked(COUPLING).study("influence"))
    assert page.status_code == 200
    assert page.text.rstrip().endswith("</html>")
    assert "What moves the thrust to be held most" in page.text
    assert client.get("/coupling/influence").status_code == 200
    assert client.get("/coupling/influence?coupling.teeth=abc").status_code == 422
    assert client.get("/coupling/influence?" + "&".join(f"a{i}=1" for i in range(1500))).status_code == 400


class BrokenPool:
    """Stand-in for a pool. Every call fails with a KeyError, as if a page had a programming error."""

    slots = 1

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        future = asyncio.get_running_loop().create_future()
        future.set_exception(KeyError(function.__name__, *arguments))
        return future


def test_a_page_that_has_begun_says_that_a_part_failed() -> None:
    assert b"could not be drawn" in asyncio.run(stream._part(BrokenPool(), pages.drawn))
