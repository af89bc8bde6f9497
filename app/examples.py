"""The examples that come with the service: one JSON file a case, named as the case, and the studies of a model."""

import json
from functools import cache, lru_cache
from importlib.resources import files
from importlib.resources.abc import Traversable
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
    folders = [model / "examples" for model in _models() if (model / "examples").is_dir()]
    stored = [path for folder in folders for path in folder.iterdir() if path.name.endswith(".json")]
    texts = {path.name.removesuffix(".json"): path.read_text("utf-8") for path in stored}
    read = [Example(name=name, **json.loads(text)) for name, text in sorted(texts.items())]
    ordered = sorted(read, key=lambda example: (not example.starter, example.source == OUTSIDE))
    return {example.name: example for example in ordered}


def _models() -> list[Traversable]:
    return sorted(files("app.models").iterdir(), key=lambda model: model.name)


class ExampleStudies(BaseModel):
    """The studies of the examples of a model.

    `pages` are questions with the controls of the page that answers them, `bodies` bodies to post, by the path of the
    kind of study, and `pictures` the studies that chapters of the manual show. Each names an example.
    """

    pages: list[dict[str, Any]] = []
    bodies: dict[str, dict[str, Any]] = {}
    pictures: dict[str, dict[str, Any]] = {}


@cache
def studies() -> tuple[ExampleStudies, ...]:
    """Return the studies of all models."""
    stored = (model / "studies.json" for model in _models())
    return tuple(ExampleStudies.model_validate_json(path.read_text("utf-8")) for path in stored if path.is_file())


@cache
def study_bodies(kind: str) -> dict[str, Any]:
    """Return examples of bodies for the kind of study at a path, in the form of OpenAPI: a `summary` and a `value`."""
    bodies = {name: body for model in studies() for name, body in model.bodies.get(kind, {}).items()}
    return {
        name: body | {"value": body["value"] | {"request": examples()[body["value"]["request"]].request}}
        for name, body in bodies.items()
    }
