"""Requests as users send them, and functions that change requests and read answers.

Some functions solve or check a request in this process, without a server.
"""

import copy
import json
from collections.abc import Callable, Mapping
from typing import Any

import httpx
import pytest
from pydantic import ValidationError

from app.calculations import BY_PATH
from app.errors import Fault
from app.evaluate import evaluate, written
from app.examples import examples
from app.schema.reading import faults

Post = Callable[[str, object], httpx.Response]
GONE = object()
"""A field that is changed to this value is removed from the request."""

PAIR: dict[str, Any] = {
    "gears": {
        "pinion": {"teeth": 23},
        "wheel": {"teeth": 30},
        "module_mm": 3,
        "helix_angle_deg": 9.8,
        "face_width_mm": 20,
    },
    "load": {"power_kw": 50, "pinion_speed_rpm": 2000},
    "model": {"lubrication": "closed_form"},
}
COUPLING: dict[str, Any] = {
    "coupling": {"teeth": 52, "module_mm": 3},
    "operation": {"torque_n_m": 3000, "speed_rpm": 1910, "misalignment_deg": 0.05},
}
MIST: dict[str, Any] = {
    "gears": {"pinion": {"teeth": 47}, "wheel": {"teeth": 117}, "module_mm": 7, "face_width_mm": 200},
    "operation": {"pinion_speed_rpm": 3000},
}
CONTACT: dict[str, Any] = {
    "contact": {"line_load_n_per_mm": 273, "radius_mm": 4.015, "speed_1_m_per_s": 1.018, "speed_2_m_per_s": 3.708},
    "model": {"thermal": False},
}


def solved(endpoint: str, body: dict[str, Any], changes: Mapping[str, Any] = {}) -> dict[str, Any]:
    """Change a request at dotted paths, solve the request in this process and return the answer."""
    # The answer has the detail "summary" unless `changes` sets another detail.
    calculation = BY_PATH[endpoint]
    request = calculation.request.model_validate(changed(body, {"detail": "summary", **changes}))
    return json.loads(written(evaluate(calculation, request)))


def example(name: str, changes: Mapping[str, Any] = {}) -> dict[str, Any]:
    """Return the request of an example, with changes at dotted paths."""
    return changed(examples()[name].request, changes)


def changed(body: dict[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return a copy of a request with new values at dotted paths. The value `GONE` removes a field."""
    # A number in a path is an index of a list.
    result = copy.deepcopy(body)
    for path, value in changes.items():
        *way, last = path.split(".")
        place: Any = result
        for part in way:
            place = place[int(part)] if part.isdecimal() else place.setdefault(part, {})
        if value is GONE:
            place.pop(last, None)
        else:
            place[last] = value
    return result


def value_at(answer: dict[str, Any], path: str) -> Any:
    """Return the value at a dotted path of an answer. A number in the path is an index of a list."""
    place: Any = answer
    for part in path.split("."):
        place = place[int(part)] if part.isdecimal() else place[part]
    return place


def accepted(response: httpx.Response) -> dict[str, Any]:
    """Check that the status of a response is 200, and return the answer."""
    assert response.status_code == 200, response.text
    return response.json()


def refusals(response: httpx.Response) -> list[tuple[str, str]]:
    """Check that the service has refused a request, and return the code and the dotted path of each fault."""
    assert response.status_code == 422, response.text
    assert response.headers["content-type"] == "application/problem+json"
    return [(each["code"], each["pointer"][1:].replace("/", ".")) for each in response.json()["errors"]]


def assumptions(answer: dict[str, Any]) -> dict[str, Any]:
    """Return a dictionary from each assumed field of an answer to the assumed value."""
    return {each["field"]: each["value"] for each in answer["assumptions"]}


def warned(answer: dict[str, Any]) -> dict[str, Any]:
    """Return a dictionary from the code of each warning in an answer to the field of the warning."""
    return {each["code"]: each["field"] for each in answer["warnings"]}


def refused(endpoint: str, body: dict[str, Any], changes: Mapping[str, Any]) -> str:
    """Return the message of the first fault of a changed request."""
    return all_faults(endpoint, body, changes)[0].message


def all_faults(endpoint: str, body: dict[str, Any], changes: Mapping[str, Any]) -> list[Fault]:
    """Check that a changed request is not valid, and return its faults."""
    model = BY_PATH[endpoint].request
    with pytest.raises(ValidationError) as refusal:
        model.model_validate(changed(body, changes))
    return faults(model, refusal.value.errors())
