"""Cases that once failed in a search with random inputs.

The folder `tests/cases` has one file per model. A line of a file holds the inputs of one case.
"""

import json
from pathlib import Path
from typing import TypeVar

from pydantic import ConfigDict, TypeAdapter

CASES = Path(__file__).parents[1] / "cases"
Inputs = TypeVar("Inputs")


def stored(kind: type[Inputs], model: str, name: str) -> list[Inputs]:
    """Return the cases that have a name in the file of a model."""
    # The cases are objects of the class `kind`. Fields that the file leaves out have the default values of this class.
    cases = json.loads((CASES / f"{model}.json").read_text("utf-8"))[name]
    return TypeAdapter(list[kind], config=ConfigDict(extra="forbid")).validate_python(cases)  # type: ignore[valid-type]
