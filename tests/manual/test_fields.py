"""The table of inputs and outputs contains all fields of the OpenAPI document, and its rows lead to the code."""

import random
import re
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.calculations import CALCULATIONS
from app.examples import examples
from app.http.routes.manual import OTHER_ANSWERS
from app.main import app
from app.manual.fields import FieldRow, address, table
from app.pages.query import link, pairs_of
from app.pages.templating import page_path
from app.schema.fields import ITEM, leaves
from solvers.quantity import quantities

ROOT = Path(__file__).parents[2]
NOT_TOLD = {"/v1/rexs/results"}  # a file


def entries() -> tuple[FieldRow, ...]:
    return table(OTHER_ANSWERS)


@cache
def rows() -> dict[tuple[str, str, str], FieldRow]:
    return {(each.section, endpoint, each.path): each for each in entries() for endpoint in each.endpoints}


def properties(schema: dict[str, Any], path: str = "") -> Iterator[str]:
    """Yield the paths of the fields in a schema that contain values. The paths of sections are left out."""
    if "$ref" in schema:
        schema = app.openapi()["components"]["schemas"][schema["$ref"].rpartition("/")[2]]
    inner = [part for name in ("anyOf", "oneOf", "allOf") for part in schema.get(name, ())]
    if "properties" in schema:
        for name, part in schema["properties"].items():
            yield from properties(part, f"{path}.{name}".lstrip("."))
    elif any("$ref" in part or "$ref" in part.get("items", ()) or "oneOf" in part.get("items", ()) for part in inner):
        for part in inner:
            if part.get("type") != "null":
                yield from properties(part, path)
    elif schema.get("type") == "array" and any(f".{ITEM}." in f".{each}" for each in properties(schema["items"], ITEM)):
        yield from properties(schema["items"], f"{path}.{ITEM}".lstrip("."))
    else:
        yield path


def documented() -> Iterator[tuple[str, str, str]]:
    """Yield the section, address and path of every field in the OpenAPI document, without figures and files."""
    calculations = {each.path for each in CALCULATIONS}
    for endpoint, operations in app.openapi()["paths"].items():
        for operation in operations.values():
            if "/figures/{name}" in endpoint or endpoint in NOT_TOLD:
                continue
            body = operation.get("requestBody", {}).get("content", {}).get("application/json", {}).get("schema")
            answer = operation["responses"]["200"].get("content", {}).get("application/json", {}).get("schema")
            if body and body.get("format") != "binary":
                section = "Requests" if endpoint in calculations else "Studies"
                yield from ((section, endpoint, path) for path in properties(body))
            if answer:
                section = "Answers" if endpoint in calculations else "Service"
                found = (path.removeprefix(f"{ITEM}.") for path in properties(answer))  # of a list of all
                yield from ((section, endpoint, path) for path in found)


def test_the_table_has_the_fields_of_the_openapi_document() -> None:
    assert set(documented()) == set(rows())


def test_ten_drawn_fields_lead_to_the_line_that_declares_them() -> None:
    """A row names a module, a class and an attribute of the solvers."""
    # The source of this module declares this attribute in this class.
    declared = [each for each in entries() if each.section in {"Requests", "Answers"} and each.cells[9]]
    for entry in random.Random(42).sample(declared, 10):
        module, kind, name = entry.cells[9].strip("`").rsplit(".", 2)
        assert name in quantities(getattr(import_module(module), kind))
        source = (ROOT / f"{module.replace('.', '/')}.py").read_text("utf-8")
        assert re.search(rf"^class {kind}\b.*?^    (?:{name}: |def {name}\()", source, re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("calculation", CALCULATIONS, ids=lambda each: each.path)
def test_every_field_has_a_row_to_which_a_link_leads(calculation: Any) -> None:
    anchors = {each.anchor for each in entries()}
    assert len(anchors) == len(entries())
    for section, model in (("Requests", calculation.request), ("Answers", calculation.response)):
        for leaf in leaves(model):
            assert rows()[section, calculation.path, leaf.path].cells[3] == (leaf.unit or "")
    for leaf in leaves(calculation.request):
        to_row = address(calculation.path, leaf.path)
        assert to_row.removeprefix("/manual/fields#") == rows()["Requests", calculation.path, leaf.path].anchor


def test_pages_lead_to_the_table(client: httpx.Client) -> None:
    shown = client.get("/manual/fields").text
    assert 'type="search"' in shown
    assert 'href="/manual/fields"' in client.get("/docs").text
    example = next(iter(examples().values()))
    path = page_path(next(each for each in CALCULATIONS if each.path == example.endpoint))
    form = client.get(link(path, pairs_of(example.request))).text
    linked = set(re.findall(r'href="/manual/fields#([^"]+)"', form))
    assert len(linked) > 20
    assert linked <= set(re.findall(r'<tr id="([^"]+)"', shown))
