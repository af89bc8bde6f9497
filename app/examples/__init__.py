"""The examples that come with the service: one JSON file a case, named after it."""

import json
from functools import lru_cache
from importlib.resources import files
from typing import Annotated, Any

from pydantic import BaseModel

from app.schema.quantities import Output

STARTER = "starter-"
OUTSIDE = "starter: outside its limits"


class ExampleSummary(BaseModel):
    """Name, subject, source and endpoint of an example."""

    name: Annotated[str, Output("name in the address of the example")]
    title: Annotated[str, Output("what it shows")]
    source: Annotated[str, Output("where the case comes from")]
    endpoint: Annotated[str, Output("where to post its request")]

    @property
    def starter(self) -> bool:
        """Whether it is a task of practice to start from."""
        return self.name.startswith(STARTER)


class Example(ExampleSummary):
    """An example with a request body that is ready to send."""

    request: Annotated[dict[str, Any], Output("the body to post")]


@lru_cache(maxsize=1)
def examples() -> dict[str, Example]:
    """Every example by name: starters, starters outside the limits, the others; each in alphabetical order."""
    stored = [path for path in files("app.examples").iterdir() if path.name.endswith(".json")]
    texts = {path.name.removesuffix(".json"): path.read_text("utf-8") for path in stored}
    read = [Example(name=name, **json.loads(text)) for name, text in sorted(texts.items())]
    ordered = sorted(read, key=lambda example: (not example.starter, example.source == OUTSIDE))
    return {example.name: example for example in ordered}
