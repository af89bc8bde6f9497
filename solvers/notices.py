"""What a result has to say about its own validity."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Notice:
    """One warning: a stable `code`, a `message` that names the range, the dotted input `field` without unit."""

    code: str
    message: str
    field: str | None = None
