"""Warnings about the validity of a result."""

from dataclasses import dataclass
from typing import Literal, get_args

Rank = Literal["invalid", "doubtful", "note"]
"""How far a warning limits the use of a result.

invalid     a result is missing, or stands where the theory does not hold
doubtful    a limit of validity, of resolution or of good practice is exceeded; the result is to be questioned
note        what was left out or assumed, or has no meaning here; the result stands
"""
RANKS: tuple[Rank, ...] = get_args(Rank)
"""The gravest first."""


@dataclass(frozen=True, slots=True)
class Notice:
    """A warning about the validity of a result.

    `code` is stable and meant for programs. `message` names the exceeded range. `field` is the dotted name of an input
    without its unit.
    """

    code: str
    message: str
    field: str | None = None
    rank: Rank = "doubtful"


def unusual_value(field: str, message: str) -> Notice:
    """Return the warning about an unusual value of an input."""
    return Notice("unusual_value", message, field)
