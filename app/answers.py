"""From a validated request to the bytes of its answer; runs in a worker process."""

from app.calculations import Calculation
from app.conversion import assumptions, field_path, from_si
from app.problems import Unprocessable
from app.requests.common import Request
from app.responses.common import MODEL_VERSION, Notice, Response
from solvers import notices
from solvers.errors import InvalidInput, NoSolution


def answer(calculation: Calculation, request: Request) -> bytes:
    """Solve the request and write the response as JSON.

    Raises Unprocessable where the solver finds the input impossible, and a validation error (never an answer) where
    a result is not finite.
    """
    resolved = request.resolved()
    try:
        result = calculation.solve(resolved.inputs())
    except InvalidInput as error:
        path = field_path(request, error.field) if error.field else None
        raise Unprocessable(error.code, error.message, path) from error
    except NoSolution as failure:
        warning = Notice(code=failure.code, message=failure.message)
        content = {"status": "no_solution", "warnings": [warning], "residuals": failure.residuals}
    else:
        warnings = [_notice(request, warning) for warning in result.warnings]
        content = from_si(calculation.response, result, request.detail, skip=frozenset(Response.model_fields))
        content |= {"status": "ok_with_warnings" if warnings else "ok", "warnings": warnings}
        if getattr(result, "status", None) == "no_solution":
            content |= {"status": "no_solution", "residuals": result.residuals}
    content |= {
        "assumptions": assumptions(request, resolved),
        "model_version": MODEL_VERSION,
        "model": resolved.options(),
    }
    return calculation.response.model_validate(content).model_dump_json(exclude_unset=True).encode()


def _notice(request: Request, warning: notices.Notice) -> Notice:
    field = field_path(request, warning.field) if warning.field else None
    return Notice(code=warning.code, message=warning.message, field=field)
