"""The answer as JSON."""

from app.calculations import Calculation
from app.evaluate import evaluate
from app.requests.common import Request
from app.responses.common import Response


def written(response: Response) -> bytes:
    """The response's fields that belong to its level of detail."""
    return response.model_dump_json(exclude_unset=True).encode()


def answer(calculation: Calculation, request: Request) -> bytes:
    """Solve the request and write its answer; runs in a worker process. Raises what `evaluate` raises."""
    return written(evaluate(calculation, request))
