"""The manual: its contents, its chapters, and the table of all fields."""

from typing import Annotated

from fastapi import APIRouter, HTTPException, Query, Request, Response
from fastapi.routing import APIRoute
from pydantic import BaseModel

from app.calculations import BY_PATH
from app.http.routes import calculations, rexs, service
from app.http.routes.pages import html, root_of
from app.manual import FIELDS, NAMES
from app.pages.manual import chapter_page, contents_page, fields_page, functions_page, search_page
from app.schema.model import kinds

OTHER_ANSWERS = tuple(
    (route.path, kind)
    for routes in (calculations.router, calculations.figures, rexs.router, service.router)
    for route in routes.routes
    if isinstance(route, APIRoute) and route.include_in_schema and route.path not in BY_PATH
    for kind, _ in kinds(route.response_model)
    if isinstance(kind, type) and issubclass(kind, BaseModel)
)
"""The models of the answers of the addresses that calculate nothing, with these addresses."""

router = APIRouter(include_in_schema=False)

# The first rendering of a chapter takes a tenth of a second. These functions are not coroutines, so that the server can
# answer other requests meanwhile.


@router.get("/manual")
def contents(http: Request, find: Annotated[str, Query(max_length=200)] = "") -> Response:
    """Show the table of contents of the manual, or the sections that have all words of `find`."""
    return html(search_page(root_of(http), find) if find.strip() else contents_page(root_of(http)))


@router.get("/manual/{name}")
def chapter(http: Request, name: str) -> Response:
    """Show a chapter of the manual, or the functions that implement the equations."""
    if name == "functions":
        return html(functions_page(root_of(http)))
    if name not in NAMES:
        raise HTTPException(404, f"The manual has no such chapter. The chapters are {', '.join(NAMES)}, functions")
    return html(fields_page(root_of(http), OTHER_ANSWERS) if name == FIELDS else chapter_page(root_of(http), name))
