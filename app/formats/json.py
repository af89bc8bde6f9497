"""The answer as JSON."""

from app.calculations import Calculation
from app.evaluate import evaluate
from app.schema.base import Request, Response
from app.schema.conversion import above
from solvers.quantity import Detail


def written(response: Response, detail: Detail = "fields") -> bytes:
    """The response's fields, those above a level of detail left out."""
    return response.model_dump_json(exclude_unset=True, exclude=above(type(response), detail)).encode()


def answer(calculation: Calculation, request: Request) -> bytes:
    """Solve the request and write its answer; runs in a worker process. Raises what `evaluate` raises."""
    return written(evaluate(calculation, request))
