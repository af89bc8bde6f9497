"""Numbers as people type them into a form, and the texts that stand for these numbers in links.

A typed number may have digits in groups of three, a decimal point or comma, a power of ten, the minus sign that pages
print, and the unit of its field with any prefix, or a unit of another system such as °F, hp or lbf in. A text that can
be read in two ways is not read as a number. In a link, a question mark is added to the end of such a text, so that the
text is not a number. `question` returns the question that asks the user which reading is meant.
"""

import re
from decimal import Decimal
from typing import Any

DOUBT = "?"
LONGEST = 60  # characters of a number and its unit; a longer text is not read as a number; chosen
MOST_ITEMS = 2000  # items of a list; more than any list of a request may have

_TIDY = str.maketrans({"−": "-", "’": "'", "\u00a0": " ", "\u2007": " ", "\u2009": " ", "\u202f": " "})
_SUPERSCRIPTS = str.maketrans("⁻⁺⁰¹²³⁴⁵⁶⁷⁸⁹", "-+0123456789")
_INTEGER = re.compile(r"[+-]?\d{1,18}")
_NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?")
_PLAIN = re.compile(r"[+-]?\d+(\.\d*)?")
_BLANKS = re.compile("[ '\u00a0\u2009\u202f]")
_SPACED = re.compile(rf"[+-]?\d{{1,3}}({_BLANKS.pattern}\d{{3}})+([.,]\d*)?")
_ENGLISH = re.compile(r"[+-]?\d{1,3}(,\d{3})+\.\d*|[+-]?\d{1,3}(,\d{3}){2,}")
_GERMAN = re.compile(r"[+-]?\d{1,3}(\.\d{3})+,\d*|[+-]?\d{1,3}(\.\d{3}){2,}")
_AMBIGUOUS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")  # in a link, where a point is always the decimal mark
_DOUBTFUL = re.compile(r"([+-]?[1-9]\d{0,2})([.,])(\d{3})(?![\d.,'])")  # in a typed text
_POWER = re.compile(r"(\d\s*[·×x*]\s*|(?<![\d.,']))10(?:\^([+-]?\d{1,4})|([⁻⁺]?[⁰¹²³⁴⁵⁶⁷⁸⁹]{1,4}))")
_TYPED = re.compile(r"([+-]?[\d.,][\d.,' ]*?)(?:[eE]([+-]?\d{1,4}))?\s*((?:\s1/|/)?[A-Za-z°µμ(].*)?")

_PREFIXES = dict(zip(("", *"pnµumcdhkMGT"), (0, -12, -9, -6, -6, -3, -2, -1, 2, 3, 6, 9, 12), strict=True))
_BASES = ("m", "g", "s", "rad", "mol", "N", "Pa", "W", "J", "K", "Hz")
_SYMBOLS = {
    f"{prefix}{base}": (base, 1, Decimal(1).scaleb(power)) for base in _BASES for prefix, power in _PREFIXES.items()
}
_SYMBOLS |= {base: (base, 1, Decimal(1)) for base in ("°C", "°", "min")}
_SYMBOLS |= {  # of other systems: base unit, its exponent, and the size in base units
    "bar": ("Pa", 1, Decimal(100000)),
    "mbar": ("Pa", 1, Decimal(100)),
    "l": ("m", 3, Decimal("0.001")),
    "in": ("m", 1, Decimal("0.0254")),
    "ft": ("m", 1, Decimal("0.3048")),
    "mil": ("m", 1, Decimal("0.0000254")),
    "gal": ("m", 3, Decimal("0.003785411784")),
    "lb": ("g", 1, Decimal("453.59237")),
    "lbf": ("N", 1, Decimal("4.4482216152605")),
    "psi": ("Pa", 1, Decimal("6894.757293168361")),
    "ksi": ("Pa", 1, Decimal("6894757.293168361")),
    "hp": ("W", 1, Decimal("745.6998715822702")),
}
_FACTOR = re.compile(rf"[\s·*-]*({'|'.join(sorted(_SYMBOLS, key=len, reverse=True))})(?:\^?(-?\d))?")
_ALIASES = {"rpm": "1/min", "RPM": "1/min", "U/min": "1/min", "deg": "°", "C": "°C", "cSt": "mm²/s"}
_ALIASES |= {"gpm": "gal/min", "lb in": "lbf in", "in lb": "lbf in", "lb ft": "lbf ft", "ft lb": "lbf ft"}
_FAHRENHEIT = {"°F", "F", "degF"}
DIGITS = 12  # significant digits of a number that was converted from a unit of another system


def text_of(value: Any) -> str:
    """Return a value as people type it.

    Whole numbers have no decimal point. Other numbers have the fewest digits from which the value can be restored.
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    return str(value)


def number_of(text: str) -> Any:
    """Read the number in a single field of a link. Return other text unchanged.

    The number may have a decimal point or a decimal comma. Digits may stand in groups of three if it is clear which
    mark is the decimal mark.
    """
    plain = _ungrouped(text)
    number = text if _AMBIGUOUS.fullmatch(plain) else plain_number_of(plain.replace(",", ".", 1))
    return text if isinstance(number, str) else number


def plain_number_of(text: str) -> Any:
    """Read a number with a decimal point. Return other text unchanged."""
    if _INTEGER.fullmatch(text):
        return int(text)
    return float(text) if _NUMBER.fullmatch(text) and "," not in text else text


def in_link(text: str, unit: str | None = None) -> str:
    """Convert a number from the user's notation to the notation of links. Return other text unchanged.

    `unit` is the unit of the field in which the number was typed.
    """
    if _PLAIN.fullmatch(text) and not _DOUBTFUL.fullmatch(text):
        return text
    parts = _parts(text)
    factor, offset = (_conversion(parts[3], unit) if parts else None) or (None, None)
    if parts is None or factor is None or offset is None:
        return text
    if (_DOUBTFUL.fullmatch(parts[1]) and not parts[2]) or _unit_in_doubt(parts):
        return text + DOUBT
    plain = _ungrouped(parts[1]).replace(",", ".", 1)
    if not _NUMBER.fullmatch(plain):
        return text
    if not parts[2] and (factor, offset) == (Decimal(1), Decimal(0)):
        return plain
    value = (Decimal(f"{plain}e{parts[2] or 0}") - offset) * factor
    return text_of(float(value if _power(factor) is not None else f"{value:.{DIGITS}g}"))


def list_in_link(text: str, unit: str | None = None) -> str:
    """Convert a typed or pasted list into its text in a link. If an item is not a number, return the text unchanged."""
    items = _items(text.translate(_TIDY), unit)
    if items is None:
        return text + DOUBT
    if len(items) > MOST_ITEMS:
        return text
    decimal = {mark for item in items for mark in ".," if item.count(mark) == 1 and not _DOUBTFUL.match(item)}
    numbers = [in_link(_settled(item, decimal), unit) for item in items]
    if any(number.endswith(DOUBT) for number in numbers):
        return text + DOUBT
    return ",".join(numbers) if all(map(_NUMBER.fullmatch, numbers)) else text


def items_in_link(text: str) -> str:
    """Convert all numbers of a text from the user's notation to the notation of links.

    Semicolons, blanks and line breaks separate the numbers.
    """
    return re.sub(r"[^;\s]+", lambda item: in_link(item[0]), text)


def table_in_link(text: str) -> str:
    """Convert a table into the text that represents the table in a link.

    The first line of the table names the columns. The cells of a column `name` are not converted.
    """
    separator = separator_of(text)
    heading, *rows = text.split("\n")
    named = [cell.strip().lower() == "name" for cell in heading.split(separator)]
    cells = ([*enumerate(row.split(separator))] for row in rows)
    read = [
        separator.join(cell if place < len(named) and named[place] else in_link(cell.strip()) for place, cell in row)
        for row in cells
    ]
    return "\n".join([heading, *read])


def separator_of(text: str) -> str:
    """Return the separator of a table's columns: a tab, as in copies from spreadsheets, or a semicolon."""
    first = next((line for line in text.splitlines() if line.strip()), "")
    return next((separator for separator in "\t;" if separator in first), "\t")


def scaled(value: Any, power: int) -> Any:
    """Multiply a number by ten to the power `power`, with a single rounding. Return other values unchanged."""
    return float(Decimal(str(value)).scaleb(power)) if power and isinstance(value, int | float) else value


def as_typed(text: str) -> str:
    """Remove the question marks that mark doubtful numbers in a link."""

    def unmarked(item: str) -> str:
        return item.removesuffix(DOUBT) if question(item) else item

    return unmarked(re.sub(r"[^;\s]{1,60}\?(?=[;\s]|$)", lambda item: unmarked(item[0]), text))


def power_between(typed: str | None, own: str | None) -> int | None:
    """Return the power of ten that converts a typed unit to the unit of the field.

    Return None if the two units belong to different quantities, or if their ratio is not a power of ten.
    """
    factor, offset = _conversion(typed, own) or (None, None)
    return _power(factor) if factor is not None and not offset else None


def _conversion(typed: str | None, own: str | None) -> tuple[Decimal, Decimal] | None:
    """Return factor and offset that convert a typed number to the unit of the field: (number - offset) factor.

    Return None if the two units belong to different quantities.
    """
    if not typed or _packed(typed) == _packed(own or ""):
        return Decimal(1), Decimal(0)
    if _packed(typed) in _FAHRENHEIT and own in {"°C", "K"}:
        return Decimal(5) / 9, Decimal(32 if own == "°C" else 0)
    here, there = _factors(typed), _factors(own or "")
    return (here[1] / there[1], Decimal(0)) if here and there and here[0] == there[0] else None


def _power(factor: Decimal) -> int | None:
    """Return the power of ten that a factor is; None if it is none."""
    return factor.adjusted() if factor == Decimal(1).scaleb(factor.adjusted()) else None


def question(text: str) -> str:
    """Return a question about a text that can be read in two ways.

    Return an empty text if there is only one reading.
    """
    asked = text.removesuffix(DOUBT)
    if asked == text and not _AMBIGUOUS.fullmatch(text):
        return ""
    for item in (asked, *re.split(r"[\s;]+", asked)):
        parts = _parts(item)
        if parts and (doubtful := _DOUBTFUL.fullmatch(parts[1])):
            whole, _, decimals = doubtful.groups()
            kept = decimals.rstrip("0")
            decimal = f"{whole}.{kept}{'0' * (len(kept) == len(decimals))}".rstrip(".")
            unit = f" {parts[3].strip()}" if parts[3] else ""
            return f"{item} may mean {whole}{decimals} or {decimal}{unit}; write one of these"
    if (parts := _parts(asked)) and _unit_in_doubt(parts):
        return f"the unit of {asked} may be 1{parts[3]} or {parts[3]}; leave the unit out"
    if not list_in_link(asked).endswith(DOUBT):
        return ""
    return f"{asked} may be one number or several; write decimal points, and semicolons between numbers"


def _parts(text: str) -> re.Match[str] | None:
    """Match the digits, the exponent and the unit of a typed number; return None if the text is not a number."""
    return _TYPED.fullmatch(_POWER.sub(_exponent, text.translate(_TIDY))) if len(text) <= LONGEST else None


def _unit_in_doubt(parts: re.Match[str]) -> bool:
    """Return whether the last digit may belong to the unit. For example, 19101/min may be 1910 1/min."""
    return parts[1].endswith("1") and (parts[3] or "").startswith("/")


def _ungrouped(text: str) -> str:
    """Remove the marks between groups of three digits if these marks cannot be decimal marks."""
    plain = _BLANKS.sub("", text) if _SPACED.fullmatch(text) else text
    if _ENGLISH.fullmatch(plain):
        return plain.replace(",", "")
    return plain.replace(".", "") if _GERMAN.fullmatch(plain) else plain


def _exponent(power: re.Match[str]) -> str:
    """Return a printed power of ten in the notation of programs: 3·10⁵ becomes 3e5."""
    exponent = power[2] or power[3].translate(_SUPERSCRIPTS)
    return f"{power[1][0] if power[1] else '1'}e{exponent}"


def _items(text: str, unit: str | None) -> list[str] | None:
    """Return the items of a list, or None if the text has two readings.

    The text is split at semicolons, line breaks and tabs. The parts are split at blanks, and then at commas that
    separate numbers.
    """
    cells = [cell.strip() for cell in re.split(r"[;\t\r\n]+", text.strip("; \t\r\n"))]
    items = list[str]()
    for cell in cells:
        if len(cells) > 1 and _SPACED.fullmatch(cell):  # the cell is either one number in groups or several numbers
            return None
        whole = " " not in cell or (not _SPACED.fullmatch(cell) and _NUMBER.fullmatch(in_link(cell, unit)))
        items += [cell] if whole else cell.split()
    if any(re.match(r"0\d", item) for item in items[1:]):  # "050" in "1 050" may be the second group of a number
        return None
    if len(items) > 1:
        items = [item.removesuffix(",") for item in items]
    elif (items[0].count(",") == 1 and "." not in items[0]) or _ENGLISH.match(items[0]) or _GERMAN.match(items[0]):
        return None
    return [part.strip() for item in items for part in (item.split(",") if _has_several(item) else [item])]


def _has_several(item: str) -> bool:
    """Return True if the text consists of several numbers that commas separate.

    This is assumed if there are decimal points beside the commas, or if there are several commas. Digits in groups of
    three are a single number.
    """
    grouped = _ENGLISH.fullmatch(item) or _GERMAN.fullmatch(item)
    return not grouped and (item.count(",") > 1 or ("," in item and "." in item))


def _settled(item: str, decimal: set[str]) -> str:
    """Add a zero to a doubtful number if the other numbers of the list show that its mark is a decimal mark.

    The mark is a point or a comma. With three digits after the mark, the number is doubtful, because the mark may
    separate either decimals or thousands. With a zero added, the number can only have decimals. `decimal` contains the
    marks that are decimal marks in other numbers of the list.
    """
    doubtful = _DOUBTFUL.match(item)
    return f"{item[: doubtful.end()]}0{item[doubtful.end() :]}" if doubtful and doubtful[2] in decimal else item


def _packed(unit: str) -> str:
    """Return a unit without blanks, brackets and dots. W/mK thus means W/(m K), not watts per millikelvin."""
    return re.sub(r"[\s()·*]", "", unit).replace("μ", "µ")


def _factors(unit: str) -> tuple[frozenset[tuple[str, int]], Decimal] | None:
    """Return the base units of a unit and its size in them; None if the text is not a unit.

    Every base unit comes with its exponent.
    """
    text = _ALIASES.get(re.sub(r"[\s·*-]+", " ", unit.strip()), unit).translate(_SUPERSCRIPTS).replace("μ", "µ")
    exponents: dict[str, int] = {}
    size = Decimal(1)
    for place, part in enumerate(re.sub(r"°\s*C", "°C", text).replace("1/", "/").split("/")):
        rest = part.strip("() ")
        while factor := _FACTOR.match(rest):
            (base, own, of_base), exponent = _SYMBOLS[factor[1]], int(factor[2] or 1) * (-1 if place else 1)
            exponents[base] = exponents.get(base, 0) + own * exponent
            size *= of_base**exponent
            rest = rest[factor.end() :]
        if rest.strip():
            return None
    return (frozenset(exponents.items()), size) if exponents else None
