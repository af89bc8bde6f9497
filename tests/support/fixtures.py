"""Fixtures of all tests: the tests in a process share one service.

The service of `client` and `post` answers in the process of the test; its worker processes are the matter of
tests/service. `served` is the client of a process of its own, for tests marked `ci`.
"""

import os
from collections.abc import Callable, Iterator

import httpx
import pytest
from hypothesis import HealthCheck, settings

from app.evaluate import warm
from app.models.kernels import KERNEL_GROUPS
from tests.support.in_process import InProcess
from tests.support.server import running_server
from tests.support.solved import FOLDER, remember_solutions

# The first example of a property may compile a kernel; the same examples every time, searches live in benchmarks.
settings.register_profile(
    "kernels",
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],  # drawing a gear unit takes long
)
settings.load_profile("kernels")


def pytest_sessionstart() -> None:
    """Load all kernels. What is not compiled yet is compiled by one process, while the others wait for its solution."""
    remember_solutions()
    if FOLDER in os.environ:
        for group in KERNEL_GROUPS:
            warm(group)


@pytest.fixture
def without_images(monkeypatch: pytest.MonkeyPatch) -> None:
    """Skip the layout and the drawing of figures, for tests that read only the texts of a report."""
    monkeypatch.setattr("app.figures.drawing.image.draw_for_report", lambda figure: (figure, b""))


@pytest.fixture(scope="session")
def server() -> Iterator[str]:
    with running_server(log_level="error") as (_, address):
        yield address


@pytest.fixture(scope="session")
def served(server: str) -> Iterator[httpx.Client]:
    with httpx.Client(base_url=server, timeout=60, limits=httpx.Limits(keepalive_expiry=3)) as client:
        yield client  # the server closes idle connections after 5 s


@pytest.fixture(scope="session")
def client() -> Iterator[httpx.Client]:
    with httpx.Client(base_url="http://127.0.0.1:8000", transport=InProcess()) as client:
        yield client


@pytest.fixture(scope="session")
def post(client: httpx.Client) -> Callable[[str, object], httpx.Response]:
    def post(path: str, body: object) -> httpx.Response:
        return client.post(path, json=body)

    return post
