"""Numbers, counts and symbols as they stand in titles, marks and at ticks."""

import re
from collections.abc import Callable
from math import floor, log10

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
PLAIN = (1e-3, 1e6)  # magnitudes written without a power of ten
# A letter or two, an underscore, letters and digits with commas between them.
_SUBSCRIPT = re.compile(r"(?<!\w)([^\W\d_²³]{1,2})_([^\W_²³]+(?:,[^\W_²³]+)*)")


def subscripts(text: str, typeset: Callable[[str, str], str]) -> str:
    """The text with every symbol such as `h_a` as `typeset` writes it of its letter and its subscript."""
    return _SUBSCRIPT.sub(lambda found: typeset(*found.groups()), text)


def number(value: float, unit: str | None = None, digits: int = 3) -> str:
    """The value with so many significant digits, a true minus sign and its unit; integers keep all their digits."""
    value += 0.0  # no negative zero
    text = _plain(value, digits) if value == 0.0 or PLAIN[0] <= abs(value) < PLAIN[1] else _power(value, digits)
    glue = "" if unit in {None, "", "°"} else " "
    return f"{text.replace('-', '−')}{glue}{unit or ''}"


def _plain(value: float, digits: int) -> str:
    if abs(value) >= 10.0 ** (digits - 1):
        whole = f"{value:.0f}" if abs(value) >= 10.0**digits else f"{value:.{digits}g}"
        return f"{float(whole):,.0f}".replace(",", " ") if abs(value) >= 1e4 else whole
    return f"{value:.{digits}g}"


def _power(value: float, digits: int) -> str:
    exponent = floor(log10(abs(value)))
    mantissa = f"{value / 10.0**exponent:.{digits}g}"
    if mantissa.lstrip("-") == "10":
        mantissa, exponent = mantissa.replace("10", "1"), exponent + 1
    power = f"10{str(exponent).translate(SUPERSCRIPTS)}"
    return {"1": power, "-1": f"-{power}"}.get(mantissa, f"{mantissa}·{power}")


def percent(fraction: float) -> str:
    """A fraction in per cent; a rounding error is none."""
    return number(0.0 if abs(fraction) < 1e-9 else 100.0 * fraction, "%")


def ratio(value: float, unit: str | None = None) -> str:
    """A ratio around 1, with as many digits as show how far from it."""
    return number(value, unit, digits=3 if abs(value - 1.0) > 0.01 else 6)


def listed(names: list[str]) -> str:
    """Names in a sentence."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
