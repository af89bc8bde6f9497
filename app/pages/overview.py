"""Pages that belong to no case: the start, the models, and what went wrong."""

from functools import lru_cache

from app.calculations import CALCULATIONS, Calculation
from app.examples import Example
from app.pages.about import ABOUT
from app.pages.links import example_link, examples_of
from app.pages.studies.sweep_examples import studies_of
from app.pages.templating import model_of, page_path, rendered
from solvers.published import STATEMENTS, Row


@lru_cache(maxsize=4)
def start_page(root: str) -> str:
    """What the models answer, a starter for each calculation."""
    models: dict[str, list[tuple[Calculation, str, list[tuple[Example, str]]]]] = {}
    for calculation in CALCULATIONS:
        examples = [(example, example_link(calculation, example)) for example in examples_of(calculation)]
        models.setdefault(model_of(calculation), []).append((calculation, page_path(calculation), examples))
    return rendered("start.html", root, models=models, about=ABOUT, studies_of=studies_of)


def rows_of(model: str) -> list[Row]:
    """What the sources print beside what is computed now; seconds, in a worker."""
    return [statement.row() for statement in STATEMENTS.get(model, ())]


def about_page(root: str, model: str, rows: list[Row]) -> str:
    """A model's equations, misprints, limits and comparison with print."""
    pages = [(page_path(each), each.title) for each in CALCULATIONS if model_of(each) == model]
    return rendered("about.html", root, model=model, about=ABOUT[model], rows=rows, pages=pages)


def problem_page(root: str, status: int, title: str, detail: str) -> str:
    """Something that is no page."""
    return rendered("problem.html", root, status=status, title=title, detail=detail)
