"""Symbols and numbers as they are printed."""

import re

from markupsafe import Markup, escape

from app.figures.wording import NO_BREAK, number, subscripts
from solvers.quantity import UNITS

_LETTER = re.compile(r"[^\W\d_]{1,2}\*?")
_SECOND_HAND = "as read in a public implementation"
NO_VALUE = "–"
_UNITS = sorted({unit.symbol for unit in UNITS.values()} - {"°"}, key=len, reverse=True)
_WITH_UNIT = re.compile(rf"(?<=\d) ({'|'.join(map(re.escape, _UNITS))}|%)(?![^\W\d_])")
_NEXT_PART = r"(?<!\w-\d and )(?<!\w-\d\d and )"  # of a standard, such as -21 in "ISO/TS 6336-20 and -21"
_MINUS = re.compile(rf"(?<![\w)-]){_NEXT_PART}-(?=\d)")
_GROUPED = re.compile(r"(?<=\d) (?=\d{3}(?!\d))")
STEP_ABOVE_S, MINUTES_ABOVE_S = 10.0, 90.0
_WORDS = {
    "allowable_misalignment": "permissible misalignment",
    "angular": "angular misalignment",
    "barus": "Barus",
    "dip": "dip lubrication",
    "elastic_plastic": "elastic, then plastic",
    "hertzian": "Hertzian",
    "ishikawa": "Ishikawa",
    "iso_tr_13989": "ISO/TS 6336-20:2017",
    "low_peclet": "low Péclet number",
    "newtonian": "Newtonian",
    "pao": "polyalphaolefin (PAO)",
    "pocket_chain": "chain of pockets",
    "ree_eyring": "Ree-Eyring",
    "roelands": "Roelands",
    "spray": "spray lubrication",
    "thermal_ehl": "thermal EHL",
}


def together(text: str) -> str:
    """Return a text with true minus signs, whose lines do not break in a number nor between it and its unit."""
    grouped = _GROUPED.sub(NO_BREAK, _MINUS.sub("−", text))
    return _WITH_UNIT.sub(lambda found: NO_BREAK + found[1].replace(" ", NO_BREAK), grouped)


def typeset(text: str) -> Markup:
    """Return a text in which names such as `h_a` are letters with subscripts, and numbers stay with their units."""
    return Markup(subscripts(together(str(escape(text))), "<i>{}</i><sub>{}</sub>".format))  # noqa: S704  escaped before


def symbol(text: str | None) -> Markup:
    """Return the symbol of a quantity with letters in italics."""
    if not text:
        return Markup("")
    marked = Markup("<i>{}</i>").format(text) if _LETTER.fullmatch(text) else typeset(text)
    return Markup('<span class="symbol">{}</span>').format(marked)


def shown(value: object, digits: int = 5) -> str:
    """Return the text of a value: numbers in digits, all other values in words."""
    match value:
        case None:
            return NO_VALUE
        case bool():
            return "yes" if value else "no"
        case int():
            return number(float(value), digits=12)
        case float():
            return number(value, digits=digits)
        case _:
            return words(str(value))


def lasting(seconds: float) -> str:
    """Return how long an estimated time is, in whole seconds, steps of five seconds or minutes."""
    if seconds < STEP_ABOVE_S:
        return f"{max(round(seconds), 1)} s"
    return f"{5 * round(seconds / 5.0)} s" if seconds < MINUTES_ABOVE_S else f"{round(seconds / 60.0)} min"


def cited(text: str) -> str:
    """Return the text of a source or a reason as pages print it."""
    return text.replace(_SECOND_HAND, "secondary source")


def words(name: str) -> str:
    """Return a code of the API, such as `full_film`, in words."""
    return _WORDS.get(name, name.replace("_", " "))
