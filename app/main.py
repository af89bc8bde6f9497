"""Wires the application together."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from fastapi import FastAPI
from fastapi_offline import FastAPIOffline

from app import problems
from app.answers import Answers
from app.compression import Compression
from app.protection import Protection
from app.routes import calculations, figures, pages, service, studies, study_pages, vary
from app.schema.base import MODEL_VERSION
from app.settings import MEBIBYTE, settings
from app.studies.office import Office
from app.workers.admission import Runner
from app.workers.control import Template
from app.workers.pool import Pool
from app.workers.start_up import StartUp

DESCRIPTION = """Tribology of high-speed drive trains: gear couplings (Pahl), air-oil pumping between gear teeth
(Milian, Distretti, Leoni, Velex), load distribution and scuffing of helical gears (Xue, Zhang, Wang).
Units are in the field names; every example below runs as it stands."""


def create_app() -> FastAPI:
    """The service; settings come from the environment."""
    limits = settings()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        template = getattr(app.state, "template", None) or Template()
        app.state.pool = Pool(limits.workers, limits.queue, limits.worker_memory_mb, template)
        app.state.start_up = StartUp(app.state.pool)
        app.state.settings = limits
        app.state.runner = Runner(limits, app.state.pool)
        app.state.office = Office(limits, app.state.pool)
        app.state.answers = Answers(limits.answers_mb * MEBIBYTE)
        app.state.published = {}
        async with app.state.pool.running(), app.state.start_up.running(), app.state.office.open():
            yield

    app = FastAPIOffline(
        title="tribodrive",
        description=DESCRIPTION,
        version=MODEL_VERSION,
        lifespan=lifespan,
        redoc_url=None,
    )
    for routes in (calculations, figures, studies, pages, vary, study_pages, service):
        app.include_router(routes.router)
    problems.install(app)
    app.add_middleware(Compression)
    app.add_middleware(Protection, settings=limits)
    return app


app = create_app()
