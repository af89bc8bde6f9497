"""Load spectra: the probability that a machine with tolerances exceeds a limit in a case of its load spectrum."""

from collections.abc import Iterable, Sequence
from math import isclose
from time import perf_counter
from typing import Annotated, Self

import numpy as np
from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from app.calculations import BY_PATH
from app.errors import Unprocessable
from app.schema.fields import Leaf
from app.schema.quantities import Input
from app.studies import runner, statistics
from app.studies.fields import NUMBERS
from app.studies.oil_tests import is_of_an_oil, remarks_on, tests_moved
from app.studies.point_sets import anchors, cut_off, drawn, fields_set, scattering, unit_cube
from app.studies.points import SOLVED, BaseRequest, Question, solve_point
from app.studies.requests import (
    COUNT,
    LARGEST,
    METHOD,
    FieldPath,
    Inputs,
    Method,
    Overrides,
    Part,
    Scatter,
    Seed,
    StudyRequest,
    Value,
)
from app.studies.runner import Clock, Line, Lines, Pool, Study, output_header, paths_of
from app.studies.statistics import ASSUMED_DEVIATION, RELATIVE_DEVIATION, Estimate, Limit
from app.studies.tolerances import class_assumptions, class_distributions, class_tolerances
from app.studies.uncertainty import assumptions_of, model_distributions
from solvers.arrays import FloatArray

PROGRESS_S = 0.5  # time between two lines of progress
KILOWATTS = {"W": 1e-3, "kW": 1.0}  # size of each unit in kilowatts
LIMIT_VARIES = 1e-9  # relative range of the scuffing temperature above which a note says that the temperature varies
LIMIT_AGREES = 1e-3  # a limit that differs from the scuffing temperature by a smaller share is that temperature
SHARES_OFF = 0.01  # the sum of the given shares may differ from 1 by at most this amount
RARE = 0.005  # if a probability is smaller, its 90 % interval contains the true value in less than 90 % of all samples
RARE_NOTE = (
    "a probability is below 0.5 %. The results of the replicates are then not distributed symmetrically, and a 90 % "
    "interval covers the true value in less than 90 % of the studies, for example in about 80 % at a probability of "
    "0.1 % with 8 replicates of 128 machines. Draw more machines"
)
NO_LIMIT = "no limit is given, and the request has no scuffing temperature; give a limit or the scuffing temperature"
NOT_USED = "not used"  # the reason of an assumption begins with these words if the field has no effect on the results


class LoadCase(Part):
    """A part of the operating time, and the values of the request that are different in this part."""

    name: Annotated[str | None, Field(max_length=100), Input("name", default_text="its number")] = None
    share: Annotated[
        float | None, Input("share", text="of the operating time", ge=0.0, le=1.01, default_text="equal shares")
    ] = None
    set: Annotated[dict[str, Value], Input("what the case changes", text="values by their dotted paths")] = Field({})


class Tolerances(Part):
    """The distributions of the fields that differ between machines, and the size of the sample of machines."""

    method: Annotated[Method, METHOD] = "sobol"
    count: Annotated[int, COUNT] = 128
    replicates: Annotated[
        int, Input("replicates", text="independent samples; the scatter of their means is the error", ge=1, le=1000)
    ] = 8
    seed: Seed = 1
    inputs: Annotated[
        Inputs | None,
        Input(
            "distributions",
            text="the fields and their distributions",
            default_text="by the quality class of the gears, which also scatters fields that are not listed here",
        ),
    ] = None
    model_uncertainty: Annotated[
        bool,
        Input(
            "uncertainty of the models",
            text="also draw what the models do not know well: cooling (the heat band's inputs) and friction",
        ),
    ] = False


class Threshold(Part):
    """The value of a limit, either fixed or normally distributed.

    The limit is a property of oil and material. Therefore a machine has one value of the limit in all cases.
    """

    value: Annotated[float | None, Input("fixed limit", ge=-LARGEST, le=LARGEST)] = None
    mean: Annotated[float | None, Input("mean of the limit", ge=-LARGEST, le=LARGEST)] = None
    deviation: Annotated[float | None, Input("standard deviation of the limit", gt=0.0, le=LARGEST)] = None

    @model_validator(mode="after")
    def one_kind(self) -> Self:
        """Refuse a limit unless it has either a fixed value, or a mean and a standard deviation."""
        if (self.mean is None) != (self.deviation is None) or (self.value is None) == (self.mean is None):
            raise PydanticCustomError("value_or_mean", "Give either the value alone, or both mean and deviation")
        return self


class SpectrumLimit(Part):
    """A limit on one output. The limit is the same in every case."""

    exactly_one = ("above", "below")
    output: Annotated[FieldPath, Input("limited output", text="dotted path of a single number of the answer")]
    above: Annotated[Threshold | None, Input("upper limit", text="values above it exceed the limit")] = None
    below: Annotated[Threshold | None, Input("lower limit", text="values below it exceed the limit")] = None


class SpectrumRequest(StudyRequest):
    """A machine with its tolerances, and the cases of its load spectrum."""

    cases: Annotated[
        list[LoadCase],
        Field(min_length=1, max_length=100),
        Input("cases", text="what each case changes, and its share"),
    ]
    tolerances: Annotated[
        Tolerances | None,
        Input(
            "tolerances", default_text="by the quality class of the gears; without a class the nominal machine alone"
        ),
    ] = None
    limits: Annotated[
        list[SpectrumLimit] | None,
        Field(max_length=20),
        Input(
            "limits",
            text="values that an output must not exceed",
            default_text="the scuffing temperature, where there is one",
        ),
    ] = None
    hours_per_year: Annotated[
        float | None,
        Input("hours per year", text="operating time, to turn mean powers into energies", gt=0.0, le=8784.0),
    ] = None
    points: Annotated[bool, Input("points", text="whether every solved point is a line of the answer")] = False


class Spectrum(Study):
    """The probability that a machine exceeds a limit. The machines are drawn at random from the tolerances.

    Each machine runs every case. The worst case of the machine is compared with the limits.

    The last line of the answer has these results:

    - for each limit, the probability that a machine exceeds the limit in its worst case, with the 90 % confidence
      interval
    - for each limit and each case, the probability of exceeding the limit if the machine runs only this case
    - for each limit and each case, the share of machines for which this case is the worst case (`decides`)
    - for each limit and each field that scatters, the rank correlation between the field and the output in the worst
      case, and the share of the variance that the field explains alone (`variance_share`): a rank correlation does not
      see what costs on both sides of the middle
    - for each output, the mean over the operating time, and the extremes over all machines and cases
    - for each output and each case, the 5, 50 and 95 % quantiles

    The intervals are the error of sampling alone; `tolerances.model_uncertainty` also draws what the models do not know
    well. `risk` is in the words of AGMA 925-A03, which are about the scuffing temperature as an upper limit; of other
    limits it is null.

    Machines without a solution in some case are counted. If there are such machines, only the `bounds` of the
    probability are known. If no output needs the thermal film, the film is not calculated. A line `progress` comes
    every half second.
    """

    path = "/v1/spectrum"
    summary = "A machine with its tolerances over its load spectrum: probabilities, losses, what decides"
    answer = "a line for the spectrum, one for each point if asked for, and one for the end"
    model = SpectrumRequest
    most = "spectrum_solves"
    body: SpectrumRequest

    def _outputs(self, base: BaseRequest) -> tuple[Leaf, ...]:
        """Return the outputs of the study.

        These are the requested outputs, or the headline numbers if the request names no outputs. The outputs that have
        a limit are always added.
        """
        body = self.body
        outputs = {f"outputs.{place}": leaf for place, leaf in enumerate(base.outputs(body.outputs))}
        if body.outputs is None:
            outputs = {place: leaf for place, leaf in outputs.items() if leaf.kind in NUMBERS}
        for index, limit in enumerate(body.limits or ()):
            place = f"limits.{index}.output"
            outputs[place] = base.output(limit.output, place)
        for place, leaf in outputs.items():
            if leaf.kind not in NUMBERS:
                raise Unprocessable("unknown_output", f"{leaf.path} is not a number; choose another output", place)
        scuffing = base.calculation.words.scuffing
        if body.limits is None and scuffing:
            outputs["limits"] = base.output(scuffing.contact, "limits")
        return tuple({leaf.path: leaf for leaf in outputs.values()}.values())

    def _planned(self, base: BaseRequest, most: int) -> int:
        body = self.body
        set_by_cases = fields_set([case.set for case in body.cases], base, "cases.{}.set")
        given = list(body.tolerances.inputs or ()) if body.tolerances else []
        self.scattering = scattering(given, base, "tolerances.inputs")
        for place, leaf in enumerate(self.scattering):
            if leaf.path in set_by_cases:
                message = f"{leaf.path} has both a value in a case and a tolerance; give only one of the two"
                raise Unprocessable("duplicate_path", message, f"tolerances.inputs.{place}.path")
        inputs = [*given, *self._added(given, base, set_by_cases)]
        self.scattering = scattering(inputs, base, "tolerances.inputs")
        drawn_from = body.tolerances or Tolerances()
        tolerances = self.tolerances = drawn_from.model_copy(update={"inputs": inputs}) if inputs else None
        scuffing = base.calculation.words.scuffing
        # The default limit is the scuffing temperature, and the words of risk need it beside a limit of the user.
        if scuffing and (body.limits is None or any(limit.output == scuffing.contact for limit in body.limits)):
            columns = dict.fromkeys([*self.question.outputs, *scuffing])
            self.question = self.question._replace(outputs=list(columns))
        typical = {scatter.path: next(iter(anchors(scatter).values())) for scatter in inputs}
        requests = [base.checked({**typical, **case.set}) for case in body.cases]
        # A number of an oil that scatters is the spread of this oil; another grade is another oil.
        varied = [leaf.path for leaf in self.scattering if leaf.options or not is_of_an_oil(leaf.path)]
        moved = tests_moved(requests[0], [*varied, *set_by_cases], self.question.outputs)
        self.oil_remarks = remarks_on(moved, {})
        total = len(body.cases) * (tolerances.count * tolerances.replicates if tolerances else 1)
        if total > most:
            message = _too_many(self.question, {**typical, **body.cases[0].set}, total, most)
            raise Unprocessable("too_many_points", message, "tolerances.count" if tolerances else "cases")
        self.cases = _with_shares(body.cases)
        # The array has one row per machine and one column per field that scatters. The machines of the first replicate
        # come first, then the machines of the second replicate, and so on.
        self.machines = _machines(tolerances, self.scattering) if tolerances else np.empty((1, 0))
        return total

    def _added(self, given: list[Scatter], base: BaseRequest, set_by_cases: Iterable[str]) -> list[Scatter]:
        """Return the distributions by the quality class and, if asked for, of the models; note what is assumed by them.

        A field that the body lists or a case sets does not scatter by them. Raises Unprocessable if the body has
        tolerances, but nothing scatters.
        """
        typical = {scatter.path: next(iter(anchors(scatter).values())) for scatter in given}
        request, taken = base.checked({**typical, **self.body.cases[0].set}), {*typical, *set_by_cases}
        widths = {path: width for path, width in class_tolerances(request).items() if path not in taken}
        asked = self.body.tolerances is not None and self.body.tolerances.model_uncertainty
        unknown = model_distributions(request) if asked else {}
        models = [scatter for path, (scatter, _) in unknown.items() if path not in taken]
        if self.body.tolerances and not (given or widths or models):
            message = "give the distributions of fields that scatter, or a quality class of the gears"
            raise Unprocessable("missing", message, "tolerances.inputs")
        self.assumed = [
            *class_assumptions(request, widths),
            *assumptions_of(request, unknown, {scatter.path for scatter in models}),
        ]
        return [*(scatter for scatter in class_distributions(request) if scatter.path in widths), *models]

    def overrides(self, index: int) -> Overrides:
        """Return the values that a point changes in the base request. The keys are the paths of the values.

        The first points are the cases of the first machine. The cases of the second machine follow, and so on.
        """
        draw, case = divmod(index, len(self.cases))
        machine = dict(zip(paths_of(self.scattering), self.machines[draw].tolist(), strict=True))
        return machine | self.cases[case].set

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """Yield the header, then the lines that state the progress, and at last the line `end`.

        If the request asks for points, also yield a line for each point.
        """
        yield [
            self.header(
                cases=[case.model_dump() for case in self.cases],
                tolerances=self._tolerances_header(),
                outputs=[output_header(leaf) for leaf in self.outputs],
                total=self.total,
            )
        ]
        await self._size_flow(pool, self.overrides(0))
        tally, due = runner.Tally(self.question.outputs), PROGRESS_S
        async for indices, points in runner.in_order(pool, self.question, self.overrides, range(self.total), clock):
            lines: list[Line] = []
            for index, point in zip(indices, points, strict=True):
                tally.add(point)
                tally.keep(point.out if point.status in SOLVED else [None] * len(point.out))
                if self.body.points:
                    draw, case = divmod(index, len(self.cases))
                    shown = point._replace(out=point.out[: len(self.outputs)])
                    lines.append({**runner.point_line(index, self.overrides(index), shown), "draw": draw, "case": case})
            if clock.elapsed_s >= due:
                lines.append(clock.line())
                due = clock.elapsed_s + PROGRESS_S
            yield lines
        replicates = self.tolerances.replicates if self.tolerances else 1
        values = tally.values.reshape(replicates, -1, len(self.cases), len(self.question.outputs))
        concluded = await runner.twice_if_lost(pool, evaluated, self, values)
        assumptions = list(tally.assumptions.values())
        yield [
            {
                "type": "end",
                **concluded,
                "notes": [*concluded["notes"], *self.oil_remarks, *self._ignored(assumptions)],
                "points": self.total,
                "counts": dict(sorted(tally.counts.items())),
                "errors": dict(sorted(tally.errors.items())),
                "warnings": dict(sorted(tally.warnings.items())),
                "assumptions": [*concluded["assumptions"], *self.assumed, *assumptions],
                "elapsed_s": clock.elapsed_s,
            }
        ]

    def _tolerances_header(self) -> Line | None:
        """Return the description of the tolerances for the first line of the study; None if there are no tolerances.

        The description of a distribution states the share of the distribution that is cut off.
        """
        if self.tolerances is None:
            return None
        inputs = [
            {**scatter.model_dump(), "unit": leaf.unit, "title": leaf.title, "cut_off": cut_off(scatter, leaf)}
            for scatter, leaf in zip(self.tolerances.inputs or (), self.scattering, strict=True)
        ]
        return {**self.tolerances.model_dump(), "inputs": inputs}

    def _ignored(self, assumptions: Sequence[Line]) -> list[str]:
        """Return a note for each field that scatters but has no effect because the model does not use the field."""
        reasons = {
            assumption["field"]: assumption["reason"]
            for assumption in assumptions
            if assumption["reason"].startswith(NOT_USED)
        }
        unused = [path for path in paths_of(self.scattering) if path in reasons]
        return [f"the tolerance of {path} has no effect; {reasons[path]}" for path in unused]


def evaluated(study: Spectrum, values: FloatArray) -> Line:
    """Compute the statistics that the last line of the study states, from outputs `[replicate, draw, case, output]`.

    This function runs in a worker.
    """
    columns = {path: values[..., place] for place, path in enumerate(study.question.outputs)}
    limits, assumptions, notes = _limits(study, columns)
    worded = [_has_words_of_risk(study, limit, columns) for limit in limits]
    limited = [
        _of_limit(study, limit, columns[limit.output], has_words)
        for limit, has_words in zip(limits, worded, strict=True)
    ]
    if any(content["interval"] and content["deviation"] and content["bounds"][1] < RARE for content in limited):
        notes = [*notes, RARE_NOTE]
    shown = {leaf.path: columns[leaf.path] for leaf in study.outputs}
    return {
        "cases": [
            {
                "name": case.name,
                "share": case.share,
                "unsolved": float(np.isnan(values[:, :, place]).all(axis=-1).mean()),
                "means": {path: statistics.mean(column[..., place]) for path, column in shown.items()},
                "quantiles": {path: statistics.quantiles(column[..., place]) for path, column in shown.items()},
                "limits": [
                    _case(limit, columns[limit.output][..., place], place, has_words)
                    for limit, has_words in zip(limits, worded, strict=True)
                ],
            }
            for place, case in enumerate(study.cases)
        ],
        "limits": limited,
        "outputs": {leaf.path: _of_output(study, leaf, columns[leaf.path]) for leaf in study.outputs},
        "notes": notes,
        "assumptions": assumptions,
    }


def _case(limit: Limit, outputs: FloatArray, place: int, has_words: bool) -> Line:
    """Return the probability of one case as if it were alone."""
    return _judged(statistics.of_case(outputs, limit.of_case(place)), has_words)


def _judged(estimate: Estimate, has_words: bool) -> Line:
    """Return an estimate whose risk is in words only where the words belong."""
    return estimate._asdict() if has_words else {**estimate._asdict(), "risk": None}


def _has_words_of_risk(study: Spectrum, limit: Limit, columns: dict[str, FloatArray]) -> bool:
    """Whether a limit is the scuffing temperature, of which the words of AGMA 925-A03 are: by default, or as given."""
    paths = BY_PATH[study.question.endpoint].words.scuffing
    if paths is None or limit.output != paths.contact or limit.side != "above":
        return False
    own = columns[paths.limit][~np.isnan(columns[paths.limit])]
    return study.body.limits is None or bool(
        own.size and isclose(limit.mean, float(np.median(own)), rel_tol=LIMIT_AGREES)
    )


def _limits(study: Spectrum, columns: dict[str, FloatArray]) -> tuple[list[Limit], list[Line], list[str]]:
    """Return the limits of the study, and the assumptions and notes about these limits.

    If the request has no limits, the scuffing temperature is the default limit of the contact temperature. The only
    possible assumption is the standard deviation of this default limit.
    """
    paths = BY_PATH[study.question.endpoint].words.scuffing
    if study.body.limits is not None or paths is None:
        return [_limit(given) for given in study.body.limits or ()], [], []
    temperatures = columns[paths.limit][~np.isnan(columns[paths.limit])]
    if not temperatures.size:
        return [], [], [NO_LIMIT]
    first = columns[paths.limit][..., 0]
    mean = float(np.nanmedian(temperatures if np.isnan(first).all() else first))  # median over the machines
    varies = bool(np.ptp(temperatures) > LIMIT_VARIES * abs(mean))
    own = columns[paths.limit] if varies else None
    limit = Limit("above", mean, RELATIVE_DEVIATION * abs(mean), paths.contact, own)
    assumption = {"field": "limits", "value": limit.deviation, "reason": ASSUMED_DEVIATION}
    note = (
        "the scuffing temperature is not the same in all cases and machines; each is judged by its own. The median in "
        f"the first case is {mean:.4g} °C"
    )
    return [limit], [assumption], [note] if varies else []


def _of_limit(study: Spectrum, limit: Limit, outputs: FloatArray, has_words: bool) -> Line:
    """Return the results for one limit. The last line of the study contains these results.

    The results include:

    - the probability that the worst case of a machine is beyond the limit
    - for each case, the share of machines for which this case is the worst case
    - for each field that scatters, the rank correlation between the field and the output in the worst case, and the
      share of the variance that the field explains alone, which also sees what costs on both sides
    - the quantiles and the histogram of the output in the worst case
    """
    worst = limit.worst(outputs)
    edges, density = statistics.histogram(worst)
    is_solved = ~np.isnan(outputs).any(axis=-1).ravel()
    machines, decisive = study.machines[is_solved], worst.ravel()[is_solved]
    correlation = {
        leaf.path: statistics.rank_correlation(column, decisive)
        for leaf, column in zip(study.scattering, machines.T, strict=True)
    }
    margins = limit.margins(outputs).max(axis=-1).ravel()[is_solved]
    shares = statistics.variance_shares(machines, margins)
    variance = dict(zip(paths_of(study.scattering), shares, strict=True))
    return {
        "output": limit.output,
        "side": limit.side,
        "mean": limit.mean,
        "deviation": limit.deviation or None,
        **_judged(statistics.of_spectrum(outputs, limit), has_words),
        "unsolved": 1.0 - float(is_solved.mean()),
        "decides": statistics.deciding(outputs, limit),
        "rank_correlation": correlation or None,
        "variance_share": variance or None,
        "quantiles": statistics.quantiles(worst),
        "histogram": {"edges": edges, "density": density},
    }


def _of_output(study: Spectrum, leaf: Leaf, column: FloatArray) -> Line:
    """Return the mean and the extremes of an output over the spectrum.

    If the output is a power and the request states the operating hours, also return the energy per year.
    """
    mean = statistics.weighted_mean(column, [case.share or 0.0 for case in study.cases])
    content: Line = mean._asdict() if mean else {"mean": None, "standard_error": None, "interval": None}
    scale = KILOWATTS.get(leaf.unit or "")
    if mean is not None and scale is not None and study.body.hours_per_year is not None:
        content["energy_kwh_per_year"] = mean.mean * scale * study.body.hours_per_year
    if np.isnan(column).all():
        return {**content, "min": None, "max": None}
    for end, index in {"min": int(np.nanargmin(column)), "max": int(np.nanargmax(column))}.items():
        draw, case = divmod(index, len(study.cases))
        content[end] = {"value": float(column.flat[index]), "case": case, "draw": draw, "at": study.overrides(index)}
    return content


def _limit(given: SpectrumLimit) -> Limit:
    threshold = given.above or given.below
    assert threshold is not None
    mean = threshold.mean if threshold.value is None else threshold.value
    assert mean is not None
    return Limit("above" if given.above else "below", mean, threshold.deviation or 0.0, given.output)


def _with_shares(cases: Sequence[LoadCase]) -> list[LoadCase]:
    """Return copies of the cases. Every copy has a name and a share of the operating time. The shares add up to 1.

    Raises Unprocessable if only some cases have a share, or if the given shares do not add up to 1.
    """
    given = [case.share for case in cases if case.share is not None]
    if given and len(given) < len(cases):
        raise Unprocessable("shares", "give a share for every case, or for none of the cases", "cases")
    shares = given or [1.0] * len(cases)
    whole = sum(shares)
    if given and abs(whole - 1.0) > SHARES_OFF + 1e-12:
        message = f"the shares add up to {whole:.6g}; give fractions of the time that add up to 1"
        raise Unprocessable("shares", message, "cases")
    return [
        case.model_copy(update={"name": case.name or f"case {place}", "share": share / whole})
        for place, (case, share) in enumerate(zip(cases, shares, strict=True), start=1)
    ]


def _machines(tolerances: Tolerances, leaves: Sequence[Leaf]) -> FloatArray:
    """Draw random values of the fields that scatter, with one row per machine and one column per field.

    The machines belong to several samples, called replicates. The replicates are independent of one another.
    """
    seeds = np.random.SeedSequence(tolerances.seed).spawn(tolerances.replicates)
    cubes = [
        unit_cube(tolerances.method, tolerances.count, len(leaves), np.random.default_rng(seed), "tolerances.count")
        for seed in seeds
    ]
    return drawn(tolerances.inputs or (), leaves, np.concatenate(cubes))


def _too_many(question: Question, overrides: Overrides, total: int, most: int) -> str:
    """Return the message about a study with too many points. The message estimates the computing time."""
    solve_point(question, overrides)  # this solution is not timed, because it may have to load kernels
    started = perf_counter()
    solve_point(question, overrides)
    seconds = perf_counter() - started
    return (
        f"the number of cases times the number of machines is {total}, but at most {most} are allowed. One solution "
        f"takes about {seconds:.2g} s, and all solutions take {total * seconds:,.0f} s on one core; reduce the number "
        "of machines or of cases"
    )
