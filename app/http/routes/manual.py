"""The theory manual."""

from fastapi import APIRouter, HTTPException, Request, Response
from fastapi.responses import RedirectResponse

from app.http.routes.pages import html, root_of
from app.manual.chapters import NAMES
from app.pages.manual import chapter_page, contents_page, functions_page

router = APIRouter(include_in_schema=False)


# Rendering takes a tenth of a second the first time: these are no coroutines, so that the server answers meanwhile.


@router.get("/manual")
def contents(http: Request) -> Response:
    """The table of contents."""
    return html(contents_page(root_of(http)))


@router.get("/manual/functions")
def functions(http: Request) -> Response:
    """The functions that implement the equations."""
    return html(functions_page(root_of(http)))


@router.get("/manual/{name}")
def chapter(http: Request, name: str) -> Response:
    """One chapter."""
    if name not in NAMES:
        raise HTTPException(404, f"There are {', '.join(NAMES)} and functions")
    return html(chapter_page(root_of(http), name))


@router.get("/{model}/about")
def about(http: Request, model: str) -> Response:
    """Redirect from the former address of a chapter."""
    if model not in NAMES:
        raise HTTPException(404, f"The manual has no chapter on {model}")
    return RedirectResponse(f"{root_of(http)}/manual/{model}", 308)
