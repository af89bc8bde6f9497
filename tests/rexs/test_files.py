"""Reading and writing files, whatever comes."""

import io
import json
import zipfile
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.errors import Unprocessable
from app.rexs.answer import with_answer
from app.rexs.document import read, with_attributes
from app.rexs.model import Attribute
from app.rexs.unit import gear_unit
from tests.rexs.units import Unit, three_stages, turbo_unit

MOST_BYTES = 20_000_000
ANSWER = {
    "status": "ok",
    "case": "ab",
    "load": {"face_load_factor": 1.25},
    "safety": {"blok_factor": 3.5, "verdict": "low"},
}


def model(body: str, version: str = "1.4") -> bytes:
    return f'<model version="{version}" applicationId="a" applicationVersion="1" date="d">{body}</model>'.encode()


def archive(*names: str, content: bytes = b"<model version='1.4'/>") -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as packed:
        for name in names:
            packed.writestr(name, content)
    return buffer.getvalue()


BOMB = b'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b0 "lol">' + b"".join(
    b'<!ENTITY b%d "%s">' % (i, b"&b%d;" % (i - 1) * 10) for i in range(1, 10)
)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "empty"),
        (b" \n", "empty"),
        (b"hello", "line 1"),
        (b"<a/>", "outermost"),
        (b"<component id='1'/>", "outermost"),
        (b"<model", "line 1"),
        (model("", version="3.0"), "version"),
        (b"<model/>", "version"),
        (BOMB + b"]><model version='1.4' a='&b9;'/>", "line 1"),
        (BOMB + b"]><model version='1.4'>&b9;</model>", "line 1"),
        (b"<!DOCTYPE a [<!ENTITY b SYSTEM 'file:///etc/hostname'>]><model version='1.4'>&b;</model>", "document type"),
        (b"<model version='1.4'>" + b"<a>" * 1000, "line 1"),
        (model("<components>" + "<c/>" * 1_600_000 + "</components>"), "tags"),
        (model("<components><component type='shaft'/></components>"), "whole number"),
        (model("<components><component id='--1'/></components>"), "whole number"),
        (model("<components><component id='1'/><component id='1'/></components>"), "twice"),
        (model("<relations><relation id='1' type='x'><ref id='z' role='a'/></relation></relations>"), "whole number"),
        (b'{"model": 1}', "model"),
        (b'{"model": {"version": "1.4", "components": [1]}}', "components"),
        (b'{"model": {"version": "1.4", "components": [{"id": "1"}]}}', "whole number"),
        (b'{"model": {"version": "1.4", "x": NaN}}', "JSON"),
        (b'{"model": ' + b"[" * 100_000, "JSON"),
        (b'{"model": [' + b"[]," * 1_600_000 + b"1]}", "objects and arrays"),
        (b'{"model": {"version": "1.4", "applicationId": "\\ud800"}}', "JSON"),
        (b"PK\x03\x04rubbish", "archive"),
        (b"PK" + archive("a.rexs")[10:], "archive"),
        (archive(), "archive"),
        (archive("readme.txt"), "0 models"),
        (archive("a.rexs", "b.rexs"), "2 models"),
        (archive("a.rexs", content=b" " * 30_000_000), "20 MB"),
    ],
)
def test_refused_with_a_reason(content: bytes, words: str) -> None:
    with pytest.raises(Unprocessable) as caught:
        read(content, MOST_BYTES)
    assert caught.value.code == "not_rexs"
    assert words in caught.value.message


def test_a_name_that_leaves_the_archive_is_only_a_name() -> None:
    assert read(archive("../../etc/a.rexs"), MOST_BYTES).model.version == "1.4"


@pytest.mark.parametrize("damage", ["missing", "cycle", "empty"])
def test_broken_graphs_are_findings(damage: str) -> None:
    unit = three_stages()
    if damage == "missing":
        unit.relate("assembly", assembly=1, part=10_000)
    if damage == "cycle":
        unit.relate("assembly", assembly=3, part=1)
    if damage == "empty":
        unit.relations.clear()
    found = gear_unit(read(unit.xml(), MOST_BYTES).model)
    expected = {"missing": "relation", "cycle": "cycle", "empty": "relation_missing"}[damage]
    assert expected in {each["code"] for each in found["findings"]}


def test_many_components_and_shafts_cost_little() -> None:
    shafts = "".join(f'<component id="{i}" type="shaft"/>' for i in range(100_000))
    chain = "".join(
        f'<relation id="{i}" type="assembly"><ref id="{i}" role="assembly"/><ref id="{i + 1}" role="part"/></relation>'
        for i in range(20_000)
    )
    found = gear_unit(read(model(f"<relations>{chain}</relations><components>{shafts}</components>"), MOST_BYTES).model)
    assert found["stages"] == []


def test_results_are_written_and_nothing_is_lost() -> None:
    unit = turbo_unit("2.0")
    document = read(unit.xml(), MOST_BYTES)
    before = document.model
    stage = next(each.id for each in before.components.values() if each.type == "cylindrical_stage")
    content = with_answer(document, stage, "/v1/scuffing", ANSWER).content
    after = read(content, MOST_BYTES).model
    added = {
        "face_load_factor_contact_stress": ("none", "1.25"),
        "custom_tribodrive_scuffing_safety_blok": ("none", "3.5"),
        "custom_tribodrive_scuffing_risk": ("none", "low"),
        "custom_tribodrive_status": ("none", "ok"),
        "custom_tribodrive_case": ("none", "ab"),
    }
    written = {name: each for name, each in after.components[stage].attributes.items() if name in added}
    assert {name: (each.unit, each.value) for name, each in written.items()} == added
    for name in added:
        del after.components[stage].attributes[name]
    assert (after.components, after.relations) == (before.components, before.relations)
    assert list(after.components) == list(before.components)
    assert b"<!-- kept -->" in content
    ET.fromstring(content)  # noqa: S314  our own


def test_before_version_2_a_standard_name_is_custom() -> None:
    document = read(turbo_unit("1.7").json(), MOST_BYTES)
    stage = next(each.id for each in document.model.components.values() if each.type == "cylindrical_stage")
    content = with_answer(document, stage, "/v1/scuffing", ANSWER).content
    attributes = read(content, MOST_BYTES).model.components[stage].attributes
    assert attributes["custom_tribodrive_face_load_factor_contact_stress"].value == 1.25
    assert "face_load_factor_contact_stress" not in attributes


def test_results_written_twice_are_there_once() -> None:
    for content in (turbo_unit().xml(), turbo_unit().json()):
        stage = 3
        for factor in (1.25, 1.5):
            file = read(content, MOST_BYTES).file
            file = with_attributes(file, stage, [Attribute("custom_tribodrive_x", "none", factor)])
            content = file.content  # noqa: PLW2901  the file goes round
        assert content.count(b"custom_tribodrive_x") == 1
        assert float(read(content, MOST_BYTES).model.components[stage].attributes["custom_tribodrive_x"].value) == 1.5


words = st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Cs"]), max_size=8)
names = st.text("abcdefghij_", min_size=1, max_size=12)
values = st.one_of(st.floats(allow_nan=False, allow_infinity=False), st.booleans(), words)


@st.composite
def units(draw: st.DrawFn) -> Unit:
    unit = Unit(draw(st.sampled_from(["1.0", "1.7", "2.0"])))
    for _ in range(draw(st.integers(1, 5))):
        attributes: dict[str, Any] = draw(st.dictionaries(names, st.tuples(values, st.sampled_from(["mm", "deg", ""]))))
        unit.add(draw(names), draw(words), **attributes)
    for _ in range(draw(st.integers(0, 4))):
        roles = draw(st.dictionaries(names, st.integers(1, len(unit.components)), min_size=1, max_size=3))
        unit.relate(draw(names), draw(st.one_of(st.none(), st.integers(1, 9))), **roles)
    return unit


@given(units())
def test_random_models_come_back(unit: Unit) -> None:
    written = json.loads(unit.json())
    file, found = read(unit.json(), MOST_BYTES)
    assert [each["id"] for each in written["model"]["components"]] == list(found.components)
    assert read(with_attributes(file, unit.components[0]["id"], []).content, MOST_BYTES).model == found
    for each in unit.components:
        attributes = found.components[each["id"]].attributes
        assert {name: (a.value, a.unit) for name, a in attributes.items()} == each["attributes"]
