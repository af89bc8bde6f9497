"""Quantities are shown in their units, as text and in dictionaries, and values outside their ranges are refused."""

from collections.abc import Callable
from functools import cache
from math import isclose
from typing import Any

import httpx
import numpy as np
import pytest

from app.calculations import BY_PATH
from app.examples import examples
from solvers.coupling.inputs import Coupling
from solvers.errors import InvalidInput
from solvers.guards import checked
from solvers.quantity import quantity, record, to_dict
from tests.support.properties import one_per_endpoint

NAMES = (
    "pahl-heavily-crowned",
    "milian-case-1",
    "xue-pair-1-modified",
    "xue-line-contact-isothermal",
    "starter-turbo-gear-drive-train",
)


@record
class Film:
    thickness: float = quantity("film thickness", "h", unit="um")
    temperature: float = quantity("temperature", unit="c")


@record
class Contact:
    film: Film = quantity("film")
    pressures: np.ndarray[Any, Any] = quantity("pressures", unit="mpa")
    law: str = quantity("law")
    speed: float | None = quantity("speed", unit="m_per_s")


CONTACT = Contact(Film(2e-6, 373.15), np.array([1e6, np.nan]), "Barus", None)


@cache
def solved(name: str) -> tuple[Any, Any]:
    example = examples()[name]
    calculation = BY_PATH[example.endpoint]
    inputs = calculation.request.model_validate(example.request).inputs()
    return inputs, calculation.solve(inputs)


def test_a_record_prints_with_its_units() -> None:
    assert repr(CONTACT) == "Contact(film=Film(...), pressures=array(2,) MPa, law='Barus', speed=None)"
    assert repr(CONTACT.film) == "Film(thickness=2 µm, temperature=100 °C)"


def test_a_dictionary_has_units_in_its_names_and_none_for_gaps() -> None:
    assert to_dict(CONTACT) == {
        "film": {"thickness_um": pytest.approx(2.0), "temperature_c": pytest.approx(100.0)},
        "pressures_mpa": [pytest.approx(1.0), None],
        "law": "Barus",
        "speed_m_per_s": None,
    }


@pytest.mark.parametrize("name", NAMES)
def test_inputs_and_results_print_in_a_few_lines(name: str) -> None:
    for each in solved(name):
        assert len(repr(each)) < 2000


@pytest.mark.parametrize("name", one_per_endpoint(NAMES))
def test_the_dictionary_of_a_result_is_the_service_s_answer(
    name: str, post: Callable[[str, object], httpx.Response]
) -> None:
    example = examples()[name]
    answer = post(example.endpoint, {**example.request, "detail": "fields"}).json()
    shown = to_dict(solved(name)[1])
    assert compared(shown, answer) > 20


def compared(shown: Any, answer: Any) -> int:
    """Compare the numbers that have equal names, and return how many numbers were compared."""
    if isinstance(shown, dict) and isinstance(answer, dict):
        return sum(compared(shown[key], answer[key]) for key in shown.keys() & answer.keys())
    if isinstance(shown, list) and isinstance(answer, list) and len(shown) == len(answer):
        return sum(compared(*pair) for pair in zip(shown, answer, strict=True))
    if isinstance(shown, float) and isinstance(answer, float):
        assert isclose(answer, shown, rel_tol=1e-9, abs_tol=1e-12)
        return 1
    return 0


def test_millimetres_given_as_metres_are_refused_by_name() -> None:
    with pytest.raises(InvalidInput, match=r"module is 3000 mm; permissible: 0\.1 to 100 mm"):
        checked(Coupling(teeth=52, module=3.0))
    with pytest.raises(InvalidInput, match="pressure_angle is 1145"):
        checked(Coupling(teeth=52, module=3e-3, pressure_angle=20.0))
