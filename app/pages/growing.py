"""What the pages of all studies share: head and tail around figures that grow between them, the addresses of views."""

from dataclasses import dataclass
from typing import Generic, TypeVar

from app.pages.links import LONGEST_QUERY
from app.pages.query import STUDY_NAMES, link
from app.pages.views import Asked
from app.sources import SHORT_SOURCES

FRAMES = "<!-- the figures -->"
S = TypeVar("S")


@dataclass(frozen=True, slots=True)
class Opened(Generic[S]):
    """A page around its figures; without a study it is whole."""

    head: bytes
    tail: bytes = b""
    status: int = 200
    study: S | None = None


def around(page: str, study: S | None) -> Opened[S]:
    """A page cut where its figures come."""
    head, _, tail = page.partition(FRAMES)
    return Opened(head.encode(), tail.encode(), study=study)


@dataclass(frozen=True, slots=True)
class StudyLinks:
    """The addresses of the views of a study, by the name of its page below that of the case."""

    name: str
    asked: Asked

    def view(self, below: str) -> str:
        """One of them."""
        said = {name: text for name, text in self.asked.views.items() if name in STUDY_NAMES or name == "theme"}
        return link(f"{self.asked.path}/{self.name}{below}", self.asked.pairs, **said, sources=SHORT_SOURCES)

    @property
    def too_long(self) -> bool:
        """Whether a link cannot hold the study."""
        return len(self.view("").partition("?")[2]) > LONGEST_QUERY

    def image(self, figure: str, image_format: str) -> str:
        """One figure as a file."""
        return self.view(f"/figures/{figure}.{image_format}")
