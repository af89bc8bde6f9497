"""The card of a model: all that `app` knows about it. `app.calculations` lists the cards."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from app.figures.declaration import Declaration
from app.models.kernels import Kernels
from app.schema.answers import Response
from app.schema.model import Request

NEAR_LIMIT = 0.8  # a value above this share of an upper limit is close to the limit


class Verdict(NamedTuple):
    """The level of a number (good, near, bad or plain), and the reason for this level in words."""

    level: str
    text: str


class ScuffingPaths(NamedTuple):
    """Dotted paths of the contact temperature and the scuffing temperature in an answer."""

    contact: str
    limit: str


class Beside(NamedTuple):
    """Values of several methods side by side: title, names of the methods, rows, and the sentence why they differ.

    A row is its label and one path for each method; empty where a method has no such value. The table is shown where
    the section `asked` of the answer is not null, and the section `unless` is not there. The note of the code `lacking`
    says why a method has no values.
    """

    title: str
    methods: tuple[str, ...]
    rows: tuple[tuple[str, tuple[str, ...]], ...]
    why: str
    asked: str
    unless: str
    lacking: str


class FileResult(NamedTuple):
    """A result that is written into a REXS file: its path, the name of the attribute there, and the unit there."""

    path: str
    attribute: str
    unit: str


@dataclass(frozen=True, slots=True)
class FromFile:
    """What a request takes from the draft that was read from a REXS file.

    `sections` are the sections of the draft that the request has, without the fields in `unknown`; None: all sections.
    `renamed` maps paths and sections of the draft to those of the request.
    """

    sections: frozenset[str] | None = None
    unknown: frozenset[str] = frozenset()
    renamed: Mapping[str, str] = field(default_factory=dict)

    def path(self, drafted: str) -> str | None:
        """Return the path of a field of the draft in the request; None if the request does not have the field."""
        if drafted in self.renamed:
            return self.renamed[drafted]
        section = drafted.partition(".")[0]
        if section in self.renamed:
            return drafted.replace(section, self.renamed[section], 1)
        known = self.sections is None or section in self.sections
        return drafted if known and drafted not in self.unknown else None


@dataclass(frozen=True, slots=True)
class Words:
    """What pages, studies and files say of an endpoint's answers. Paths are dotted paths of the answer.

    verdict        judges the answer as a whole: the first sentence that a reader sees
    verdicts       judges headline numbers and tiles that need more than a limit, by path
    conclusion     what else the answer says, one statement a line
    tiles          further numbers that stand beside the headline numbers, by path
    touches        the headline numbers and tiles that a warning concerns, by the warning's code; all of them for a
                   code that is missing here
    names          codes of warnings that the verdict itself names
    belongs        what headline numbers belong to, by path, such as the helix that decides
    remarks        how well results are known, by path
    hands_on       results that become inputs of other calculations: by endpoint, the path there and that of the answer
    losses         powers that a load spectrum averages
    scuffing       the temperatures that a load spectrum compares unless it names limits
    of_the_film    outputs that need the thermal film (`*` for an index), beside those with `thermal_ehl` in their path;
                   None: no film
    from_file      what a request takes from a REXS file; None: files make no such request
    to_file        results that go back into a REXS file
    chapters       the chapters of the manual about optional sections, by section
    beside         values of several methods that stand side by side
    """

    verdict: Callable[[Any], Verdict] = lambda _: Verdict("plain", "")
    verdicts: Callable[[Any], dict[str, Verdict]] = lambda _: {}
    tiles: tuple[str, ...] = ()
    touches: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    names: frozenset[str] = frozenset()
    conclusion: Callable[[Any], str] = lambda _: ""
    belongs: Callable[[Any], dict[str, str]] = lambda _: {}
    remarks: Callable[[Any], dict[str, str]] = lambda _: {}
    hands_on: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    losses: tuple[str, ...] = ()
    scuffing: ScuffingPaths | None = None
    of_the_film: frozenset[str] | None = None
    from_file: FromFile | None = None
    to_file: tuple[FileResult, ...] = ()
    chapters: Mapping[str, str] = field(default_factory=dict)
    beside: tuple[Beside, ...] = ()


class Cost(NamedTuple):
    """Estimated time of a calculation on one core [s], and the request field on which this time depends."""

    seconds: float
    field: str


class Pump(NamedTuple):
    """The oil pump that a calculation sizes: the request's fields of flow and rise, and how the flow is sized.

    `sized` returns the flow for the solver's inputs [m^3/s], None if it sizes none.
    """

    flow: str
    rise: str
    sized: Callable[[Any], float | None]


@dataclass(frozen=True, slots=True, eq=False)
class Calculation:
    """One endpoint of a model, with its solver, its figures and its words.

    `cost` estimates the time of a request; it is None if no permissible request takes too long.
    """

    path: str
    title: str
    summary: str
    source: str
    request: type[Request]
    solve: Callable[[Any], Any]
    response: type[Response]
    kernels: Kernels = field(default_factory=Kernels)
    figures: tuple[Declaration, ...] = ()
    words: Words = Words()
    cost: Callable[[Any], Cost] | None = None
    pump: Pump | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Card:
    """A model: the name of its chapter, its endpoints, and what the start page shows.

    `subject` is what its pages hand to those of other models: a gear "pair", a "coupling", or nothing.
    `start_figure` is the figure of the first endpoint on the start page; empty: none.
    """

    name: str
    endpoints: tuple[Calculation, ...]
    subject: str = ""
    start_figure: str = ""
