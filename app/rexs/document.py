"""Reading of a REXS file into a `RexsUnit`, and writing of the file with new attributes.

What is written is the file that was read, with lines added: declaration, encoding, line ends and comments of XML stay
byte for byte, and JSON keeps its indentation and line ends.

A file is XML, JSON, or a zip archive with one XML or JSON file. The file may come from anybody. Therefore the options
of lxml forbid entities, external files and deep nesting. The number of tags and attributes is checked before the parser
turns the file into objects.
"""

import base64
import codecs
import io
import json
import re
import zipfile
import zlib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from math import isfinite
from pathlib import PurePosixPath
from typing import Any, NamedTuple
from xml.parsers import expat
from xml.sax.saxutils import escape, quoteattr

import numpy as np
from lxml import etree

from app.errors import Unprocessable
from app.rexs.model import Attribute, Component, LoadCase, Relation, RexsUnit

MOST_ELEMENTS = 1_500_000  # XML tags and attributes, or JSON objects and arrays; about 200 bytes of memory for each
VERSIONS = ("1", "2")
SUFFIXES = (".rexs", ".rexsj", ".rexs.json", ".rexs.xml")
MODELS = ", ".join(SUFFIXES)
PACKINGS = {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}  # to unpack other methods may take gigabytes of memory
CODES = {"float32": "<f4", "float64": "<f8", "int32": "<i4"}
SAFE = {"resolve_entities": False, "load_dtd": False, "no_network": True, "huge_tree": False, "remove_pis": False}
"""Options of lxml: no entities, no access to other files, and libxml2's own limits on nesting and on text length."""


def not_rexs(message: str) -> Unprocessable:
    """Return the error for a file that is not a readable REXS model. `message` says what is wrong and where."""
    return Unprocessable("not_rexs", message, None)


MARKS = {
    codecs.BOM_UTF8: ("utf-8", 3),
    codecs.BOM_UTF16_LE: ("utf-16-le", 2),
    codecs.BOM_UTF16_BE: ("utf-16-be", 2),
    "<?".encode("utf-16-le"): ("utf-16-le", 0),
    "<?".encode("utf-16-be"): ("utf-16-be", 0),
}
"""Encodings of XML by its first bytes, and how many of these are not text."""
_DECLARATION = re.compile(r"\s*<\?xml\b[^>]*?\?>")
_ENCODING = re.compile(rb"""\s*<\?xml\b[^>]*?\bencoding\s*=\s*["']([\w.:-]{1,40})["']""")
_TAG = re.compile(rb"""<(?:[^'">]|"[^"]*"|'[^']*')*>""")
_INDENT = re.compile(r"\s*\{\r?\n([ \t]*)")


class File(NamedTuple):
    """A file in XML or JSON; `archive` is the zip archive from which it was unpacked."""

    content: bytes
    media_type: str
    suffix: str
    archive: bytes | None = None


class Document(NamedTuple):
    """An unpacked file and the model in it."""

    file: File
    model: RexsUnit


def read(content: bytes, most_bytes: int) -> Document:
    """Read a REXS file in any of its formats.

    Raises Unprocessable if the file cannot be read, or if the unpacked file has more than `most_bytes` bytes.
    """
    archive = content if content.startswith(b"PK") else None
    if archive is not None:
        content = _unpacked(archive, most_bytes)
    if len(content) > most_bytes:
        raise not_rexs(f"the model has more than {most_bytes // 1_000_000} MB")
    start = content.lstrip(b"\xef\xbb\xbf \t\r\n")[:1]
    if not start:
        raise not_rexs("the file is empty")
    if start == b"{":
        return Document(File(content, "application/json", ".rexsj", archive), _model_of_json(content))
    return Document(File(content, "application/xml", ".rexs", archive), _model_of_xml(content))


def with_attributes(file: File, component: int, attributes: Sequence[Attribute]) -> File:
    """File with additional attributes of a component. A new attribute replaces an attribute of the same name."""
    write = _json_with if file.suffix == ".rexsj" else _xml_with
    return file._replace(content=write(file.content, component, attributes))


def packed(file: File, most_bytes: int) -> File:
    """Return a file that came from an archive as that archive, with its other entries; any other file unchanged.

    Raises Unprocessable if the other entries have more than `most_bytes` bytes, or cannot be read.
    """
    if file.archive is None:
        return file
    buffer, left = io.BytesIO(), most_bytes
    with _opened(file.archive) as archive, zipfile.ZipFile(buffer, "w") as copy:
        model = _model_entry(archive)
        for entry in archive.infolist():
            content = file.content
            if entry is not model:
                content = archive.open(entry).read(left + 1)
                left -= len(content)
            if left < 0:
                raise not_rexs(f"the archive has more than {most_bytes // 1_000_000} MB beside the model")
            copy.writestr(entry, content)
    return File(buffer.getvalue(), "application/zip", ".rexsz")


@contextmanager
def _opened(content: bytes) -> Iterator[zipfile.ZipFile]:
    """Open an archive; raise Unprocessable if it cannot be read."""
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            yield archive
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, OSError, EOFError, ValueError) as error:
        raise not_rexs("the archive is damaged, encrypted or compressed by a method that is not supported") from error


def _model_entry(archive: zipfile.ZipFile) -> zipfile.ZipInfo:
    """Return the only model in an archive."""
    models = [entry for entry in archive.infolist() if _is_model(entry.filename)]
    if len(models) != 1:
        names = ", ".join(PurePosixPath(entry.filename).name[:40] for entry in models[:5])
        listed = f": {names}" if names else ""
        raise not_rexs(f"the archive must hold exactly one model ({MODELS}), but it holds {len(models)}{listed}")
    if models[0].compress_type not in PACKINGS:
        raise not_rexs("the compression of the archive is not supported; use deflate, the usual method")
    return models[0]


def _unpacked(content: bytes, most_bytes: int) -> bytes:
    """Unpack the model file in a zip archive, and return at most the first `most_bytes` + 1 bytes of the file."""
    with _opened(content) as archive, archive.open(_model_entry(archive)) as model:
        return model.read(most_bytes + 1)


def _is_model(name: str) -> bool:
    """Return True if the name of a file in an archive is the name of a REXS file."""
    path = PurePosixPath(name.replace("\\", "/"))
    hidden = "__MACOSX" in path.parts[:-1] or path.name.startswith(".")
    return not hidden and not name.endswith("/") and path.name.lower().endswith(SUFFIXES)


def _model(
    version: object,
    application: Iterable[str | None],
    components: list[Component],
    relations: Iterable[Relation],
    load_cases: Iterable[LoadCase],
) -> RexsUnit:
    version = str(version or "").strip()
    if version.split(".")[0] not in VERSIONS:
        raise not_rexs("the version of the model is not 1.x or 2.x" if version else "the model states no version")
    by_id: dict[int, Component] = {}
    for component in components:
        if component.id in by_id:
            raise not_rexs(f"component {component.id} occurs twice")
        by_id[component.id] = component
    return RexsUnit(version[:20], " ".join(filter(None, application)), by_id, tuple(relations), tuple(load_cases))


def _numbers(code: object, text: object) -> list[Any] | None:
    """Return the numbers of an array in base64 (little-endian), or None if the text is damaged."""
    try:
        raw = base64.b64decode(str(text or "").strip(), validate=True)
        numbers: list[Any] = np.frombuffer(raw, dtype=CODES[str(code)]).tolist() if raw else []
    except (ValueError, KeyError):
        return None
    return numbers


def _model_of_xml(content: bytes) -> RexsUnit:
    """Read the model from XML, element by element, so that the whole tree of a large file is never in memory."""
    if content.count(b"<") + content.count(b"=") > MOST_ELEMENTS:
        raise not_rexs(f"the file has more than {MOST_ELEMENTS} tags and attributes")
    readers = {"component": _xml_component, "relation": _xml_relation, "load_case": _xml_load_case}
    parts: dict[str, list[Any]] = {tag: [] for tag in readers}
    tags = tuple(f"{{*}}{tag}" for tag in readers)
    steps = etree.iterparse(io.BytesIO(content), events=("end",), tag=tags, **SAFE)
    try:
        for _, element in steps:
            tag = _tag(element)
            if tag == "component" and not _is_of_model(element):
                continue  # the component belongs to a load case; it is read together with the load case
            parts[tag].append(readers[tag](element))
            element.clear(keep_tail=False)
    except etree.XMLSyntaxError as error:
        raise not_rexs(f"line {error.lineno}: {error.msg}") from error
    root = steps.root
    if root.getroottree().docinfo.internalDTD is not None:
        raise not_rexs("the file has a document type declaration; REXS has none")
    if _tag(root) != "model":
        raise not_rexs("the outermost element is not <model>")
    application = root.get("applicationId"), root.get("applicationVersion")
    return _model(root.get("version"), application, parts["component"], parts["relation"], parts["load_case"])


def _tag(element: Any) -> str:
    """Return the name of an element without its namespace. The name of a comment is empty."""
    return etree.QName(element).localname if isinstance(element.tag, str) else ""


def _children(element: Any, tag: str) -> Iterator[Any]:
    return (child for child in element if _tag(child) == tag)


def _is_of_model(component: Any) -> bool:
    """Return True if a component is in the model's own list of components, and not in a load case."""
    parent = component.getparent()
    return parent is not None and _tag(parent) == "components"


def _xml_component(element: Any) -> Component:
    attributes = {}
    for attribute in _children(element, "attribute"):
        name = attribute.get("id") or ""
        array = next((child for child in attribute if _tag(child) in {"array", "matrix", "array_of_arrays"}), None)
        value = _text_of(attribute) if array is None else _xml_array(array)
        attributes[name] = Attribute(name, attribute.get("unit") or "", value)
    return Component(_xml_id(element), element.get("type") or "", element.get("name") or "", attributes)


def _xml_array(element: Any) -> list[Any] | None:
    """Return an array as a list. Return a matrix or an array of arrays as a list of rows."""
    if code := element.get("code"):
        return _numbers(code, element.text)
    if _tag(element) == "array":
        return [_text_of(cell) for cell in _children(element, "c")]
    rows = _children(element, "r" if _tag(element) == "matrix" else "array")
    return [[_text_of(cell) for cell in _children(row, "c")] for row in rows]


def _text_of(element: Any) -> str:
    return (element.text or "").strip()


def _xml_relation(element: Any) -> Relation:
    order = None if element.get("order") is None else _xml_id(element, "order")
    parts = tuple((ref.get("role") or "", _xml_id(ref)) for ref in _children(element, "ref"))
    return Relation(element.get("type") or "", order, parts)


def _xml_load_case(element: Any) -> LoadCase:
    parts = [_xml_component(component) for component in _children(element, "component")]
    return LoadCase(element.get("name") or element.get("id") or "", {part.id: part.attributes for part in parts})


def _xml_id(element: Any, attribute: str = "id") -> int:
    text = (element.get(attribute) or "").strip()
    if not re.fullmatch(r"-?\d{1,18}", text):
        raise not_rexs(
            f"line {element.sourceline}: the attribute {attribute} of <{_tag(element)}> must be a whole number"
        )
    return int(text)


def _encoding_of(content: bytes) -> tuple[str, int]:
    """Return the encoding of an XML file, and the number of bytes before its text."""
    found = next((known for mark, known in MARKS.items() if content.startswith(mark)), None)
    if found is not None:
        return found
    stated = _ENCODING.match(content)
    return (stated[1].decode() if stated else "utf-8"), 0


class _Place:
    """Where a component stands in the UTF-8 bytes of an XML file: its tag, and the attributes directly in it."""

    def __init__(self, raw: bytes, component: int) -> None:
        self.raw, self.component = raw, component
        self.tag, self.start, self.end = "", -1, -1  # end: of its content, or of its tag if it is empty
        self.attributes: list[tuple[str, int, int]] = []  # name, start and end
        self._open: list[tuple[str, str, int]] = []  # tag, id and start of the elements around
        self._parser = expat.ParserCreate("utf-8")
        self._parser.StartElementHandler, self._parser.EndElementHandler = self._begin, self._finish
        self._parser.Parse(raw, True)

    def _begin(self, tag: str, attributes: dict[str, str]) -> None:
        around = [_local(each[0]) for each in self._open[-1:]]
        self._open.append((tag, attributes.get("id", "").strip(), self._parser.CurrentByteIndex))
        is_of_model = _local(tag) == "component" and around == ["components"]  # not of a load case
        if is_of_model and not self.tag and int(self._open[-1][1]) == self.component:
            self.tag, self.start = tag, self._open[-1][2]
            self._depth = len(self._open)

    def _finish(self, tag: str) -> None:
        _, name, start = self._open.pop()
        at = self._parser.CurrentByteIndex  # of the end tag; of an empty element, behind it
        if not self.tag or self.end >= 0:
            return
        if len(self._open) == self._depth - 1:
            self.end = at
        elif len(self._open) == self._depth and _local(tag) == "attribute":
            end = at if self._is_empty(start, at) else self.raw.index(b">", at) + 1
            self.attributes.append((name, start, end))

    @property
    def is_empty(self) -> bool:
        """Whether the component is an empty element, such as `<component id="1"/>`."""
        return self._is_empty(self.start, self.end)

    def _is_empty(self, start: int, end: int) -> bool:
        tag = _TAG.match(self.raw, start)
        return tag is not None and tag.end() == end and tag[0].endswith(b"/>")


def _local(tag: str) -> str:
    """Return a name without its prefix."""
    return tag.rpartition(":")[2]


def _blank_before(raw: bytes, place: int) -> bytes:
    """Return the blanks and line ends that stand before a place."""
    return raw[len(raw[:place].rstrip(b" \t\r\n")) : place]


def _xml_with(content: bytes, component: int, attributes: Sequence[Attribute]) -> bytes:
    """Add attributes to a component; every other byte of the file stays."""
    encoding, skipped = _encoding_of(content)
    try:
        text = content[skipped:].decode(encoding)
        declaration = _DECLARATION.match(text)
        raw = text.encode()
        hidden = len(declaration[0].encode()) if declaration else 0
        place = _Place(b" " * hidden + raw[hidden:], component)
    except (expat.ExpatError, LookupError, UnicodeError) as error:
        raise not_rexs("the file cannot be written in its encoding; save it as UTF-8") from error
    prefix = place.tag.removesuffix("component")
    names = {attribute.name for attribute in attributes}
    around = _blank_before(raw, place.start)
    indent = _blank_before(raw, place.attributes[0][1]) if place.attributes else around + (b" " if around else b"")
    added = b"".join(indent + _xml_attribute(prefix, attribute).encode() for attribute in attributes)
    edits = [
        (start - len(_blank_before(raw, start)), end, b"") for name, start, end in place.attributes if name in names
    ]
    if place.is_empty:
        slash = raw.rindex(b"/", place.start, place.end)
        edits.append((slash, place.end, b">" + added + around + f"</{place.tag}>".encode()))
    elif place.attributes:
        last = place.attributes[-1][2]
        edits.append((last, last, added))
    else:
        at = place.end - len(_blank_before(raw, place.end))
        edits.append((at, at, added + (b"" if at < place.end else around)))
    for start, end, new in sorted(edits, reverse=True):
        raw = raw[:start] + new + raw[end:]
    return content[:skipped] + raw.decode().encode(encoding, "xmlcharrefreplace")


def _xml_attribute(prefix: str, attribute: Attribute) -> str:
    name, unit, value = quoteattr(attribute.name), quoteattr(attribute.unit), escape(str(attribute.value))
    return f"<{prefix}attribute id={name} unit={unit}>{value}</{prefix}attribute>"


def _model_of_json(content: bytes) -> RexsUnit:
    if content.count(b"{") + content.count(b"[") > MOST_ELEMENTS:
        raise not_rexs(f"the file has more than {MOST_ELEMENTS} objects and arrays")
    try:
        document = json.loads(content, parse_constant=_refuse_constant, parse_float=_finite)
        if b"\\ud" in content.lower():
            json.dumps(document, ensure_ascii=False).encode()  # raises an error if half of a surrogate pair is missing
    except json.JSONDecodeError as error:
        raise not_rexs(f"line {error.lineno}: {error.msg}") from error
    except (ValueError, RecursionError) as error:  # not UTF-8, too many digits in a number, or too deep nesting
        raise not_rexs("the file is not valid JSON") from error
    model = document.get("model")
    if not isinstance(model, dict):
        raise not_rexs("model is missing or of the wrong kind")
    return _model(
        model.get("version"),
        (str(model.get(name) or "") for name in ("applicationId", "applicationVersion")),
        [_json_component(item) for item in _objects(model, "components")],
        (_json_relation(item) for item in _objects(model, "relations")),
        (_json_load_case(item) for item in _objects(model.get("load_spectrum") or {}, "load_cases")),
    )


def _refuse_constant(name: str) -> float:
    raise ValueError(name)


def _finite(text: str) -> float:
    """Convert a text into a float. Reject a number too large for a float, because JSON cannot represent infinity."""
    if not isfinite(number := float(text)):
        raise not_rexs(f"the number {text[:20]} is too large")
    return number


def _objects(of: Any, name: str) -> list[dict[str, Any]]:
    """Return the list of objects that a JSON object contains under a name, or an empty list if the name is absent."""
    items = of.get(name, []) if isinstance(of, dict) else None
    if not isinstance(items, list) or not all(isinstance(item, dict) for item in items):
        raise not_rexs(f"{name} must be a list of objects")
    return items


def _json_component(item: dict[str, Any]) -> Component:
    attributes = {}
    for attribute in _objects(item, "attributes"):
        name = str(attribute.get("id") or "")
        # The key of the value is the name of the value's type.
        value = next((attribute[key] for key in attribute if key not in {"id", "unit"}), None)
        if isinstance(value, dict):
            value = _numbers(value.get("code"), value.get("value"))
        attributes[name] = Attribute(name, str(attribute.get("unit") or ""), value)
    return Component(_json_id(item), str(item.get("type") or ""), str(item.get("name") or ""), attributes)


def _json_relation(item: dict[str, Any]) -> Relation:
    order = item.get("order")
    parts = tuple((str(ref.get("role") or ""), _json_id(ref)) for ref in _objects(item, "refs"))
    return Relation(str(item.get("type") or ""), order if isinstance(order, int) else None, parts)


def _json_load_case(item: dict[str, Any]) -> LoadCase:
    parts = [_json_component(component) for component in _objects(item, "components")]
    return LoadCase(str(item.get("name") or item.get("id") or ""), {part.id: part.attributes for part in parts})


def _json_id(item: dict[str, Any]) -> int:
    id_ = item.get("id")
    if not isinstance(id_, int) or isinstance(id_, bool):
        raise not_rexs("every component, and every ref of a relation, needs a whole number as its id")
    return id_


def _json_with(content: bytes, component: int, attributes: Iterable[Attribute]) -> bytes:
    """Add attributes to a component; encoding, indentation and line ends of the file stay."""
    encoding = json.detect_encoding(content)
    text = content.decode(encoding)
    document = json.loads(text)
    item = next(item for item in document["model"]["components"] if item["id"] == component)
    listed = item.setdefault("attributes", [])
    for attribute in attributes:
        listed[:] = [entry for entry in listed if entry.get("id") != attribute.name]
        kind = "floating_point" if isinstance(attribute.value, float) else "string"
        listed.append({"id": attribute.name, "unit": attribute.unit, kind: attribute.value})
    indent = _INDENT.match(text)
    tight = re.match(r'\s*\{\s*"model":\S', text) is not None
    separators = ("," if indent or tight else ", ", ":" if tight else ": ")
    written = json.dumps(
        document, ensure_ascii=text.isascii(), indent=indent[1] if indent else None, separators=separators
    )
    written = written.replace("\n", "\r\n" if "\r\n" in text else "\n") + text[len(text.rstrip()) :]
    return written.encode(encoding)
