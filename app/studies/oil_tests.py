"""Tests of oils in studies over the oil: the load stage at which an oil fails belongs to this oil and to no other.

If only the grade of an oil changes and its load stage stays, the limit that follows from the stage moves with the
grade: a thin oil then seems to need a thin film only. A study therefore holds the limit of the case, or takes the named
oils with the stages that their data sheets print.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from app.calculations import BY_PATH
from app.errors import Unprocessable
from app.figures.wording import number
from app.models.sections.oil import OF_A_NAME, Oil
from app.schema.fields import leaf_at, value_at
from app.schema.model import Documented
from app.studies.points import SOLVED, Question, solve_point
from app.studies.requests import Overrides
from app.studies.runner import Pool, twice_if_lost
from solvers.named_oils import NamedOil, named_oils

NAME = "lubricant.name"
LUBRICANT = "lubricant."
OF_AN_OIL = ("iso_vg", "viscosity_pa_s", *OF_A_NAME, "viscosity_index", "name")
"""The fields whose values make another oil."""


class OilTest(NamedTuple):
    """A test of an oil, and the limit that follows from it."""

    title: str
    stage: str
    absent: str  # what is null in a request without the test
    limit: str  # field that gives the limit instead of the test
    name: str  # of this limit
    unit: str | None
    results: tuple[str, ...]  # where answers state the limit
    judged: str  # pattern of the outputs that depend on the limit
    printed: str  # field of `NamedOil`

    def judges(self, outputs: Iterable[str]) -> bool:
        """Return whether one of the outputs depends on the limit."""
        return any(re.match(self.judged, output) for output in outputs)


TESTS = (
    OilTest(
        "FZG load stage",
        "temperatures.scuffing_test.fzg_stage",
        "temperatures.scuffing_test",
        "temperatures.scuffing_c",
        "scuffing temperature",
        "°C",
        ("safety.scuffing_c", "derived.temperatures.scuffing_c"),
        r"(?!.*micropitting).*safety",
        "fzg_stage",
    ),
    OilTest(
        "Micropitting load stage",
        "micropitting.failure_load_stage",
        "micropitting.failure_load_stage",
        "micropitting.permissible_ratio",
        "permissible film",
        None,
        ("micropitting.permissible_ratio",),
        r".*micropitting.*safety",
        "micropitting_stage",
    ),
)


def is_of_an_oil(path: str) -> bool:
    """Return whether another value of the request field makes another oil."""
    return path.startswith(LUBRICANT) and path.removeprefix(LUBRICANT) in OF_AN_OIL


def tests_moved(case: Any, varied: Iterable[str], outputs: Sequence[str]) -> dict[OilTest, int]:
    """Return the tests of the case's oil on which an output depends, with their stages, if a study varies the oil.

    A test whose stage or limit varies too follows the oil already.
    """
    fields = {*varied}
    if not any(map(is_of_an_oil, fields)):
        return {}
    fixed = (test for test in TESTS if not fields & {test.stage, test.absent, test.limit})
    return {test: stage for test in fixed if test.judges(outputs) and (stage := value_at(case, test.stage)) is not None}


def remarks_on(tests: Mapping[OilTest, int], held: Overrides) -> list[str]:
    """Say of each test that its stage belongs to the oil of the case, and what follows for the numbers of a study."""
    remarks = []
    for test, stage in tests.items():
        belongs = f"{test.title} {stage} belongs to the oil of the case; another oil fails at another stage"
        limit: Any = held.get(test.limit)
        if limit is not None:
            remarks.append(f"{belongs}. So the {test.name} of the case is held: {number(limit, test.unit)}")
        else:
            remarks.append(f"{belongs}. Yet here the {test.name} follows this stage at every oil")
    return remarks


def candidates(model: type[Documented], body: Any, case: Any, outputs: Sequence[str]) -> dict[NamedOil, Overrides]:
    """Return the named oils, thinnest first, with what each changes in a request; nothing else says what oil it is.

    An oil brings its own load stages, unless the case gives their limits. It is left out if an output depends on a
    stage that its sheet does not print.
    """
    tests = [test for test in TESTS if _is_open(test, model, case)]
    needed = [test for test in tests if test.judges(outputs)]
    given = value_at(body, "lubricant") or ()
    described: Overrides = {f"{LUBRICANT}{name}": None for name in given if name in Oil.model_fields}
    found: dict[NamedOil, Overrides] = {}
    for oil in sorted(named_oils().values(), key=lambda each: each.kinematic_viscosity_40_mm2_per_s):
        if all(getattr(oil, test.printed) for test in needed):
            found[oil] = dict(described)
            found[oil][NAME], found[oil][f"{LUBRICANT}kind"] = oil.name, oil.kind
            for test in tests:
                stage = getattr(oil, test.printed)
                found[oil] |= {test.stage: stage} if stage else {test.absent: None}
    return found


def _is_open(test: OilTest, model: type[Documented], case: Any) -> bool:
    """Return whether the case leaves the limit of a test to the oil."""
    section = test.stage.partition(".")[0]
    return (
        leaf_at(model, test.stage) is not None
        and value_at(case, section) is not None
        and value_at(case, test.limit) is None
    )


async def hold(pool: Pool, question: Question, tests: Iterable[OilTest], first: Overrides) -> Overrides:
    """Return the limits to hold, calculated in a process of the pool. Raises Unprocessable if one has no value."""
    held: Overrides = await twice_if_lost(pool, held_limits, question, [*tests], first)
    lacking = [test.name for test in tests if held[test.limit] is None]
    if lacking:
        raise Unprocessable(
            "no_limit", f"the case as described has no {' and no '.join(lacking)} to be held", "oil_tests"
        )
    return held


def held_limits(question: Question, tests: Sequence[OilTest], first: Overrides) -> Overrides:
    """Return the limits that the tests prove for the case as described; None for one that has no value.

    If the case lacks the field that the study varies, the request of the first point is taken. This runs in a worker.
    """
    response = BY_PATH[question.endpoint].response
    results = [next(path for path in test.results if leaf_at(response, path)) for test in tests]
    asked = question._replace(outputs=results)
    points = (solve_point(asked, overrides) for overrides in ({}, first))
    point = next((point for point in points if point.status in SOLVED), None)
    limits = [None] * len(tests) if point is None else point.out
    return {test.limit: limit for test, limit in zip(tests, limits, strict=True)}
