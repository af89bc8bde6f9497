"""The form of a case sends exactly this case, and an edit of one field changes only this field."""

from functools import cache
from typing import Any

import httpx
import pytest

from app.calculations import BY_PATH
from app.examples import examples
from app.pages import views
from app.pages.cases import Asked
from app.pages.query import PICK, WRITTEN, Pairs, body_of, from_form, normalised, pairs_of
from app.pages.results import flattened
from app.pages.templating import page_path
from tests.support.forms import read_form
from tests.support.properties import one_per_endpoint

GENERATOR = "starter-generator-gear-drive-train"
STIFFNESS = "wheel_shaft.bearings.0.stiffness_n_per_um"
EDITED = {
    "contact.line_load_n_per_mm",
    "gears.face_width_mm",
    "load.pinion_torque_n_m",
    "load.power_kw",
    "operation.pinion_speed_rpm",
    "operation.power_kw",
    "operation.torque_n_m",
}
FIRST = {example.endpoint: name for name, example in reversed(examples().items()) if example.starter}


@cache
def form_of(name: str) -> tuple[Pairs, dict[str, list[str]]]:
    """Return the fields of the form of an example, and the texts that each select offers. Nothing is solved."""
    example = examples()[name]
    calculation = BY_PATH[example.endpoint]
    asked = Asked(page_path(calculation), pairs_of(example.request))
    return read_form(views.form_page(asked).content.decode())


def sent(name: str, pairs: Pairs) -> dict[str, Any]:
    """Return the inputs of the request that the form sends with these texts. The keys are the paths of the inputs."""
    model = BY_PATH[examples()[name].endpoint].request
    return flattened(body_of(model, normalised(model, from_form(model, pairs))))


def edited(text: str, offers: list[str] | None) -> str:
    """Return a text that differs from the text of a field. If the field is a select, choose one of its `offers`."""
    if offers:
        return next(each for each in offers if each != text)
    items = text.split(",")
    try:
        number = float(items[0])
    except ValueError:
        return f"{text}x"
    items[0] = str(int(number) + 1) if number.is_integer() else f"{1.25 * number:.6g}"
    return ",".join(items)


def test_an_oil_is_picked_by_its_name() -> None:
    name = "starter-high-speed-scuffing"  # its oil is a grade, whose text stays in the form
    choice = {"pick:lubricant.iso_vg": "lubricant.name", "lubricant.name": "Mobil SHC 624"}
    pairs = [(field, choice.get(field, text)) for field, text in form_of(name)[0]]
    found = {path: value for path, value in sent(name, pairs).items() if path.startswith("lubricant.")}
    assert found == {"lubricant.name": "Mobil SHC 624"}


@pytest.mark.parametrize("name", one_per_endpoint(examples()))
def test_the_form_sends_the_case(name: str) -> None:
    pairs, _ = form_of(name)
    model = BY_PATH[examples()[name].endpoint].request
    body = body_of(model, normalised(model, from_form(model, pairs)))
    assert model.model_validate(body) == model.model_validate(examples()[name].request)


@pytest.mark.parametrize("name", one_per_endpoint(examples()))
def test_an_edit_changes_one_field(name: str) -> None:
    pairs, offers = form_of(name)
    before, count = sent(name, pairs), 0
    for place, (field, text) in enumerate(pairs):
        if field.startswith(PICK) or field == WRITTEN or not text:
            continue
        after = sent(name, [*pairs[:place], (field, edited(text, offers.get(field))), *pairs[place + 1 :]])
        changed = {path for path in before.keys() | after.keys() if before.get(path) != after.get(path)}
        assert changed == {path for path in before if field == path or field.startswith(f"{path}.")}, field
        count += 1
    assert count >= 5


@pytest.mark.parametrize("name", sorted(FIRST.values()))
@pytest.mark.ci
def test_the_first_example_is_computed_after_an_edit(name: str, client: httpx.Client) -> None:
    example = examples()[name]
    pairs, _ = form_of(name)
    place = next(place for place, (field, _) in enumerate(pairs) if field in EDITED)
    field, text = pairs[place]
    pairs = [*pairs[:place], (field, f"{float(text) * 1.04:.6g}"), *pairs[place + 1 :]]
    path = page_path(BY_PATH[example.endpoint])
    answer = client.get(path, params=dict(pairs), follow_redirects=True)
    assert answer.status_code == 200
    again, _ = read_form(answer.text)
    assert sent(name, again) == sent(name, pairs)


def test_a_matrix_is_typed_element_by_element() -> None:
    pairs = dict(pairs_of(examples()[GENERATOR].request))
    model = BY_PATH["/v1/drive-train"].request

    def stiffness(**texts: str) -> Any:
        others = {name: text for name, text in pairs.items() if not name.startswith(STIFFNESS)}
        typed = {f"{STIFFNESS}.{place[1]}.{place[2]}": text for place, text in texts.items()}
        body = body_of(model, normalised(model, list((others | typed).items())))
        return body["wheel_shaft"]["bearings"][0].get("stiffness_n_per_um")

    assert stiffness(k00="420", k01="1,5", k10="-90", k11="5.6e2") == [[420, 1.5], [-90, 560]]
    assert stiffness(k00="420") == 420
    assert stiffness(k00="420", k11="560") == [[420, None], [None, 560]]
    assert stiffness(k11="560") == [[None, None], [None, 560]]
    assert stiffness() is None


def test_the_generator_unit_survives_another_power(client: httpx.Client) -> None:
    pairs, _ = form_of(GENERATOR)
    texts = dict(pairs)
    assert texts["operation.power_kw"] == "2500"
    assert [texts[f"{STIFFNESS}.{row}.{column}"] for row in "01" for column in "01"] == ["420", "160", "-90", "560"]
    assert texts["pinion_shaft.bearings.0.stiffness_n_per_um.0.0"] == "380"
    answer = client.get("/drive-train", params=texts | {"operation.power_kw": "2600"}, follow_redirects=True)
    assert answer.status_code == 200
    assert "stiffness_n_per_um.1.0=-90" in str(answer.url)


def test_an_element_that_is_missing_is_named(client: httpx.Client) -> None:
    texts = dict(form_of(GENERATOR)[0]) | {f"{STIFFNESS}.1.0": ""}
    answer = client.get("/drive-train", params=texts, follow_redirects=True)
    assert answer.status_code == 422
    assert f'id="f.{STIFFNESS}.1.0-fault">' in answer.text
