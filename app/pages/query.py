"""Conversion of a query string or a form to a request body and back.

The name of a field in a query contains the names of its sections and the indices of lists, separated by dots.
"""

import re
from collections.abc import Iterable
from typing import Any
from urllib.parse import parse_qsl, urlencode

from app.errors import Unreadable, printable
from app.figures.wording import difference_unit
from app.pages.study_kinds import CASES, CORNER, control_names
from app.pages.typed import (
    as_typed,
    in_link,
    items_in_link,
    list_in_link,
    number_of,
    plain_number_of,
    table_in_link,
    text_of,
)
from app.schema.fields import Leaf, branches, leaf_at, matrix_at, pair_at, pattern_of
from app.schema.model import Documented

Pairs = list[tuple[str, str]]

REPORT_NAMES = {
    "title": 200,
    "project": 200,
    "part": 200,
    "revision": 40,
    "author": 200,
    "checker": 200,
    "approver": 200,
    "rexs_file": 200,
    "rexs_sha256": 64,
    "notes": 2000,
}
"""The fields that identify a report, with the largest permissible number of characters of each field."""
VIEW_NAMES = REPORT_NAMES.keys() | {
    *("paper", "ref", "also", "pair", "typical", "theme", "sources", "curve", "unlinked", "extent", "rexs_stage"),
    "narrow",
}
"""Names of query fields that affect only how a case is shown.

`split_views` adds the names of the controls of studies.
"""
PICK = "pick:"
"""Prefix of a query field that states the user's choice among several fields that exclude each other.

The text of the query field is the name of the chosen field.
"""
WRITTEN = "written"
"""The name of a hidden field of a form.

The hidden field lists texts that the server wrote into the form, as a query string. The list contains only texts that
would have another meaning if a user typed them.
"""
MOST_FIELDS = 1000  # chosen: many more than the longest form has
DEEPEST = 12  # largest number of parts of a name; the names of all fields have fewer parts
LONGEST_QUERY = 6000  # characters; common proxies refuse a request line of more than 8 KiB
LONGEST_NAME = 100  # characters of a name; the names of all fields are shorter
MATRIX = 2  # number of dimensions
PAIR = 2  # numbers of a pair
SIDE = 2  # rows and columns of a matrix, one for each of the two directions across a shaft
PRESENT = "on"

_PASTED = re.compile(r"[\s;]+")


def pairs_of_query(query: str) -> Pairs:
    """Return the names and texts of a query as they were sent. Raises Unreadable if the query has too many fields."""
    try:
        return parse_qsl(query, keep_blank_values=True, max_num_fields=MOST_FIELDS, errors="replace")
    except ValueError:
        raise Unreadable(f"The query has more than {MOST_FIELDS} fields, which is the largest number allowed") from None


def split_views(pairs: Pairs) -> tuple[Pairs, dict[str, str]]:
    """Return the fields of the case, and the fields that affect only how the case is shown."""
    views = VIEW_NAMES | control_names()
    return [pair for pair in pairs if pair[0] not in views], {name: text for name, text in pairs if name in views}


def from_form(model: type[Documented], pairs: Pairs) -> Pairs:
    """Return the fields of a form or of a link as fields of a link.

    If the fields come from a form, the texts that a user typed are converted into texts for a link. The texts that the
    server wrote into the form are unchanged. If the fields come from a link, all texts are unchanged.
    """
    written = next((text for name, text in pairs if name == WRITTEN), None)
    if written is None:
        return pairs
    own = set(_plain(pairs_of_query(written)))
    plain = _plain(pair for pair in pairs if pair[0] != WRITTEN)
    all_of = dict(plain)
    return [(name, text if (name, text) in own else _in_link(model, name, text, all_of)) for name, text in plain]


def _plain(pairs: Iterable[tuple[str, str]]) -> Pairs:
    """Remove the blanks and line ends that a browser adds; tabs remain, because they separate the cells of a table."""
    return [(name, text.replace("\r\n", "\n").strip(" \n")) for name, text in pairs]


def written_of(model: type[Documented], pairs: Pairs) -> str:
    """Return the value of the hidden field `WRITTEN` for a form that is filled in with the texts of a link."""
    both = [*pairs, *(pair for pair in with_pairs_apart(model, pairs) if pair not in pairs)]
    all_of = dict(both)
    kept = [(name, text) for name, text in both if as_typed(text) == text != _in_link(model, name, text, all_of)]
    return urlencode(kept, safe=",:", errors="replace")


def _in_link(model: type[Documented], name: str, text: str, others: dict[str, str]) -> str:
    """Convert a typed text into the text for a link; `others` holds the texts of all fields of the form."""
    if name == CASES:
        return table_in_link(text)
    if name.startswith(CORNER):
        return items_in_link(text)
    if name in control_names():
        leaf = leaf_at(model, others.get(name.partition(".")[0], ""))  # the input that is varied or uncertain
        unit = leaf.unit if leaf else None
        if not name.endswith(".by") or difference_unit(unit) == unit:
            return in_link(text, unit)
        deviation = in_link(text, difference_unit(unit))
        return deviation if deviation != text else in_link(text, unit)
    leaf = leaf_at(model, name) or matrix_at(model, name) or pair_at(model, name)
    if leaf is None or leaf.options or leaf.kind not in {"number", "integer"}:
        return text
    is_list = leaf.dimensions == 1 and leaf_at(model, name) is not None
    return list_in_link(text, leaf.unit) if is_list else in_link(text, leaf.unit)


def normalised(model: type[Documented], pairs: Pairs) -> Pairs:
    """Return the fields that the link of a case must contain.

    Empty fields are left out. If the user has chosen one of several fields that exclude each other, the fields that the
    user did not choose are left out. The fields that state such a choice (see `PICK`) are left out too. The items of
    lists are renumbered. Two numbers that belong together become one field.
    """
    picked = {text for name, text in pairs if name.startswith(PICK)}
    kept: Pairs = []
    for name, spaced in pairs:
        text = spaced.strip()
        if not text or name.startswith(PICK):
            continue
        leaf = leaf_at(model, name)
        if leaf is None or picked.isdisjoint(excluded(name, leaf)):
            kept.append((name, text))
    for path in (path for path, branch in branches(model).items() if branch.repeated):
        kept = _renumbered(path, kept)
    return _with_pairs_joined(model, kept)


def _with_pairs_joined(model: type[Documented], pairs: Pairs) -> Pairs:
    """Join the numbers of each pair, such as the ends of a range; leave a pair apart that lacks a number."""
    texts, joined = dict(pairs), list[tuple[str, str]]()
    for name, text in pairs:
        whole, _, item = name.rpartition(".")
        both = [texts.get(f"{whole}.{place}", "") for place in "01"]
        whole_pair = pair_at(model, name) is not None and not any(
            isinstance(plain_number_of(each), str) for each in both
        )
        if not whole_pair:
            joined.append((name, text))
        elif item == "0":
            joined.append((whole, ",".join(both)))
    return joined


def with_pairs_apart(model: type[Documented], pairs: Pairs) -> Pairs:
    """Return the fields as a form shows them: each pair of numbers as two fields."""
    apart = list[tuple[str, str]]()
    for name, text in pairs:
        leaf = leaf_at(model, name)
        items = [item for item in re.split(r"[\s;,]+", text) if item]
        is_pair = leaf is not None and leaf.pair and len(items) == PAIR
        apart += [(f"{name}.{place}", item) for place, item in enumerate(items)] if is_pair else [(name, text)]
    return apart


def _renumbered(path: str, pairs: Pairs) -> Pairs:
    """Renumber the items of the list of sections at `path` from 0, without gaps."""
    items = [re.fullmatch(rf"{re.escape(path)}\.([0-9]{{1,9}})(|\..*)", name, re.DOTALL) for name, _ in pairs]
    indices = sorted({int(item[1]) for item in items if item})
    return [
        (f"{path}.{indices.index(int(item[1]))}{item[2]}" if item else name, text)
        for (name, text), item in zip(pairs, items, strict=True)
    ]


def excluded(name: str, leaf: Leaf) -> tuple[str, ...]:
    """Return the names of all fields and sections that a form leaves out if the field `name` is chosen."""
    section = name.rpartition(".")[0]
    fellows = dict.fromkeys((*leaf.exclusive, *leaf.alternatives))
    return tuple(f"{section}.{fellow.rpartition('.')[2]}".lstrip(".") for fellow in fellows)


def body_of(model: type[Documented], pairs: Pairs) -> dict[str, Any]:
    """Return the request body with these fields.

    If a field takes a number but its text is not a number, the text is kept; the validator then refuses the text.
    Raises Unreadable if a name is malformed, or if two names contradict each other.
    """
    body: dict[str, Any] = {}
    for name, text in pairs:
        parts = name[:LONGEST_NAME].split(".")
        if len(parts) > DEEPEST or not all(parts):
            raise Unreadable("The name of a field must consist of words separated by points")
        place = body
        for part in parts[:-1]:
            place = place.setdefault(part, {})
            if not isinstance(place, dict):
                raise Unreadable(
                    f"The query contains {printable('.'.join(parts[:-1]))} both as a value and as a section"
                )
        if isinstance(place.get(parts[-1]), dict) and text == PRESENT:
            continue
        if parts[-1] in place:
            raise Unreadable(f"The query contains the field {printable('.'.join(parts))} twice")
        place[parts[-1]] = _value(model, name, text)
    content: dict[str, Any] = _with_lists(model, body)
    return content


def pairs_of(content: Any, name: str = "") -> Pairs:
    """Return the fields of a request body without the null fields, because a null field is empty in a form."""
    inner: Iterable[tuple[Any, Any]]
    match content:
        case None | []:
            return []
        case dict():
            if not content and name:
                return [(name, PRESENT)]
            inner = content.items()
        case list() if any(isinstance(item, dict | list) for item in content):  # sections, or the rows of a matrix
            inner = enumerate(dict(enumerate(item)) if isinstance(item, list) else item for item in content)
        case list():
            return [(name, ",".join(text_of(item) for item in content))]
        case _:
            return [(name, text_of(content))]
    return [pair for key, value in inner for pair in pairs_of(value, f"{name}.{key}" if name else str(key))]


def link(path: str, pairs: Pairs, **views: str | None) -> str:
    """Return `path` with a query that contains the fields `pairs` and those `views` that have a text."""
    query = urlencode([*pairs, *((name, text) for name, text in views.items() if text)], safe=",:", errors="replace")
    return f"{path}?{query}" if query else path


def _value(model: type[Documented], name: str, text: str) -> Any:
    leaf = leaf_at(model, name)
    if leaf is None:
        if text == PRESENT and pattern_of(name) in branches(model):
            return {}
        return number_of(text) if matrix_at(model, name) or pair_at(model, name) else text
    if leaf.dimensions == 1:
        return _listed(leaf, text)
    if leaf.options:
        return next((option for option in leaf.options if option in (text, number_of(text))), text)
    if leaf.kind == "boolean":
        return {"true": True, "false": False}.get(text, text)
    return number_of(text) if leaf.kind in {"number", "integer"} else text


def _listed(leaf: Leaf, text: str) -> list[Any]:
    """Read a list.

    In a link, commas separate the items. In a pasted list, blanks, line ends or semicolons separate the items, and a
    comma may stand before each of these separators.
    """
    items = _PASTED.split(text.strip(" \t\r\n;"))
    items = text.split(",") if len(items) == 1 else [item.removesuffix(",") for item in items]
    return [item.strip() if leaf.kind == "text" else plain_number_of(item.strip()) for item in items]


def _with_lists(model: type[Documented], content: Any, path: str = "") -> Any:
    """Replace each object whose keys are indices by a list or a matrix, and return the content."""
    if not isinstance(content, dict):
        return content
    inner = {name: _with_lists(model, value, f"{path}.{name}".lstrip(".")) for name, value in content.items()}
    if (leaf := leaf_at(model, path)) is not None and leaf.dimensions == MATRIX:
        return _matrix(content)
    if leaf is not None and leaf.pair and content.keys() <= {"0", "1"}:
        return [content.get(item, default) for item, default in zip("01", leaf.default or (None, None), strict=True)]
    if inner and all(name.isdecimal() and name.isascii() for name in inner):
        return [inner[name] for name in sorted(inner, key=lambda name: (len(name), name))]
    return inner


def _matrix(elements: dict[str, Any]) -> Any:
    """Return a matrix as a list of rows.

    `elements` maps the index of each row to a dictionary. This dictionary maps the index of each column to a text. A
    missing element becomes None. If only the first element is given, return its text: the matrix is then this multiple
    of the unit matrix. If a key is not an index of the matrix, return `elements` unchanged.
    """
    places = [str(place) for place in range(SIDE)]
    rows = [elements.get(place, {}) for place in places]
    if not all(isinstance(part, dict) and part.keys() <= {*places} for part in (elements, *rows)):
        return elements
    matrix = [[row.get(place) for place in places] for row in rows]
    alone = matrix[0][0]
    return alone if elements == {"0": {"0": alone}} else matrix
