"""A case as a JSON file: its title, its endpoint and its request, as the examples are stored."""

import json
from pathlib import PurePath

from app.calculations import BY_PATH
from app.errors import InvalidBody, Unreadable
from app.evaluate import content_of
from app.pages.query import Pairs, link, pairs_of, pairs_of_query
from app.pages.templating import page_path
from app.pages.views import Asked


def saved(asked: Asked) -> bytes:
    """The file of a case as it was typed, complete or not."""
    content = {"title": asked.title, "endpoint": asked.calculation.path, "request": asked.body}
    return json.dumps(content, indent=1, ensure_ascii=False).encode()


def file_name(asked: Asked) -> str:
    """What the file is called: the letters, digits, blanks and hyphens of the title."""
    kept = "".join(each for each in asked.title if each.isalnum() or each in " -").strip()
    return f"{kept or PurePath(asked.path).name}.json"


def opened(content: bytes, root: str) -> Asked:
    """The case that a file holds; raises Unreadable where it holds none."""
    try:
        case = content_of(content)
        endpoint, request = str(case["endpoint"]), dict(case["request"])
        title, pairs = str(case.get("title", "")), _as_sent(request)
    except (InvalidBody, Unreadable, AttributeError, KeyError, RecursionError, TypeError, ValueError):
        raise Unreadable("The file holds no case: JSON with an endpoint and a request") from None
    if endpoint not in BY_PATH:
        raise Unreadable(f"The endpoint of the case is none of {', '.join(BY_PATH)}")
    return Asked(page_path(BY_PATH[endpoint]), pairs, {"title": title} if title else {}, root=root)


def _as_sent(request: dict[str, object]) -> Pairs:
    """The fields of a request as the form sends them."""
    return pairs_of_query(link("", pairs_of(request)).removeprefix("?"))
