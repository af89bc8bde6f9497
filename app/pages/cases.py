"""A case: its query, the addresses of its views, and its answer.

The service keeps the answer. It can therefore make the figures, the report and the downloads of the case without
solving the case again.
"""

import pickle
import re
import zlib
from dataclasses import dataclass, field
from hashlib import sha256
from typing import Any, NamedTuple, get_args

from app.calculations import BY_PATH, Calculation
from app.errors import InvalidBody, Unprocessable, Unreadable
from app.evaluate import response_to, solve
from app.figures.data import ThemeName
from app.pages.query import (
    LONGEST_QUERY,
    Pairs,
    body_of,
    link,
    normalised,
    pairs_of,
    pairs_of_query,
    split_views,
    written_of,
)
from app.schema.fields import Branch, leaf_at, leaves, tree
from app.schema.model import Request
from app.schema.reading import content_of, validated
from app.sources import SHORT_SOURCES, changes_since
from solvers.quantity import Detail

NAME = r"[a-z]\w*(?:[._]\w+)+"  # name of a field: words joined by points and underscores
CARRIED_NAMES = ("rexs_file", "rexs_sha256", "rexs_stage", "typical", "pair")
"""Query fields that go with a case to all its pages: its REXS file, its typical shafts, and inputs of other pages."""
COMPRESSION = 1  # the fastest level of zlib
REFUSED = (Unreadable, InvalidBody, Unprocessable)


@dataclass(frozen=True, slots=True)
class Asked:
    """A requested case, and the addresses of the pages and files that show the case.

    The case may be compared with a variant, that is, with another case of the same calculation. `kept` and `kept_ref`
    are the kept answers of the case and of the variant. None stands for an answer that is not kept. `root` is the
    prefix that a proxy puts before the addresses of the service. `pressed` is True if the user sent the form, even if
    no field was filled in.

    An address that people may store contains a hash of the solvers' source code. If the present source code has another
    hash, the page tells the reader that the numbers may have changed.

    A case that is too long for a link is sent by POST. The addresses of its figures contain the field `answered`, which
    holds two hashes: the hash of the case and the hash of the variant. Such an address works as long as the service
    keeps both answers.
    """

    path: str
    pairs: Pairs
    views: dict[str, str] = field(default_factory=dict)
    kept: bytes | None = None
    kept_ref: bytes | None = None
    root: str = ""
    answered: tuple[str, str] = ("", "")
    pressed: bool = False

    @property
    def calculation(self) -> Calculation:
        """The calculation to which the case belongs."""
        return BY_PATH[f"/v1{self.path}"]

    @property
    def body(self) -> dict[str, Any]:
        """The request body made from the fields. Raises Unreadable if the names of fields contradict each other."""
        return body_of(self.calculation.request, self.pairs)

    @property
    def case(self) -> dict[str, Any]:
        """The validated request with its defaults.

        If the request is not valid, the value is the unchecked request body. If the names of fields contradict each
        other, the value is empty.
        """
        try:
            return validated(self.calculation.request, self.body).model_dump()
        except InvalidBody:
            return self.body
        except Unreadable:
            return {}

    @property
    def theme(self) -> ThemeName | None:
        """The requested theme. A page without a requested theme follows the settings of the reader's system."""
        return next((theme for theme in get_args(ThemeName) if theme == self.views.get("theme")), None)

    @property
    def title(self) -> str:
        """The title that the author gave to the case."""
        return self.views.get("title", "")

    @property
    def ref(self) -> str:
        """The query string of the variant with which the case is compared; empty if there is no variant."""
        return self.views.get("ref", "")

    @property
    def ref_pairs(self) -> Pairs:
        """The fields of the variant with which the case is compared."""
        return split_views(normalised(self.calculation.request, pairs_of_query(self.ref)))[0]

    @property
    def outdated(self) -> list[str]:
        """The changes to the solvers since the link was made."""
        return changes_since(self.views.get("sources", ""))

    @property
    def query(self) -> str:
        """The query string of the case, without the fields that only affect how the case is shown."""
        return link("", self.pairs).removeprefix("?")

    @property
    def written(self) -> str:
        """The value of the form's hidden field `written`.

        The server fills in the form with texts. Some of these texts would be read differently if a user had typed them.
        The hidden field lists these texts, so that the server can tell them from typed texts when the form is sent.
        """
        return written_of(self.calculation.request, self.pairs)

    @property
    def too_long(self) -> bool:
        """Whether a link cannot hold the case."""
        return len(self.query) + len(self.ref) + len(self.views.get("also", "")) > LONGEST_QUERY

    @property
    def page(self) -> str:
        """The address of the page of the case. The page also shows the variant, if there is one."""
        return self.beside(self.ref)

    def beside(self, ref: str) -> str:
        """Return the address of the page that compares the case with the case in the query `ref`."""
        also = self.views.get("also") if ref else None
        views = {"ref": ref, "also": also, "theme": self.theme, "title": self.title}
        return link(self.path, self.pairs, **views, **self.carried, sources=SHORT_SOURCES)

    def view(self, name: str, **views: str | None) -> str:
        """Return the address of a page or a file of the case; `name` is the end of the path."""
        return link(f"{self.path}/{name}", self.pairs, **views)

    @property
    def carried(self) -> dict[str, str | None]:
        """The query fields that go with the case to all its pages."""
        return {name: self.views.get(name) for name in CARRIED_NAMES}

    @property
    def report(self) -> str:
        """The address of the report of the case. The report also shows all variants."""
        return self.reported()

    def reported(self, **views: str | None) -> str:
        """Return the address of the report of the case, for example with another extent."""
        also = self.views.get("also") if self.ref else None
        own = {"ref": self.ref, "also": also, "title": self.title}
        return self.view("report", **own, **self.carried, **views, sources=SHORT_SOURCES)

    def study(self, name: str) -> str:
        """Return the address of the page of a study of the case."""
        return self.view(name, theme=self.theme, title=self.title, **self.carried)

    def image(self, figure: str, image_format: str, theme: ThemeName | None = None, *, narrow: bool = False) -> str:
        """Return the address of a figure's file; a narrow figure suits a phone."""
        name, theme = f"figures/{figure}.{image_format}", theme or self.theme
        looks = {"theme": theme, "narrow": "on" if narrow else None}
        if self.too_long:
            case, ref_case = self.answered
            return link(f"{self.path}/{name}", [], case=case, ref_case=ref_case, **looks)
        return self.view(name, ref=self.ref, **looks)


def opened(content: bytes, root: str) -> Asked:
    """Return the case that a file contains; raise Unreadable if the file does not contain a case."""
    try:
        case = content_of(content)
        endpoint, title = str(case["endpoint"]), str(case.get("title", ""))
        pairs = pairs_of_query(link("", pairs_of(dict(case["request"]))).removeprefix("?"))  # the texts of a form
    except (InvalidBody, Unreadable, AttributeError, KeyError, RecursionError, TypeError, ValueError):
        raise Unreadable(
            "The file does not contain a case. A case is a JSON object with an endpoint and a request"
        ) from None
    if endpoint not in BY_PATH:
        raise Unreadable("The file contains a case of a calculation that this service does not have")
    return Asked(endpoint.removeprefix("/v1"), pairs, {"title": title} if title else {}, root=root)


def key_of(path: str, pairs: Pairs) -> str:
    """Return the key under which the answer of a case is kept."""
    return sha256(repr((path, sorted(pairs))).encode()).hexdigest()


class FormFault(NamedTuple):
    """A fault in a request: the dotted path of the field, and the message about the fault."""

    path: str
    message: str


@dataclass(frozen=True, slots=True)
class SolvedCase:
    """A request and its answer; `kept` holds the request and the solver's result, pickled and compressed."""

    calculation: Calculation
    request: Request
    response: Any
    kept: bytes


def solved(calculation: Calculation, pairs: Pairs, kept: bytes | None, detail: Detail = "fields") -> SolvedCase:
    """Return the case with its answer. By default the answer has all fields that the figures of the case need.

    If `kept` is given, request and result are read from `kept`, and `pairs` is ignored.

    Raises Unreadable if names of fields are malformed or contradict each other. Raises InvalidBody if the request is
    invalid. Raises Unprocessable if the solver refuses the inputs.
    """
    if kept is None:
        body = body_of(calculation.request, pairs)
        _fill(tree(calculation.request), body)
        request = validated(calculation.request, body)
        result = solve(calculation, request)
        kept = zlib.compress(pickle.dumps((request, result)), COMPRESSION)
    else:
        request, result = pickle.loads(zlib.decompress(kept))  # noqa: S301  our own
    request = request.model_copy(update={"detail": detail})
    return SolvedCase(calculation, request, response_to(calculation, request, result), kept)


def faults_of(error: Exception, calculation: Calculation) -> list[FormFault]:
    """Return the faults for which a case was refused. The messages name each field by its title."""
    match error:
        case InvalidBody():
            dotted = ((fault.pointer.removeprefix("/").replace("/", "."), fault.message) for fault in error.faults)
            messages = [(path.replace("~1", "/").replace("~0", "~"), message) for path, message in dotted]
        case Unprocessable():
            messages = [(error.path or "", error.message)]
        case _:
            messages = [("", str(error))]
    return [FormFault(path, _titled(message, path, calculation)) for path, message in messages]


def _titled(message: str, path: str, calculation: Calculation) -> str:
    """Replace the names of fields in a message by the titles of these fields."""
    section, _, own = path.rpartition(".")
    models = (calculation.request, calculation.response)

    def title(name: re.Match[str]) -> str:
        exact = (leaf_at(model, sibling) for sibling in (f"{section}.{name[0]}", name[0]) for model in models)
        alike = (leaf for model in models for leaf in leaves(model) if leaf.path.endswith(f".{name[0]}"))
        leaf = next(filter(None, exact), None) or next(alike if "." not in name[0] else iter(()), None)
        return leaf.title if leaf else name[0]

    return re.sub(rf"^{re.escape(own)}(?= )|{NAME}", title, message)


def _fill(branch: Branch, body: dict[str, Any]) -> None:
    """Add an empty section to the body for each required section that is missing.

    Validation then reports each missing field, and not the missing section. Only fields are visible to users on the
    page.
    """
    for inner in branch.branches:
        name = inner.path.rpartition(".")[2]
        if inner.required and not inner.optional and not inner.repeated:
            body.setdefault(name, {})
        if isinstance(body.get(name), dict):
            _fill(inner, body[name])
