"""The examples that come with the service: one JSON file a case, named after it."""

import json
from functools import lru_cache
from importlib.resources import files
from typing import Annotated, Any

from pydantic import BaseModel

from app.schema.quantities import Output

STARTER = "starter-"


class ExampleSummary(BaseModel):
    """What an example is about."""

    name: Annotated[str, Output("name in the address of the example")]
    title: Annotated[str, Output("what it shows")]
    source: Annotated[str, Output("where the case comes from")]
    endpoint: Annotated[str, Output("where to post its request")]

    @property
    def starter(self) -> bool:
        """Whether it is a task of practice to start from."""
        return self.name.startswith(STARTER)


class Example(ExampleSummary):
    """A ready request body."""

    request: Annotated[dict[str, Any], Output("the body to post")]


@lru_cache(maxsize=1)
def examples() -> dict[str, Example]:
    """Every example by name, the starters with industrial data first, then in alphabetical order."""
    stored = [path for path in files("app.examples").iterdir() if path.name.endswith(".json")]
    texts = {path.name.removesuffix(".json"): path.read_text("utf-8") for path in stored}
    ordered = sorted(texts, key=lambda name: (not name.startswith(STARTER), name))
    return {name: Example(name=name, **json.loads(texts[name])) for name in ordered}
