"""The OpenAPI document says what every field means."""

import json
from typing import Any

import httpx
import pytest
from pydantic import BaseModel

from app.calculations import CALCULATIONS
from app.schema.quantities import split_unit


@pytest.fixture(scope="module")
def document(client: httpx.Client) -> dict[str, Any]:
    document: dict[str, Any] = client.get("/openapi.json").json()
    return document


def fields(document: dict[str, Any]) -> list[tuple[str, str, dict[str, Any]]]:
    return [
        (schema, name, field)
        for schema, definition in document["components"]["schemas"].items()
        for name, field in definition.get("properties", {}).items()
    ]


def test_every_field_has_a_description(document: dict[str, Any]) -> None:
    assert [(schema, name) for schema, name, field in fields(document) if not field.get("description")] == []


def test_every_schema_has_a_name_of_its_own(document: dict[str, Any]) -> None:
    """If two modules have models of one name, the names of both schemas contain their modules."""
    # Generated clients cannot use such names.
    assert [name for name in document["components"]["schemas"] if "__" in name or "-" in name] == []


def test_every_unit_in_a_name_is_stated(document: dict[str, Any]) -> None:
    """A field states the unit that its name ends with, or else the unit of its group."""
    of_group = {group(field): field["x-unit"] for _, _, field in fields(document) if group(field) and "x-unit" in field}
    assert of_group == {"PumpingMassFlow": "g/s", "MisalignmentParts": "µm"}
    for schema, name, field in fields(document):
        _, unit = split_unit(name)
        wanted = unit.symbol if unit else of_group.get(schema) or of_group.get(group(field))
        assert field.get("x-unit") == wanted, (schema, name)


def group(field: dict[str, Any]) -> str:
    """Return the name of the schema to which a field refers, or an empty text if there is none."""
    return str(field.get("$ref", "")).rpartition("/")[2]


def test_every_number_of_a_request_has_a_range() -> None:
    unbounded = [
        (model.__name__, name)
        for calculation in CALCULATIONS
        for model in nested(calculation.request)
        for name, field in model.model_json_schema()["properties"].items()
        if not all(is_bounded(kind) for kind in kinds(field))
    ]
    assert unbounded == []


def kinds(field: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the schema of a field, the schemas of its alternatives, and those of the items of its lists."""
    alternatives = [field, *field.get("anyOf", ())]
    return [*alternatives, *(kind["items"] for kind in alternatives if "items" in kind)]


def is_bounded(kind: dict[str, Any]) -> bool:
    below, above = {"minimum", "exclusiveMinimum"}, {"maximum", "exclusiveMaximum"}
    return (
        "enum" in kind or kind.get("type") not in {"number", "integer"} or bool(below & set(kind) and above & set(kind))
    )


def nested(model: type[BaseModel]) -> list[type[BaseModel]]:
    inner = [
        kind
        for field in model.model_fields.values()
        for kind in (field.annotation, *getattr(field.annotation, "__args__", ()))
        if isinstance(kind, type) and issubclass(kind, BaseModel)
    ]
    return [model, *(deeper for kind in inner for deeper in nested(kind))]


def test_examples_stand_in_the_document(document: dict[str, Any]) -> None:
    for calculation in CALCULATIONS:
        content = document["paths"][calculation.path]["post"]["requestBody"]["content"]["application/json"]
        assert content["examples"]


def test_errors_are_problem_documents(document: dict[str, Any]) -> None:
    for calculation in CALCULATIONS:
        responses = document["paths"][calculation.path]["post"]["responses"]
        for status in ("422", "503", "504"):
            assert list(responses[status]["content"]) == ["application/problem+json"]
    assert "HTTPValidationError" not in json.dumps(document)
