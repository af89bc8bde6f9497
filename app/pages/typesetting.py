"""Symbols and numbers as they are printed."""

import re

from markupsafe import Markup, escape

from app.figures.wording import number, subscripts

_LETTER = re.compile(r"[^\W\d_]{1,2}\*?")
_SECOND_HAND = "as read in a public implementation"
NO_VALUE = "–"
_WORDS = {
    "allowable_misalignment": "permissible misalignment",
    "angular": "angular misalignment",
    "barus": "Barus",
    "dip": "dip lubrication",
    "elastic_plastic": "elastic, then plastic",
    "hertzian": "Hertzian",
    "ishikawa": "Ishikawa",
    "iso_tr_13989": "ISO/TS 6336-20:2017",
    "newtonian": "Newtonian",
    "pao": "polyalphaolefin (PAO)",
    "pocket_chain": "chain of pockets",
    "ree_eyring": "Ree-Eyring",
    "roelands": "Roelands",
    "spray": "spray lubrication",
    "thermal_ehl": "thermal EHL",
}


def typeset(text: str) -> Markup:
    """Return a text in which names such as `h_a` are letters with subscripts."""
    return Markup(subscripts(str(escape(text)), "<i>{}</i><sub>{}</sub>".format))  # noqa: S704  escaped before


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


def cited(text: str) -> str:
    """Return the text of a source or a reason as pages print it."""
    return text.replace(_SECOND_HAND, "secondary source")


def words(name: str) -> str:
    """Return a code of the API, such as `full_film`, in words."""
    return _WORDS.get(name, name.replace("_", " "))
