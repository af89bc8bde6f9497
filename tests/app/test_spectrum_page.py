"""The page of a load spectrum reads a pasted table and tolerances, and shows the numbers of the study."""

import asyncio
import re
from collections.abc import AsyncGenerator, Callable
from dataclasses import replace
from html import unescape
from typing import Any
from urllib.parse import urlencode

import httpx
import pytest

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.errors import Unprocessable
from app.examples import examples, study_bodies
from app.figures.spectrum import chance_text
from app.pages.query import pairs_of
from app.pages.studies import page as pages
from app.pages.studies.load_cases import cases_of, table_of
from app.pages.studies.page import StudyPage
from app.pages.studies.spectrum import SpectrumPage, address_of
from app.pages.studies.stream import report_pieces
from app.schema.fields import ITEM, leaves
from app.studies.kinds.spectrum import Spectrum
from app.studies.runner import Clock
from tests.support.pages import DEADLINE_S, asked, asked_by, checked, fault_at, lines_of, whole

SCUFFING = BY_PATH["/v1/scuffing"]
MOST = 20_000
COUPLING = "pahl-axial-displacement"
CASE = pairs_of(examples()[COUPLING].request)
TABLE = "name\tshare\tload.power_kw\ttemperatures.oil_c\nstart\t2 %\t2000,5\t40\nfull load\t0.98\t\t\n"


def told(study: StudyPage) -> list[dict[str, Any]]:
    """Return the lines of a study without the lines about its progress."""
    return [line for line in lines_of(study) if line["type"] != "progress"]


def studied(study: StudyPage) -> tuple[list[dict[str, Any]], str]:
    """Return the lines of a study without the lines about its progress, and the page that shows these lines."""
    lines = told(study)
    return lines, whole(study, lines)


def test_a_table_as_a_spreadsheet_copies_it() -> None:
    found = cases_of(SCUFFING, TABLE)
    assert found == [
        {"name": "start", "share": 0.02, "set": {"load.power_kw": 2000.5, "temperatures.oil_c": 40}},
        {"name": "full load", "share": 0.98, "set": {}},
    ]
    assert cases_of(SCUFFING, TABLE.replace("\t", ";")) == found
    assert cases_of(SCUFFING, table_of(SCUFFING, found)) == found
    assert cases_of(SCUFFING, " \n") == [{}]
    assert cases_of(SCUFFING, "name\tshare") == [{}]


@pytest.mark.parametrize(
    ("text", "message"),
    [("name\nfull\t1", "line 2 has more columns"), ("share\nmuch", "line 2: the share is not a number")],
)
def test_a_table_that_cannot_be_read(text: str, message: str) -> None:
    with pytest.raises(Unprocessable) as caught:
        cases_of(SCUFFING, text)
    assert caught.value.path == "cases"
    assert message in caught.value.message


@pytest.mark.parametrize(
    ("heading", "cell", "path", "value"),
    [
        ("pinion speed", "1500", "load.pinion_speed_rpm", 1500),
        ("Pinion speed, 1/min", "1500", "load.pinion_speed_rpm", 1500),
        ("pinion speed [rpm]", "1500", "load.pinion_speed_rpm", 1500),
        ("pinion speed (U/min)", "1500", "load.pinion_speed_rpm", 1500),
        ("pinion_speed_rpm", "1500", "load.pinion_speed_rpm", 1500),
        ("power", "2,5", "load.power_kw", 2.5),
        ("power [MW]", "2,3", "load.power_kw", 2300.0),
        ("pinion torque kN m", "0.7", "load.pinion_torque_n_m", 700.0),
        ("oil temperature °C", "40", "temperatures.oil_c", 40),
        ("number of teeth, pinion", "23", "gears.pinion.teeth", 23),
    ],
)
def test_headings_are_labels_of_the_form_with_or_without_unit(heading: str, cell: str, path: str, value: float) -> None:
    assert cases_of(SCUFFING, f"Name\tShare [%]\t{heading}\none\t20\t{cell}") == [
        {"name": "one", "share": 0.2, "set": {path: value}}
    ]


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=[each.path for each in CALCULATIONS])
def test_every_label_of_the_form_is_a_heading(calculation: Calculation) -> None:
    for leaf in leaves(calculation.request):
        if leaf.is_scalar and ITEM not in leaf.path:
            for heading in (leaf.title, leaf.path, f"{leaf.title}, {leaf.unit}" if leaf.unit else leaf.title):
                (case,) = cases_of(calculation, f"{heading}\n1")
                assert [*case["set"]] == [leaf.path], heading


def test_a_heading_of_several_fields_is_asked_back() -> None:
    with pytest.raises(Unprocessable, match="number of teeth, pinion or number of teeth, wheel"):
        cases_of(SCUFFING, "number of teeth\n23")


@pytest.mark.parametrize("heading", ["pinion sped", "pinion speed, Hz", "pinion speed limit"])
def test_a_heading_of_no_field_is_left_to_the_study(heading: str) -> None:
    assert cases_of(SCUFFING, f"{heading}\n1") == [{"set": {heading: 1}}]


def test_doubtful_cells_are_asked_back_where_they_are_typed(client: httpx.Client) -> None:
    table = "name\tshare\toperation.torque_n_m\n3.500\t1\t3.500"
    linked = client.get("/coupling/spectrum", params=[*CASE, ("cases", table), ("machines", "16")])
    assert linked.status_code == 200
    typed = [*CASE, ("cases", table), ("written", "")]
    asked_back = client.get("/coupling/spectrum", params=typed, follow_redirects=True)
    assert asked_back.status_code == 422
    assert fault_at(asked_back.text, "cases") == "line 2: 3.500 may mean 3500 or 3.5; write one of these"
    assert f"{table}</textarea>" in asked_back.text
    assert 'name="written" value=""' in asked_back.text  # the table that was typed is not the server's
    kept = re.search(r'name="written" value="([^"]*)"', linked.text)
    assert kept
    typed[-1] = ("written", unescape(kept[1]))
    again = client.get("/coupling/spectrum", params=typed)
    assert again.status_code == 303
    assert "3.500%3F" not in again.headers["location"]


def test_controls_of_a_study_are_read_as_fields_are(client: httpx.Client) -> None:
    views = {"x": "operation.torque_n_m", "x.from": "3 kNm", "x.to": "4 500", "x.count": "3", "written": ""}
    answer = client.get("/coupling/vary", params=[*CASE, *views.items()], follow_redirects=True)
    assert answer.status_code == 200
    assert "x.from=3000&x.to=4500" in str(answer.url)
    doubt = client.get("/coupling/vary", params=[*CASE, *(views | {"x.to": "4.500"}).items()], follow_redirects=True)
    assert doubt.status_code == 422
    assert fault_at(doubt.text, "x.to") == "4.500 may mean 4500 or 4.5; write one of these"
    assert 'name="x.to" type="text"' in doubt.text
    assert 'value="4.500"' in doubt.text


@pytest.mark.parametrize("name", study_bodies("/v1/spectrum"))
def test_ready_studies_are_those_of_the_interface(name: str) -> None:
    """The page of an example from the API has the cases, tolerances and limits of the example."""
    # The number of machines is the default of the page: 8 replicates of 32 machines.
    body = study_bodies("/v1/spectrum")[name]["value"]
    calculation = BY_PATH[body["endpoint"]]
    question = asked_by(address_of(calculation, pairs_of(body["request"]), body))
    path = question.path.removesuffix("/spectrum")
    study = pages.checked(SpectrumPage, replace(question, path=path), MOST, DEADLINE_S).study
    tolerances = {**body["tolerances"], "count": 32, "replicates": 8}
    own = Spectrum({**body, "tolerances": tolerances}, MOST, DEADLINE_S)
    assert isinstance(study, Spectrum)
    assert [(each.set, each.share) for each in study.cases] == [(each.set, each.share) for each in own.cases]
    assert study.body.tolerances is not None
    assert own.body.tolerances is not None
    assert study.machines == pytest.approx(own.machines)
    assert study.body.limits == own.body.limits


@pytest.mark.slow
@pytest.mark.parametrize("name", study_bodies("/v1/spectrum"))
def test_customers_read_where_a_limit_comes_from(client: httpx.Client, name: str) -> None:
    """For gears, the page and the report cite a secondary source for the deviation of the scuffing temperature."""
    # For the coupling, the deviation of the limit is given.
    body = study_bodies("/v1/spectrum")[name]["value"]
    address = address_of(BY_PATH[body["endpoint"]], pairs_of(body["request"]), body) + "&machines=8"
    page = client.get(address)
    report = client.get(address.replace("/spectrum?", "/spectrum/report?"))
    for answer in (page, report):
        assert answer.status_code == 200
        assert not re.search(r"from memory|as read in", answer.text)
        text = unescape(answer.text)
        limit = text[text.index(">Limit</") :]
        stated = limit[: limit.index("</table>")]
        assert ("0.15 times its mean (AGMA 925-A03, secondary source)" in stated) is (name != "coupling")
        assert (">given</td>" in stated) is (name == "coupling")


TITLE = "thrust limit of coaxial shafts"
SAID = {
    "cases": "name;share;operation.torque_n_m\nlow;0.5;3000\nhigh;0.5;4500",
    "t0": "friction.coefficient",
    "t0.by": "0.02",
    "machines": "16",
    "show": "axial_thrust.coaxial_limit_n",
    "limit": "5000",
    "limit.by": "400",
    "hours": "8000",
}


@pytest.mark.ci
def test_the_page_shows_what_the_study_says() -> None:
    lines, page = studied(checked(SpectrumPage, asked(COUPLING, **SAID)))
    (limit,) = lines[-1]["limits"]
    assert "the error of sampling alone" in page
    assert f"{chance_text(limit)} of the machines exceed the limit: {TITLE} above it" in unescape(page).replace(
        "\u00a0", " "
    )
    assert "risk" not in page, "a thrust has no risk of scuffing"
    for name in ("limit", "probability", "decides", "losses"):
        assert f'id="figure-{name}"' in page
    rows = re.findall(r'<tr><td><a href="([^"]+)">(low|high)</a></td>', page)
    assert [name for _, name in rows] == ["low", "high"]
    assert ("operation.torque_n_m", "4500") in asked_by(rows[1][0]).pairs
    assert "16 machines in 2 cases" in page


def test_no_name_of_a_case_is_a_formula_in_a_spreadsheet() -> None:
    study = checked(SpectrumPage, asked(COUPLING, **{**SAID, "cases": SAID["cases"].replace("low", "=1+1")}))
    assert b"\n'=1+1," in pages.file(study, told(study), "losses", "csv")


def test_listed_values_and_their_weights_are_typed_with_semicolons() -> None:
    said = {
        "t0": "coupling.teeth",
        "t0.law": "listed",
        "t0.about": "40; 50; 60",
        "t0.by": "1; 2; 1",
        "cases": "name\na",
    }
    study = checked(SpectrumPage, asked(COUPLING, **said)).study
    (scatter,) = study.body.tolerances.inputs
    assert (scatter.values, scatter.weights) == ([40, 50, 60], [1, 2, 1])
    address = address_of(study_calculation(), CASE, study.body.model_dump())
    views = asked_by(address).views
    assert {name: views[name] for name in said if name != "cases"} == {
        name: said[name] for name in said if name != "cases"
    }
    assert (
        checked(SpectrumPage, asked(COUPLING, **said | {"t0.by": ""})).study.body.tolerances.inputs[0].weights is None
    )


def study_calculation() -> Calculation:
    return BY_PATH["/v1/coupling"]


@pytest.mark.ci
def test_one_click_draws_the_uncertainty_of_the_models() -> None:
    said = {"cases": "name\na", "show": "axial_thrust.coaxial_limit_n", "limit": "5000", "machines": "16"}
    study = checked(SpectrumPage, asked(COUPLING, **said))
    page = whole(study, told(study))
    assert "How well the models are known (friction) is not in these numbers" in page
    (address,) = re.findall(r'href="([^"]+)">Draw the uncertainty of the models too', page)
    found = asked_by(unescape(address))
    drawn = checked(SpectrumPage, replace(found, path=found.path.removesuffix("/spectrum")))
    assert [leaf.path for leaf in drawn.study.scattering] == ["friction.coefficient"]
    assert "Draw the uncertainty" not in whole(drawn, told(drawn))


@pytest.mark.ci
def test_a_probability_that_nobody_knows_is_no_number() -> None:
    """The limit is so far away that the computed probability has no meaning."""
    # The page states a probability below 0.001 % instead, and has no figure of the probability.
    lines, page = studied(checked(SpectrumPage, asked(COUPLING, **{**SAID, "limit": "20000"})))
    (limit,) = lines[-1]["limits"]
    assert 0.0 < limit["probability"] < 1e-9
    page = page.replace("\u00a0", " ")
    assert "The limit holds: below 0.001 % of the machines" in page
    assert "The probability of violating the limit is below 0.001 % for the whole spectrum" in page
    assert 'id="figure-probability"' not in page


def test_the_nominal_machine_alone() -> None:
    said = {"cases": "name;share\nonly;1", "show": "axial_thrust.force_n"}
    lines, page = studied(checked(SpectrumPage, asked(COUPLING, **said)))
    assert lines[-1]["points"] == 1
    assert "state a limit to get a probability" in page


@pytest.mark.parametrize(
    ("said", "control"),
    [
        ({"cases": "name\nfull\t1"}, "cases"),
        ({"cases": "operation.sped_rpm\n1"}, "cases"),
        ({"cases": "share\n0.5"}, "cases"),
        ({"t0": "friction.coefficient", "t0.by": "-1"}, "t0.by"),
        ({"t0": "friction.coefficient", "t0.by": "x"}, "t0.by"),
        ({"t0": "friction.coeficient", "t0.by": "0.1"}, "t0"),
        ({"t0": "friction.coefficient", "t0.by": "0.1", "t1": "friction.coefficient", "t1.by": "0.1"}, "t0"),
        ({"t3": "friction.coefficient", "t3.by": "-1"}, "t3.by"),  # the tolerances before it are empty
        ({"t3": "friction.coeficient", "t3.by": "0.1"}, "t3"),
        ({"t2": "friction.coefficient", "t2.by": "0.1", "t4": "friction.coefficient", "t4.by": "0.1"}, "t2"),
        ({"t0": "friction.coefficient", "t0.by": "0.02", "machines": "1000000"}, "machines"),
        ({"cases": "name\na", "limit": "x"}, "limit"),
        ({"cases": "name\na", "limit.by": "5", "show": "axial_thrust.force_n"}, "limit"),
        ({"cases": "name\na", "limit.by": "-1", "limit": "1", "show": "axial_thrust.force_n"}, "limit"),
        ({"cases": "name\na", "hours": "-1"}, "hours"),
    ],
)
def test_what_is_wrong_stands_at_its_control(client: httpx.Client, said: dict[str, str], control: str) -> None:
    page = client.get("/coupling/spectrum?" + urlencode([*CASE, *said.items()]))
    assert page.status_code == 422
    assert fault_at(page.text, control)
    assert f'href="#f.{control}"' in page.text


def test_names_that_contradict_each_other_are_a_fault_on_the_page(client: httpx.Client) -> None:
    page = client.get("/coupling/spectrum?a.b=3&a=x&cases=name")
    assert page.status_code == 400
    assert "<li>The query contains the field a twice</li>" in page.text
    assert '<form id="study"' in page.text


@pytest.mark.slow
def test_hostile_queries_are_no_errors_of_the_service(client: httpx.Client) -> None:
    """Whatever text stands in a control of the page, the service answers with a page or refuses the query."""
    texts = [
        "\x00\x01",
        '"',
        "name\n" + "\n".join("abc" * 50),
        "<script>;share\n1;1",
        "name;" * 500,
        "set;set\n1;2",
        "٣\n٣",
    ]
    for text in texts:
        for name in ("cases", "t0", "machines", "limit", "limit.by", "limit.side", "hours", "show", "t0.law"):
            said = {"t0": "friction.coefficient", "t0.by": "0.01", "cases": "name\na", name: text}
            page = client.get("/coupling/spectrum?" + urlencode([*CASE, *said.items()]), follow_redirects=True)
            assert page.status_code in {200, 400, 422}, (name, text)
            assert "<script>;" not in page.text


@pytest.mark.ci
def test_the_page_works_from_the_case(client: httpx.Client) -> None:
    case = client.get("/coupling?" + urlencode(CASE))
    address = unescape(re.findall(r'href="(/coupling/spectrum\?[^"]+)"', case.text)[0])
    start = client.get(address)
    assert start.status_code == 200
    assert "full load\t0.8\t" in unescape(start.text)
    page = client.get(address + "&" + urlencode(SAID))
    assert page.status_code == 200
    assert 'id="figure-limit"' in page.text
    figure = client.get(address.replace("/spectrum?", "/spectrum/figures/losses.csv?") + "&" + urlencode(SAID))
    assert figure.status_code == 200
    assert figure.text.splitlines()[1].startswith("low,")


class Inline:
    """A pool that runs every call immediately, in this process."""

    slots = 1

    def submit(self, function: Callable[..., Any], *arguments: Any) -> asyncio.Future[Any]:
        """Return a future that already has the result of the call."""
        future = asyncio.get_running_loop().create_future()
        future.set_result(function(*arguments))
        return future


def parts_of_report(study: StudyPage, lines: list[dict[str, Any]]) -> list[str]:
    """Return the parts of the document with the report, in the order in which they are sent."""
    # The lines of the study arrive every 0.31 s. Parts about the progress are sent at most every 0.3 s.
    clock = Clock(study.study.total)

    async def arriving() -> AsyncGenerator[list[dict[str, Any]], None]:
        for line in lines:
            await asyncio.sleep(0.31)
            clock.done = line.get("done", clock.done)
            yield [line]

    async def sent() -> list[str]:
        return [part.decode() async for part in report_pieces(Inline, study, "", arriving(), clock)]

    return asyncio.run(sent())


@pytest.mark.usefixtures("without_images")
@pytest.mark.ci
def test_the_report_tells_how_many_points_are_calculated_until_it_comes() -> None:
    study = checked(SpectrumPage, asked(COUPLING, **SAID))
    total = study.study.total
    half = {"type": "progress", "done": total // 2, "total": total, "elapsed_s": 1.0}
    all_of = half | {"done": total}
    first, *between, last = parts_of_report(study, [half, all_of, *told(study)])
    assert f'<progress max="{total}" value="0"' in first
    texts = [re.sub(r"<[^>]+>", "", part) for part in between]
    assert f"{total // 2} of {total} points are calculated." in texts[0]
    assert f"{total} of {total} points are calculated; the report is being written." in texts[-1]
    assert last.startswith("<style>")
    assert "<h2>Load spectrum</h2>" in last
    assert (first + last).count("<body>") == (first + last).count("</body>") == 1


@pytest.mark.ci
def test_the_report_of_a_study_that_ends_early_says_why() -> None:
    study = checked(SpectrumPage, asked(COUPLING, **SAID))
    ended = {"type": "error", "code": "deadline_exceeded", "message": "It took too long.", "done": 5}
    *_, last = parts_of_report(study, [told(study)[0], ended])
    assert f"The study ended after 5 of {study.study.total} points. It took too long." in last
    assert "<main" not in last


@pytest.mark.ci
def test_the_report_has_a_section_of_its_own(client: httpx.Client) -> None:
    query = urlencode([*CASE, *SAID.items(), ("project", "Pump 7")])
    page = client.get(f"/coupling/spectrum?{query}")
    address = unescape(re.findall(r'href="(/coupling/spectrum/report\?[^"]+)"', page.text)[0])
    report = client.get(address)
    assert report.status_code == 200
    text = unescape(report.text)
    section = text.partition("<h2>Load spectrum</h2>")[2].partition("</section>")[0]
    assert "of the machines exceed the limit" in section.replace("\u00a0", " ")
    assert section.count("<figure") == 4
    assert "<caption>Tolerances</caption>" in section
    assert "<h2>Inputs</h2>" in text
    refused = client.get(f"/coupling/spectrum/report?{query}&t1=nothing")
    assert refused.status_code == 422
