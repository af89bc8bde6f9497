"""The examples that come with the service. Each JSON file holds one case and has the name of this case."""

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
        """Whether the example is a practical task from which users can start."""
        return self.name.startswith(STARTER)


class Example(ExampleSummary):
    """An example with a request body that is ready to send."""

    request: Annotated[dict[str, Any], Output("the body to post")]


@lru_cache(maxsize=1)
def examples() -> dict[str, Example]:
    """Return all examples. The keys are the names of the examples.

    Starters within the limits of their models come first, then starters outside these limits, then all other examples.
    Each of these groups is in alphabetical order.
    """
    folders = [model / "examples" for model in files("app.models").iterdir() if (model / "examples").is_dir()]
    stored = [path for folder in folders for path in folder.iterdir() if path.name.endswith(".json")]
    texts = {path.name.removesuffix(".json"): path.read_text("utf-8") for path in stored}
    read = [Example(name=name, **json.loads(text)) for name, text in sorted(texts.items())]
    ordered = sorted(read, key=lambda example: (not example.starter, example.source == OUTSIDE))
    return {example.name: example for example in ordered}
