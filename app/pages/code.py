"""A case as code that runs as it is: for a shell, and for Python with the client of the service."""

import json
import shlex
from pprint import pformat
from typing import Any

from app.calculations import Calculation
from app.schema.model import Request


def given(request: Request) -> dict[str, Any]:
    """The body of a request without what was left to its default."""
    return {name: value for name, value in request.model_dump(exclude_unset=True).items() if name != "detail"}


def for_shell(address: str, calculation: Calculation, body: dict[str, Any]) -> str:
    """A command for curl; `address` is that of the service."""
    sent = shlex.quote(json.dumps(body))
    return f"curl -s {address}{calculation.path} -H 'Content-Type: application/json' -d {sent}"


def for_python(address: str, calculation: Calculation, body: dict[str, Any]) -> str:
    """A program that asks the service at `address` and prints the answer's status."""
    method = calculation.path.rpartition("/")[2].replace("-", "_")
    return (
        "from app.client import Tribodrive\n\n"
        f'service = Tribodrive("{address}")\n'
        f"result = service.{method}(\n{_indented(pformat(body, width=100, sort_dicts=False))}\n)\n"
        'print(result["status"])\n'
    )


def _indented(text: str) -> str:
    return "\n".join(f"    {line}" for line in text.splitlines())
