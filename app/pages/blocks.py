"""What a form is made of: the parts that the template sets."""

from dataclasses import dataclass

from app.pages.fields import FieldView


@dataclass(frozen=True, slots=True)
class Single:
    """A field on a line of its own."""

    field: FieldView
    kind: str = "field"


@dataclass(frozen=True, slots=True)
class Choice:
    """Fields of which one is given; `picked` is the one that counts."""

    name: str
    legend: str
    fields: tuple[FieldView, ...]
    picked: str
    kind: str = "choice"


@dataclass(frozen=True, slots=True)
class Twins:
    """Sections of one kind side by side: a line a field, a column a section."""

    columns: tuple[str, ...]
    rows: tuple[tuple[FieldView, ...], ...]
    faults: tuple[str, ...]
    anchors: tuple[str, ...]
    kind: str = "twins"


@dataclass(frozen=True, slots=True)
class Section:
    """A part of the form; `switch` is the field that says that an optional section is there."""

    id: str
    path: str
    title: str
    description: str
    open: bool
    given: int
    assumed: int
    fault: str | None
    blocks: tuple["Block", ...]
    switch: FieldView | None = None
    needed: bool = False
    advanced: bool = False
    kind: str = "section"


@dataclass(frozen=True, slots=True)
class Rows:
    """A list of sections; the last one is empty, to be filled."""

    id: str
    path: str
    title: str
    fault: str | None
    items: tuple[Section, ...]
    kind: str = "rows"


Block = Single | Choice | Twins | Section | Rows
