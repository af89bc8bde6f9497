"""The API, the manual and the examples use the terms of ISO 1122-1, ISO 1328-1, ISO 6336-1 and ISO 21771."""

import json
import re

import pytest

from app.examples import examples
from app.main import app
from tests.support.server import ROOT

TERMS = {
    "addendum modification": "profile shift",
    "allowable": "permissible",
    "center distance": "centre distance",
    "contact path": "path of contact",
    "film parameter": "specific film thickness",
    "friction coefficient": "coefficient of friction",
    "from memory": "quoted, not verified against the standard",
    "hertz pressure": "Hertzian pressure",
    "lead crowning": "helix crowning",
    "overlap factor": "overlap ratio",
    "pitch error": "pitch deviation",
    "safety against": "safety factor against",
    "sliding ratio": "slide-roll ratio",
}


@pytest.fixture(scope="module")
def texts() -> list[str]:
    """Return the texts of the API, the titles of the examples, and the chapters of the manual."""
    chapters = [chapter.read_text("utf-8") for chapter in (ROOT / "app" / "manual").glob("*.md")]
    return [json.dumps(app.openapi()), *(example.title for example in examples().values()), *chapters]


@pytest.mark.parametrize("other", TERMS)
def test_the_standard_term_is_used(texts: list[str], other: str) -> None:
    """The test ignores the names of fields and functions, such as `allowable_misalignment`."""
    written = re.compile(rf"\b{other}(?!_)", re.IGNORECASE)
    found = [text[max(place.start() - 60, 0) : place.end() + 30] for text in texts for place in written.finditer(text)]
    assert not found, TERMS[other]
