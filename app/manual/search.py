"""The search over the sections of the manual."""

import re
from functools import cache
from typing import NamedTuple

from app.manual import chapters

_MARKUP = (
    (re.compile(r"<!--.*?-->|<a id=.*?</a>|^\|[-| ]+\|$", re.MULTILINE | re.DOTALL), " "),
    (re.compile(r"^Code: .*?(?:\n\n|\Z)", re.MULTILINE | re.DOTALL), " "),
    (re.compile(r"!?\[([^\]]*)\]\([^)]*\)"), r"\1"),
    (re.compile(r"\$\$.*?\\tag\{([^}]+)\}\s*\$\$", re.DOTALL), r" (\1) "),
    (re.compile(r"\$\$.*?\$\$", re.DOTALL), " "),
    (re.compile(r"```\w*|[`|*#]|>>>"), " "),
)
_FORMULA = re.compile(r"\$[^$]*\$")
_BEFORE, _AFTER = 60, 140  # characters of a section shown around the first word found


class Section(NamedTuple):
    """A section of a chapter; `place` is its position among the chapter's headings, -1 before the first."""

    chapter: str
    title: str
    place: int
    text: str


class Found(NamedTuple):
    """A section that has every word of a search, and the text around the first of them."""

    section: Section
    around: str


@cache
def sections() -> tuple[Section, ...]:
    """All sections of the manual in reading order, as plain text."""
    found = []
    for chapter in chapters().values():
        for place, part in enumerate(chapter.text.split("\n## "), -1):
            title, _, text = part.partition("\n")
            for pattern, plain in _MARKUP:
                text = pattern.sub(plain, text)
            found.append(Section(chapter.name, title.removeprefix("# "), place, " ".join(text.split())))
    return tuple(found)


def search(words: str) -> list[Found]:
    """Sections that have every word, those with words in their title first."""
    wanted = words.casefold().split()
    found = []
    for section in sections():
        title, text = section.title.casefold(), section.text.casefold()
        if wanted and all(word in title or word in text for word in wanted):
            rank = -sum(word in title for word in wanted)
            found.append(
                (rank, -sum(text.count(word) for word in wanted), Found(section, _around(section.text, wanted)))
            )
    return [each for *_, each in sorted(found, key=lambda each: each[:2])]


def _around(text: str, wanted: list[str]) -> str:
    shown = _FORMULA.sub("…", text)
    first = min((place for word in wanted if (place := shown.casefold().find(word)) >= 0), default=0)
    start = max(first - _BEFORE, 0)
    cut = shown[start : first + _AFTER]
    return f"{'…' if start else ''}{cut}{'…' if first + _AFTER < len(shown) else ''}"
