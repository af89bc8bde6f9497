"""At its start the service compiles kernels: requests wait for their own, and what prevents serving ends it."""

import asyncio
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from anyio import to_process
from fastapi import Request

from app.calculations import BY_PATH
from app.errors import ClientGone, DeadlineExceeded, WarmingUp
from app.models.kernels import LINE_CONTACT, PUMPING, SCUFFING
from app.settings import Settings
from app.workers import pool as pools
from app.workers import start_up
from app.workers.pool import Pool
from app.workers.start_up import StartUp
from solvers import kernel_cache
from tests.app.test_workers import Processes

ROOT = Path(__file__).parents[2]


class Client:
    """Stand-in for the request of a client, who may leave."""

    def __init__(self) -> None:
        self.left = asyncio.Event()
        self.headers: dict[str, str] = {}
        self.client = SimpleNamespace(host="here")

    async def receive(self) -> dict[str, str]:
        await self.left.wait()
        return {"type": "http.disconnect"}


def as_request(client: Client) -> Request:
    return cast("Request", client)


def test_the_stages_of_a_request_depend_on_the_request() -> None:
    scuffing, pumping = BY_PATH["/v1/scuffing"], BY_PATH["/v1/pumping"]
    assert LINE_CONTACT not in scuffing.kernels.of({"model.lubrication": "closed_form"}.get)
    assert LINE_CONTACT in scuffing.kernels.of({}.get)
    assert LINE_CONTACT in scuffing.kernels.of()
    assert pumping.kernels.of({}.get) == {PUMPING}
    assert pumping.kernels.of({"model.flow": "pocket_chain"}.get) > {PUMPING}
    assert LINE_CONTACT not in BY_PATH["/v1/drive-train"].kernels.of({"model.lubrication": "closed_form"}.get)


def test_a_request_waits_for_its_own_stages_only(monkeypatch: pytest.MonkeyPatch) -> None:
    async def check() -> None:
        starting, client = StartUp(), as_request(Client())
        waiting = asyncio.create_task(starting.wait(client, SCUFFING.all))
        await asyncio.sleep(0.01)
        assert not waiting.done()
        for stage in SCUFFING.all:
            starting._advance(stage.name, 100)
        await asyncio.wait_for(waiting, 1.0)
        monkeypatch.setattr(start_up, "WAIT_S", 0.01)
        with pytest.raises(WarmingUp, match="line contact 0 %"):
            await starting.wait(client, LINE_CONTACT.all)

    asyncio.run(check())


def test_who_leaves_waits_no_longer() -> None:
    async def check() -> None:
        client = Client()
        waiting = asyncio.create_task(StartUp().wait(as_request(client), SCUFFING.all))
        await asyncio.sleep(0.01)
        client.left.set()
        with pytest.raises(ClientGone):
            await asyncio.wait_for(waiting, 1.0)

    asyncio.run(check())


def test_a_line_that_is_no_progress_ends_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    start = asyncio.create_subprocess_exec

    async def talkative(*_: str, **options: Any) -> asyncio.subprocess.Process:
        code = r"print('a warning'); print('coupling: x %'); print('another: 5 %'); print('coupling: 100 %')"
        return await start(sys.executable, "-c", code, **options)

    async def check() -> None:
        monkeypatch.setattr(asyncio, "create_subprocess_exec", talkative)
        starting = StartUp()
        assert await starting._compile(())
        assert starting.warm == ["coupling"]

    asyncio.run(check())


@pytest.mark.ci
def test_a_task_that_fails_ends_the_process_with_the_reason() -> None:
    code = """
import asyncio
from app.main import _vital
async def fails():
    raise RuntimeError("can't start new thread")
async def serving():
    async with asyncio.TaskGroup() as group:
        group.create_task(_vital(fails()))
        await asyncio.sleep(60)
asyncio.run(serving())
"""
    command = [sys.executable, "-c", code]
    ended = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=60, check=False)
    assert ended.returncode == 1
    assert 'cannot serve any more: RuntimeError("can\'t start new thread")' in ended.stderr


def test_compilation_does_not_count_against_the_deadline(monkeypatch: pytest.MonkeyPatch) -> None:
    """A call past its deadline goes on while its worker compiles, and ends when the worker no longer does."""
    processes = Processes()
    monkeypatch.setattr(to_process, "run_sync", processes.run_sync)
    monkeypatch.setattr(pools, "TICK_S", 0.02)

    async def check() -> None:
        pool = Pool(Settings(workers=1, deadline_s=0.2), ())
        tasks = [asyncio.create_task(work) for work in (pool.keep_workers(), pool.serve())]
        call = asyncio.create_task(pool.calculate(as_request(Client()), str, "slow"))
        while not processes.calls:  # noqa: ASYNC110
            await asyncio.sleep(0.01)
        (job,) = pool._running
        file = pool._folder / str(id(job))
        file.touch()
        await asyncio.sleep(0.5)
        assert not call.done()
        file.unlink()
        with pytest.raises(DeadlineExceeded):
            await asyncio.wait_for(call, 2.0)
        for task in tasks:
            task.cancel()
        with suppress(asyncio.CancelledError):
            await asyncio.gather(*tasks)

    asyncio.run(check())


def test_kernels_of_a_folder_that_cannot_be_written_are_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    existing = tmp_path / "mounted" / "name"
    existing.mkdir(parents=True)
    (existing / "kernel.nbc").write_bytes(b"machine code")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    folder = kernel_cache._own_folder("name", existing)
    assert folder is not None
    assert (folder / "kernel.nbc").read_bytes() == b"machine code"
    assert folder.parent.stat().st_mode & 0o077 == 0
    folder.parent.chmod(0o777)  # others may write: their kernels are never loaded
    assert kernel_cache._own_folder("name", existing) is None


@pytest.mark.ci
def test_a_first_call_from_python_says_once_that_it_compiles(tmp_path: Path) -> None:
    code = """
from solvers.coupling.crowning import *
from app.evaluate import answer
from app.examples import examples
example = examples()["pahl-axial-displacement"]
for _ in range(2):
    answer(example.endpoint, example.request)
"""
    environment = {"NUMBA_CACHE_DIR": str(tmp_path), "PATH": "/usr/bin:/bin", "HOME": str(tmp_path)}
    ended = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, env=environment, capture_output=True, text=True, timeout=300, check=True
    )
    (line,) = ended.stderr.splitlines()
    assert "kernels, once after installation, about" in line
