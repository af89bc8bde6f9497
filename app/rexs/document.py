"""A REXS file as bytes: XML, JSON or a zip archive of one of them; read into a `Model`, and written with additions.

The file may come from anybody. XML is parsed by lxml without entities, external files or deep nesting, and what a
parser would turn into many small objects is counted before it is parsed.
"""

import base64
import io
import json
import zipfile
import zlib
from collections import defaultdict
from collections.abc import Iterable
from typing import Any, Protocol

import numpy as np
from lxml import etree

from app.rexs.model import Attribute, Component, LoadCase, Model, Relation

MOST_ELEMENTS = 1_500_000  # tags and attributes of XML, containers of JSON: at 200 bytes each 300 MB
VERSIONS = ("1", "2")
CODES = {"float32": "<f4", "float64": "<f8", "int32": "<i4"}
SAFE = {"resolve_entities": False, "load_dtd": False, "no_network": True, "huge_tree": False, "remove_pis": False}
"""No entities, no other files, libxml2's limits of depth and length."""
_ARRAYS = ("array", "matrix", "array_of_arrays")


class NotRexs(Exception):
    """The file is not a REXS model that can be read; the message says where and why."""


class Document(Protocol):
    """A file that was read: its model, and the file itself, to which attributes can be added."""

    model: Model
    media_type: str
    suffix: str

    def add(self, component: int, attributes: Iterable[Attribute]) -> None:
        """Give attributes to a component, in place of those of the same names."""

    def content(self) -> bytes:
        """The file with what was added; everything else as it was."""


def read(content: bytes, most_bytes: int) -> Document:
    """Read a REXS file of at most `most_bytes` (unpacked), whichever of the formats it has."""
    if content.startswith(b"PK"):
        content = _unpacked(content, most_bytes)
    if len(content) > most_bytes:
        raise NotRexs(f"the model has more than {most_bytes // 1_000_000} MB")
    start = content.lstrip(b"\xef\xbb\xbf \t\r\n")[:1]
    if not start:
        raise NotRexs("the file is empty")
    return _Json(content) if start == b"{" else _Xml(content)


def _unpacked(content: bytes, most_bytes: int) -> bytes:
    """The one model in a zip archive, read no further than allowed whatever the archive says of its size."""
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            models = [
                each for each in archive.infolist() if each.filename.lower().endswith((".rexs", ".rexsj", ".xml"))
            ]
            if len(models) != 1:
                raise NotRexs(f"the archive holds {len(models)} models (.rexs or .rexsj); it must hold one")
            with archive.open(models[0]) as packed:
                return packed.read(most_bytes + 1)
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, OSError, EOFError) as error:
        raise NotRexs("the archive is damaged, encrypted or packed in a way that cannot be read") from error


class _Xml:
    """A model in XML (.rexs)."""

    media_type = "application/xml"
    suffix = ".rexs"

    def __init__(self, content: bytes) -> None:
        if content.count(b"<") + content.count(b"=") > MOST_ELEMENTS:
            raise NotRexs(f"the file has more than {MOST_ELEMENTS} tags and attributes")
        self._content = content
        self._added: dict[int, list[Attribute]] = defaultdict(list)
        try:
            self.model = self._read()
        except etree.XMLSyntaxError as error:
            raise NotRexs(f"line {error.lineno}: {error.msg}") from error

    def _read(self) -> Model:
        """The model, read part by part, so that the tree of a large file is never there as a whole."""
        tags = ("component", "relation", "load_case")
        steps = etree.iterparse(io.BytesIO(self._content), events=("end",), tag=tags, **SAFE)
        found: dict[str, list[Any]] = {tag: [] for tag in tags}
        for _, element in steps:
            if element.tag == "component" and element.getparent().tag != "components":
                continue  # of a load case, which is read as a whole
            found[element.tag].append(PARTS[element.tag](element))
            element.clear(keep_tail=False)
        root = steps.root
        if root.getroottree().docinfo.internalDTD is not None:
            raise NotRexs("the file has a document type declaration; REXS has none")
        if root.tag != "model":
            raise NotRexs("the outermost element is not <model>")
        return Model(
            version=_checked_version(root.get("version")),
            application=" ".join(filter(None, (root.get("applicationId"), root.get("applicationVersion")))),
            components=_by_id(found["component"]),
            relations=tuple(found["relation"]),
            load_cases=tuple(found["load_case"]),
        )

    def add(self, component: int, attributes: Iterable[Attribute]) -> None:
        self._added[component].extend(attributes)

    def content(self) -> bytes:
        root = etree.fromstring(self._content, etree.XMLParser(**SAFE))
        for element in root.iterfind("components/component"):
            added = self._added.get(int(element.get("id")), ())
            present = {each.get("id"): each for each in element.iterfind("attribute")}
            for attribute in added:
                if (old := present.get(attribute.name)) is not None:
                    element.remove(old)
                new = etree.SubElement(element, "attribute", id=attribute.name, unit=attribute.unit)
                new.text = _text(attribute.value)
        return bytes(etree.tostring(root.getroottree(), xml_declaration=True, encoding="UTF-8"))


def _by_id(components: Iterable[Component]) -> dict[int, Component]:
    found: dict[int, Component] = {}
    for component in components:
        if component.id in found:
            raise NotRexs(f"component {component.id} is there twice")
        found[component.id] = component
    return found


def _component_of(element: Any) -> Component:
    attributes = (_attribute_of(each) for each in element.iterfind("attribute"))
    return Component(
        id=_whole(element.get("id"), element),
        type=element.get("type") or "",
        name=element.get("name") or "",
        attributes={each.name: each for each in attributes},
    )


def _attribute_of(element: Any) -> Attribute:
    array = next((child for child in element if child.tag in _ARRAYS), None)
    value: Any = (element.text or "").strip()
    if array is not None:
        value = _array_of(array)
    return Attribute(element.get("id") or "", element.get("unit") or "", value)


def _array_of(element: Any) -> list[Any] | None:
    """An array; matrices and arrays of arrays as lists of their rows."""
    if code := element.get("code"):
        return _decoded(code, element.text)
    if element.tag == "array":
        return [(cell.text or "").strip() for cell in element.iterfind("c")]
    rows = element.iterfind("r") if element.tag == "matrix" else element.iterfind("array")
    return [[(cell.text or "").strip() for cell in row.iterfind("c")] for row in rows]


def _relation_of(element: Any) -> Relation:
    order = element.get("order")
    return Relation(
        type=element.get("type") or "",
        order=None if order is None else _whole(order, element),
        parts=tuple((each.get("role") or "", _whole(each.get("id"), each)) for each in element.iterfind("ref")),
    )


def _load_case_of(element: Any) -> LoadCase:
    parts = (_component_of(each) for each in element.iterfind("component"))
    return LoadCase(str(element.get("name") or element.get("id") or ""), {each.id: each.attributes for each in parts})


PARTS = {"component": _component_of, "relation": _relation_of, "load_case": _load_case_of}
"""What reads each part of the file."""


def _whole(text: str | None, element: Any) -> int:
    if text is None or not text.strip().lstrip("-").isdecimal() or len(text) > 18:
        raise NotRexs(f"line {element.sourceline}: <{element.tag}> needs a whole number as its id or order")
    return int(text)


def _text(value: float | str | bool) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return repr(float(value)) if isinstance(value, float) else str(value)


class _Json:
    """A model in JSON (.rexsj)."""

    media_type = "application/json"
    suffix = ".rexsj"

    def __init__(self, content: bytes) -> None:
        if content.count(b"{") + content.count(b"[") > MOST_ELEMENTS:
            raise NotRexs(f"the file has more than {MOST_ELEMENTS} objects and arrays")
        try:
            self._document = json.loads(content, parse_constant=_refuse_constant)
        except json.JSONDecodeError as error:
            raise NotRexs(f"line {error.lineno}: {error.msg}") from error
        except (ValueError, RecursionError) as error:  # not UTF-8, a number of thousands of digits, too deep
            raise NotRexs("the file is not JSON that can be read") from error
        model = _member(self._document, "model", dict)
        items = _objects(model, "components")
        components = [_component_of_json(item) for item in items]
        self._items = {component.id: item for component, item in zip(components, items, strict=True)}
        spectrum = model.get("load_spectrum") or {}
        self.model = Model(
            version=_checked_version(model.get("version")),
            application=f"{model.get('applicationId') or ''} {model.get('applicationVersion') or ''}".strip(),
            components=_by_id(components),
            relations=tuple(_relation_of_json(each) for each in _objects(model, "relations")),
            load_cases=tuple(_load_case_of_json(each) for each in _objects(spectrum, "load_cases")),
        )

    def add(self, component: int, attributes: Iterable[Attribute]) -> None:
        listed = self._items[component].setdefault("attributes", [])
        for attribute in attributes:
            listed[:] = [each for each in listed if each.get("id") != attribute.name]
            kind = "floating_point" if isinstance(attribute.value, float) else "string"
            listed.append({"id": attribute.name, "unit": attribute.unit, kind: attribute.value})

    def content(self) -> bytes:
        return json.dumps(self._document, ensure_ascii=False, indent=1).encode()


def _refuse_constant(name: str) -> float:
    raise ValueError(name)


def _member(of: Any, name: str, kind: type) -> Any:
    found = of.get(name) if isinstance(of, dict) else None
    if not isinstance(found, kind):
        raise NotRexs(f"{name} is missing or of the wrong kind")
    return found


def _objects(of: Any, name: str) -> list[dict[str, Any]]:
    """The list of objects under a name; none where the name is not there."""
    found = of.get(name, []) if isinstance(of, dict) else None
    if not isinstance(found, list) or not all(isinstance(each, dict) for each in found):
        raise NotRexs(f"{name} must be a list of objects")
    return found


def _component_of_json(item: dict[str, Any]) -> Component:
    attributes = {}
    for each in _objects(item, "attributes"):
        name = str(each.get("id") or "")
        kind = next((key for key in each if key not in {"id", "unit"}), None)
        value = each.get(kind) if kind else None
        if isinstance(value, dict):
            value = _decoded(value.get("code"), value.get("value"))
        attributes[name] = Attribute(name, str(each.get("unit") or ""), value)
    return Component(_id(item), str(item.get("type") or ""), str(item.get("name") or ""), attributes)


def _relation_of_json(item: dict[str, Any]) -> Relation:
    order = item.get("order")
    parts = tuple((str(each.get("role") or ""), _id(each)) for each in _objects(item, "refs"))
    return Relation(str(item.get("type") or ""), order if isinstance(order, int) else None, parts)


def _load_case_of_json(item: dict[str, Any]) -> LoadCase:
    parts = (_component_of_json(each) for each in _objects(item, "components"))
    return LoadCase(str(item.get("name") or item.get("id") or ""), {each.id: each.attributes for each in parts})


def _id(item: dict[str, Any]) -> int:
    found = item.get("id")
    if not isinstance(found, int) or isinstance(found, bool):
        raise NotRexs("every component, and every ref of a relation, needs a whole number as its id")
    return found


def _checked_version(version: object) -> str:
    text = str(version or "").strip()
    if text.split(".")[0] not in VERSIONS:
        raise NotRexs("the version of the model is not 1.x or 2.x" if text else "the model states no version")
    return text[:20]


def _decoded(code: object, text: object) -> list[Any] | None:
    """The numbers of an array in base64 (little-endian), or None where it is damaged."""
    try:
        raw = base64.b64decode(str(text).strip(), validate=True)
        numbers: list[Any] = np.frombuffer(raw, dtype=CODES[str(code)]).tolist()
    except (ValueError, KeyError):
        return None
    return numbers
