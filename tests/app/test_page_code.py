"""The programs beside a result, in Python and for the shell, send the request of the case."""

import json
import shlex
from html import unescape
from typing import Any

import httpx
import pytest

from app import client as client_module
from app.calculations import CALCULATIONS, Calculation
from app.examples import examples
from app.pages.cases import SolvedCase
from app.pages.report import for_python, for_shell
from app.pages.templating import example_link
from app.schema.reading import validated

FIRST = {each.endpoint: each for each in reversed(examples().values())}


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_both_programs_send_the_request_of_the_case(
    calculation: Calculation, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    request = FIRST[calculation.path].request
    case = SolvedCase(calculation, validated(calculation.request, request), None, b"")
    sent: list[tuple[str, str, Any]] = []

    def solve(service: client_module.Tribodrive, endpoint: str, given: Any) -> Any:
        sent.append((str(service._http.base_url), endpoint, given))
        return {"status": "asked"}

    monkeypatch.setattr(client_module.Tribodrive, "solve", solve)
    exec(for_python("http://127.0.0.1:1", case), {})  # noqa: S102
    assert capsys.readouterr().out == "asked\n"
    *_, address, _, header, _, data = shlex.split(for_shell("http://127.0.0.1:1", case))
    sent.append((address.removesuffix(calculation.path), calculation.path, json.loads(data)))
    assert header == "Content-Type: application/json"
    for base, endpoint, posted in sent:
        assert (base.rstrip("/"), endpoint) == ("http://127.0.0.1:1", calculation.path)
        assert validated(calculation.request, posted) == validated(calculation.request, request)


def test_the_page_shows_them(client: httpx.Client) -> None:
    example = examples()["pahl-axial-displacement"]
    page = client.get(example_link(CALCULATIONS[0], example), follow_redirects=True).text
    case = SolvedCase(CALCULATIONS[0], validated(CALCULATIONS[0].request, example.request), None, b"")
    assert for_shell("http://localhost:8000", case) in unescape(page)
    assert for_python("http://localhost:8000", case) in unescape(page)
