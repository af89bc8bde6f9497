"""The pictures of the manual's chapters, as their Markdown names them."""

import re

from app.manual import Chapter


def figures_of(chapter: Chapter) -> list[tuple[str, str]]:
    """Example and figure of every picture; the file is named after both."""
    return re.findall(r"\]\(figures/([\w-]+)\.([\w-]+)\.png\)", chapter.text)


def studies_of(chapter: Chapter) -> list[str]:
    """The name of every picture of a study; `studies.json` says of which."""
    return re.findall(r"\]\(studies/([\w-]+)\.png\)", chapter.text)
