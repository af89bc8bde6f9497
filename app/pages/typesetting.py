"""Symbols and numbers as print sets them."""

import re

from markupsafe import Markup, escape

from app.figures.wording import number

_SUBSCRIPT = re.compile(r"([^\W\d_]+[^\s_/]*)_([^\s/*]+?)(\*?)(?=,? |/|$)")
_LETTER = re.compile(r"[^\W\d_]{1,2}\*?")
NO_VALUE = "–"


def symbol(text: str | None) -> Markup:
    """`h_aP*` with a subscript; letters slanted, as symbols of quantities are."""
    if not text:
        return Markup("")
    plain = str(escape(text))
    marked = f"<i>{plain}</i>" if _LETTER.fullmatch(plain) else _SUBSCRIPT.sub(r"<i>\1</i><sub>\2</sub>\3", plain)
    return Markup('<span class="symbol">{}</span>').format(Markup(marked))  # noqa: S704  escaped before


def shown(value: object, digits: int = 5) -> str:
    """A single value in words or digits."""
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


def words(name: str) -> str:
    """A code or choice as people read it."""
    return name.replace("_", " ")


def percent_change(now: float, before: float) -> str:
    """By how much a number changed."""
    if before == 0.0:
        return "no change" if now == 0.0 else "from zero"
    change = 100.0 * (now / before - 1.0)
    return "no change" if abs(change) < 5e-4 else f"{change:+.3g} %".replace("-", "−")
