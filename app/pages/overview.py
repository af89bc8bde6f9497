"""Pages that belong to no case: the start, the models, and what went wrong."""

from functools import lru_cache
from typing import Any

from app.calculations import Calculation
from app.manual.chapters import chapters
from app.pages.links import example_link, examples_of
from app.pages.query import link, pairs_of
from app.pages.study_links import studies_of
from app.pages.templating import by_model, model_of, page_path, rendered

ANSWERS = {"drive-train": "face-load", "coupling": "tooth-loads", "pumping": "mach-map", "scuffing": "flank-load"}
"""The figure that answers the question of each model on the start page."""


@lru_cache(maxsize=4)
def start_page(root: str) -> str:
    """A question of each model with the picture that answers it, and all that can be calculated."""
    return rendered("start.html", root, models={name: _entry(some) for name, some in by_model().items()})


def _entry(calculations: list[Calculation]) -> dict[str, Any]:
    """What the start page shows of a model: a question of its first calculation, then every calculation."""
    first = calculations[0]
    known = examples_of(first)
    example = next((each for each in known if each.title.endswith("?")), known[0])
    shown = next(each for each in first.figures if each.name == ANSWERS[model_of(first)])
    pairs = pairs_of(example.request)
    place = f"{page_path(first)}/figures/{shown.name}.svg"
    return {
        "chapter": chapters()[model_of(first)],
        "question": example.title,
        "address": example_link(first, example),
        "figure": shown.title,
        "image": link(place, pairs),
        "dark": link(place, pairs, theme="dark"),
        "calculations": [
            (each, page_path(each), [(one.title, example_link(each, one)) for one in examples_of(each)[:2]])
            for each in calculations
        ],
        "studies": [study for each in calculations for study in studies_of(each)[:1]],
    }


def problem_page(root: str, status: int, title: str, detail: str) -> str:
    """Something that is no page."""
    return rendered("problem.html", root, status=status, title=title, detail=detail)
