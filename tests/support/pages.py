"""The page of an example."""

from app.calculations import BY_PATH
from app.examples import examples
from app.pages.query import pairs_of
from app.pages.templating import page_path
from app.pages.views import Asked


def asked(name: str, **said: str) -> Asked:
    """The page of an example; `said` is what its query says beside the case."""
    example = examples()[name]
    return Asked(page_path(BY_PATH[example.endpoint]), pairs_of(example.request), said)
