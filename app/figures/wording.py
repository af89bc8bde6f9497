"""Numbers, lists and symbols as texts for titles, marks and ticks."""

import re
from collections.abc import Callable
from math import floor, log10

NO_BREAK = "\u00a0"  # a space at which lines do not break
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
PLAIN = (1e-3, 1e6)  # range of the magnitudes that are written without a power of ten
NOISE = 1e-9  # share of a whole; a smaller part is a rounding error
UNCERTAIN = 0.2  # chosen; a verdict is doubtful if the resolution causes a larger relative error of its number
DIFFERENCES = {"°C": "K", "K": "K", "°": "°", "%": "percentage points"}
"""Units of quantities whose changes are stated as differences and not as ratios, with the units of the differences."""
# One or two letters, an underscore, then letters and digits, which commas may separate into groups.
_SUBSCRIPT = re.compile(r"(?<!\w)([^\W\d_²³]{1,2})_([^\W_²³]+(?:,[^\W_²³]+)*)")


def subscripts(text: str, typeset: Callable[[str, str], str]) -> str:
    """Replace every symbol such as `h_a` in a text."""
    return _SUBSCRIPT.sub(lambda match: typeset(*match.groups()), text)


def number(value: float, unit: str | None = None, digits: int = 3) -> str:
    """Return a value with its unit as text, with `digits` significant digits and a true minus sign."""
    value += 0.0  # no negative zero
    if value != 0.0 and not PLAIN[0] <= abs(value) < PLAIN[1]:
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        power = f"10{str(int(exponent)).translate(SUPERSCRIPTS)}"
        mantissa = f"{float(mantissa):g}"
        text = {"1": power, "-1": f"-{power}"}.get(mantissa, f"{mantissa}·{power}")
    else:
        text = f"{value:,.{digits}g}" if abs(value) < 10.0 ** (digits - 1) else f"{value:,.0f}"
        text = text.replace(",", " " if abs(value) >= 1e4 else "")
    glue = "" if unit in {None, "", "°"} else " "
    return f"{text.replace('-', '−')}{glue}{unit or ''}"


def without_rounding(value: float, whole: float) -> float:
    """Return the value, or zero if the value is a rounding error, that is, smaller than 1e-9 of `whole`."""
    return 0.0 if abs(value) < NOISE * abs(whole) else value


def percent(fraction: float) -> str:
    """Return a fraction as text in per cent. A rounding error becomes zero."""
    return number(100.0 * without_rounding(fraction, 1.0), "%")


def ratio(value: float, unit: str | None = None) -> str:
    """Return a ratio as text, with more digits if the ratio is close to 1."""
    return number(value, unit, digits=3 if abs(value - 1.0) > 0.01 else 6)


def difference_unit(unit: str | None) -> str | None:
    """Return the unit of the difference of two values with this unit, for example K for °C."""
    return DIFFERENCES.get(unit or "", unit)


def signed(value: float, unit: str | None = None, digits: int = 3) -> str:
    """Return a value as text that begins with a sign, even if the value is positive."""
    text = number(value, unit, digits)
    return text if text.startswith("−") else f"+{text}"


def to_digits(value: float, error: float, most: int = 3) -> str:
    """Return a value as text, rounded to the leading digit of its error and to at most `most` significant digits."""
    if value == 0.0:
        return number(value)
    size = floor(log10(abs(value)))
    reliable = most if error <= 0.0 else size - floor(log10(error)) + 1
    digits = min(max(reliable, 1), most)
    return number(round(value, digits - 1 - size), digits=most)


def listed(names: list[str]) -> str:
    """Join names with commas and a final "and", for use in a sentence."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
