"""The Python clients work with the running service, and handle refusals, requests to wait and aborted studies."""

import asyncio
import json
from collections.abc import AsyncIterator, Callable, Iterator

import httpx
import pytest
import uvicorn

from app.client import OPTIONS, AsyncTribodrive, ProblemError, ServiceError, Study, StudyError, Tribodrive

pytestmark = pytest.mark.ci

COUPLING = {
    "coupling": {"teeth": 52, "module_mm": 3, "crowning_ratio": 1},
    "operation": {"torque_n_m": 3000, "speed_rpm": 1910, "misalignment_deg": 0.05, "axial_velocity_mm_per_s": 2},
    "friction": {"coefficient": 0.2},
    "detail": "summary",
}
SWEEP = {
    "endpoint": "/v1/coupling",
    "request": {key: value for key, value in COUPLING.items() if key != "detail"},
    "vary": [{"path": "operation.torque_n_m", "values": [1500, 3000]}],
    "outputs": ["axial_thrust.force_n"],
}


@pytest.fixture
def service(server: str) -> Iterator[Tribodrive]:
    with Tribodrive(server) as service:
        yield service


def behind(*answers: httpx.Response) -> Tribodrive:
    """Return a client whose service gives these answers one after the other."""
    left = iter(answers)
    return Tribodrive(transport=httpx.MockTransport(lambda _: next(left)))


def test_every_endpoint_has_its_method(served: httpx.Client) -> None:
    asked: list[str] = []

    def note(request: httpx.Request) -> httpx.Response:
        asked.append(request.url.path)
        return httpx.Response(200, json={"type": "end"})

    client = Tribodrive(transport=httpx.MockTransport(note))
    for name in sorted(public(Tribodrive) - {"close", "example", "solve", "study"}):
        answer = getattr(client, name)({})
        if isinstance(answer, Study):
            list(answer)
    paths = served.get("/openapi.json").json()["paths"]
    solved = {path for path, methods in paths.items() if "post" in methods and "{" not in path}
    assert set(asked) == solved - {"/v1/rexs", "/v1/rexs/results", "/rexs"}


def public(client: type) -> set[str]:
    return {name for name in dir(client) if not name.startswith("_")}


def test_both_clients_have_the_same_methods(server: str) -> None:
    assert public(AsyncTribodrive) == public(Tribodrive)
    name = "pahl-axial-displacement"

    async def requested() -> object:
        async with AsyncTribodrive(server) as client:
            return await client.example(name)

    with Tribodrive(server) as service:
        assert asyncio.run(requested()) == service.example(name)


def test_an_answer_is_that_of_the_interface(service: Tribodrive, post: Callable[..., httpx.Response]) -> None:
    assert service.coupling(COUPLING) == post("/v1/coupling", COUPLING).json()


def test_a_refusal_names_field_and_cause(service: Tribodrive) -> None:
    wrong = {**COUPLING, "coupling": {"teeth": 3, "module_mm": 3}}
    with pytest.raises(ProblemError, match="/coupling/teeth is 3") as caught:
        service.coupling(wrong)
    assert caught.value.status == 422
    assert caught.value.code == "invalid_request"
    assert [each["pointer"] for each in caught.value.errors] == ["/coupling/teeth"]


def test_a_refusal_that_names_its_field_names_it_once() -> None:
    fault = {"pointer": "/gears/module_mm", "code": "out_of_range", "message": "module_mm is 0, and must be above 0"}
    with pytest.raises(ProblemError) as caught:
        behind(httpx.Response(422, json={"errors": [fault, {"pointer": "", "message": None}]})).scuffing({})
    assert str(caught.value) == "422 : /gears/module_mm is 0, and must be above 0; request: "


def test_a_sweep_is_an_iterator_and_a_table(service: Tribodrive) -> None:
    sweep = service.sweep(SWEEP, progress=True)
    thrusts = [point["out"][0] for point in sweep]
    request = {key: value for key, value in COUPLING.items() if key != "detail"}
    assert thrusts[1] == service.coupling(request)["axial_thrust"]["force_n"]
    assert sweep.header["total"] == 2
    assert sweep.end["counts"] == {"ok": 2}
    table = sweep.frame()
    assert list(table.columns) == ["operation.torque_n_m", "axial_thrust.force_n", "status"]
    assert list(table["axial_thrust.force_n"]) == thrusts


def test_a_sensitivity_is_a_table(service: Tribodrive) -> None:
    table = service.sensitivity({"endpoint": "/v1/coupling", "request": SWEEP["request"]}).frame()
    assert {"output", "path", "derivative", "elasticity"} <= set(table.columns)


def test_a_spectrum_is_a_table_of_its_cases(service: Tribodrive) -> None:
    """The progress bar of a spectrum ends at the total, although the last progress line reports fewer solutions."""
    cases = [{"name": "full"}, {"name": "half", "set": {"operation.torque_n_m": 1500}}]
    request = {key: SWEEP[key] for key in ("endpoint", "request", "outputs")} | {"cases": cases}
    spectrum = service.spectrum(request, progress=True)
    table = spectrum.frame()
    assert list(table["name"]) == ["full", "half"]
    assert "means.axial_thrust.force_n" in table.columns
    assert spectrum._bar.n == spectrum._bar.total == 2


def test_the_asynchronous_client_answers_the_same(server: str, service: Tribodrive) -> None:
    async def ask() -> tuple[object, list[float]]:
        async with AsyncTribodrive(server) as client:
            answer = await client.coupling(COUPLING)
            sweep = client.sweep(SWEEP)
            return answer, list((await sweep.frame())["axial_thrust.force_n"])

    answer, thrusts = asyncio.run(ask())
    assert answer == service.coupling(COUPLING)
    assert thrusts == list(service.sweep(SWEEP).frame()["axial_thrust.force_n"])


def test_a_busy_service_is_asked_again_after_the_time_it_names() -> None:
    busy = httpx.Response(503, json={"type": "urn:tribodrive:problem:queue_full"}, headers={"Retry-After": "0"})
    assert behind(busy, busy, httpx.Response(200, json={"status": "ok"})).coupling({}) == {"status": "ok"}


def test_who_is_to_wait_longer_than_his_patience_is_told_at_once() -> None:
    busy = httpx.Response(503, json={"type": "urn:tribodrive:problem:warming_up"}, headers={"Retry-After": "3600"})
    with pytest.raises(ProblemError, match="warming_up"):
        behind(busy).coupling({})


def test_what_has_no_time_to_try_again_is_not_tried_again() -> None:
    with pytest.raises(ProblemError, match="memory_limit"):
        behind(httpx.Response(503, json={"type": "urn:tribodrive:problem:memory_limit"})).coupling({})
    with pytest.raises(ProblemError, match="502"):
        behind(httpx.Response(502, text="<html>")).coupling({})


def test_a_study_without_end_is_an_error() -> None:
    header = {"type": "sweep", "case": "0", "axes": [], "outputs": [], "total": 2}
    with pytest.raises(StudyError, match="closed before"):
        list(behind(httpx.Response(200, text=json.dumps(header))).sweep({}))
    broken = {"type": "error", "code": "study_deadline", "message": "the study took longer than 1 s"}
    with pytest.raises(StudyError, match="study_deadline"):
        list(behind(httpx.Response(200, text=json.dumps(broken))).sweep({}))


def test_idle_connections_end_before_the_service_closes_them() -> None:
    """If the service closed a connection first, a request on its way would get no answer."""
    assert OPTIONS["limits"].keepalive_expiry < uvicorn.Config("app.main:app").timeout_keep_alive


def breaks(_: httpx.Request) -> httpx.Response:
    raise httpx.ConnectError("refused")


def test_a_broken_connection_is_an_error_of_the_service() -> None:
    service = Tribodrive(transport=httpx.MockTransport(breaks))
    for ask in (service.coupling, service.example, lambda request: list(service.sweep(request))):
        with pytest.raises(ServiceError, match="refused"):
            ask({})

    async def ask_async() -> list[object]:
        async with AsyncTribodrive(transport=httpx.MockTransport(breaks)) as client:
            asked = (client.coupling({}), client.example(""), client.sweep({}).frame())
            return list(await asyncio.gather(*asked, return_exceptions=True))

    errors = asyncio.run(ask_async())
    assert [type(error) for error in errors] == [ServiceError] * 3
    assert all("refused" in str(error) for error in errors)


def test_a_connection_that_breaks_during_a_study_is_told() -> None:
    def lines() -> Iterator[bytes]:
        yield b'{"type": "sweep", "case": "0", "axes": [], "outputs": [], "total": 2}\n'
        raise httpx.ReadError("reset")

    async def lines_async() -> AsyncIterator[bytes]:
        for line in lines():
            yield line

    with pytest.raises(StudyError, match="before the study's end: reset"):
        list(behind(httpx.Response(200, content=lines())).sweep({}))
    torn = httpx.MockTransport(lambda _: httpx.Response(200, content=lines_async()))
    with pytest.raises(StudyError, match="before the study's end: reset"):
        asyncio.run(AsyncTribodrive(transport=torn).sweep({}).frame())


def test_deep_json_is_an_error_of_the_service() -> None:
    deep = httpx.Response(200, text="[" * 100_000)
    with pytest.raises(ServiceError, match="not a JSON object"):
        behind(deep).coupling({})
    with pytest.raises(StudyError, match="does not belong to a study"):
        list(behind(deep).sweep({}))


@pytest.mark.parametrize(("indices", "words"), [((0,), "has 2 points, but 1 arrived"), ((0, 0, 1), "0 twice")])
def test_missing_and_doubled_points_of_a_sweep_are_noticed(indices: tuple[int, ...], words: str) -> None:
    header = {"type": "sweep", "case": "", "outputs": [], "axes": [], "total": 2}
    points = [{"type": "point", "index": index, "at": [], "out": [], "status": "ok"} for index in indices]
    lines = "".join(f"{json.dumps(line)}\n" for line in [header, *points, {"type": "end"}])
    with pytest.raises(StudyError, match=words):
        list(behind(httpx.Response(200, text=lines)).sweep({}))


def test_a_study_that_is_read_again_counts_its_points_anew() -> None:
    header = {"type": "sweep", "case": "", "outputs": [], "axes": [], "total": 1}
    point = {"type": "point", "index": 0, "at": [], "out": [], "status": "ok"}
    lines = "".join(f"{json.dumps(line)}\n" for line in (header, point, {"type": "end"}))
    sweep = behind(httpx.Response(200, text=lines), httpx.Response(200, text=lines)).sweep({})
    assert list(sweep) == list(sweep) == [point]
