"""The price of a tolerance: how probable damage is by quality class, for one correction, and which input dominates.

Damage is scuffing or micropitting; the more probable one counts. The contact temperature is compared with the scuffing
temperature of the machine, the safety against micropitting with 1; both limits scatter normally by 15 %.
"""

from collections.abc import AsyncGenerator, Callable, Sequence
from math import inf, nan
from typing import Any, NamedTuple

import numpy as np

from app.calculations import BY_PATH
from app.errors import Unprocessable
from app.schema.fields import value_at
from app.schema.model import Request
from app.studies import runner, statistics
from app.studies.machines import PAIR, MachineDraws, Machines, Variation
from app.studies.points import BaseRequest, Question, reduced_request
from app.studies.requests import DRIVE_TRAIN, Overrides
from app.studies.runner import Clock, Line, Pool
from app.studies.statistics import ASSUMED_DEVIATION, RELATIVE_DEVIATION, Limit
from solvers.arrays import FloatArray

MORE = 0.1  # a class is worth its price if the probability rises by less than this share; chosen
SURE = 0.95  # confidence of a sure comparison, on one side
FILM_SAFETY = "micropitting.local.safety"
SCUFFING, MICROPITTING = "scuffing", "micropitting"
ASSUMED_FILM = "the permissible film scatters by 0.15 of itself, as the scuffing temperature does; no source is known"
PROBABILITY = {"path": "probability", "unit": None, "title": "probability of damage"}
LEAST = 1e-12  # probabilities below are not compared, because nobody knows the tails of the distributions so far out


class Damage(NamedTuple):
    """A kind of damage that the case allows to judge, and the columns of outputs that it compares."""

    name: str
    columns: tuple[str, ...]


def damages(request: Request) -> list[Damage]:
    """Return the kinds of damage whose limits a case states; raise Unprocessable (`no_limit`) if there are none."""
    paths = BY_PATH[DRIVE_TRAIN].words.scuffing
    assert paths is not None
    found = []
    temperatures: Any = value_at(request, "temperatures")
    if temperatures.scuffing_c is not None or temperatures.scuffing_test is not None:
        found.append(Damage(SCUFFING, (paths.contact, paths.limit)))
    film: Any = value_at(request, "micropitting")
    if film is not None and not (film.failure_load_stage is None and film.permissible_ratio is None):
        found.append(Damage(MICROPITTING, (FILM_SAFETY,)))
    if not found:
        message = (
            "a probability needs a limit: give the scuffing temperature or the scuffing test of the oil, or its "
            "micropitting test"
        )
        raise Unprocessable("no_limit", message, "request")
    return found


def columns_of(kinds: Sequence[Damage]) -> list[str]:
    """Return the outputs that the kinds of damage compare."""
    return [column for kind in kinds for column in kind.columns]


def assumptions(kinds: Sequence[Damage]) -> list[Line]:
    """Say what is assumed of the limits."""
    reasons = {SCUFFING: ASSUMED_DEVIATION, MICROPITTING: ASSUMED_FILM}
    return [{"field": "limits", "value": RELATIVE_DEVIATION, "reason": reasons[kind.name]} for kind in kinds]


def judged(kinds: Sequence[Damage], values: FloatArray) -> dict[str, tuple[Limit, FloatArray]]:
    """Return limit and limited output `[replicate, draw, case]` of each kind, from the outputs of `columns_of`."""
    found, column = {}, 0
    for kind in kinds:
        output, limit = values[..., column], Limit("below", 1.0, RELATIVE_DEVIATION, kind.columns[0])
        if kind.name == SCUFFING:
            own = values[..., column + 1]
            mean = float(np.median(own[~np.isnan(own)])) if not np.isnan(own).all() else 1.0
            limit = Limit("above", mean, RELATIVE_DEVIATION * abs(mean), kind.columns[0], own)
        found[kind.name] = limit, output
        column += len(kind.columns)
    return found


def probability(kinds: Sequence[Damage], values: FloatArray) -> Line:
    """Return the probability of each kind of damage over machines, and that of the more probable kind (`kind`).

    `worst` and `worst_case` are the machine and the load case that come closest to the damage.
    """
    estimates = {name: statistics.of_spectrum(output, limit) for name, (limit, output) in judged(kinds, values).items()}
    kind = max(estimates, key=lambda name: estimates[name].bounds[1])
    unsolved = np.isnan(values).any(axis=(-1, -2))
    limit, output = judged(kinds, values)[kind]
    chances = np.nan_to_num(limit.exceeded(output), nan=-1.0).reshape(unsolved.size, -1)
    worst, worst_case = divmod(int(chances.argmax()), chances.shape[1])
    parts = {name: estimate._asdict() for name, estimate in estimates.items()}
    for name in parts.keys() - {SCUFFING}:
        parts[name]["risk"] = None  # the words of AGMA 925-A03 are about scuffing
    places = {"worst": worst, "worst_case": worst_case}
    return {**parts[kind], "kind": kind, "unsolved": float(unsolved.mean()), **places, "kinds": parts}


def _by_replicate(kinds: Sequence[Damage], values: FloatArray, kind: str) -> FloatArray:
    """Probability of a kind of damage in each replicate; machines with an unsolved case count as damaged."""
    limit, output = judged(kinds, values)[kind]
    return np.asarray(np.nan_to_num(limit.exceeded(output).max(axis=-1), nan=1.0).mean(axis=1))


def of_class(kinds: Sequence[Damage], values: FloatArray, exact: FloatArray) -> Line:
    """Return the probability of damage, and `more`: by which share it exceeds that with exact flanks, over equal draws.

    Machines with an unsolved case count as damaged. `more_error` is the standard error of `more`; None with one
    replicate. Both are 0 if neither damage is probable, and None if only exact flanks are safe: no finite share would
    tell by how much. `enough` says whether the class costs less than a tenth more.
    """
    found, reference = probability(kinds, values), _by_replicate(kinds, exact, probability(kinds, exact)["kind"])
    own = _by_replicate(kinds, values, found["kind"])
    more: float | None = None
    error: float | None = None
    if max(own.mean(), reference.mean()) <= LEAST:
        more = error = 0.0
    elif reference.mean() > LEAST:
        ratio = float(own.mean() / reference.mean())
        more = ratio - 1.0
        if own.size > 1:
            rest = own - ratio * reference  # error of a ratio of means, to first order
            error = float(rest.std(ddof=1) / np.sqrt(own.size) / reference.mean())
    return {**found, "more": more, "more_error": error, "enough": more is not None and more < MORE}


def coarsest(rows: Sequence[Line], replicates: int) -> tuple[int | None, bool]:
    """Return the coarsest class that costs less than a tenth more, and whether the draws leave that open.

    The classes are in rising order; a class after one that costs more does not count.
    """
    from scipy.stats import t  # noqa: PLC0415  half a second that only studies need

    reach = float(t.ppf(SURE, replicates - 1)) if replicates > 1 else inf  # a few samples know their error badly
    found, is_open = None, False
    for row in rows:
        more, error = row["more"], row["more_error"]
        if more is not None:
            is_open |= error is None or abs(more - MORE) < reach * error
        if not row["enough"]:
            break
        found = row["quality_class"]
    return found, is_open


def influences(
    kinds: Sequence[Damage], kind: str, nominal: FloatArray, values: FloatArray, varied: Sequence[Variation]
) -> list[Line]:
    """Return what each quantity alone does to the margin of a kind of damage, the most influential first.

    `range` is the largest minus the least margin over the nominal unit and the rows of the quantity, in standard
    deviations of the limit, None without a solution; `share` is its square over the sum of all squares.
    """
    margins, base = (_margins(kinds, kind, each) for each in (values, nominal))
    found, place = list[Line](), 0
    for each in varied:
        own = np.append(margins[place : place + len(each.rows)], base)
        place += len(each.rows)
        known = own[~np.isnan(own)]
        reach = float(np.ptp(known)) if known.size > 1 else None
        found.append({"name": each.name, "paths": each.paths, "range": reach})
    whole = sum((line["range"] or 0.0) ** 2 for line in found)
    shared = [{**line, "share": (line["range"] or 0.0) ** 2 / whole if whole else None} for line in found]
    return sorted(shared, key=lambda line: -(line["range"] or 0.0))


def _margins(kinds: Sequence[Damage], kind: str, values: FloatArray) -> FloatArray:
    """How far each machine is beyond its limit in its worst case, in standard deviations of the limit."""
    limit, output = judged(kinds, values)[kind]
    return np.asarray(limit.margins(output).max(axis=-1).ravel())


class Pricing:
    """The machines by which a study judges corrections, in every load case."""

    def __init__(
        self, base: BaseRequest, given: MachineDraws, load_cases: list[Overrides], elsewhere: set[str], asked: Question
    ) -> None:
        self.machines = Machines(given, base, load_cases[0], elsewhere, "tolerances")
        self.load_cases = load_cases
        self.kinds = damages(base.checked({**self.machines.typical, **load_cases[0]}))
        columns = columns_of(self.kinds)
        request = reduced_request(asked.endpoint, base.body, columns)
        self.question = asked._replace(base=request, outputs=columns)

    @property
    def points_per_trial(self) -> int:
        """The number of points at which the search judges a correction: those of one sample."""
        return PAIR * self.machines.given.count * len(self.load_cases)

    @property
    def points(self) -> int:
        """The number of points of a price.

        Nominal, as described, with exact flanks and with those of every class, and each quantity varied alone.
        """
        machines = self.machines
        alone = sum(len(each.rows) for each in machines.variations({}))
        drawn = machines.total // PAIR + machines.total * (1 + len(machines.classes))
        return len(self.load_cases) * (1 + drawn + alone)

    async def trial(self, pool: Pool, clock: Clock, at: Overrides, flow: float | None) -> tuple[Line, float | None]:
        """Judge a correction over the first sample; return what a trial states, and its probability of damage.

        The probability is None if no machine has a solution. Machines without solution count as damaged.
        """
        machines = self.machines
        values = await self._drawn(pool, clock, at, machines.reference, flow, samples=1)
        found = await runner.twice_if_lost(pool, probability, self.kinds, values)
        chance = None if found["unsolved"] == 1.0 else float(found["bounds"][1])
        worst = machines.overrides(found["worst"], machines.reference, at) | self.load_cases[found["worst_case"]]
        return {"at": at, "objective": chance, "worst_corner": {} if chance is None else worst}, chance

    async def lines(self, pool: Pool, clock: Clock, at: Overrides, flow: float | None) -> AsyncGenerator[Line, None]:
        """Yield what a correction costs by each quality class, and at last all of its price."""
        machines, kinds = self.machines, self.kinds
        fixed = await self._solved(pool, clock, lambda case: {**at, **self.load_cases[case]}, 1, flow)
        exact = await self._drawn(pool, clock, at, None, flow)
        rows: list[Line] = []
        for quality_class in machines.classes:
            values = await self._drawn(pool, clock, at, quality_class, flow)
            widths = {
                path.removeprefix("modifications."): width for path, width in machines.tolerances[quality_class].items()
            }
            found = await runner.twice_if_lost(pool, of_class, kinds, values, exact)
            rows.append({"quality_class": quality_class, "tolerances": widths, **found})
            yield rows[-1]
        described = await self._drawn(pool, clock, {}, machines.reference, flow)
        enough, is_open = coarsest(rows, machines.given.replicates)
        varied = machines.variations(at)
        alone = [row for each in varied for row in each.rows]
        cases = self.load_cases

        def moved(index: int) -> Overrides:
            place, case = divmod(index, len(cases))
            return {**at, **alone[place], **cases[case]}

        values = await self._solved(pool, clock, moved, len(alone), flow)
        kind = next(row["kind"] for row in rows if row["quality_class"] == machines.reference)
        judged_values = {"nominal": fixed, "exact": exact, "as_described": described}
        yield {
            "correction": at,
            "machines": machines.total,
            "reference_class": machines.reference,
            **{
                name: await runner.twice_if_lost(pool, probability, kinds, values)
                for name, values in judged_values.items()
            },
            "classes": rows,
            "coarsest_class": enough,
            "undecided": is_open,
            "influences": influences(kinds, kind, fixed, values, varied),
            "assumptions": [*assumptions(kinds), *machines.assumed],
        }

    async def _drawn(
        self, pool: Pool, clock: Clock, at: Overrides, quality_class: int | None, flow: float | None, samples: int = 0
    ) -> FloatArray:
        """Solve the machines with a correction: of the first `samples` samples, or of all; one of a pair if exact."""
        cases, step = self.load_cases, PAIR if quality_class is None else 1
        count = PAIR * self.machines.given.count // step
        total = (samples or self.machines.given.replicates) * count

        def overrides(index: int) -> Overrides:
            draw, case = divmod(index, len(cases))
            return self.machines.overrides(step * draw, quality_class, at) | cases[case]

        return await self._solved(pool, clock, overrides, total, flow, count)

    async def _solved(
        self,
        pool: Pool,
        clock: Clock,
        overrides: Callable[[int], Overrides],
        total: int,
        flow: float | None,
        count: int = 1,
    ) -> FloatArray:
        """Return outputs `[replicate, draw, case, output]` of `total` machines, `count` in a replicate."""
        question, found = self.question._replace(gear_flow=flow), list[list[float]]()
        indices = range(total * len(self.load_cases))
        async for _, points in runner.in_order(pool, question, overrides, indices, clock):
            found += [[nan if value is None else float(value) for value in point.out] for point in points]
        return np.array(found).reshape(-1, count, len(self.load_cases), len(question.outputs))
