"""Wires the application together."""

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from fastapi import FastAPI
from fastapi_offline import FastAPIOffline

from app import problems
from app.answers import Answers
from app.compression import Compression
from app.protection import Protection
from app.responses.common import MODEL_VERSION
from app.routes import calculations, figures, pages, service, studies, study_pages, vary
from app.settings import MEBIBYTE, Settings
from app.settings import settings as settings_from_environment
from app.start_up import StartUp
from app.studies.office import Office
from app.workers.admission import Runner
from app.workers.pool import Pool

DESCRIPTION = """Tribology of high-speed drive trains: gear couplings (Pahl), air-oil pumping between gear teeth
(Milian, Distretti, Leoni, Velex), load distribution and scuffing of helical gears (Xue, Zhang, Wang).
Units are in the field names; every example below runs as it stands."""

# Slow to load or asked for by studies: random samples need scipy.stats, a drawing half a second and 70 MB.
WORKERS_SHARE = ("scipy.stats", "app.figures.drawing.image", "app.studies.sweep")


def create_app(settings: Settings | None = None) -> FastAPI:
    """The service; settings come from the environment unless given."""
    settings = settings or settings_from_environment()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        app.state.pool = Pool(settings.workers, settings.worker_memory_mb, WORKERS_SHARE)
        app.state.start_up = StartUp(app.state.pool)
        app.state.settings = settings
        app.state.runner = Runner(settings, app.state.pool)
        app.state.office = Office(settings, app.state.pool)
        app.state.answers = Answers(settings.answers_mb * MEBIBYTE)
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
    app.add_middleware(Protection, settings=settings)
    return app
