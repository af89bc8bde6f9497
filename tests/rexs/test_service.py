"""The service and the command line take files of gear units and answer them or refuse them."""

import io
import json
import re
import subprocess
import sys
import zipfile
from html import unescape
from pathlib import Path
from typing import Any
from urllib.parse import parse_qsl

import httpx
import pytest

from app.command import print_unit
from tests.rexs.units import three_stages, turbo_unit
from tests.support.server import ROOT

XML = {"Content-Type": "application/xml"}


@pytest.mark.parametrize(
    ("kind", "media_type"),
    [
        ("xml", "application/xml"),
        ("json", "application/json"),
        ("zipped", "application/zip"),
        ("zipped", "application/x-zip-compressed"),
        ("zipped", "application/octet-stream"),
        ("xml", "application/octet-stream"),
    ],
)
def test_a_file_as_the_body(client: httpx.Client, kind: str, media_type: str) -> None:
    content = getattr(three_stages(), kind)()
    answer = client.post("/v1/rexs", content=content, headers={"Content-Type": media_type})
    assert answer.status_code == 200
    assert len(answer.json()["stages"]) == 3


def test_a_file_from_a_form(client: httpx.Client) -> None:
    files = {"file": ("unit.rexs", three_stages().xml())}
    assert (
        client.post("/v1/rexs", files=files).json()
        == client.post("/v1/rexs", content=three_stages().xml(), headers=XML).json()
    )


@pytest.mark.ci
def test_every_request_is_answered_or_says_what_it_lacks(client: httpx.Client) -> None:
    (stage,) = client.post("/v1/rexs", content=turbo_unit().xml(), headers=XML).json()["stages"]
    assert len(stage["requests"]) == 4
    for path, body in stage["requests"].items():
        assert client.post(path, json={**body, "detail": "summary"}).json()["status"].startswith("ok")


@pytest.mark.parametrize(
    ("content", "status", "code"),
    [(b"<a", 422, "not_rexs"), (b"", 422, "not_rexs"), (b"<model version='7'/>", 422, "not_rexs")],
)
def test_what_cannot_be_read_says_why(client: httpx.Client, content: bytes, status: int, code: str) -> None:
    answer = client.post("/v1/rexs", content=content, headers=XML)
    assert (answer.status_code, answer.json()["errors"][0]["code"]) == (status, code)


def test_other_types_and_sizes_are_refused(client: httpx.Client) -> None:
    assert client.post("/v1/rexs", content=b"x", headers={"Content-Type": "text/plain"}).status_code == 415
    assert client.post("/v1/rexs", files={"other": b"x"}).status_code == 422
    assert client.post("/v1/rexs", content=b" " * 22 * 2**20, headers=XML).status_code == 413
    page = client.post("/rexs", files={"file": ("a.rexs", b"<a")})
    assert (page.status_code, "cannot be read" in page.text) == (422, True)


def results(client: httpx.Client, stage: int, request: dict[str, Any] | None = None) -> httpx.Response:
    files: dict[str, Any] = {"file": ("unit.rexs", turbo_unit().xml())}
    if request is not None:
        files["request"] = (None, json.dumps(request))
    return client.post(f"/v1/rexs/results?stage={stage}", files=files)


@pytest.mark.ci
def test_results_come_back_in_the_file(client: httpx.Client) -> None:
    (stage,) = client.post("/v1/rexs", content=turbo_unit().xml(), headers=XML).json()["stages"]
    answer = results(client, stage["id"])
    assert answer.headers["content-type"] == "application/xml"
    assert b"face_load_factor_contact_stress" in answer.content
    edited = {**stage["requests"]["/v1/scuffing"], "temperatures": {"oil_c": 50, "scuffing_c": 300}}
    edited["model"] = {"lubrication": "closed_form"}
    answer = results(client, stage["id"], edited)
    assert b"custom_tribodrive_scuffing_safety_blok" in answer.content
    assert len(client.post("/v1/rexs", content=answer.content, headers=XML).json()["stages"]) == 1
    assert results(client, 999).status_code == 422
    assert results(client, stage["id"], {"gears": {}}).status_code == 422


OIL = {"lubricant.iso_vg": "220", "temperatures.oil_c": "60", "temperatures.scuffing_test.fzg_stage": "12"}


def opened(client: httpx.Client, content: bytes, name: str = "mill 7.rexs") -> str:
    """Open a file, and return the address of its page."""
    sent = client.post("/rexs", files={"file": (name, content)})
    assert sent.status_code == 303
    return str(sent.headers["location"])


def test_any_byte_may_stand_in_the_name_of_a_file(client: httpx.Client) -> None:
    page = client.get(opened(client, three_stages().xml(), "mill\0 7.rexs"))
    assert page.status_code == 200
    assert "mill" in page.text


def test_oil_is_given_once_for_all_stages(client: httpx.Client) -> None:
    address = opened(client, three_stages().xml())
    before = client.get(address).text
    assert "without an oil there is no film" in before
    sent = client.get(address, params={"written": "", **OIL, "temperatures.oil_c": "60 °C", "gears.module_mm": "3"})
    assert sent.status_code == 303
    assert dict(parse_qsl(sent.headers["location"].partition("?")[2])) == OIL
    page = unescape(client.get(sent.headers["location"]).text)
    assert "without an oil there is no film" not in page
    links = [each for each in re.findall(r'href="(/scuffing\?[^"]+)"', page) if "rexs_stage" in each]
    assert len({dict(parse_qsl(each))["rexs_stage"] for each in links}) == 3
    for each in links:
        assert OIL.items() <= dict(parse_qsl(each.partition("?")[2])).items()


def test_the_oil_of_all_stages_replaces_what_the_file_says(client: httpx.Client) -> None:
    page = unescape(client.get(opened(client, turbo_unit().xml()), params=OIL).text)
    for address in re.findall(r'href="(/(?:scuffing|drive-train)\?[^"]+)"', page):
        fields = dict(parse_qsl(address.partition("?")[2]))
        assert fields["lubricant.iso_vg"] == "220"
        assert not [name for name in fields if name.startswith("lubricant.kinematic")]


@pytest.mark.ci
def test_all_stages_in_one_table_and_written_back_at_once(client: httpx.Client) -> None:
    content = three_stages().xml().replace(b"\n", b"\r\n")
    address = opened(client, content)
    page = unescape(client.get(address, params={**OIL, "all": "on"}).text)
    table = page.partition('id="stages"')[2].partition("</table>")[0]
    rows = re.findall(r"<tr>(.*?)</tr>", table, re.DOTALL)
    assert len(rows) == 4
    assert all("Not computed" not in row and "risk" in row for row in rows[1:])
    written = client.post(f"{address}/results", params=OIL)
    assert written.headers["content-disposition"] == "attachment; filename*=UTF-8''mill%207.rexs"
    lines = written.content.splitlines(keepends=True)
    assert [line for line in lines if b"tribodrive" not in line] == content.splitlines(keepends=True)
    assert written.content.count(b"custom_tribodrive_scuffing_safety_blok") == 3
    case = next(each for each in re.findall(r'href="(/scuffing\?[^"]+)"', page))
    answer = client.get(case.replace("/scuffing?", "/scuffing/result.json?")).json()
    assert f">{answer['case']}<".encode() in written.content, "the page of the stage has the same case"


@pytest.mark.ci
def test_without_a_stage_the_results_of_all_stages_are_written(client: httpx.Client) -> None:
    unit = turbo_unit()
    answer = client.post("/v1/rexs/results", files={"file": ("Träger 1.rexs", unit.xml())})
    assert answer.status_code == 200
    assert answer.headers["content-disposition"].endswith("Tr%C3%A4ger%201.rexs")
    assert b"face_load_factor_contact_stress" in answer.content
    torn = client.post("/v1/rexs/results", files={"file": ("a.rexs", unit.xml()), "request": (None, "{}")})
    assert (torn.status_code, torn.json()["errors"][0]["pointer"]) == (422, "/stage")


def test_a_stage_that_cannot_be_calculated_says_so(client: httpx.Client) -> None:
    unit = three_stages()
    for each in unit.components:
        if each["type"] == "external_load":
            each["attributes"].pop("torque_around_u_axis", None)
    answer = client.post("/v1/rexs/results", files={"file": ("a.rexs", unit.xml())})
    assert (answer.status_code, answer.json()["errors"][0]["code"]) == (422, "nothing_calculated")
    address = opened(client, unit.xml())
    page = client.get(address, params={"all": "on"})
    assert page.text.count("Not computed: ") == 3
    assert client.post(f"{address}/results").status_code == 422


@pytest.mark.parametrize(
    "query", ["lubricant.iso_vg=x", "lubricant.iso_vg=NaN", "temperatures.oil_c=1e400", "all=%00", "a" * 5000]
)
def test_any_query_of_a_unit_is_answered(client: httpx.Client, query: str) -> None:
    address = opened(client, three_stages().xml())
    assert client.get(f"{address}?{query}").status_code == 200
    assert client.post(f"{address}/results?{query}").status_code in {200, 422}
    assert client.post(f"/rexs/{'0' * 64}/results?{query}").status_code == 410


FIELD = '<input id="rexs-file" name="file" type="file"'


@pytest.mark.ci
def test_the_page_leads_to_every_calculation(client: httpx.Client) -> None:
    page = client.post("/rexs", files={"file": ("unit.rexs", turbo_unit().xml())}, follow_redirects=True)
    assert page.status_code == 200
    addresses = [part.split('"')[0] for part in page.text.split('href="')[1:]]
    cases = [each.replace("&amp;", "&") for each in addresses if "gears.pinion.teeth=" in each]
    assert len(cases) == 4
    for address in cases:
        assert client.get(address, follow_redirects=True).status_code == 200


def test_the_page_of_a_unit_has_an_address_while_it_is_kept(client: httpx.Client) -> None:
    sent = client.post("/rexs", files={"file": ("unit.rexs", turbo_unit().xml())})
    assert sent.status_code == 303
    kept = client.get(sent.headers["location"])
    assert kept.status_code == 200
    assert client.get(sent.headers["location"]).text == kept.text
    assert "Stages" in kept.text


@pytest.mark.parametrize("name", ["0" * 64, "x", "%2e%2e"])
def test_a_unit_that_is_gone_is_asked_for_again(client: httpx.Client, name: str) -> None:
    gone = client.get(f"/rexs/{name}")
    assert gone.status_code == 410
    assert "This page no longer exists" in gone.text
    assert FIELD in gone.text


@pytest.mark.parametrize(
    ("sent", "status"),
    [
        ({"files": {"file": ("a.rexs", b"<a")}}, 422),
        ({"files": {"other": ("a.rexs", b"<a")}}, 422),
        ({"content": b"x", "headers": {"Content-Type": "text/plain"}}, 415),
    ],
)
def test_a_page_of_an_error_has_the_file_field(client: httpx.Client, sent: dict[str, Any], status: int) -> None:
    sent["headers"] = {"Accept": "text/html", **sent.get("headers", {})}
    answer = client.post("/rexs", **sent)
    assert answer.status_code == status
    assert FIELD in answer.text
    assert FIELD not in client.get("/none", headers={"Accept": "text/html"}).text


def test_where_a_file_is_chosen(client: httpx.Client) -> None:
    answer = client.get("/rexs")
    assert (answer.status_code, answer.headers["location"]) == (303, "/#rexs-file")


def test_the_page_leads_to_the_load_spectrum(client: httpx.Client) -> None:
    unit = turbo_unit()
    load = next(each["id"] for each in unit.components if each["type"] == "external_load")
    unit.cases = [{1: {"operating_time_fraction": (50.0, "%")}, load: {"power": (kw, "kW")}} for kw in (5000.0, 9000.0)]
    page = client.post("/rexs", files={"file": ("unit.rexs", unit.xml())}, follow_redirects=True)
    addresses = [unescape(part.split('"')[0]) for part in page.text.split('href="')[1:]]
    spectra = [address for address in addresses if "/spectrum?" in address]
    assert [address.partition("?")[0] for address in spectra] == ["/scuffing/spectrum", "/drive-train/spectrum"]
    answer = client.get(spectra[0], follow_redirects=True)
    assert answer.status_code == 200
    assert "1 machine in 2 cases" in answer.text


@pytest.mark.ci
def test_the_command_prints_the_answer(
    tmp_path: Path, client: httpx.Client, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "unit.rexs"
    file.write_bytes(three_stages().xml())
    done = subprocess.run(
        [sys.executable, "-m", "app", "rexs", str(file)], capture_output=True, check=True, cwd=ROOT, text=True
    )
    assert json.loads(done.stdout) == client.post("/v1/rexs", content=file.read_bytes(), headers=XML).json()
    with pytest.raises(SystemExit, match=r"nothing\.rexs: No such file"):
        print_unit(Path("nothing.rexs"))
    assert capsys.readouterr().out == ""


def nasty_files() -> dict[str, bytes]:
    """Return unusual files. The service may read or refuse such a file, but must not fail with a server error."""
    unit = turbo_unit()
    few = three_stages("1.4")
    for each in few.components:
        if each["type"] == "cylindrical_gear":
            each["attributes"]["number_of_teeth"] = (2, "none")
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_LZMA) as archive:
        archive.writestr("a.rexs", unit.xml())
    return {
        "nested": unit.xml()
        .replace(b"<components>", b"<a><components>")
        .replace(b"</components>", b"</components></a>"),
        "boolean": unit.json().replace(b'"floating_point": 200.0', b'"boolean": true'),
        "few teeth": few.xml(),
        "huge number": unit.json().replace(b"200.0", b"1e400"),
        "lzma": packed.getvalue(),
        "namespace": unit.xml().replace(b"<model ", b'<model xmlns="urn:a" '),
        "nothing": b"",
    }


@pytest.mark.parametrize("name", nasty_files())
def test_no_file_is_an_error_of_the_server(client: httpx.Client, name: str) -> None:
    content = nasty_files()[name]
    form = {"file": ("unit.rexs", content)}
    stage = next(each["id"] for each in turbo_unit().components if each["type"] == "cylindrical_stage")
    answers = [
        client.post("/v1/rexs", content=content, headers=XML),
        client.post("/v1/rexs", files=form),
        client.post("/rexs", files=form),
        client.post(f"/v1/rexs/results?stage={stage}", files={**form, "request": (None, "{}")}),
    ]
    assert {answer.status_code for answer in answers} <= {200, 303, 422}, "303: to the page of the unit"
