"""The processes of a test run share compiled kernels, and all tests in a process share one service."""

import asyncio
from collections.abc import Callable, Iterator

import httpx
import pytest
from hypothesis import HealthCheck, settings

from app.workers.start_up import StartUp
from tests.support.server import running_server

# The first example of a property may compile a kernel; the same examples every time, searches live in benchmarks.
settings.register_profile(
    "kernels",
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],  # drawing a gear unit takes long
)
settings.load_profile("kernels")


def pytest_sessionstart(session: pytest.Session) -> None:
    """Compile all kernels before the tests run in several processes.

    Otherwise, each of these processes would compile its own kernels.
    """
    if session.config.getoption("numprocesses", None) and not hasattr(session.config, "workerinput"):
        asyncio.run(StartUp().run())


@pytest.fixture
def without_images(monkeypatch: pytest.MonkeyPatch) -> None:
    """Skip the layout and the drawing of figures, for tests that read only the texts of a report."""
    monkeypatch.setattr("app.figures.drawing.image.draw_for_report", lambda figure: (figure, b""))


@pytest.fixture(scope="session")
def server() -> Iterator[str]:
    with running_server(log_level="error") as (_, address):
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
