"""The service without a server and without processes: requests reach the application through httpx's ASGI transport."""

import asyncio
from threading import Lock

import httpx
from cachetools import LRUCache

from app.http.admission import StudyAdmission
from app.main import app
from app.models.kernels import KERNEL_GROUPS
from app.settings import MEBIBYTE, settings
from app.workers.start_up import StartUp
from tests.support.pools import InlineWorkers


class InProcess(httpx.BaseTransport):
    """A transport to a service of its own, for clients that are not asynchronous."""

    def __init__(self) -> None:
        limits = settings()
        app.state.settings = limits
        app.state.pool = pool = InlineWorkers(limits)
        app.state.start_up = start_up = StartUp()
        for group in KERNEL_GROUPS:
            start_up._advance(group.name, 100)
        app.state.studies = StudyAdmission(limits, pool)
        app.state.answers = LRUCache(limits.answers_mb * MEBIBYTE, getsizeof=len)
        self._transport = httpx.ASGITransport(app, raise_app_exceptions=False)
        self._loop, self._lock = asyncio.Runner(), Lock()

    def handle_request(self, request: httpx.Request) -> httpx.Response:
        request.read()
        with self._lock:
            return self._loop.run(self._answered(request))

    async def _answered(self, request: httpx.Request) -> httpx.Response:
        response = await self._transport.handle_async_request(request)
        assert isinstance(response.stream, httpx.AsyncByteStream)
        content = b"".join([piece async for piece in response.stream])
        return httpx.Response(response.status_code, headers=response.headers, stream=httpx.ByteStream(content))

    def close(self) -> None:
        self._loop.close()
