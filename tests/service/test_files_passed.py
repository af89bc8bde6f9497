"""How many modules one request passes: what somebody reads who follows it from the application to the answer's bytes.

Not counted: the modules of the solvers, which are the model; app/log.py, whose thread writes the log.
"""

import asyncio
import pickle
import re
import sys
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

import httpx
import pytest

from app import calculations, main
from app.examples import examples
from app.settings import Settings
from app.workers import start_up
from tests.support.server import ROOT

COUPLING = examples()["pahl-axial-displacement"]


def modules_entered(work: Callable[[], object]) -> set[str]:
    """The project's modules in which a function is called."""
    entered = set()

    def note(frame: FrameType, event: str, _argument: object) -> None:
        if event == "call":
            entered.add(frame.f_code.co_filename)

    sys.setprofile(note)
    try:
        work()
    finally:
        sys.setprofile(None)
    paths = (Path(name) for name in entered if name.startswith((f"{ROOT}/app/", f"{ROOT}/solvers/")))
    return {str(path.relative_to(ROOT)) for path in paths}


def test_a_coupling_request_passes_at_most_14_files_before_the_solver(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(main, "settings", lambda: Settings(workers=1, log_level="error"))
    monkeypatch.setattr(start_up, "STAGES", (calculations.COUPLING,))
    app = main.create_app()
    calls: list[bytes] = []
    submit = Pool.submit

    def noted(self: Pool, owner: object, function: Callable[..., Any], *arguments: Any) -> Outcome:
        calls.append(pickle.dumps((function, arguments)))
        return submit(self, owner, function, *arguments)

    with asyncio.Runner() as runner:
        lifespan = app.router.lifespan_context(app)
        runner.run(lifespan.__aenter__())

        async def post() -> None:
            async with httpx.AsyncClient(transport=httpx.ASGITransport(app=app), base_url="http://test") as client:
                answer = await client.post(COUPLING.endpoint, json=COUPLING.request, timeout=30)
                assert answer.json()["status"] == "ok"

        async def warm() -> None:
            async with asyncio.timeout(60):
                while not app.state.start_up.warm:  # noqa: ASYNC110  nothing tells when
                    await asyncio.sleep(0.05)
            await post()

        try:
            runner.run(warm())
            service = modules_entered(lambda: runner.run(post()))
            monkeypatch.setattr(Pool, "submit", noted)
            runner.run(post())
        finally:
            runner.run(lifespan.__aexit__(None, None, None))
    monkeypatch.setattr(worker, "prepare", lambda *_: None)  # of this process
    worker.perform(0, (), calls[0])  # a warm worker has looked up every name and unit once
    working = modules_entered(lambda: worker.perform(0, (), calls[0]))
    assert {"app/workers/pool.py", "app/http/json_route.py"} <= service
    assert {"app/workers/worker.py", "solvers/coupling/model.py"} <= working
    passed = {path for path in service | working if path.startswith("app/")}
    assert len(passed) <= 14, sorted(passed)
    chapter = (ROOT / "app" / "manual" / "service.md").read_text("utf-8")
    diagram = chapter.partition("<!-- files of a coupling request -->")[2].partition("<!-- end -->")[0]
    assert set(re.findall(r"app/[a-z_/]+\.py", diagram)) == passed
