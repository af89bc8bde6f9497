"""What tests of pages share: the page of an example, and the lines of a study that a page shows."""

import asyncio
import json
from typing import Any

from app.calculations import BY_PATH
from app.examples import examples
from app.pages.query import pairs_of
from app.pages.studies.page import StudyPage
from app.pages.templating import page_path
from app.pages.views import Asked
from app.studies.engine import Clock
from tests.support.pools import InlinePool


def asked(name: str, **said: str) -> Asked:
    """The page of an example; `said` is what its query says beside the case."""
    example = examples()[name]
    return Asked(page_path(BY_PATH[example.endpoint]), pairs_of(example.request), said)


def lines_of(study: StudyPage) -> list[dict[str, Any]]:
    """Every line of a study, calculated in this process, as a client reads it."""

    async def run() -> list[dict[str, Any]]:
        clock = Clock(study.study.total)
        return [line async for group in study.study.lines(InlinePool(), clock) for line in group]

    found: list[dict[str, Any]] = json.loads(json.dumps(asyncio.run(run())))
    return found
