"""What an about page is made of."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Equation:
    """An equation that is computed, by the number of the paper."""

    number: str
    says: str
    formula: str


@dataclass(frozen=True, slots=True)
class Misprint:
    """What is printed, what is computed instead, and how that is known."""

    place: str
    printed: str
    computed: str
    reason: str


@dataclass(frozen=True, slots=True)
class About:
    """A model: what it answers, how, where the paper is wrong, how far to trust it."""

    title: str
    paper: str
    answers: tuple[str, ...]
    equations: tuple[Equation, ...]
    misprints: tuple[Misprint, ...]
    limits: tuple[str, ...]
