"""Examples, health and metrics."""

from typing import Annotated, Literal

from fastapi import APIRouter, HTTPException, Path, Request, Response
from prometheus_client import CONTENT_TYPE_LATEST, generate_latest
from pydantic import BaseModel

from app.errors import WorkerLost
from app.examples import Example, ExampleSummary, examples
from app.http.problems import documented
from app.http.routes.pages import HTML, root_of
from app.pages.templating import rendered
from app.schema.quantities import Output

DOCS_ASSETS = "/static-offline-docs"  # assets of Swagger's page; the package fastapi-offline contains them

router = APIRouter(tags=["service"])


class Health(BaseModel):
    """The answer of a running service."""

    status: Annotated[Literal["ok"], Output("always ok: an answer is the message")] = "ok"


class Readiness(BaseModel):
    """The calculations that are ready, and the number of workers."""

    status: Annotated[Literal["ok"], Output("always ok: an answer is the message")] = "ok"
    warm: Annotated[list[str], Output("models, or parts of them, whose kernels are loaded")]
    workers: Annotated[int, Output("number of worker processes that can calculate")]


@router.get("/v1/examples")
async def list_examples() -> list[ExampleSummary]:
    """List the examples without their requests."""
    return [*examples().values()]


@router.get("/v1/examples/{name}", responses=documented(404, 422))
async def show_example(name: Annotated[str, Path(description="name of the example", max_length=100)]) -> Example:
    """Return an example with its request."""
    if name not in examples():
        raise HTTPException(404, "There is no example with this name; GET /v1/examples lists all examples")
    return examples()[name]


@router.get("/healthz")
async def healthz() -> Health:
    """Return `ok`, which shows that the service is running."""
    return Health()


@router.get("/readyz", responses=documented(503))
async def readyz(http: Request) -> Readiness:
    """Return `ok` if all calculations are ready and a worker is alive. Otherwise, answer 503 with the reason."""
    start_up, pool = http.app.state.start_up, http.app.state.pool
    start_up.require()
    if pool.alive <= 0:
        raise WorkerLost
    return Readiness(warm=start_up.warm, workers=pool.alive)


@router.get("/docs", include_in_schema=False)
async def docs(http: Request) -> Response:
    """Show the OpenAPI document on Swagger's page."""
    page = rendered("docs.html", root_of(http), assets=DOCS_ASSETS, description=http.app.description)
    return Response(page, media_type=HTML)


@router.get("/metrics", response_class=Response, include_in_schema=False)
async def metrics() -> Response:
    """Return the metrics in the Prometheus text format."""
    return Response(generate_latest(), media_type=CONTENT_TYPE_LATEST)
