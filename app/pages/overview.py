"""Pages that belong to no case: the start, the models, and what went wrong."""

from functools import lru_cache

from app.calculations import CALCULATIONS, Calculation
from app.examples import Example
from app.manual.chapters import chapters
from app.pages.links import example_link, examples_of
from app.pages.studies.sweep_examples import studies_of
from app.pages.templating import model_of, page_path, rendered


@lru_cache(maxsize=4)
def start_page(root: str) -> str:
    """What the models answer, a starter for each calculation."""
    models: dict[str, list[tuple[Calculation, str, list[tuple[Example, str]]]]] = {}
    for calculation in CALCULATIONS:
        examples = [(example, example_link(calculation, example)) for example in examples_of(calculation)]
        models.setdefault(model_of(calculation), []).append((calculation, page_path(calculation), examples))
    return rendered("start.html", root, models=models, chapters=chapters(), studies_of=studies_of)


def problem_page(root: str, status: int, title: str, detail: str) -> str:
    """Something that is no page."""
    return rendered("problem.html", root, status=status, title=title, detail=detail)
