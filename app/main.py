"""The FastAPI application."""

import asyncio
import gc
import logging
import os
import traceback
from collections.abc import AsyncIterator, Coroutine
from contextlib import asynccontextmanager
from typing import Any

from cachetools import LRUCache
from fastapi import FastAPI
from starlette.exceptions import HTTPException
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware
from starlette.staticfiles import StaticFiles

from app import log
from app.errors import PROBLEMS
from app.http import problems
from app.http.admission import StudyAdmission
from app.http.middleware import Protection
from app.http.routes import calculations, manual, pages, rexs, service, studies, study_pages
from app.schema.answers import MODEL_VERSION
from app.settings import MEBIBYTE, settings, unknown_variables
from app.workers.pool import Pool
from app.workers.start_up import StartUp

DESCRIPTION = """Tribology of high-speed drive trains: gear couplings (Pahl), air-oil pumping between gear teeth
(Milian, Distretti, Leoni, Velex), load distribution and scuffing of helical gears (Xue, Zhang, Wang).
Units are in the field names; every example below runs as it stands."""

MODULES = ("app.pages.views", "app.pages.studies.page", "app.rexs.answer")
"""Modules that workers load when they start."""
COMPRESSED_FROM = 4096  # bytes; smaller answers are not compressed
# Media types that are already compressed, and media types of studies. The lines of a study must arrive one by one.
NOT_COMPRESSED = (*DEFAULT_EXCLUDED_CONTENT_TYPES, "application/pdf", "application/x-ndjson", "text/csv")

logger = logging.getLogger("tribodrive")


async def _vital(work: Coroutine[Any, Any, None]) -> None:
    """Run a task without which the service cannot serve. If the task fails, end the process with the reason.

    An exception would end the other tasks, but not the process: it would refuse every calculation for ever. The
    workers end themselves when their parent is gone, and a supervisor starts the service anew.
    """
    try:
        await work
    except Exception as error:  # noqa: BLE001  whatever it is
        reason = "".join(traceback.format_exception(error))
        os.write(2, f"{reason}tribodrive: cannot serve any more: {error!r}\n".encode(errors="replace"))
        os._exit(1)


def create_app() -> FastAPI:
    """Create the application. The settings are read from environment variables."""
    limits = settings()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        gc.freeze()  # the garbage collector then ignores the imported objects, which stay in memory
        gc.enable()
        app.state.settings = limits
        app.state.pool = pool = Pool(limits, MODULES)
        app.state.start_up = start_up = StartUp()
        app.state.studies = StudyAdmission(limits, pool)
        app.state.answers = LRUCache(limits.answers_mb * MEBIBYTE, getsizeof=len)
        with log.running(limits.log_level):
            for line in unknown_variables():
                logger.warning(line)
            logger.info("tribodrive: %d workers", limits.workers)
            async with app.state.studies.open(), asyncio.TaskGroup() as group:
                works = [pool.keep_workers(), start_up.run(pool), *(pool.serve() for _ in range(limits.workers))]
                tasks = [group.create_task(_vital(work)) for work in works]
                try:
                    yield
                finally:
                    for task in tasks:
                        task.cancel()

    app = FastAPI(
        title="tribodrive",
        description=DESCRIPTION,
        version=MODEL_VERSION,
        lifespan=lifespan,
        docs_url=None,  # app.http.routes.service serves this page
        redoc_url=None,
        redirect_slashes=False,  # such redirects would contain the host name that the client sent
    )
    app.include_router(calculations.router)
    app.include_router(calculations.figures)
    for routes in (studies, rexs, manual, pages, study_pages, service):
        app.include_router(routes.router)
    app.include_router(rexs.pages)
    app.mount(service.DOCS_ASSETS, StaticFiles(packages=[("fastapi_offline", "static")]))
    problems.install(app)
    app.add_exception_handler(HTTPException, pages.failed)
    for kind in PROBLEMS:
        app.add_exception_handler(kind, pages.failed)
    app.add_middleware(
        GZipMiddleware, minimum_size=COMPRESSED_FROM, compresslevel=4, exclude_content_types=NOT_COMPRESSED
    )
    app.add_middleware(Protection, settings=limits)
    return app


app = create_app()
