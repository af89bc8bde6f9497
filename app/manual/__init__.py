"""The theory manual: chapters in Markdown beside this file.

`equations` finds the numbered equations and the functions that implement the equations. `results` finds the equation or
the section that explains a result. `fields` makes the table of all fields. `app.pages.manual` writes the pages of the
chapters.
"""

import re
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable

FIELDS = "fields"
"""Name of the chapter below which its page shows the table of all fields."""

NAMES = (
    "first-pair",
    "coupling",
    "pumping",
    "load-distribution",
    "line-contact",
    "scuffing",
    "standard",
    "micropitting",
    "drive-train",
    "double-helical",
    "heat-balance",
    "practice",
    "spectrum",
    "service",
    FIELDS,
)
"""The names of the chapters in reading order."""


@dataclass(frozen=True, slots=True)
class Chapter:
    """A chapter. `name` is part of the chapter's address and of its file name; `text` is Markdown."""

    name: str
    text: str

    @property
    def title(self) -> str:
        """The heading of the chapter."""
        return self.text.partition("\n")[0].removeprefix("# ")

    @property
    def lead(self) -> str:
        """The first paragraph of the chapter, without line breaks."""
        return " ".join(self.text.split("\n\n")[1].split())

    @property
    def answers(self) -> list[str]:
        """The questions that the chapter answers."""
        return re.findall(r"^\* (.*)$", self.section("What it answers"), re.MULTILINE)

    def section(self, heading: str) -> str:
        """Return the text below this heading, up to the next heading; empty if the chapter has no such heading."""
        return self.text.partition(f"\n## {heading}\n")[2].partition("\n## ")[0].strip()


@cache
def chapters() -> dict[str, Chapter]:
    """Return the chapters in reading order. The keys are the names of the chapters."""
    return {name: Chapter(name, file_of(name).read_text("utf-8")) for name in NAMES}


def file_of(name: str) -> Traversable:
    """Return the file of a chapter: that of a model in the folder of the model, any other one beside this module."""
    own = files("app.models") / name.replace("-", "_") / "chapter.md"
    return own if own.is_file() else files("app.manual") / f"{name}.md"
