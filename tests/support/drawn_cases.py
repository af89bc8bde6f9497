"""Cases drawn from the examples for tests of figures: a few numbers far from the usual, all of them legal."""

import random
from collections.abc import Iterator
from copy import deepcopy
from math import exp, log
from typing import Any

from app.calculations import Calculation
from app.errors import InvalidBody, Unprocessable
from app.evaluate import evaluate
from app.examples import examples
from app.schema.fields import Leaf, leaf_at, leaves
from app.schema.model import Documented
from app.schema.reading import validated
from app.studies.fields import is_number, set_value, value_at

CHANGES = 4  # numbers of an example that are drawn anew
REACH = 6.0  # times its value, or a part of it
TRIALS = 60


def drawn_cases(calculation: Calculation, count: int, seed: int) -> Iterator[tuple[Documented, Any]]:
    """Requests that have an answer, with their results."""
    choice = random.Random(f"{seed} {calculation.path}")
    alike = [each for each in examples().values() if each.endpoint == calculation.path]
    found = 0
    for _ in range(TRIALS):
        if found == count:
            return
        body = _body(calculation, deepcopy(choice.choice(alike).request), choice)
        try:
            request = validated(calculation.request, {**body, "detail": "fields"})
            answer = evaluate(calculation, request)
        except (InvalidBody, Unprocessable):
            continue
        if answer.status != "no_solution":
            found += 1
            yield request, answer
    raise AssertionError(f"{found} of {TRIALS} drawn cases of {calculation.path} have an answer")


def _body(calculation: Calculation, body: dict[str, Any], choice: random.Random) -> dict[str, Any]:
    """A request with some of its numbers drawn anew, its films by formulas alone."""
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
    """A number within the range of its field, as a rule by a factor away."""
    low, high = leaf.declared.bounds.get("ge", -1e9), leaf.declared.bounds.get("le", 1e9)
    far = value * exp(choice.uniform(-log(REACH), log(REACH))) if value else choice.uniform(-1.0, 1.0) * REACH
    near = min(max(far, low), high)
    return round(near) if leaf.kind == "integer" else float(f"{near:.4g}")
