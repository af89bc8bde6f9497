"""REXS files are read and written without loss; unreadable files are refused with a reason."""

import base64
import io
import json
import re
import struct
import zipfile
from hashlib import sha256
from html import unescape
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from hypothesis import strategies as st

from app.errors import Unprocessable
from app.pages.carried import uses
from app.rexs.answer import unit_html, unit_json, with_answer
from app.rexs.document import packed, read, with_attributes
from app.rexs.model import Attribute
from app.rexs.unit import gear_unit
from tests.rexs.units import Unit, three_stages, turbo_unit
from tests.support.pages import asked_by
from tests.support.properties import examples

MOST_BYTES = 20_000_000
ANSWER = {
    "status": "ok",
    "case": "ab",
    "load": {"face_load_factor": 1.25},
    "safety": {"blok_factor": 3.5, "verdict": "low"},
}


def model(body: str, version: str = "1.4") -> bytes:
    return f'<model version="{version}" applicationId="a" applicationVersion="1" date="d">{body}</model>'.encode()


def archive(*names: str, content: bytes = b"<model version='1.4'/>", packing: int = zipfile.ZIP_DEFLATED) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", packing) as packed:
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
        (archive("readme.txt"), "holds 0"),
        (archive("a.rexs", "in/b.rexsj"), "a.rexs, b.rexsj"),
        (archive("a.xml"), "holds 0"),
        (archive("__MACOSX/a.rexs", ".b.rexs"), "holds 0"),
        (archive("a.rexs", packing=zipfile.ZIP_LZMA), "deflate"),
        (
            b'{"model": {"version": "1.4", "x": [1e400]}}',
            "1e400",
        ),
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


@pytest.mark.parametrize("name", ["a.rexs", "B.REXS", "in/a.rexs", "a.rexs.xml", "in\\a.rexsj", "a.rexs.json"])
def test_a_model_among_other_files_of_an_archive(name: str) -> None:
    beside = ("__MACOSX/._a.rexs", "in/.a.rexs", "readme.txt", "sheet.xml", "data.json", "__MACOSX/in/a.rexs")
    assert read(archive(name, *beside), MOST_BYTES).model.version == "1.4"


def test_a_dictionary_of_gigabytes_is_refused() -> None:
    """An LZMA archive is refused, because its decoder would request as much memory as the archive states."""
    packed = bytearray(archive("a.rexs", packing=zipfile.ZIP_LZMA))
    properties = packed.index(b"a.rexs") + len("a.rexs") + 4  # behind version and size of the properties
    packed[properties + 1 : properties + 5] = b"\xff\xff\xff\xff"
    with pytest.raises(Unprocessable):
        read(bytes(packed), MOST_BYTES)


@pytest.mark.parametrize("version", ["1.0", "1.4", "2.0"])
def test_a_default_namespace_is_read_as_if_it_were_not_there(version: str) -> None:
    unit = turbo_unit(version)
    unit.cases = [{1: {"operating_time_fraction": (100.0, "%")}}]
    named = unit.xml().replace(b"<model ", b'<model xmlns="https://example.org/rexs" ')
    file, found = read(named, MOST_BYTES)
    assert found == read(unit.xml(), MOST_BYTES).model
    stage = found.by_type["cylindrical_stage"][0].id
    written = with_attributes(file, stage, [Attribute("custom_tribodrive_x", "none", 1.5)]).content
    assert read(written, MOST_BYTES).model.components[stage].attributes["custom_tribodrive_x"].value == "1.5"
    assert b'xmlns=""' not in written


def test_components_inside_an_element_of_their_own_take_results() -> None:
    content = (
        turbo_unit()
        .xml()
        .replace(b"<components>", b"<part><components>")
        .replace(b"</components>", b"</components></part>")
    )
    document = read(content, MOST_BYTES)
    stage = document.model.by_type["cylindrical_stage"][0].id
    written = read(with_answer(document, [stage], "/v1/scuffing", ANSWER).content, MOST_BYTES).model
    assert "custom_tribodrive_status" in written.components[stage].attributes


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


@pytest.mark.ci
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
    content = with_answer(document, [stage], "/v1/scuffing", ANSWER).content
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
    content = with_answer(document, [stage], "/v1/scuffing", ANSWER).content
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


@examples(100, 1000, units())
def test_random_models_come_back(unit: Unit) -> None:
    written = json.loads(unit.json())
    file, found = read(unit.json(), MOST_BYTES)
    assert [each["id"] for each in written["model"]["components"]] == list(found.components)
    assert read(with_attributes(file, unit.components[0]["id"], []).content, MOST_BYTES).model == found
    for each in unit.components:
        attributes = found.components[each["id"]].attributes
        assert {name: (a.value, a.unit) for name, a in attributes.items()} == each["attributes"]


cells = st.lists(st.floats(allow_nan=False, allow_infinity=False, width=32), max_size=4)
typed = st.one_of(st.floats(allow_nan=False, allow_infinity=False), st.integers(-(10**9), 10**9), st.booleans(), cells,
                  st.text("abcdefgh <>&\"'äöü°µ", max_size=8).map(str.strip))  # fmt: skip


@st.composite
def models(draw: st.DrawFn) -> Unit:
    """Draw a small model with values of every kind and up to two load cases."""
    unit = Unit(draw(st.sampled_from(["1.0", "1.3", "1.4", "1.7", "2.0"])))
    attributes = st.dictionaries(names, st.tuples(typed, st.sampled_from(["mm", "deg", "°", "none", ""])), max_size=4)
    for _ in range(draw(st.integers(1, 4))):
        unit.add(draw(names), draw(st.text("abcä <&", max_size=5)), **draw(attributes))
    ids = st.integers(1, len(unit.components))
    for _ in range(draw(st.integers(0, 3))):
        unit.relate(draw(names), draw(st.one_of(st.none(), st.integers(1, 9))), **{draw(names): draw(ids)})
    for _ in range(draw(st.integers(0, 2))):
        unit.cases.append({draw(ids): draw(attributes)})
    return unit


def as_text(value: Any) -> Any:
    """Return a value in the form that the reader returns for XML: a text or a list of texts."""
    if isinstance(value, list):
        return [str(each) for each in value]
    return str(value).lower() if isinstance(value, bool) else str(value).strip()


def in_base64(content: bytes) -> bytes:
    """Return an XML file with the numbers of every array coded as one text in base64."""
    root = ET.fromstring(content)  # noqa: S314  our own
    for array in root.iter("array"):
        numbers = [float(cell.text or "") for cell in array]
        array.clear()
        array.set("code", "float64")
        array.text = base64.b64encode(struct.pack(f"<{len(numbers)}d", *numbers)).decode()
    return ET.tostring(root)


@examples(100, 1000, models())
@pytest.mark.ci
def test_all_forms_of_a_model_say_the_same(unit: Unit) -> None:
    expected = read(unit.json(), MOST_BYTES).model
    for content in (unit.xml(), unit.zipped(), unit.xml().replace(b"<model ", b'<model xmlns="urn:a" ')):
        found = read(content, MOST_BYTES).model
        assert (found.version, found.relations) == (expected.version, expected.relations)
        assert list(found.components) == list(expected.components)
        pairs = [(found.components[id_].attributes, each.attributes) for id_, each in expected.components.items()]
        for ours, theirs in zip(found.load_cases, expected.load_cases, strict=True):
            assert ours.attributes.keys() == theirs.attributes.keys()
            pairs += [(ours.attributes[id_], each) for id_, each in theirs.attributes.items()]
        for here, there in pairs:
            assert {name: (a.unit, a.value) for name, a in here.items()} == {
                name: (a.unit, as_text(a.value)) for name, a in there.items()
            }
    coded = read(in_base64(unit.xml()), MOST_BYTES).model
    for id_, each in expected.components.items():
        for name, attribute in each.attributes.items():
            if isinstance(attribute.value, list):
                assert coded.components[id_].attributes[name].value == attribute.value


@examples(100, 1000, models())
@pytest.mark.ci
def test_nothing_is_lost_when_results_are_written(unit: Unit) -> None:
    last = len(unit.components)
    for content in (unit.xml(), unit.json()):
        document = read(content, MOST_BYTES)
        written = with_attributes(document.file, last, [Attribute("custom_tribodrive_x", "none", 1.5)])
        found = read(written.content, MOST_BYTES).model
        assert float(found.components[last].attributes.pop("custom_tribodrive_x").value) == 1.5
        assert found == document.model


FORMS = [getattr(make(), form)() for make in (three_stages, turbo_unit) for form in ("xml", "json", "zipped")]
SNIPPETS = [
    b"<",
    b">",
    b'"',
    b"{",
    b"]",
    b"1e400",
    b"-1",
    b"NaN",
    b"true",
    b"null",
    b"\x00",
    b"\xff",
    b"9" * 30,
    b"&a;",
    b"",
]


@examples(100, 1000, st.data())
def test_a_damaged_file_is_read_or_refused_wherever_one_is_taken(data: st.DataObject) -> None:
    content = data.draw(st.sampled_from(FORMS))
    for _ in range(data.draw(st.integers(1, 3))):
        place = data.draw(st.integers(0, len(content)))
        cut = data.draw(st.sampled_from([0, 1, 2, 8, 200]))
        content = content[:place] + data.draw(st.sampled_from(SNIPPETS)) + content[place + cut :]
    try:
        document = read(content, MOST_BYTES)
        found = json.loads(unit_json(content, MOST_BYTES), parse_constant=pytest.fail)
    except Unprocessable:
        return
    assert unit_html(unit_json(content, MOST_BYTES), "")
    for stage in found["stages"]:
        assert read(with_answer(document, [stage["id"]], "/v1/scuffing", ANSWER).content, MOST_BYTES)


def test_links_of_a_unit_carry_the_name_of_the_file_to_every_report() -> None:
    content = turbo_unit().xml()
    name, hashed = "mill 7.rexs", sha256(content).hexdigest()
    html = unescape(unit_html(unit_json(content, MOST_BYTES), "", name, hashed).decode())
    assert f"File: {name}." in html
    links = re.findall(r'href="(/[a-z/-]+\?[^"]+)"', html)
    assert len(links) > 3
    for address in links:
        case = asked_by(address)
        addresses = [case.report, case.study("vary"), *(use.address for use in uses(case))]
        for carried in (asked_by(each).carried for each in addresses):
            assert (carried["rexs_file"], carried["rexs_sha256"]) == (name, hashed)


@pytest.mark.parametrize("teeth", [1, 2, 3, 4, 5, 1000, 1001, 10_000])
def test_the_page_of_any_number_of_teeth(teeth: int) -> None:
    unit = three_stages("1.4")
    for each in unit.components:
        if each["type"] == "cylindrical_gear":
            each["attributes"]["number_of_teeth"] = (teeth, "none")
    assert unit_html(unit_json(unit.xml(), MOST_BYTES), "")


def in_encoding(text: str, encoding: str) -> bytes:
    """Return an XML file in an encoding, with the byte order mark that belongs to it."""
    return text.replace("UTF-8", encoding.removesuffix("-sig").upper()).encode(encoding)


@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "iso-8859-1"])
def test_declaration_encoding_and_line_ends_stay_byte_for_byte(encoding: str, line_end: str) -> None:
    text = turbo_unit().xml().decode().replace("Turbo unit", "Träger µ").replace("\n", line_end)
    declaration = "<?xml version='1.0' encoding='UTF-8' standalone='yes'?>"
    text = text.replace('<?xml version="1.0" encoding="UTF-8"?>', declaration)
    content = in_encoding(text, encoding)
    document = read(content, MOST_BYTES)
    stage = document.model.by_type["cylindrical_stage"][0].id
    written = with_attributes(document.file, stage, [Attribute("custom_tribodrive_x", "µm", 1.5)])
    assert read(written.content, MOST_BYTES).model.components[stage].attributes["custom_tribodrive_x"].unit == "µm"
    before, after = (each.decode(encoding).splitlines(keepends=True) for each in (content, written.content))
    (added,) = [line for line in after if "custom_tribodrive_x" in line]
    assert [line for line in after if line != added] == before
    assert added.endswith(f"</attribute>{line_end}")
    assert with_attributes(written, stage, [Attribute("custom_tribodrive_x", "µm", 1.5)]).content == written.content


@pytest.mark.parametrize(
    ("component", "expected"),
    [
        ('<component id="1" name="a&gt;b/"/>', '<component id="1" name="a&gt;b/">{}</component>'),
        ('<component id="1" name="a>b/" ></component>', '<component id="1" name="a>b/" >{}</component>'),
        ('<component id="1"><attribute id="y"/></component>', '<component id="1"><attribute id="y"/>{}</component>'),
        ('<component id="1"><attribute id="x">9</attribute></component>', '<component id="1">{}</component>'),
        ('<r:component id="1"/>', '<r:component id="1">{}</r:component>'),
    ],
)
def test_only_the_new_attribute_is_added(component: str, expected: str) -> None:
    around = '<model xmlns:r="urn:r" version="1.4"><components>{}</components></model>'
    file = read(around.format(component).encode(), MOST_BYTES).file
    prefix = "r:" if "r:component" in component else ""
    new = f'<{prefix}attribute id="x" unit="none">1.5</{prefix}attribute>'
    written = with_attributes(file, 1, [Attribute("x", "none", 1.5)]).content.decode()
    assert written == around.format(expected.format(new))


def test_the_component_of_a_load_case_is_left_alone() -> None:
    unit = turbo_unit()
    stage = next(each["id"] for each in unit.components if each["type"] == "cylindrical_stage")
    unit.cases = [{stage: {"custom_x": (1.0, "none")}}]
    content = unit.xml()
    spectrum = content[content.index(b" <load_spectrum") : content.index(b"</model>")]
    moved = content.replace(spectrum, b"").replace(b" <relations>", spectrum + b" <relations>", 1)
    written = with_attributes(read(moved, MOST_BYTES).file, stage, [Attribute("custom_x", "none", 2.0)]).content
    assert spectrum in written
    assert read(written, MOST_BYTES).model.components[stage].attributes["custom_x"].value == "2.0"


@pytest.mark.parametrize("dumped", [{"indent": 4}, {"indent": "\t"}, {"separators": (",", ":")}, {}])
def test_json_keeps_indentation_and_line_ends(dumped: dict[str, Any]) -> None:
    for line_end in ("\n", "\r\n"):
        text = json.dumps(json.loads(turbo_unit().json()), **dumped).replace("\n", line_end) + line_end
        written = with_attributes(read(text.encode(), MOST_BYTES).file, 3, [Attribute("x", "none", 1.5)])
        again = with_attributes(written, 3, []).content.decode()
        document = json.loads(again)
        (item,) = [each for each in document["model"]["components"] if each["id"] == 3]
        item["attributes"] = [each for each in item["attributes"] if each["id"] != "x"]
        assert json.dumps(document, **dumped).replace("\n", line_end) + line_end == text


def test_an_archive_comes_back_with_its_other_entries() -> None:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as made:
        made.writestr("notes/read me.txt", b"kept")
        made.writestr("unit/mill.rexs", turbo_unit().xml())
    document = read(buffer.getvalue(), MOST_BYTES)
    stage = document.model.by_type["cylindrical_stage"][0].id
    file = packed(with_attributes(document.file, stage, [Attribute("x", "none", 1.5)]), MOST_BYTES)
    assert (file.suffix, file.media_type) == (".rexsz", "application/zip")
    with zipfile.ZipFile(io.BytesIO(file.content)) as archive:
        assert archive.namelist() == ["notes/read me.txt", "unit/mill.rexs"]
        assert archive.read("notes/read me.txt") == b"kept"
        assert b'id="x"' in archive.read("unit/mill.rexs")
    with pytest.raises(Unprocessable, match="beside the model"):
        packed(document.file, 3)
