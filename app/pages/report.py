"""What a report says beside the result: names, date, every input with where it comes from, how to repeat it."""

import json
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

from markupsafe import Markup

from app.contract.fields import leaf_at
from app.pages.about import about_of
from app.pages.cases import Case
from app.pages.results import flattened
from app.pages.typesetting import shown, symbol

NAMES = ("project", "part", "author", "checker", "notes")
LONGEST_TEXT = 200
PAPERS = {"a4": "A4", "letter": "letter"}


@dataclass(frozen=True, slots=True)
class Input:
    """An input: `origin` is given, assumed or default."""

    label: str
    symbol: Markup
    value: str
    unit: str
    origin: str


def context(case: Case, views: dict[str, str], address: str, link: str) -> dict[str, Any]:
    """What the template needs beside the result."""
    request = {name: value for name, value in case.request.model_dump(exclude_unset=True).items() if name != "detail"}
    body = json.dumps(request)
    return {
        "names": {name: views.get(name, "")[:LONGEST_TEXT] for name in NAMES},
        "paper": PAPERS.get(views.get("paper", ""), "A4"),
        "date": datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"),
        "inputs": _inputs(case),
        "body": body.replace("'", "\\u0027"),
        "address": address,
        "link": link,
        "about": about_of(case.calculation),
    }


def _inputs(case: Case) -> dict[str, list[Input]]:
    """Every input by section, in the order of the schema."""
    given = set(flattened(case.request.model_dump(exclude_unset=True)))
    assumed = {each.field for each in case.response.assumptions}
    sections: dict[str, list[Input]] = {}
    for path, value in flattened(case.response.inputs).items():
        leaf = leaf_at(type(case.request), path)
        if leaf is None or (value is None and leaf.exclusive):
            continue
        origin = "given" if path in given else "assumed" if path in assumed else "default"
        text = shown(value, 6) if not isinstance(value, list) else ", ".join(shown(item, 6) for item in value)
        if value is None and leaf.default_text:
            text = leaf.default_text
        section = path.rpartition(".")[0].replace(".", " · ").replace("_", " ") or "general"
        unit = leaf.unit or "" if value is not None else ""
        title = leaf.title.partition(",")[0]
        sections.setdefault(section, []).append(Input(title, symbol(leaf.symbol), text, unit, origin))
    return sections
