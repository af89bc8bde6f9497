"""The template process as the service sees it."""

import asyncio
from concurrent.futures import ThreadPoolExecutor

import pytest

from app.workers import fork_server
from app.workers.fork_server import ForkServer, Worker

pytestmark = pytest.mark.service


def test_imports_may_take_longer_than_a_fork(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a busy machine they take ten times as long as on a quiet one, and are not started again for it."""
    monkeypatch.setattr(fork_server, "FORK_TIMEOUT_S", 1.0)  # imports take two seconds

    async def forked() -> bool:
        ended: asyncio.Future[Worker] = asyncio.get_running_loop().create_future()
        server = ForkServer.start()
        try:
            worker = await server.fork(512, ended.set_result)
            alive = worker.alive
            worker.kill()
            await ended
            await server.reap(worker.pid)
            return alive
        finally:
            server.close()

    with ThreadPoolExecutor(1) as thread:  # the browser of other tests keeps its event loop in this one
        assert thread.submit(lambda: asyncio.run(forked())).result()
