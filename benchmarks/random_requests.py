"""Solve random requests to every endpoint, and report exceptions, NaN, infinity and late answers.

The requests fit the schema; some values are ends of their ranges. The requests are solved in this process. Run from the
project's root: python -m benchmarks.random_requests --count 100000. Each request has its own seed. The seed is printed
if the request fails or is late; --seed with --count 1 repeats this request. Slow endpoints get fewer requests, because
their requests would otherwise take most of the time.
"""

import argparse
import copy
import json
import math
import random
import time
import traceback
from collections import Counter
from functools import cache
from typing import Any

from app.calculations import BY_PATH, CALCULATIONS, Calculation
from app.errors import InvalidBody, Unprocessable
from app.evaluate import answer_of, refuse_endless
from app.examples import examples
from app.schema.reading import validated
from app.settings import settings

RANGE_END = 0.15
FROM_NOTHING = 0.2
MOST_CHANGES = 5
LONGEST_LIST = 12
SHARES = {
    "/v1/pumping": 0.3,
    "/v1/pumping/choking-speed": 0.02,
    "/v1/scuffing": 0.02,
    "/v1/drive-train": 0.02,
    "/v1/drive-train/warm-up": 0.01,
}
Schema = dict[str, Any]


class Draw:
    """A generator of random values for a JSON schema."""

    def __init__(self, document: Schema, choice: random.Random) -> None:
        self._document = document
        self._choice = choice

    def resolved(self, schema: Schema) -> Schema:
        """Return the schema that a reference points to, or the schema itself if it is not a reference."""
        while "$ref" in schema:
            schema = self._document["$defs"][schema["$ref"].rsplit("/", 1)[1]]
        return schema

    def value(self, schema: Schema) -> Any:
        """Draw a random value for a schema."""
        schema = self.resolved(schema)
        if "anyOf" in schema:
            return self.value(self._choice.choice(schema["anyOf"]))
        if "const" in schema:
            return schema["const"]
        if "enum" in schema:
            return self._choice.choice(schema["enum"])
        return getattr(self, f"_{schema['type']}")(schema)

    def _array(self, schema: Schema) -> list[Any]:
        return [self.value(schema["items"]) for _ in range(self._length(schema))]

    def _boolean(self, _schema: Schema) -> bool:
        return self._choice.random() < 0.5

    def _null(self, _schema: Schema) -> None:
        return None

    def _string(self, schema: Schema) -> str:
        return "x" * int(schema.get("minLength", 0))

    def _integer(self, schema: Schema) -> int:
        return round(self._number(schema))

    def _object(self, schema: Schema) -> dict[str, Any]:
        required = schema.get("required", ())
        return {
            name: self.value(field)
            for name, field in schema.get("properties", {}).items()
            if name in required or self._choice.random() < 0.3
        }

    def _length(self, schema: Schema) -> int:
        low = schema.get("minItems", 0)
        return self._choice.randint(low, max(low, min(schema.get("maxItems", LONGEST_LIST), LONGEST_LIST)))

    def _number(self, schema: Schema) -> float:
        low, high = self._range(schema)
        if self._choice.random() < RANGE_END:
            return self._choice.choice((low, high))
        if low > 0 and high / low > 100:
            return min(high, max(low, math.exp(self._choice.uniform(math.log(low), math.log(high)))))
        return self._choice.uniform(low, high)

    def _range(self, schema: Schema) -> tuple[float, float]:
        whole = schema["type"] == "integer"
        low, high = schema.get("minimum", -1e6), schema.get("maximum", 1e6)
        if "exclusiveMinimum" in schema:
            edge = schema["exclusiveMinimum"]
            low = edge + 1 if whole else math.nextafter(edge, math.inf)
        if "exclusiveMaximum" in schema:
            edge = schema["exclusiveMaximum"]
            high = edge - 1 if whole else math.nextafter(edge, -math.inf)
        return low, high


def leaves(schema: Schema, draw: Draw, path: tuple[str, ...] = ()) -> list[tuple[tuple[str, ...], Schema]]:
    """Return the path and the schema of every field of a request. An object is replaced by its fields."""
    schema = draw.resolved(schema)
    if schema.get("type") != "object":
        return [(path, schema)]
    return [leaf for name, field in schema["properties"].items() for leaf in leaves(field, draw, (*path, name))]


@cache
def schema_of(calculation: Calculation) -> Schema:
    """Return the JSON schema of the requests to the endpoint of a calculation."""
    return calculation.request.model_json_schema()


def request(seed: int) -> tuple[str, dict[str, Any]]:
    """Return the endpoint and the body of the random request with this seed.

    The body is an example with some random fields, or the body is entirely random.
    """
    choice = random.Random(seed)
    calculation = choice.choices(CALCULATIONS, [SHARES.get(listed.path, 1.0) for listed in CALCULATIONS])[0]
    document = schema_of(calculation)
    draw = Draw(document, choice)
    similar = [example for example in examples().values() if example.endpoint == calculation.path]
    if not similar or choice.random() < FROM_NOTHING:
        return calculation.path, draw.value(document)
    body = copy.deepcopy(choice.choice(similar).request)
    fields = leaves(document, draw)
    for path, schema in choice.sample(fields, min(len(fields), choice.randint(1, MOST_CHANGES))):
        section = body
        for name in path[:-1]:
            section = section.setdefault(name, {})
        section[path[-1]] = draw.value(schema)
    return calculation.path, body


def refuse(constant: str) -> float:
    """Raise ValueError. The JSON parser calls this function if an answer contains NaN or infinity."""
    raise ValueError(f"{constant} in the answer")


def solve_random(seed: int) -> tuple[str, str, float]:
    """Solve the random request with this seed, and return endpoint, outcome and CPU time [s].

    The outcome is the status of the answer, the code of the refusal, or "FAILED" after any other exception.
    """
    path, body = request(seed)
    began = time.process_time()  # other processes on the machine do not count
    try:
        wanted = validated(BY_PATH[path].request, body)
        refuse_endless(BY_PATH[path], wanted, settings().deadline_s)
        content = answer_of(path, wanted)
        outcome = str(json.loads(content, parse_constant=refuse)["status"])
    except Unprocessable as refusal:
        outcome = f"refused: {refusal.code}"
    except InvalidBody as refusal:
        outcome = f"invalid: {refusal.faults[0].code}"
    except Exception:  # noqa: BLE001  any exception is a failure to report
        print(f"seed {seed}: {path} {json.dumps(body)}\n{traceback.format_exc()}", flush=True)
        outcome = "FAILED"
    return path, outcome, time.process_time() - began


def main(first: int, count: int) -> None:
    """Solve the requests with `count` consecutive seeds.

    Print the number of requests per endpoint and per outcome, and the five longest times.
    """
    outcomes: Counter[str] = Counter()
    asked: Counter[str] = Counter()
    late: list[tuple[float, int]] = []
    print(f"seeds {first} to {first + count - 1}")
    for seed in range(first, first + count):
        path, outcome, seconds = solve_random(seed)
        asked[path] += 1
        outcomes[outcome] += 1
        late.append((seconds, seed))
        if seconds > settings().deadline_s:
            print(f"seed {seed}: beyond the deadline, {seconds:.1f} s", flush=True)
            outcomes["LATE"] += 1
    for counts in (asked, outcomes):
        for what, number in counts.most_common():
            print(f"{number:>8} {what}")
    print("slowest: " + ", ".join(f"{seconds:.1f} s (seed {seed})" for seconds, seed in sorted(late)[:-6:-1]))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1, help="the first")
    parser.add_argument("--count", type=int, default=1000, help="how many requests")
    arguments = parser.parse_args()
    main(arguments.seed, arguments.count)
