"""Wires the application together."""

import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

import anyio
from fastapi import FastAPI
from fastapi_offline import FastAPIOffline

from app import problems
from app.compute import Runner
from app.protection import Protection
from app.responses.common import MODEL_VERSION
from app.routes import calculations, figures, service
from app.settings import Settings
from app.settings import settings as settings_from_environment
from app.warm_up import warm_up

DESCRIPTION = """Tribology of high-speed drive trains: gear couplings (Pahl), air-oil pumping between gear teeth
(Milian, Distretti, Leoni, Velex), load distribution and scuffing of helical gears (Xue, Zhang, Wang).
Units are in the field names; every example below runs as it stands."""


def create_app(settings: Settings | None = None) -> FastAPI:
    """The service; settings come from the environment unless given."""
    settings = settings or settings_from_environment()
    runner = Runner(settings, warm_up)

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        app.state.runner = runner
        # Kernels not yet in the cache are compiled once, in a process that takes the compiler's memory with it.
        await anyio.run_process([sys.executable, "-m", "app.warm_up"], check=False)
        async with runner.started():
            yield

    app = FastAPIOffline(
        title="tribodrive",
        description=DESCRIPTION,
        version=MODEL_VERSION,
        lifespan=lifespan,
        redoc_url=None,
    )
    for routes in (calculations, figures, service):
        app.include_router(routes.router)
    problems.install(app)
    app.add_middleware(Protection, settings=settings)
    return app
