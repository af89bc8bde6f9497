"""Cases that a search once found, stored as the inputs they are: `tests/cases`, one file a model, one line a case."""

import json
from pathlib import Path
from typing import TypeVar

from pydantic import ConfigDict, TypeAdapter

CASES = Path(__file__).parents[1] / "cases"
Inputs = TypeVar("Inputs")


def stored(kind: type[Inputs], model: str, name: str) -> list[Inputs]:
    """The cases of a name in the file of a model; what they leave out is the default of `kind`."""
    cases = json.loads((CASES / f"{model}.json").read_text("utf-8"))[name]
    return TypeAdapter(list[kind], config=ConfigDict(extra="forbid")).validate_python(cases)  # type: ignore[valid-type]
