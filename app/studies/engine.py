"""The names that the HTTP layer still imports from here."""

from app.studies.runner import (
    PROGRESS_S,
    Clock,
    Line,
    Lines,
    Study,
    encoded,
    guarded,
    json_line,
    twice_if_lost,
)

__all__ = [
    "PROGRESS_S",
    "Clock",
    "Line",
    "Lines",
    "Study",
    "encoded",
    "guarded",
    "json_line",
    "twice_if_lost",
]
