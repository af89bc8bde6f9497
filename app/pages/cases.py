"""A case from its query to its answer, which is kept: figure, report and download of it need no second solve."""

import pickle
import re
import zlib
from dataclasses import dataclass, field
from hashlib import sha256
from typing import Any, NamedTuple, get_args

from app.calculations import BY_PATH, Calculation
from app.errors import InvalidBody, Unprocessable, Unreadable
from app.evaluate import content_of, response_to, solve
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
from app.schema.reading import validated
from app.sources import SHORT_SOURCES, changes_since
from solvers.quantity import Detail

NAME = r"[a-z]\w*(?:[._]\w+)+"  # of a field: words joined by points and underscores
FILE_NAMES = ("rexs_file", "rexs_sha256", "rexs_stage")  # views that say where a case was read from
COMPRESSION = 1  # the fastest level of zlib
REFUSED = (Unreadable, InvalidBody, Unprocessable)


@dataclass(frozen=True, slots=True)
class Asked:
    """A case to look at, and the addresses of its views.

    Addresses that people keep name the solvers' sources, so that a later reader is told whether numbers may differ.
    `kept` and `kept_ref` are the answers of it and of its variant, if they are still known. `root` is the prefix that
    a proxy puts before the addresses of the service. A case too long for a link has to be posted; its figures are
    addressed by `answered`, the hashes in its answer and in that of the variant, while both answers are kept. `pressed`
    says that the form was sent, if with no field.
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
        """The calculation of the case."""
        return BY_PATH[f"/v1{self.path}"]

    @property
    def body(self) -> dict[str, Any]:
        """The request body made of the fields; raises Unreadable where names contradict each other."""
        return body_of(self.calculation.request, self.pairs)

    @property
    def case(self) -> dict[str, Any]:
        """The request with its defaults; as far as it is given where that is refused, empty where it is unreadable."""
        try:
            return validated(self.calculation.request, self.body).model_dump()
        except InvalidBody:
            return self.body
        except Unreadable:
            return {}

    @property
    def theme(self) -> ThemeName | None:
        """The theme asked for; a page without one follows the reader's system."""
        return next((theme for theme in get_args(ThemeName) if theme == self.views.get("theme")), None)

    @property
    def title(self) -> str:
        """What its author calls the case."""
        return self.views.get("title", "")

    @property
    def ref(self) -> str:
        """The query of the variant to compare with."""
        return self.views.get("ref", "")

    @property
    def ref_pairs(self) -> Pairs:
        """The fields of the variant to compare with."""
        return split_views(normalised(self.calculation.request, pairs_of_query(self.ref)))[0]

    @property
    def outdated(self) -> list[str]:
        """What has changed since the link was made, as far as it names the solvers' sources."""
        return changes_since(self.views.get("sources", ""))

    @property
    def query(self) -> str:
        """The case alone."""
        return link("", self.pairs).removeprefix("?")

    @property
    def written(self) -> str:
        """What a form that is filled with the case says of its texts."""
        return written_of(self.calculation.request, self.pairs)

    @property
    def too_long(self) -> bool:
        """Whether a link cannot hold the case."""
        return len(self.query) + len(self.ref) + len(self.views.get("also", "")) > LONGEST_QUERY

    @property
    def page(self) -> str:
        """The page of the case, beside the case that it is compared with."""
        return self.beside(self.ref)

    def beside(self, ref: str) -> str:
        """The page of the case, compared with the case of another query unless that is empty."""
        also = self.views.get("also") if ref else None
        views = {"ref": ref, "also": also, "pair": self.views.get("pair"), "theme": self.theme, "title": self.title}
        return link(self.path, self.pairs, **views, **self.file, sources=SHORT_SOURCES)

    def view(self, name: str, **views: str | None) -> str:
        """The address of a view of the case."""
        return link(f"{self.path}/{name}", self.pairs, **views)

    @property
    def file(self) -> dict[str, str | None]:
        """The REXS file that the case was read from: its name and SHA-256, and the stage."""
        return {name: self.views.get(name) for name in FILE_NAMES}

    @property
    def report(self) -> str:
        """The address of the report of the case, which shows the compared case too if there is one."""
        return self.view("report", ref=self.ref, title=self.title, **self.file, sources=SHORT_SOURCES)

    def study(self, name: str) -> str:
        """The address of the page of a study of the case."""
        return self.view(name, theme=self.theme, title=self.title, **self.file)

    def image(self, figure: str, image_format: str, theme: ThemeName | None = None) -> str:
        """One figure as a file."""
        name, theme = f"figures/{figure}.{image_format}", theme or self.theme
        if self.too_long:
            case, ref_case = self.answered
            return link(f"{self.path}/{name}", [], case=case, ref_case=ref_case, theme=theme)
        return self.view(name, ref=self.ref, theme=theme)


def opened(content: bytes, root: str) -> Asked:
    """The case that a file holds; raises Unreadable where it holds none."""
    try:
        case = content_of(content)
        endpoint, title = str(case["endpoint"]), str(case.get("title", ""))
        pairs = pairs_of_query(link("", pairs_of(dict(case["request"]))).removeprefix("?"))  # as the form sends them
    except (InvalidBody, Unreadable, AttributeError, KeyError, RecursionError, TypeError, ValueError):
        raise Unreadable(
            "The file does not contain a case. A case is a JSON object with an endpoint and a request"
        ) from None
    if endpoint not in BY_PATH:
        raise Unreadable("The file contains a case of a calculation that this service does not have")
    return Asked(endpoint.removeprefix("/v1"), pairs, {"title": title} if title else {}, root=root)


def key_of(path: str, pairs: Pairs) -> str:
    """The key of an answer: page and fields of its case, whatever their order, or the hash of the answer as `case`."""
    return sha256(repr((path, sorted(pairs))).encode()).hexdigest()


class Fault(NamedTuple):
    """What is wrong with the field at a dotted path."""

    path: str
    message: str


@dataclass(frozen=True, slots=True)
class Case:
    """A request and its answer; `kept` are the request and the solver's result as they are kept."""

    calculation: Calculation
    request: Request
    response: Any
    kept: bytes


def solved(calculation: Calculation, pairs: Pairs, kept: bytes | None, detail: Detail = "fields") -> Case:
    """The case, usually with all that its figures need; the one that is kept if there is one, whatever the fields.

    Raises Unreadable, InvalidBody and Unprocessable.
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
    return Case(calculation, request, response_to(calculation, request, result), kept)


def faults_of(error: Exception, calculation: Calculation) -> list[Fault]:
    """What a case was refused for; the messages name fields by their titles."""
    match error:
        case InvalidBody():
            dotted = ((each.pointer.removeprefix("/").replace("/", "."), each.message) for each in error.faults)
            found = [(path.replace("~1", "/").replace("~0", "~"), message) for path, message in dotted]
        case Unprocessable():
            found = [(error.path or "", error.message)]
        case _:
            found = [("", str(error))]
    return [Fault(path, _titled(message, path, calculation)) for path, message in found]


def _titled(message: str, path: str, calculation: Calculation) -> str:
    """A message with titles for the names of fields; among fields of one name, the one beside `path`."""
    section, _, own = path.rpartition(".")
    models = (calculation.request, calculation.response)

    def title(name: re.Match[str]) -> str:
        exact = (leaf_at(model, each) for each in (f"{section}.{name[0]}", name[0]) for model in models)
        alike = (leaf for model in models for leaf in leaves(model) if leaf.path.endswith(f".{name[0]}"))
        found = next(filter(None, exact), None) or next(alike if "." not in name[0] else iter(()), None)
        return found.title if found else name[0]

    return re.sub(rf"^{re.escape(own)}(?= )|{NAME}", title, message)


def _fill(branch: Branch, body: dict[str, Any]) -> None:
    """Empty sections where required ones are missing: people see fields, which the validator then names."""
    for inner in branch.branches:
        name = inner.path.rpartition(".")[2]
        if inner.required and not inner.optional and not inner.repeated:
            body.setdefault(name, {})
        if isinstance(body.get(name), dict):
            _fill(inner, body[name])
