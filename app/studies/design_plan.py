"""The design search that a body asks for: its variables, corners and operating points checked against the schema."""

from typing import Any

from app.problems import Unprocessable
from app.reading import read
from app.schema.fields import Leaf
from app.studies.design import Choice, Design
from app.studies.fields import value_at
from app.studies.outputs import output
from app.studies.plan import Varied, check_count, check_distinct, check_value, grid, listed
from app.studies.points import Question
from app.studies.reading import calculation_of, case_of_study, checked_base
from app.studies.requests import Overrides
from app.studies.unit import MOST_CORNERS, lightened
from app.studies.unit_requests import ENDPOINT, DesignRequest, Variable

PATH = f"{ENDPOINT}/design"
NUMBERS = {"number", "integer"}


def plan_design(body: bytes, most: int, deadline_s: float) -> Design:
    """The search that a body asks for; runs in a worker.

    Raises Unreadable, InvalidBody and Unprocessable, with locations in the study.
    """
    request = read(DesignRequest, body)
    calculation = calculation_of(request)
    objective = output(calculation, request.objective, "objective")
    if objective.kind not in NUMBERS:
        raise Unprocessable("unknown_output", f"{request.objective} is no number", "objective")
    varied = Varied(calculation.request, request.request)
    choices = tuple(_choice(each, varied, f"variables.{place}") for place, each in enumerate(request.variables))
    cases = _cases(request, varied)
    check_count(request.evaluations * len(cases), most, "evaluations")
    base = checked_base(calculation, request.request, cases[0]).model_dump()
    return Design(
        question=Question(calculation.path, lightened(request.request, [objective.path]), [objective.path], deadline_s),
        choices=choices,
        cases=cases,
        objective=objective,
        sign=_sign(request, objective),
        start=tuple(_share(choice, base) for choice in choices),
        evaluations=request.evaluations,
        case=case_of_study(PATH, request),
    )


def _choice(variable: Variable, request: Varied, place: str) -> Choice:
    leaves = tuple(request.leaf(path, f"{place}.path") for path in variable.paths)
    for leaf in leaves:
        if leaf.kind != "number":
            raise Unprocessable("not_continuous", f"{leaf.path} takes no numbers between others", f"{place}.path")
        for value in (variable.min, variable.max):
            check_value(leaf, value, place)
    if not variable.min < variable.max:
        raise Unprocessable("variable_range", "a variable needs a range from min to max", place)
    return Choice(leaves, variable.min, variable.max)


def _cases(request: DesignRequest, varied: Varied) -> list[Overrides]:
    """Every operating point at every corner."""
    corners: list[Overrides] = [{}]
    if request.corners is not None:
        plan = grid(request.corners, varied, "corners", MOST_CORNERS)
        corners = [plan.overrides(index) for index in range(plan.total)]
    points = [{}] if request.collective is None else request.collective
    listed(points, varied, MOST_CORNERS, "collective")
    check_count(len(points) * len(corners), MOST_CORNERS, "corners")
    chosen = [path for variable in request.variables for path in variable.paths]
    for place, paths in (
        ("variables", []),
        ("corners", corners[0]),
        ("collective", {path for p in points for path in p}),
    ):
        chosen += paths
        check_distinct(chosen, place)
    return [{**point, **corner} for point in points for corner in corners]


def _sign(request: DesignRequest, objective: Leaf) -> float:
    """What makes the objective a figure to be made small."""
    if request.direction is not None:
        return -1.0 if request.direction == "maximise" else 1.0
    if objective.bound is None:
        message = f"{objective.path} has no safe side of its own; say maximise or minimise"
        raise Unprocessable("direction_missing", message, "direction")
    return -1.0 if objective.bound == "lower" else 1.0


def _share(choice: Choice, case: dict[str, Any]) -> float:
    """Where the case itself stands in the range, at its lower end where it has no number."""
    own = value_at(case, choice.leaves[0].path)
    return 0.0 if own is None else min(max((own - choice.low) / (choice.high - choice.low), 0.0), 1.0)
