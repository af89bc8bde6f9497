"""The addresses of the views of a case, and the examples to start from.

Addresses that are kept name the solvers' sources, so that a later reader is told whether numbers may differ.
"""

from dataclasses import dataclass

from app.calculations import Calculation
from app.examples import Example, examples
from app.pages.query import Pairs, link, pairs_of
from app.pages.templating import page_path
from app.sources import SHORT_SOURCES

LONGEST_QUERY = 6000  # characters: common proxies refuse a request line beyond 8 KiB
IMAGE_FORMATS = ("svg", "png", "pdf", "csv")


@dataclass(frozen=True, slots=True)
class Links:
    """Where each view of a case is.

    A case too long for a link has to be posted; its figures are addressed by `case`, the hash in its answer, and by
    `ref_case`, that of the variant, while both answers are kept.
    """

    path: str
    pairs: Pairs
    ref: str
    theme: str
    case: str = ""
    ref_case: str = ""
    title: str = ""

    @property
    def query(self) -> str:
        """The case alone."""
        return link("", self.pairs).removeprefix("?")

    @property
    def too_long(self) -> bool:
        """Whether a link cannot hold the case."""
        return len(self.query) + len(self.ref) > LONGEST_QUERY

    @property
    def page(self) -> str:
        """The page of the case, beside the case that it is compared with."""
        return link(self.path, self.pairs, ref=self.ref, theme=self.theme, title=self.title, sources=SHORT_SOURCES)

    @property
    def alone(self) -> str:
        """The case without comparison."""
        return link(self.path, self.pairs, theme=self.theme, title=self.title, sources=SHORT_SOURCES)

    @property
    def pinned(self) -> str:
        """The case compared with itself, to be changed."""
        return link(self.path, self.pairs, ref=self.query, theme=self.theme, title=self.title, sources=SHORT_SOURCES)

    def view(self, name: str, **views: str) -> str:
        """One view."""
        return link(f"{self.path}/{name}", self.pairs, **views)

    @property
    def report(self) -> str:
        """The report of the case, beside the case that it is compared with."""
        return self.view("report", ref=self.ref, title=self.title, sources=SHORT_SOURCES)

    @property
    def file(self) -> str:
        """The case as a file to be opened again."""
        return self.view("case.json", title=self.title)

    def study(self, name: str) -> str:
        """A study of the case that has a page of its own."""
        return self.view(name, theme=self.theme, title=self.title)

    def image(self, figure: str, image_format: str, theme: str = "") -> str:
        """One figure as a file."""
        name, theme = f"figures/{figure}.{image_format}", theme or self.theme
        if self.too_long:
            return link(f"{self.path}/{name}", [], case=self.case, ref_case=self.ref_case, theme=theme)
        return self.view(name, ref=self.ref, theme=theme)


def examples_of(calculation: Calculation) -> list[Example]:
    """The examples of a calculation, starters first."""
    return [example for example in examples().values() if example.endpoint == calculation.path]


def example_link(calculation: Calculation, example: Example) -> str:
    """The page of an example."""
    return link(page_path(calculation), pairs_of(example.request))
