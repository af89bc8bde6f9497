"""The kinds of study. Each module of `app.studies.kinds` describes one kind; `PAGE` in the module is the page class.

The modules are imported when `study_pages` is called for the first time. An import at the top of this file would be
circular: all pages have links to studies, and the pages of studies consist of parts of other pages.
"""

import pkgutil
from functools import cache
from importlib import import_module
from typing import Any, NamedTuple

from app.studies import kinds as package


class StudyLink(NamedTuple):
    """A link to the page of a kind of study.

    `name` is the last part of the address, `label` is the text of the link, `hint` is the description of the study, and
    `place` is the position among the links. `endpoint` is the only endpoint whose cases have this study. If `endpoint`
    is None, the cases of all endpoints have this study.
    """

    name: str
    label: str
    hint: str
    place: int
    endpoint: str | None = None


@cache
def study_pages() -> tuple[type[Any], ...]:
    """Return the page classes of all kinds of study, in the order in which pages show the links to the studies.

    A page class is a subclass of `StudyPage`.
    """
    modules = (import_module(f"{package.__name__}.{module.name}") for module in pkgutil.iter_modules(package.__path__))
    return tuple(sorted((module.PAGE for module in modules), key=lambda page: page.link.place))


def study_page(name: str) -> type[Any]:
    """Return the page class of a kind of study; `name` is the last part of the address of its page."""
    return next(page for page in study_pages() if page.link.name == name)


@cache
def control_names() -> frozenset[str]:
    """Return the names of all controls of studies. In a query, these names do not belong to fields of a case."""
    return frozenset().union({"show"}, *(page.names for page in study_pages()))
