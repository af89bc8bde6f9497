"""The kinds of study that there are: one module of `app.studies.kinds` each, known by its `PAGE`.

They are looked up when they are asked for, not imported: pages link to studies, and the pages of studies are made of
parts of other pages.
"""

import pkgutil
from functools import cache
from importlib import import_module
from typing import Any, NamedTuple

from app.studies import kinds as package


class StudyLink(NamedTuple):
    """The last part of the address of a study's page, the label of the link to it, a description, and its place.

    `endpoint` is the only one whose cases have the study; None where all have it.
    """

    name: str
    label: str
    hint: str
    place: int
    endpoint: str | None = None


@cache
def study_pages() -> tuple[type[Any], ...]:
    """The `PAGE` of every kind of study, a `StudyPage`, in the order of their links."""
    modules = (import_module(f"{package.__name__}.{each.name}") for each in pkgutil.iter_modules(package.__path__))
    return tuple(sorted((module.PAGE for module in modules), key=lambda page: page.link.place))


def study_page(name: str) -> type[Any]:
    """The page of the kind of study that has this name in addresses."""
    return next(page for page in study_pages() if page.link.name == name)


@cache
def control_names() -> frozenset[str]:
    """The names in a query that are controls of some study, not fields of a case."""
    return frozenset().union({"show"}, *(page.names for page in study_pages()))
