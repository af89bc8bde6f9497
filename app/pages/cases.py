"""A case from its fields to its answer, which is kept: figure, report and download of it need no second solve."""

import pickle
import re
import zlib
from dataclasses import dataclass
from hashlib import sha256
from typing import Any, NamedTuple

from app.calculations import Calculation
from app.errors import InvalidBody, Unprocessable
from app.evaluate import response_to, solve
from app.pages.query import Pairs, body_of
from app.schema.fields import Branch, leaf_at, leaves, tree
from app.schema.model import Request
from app.schema.reading import validated
from solvers.quantity import Detail

NAME = r"[a-z]\w*(?:[._]\w+)+"  # of a field: words joined by points and underscores
COMPRESSION = 1  # the fastest level of zlib


def key_of(path: str, pairs: Pairs) -> str:
    """The key of a case: its endpoint and fields, whatever their order."""
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
