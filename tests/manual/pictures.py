"""Functions that find the pictures in the Markdown of the manual's chapters."""

import re

from app.manual import Chapter


def figures_of(chapter: Chapter) -> list[tuple[str, str]]:
    """Return the example and the figure of every picture. The name of the picture's file consists of both names."""
    return re.findall(r"\]\([./\w]*figures/([\w-]+)\.([\w-]+)\.png\)", chapter.text)


def studies_of(chapter: Chapter) -> list[str]:
    """Return the names of all pictures of studies. `studies.json` of a model describes them."""
    return re.findall(r"\]\([./\w]*studies/([\w-]+)\.png\)", chapter.text)
