"""The declaration of every field of a request or an answer contains all that the pages and the JSON schema need."""

import pickle
from collections import Counter
from functools import cache
from itertools import pairwise
from typing import Any

import pytest

from app.calculations import BY_PATH, CALCULATIONS
from app.schema.fields import ITEM, Leaf, branches, headlines, leaf_at, leaves
from app.schema.model import Documented
from app.schema.quantities import split_unit

REQUESTS = [each.request for each in CALCULATIONS]
RESPONSES = [each.response for each in CALCULATIONS]
MODELS = [*REQUESTS, *RESPONSES]
IDS = [model.__name__ for model in MODELS]
RESPONSE_IDS = [model.__name__ for model in RESPONSES]
REQUEST_IDS = [model.__name__ for model in REQUESTS]


@cache
def document_of(model: type[Documented]) -> dict[str, Any]:
    return model.model_json_schema(mode="serialization")


def schema_of(model: type[Documented], path: str) -> dict[str, Any]:
    """Return the part of the JSON schema that describes the field at `path`."""
    document = document_of(model)
    place: dict[str, Any] = document
    for name in (part for part in path.split(".") if part != ITEM):
        place = definition(document, place)["properties"][name]
    return place


def definition(document: dict[str, Any], field: dict[str, Any]) -> dict[str, Any]:
    """Return the definition of the section in a field, also if the section is optional or in a list.

    If the field has no section, return the field.
    """
    kinds = [field, *field.get("anyOf", ())]
    kinds += [kind["items"] for kind in kinds if "items" in kind]
    reference = next((kind["$ref"] for kind in kinds if "$ref" in kind), None)
    return document["$defs"][reference.rpartition("/")[2]] if reference else field


@pytest.mark.parametrize("model", REQUESTS, ids=REQUEST_IDS)
def test_sections_of_a_request_can_be_kept(model: type[Documented]) -> None:
    """Workers hand requests over and keep them pickled, which needs the class of every section in its module."""
    for branch in branches(model).values():
        assert pickle.dumps(branch.model)


@pytest.mark.parametrize("model", MODELS, ids=IDS)
def test_every_leaf_says_what_it_is(model: type[Documented]) -> None:
    for leaf in leaves(model):
        _, unit = split_unit(leaf.path.rpartition(".")[2])
        assert leaf.title, leaf.path
        assert leaf.declared.description, leaf.path
        assert leaf.unit or unit is None, leaf.path
        assert leaf.declared.symbol or leaf.unit is None, f"{leaf.path} has a unit and no symbol"


@pytest.mark.parametrize("model", MODELS, ids=IDS)
def test_schema_and_walk_agree(model: type[Documented]) -> None:
    for leaf in leaves(model):
        field = schema_of(model, leaf.path)
        assert leaf.title.startswith(field["title"]), leaf.path
        assert field["description"] == leaf.declared.description
        assert field.get("x-unit") == leaf.unit
        assert field.get("x-symbol") == leaf.declared.symbol
        assert field.get("x-source") == leaf.declared.source
        assert field.get("x-assumed") == leaf.declared.assumed
        assert field.get("x-default-text") == leaf.declared.default_text
        assert field.get("x-tolerance") == leaf.declared.tolerance
        assert bool(field.get("x-axis")) == bool(leaf.axes)
        assert field.get("x-limit") == leaf.view.limit
        assert field.get("x-headline") == leaf.view.headline


@pytest.mark.parametrize("model", MODELS, ids=IDS)
def test_titles_stand_alone(model: type[Documented]) -> None:
    titles = Counter(leaf.title for leaf in leaves(model))
    assert [title for title, count in titles.items() if count > 1] == []
    for title in titles:
        assert ";" not in title
        assert ":" not in title
        assert title.split()[0] not in {"at", "of", "by", "in", "into", "where", "the", "whether"}, title


@pytest.mark.parametrize("model", MODELS, ids=IDS)
def test_symbols_are_written_alike(model: type[Documented]) -> None:
    """A symbol has at most one underscore, before its subscript. Symbols of temperatures begin with θ."""
    for leaf in leaves(model):
        for part in (leaf.declared.symbol or "").replace("/", " ").replace(",", " ").split():
            assert part.count("_") <= 1, leaf.path
            assert not part.endswith("_"), leaf.path
        if leaf.unit == "°C":
            assert (leaf.declared.symbol or "").startswith("θ"), leaf.path


@pytest.mark.parametrize("response", RESPONSES, ids=RESPONSE_IDS)
def test_curves_have_axes(response: type[Documented]) -> None:
    """Every list in an answer names its axes, is itself the axis of a field, or declares the meaning of its index."""
    answer = {leaf.path: leaf for leaf in leaves(response)}
    abscissas = {axis for leaf in answer.values() for axis in leaf.axes}
    for leaf in answer.values():
        if leaf.kind == "other":
            continue
        assert all(answer[axis].dimensions == 1 for axis in leaf.axes), leaf.path
        assert len(leaf.axes) in {0, leaf.dimensions}, leaf.path
        assert not leaf.dimensions or leaf.axes or leaf.declared.index or leaf.path in abscissas, leaf.path


@pytest.mark.parametrize("each", CALCULATIONS, ids=RESPONSE_IDS)
def test_limits_are_numbers_or_fields(each: Any) -> None:
    known = {leaf.path: leaf for leaf in (*leaves(each.request), *leaves(each.response))}
    for leaf in leaves(each.response):
        if isinstance(leaf.view.limit, str):
            assert known[leaf.view.limit].unit == leaf.unit, leaf.path


@pytest.mark.parametrize("response", RESPONSES, ids=RESPONSE_IDS)
def test_headlines_are_few_scalars(response: type[Documented]) -> None:
    ranks = [leaf.view.headline for leaf in headlines(response)]
    assert ranks[0] == 1
    assert {*ranks} == {*range(1, len({*ranks}) + 1)}
    assert len({*ranks}) <= 4
    assert all(leaf.is_scalar for leaf in headlines(response))


@pytest.mark.parametrize("request_model", REQUESTS, ids=REQUEST_IDS)
def test_defaults_explain_themselves(request_model: type[Documented]) -> None:
    for leaf in leaves(request_model):
        if leaf.nullable and leaf.kind in {"number", "integer"} and not leaf.required and not leaf.exclusive:
            assert leaf.declared.default_text, leaf.path
        assert not (leaf.declared.assumed and leaf.required), leaf.path
        assert leaf.declared.tolerance is None or leaf.kind == "number", leaf.path


@pytest.mark.parametrize("request_model", REQUESTS, ids=REQUEST_IDS)
def test_exclusive_fields_exist_and_know_each_other(request_model: type[Documented]) -> None:
    fields = {leaf.path: leaf for leaf in leaves(request_model)}
    for leaf in fields.values():
        for fellow in leaf.exclusive:
            if fellow in fields:
                assert leaf.path in fields[fellow].exclusive
                assert fields[fellow].nullable
            else:  # a section
                assert any(path.startswith(f"{fellow}.") for path in fields)


@pytest.mark.parametrize("request_model", REQUESTS, ids=REQUEST_IDS)
def test_model_options_are_advanced(request_model: type[Documented]) -> None:
    assert all(leaf.advanced == leaf.path.startswith("model.") for leaf in leaves(request_model) if not oil_law(leaf))


def oil_law(leaf: Leaf) -> bool:
    return leaf.path in {"lubricant.pressure_viscosity_law", "lubricant.compressible"}


@pytest.mark.parametrize(
    ("model", "path", "title", "symbol"),
    [
        ("request", "modifications.lead_crowning_um", "helix crowning", "C_β"),
        ("request", "temperatures.bulk_c", "bulk temperature", "θ_M"),
        ("request", "temperatures.scuffing_c", "scuffing temperature", "θ_S"),
        ("response", "film.thickness_ratio", "specific film thickness", "λ"),
        ("response", "safety.blok_factor", "safety factor (flash temperature method)", "S_B"),
        ("response", "load.face_load_factor", "face load factor", "K_Hβ"),
        ("response", "load.max_at.gamma", "profile parameter, place of the largest line load", "Γ"),
        ("response", "pressure.max_at.gamma", "profile parameter, place of the largest pressure", "Γ"),
    ],
)
def test_terms_of_the_field(model: str, path: str, title: str, symbol: str) -> None:
    leaf = leaf_at(getattr(BY_PATH["/v1/scuffing"], model), path)
    assert (leaf.title, leaf.declared.symbol) == (title, symbol)


def test_list_items_are_found_by_their_index() -> None:
    pumping = BY_PATH["/v1/pumping"].request
    leaf = leaf_at(pumping, "grooves.12.width_mm")
    assert leaf.path == "grooves.*.width_mm"
    assert (leaf.unit, leaf.kind, leaf.declared.bounds) == ("mm", "number", {"ge": 0.01, "le": 5000})
    assert leaf_at(pumping, "grooves.width_mm") is None
    assert leaf_at(pumping, "gears.pinion") is None


def test_choices_are_the_solvers() -> None:
    flow = leaf_at(BY_PATH["/v1/pumping"].request, "model.flow")
    assert flow.options == ("gas_dynamics", "pocket_chain", "incompressible")
    assert (flow.default, flow.kind) == ("gas_dynamics", "text")


@pytest.mark.parametrize("response", RESPONSES, ids=RESPONSE_IDS)
def test_an_answer_ends_with_what_it_rests_on(response: type[Documented]) -> None:
    names = list(response.model_fields)
    order = ["status", "warnings", "assumptions", "model", "derived", "inputs", "case"]
    assert all(names.index(first) < names.index(second) for first, second in pairwise(order))
    assert names[:2] == ["status", "warnings"]
    assert names[-7:] == ["assumptions", "model_version", "sources", "model", "derived", "inputs", "case"]
