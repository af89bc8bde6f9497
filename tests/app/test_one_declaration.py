"""A new input, a new output or a new endpoint of a calculation is declared in one place.

An input needs one declaration and its use in the solver. An output needs one declaration and its value. An endpoint
needs one row and its solver. Nothing else of `app` changes.
"""

import asyncio
import json
from collections.abc import Callable
from dataclasses import replace
from typing import Annotated, Any, ClassVar

import httpx
import numpy as np
import pytest
from fastapi import FastAPI

from app import calculations
from app.calculations import Calculation
from app.errors import InvalidBody, Unprocessable
from app.evaluate import evaluate, written
from app.http.routes.calculations import add
from app.models.kernels import COUPLING, Kernels
from app.pages import csv
from app.pages.form import FieldView, FormState, form
from app.pages.results import entries
from app.pages.templating import page_path
from app.schema.answers import Group, Response, group, shown
from app.schema.fields import leaf_at
from app.schema.model import Request, Section
from app.schema.quantities import Input, View
from app.schema.reading import validated
from app.settings import settings
from app.studies.points import Question, solve_point
from solvers.arrays import FloatArray
from solvers.coupling.inputs import Coupling
from solvers.errors import InvalidInput
from solvers.guards import checked
from solvers.notices import Notice
from solvers.quantity import quantities, quantity, record


@record
class Spring:
    """A spring under load. Lengths are in m, forces are in N."""

    force: float = quantity("force", "F", unit="n", ge=0, le=1e4)
    stiffness: float = quantity("stiffness", "k", "Hooke 1678", unit="n_per_um", default=2.0, gt=0, le=100)


@record
class Deflection:
    """The result for a spring under load."""

    deflection: float = quantity("deflection", "s", unit="um")
    warnings: tuple[Notice, ...] = ()


@record
class LongSpring(Spring):
    """A spring with one more input, which needs only this declaration."""

    preload: float = quantity(
        "preload", "F_0", unit="n", default=10.0, ge=0, le=100, tolerance=0.5, assumed="order of magnitude"
    )


@record
class LongDeflection:
    """A result that adds an output and a curve. Nothing else declares the output and the curve."""

    deflection: float = quantity("deflection", "s", unit="um")
    energy: float = quantity("stored energy", "W", unit="j", text="of the spring under load")
    load: FloatArray = quantity("load", "F", unit="n", detail="curves")
    way: FloatArray = quantity("way", "s", unit="mm", detail="curves", axis="load")
    warnings: tuple[Notice, ...] = ()


def solve(spring: Spring) -> Deflection:
    return Deflection(spring.force / spring.stiffness)


def solve_long(spring: LongSpring) -> LongDeflection:
    """Compute the result of a spring with preload. If `preload` were not used here, it would change no output."""
    total = spring.force + spring.preload
    load = np.linspace(0.0, total, 3)
    return LongDeflection(total / spring.stiffness, total**2 / (2 * spring.stiffness), load, load / spring.stiffness)


def calculation(inputs: type[Any], result: type[Any], solver: Any) -> Calculation:
    """Return the calculation for a solver of springs. Its code is the same whatever the dataclasses declare."""

    class SpringSection(Section, of=inputs):
        """The section of the request that describes the spring."""

    class SpringRequest(Request):
        """A request for one spring."""

        spring: Annotated[SpringSection, Input("spring")]

        def inputs(self) -> Any:
            return self.spring.si(inputs)

        def options(self) -> dict[str, Any]:
            return {}

    return Calculation(
        path="/v1/spring",
        title="Spring",
        summary="A spring",
        source="Hooke",
        request=SpringRequest,
        solve=solver,
        response=group(result, "SpringResponse", base=Response, stands=False, deflection=View(headline=1)),
        kernels=Kernels(COUPLING),
    )


SHORT = calculation(Spring, Deflection, solve)
LONG = calculation(LongSpring, LongDeflection, solve_long)


def answered(chosen: Calculation, **spring: float) -> dict[str, Any]:
    request = validated(chosen.request, {"spring": {"force_n": 30, **spring}})
    found: dict[str, Any] = json.loads(written(evaluate(chosen, request)))
    return found


def test_the_answer_has_the_new_input_and_the_new_outputs() -> None:
    before, after = answered(SHORT), answered(LONG)
    assert before["inputs"] == {"spring": {"force_n": 30.0, "stiffness_n_per_um": 2.0}}
    assert after["inputs"] == {"spring": {"force_n": 30.0, "stiffness_n_per_um": 2.0, "preload_n": 10.0}}
    assert before["deflection_um"] == pytest.approx(15.0)
    assert after["deflection_um"] == pytest.approx(20.0)
    assert after["energy_j"] == pytest.approx(4e-4)
    assert after["load_n"] == [0.0, 20.0, 40.0]
    assert after["way_mm"] == pytest.approx([0.0, 0.01, 0.02])
    assert after["assumptions"] == [{"field": "spring.preload_n", "value": 10.0, "reason": "order of magnitude"}]
    assert list(after)[-6:] == [*list(before)[-6:]]


def test_the_input_moves_the_output() -> None:
    assert answered(LONG, preload_n=50)["deflection_um"] == pytest.approx(40.0)
    assert answered(LONG, preload_n=50)["assumptions"] == []


def test_the_level_of_detail_counts() -> None:
    request = validated(LONG.request, {"spring": {"force_n": 30}, "detail": "summary"})
    assert {"energy_j", "load_n"} & set(json.loads(written(evaluate(LONG, request)))) == {"energy_j"}


def test_the_schema_says_what_the_declaration_says() -> None:
    section = LONG.request.model_json_schema()["$defs"]["SpringSection"]["properties"]["preload_n"]
    assert section == {
        "type": "number",
        "minimum": 0,
        "maximum": 100,
        "default": 10.0,
        "title": "preload",
        "description": "preload",
        "x-symbol": "F_0",
        "x-assumed": "order of magnitude",
        "x-tolerance": 0.5,
        "x-unit": "N",
    }
    way = leaf_at(LONG.response, "way_mm")
    assert way is not None
    assert (way.title, way.unit, way.axes, way.detail, way.dimensions) == ("way", "mm", ("load_n",), "curves", 1)
    energy = LONG.response.model_json_schema(mode="serialization")["properties"]["energy_j"]
    assert (energy["title"], energy["description"], energy["x-unit"]) == (
        "stored energy",
        "of the spring under load",
        "J",
    )


@pytest.mark.parametrize("value", [-1, 101, "10", True, float("nan")])
def test_what_is_out_of_range_is_refused(value: object) -> None:
    with pytest.raises(InvalidBody) as refused:
        validated(LONG.request, {"spring": {"force_n": 30, "preload_n": value}})
    assert [fault.pointer for fault in refused.value.faults] == ["/spring/preload_n"]


def test_the_form_asks_for_it() -> None:
    (section,) = (each for each in form(LONG.request, FormState()) if each.path == "spring")
    field = next(block for block in section.blocks if isinstance(block, FieldView) and block.name == "spring.preload_n")
    assert (field.label, field.unit, field.placeholder) == ("preload", "N", "10")


def test_tables_and_files_hold_it() -> None:
    response = evaluate(LONG, validated(LONG.request, {"spring": {"force_n": 30}}))
    rows = {entry.path: (entry.leaf.title, entry.value) for entry in entries(response)}
    assert rows["energy_j"] == ("stored energy", pytest.approx(4e-4))
    assert csv.curve(response, "way_mm") == b"load F [N],way s [mm]\r\n0,0\r\n20,0.01\r\n40,0.02\r\n"


def test_a_sweep_varies_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(calculations.BY_PATH, LONG.path, LONG)
    question = Question(LONG.path, {"spring": {"force_n": 30}}, ["deflection_um", "energy_j"], 30.0)
    points = [solve_point(question, {"spring.preload_n": preload}) for preload in (0, 50)]
    assert [point.out for point in points] == [pytest.approx([15.0, 2.25e-4]), pytest.approx([40.0, 1.6e-3])]


def test_a_solver_s_complaint_names_the_request_s_field() -> None:
    def refuses(_: Spring) -> Deflection:
        raise InvalidInput("too_soft", "take a stiffer spring", "stiffness")

    request = validated(SHORT.request, {"spring": {"force_n": 30}})
    with pytest.raises(Unprocessable) as refused:
        evaluate(replace(SHORT, solve=refuses), request)
    assert refused.value.path == "spring.stiffness_n_per_um"


class PlainRequest(Request, of=LongSpring):
    """A request whose own fields are the inputs of a spring. None of these inputs is declared again."""

    def inputs(self) -> LongSpring:
        return self.si(LongSpring)

    def options(self) -> dict[str, Any]:
        return {}


ROW = replace(LONG, path="/v1/new-spring", request=PlainRequest)
"""A new endpoint, which consists of this row and its solver."""


def test_an_input_at_the_root_is_one_declaration_too() -> None:
    fields = {name: PlainRequest.model_fields[name] for name in ("force_n", "stiffness_n_per_um", "preload_n")}
    assert [field.is_required() for field in fields.values()] == [True, False, False]
    found = json.loads(written(evaluate(ROW, validated(PlainRequest, {"force_n": 30, "preload_n": 50}))))
    assert (found["deflection_um"], found["assumptions"]) == (pytest.approx(40.0), [])
    found = json.loads(written(evaluate(ROW, validated(PlainRequest, {"force_n": 30}))))
    assert [each["field"] for each in found["assumptions"]] == ["preload_n"]
    with pytest.raises(InvalidBody) as refused:
        validated(PlainRequest, {"force_n": 30, "preload_n": 101})
    assert refused.value.faults == [("/preload_n", "less_than_equal", "preload_n is 101; permissible: 0 to 100 N")]


class _AtOnce:
    """Stand-in for the workers and the start-up: it runs a function at once and accepts every endpoint."""

    async def wait(self, _http: object, _stages: object) -> None:
        """Let every request pass."""

    async def calculate(self, _http: object, function: Callable[..., bytes], *arguments: Any) -> bytes:
        return function(*arguments)


def test_an_endpoint_is_one_row_and_its_solver(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(calculations.BY_PATH, ROW.path, ROW)
    service = FastAPI()
    service.state.settings, service.state.pool, service.state.start_up = settings(), _AtOnce(), _AtOnce()
    add(service.router, ROW)

    async def posted(body: dict[str, float]) -> httpx.Response:
        transport = httpx.ASGITransport(app=service)
        async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
            return await client.post(ROW.path, json=body)

    response = asyncio.run(posted({"force_n": 30, "preload_n": 50}))
    assert response.status_code == 200
    assert response.json()["deflection_um"] == pytest.approx(40.0)
    operation = service.openapi()["paths"]["/v1/new-spring"]["post"]
    assert (operation["operationId"], operation["summary"], operation["tags"]) == (
        "new_spring",
        "A spring",
        ["new-spring"],
    )
    assert operation["responses"]["200"]["content"]["application/json"]["schema"]["$ref"].endswith("SpringResponse")
    assert page_path(ROW) == "/new-spring"
    point = solve_point(Question(ROW.path, {"force_n": 30}, ["deflection_um"], 30.0), {"preload_n": 50})
    assert point.out == [pytest.approx(40.0)]


@record
class Inner:
    """The result of another calculation."""

    width: float = quantity("width", unit="mm")


@record
class Outer:
    """A result that contains the result `Inner`. The member `deep` may be missing."""

    inner: Inner
    height: float = quantity("height", unit="mm")
    deep: Spring | None = None


class InnerGroup(Group, of=Inner):
    """A group with a width."""


class OuterGroup(InnerGroup, of=(Outer, Spring)):
    """A group filled from `Outer`, from the `Inner` inside it, and from `deep`, which may be missing."""


@pytest.mark.parametrize(("deep", "force"), [(Spring(5.0), 5.0), (None, None)])
def test_an_output_is_read_from_the_member_that_holds_it(deep: Spring | None, force: float | None) -> None:
    found = shown(OuterGroup, Outer(Inner(0.001), 0.002, deep), "summary")
    stiffness = None if deep is None else 2.0
    assert found == {"width_mm": 1.0, "height_mm": 2.0, "force_n": force, "stiffness_n_per_um": stiffness}


def test_a_section_names_declared_fields_only() -> None:
    with pytest.raises(TypeError, match="names fields that are not declared: colour"):

        class Painted(Section, of=Spring, only=("force", "colour")):
            """A section with the field `colour`, which is not declared."""

    with pytest.raises(TypeError, match="colour"):

        class Judged(Group, of=Spring):
            """A group with a view of the field `colour`, which is not declared."""

            views: ClassVar = {"colour": View(headline=1)}


def test_one_model_stands_for_a_dataclass_whatever_the_order() -> None:
    with pytest.raises(TypeError, match="InnerGroup and Twin both describe Inner"):

        class Twin(Group, of=Inner):
            """A second group for `Inner`, which is rejected."""

    class Other(Group, of=Inner, stands=False):
        """A group for `Inner` that other groups do not use."""

    assert list(Other.model_fields) == ["width_mm"]


def test_defaults_are_written_in_the_shown_unit_and_held_in_si() -> None:
    assert Spring(1.0).stiffness == 2e6
    assert quantities(Spring)["stiffness"].default == 2.0
    assert Coupling(teeth=52, module=3e-3).hub_distance == 0.2


def test_inputs_built_in_python_are_checked_where_the_user_asks_for_it() -> None:
    spring = Spring(force=30.0)
    assert checked(spring) is spring
    with pytest.raises(InvalidInput) as refused:
        checked(replace(spring, stiffness=2e8))
    assert (refused.value.code, refused.value.field) == ("out_of_range", "stiffness")
    assert refused.value.message == "stiffness is 200 N/µm; permissible: above 0 and at most 100 N/µm"
    with pytest.raises(InvalidInput):
        checked(replace(spring, force=float("nan")))
    with pytest.raises(InvalidInput) as refused:
        checked(Coupling(teeth=52, module=3e-3, pitch_errors=(0.0, 1.0)))
    assert refused.value.field == "pitch_errors.1"


def test_a_coupling_s_proportions_follow_the_module() -> None:
    coupling = Coupling(teeth=52, module=3e-3, tooth_height=5e-3)
    assert (coupling.face_width, coupling.tooth_height) == (0.024, 0.005)
