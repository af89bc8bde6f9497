"""What a study with a page of its own is, and what the page shows of it."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from app.figures.data import Figure
from app.pages.form import FieldView
from app.pages.offers import Offer
from app.pages.views import Asked
from app.schema.fields import Leaf
from app.studies.stream import Line
from app.studies.study import Study


class Cell(NamedTuple):
    """A cell of a table: a text, with a link where it leads somewhere; numbers stand right."""

    text: str
    address: str = ""
    right: bool = False


class Table(NamedTuple):
    """A table under its title, and what there is to say of it."""

    title: str
    head: tuple[Cell, ...]
    rows: tuple[tuple[Cell, ...], ...]
    note: str = ""


class Lead(NamedTuple):
    """A link to go on from the result."""

    label: str
    address: str


@dataclass(frozen=True, slots=True)
class Result:
    """What a page shows of a study that came to its end; figures by their names."""

    progress: str
    figures: dict[str, Figure] = field(default_factory=dict)
    tables: tuple[Table, ...] = ()
    remarks: tuple[str, ...] = ()
    leads: tuple[Lead, ...] = ()


@dataclass(frozen=True, slots=True)
class Asking:
    """A study asked for on a page, of one output."""

    page: "StudyPage"
    asked: Asked
    output: Leaf
    study: Study


def no_fields(_said: dict[str, str], _faults: dict[str, str]) -> tuple[FieldView, ...]:
    """A form without fields."""
    return ()


@dataclass(frozen=True, slots=True)
class StudyPage:
    """A study with a page of its own.

    `output` is the path of the one shown when none is chosen, else the first headline. `body` makes what the study's
    endpoint is asked, `plan` checks it; `fields` are what the form has beside the output; `figures` names all it may
    show.
    """

    offer: Offer
    question: str
    about: str
    figures: tuple[str, ...]
    body: Callable[[Asked, Leaf], dict[str, Any]]
    plan: Callable[[bytes, int, float], Study]
    result: Callable[[Asking, list[Line]], Result]
    output: str | None = None
    fields: Callable[[dict[str, str], dict[str, str]], tuple[FieldView, ...]] = no_fields
