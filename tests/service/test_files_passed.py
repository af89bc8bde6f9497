"""A coupling request passes few modules, so that a reader can follow it from the application to the answer's bytes.

Two kinds of modules are not counted: the modules of the solvers, which are the model, and app/log.py, whose thread
writes the log.
"""

import asyncio
import pickle
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import Any

import httpx
import pytest

from app import calculations, main
from app.examples import examples
from app.settings import Settings
from app.workers import start_up, worker
from app.workers.pool import Outcome, Pool
from tests.support.server import ROOT

COUPLING = examples()["pahl-axial-displacement"]


@contextmanager
def modules_entered() -> Iterator[set[str]]:
    """Collect the project's modules in which a function is called while the context is open."""
    entered: set[str] = set()

    def note(frame: FrameType, event: str, _argument: object) -> None:
        path = Path(frame.f_code.co_filename)
        if event == "call" and path.is_relative_to(ROOT) and path.parts[len(ROOT.parts)] in {"app", "solvers"}:
            entered.add(str(path.relative_to(ROOT)))

    sys.setprofile(note)
    try:
        yield entered
    finally:
        sys.setprofile(None)


def test_a_coupling_request_passes_at_most_14_files_before_the_solver(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(main, "settings", lambda: Settings(workers=1, log_level="error"))
    monkeypatch.setattr(start_up, "STAGES", (calculations.COUPLING,))
    app = main.create_app()
    calls: list[bytes] = []
    submit = Pool.submit

    def noted(self: Pool, owner: object, function: Callable[..., Any], *arguments: Any) -> Outcome:
        calls.append(pickle.dumps((function, arguments)))
        return submit(self, owner, function, *arguments)

    async def entered_by_the_service() -> set[str]:
        async with (
            app.router.lifespan_context(app),
            httpx.AsyncClient(transport=httpx.ASGITransport(app=app), base_url="http://test", timeout=30) as client,
        ):

            async def post() -> None:
                answer = await client.post(COUPLING.endpoint, json=COUPLING.request)
                assert answer.json()["status"] == "ok", answer.text

            async with asyncio.timeout(60):
                while not app.state.start_up.warm:  # noqa: ASYNC110  nothing tells when
                    await asyncio.sleep(0.05)
            await post()
            with modules_entered() as entered:
                await post()
            monkeypatch.setattr(Pool, "submit", noted)
            await post()
            return entered

    service = asyncio.run(entered_by_the_service())
    monkeypatch.setattr(worker, "prepare", lambda *_: None)  # of this process
    worker.perform(0, (), Path("compiling"), calls[0])  # a warm worker has looked up every name and unit once
    with modules_entered() as working:
        worker.perform(0, (), Path("compiling"), calls[0])
    assert {"app/workers/pool.py", "app/http/json_route.py"} <= service
    assert {"app/workers/worker.py", "solvers/coupling/model.py"} <= working
    passed = {path for path in service | working if path.startswith("app/")}
    assert len(passed) <= 14, sorted(passed)
    chapter = (ROOT / "app" / "manual" / "service.md").read_text("utf-8")
    diagram = chapter.partition("<!-- files of a coupling request -->")[2].partition("<!-- end -->")[0]
    assert set(re.findall(r"app/[a-z_/]+\.py", diagram)) == passed
