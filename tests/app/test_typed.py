"""A form reads typed text as its author means it, or asks back if the text has two readings.

Links are read as strictly as before.
"""

import re
from html import unescape
from math import isclose
from random import Random
from urllib.parse import parse_qsl

import httpx
import pytest

from app.calculations import BY_PATH
from app.examples import examples
from app.pages.cases import Asked
from app.pages.query import WRITTEN, body_of, from_form, pairs_of, written_of
from app.pages.templating import page_path
from app.pages.typed import DOUBT, in_link, list_in_link, number_of, question
from solvers.quantity import UNITS
from tests.support.forms import read_form
from tests.support.lists import LISTS
from tests.support.pages import asked, fault_at, html_of
from tests.support.requests import value_at

SYMBOLS = sorted({unit.symbol for unit in UNITS.values()})
COUPLING = "pahl-axial-displacement"
CROWNING = "pahl-recommended-crowning"
TORQUE = "operation.torque_n_m"


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("1 910", "1/min", 1910),
        ("12'000", None, 12_000),
        ("12’000", None, 12_000),
        ("1 910,5", None, 1910.5),
        ("1.234,5", None, 1234.5),
        ("3.500.000", None, 3_500_000),
        ("0,400", None, 0.4),
        ("20.1250", None, 20.125),
        ("3500.0", None, 3500.0),
        ("−0,05", "°", -0.05),
        ("55 °C", "°C", 55),
        ("55 C", "°C", 55),
        ("3500 Nm", "N m", 3500),
        ("3,5 kNm", "N m", 3500.0),
        ("0.05°", "°", 0.05),
        ("18 MW", "kW", 18_000.0),
        ("1910 rpm", "1/min", 1910),
        ("1 910 1/min", "1/min", 1910),
        ("1910/min", "1/min", 1910),
        ("1910 min⁻¹", "1/min", 1910),
        ("1910 U/min", "1/min", 1910),
        ("40 mPas", "Pa s", 0.04),
        ("220 cSt", "mm²/s", 220),
        ("220 mm^2/s", "mm²/s", 220),
        ("7,85 kg/dm³", "kg/m³", 7850.0),
        ("0.46 kJ/(kg K)", "J/(kg K)", 460.0),
        ("45 W/m/K", "W/(m K)", 45),
        ("22 GPa⁻¹", "1/GPa", 22),
        ("0.4 kN/μm", "N/µm", 400.0),
        ("300 nm", "mm", 0.0003),
        ("1.2346·10⁻⁵", None, 1.2346e-5),
        ("−10⁻⁶", None, -1e-6),
        ("1.910·10³ N m", "N m", 1910),
        ("2.5 x 10^3", None, 2500),
        ("212 °F", "°C", 100),
        ("−40°F", "°C", -40),
        ("9 °F", "K", 5),
        ("0.5 in", "mm", 12.7),
        ("100 hp", "kW", 74.5699871582),
        ("50000 psi", "MPa", 344.737864658),
        ("8000 lbf in", "N m", 903.878632221),
        ("8000 lbf·in", "N m", 903.878632221),
        ("100 lb-ft", "N m", 135.581794833),
        ("2 bar", "kPa", 200),
        ("10 gpm", "l/min", 37.85411784),
        ("3,500e3", None, 3500),
    ],
)
def test_a_typed_number_is_read(text: str, unit: str | None, value: float) -> None:
    assert number_of(in_link(text, unit)) == value


@pytest.mark.parametrize(
    ("text", "readings"),
    [
        ("3.500", "3500 or 3.5"),
        ("1,910", "1910 or 1.91"),
        ("20.125", "20125 or 20.1250"),
        ("−1.000", "-1000 or -1"),
        ("3.500 kNm", "3500 or 3.5 kNm"),
        ("999,999", "999999 or 999.9990"),
    ],
)
def test_a_number_with_two_readings_is_asked_back(text: str, readings: str) -> None:
    asked = in_link(text, "N m")
    assert asked == text + DOUBT
    assert question(asked) == f"{text} may mean {readings}; write one of these"
    assert isinstance(number_of(asked), str)
    for answer in readings.removesuffix(" kNm").split(" or "):
        assert isinstance(number_of(in_link(answer)), int | float)


@pytest.mark.parametrize(
    "text", ["18 mw", "55 K", "3500 N", "5 %", "3²", "12 34", "1-2", "5 m°", "1e", "N m", "5 10^3", ""]
)
def test_what_is_no_number_of_the_field_is_left_to_the_validator(text: str) -> None:
    assert in_link(text, "N m") == text
    assert isinstance(number_of(text), str)


@pytest.mark.parametrize("symbol", SYMBOLS)
def test_every_unit_of_a_field_may_be_typed_behind_its_number(symbol: str) -> None:
    for written in (symbol, symbol.replace(" ", ""), symbol.replace("µ", "μ"), symbol.replace("²", "^2")):
        assert in_link(f"12,5 {written}", symbol) == "12.5"
        close = in_link(f"12,5{written}", symbol)
        assert close == (f"12,5{written}{DOUBT}" if written.startswith("1/") else "12.5")  # 12,51/min
    assert all(in_link(f"12 {other}", symbol) == f"12 {other}" for other in SYMBOLS if not _alike(other, symbol))


def _alike(one: str, other: str) -> bool:
    """Return whether two units are of the same quantity.

    Units are of the same quantity if a field with the unit `other` reads a number with the unit `one`.
    """
    return in_link(f"1 {one}", other) != f"1 {one}"


def test_units_of_one_quantity_are_those_whose_scales_are_powers_of_ten() -> None:
    prefixed = {("mm", "µm"), ("W", "kW"), ("MPa", "GPa"), ("kPa", "MPa"), ("N/mm", "N/µm"), ("m/s", "mm/s")}
    alike = {(one, other) for one in SYMBOLS for other in SYMBOLS if one != other and _alike(one, other)}
    assert prefixed <= alike
    assert {(one, other) for other, one in alike} == alike
    scale = {unit.symbol: unit.scale for unit in UNITS.values()}
    for one, other in alike:
        assert isclose(float(in_link(f"7 {one}", other)) * scale[other], 7 * scale[one], rel_tol=1e-12)


@pytest.mark.parametrize(("text", "values"), LISTS)
def test_a_typed_list_is_read_or_asked_back(text: str, values: list[float] | None) -> None:
    asked = list_in_link(text, "°")
    crowning = BY_PATH["/v1/coupling/recommendation"].request
    name = "operation.misalignment_range_deg"
    read = value_at(body_of(crowning, [(name, asked)]), name)
    if values is None:
        assert asked == text + DOUBT
        assert question(asked)
        assert any(isinstance(each, str) for each in read)
    else:
        assert read == values


def test_a_list_whose_commas_part_numbers_may_be_copied_from_a_link() -> None:
    assert list_in_link("0.4,0.2", "°") == "0.4,0.2"
    assert list_in_link("abc 1,5") == "abc 1,5"
    assert list_in_link(" ".join(["1,5"] * 5000)) == " ".join(["1,5"] * 5000)  # refused for its length


def writing(value: float, random: Random) -> tuple[str, float, bool]:
    """Return a random way to write a number, the number that is meant, and whether the text has two readings."""
    places = random.choice((0, 1, 2, 3, 4))
    whole, _, decimals = f"{abs(value):.{places}f}".partition(".")
    mark, other = random.choice((".,", ",."))
    separator = random.choice(["", " ", "'", "’", "\u00a0", "\u202f", other])
    grouped = f"{int(whole):,}".replace(",", separator)
    sign = random.choice("-−") if value < 0 else random.choice(("", "+"))
    text = f"{sign}{grouped}{mark}{decimals}" if decimals else f"{sign}{grouped}"
    thousands = separator == other and not decimals and 10**3 <= int(whole) < 10**6
    return text, round(value, places), thousands or (places == 3 and 1 <= int(whole) < 1000)


TORQUE_UNITS = {"": 1.0, " N m": 1.0, "Nm": 1.0, " N·m": 1.0, " kN m": 1e3, "mNm": 1e-3}


def test_three_hundred_writings_of_a_hundred_numbers_are_read_as_meant_or_asked_back() -> None:
    random, doubts = Random(40), 0
    for value in [random.choice((1, -1)) * 10 ** random.uniform(-2, 7) for _ in range(100)]:
        for _ in range(3):
            text, meant, doubtful = writing(value, random)
            unit = random.choice(list(TORQUE_UNITS))
            read = in_link(text + unit, "N m")
            if doubtful:
                assert question(read).startswith(f"{text}{unit} may mean "), text
                doubts += 1
            else:
                assert number_of(read) == pytest.approx(meant * TORQUE_UNITS[unit], rel=1e-14, abs=0), (text, unit)
    assert 15 <= doubts <= 100


FIRST = {example.endpoint: name for name, example in reversed(examples().items())}


@pytest.mark.parametrize("name", sorted(examples()))
def test_what_the_server_wrote_into_a_form_gives_the_same_case(name: str) -> None:
    example = examples()[name]
    model = BY_PATH[example.endpoint].request
    pairs = pairs_of(example.request)
    assert from_form(model, [*pairs, (WRITTEN, written_of(model, pairs))]) == pairs
    awkward = [(path, "20.125" if _is_number(text) else text) for path, text in pairs]
    assert from_form(model, [*awkward, (WRITTEN, written_of(model, awkward))]) == awkward
    assert awkward == pairs or from_form(model, [*awkward, (WRITTEN, "")]) != awkward


def _is_number(text: str) -> bool:
    return isinstance(number_of(text), float)


@pytest.mark.parametrize("name", FIRST.values(), ids=FIRST)
@pytest.mark.ci
def test_every_number_that_a_page_prints_may_be_typed_into_its_form(name: str) -> None:
    """If a number of a page is typed into the form of this page, the form reads the same number or asks back."""
    # The numbers stand in tables, headlines and placeholders.
    html = html_of(asked(name))
    printed = re.findall(r'data-path="[^"]+">([^<]*)<', html) + re.findall(
        r'class="number"[^>]*placeholder="([^"]*)"', html
    )
    numbers = [
        text for text in map(unescape, printed) if re.fullmatch(r"[−-]?\d[\d  .·]*[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]*(?:e[+-]\d+)?", text)
    ]
    assert len(numbers) > 10
    for text in numbers:
        read = in_link(text)
        plain = text.translate(str.maketrans("−⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789", "  ")).replace("·10", "e")
        if not read.endswith(DOUBT):
            assert number_of(read) == float(plain), text
        else:
            assert re.fullmatch(r"-?[1-9]\d{0,2}\.\d{3}", plain), text


def sent(client: httpx.Client, name: str, **texts: str) -> httpx.Response:
    """Type these texts into the form of an example's page, send the form without script, and return the answer."""
    path = page_path(BY_PATH[examples()[name].endpoint])
    fields, _ = read_form(client.get(path, params=pairs_of(examples()[name].request)).text)
    assert texts.keys() <= dict(fields).keys()
    return client.get(path, params=dict(fields) | texts, follow_redirects=True)


def test_a_form_sent_without_script_is_read_and_its_link_has_the_number(client: httpx.Client) -> None:
    answer = sent(client, COUPLING, **{TORQUE: "3,5 kNm", "operation.speed_rpm": "1 910 rpm"})
    assert answer.status_code == 200
    query = dict(parse_qsl(answer.url.query.decode()))
    assert (query[TORQUE], query["operation.speed_rpm"]) == ("3500", "1910")
    assert WRITTEN not in query
    assert dict(read_form(answer.text)[0])[TORQUE] == "3500"


@pytest.mark.parametrize("text", ["3.500", "3,500", "3.500 Nm"])
def test_a_form_sent_without_script_asks_back(client: httpx.Client, text: str) -> None:
    answer = sent(client, COUPLING, **{TORQUE: text})
    assert answer.status_code == 422
    assert "may mean 3500 or 3.5" in fault_at(answer.text, TORQUE)
    fields = dict(read_form(answer.text)[0])
    assert fields[TORQUE] == text
    again = client.get(answer.url)  # its address keeps the question
    assert again.text == answer.text
    once_more = client.get("/coupling", params=fields, follow_redirects=True)
    assert once_more.status_code == 422
    assert client.get("/coupling/result.json", params=answer.url.query).status_code == 422


def test_a_link_is_as_strict_as_it_was(client: httpx.Client) -> None:
    pairs = dict(pairs_of(examples()[COUPLING].request))
    linked = client.get("/coupling", params=pairs | {TORQUE: "3.500"}, follow_redirects=True)
    assert linked.status_code == 200
    kept = dict(read_form(linked.text)[0])
    edited = client.get("/coupling", params=kept | {"operation.speed_rpm": "1920"}, follow_redirects=True)
    assert edited.status_code == 200
    assert "torque_n_m=3.500&" in str(edited.url)
    for text in ("3500 Nm", "−3", "0,4 0,2"):
        refused = client.get("/coupling", params=pairs | {TORQUE: text}, follow_redirects=True)
        assert refused.status_code == 422, text


def test_two_values_may_have_decimal_commas(client: httpx.Client) -> None:
    name = "operation.misalignment_range_deg"
    answer = sent(client, CROWNING, **{f"{name}.0": "0,02", f"{name}.1": "0,06"})
    assert f"{name}=0.02,0.06" in str(answer.url)
    assert answer.status_code == 200
    doubtful = sent(client, CROWNING, **{"coupling.pitch_errors_um": "0,400"})
    assert doubtful.status_code == 422
    assert "one number or several" in fault_at(doubtful.text, "coupling.pitch_errors_um")


def test_only_what_is_refused_is_asked_back() -> None:
    """In a link, the comma in 100,200 separates two values of a list."""
    # The page therefore does not ask what this text means, even if it asks to correct another field.
    pairs = [("coupling.pitch_errors_um", "100,200"), (TORQUE, "x")]
    html = html_of(Asked("/coupling", pairs), 422)
    assert "may mean" not in html
    assert fault_at(html, TORQUE)


@pytest.mark.parametrize("method", ["GET", "POST"])
def test_calculate_on_an_empty_form_says_what_is_missing(client: httpx.Client, method: str) -> None:
    fields = dict(read_form(client.get("/coupling").text)[0])
    answer = client.request(method, "/coupling", **{"params" if method == "GET" else "data": fields})
    assert answer.status_code == 422
    assert fault_at(answer.text, "coupling.teeth")
    assert client.get("/coupling").status_code == 200
