"""An output costs one declaration in the solver's result and one in the response."""

import json
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Annotated, Any, ClassVar

import pytest

from app.calculations import CALCULATIONS
from app.evaluate import evaluate
from app.formats.json import written
from app.library import examples
from app.schema.base import Group
from app.schema.conversion import from_si
from app.schema.coupling import CouplingResponse
from app.schema.fields import leaf_at
from app.schema.quantities import Output
from solvers.coupling.results import CouplingResult


@dataclass(frozen=True, kw_only=True)
class WiderResult(CouplingResult):
    """A result that knows one thing more."""

    longest_day: float


class WiderResponse(CouplingResponse):
    """And the response that shows it."""

    longest_day_mm: Annotated[float | None, Output("longest day", "d", headline=1)] = None


def test_an_output_is_one_line_in_each_layer() -> None:
    calculation = CALCULATIONS[0]
    request = calculation.request.model_validate(examples()["pahl-z-arrangement"].request)

    def solve(inputs: Any) -> WiderResult:
        result = calculation.solve(inputs)
        fields = {name: getattr(result, name) for name in CouplingResult.__dataclass_fields__}
        return WiderResult(**fields, longest_day=0.25)

    wider = replace(calculation, solve=solve, response=WiderResponse)
    answer = json.loads(written(evaluate(wider, request)))
    assert answer["longest_day_mm"] == 250.0
    assert list(answer)[-7:] == ["assumptions", "model_version", "sources", "model", "derived", "inputs", "case"]

    leaf = leaf_at(WiderResponse, "longest_day_mm")
    assert leaf is not None
    assert (leaf.title, leaf.unit, leaf.symbol, leaf.headline) == ("longest day", "mm", "d", 1)
    schema = WiderResponse.model_json_schema(mode="serialization")["properties"]["longest_day_mm"]
    assert (schema["title"], schema["x-unit"], schema["x-headline"]) == ("longest day", "mm", 1)


class Inner(Group):
    """What another calculation answers."""

    width_mm: Annotated[float, Output("width")]


class Outer(Inner):
    """And what is built on it."""

    held: ClassVar = {Inner: "inner"}
    height_mm: Annotated[float, Output("height")]
    depth_mm: Annotated[float | None, Output("depth", of="deep")]


@pytest.mark.parametrize(("deep", "depth"), [(SimpleNamespace(depth=0.5), 500.0), (None, None)])
def test_an_output_is_read_from_the_member_that_holds_it(deep: object, depth: float | None) -> None:
    result = SimpleNamespace(inner=SimpleNamespace(width=0.001, height=9.0), height=0.002, deep=deep)
    assert from_si(Outer, result, "summary") == {"width_mm": 1.0, "height_mm": 2.0, "depth_mm": depth}
