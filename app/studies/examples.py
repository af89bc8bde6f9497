"""Bodies to start from, for the docs page of the studies; `examples.json` names the requests in them."""

import json
from importlib.resources import files
from typing import Any

from app.examples import examples

EXAMPLES: dict[str, dict[str, Any]] = json.loads(files("app.studies").joinpath("examples.json").read_text("utf-8"))
"""By the path of the study, each as OpenAPI has it: a `summary` and a `value`."""

for _bodies in EXAMPLES.values():
    for _each in _bodies.values():
        _each["value"]["request"] = examples()[_each["value"]["request"]].request
