"""One running service for all tests that talk to one."""

from collections.abc import Callable, Iterator
from fcntl import LOCK_EX, LOCK_UN, flock

import httpx
import pytest
from hypothesis import HealthCheck, settings

from tests.support.server import running_server

# The first example of a property may compile a kernel; the same examples every time, searches live in benchmarks.
settings.register_profile(
    "kernels",
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],  # drawing a gear unit takes long
)
settings.load_profile("kernels")


@pytest.fixture
def without_images(monkeypatch: pytest.MonkeyPatch) -> None:
    """Images of a report's figures are empty, where its texts alone are read."""
    monkeypatch.setattr("app.pages.charts.written", lambda *_: b"")


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    # Processes of one test run start theirs in turn: where kernels have to be compiled, the next one finds them.
    with (tmp_path_factory.getbasetemp().parent / "server.lock").open("w") as turn:
        flock(turn, LOCK_EX)
        with running_server(log_level="error") as (_, address):
            flock(turn, LOCK_UN)
            yield address


@pytest.fixture(scope="session")
def client(server: str) -> Iterator[httpx.Client]:
    # The service closes idle connections after 5 s.
    with httpx.Client(base_url=server, timeout=60, limits=httpx.Limits(keepalive_expiry=3)) as client:
        yield client


@pytest.fixture(scope="session")
def post(client: httpx.Client) -> Callable[[str, object], httpx.Response]:
    def post(path: str, body: object) -> httpx.Response:
        return client.post(path, json=body)

    return post
