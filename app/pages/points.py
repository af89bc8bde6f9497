"""The cases that a study asks, as cases of their own: their fields, their pages, their answers."""

from app.pages.cases import Case, solved
from app.pages.query import Pairs, body_of, link, pairs_of
from app.pages.views import Asked
from app.studies.drive_train import lightened
from app.studies.points import with_overrides
from app.studies.requests import Overrides


def pairs_at(asked: Asked, overrides: Overrides) -> Pairs:
    """The fields of the case with a point's values."""
    body = with_overrides(asked.calculation, body_of(asked.calculation.request, asked.pairs), overrides)
    del body["detail"]
    return pairs_of(body)


def address_at(asked: Asked, overrides: Overrides, below: str = "") -> str:
    """Where the page of a point is, or a view of it."""
    return link(f"{asked.path}{below}", pairs_at(asked, overrides), theme=asked.views.get("theme", ""))


def case_at(asked: Asked, overrides: Overrides, outputs: list[str]) -> Case:
    """The case at a point with its answer, no more of it calculated than these outputs need."""
    body = body_of(asked.calculation.request, pairs_at(asked, overrides))
    return solved(asked.calculation, pairs_of(lightened(body, outputs)), None)
