"""Draw valid cases for tests of figures: examples in which a few numbers are replaced by unusual numbers."""

import random
from collections.abc import Iterator
from copy import deepcopy
from math import exp, log
from typing import Any

from app.calculations import Calculation
from app.errors import InvalidBody, Unprocessable
from app.evaluate import evaluate
from app.examples import examples
from app.schema.fields import Leaf, leaf_at, leaves, value_at
from app.schema.model import Documented
from app.schema.reading import validated
from app.studies.fields import is_number, set_value

CHANGES = 4  # numbers of an example that are drawn anew
REACH = 6.0  # times its value, or a part of it
TRIALS = 60


def drawn_cases(calculation: Calculation, count: int, seed: int) -> Iterator[tuple[Documented, Any]]:
    """Draw requests, and yield the first `count` requests that have a solution, with their answers.

    Raise AssertionError if 60 draws are not enough.
    """
    choice = random.Random(f"{seed} {calculation.path}")
    alike = [each for each in examples().values() if each.endpoint == calculation.path]
    found = 0
    for _ in range(TRIALS):
        body = _body(calculation, deepcopy(choice.choice(alike).request), choice)
        try:
            request = validated(calculation.request, {**body, "detail": "fields"})
            answer = evaluate(calculation, request)
        except (InvalidBody, Unprocessable):
            continue
        if answer.status != "no_solution":
            found += 1
            yield request, answer
            if found == count:
                return
    raise AssertionError(f"{found} of {TRIALS} drawn cases of {calculation.path} have an answer")


def _body(calculation: Calculation, body: dict[str, Any], choice: random.Random) -> dict[str, Any]:
    """Change up to four numbers of a request body at random. If the request can choose the film, choose formulas."""
    model = calculation.request
    if leaf_at(model, "model.lubrication"):
        set_value(model, body, "model.lubrication", "closed_form")
    given = [
        leaf for leaf in leaves(model) if leaf.is_scalar and _varies(leaf) and is_number(value_at(body, leaf.path))
    ]
    for leaf in choice.sample(given, min(CHANGES, len(given))):
        set_value(model, body, leaf.path, _drawn(leaf, float(value_at(body, leaf.path)), choice))
    return body


def _varies(leaf: Leaf) -> bool:
    return leaf.kind in {"number", "integer"} and not leaf.options and not leaf.path.startswith("model.")


def _drawn(leaf: Leaf, value: float, choice: random.Random) -> float:
    """Return `value` times a random factor between 1/6 and 6, limited to the range of the field.

    If `value` is 0, return a random number between -6 and 6, limited in the same way.
    """
    low, high = leaf.declared.bounds.get("ge", -1e9), leaf.declared.bounds.get("le", 1e9)
    far = value * exp(choice.uniform(-log(REACH), log(REACH))) if value else choice.uniform(-1.0, 1.0) * REACH
    near = min(max(far, low), high)
    return round(near) if leaf.kind == "integer" else float(f"{near:.4g}")
