"""The chapters, in the order in which they are read."""

import re
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

NAMES = (
    "coupling",
    "pumping",
    "load-distribution",
    "line-contact",
    "scuffing",
    "drive-train",
    "practice",
    "spectrum",
    "service",
)

_FIGURE = re.compile(r"\]\(figures/([\w-]+)\.([\w-]+)\.png\)")


@dataclass(frozen=True, slots=True)
class Chapter:
    """A chapter: its name in addresses and file names, and its text in Markdown."""

    name: str
    text: str

    @property
    def title(self) -> str:
        """The first heading."""
        return self.text.partition("\n")[0].removeprefix("# ")

    @property
    def lead(self) -> str:
        """The first paragraph, in one line."""
        return " ".join(self.text.split("\n\n")[1].split())

    @property
    def answers(self) -> list[str]:
        """Which questions it answers."""
        return re.findall(r"^\* (.*)$", self.section("What it answers"), re.MULTILINE)

    def section(self, heading: str) -> str:
        """The text below a heading, without it."""
        return self.text.partition(f"\n## {heading}\n")[2].partition("\n## ")[0].strip()

    @property
    def figures(self) -> list[tuple[str, str]]:
        """Example and figure of every picture; the file is named after both."""
        return _FIGURE.findall(self.text)

    @property
    def studies(self) -> list[str]:
        """The name of every picture of a study; `studies.json` says of which."""
        return re.findall(r"\]\(studies/([\w-]+)\.png\)", self.text)


@cache
def chapters() -> dict[str, Chapter]:
    """Every chapter by name."""
    folder = files("app.manual")
    return {name: Chapter(name, folder.joinpath(f"{name}.md").read_text("utf-8")) for name in NAMES}
