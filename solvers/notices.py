"""Warnings about the validity of a result."""

from dataclasses import dataclass
from typing import Literal, get_args

Rank = Literal["invalid", "doubtful", "note"]
"""How far a warning limits the use of a result.

invalid     a result is missing, or the theory does not hold for this result
doubtful    a limit of validity, of resolution or of good practice is exceeded; the result may be wrong
note        something was left out, was assumed, or has no meaning in this case; the result is valid
"""
RANKS: tuple[Rank, ...] = get_args(Rank)
"""The ranks in order; the most serious rank comes first."""


@dataclass(frozen=True, slots=True)
class Notice:
    """A warning about the validity of a result.

    `code` is stable and meant for programs. `message` says what is wrong or uncertain. `field` is the dotted name of
    the input that the warning is about, without a unit. If the warning is not about one input alone, `field` may be
    None.
    """

    code: str
    message: str
    field: str | None = None
    rank: Rank = "doubtful"


def unusual_value(field: str, message: str) -> Notice:
    """Return the warning about an unusual value of an input."""
    return Notice("unusual_value", message, field)
