"""The examples that come with the service: one JSON file a case, named after it."""

import json
from functools import lru_cache
from importlib.resources import files
from typing import Annotated, Any

from fastapi import Body
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
    folder = files("app").joinpath("examples")
    texts = {path.name.removesuffix(".json"): path.read_text("utf-8") for path in folder.iterdir()}
    ordered = sorted(texts, key=lambda name: (not name.startswith(STARTER), name))
    return {name: Example(name=name, **json.loads(texts[name])) for name in ordered}


def body_of(endpoint: str) -> Any:
    """The body parameter of an endpoint, its examples on the docs page."""
    return Body(
        openapi_examples={
            example.name: {"summary": example.title, "description": example.source, "value": example.request}
            for example in examples().values()
            if example.endpoint == endpoint
        }
    )
