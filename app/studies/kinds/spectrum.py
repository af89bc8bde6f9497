"""Load spectra: the probability that a machine with tolerances exceeds a limit in a case of its load spectrum.

On the page of the study, the user pastes the cases as a table, chooses the fields that scatter, and states a tolerance
for each of these fields.
"""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import replace
from time import perf_counter
from types import MappingProxyType
from typing import Annotated, Any, NamedTuple, Self

import numpy as np
from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from app.calculations import Calculation
from app.errors import Unprocessable
from app.figures.data import Figure, NoFigure
from app.figures.spectrum import Limited, SpectrumCase, chance_text, chances, deciding, losses, overlap, sentence
from app.figures.units import axis_of
from app.figures.wording import difference_unit, number, percent
from app.pages.form import FieldView
from app.pages.query import CASES, Pairs, link, pairs_of
from app.pages.studies.controls import Control, field_choices, is_number, texts_of
from app.pages.studies.page import Controls, Link, Number, Result, StudyPage, Table, titled
from app.pages.study_kinds import StudyLink
from app.pages.study_links import Starter
from app.pages.templating import page_path
from app.pages.typed import as_typed, number_of, power_between, question, scaled, separator_of, text_of
from app.pages.typesetting import cited, shown, words
from app.schema.fields import ITEM, Leaf, leaf_at, leaves
from app.schema.quantities import Input, split_unit
from app.studies import runner, statistics
from app.studies.fields import NUMBERS, scalar_at, value_at
from app.studies.point_sets import anchors, cut, drawn, fields_set, scattering, unit_cube
from app.studies.points import SOLVED, BaseRequest, Question, solve_point
from app.studies.requests import (
    COUNT,
    DRIVE_TRAIN,
    EXAMPLES,
    LARGEST,
    METHOD,
    FieldPath,
    Inputs,
    Method,
    Overrides,
    Part,
    Seed,
    StudyRequest,
    Value,
)
from app.studies.runner import Clock, Line, Lines, Pool, Study, output_header, paths_of
from app.studies.statistics import Limit
from solvers.arrays import FloatArray

PROGRESS_S = 0.5  # time between two lines of progress
KILOWATTS = {"W": 1e-3, "kW": 1.0}  # size of each unit in kilowatts
RELATIVE_DEVIATION = 0.15  # AGMA 925-A03; taken from a secondary source and not compared with the standard
LIMIT_VARIES = 1e-9  # relative range of the scuffing temperature above which a note says that the temperature varies
SHARES_OFF = 0.01  # the sum of the given shares may differ from 1 by at most this amount
ASSUMED_DEVIATION = (
    "the scuffing temperature is assumed to be normally distributed, with a standard deviation of 0.15 times its mean "
    "(AGMA 925-A03, secondary source)"
)

RARE = 0.005  # if a probability is smaller, its 90 % interval contains the true value in less than 90 % of all samples
RARE_NOTE = (
    "a probability is below 0.5 %. The results of the replicates are then not distributed symmetrically, and a 90 % "
    "interval covers the true value in less than 90 % of the studies, for example in about 80 % at a probability of "
    "0.1 % with 8 replicates of 128 machines. Draw more machines"
)
NOT_USED = "not used"  # the reason of an assumption begins with these words if the field has no effect on the results

NAME, SHARE = "name", "share"
REPLICATES = 8  # number of independent samples on the page; the scatter of their means gives the error of a mean
MACHINES = (("", "256"), ("64", "64"), ("1024", "1024"), ("4096", "4096"))
LAWS = (("", "normal"), ("uniform", "uniform"), ("triangular", "triangular"), ("lognormal", "lognormal"))
SIDES = (("", "by the output"), ("above", "above is bad"), ("below", "below is bad"))
AROUND_UNIT = " ,;[]()"  # characters that may stand before and after the unit in the heading of a column
# Fields that a case of the spectrum usually changes. The page suggests a table of cases with these fields.
USUAL = (
    *("load.power_kw", "load.pinion_torque_n_m", "load.pinion_speed_rpm"),
    *("operation.power_kw", "operation.pinion_torque_n_m", "operation.torque_n_m"),
    *("operation.pinion_speed_rpm", "operation.speed_rpm", "temperatures.oil_c"),
)
LOSSES = {
    "/v1/coupling": ("losses.friction_power_w",),
    "/v1/pumping": ("total.pumping_power_w",),
    "/v1/scuffing/load-distribution": ("friction_loss.power_w",),
    "/v1/scuffing": ("friction_loss.power_w",),
    DRIVE_TRAIN: ("losses.coupling_w", "losses.pumping_w", "losses.mesh_w", "losses.bearings_w"),
}
MOST_BARS = 40  # number of bars that fit side by side on a page
TOLERANCES = tuple(f"t{place}" for place in range(12))  # names of the tolerances in the form; no more are possible


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
    inputs: Annotated[Inputs, Input("distributions", text="the fields and their distributions")]


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
    tolerances: Annotated[Tolerances | None, Input("tolerances", default_text="the nominal machine alone")] = None
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


class Scuffing(NamedTuple):
    """Dotted paths of the contact temperature and the scuffing temperature in the answer of an endpoint."""

    contact: str
    limit: str


SCUFFING = {
    "/v1/scuffing": Scuffing("contact_temperature.blok_max_c", "safety.scuffing_c"),
    DRIVE_TRAIN: Scuffing("flash.contact_max_c", "derived.temperatures.scuffing_c"),
}


class Spectrum(Study):
    """The probability that a machine exceeds a limit. The machines are drawn at random from the tolerances.

    Each machine runs every case. The worst case of the machine is compared with the limits.

    The last line of the answer has these results:

    - for each limit, the probability that a machine exceeds the limit in its worst case, with the 90 % confidence
      interval
    - for each limit and each case, the probability of exceeding the limit if the machine runs only this case
    - for each limit and each case, the share of machines for which this case is the worst case (`decides`)
    - for each limit and each field that scatters, the rank correlation between the field and the output in the worst
      case
    - for each output, the mean over the operating time, and the extremes over all machines and cases
    - for each output and each case, the 5, 50 and 95 % quantiles

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
        if body.limits is None and body.endpoint in SCUFFING:
            outputs["limits"] = base.output(SCUFFING[body.endpoint].contact, "limits")
        return tuple({leaf.path: leaf for leaf in outputs.values()}.values())

    def _planned(self, base: BaseRequest, most: int) -> int:
        body, tolerances = self.body, self.body.tolerances
        set_by_cases = fields_set([case.set for case in body.cases], base, "cases.{}.set")
        inputs = tolerances.inputs if tolerances else []
        self.scattering = scattering(inputs, base, "tolerances.inputs")
        for place, leaf in enumerate(self.scattering):
            if leaf.path in set_by_cases:
                message = f"{leaf.path} has both a value in a case and a tolerance; give only one of the two"
                raise Unprocessable("duplicate_path", message, f"tolerances.inputs.{place}.path")
        if body.limits is None and body.endpoint in SCUFFING:  # the default limit needs the scuffing temperature
            columns = dict.fromkeys([*self.question.outputs, *SCUFFING[body.endpoint]])
            self.question = self.question._replace(outputs=list(columns))
        typical = {scatter.path: next(iter(anchors(scatter).values())) for scatter in inputs}
        for case in body.cases:
            base.checked({**typical, **case.set})
        total = len(body.cases) * (tolerances.count * tolerances.replicates if tolerances else 1)
        if total > most:
            message = _too_many(self.question, {**typical, **body.cases[0].set}, total, most)
            raise Unprocessable("too_many_points", message, "tolerances.count" if tolerances else "cases")
        self.cases = _with_shares(body.cases)
        # The array has one row per machine and one column per field that scatters. The machines of the first replicate
        # come first, then the machines of the second replicate, and so on.
        self.machines = _machines(tolerances, self.scattering) if tolerances else np.empty((1, 0))
        return total

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
        replicates = self.body.tolerances.replicates if self.body.tolerances else 1
        values = tally.values.reshape(replicates, -1, len(self.cases), len(self.question.outputs))
        concluded = await runner.twice_if_lost(pool, evaluated, self, values)
        assumptions = list(tally.assumptions.values())
        yield [
            {
                "type": "end",
                **concluded,
                "notes": [*concluded["notes"], *self._ignored(assumptions)],
                "points": self.total,
                "counts": dict(sorted(tally.counts.items())),
                "errors": dict(sorted(tally.errors.items())),
                "warnings": dict(sorted(tally.warnings.items())),
                "assumptions": [*concluded["assumptions"], *assumptions],
                "elapsed_s": clock.elapsed_s,
            }
        ]

    def _tolerances_header(self) -> Line | None:
        """Return the description of the tolerances for the first line of the study; None if there are no tolerances.

        The description of a distribution states the share of the distribution that is cut off.
        """
        if self.body.tolerances is None:
            return None
        inputs = [
            {**scatter.model_dump(), "unit": leaf.unit, "title": leaf.title, "cut_off": cut(scatter, leaf).cut_off}
            for scatter, leaf in zip(self.body.tolerances.inputs, self.scattering, strict=True)
        ]
        return {**self.body.tolerances.model_dump(), "inputs": inputs}

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
    limited = [_of_limit(study, limit, columns[limit.output]) for limit in limits]
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
                "limits": [statistics.of_case(columns[limit.output][..., place], limit)._asdict() for limit in limits],
            }
            for place, case in enumerate(study.cases)
        ],
        "limits": limited,
        "outputs": {leaf.path: _of_output(study, leaf, columns[leaf.path]) for leaf in study.outputs},
        "notes": notes,
        "assumptions": assumptions,
    }


def _limits(study: Spectrum, columns: dict[str, FloatArray]) -> tuple[list[Limit], list[Line], list[str]]:
    """Return the limits of the study, and the assumptions and notes about these limits.

    If the request has no limits, the scuffing temperature is the default limit of the contact temperature. The only
    possible assumption is the standard deviation of this default limit.
    """
    paths = SCUFFING.get(study.question.endpoint)
    if study.body.limits is not None or paths is None:
        return [_limit(given) for given in study.body.limits or ()], [], []
    temperatures = columns[paths.limit][~np.isnan(columns[paths.limit])]
    if not temperatures.size:
        missing = (
            "no limit is given, and the request has no scuffing temperature; give a limit or the scuffing temperature"
        )
        return [], [], [missing]
    first = columns[paths.limit][..., 0]
    mean = float(np.nanmedian(temperatures if np.isnan(first).all() else first))  # median over the machines
    limit = Limit("above", mean, RELATIVE_DEVIATION * abs(mean), paths.contact)
    assumption = {"field": "limits", "value": limit.deviation, "reason": ASSUMED_DEVIATION}
    varies = np.ptp(temperatures) > LIMIT_VARIES * abs(mean)
    note = (
        "the scuffing temperature is not the same in all cases and machines; the median in the first case, "
        f"{mean:.4g}, is used as the limit. To judge by other values, give limits"
    )
    return [limit], [assumption], [note] if varies else []


def _of_limit(study: Spectrum, limit: Limit, outputs: FloatArray) -> Line:
    """Return the results for one limit. The last line of the study contains these results.

    The results include:

    - the probability that the worst case of a machine is beyond the limit
    - for each case, the share of machines for which this case is the worst case
    - for each field that scatters, the rank correlation between the field and the output in the worst case
    - the quantiles and the histogram of the output in the worst case
    """
    worst = limit.worst(outputs)
    edges, density = statistics.histogram(worst)
    is_solved = ~np.isnan(outputs).any(axis=-1).ravel()
    correlation = {
        leaf.path: statistics.rank_correlation(column[is_solved], worst.ravel()[is_solved])
        for leaf, column in zip(study.scattering, study.machines.T, strict=True)
    }
    return {
        "output": limit.output,
        "side": limit.side,
        "mean": limit.mean,
        "deviation": limit.deviation or None,
        **statistics.of_spectrum(outputs, limit)._asdict(),
        "unsolved": 1.0 - float(is_solved.mean()),
        "decides": statistics.deciding(outputs.reshape(-1, outputs.shape[-1]), limit),
        "rank_correlation": correlation or None,
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
    return drawn(tolerances.inputs, leaves, np.concatenate(cubes))


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


class Column(NamedTuple):
    """A column of the table of load cases.

    `path` is the path of the field whose values the column contains. It is "name" for the names of the load cases, and
    "share" for their shares of the operating time. The numbers in the column are multiplied by 10**`power`.
    """

    path: str
    power: int = 0


def cases_of(calculation: Calculation, text: str) -> list[dict[str, Any]]:
    """Return the cases in a table. Raises Unprocessable if the table is not valid.

    The first line of the table names the columns: name, share, and fields by their labels or paths. The columns are
    separated by tabs, as in a table copied from a spreadsheet, or by semicolons. If a cell is empty, the case keeps the
    value of the base request.
    """
    lines = [line for line in text.splitlines() if line.strip()] or [""]
    try:
        heading, *rows = csv.reader(lines, delimiter=separator_of(text))
    except csv.Error:
        raise Unprocessable(
            "table",
            "the table cannot be read; write one case per line, with tabs or semicolons between the columns",
            "cases",
        ) from None
    columns = [_column(calculation, cell.strip()) for cell in heading]
    return [_case(calculation, columns, row, place) for place, row in enumerate(rows, start=2)] or [{}]


def _column(calculation: Calculation, heading: str) -> Column:
    """Return the column that a heading describes.

    A heading is "name", "share", the path of a field, the last part of such a path, or the label of a field in the
    form. A unit may follow the label. Raises Unprocessable if the heading fits several fields. If the heading fits no
    field, the heading is used as the path; the study then reports an unknown path.
    """
    plain = heading.lower()
    if leaf_at(calculation.request, heading) or plain in {NAME, SHARE}:
        return Column(heading if plain not in {NAME, SHARE} else plain)
    if plain.startswith(SHARE) and plain.removeprefix(SHARE).strip(AROUND_UNIT) == "%":
        return Column(SHARE, -2)
    # The longest label with which the heading begins has priority. Among labels of equal length, a label that the form
    # shows has priority.
    alike: dict[tuple[int, bool], dict[str, Column]] = {}
    for leaf in (leaf for leaf in leaves(calculation.request) if leaf.is_scalar and ITEM not in leaf.path):
        name = leaf.path.rpartition(".")[2]
        labels = {leaf.title, leaf.declared.title, name, words(split_unit(name)[0])}
        for label in filter(plain.startswith, map(str.lower, labels)):
            power = power_between(heading[len(label) :].strip(AROUND_UNIT), leaf.unit)
            if power is not None:
                shown = label == leaf.title.lower()
                alike.setdefault((len(label), shown), {})[leaf.title] = Column(leaf.path, power)
    meant = alike[max(alike)] if alike else {heading: Column(heading)}
    if len(meant) > 1:
        message = f"the heading {heading} can mean {' or '.join(meant)}; write one of these"
        raise Unprocessable("table", message, "cases")
    return next(iter(meant.values()))


def _case(calculation: Calculation, columns: list[Column], row: list[str], line: int) -> dict[str, Any]:
    """Return the case that a row of the table describes. Raises Unprocessable if the row is not valid.

    If a field does not accept the content of its cell, the content is kept as text. The study then reports the error.
    """
    if any(cell.strip() for cell in row[len(columns) :]):
        raise Unprocessable("table", f"line {line} has more columns than the first line", "cases")
    case: dict[str, Any] = {"set": {}}
    for (column, power), cell in zip(columns, map(str.strip, row), strict=False):
        leaf = leaf_at(calculation.request, column)
        if not cell:
            continue
        if column != NAME and (asked := question(cell)):
            raise Unprocessable("table", f"line {line}: {asked}", "cases")
        if column == NAME:
            case[NAME] = cell
        elif column == SHARE:
            share = scaled(number_of(cell.removesuffix("%").strip()), -2 if cell.endswith("%") else power)
            if isinstance(share, str):
                raise Unprocessable("table", f"line {line}: the share is not a number", "cases")
            case[SHARE] = float(share)
        elif leaf is not None and leaf.kind == "boolean":
            case["set"][column] = {"true": True, "false": False}.get(cell, cell)
        else:
            case["set"][column] = scaled(number_of(cell), power) if leaf is None or leaf.kind in NUMBERS else cell
    return case


def table_of(calculation: Calculation, cases: list[dict[str, Any]]) -> str:
    """Return the cases as the text of a table.

    The first line names the columns. The name of a field is the label of this field in the form. `cases_of` can read
    the text.
    """
    paths = list(dict.fromkeys(path for case in cases for path in case.get("set", {})))
    rows = [[NAME, SHARE, *(_heading(calculation, path) for path in paths)]]
    for place, case in enumerate(cases, start=1):
        own = case.get("set", {})
        head = [str(case.get(NAME) or f"case {place}"), text_of(case[SHARE]) if case.get(SHARE) is not None else ""]
        rows.append([*head, *(text_of(own[path]) if path in own else "" for path in paths)])
    return "\n".join("\t".join(cell.replace("\t", " ") for cell in row) for row in rows)


def _heading(calculation: Calculation, path: str) -> str:
    """Return the heading of a field's column: the label with the unit, or the path if the label fits several fields."""
    leaf = leaf_at(calculation.request, path)
    if leaf is None:
        return path
    try:
        meant = _column(calculation, titled(leaf))
    except Unprocessable:
        return path
    return titled(leaf) if meant == Column(path) else path


CONTROLS = (
    Control(CASES, "cases", "", str),
    Control("machines", "tolerances.count", int(MACHINES[0][1])),
    Control("hours", "hours_per_year"),
    Control("limit", "limit.value"),
    Control("limit.side", "limit.side", read=str),
    Control("limit.by", "limit.deviation"),
)
TOLERANCE = (
    Control("", "path", read=str),
    Control(".law", "distribution", "normal", str),
    Control(".about", "mean"),
    Control(".by", "deviation"),
)
"""The controls of a tolerance, with only the last parts of their names; `_tolerance` adds the first parts.

The paths `mean` and `deviation` hold the typed mean and the typed width, whatever the distribution is.
"""
STATED = {"normal": ("mean", "deviation"), "lognormal": ("median", "factor")}
"""For each distribution, the parameter that is set to the typed mean and the parameter that is set to the typed width.

The other distributions have the parameters `min` and `max`; the triangular distribution also has `mode`.
"""


def _tolerance(place: int, name: str, about: Any = None, by: Any = None) -> list[Control]:
    """Return the controls of a tolerance. The default of the mean is `about`, and the default of the width is `by`."""
    usual = {"mean": about, "deviation": by}
    return [
        part._replace(
            name=f"{name}{part.name}",
            path=f"tolerances.inputs.{place}.{part.path}",
            default=usual.get(part.path, part.default),
        )
        for part in TOLERANCE
    ]


def _stated(law: str, about: Any, by: Any) -> dict[str, Any]:
    """Convert mean and width into the parameters of a distribution.

    The result is empty if the distribution is not known; the validation of the body then reports the error.
    """
    if names := STATED.get(law):
        return dict(zip(names, (about, by), strict=True))
    ends = {"uniform": ("min", "max"), "triangular": ("min", "mode", "max")}.get(law, ())
    return {end: {"min": about - by, "mode": about, "max": about + by}[end] for end in ends}


def _typed(scatter: dict[str, Any]) -> dict[str, Any]:
    """Convert a distribution in the body into the values of the controls.

    The controls have no mode, so a triangular distribution gets its mode in the middle of its range.
    """
    law = scatter["distribution"]
    if names := STATED.get(law):
        about, by = (scatter[name] for name in names)
    else:
        about, by = (scatter["min"] + scatter["max"]) / 2, (scatter["max"] - scatter["min"]) / 2
    return {"path": scatter["path"], "distribution": law, "mean": about, "deviation": by}


def address_of(
    endpoint: Calculation, request: Pairs, body: dict[str, Any], file: Mapping[str, str] = MappingProxyType({})
) -> str:
    """Return the address of the page that shows the study with this body.

    If the body has several limits, the address contains only the first limit. `file` names the file from which the
    study was read.
    """
    inputs, views = [_typed(scatter) for scatter in (body.get("tolerances") or {"inputs": []})["inputs"]], dict(file)
    given = {
        "cases": table_of(endpoint, body["cases"]),
        "tolerances": {"inputs": inputs},
        "hours_per_year": body.get("hours_per_year"),
    }
    for limit in (body.get("limits") or ())[:1]:
        (side,) = {"above", "below"} & set(limit)
        threshold = limit[side]
        views["show"] = limit["output"]
        given["limit"] = {"value": threshold.get("mean"), **threshold, "side": side}
    of_tolerances = (part for place in range(len(inputs)) for part in _tolerance(place, TOLERANCES[place]))
    controls = [*CONTROLS, *of_tolerances]
    return link(f"{page_path(endpoint)}/{SpectrumPage.link.name}", request, **views, **texts_of(controls, given))


class SpectrumPage(StudyPage):
    """The page that shows the study of a load spectrum."""

    link = StudyLink(
        "spectrum",
        "Load spectrum",
        "cases and tolerances: the probability of exceeding a limit, and the mean losses",
        place=3,
    )
    question = "its load spectrum"
    about = (
        "Random machines are drawn from the tolerances. Each machine runs every case, and its worst case is compared "
        "with the limit."
    )
    names = frozenset(
        {control.name for control in CONTROLS} | {f"{name}{part.name}" for name in TOLERANCES for part in TOLERANCE}
    )
    figures = ("limit", "probability", "decides", "losses")
    outputs = tuple(paths.contact for paths in SCUFFING.values())
    needs = ("cases", *TOLERANCES)
    choose = (
        "The table of cases lists what changes in each part of the operating time. The tolerances state how the "
        "fields scatter."
    )
    plan = Spectrum
    address_of = staticmethod(address_of)
    study: Spectrum

    def body(self) -> dict[str, Any]:
        """Return the body with the typed cases, tolerances and limit.

        The requested outputs are the output that the page shows, and the losses.
        """
        calculation, output, given = self.calculation, self.output.path, self.given()
        tolerances = given["tolerances"]
        typed = tolerances.get("inputs", [])
        inputs = [self._scatter(scatter, f"tolerances.inputs.{place}") for place, scatter in enumerate(typed)]
        machines = tolerances["count"]
        if not isinstance(machines, int):
            raise Unprocessable("int_type", "give a whole number", "tolerances.count")
        tolerances = {"inputs": inputs, "count": machines // REPLICATES, "replicates": REPLICATES}
        return {
            "endpoint": calculation.path,
            "request": self.asked.body,
            "cases": cases_of(calculation, given["cases"]),
            "tolerances": tolerances if inputs else None,
            "outputs": list(dict.fromkeys([output, *LOSSES.get(calculation.path, ())])),
            "limits": self._limits(given.get("limit", {})),
            "hours_per_year": given.get("hours_per_year"),
        }

    def _given(self) -> list[str]:
        """Return the names of the tolerances for which the user has entered values, in the order of the form."""
        return [name for name in TOLERANCES if self.views.get(name)]

    def declared(self) -> tuple[Control, ...]:
        """Return the controls for cases, machines, hours of operation, limit and tolerances.

        The default mean of a tolerance is the value of the field in the case.
        """
        controls = [
            *CONTROLS,
            Control("machines", "tolerances", sets=False),
            Control("limit", "limits", sets=False),
        ]
        for place, name in enumerate(self._given()):
            path = self.views[name]
            leaf, where = self.field_at(path), f"tolerances.inputs.{place}"
            controls += _tolerance(place, name, value_at(self.case, path), leaf.declared.tolerance if leaf else None)
            controls += (
                Control(f"{name}.about", f"{where}.median", sets=False),
                Control(f"{name}.by", where, sets=False),
            )
        return (*controls, *(Control(name, "tolerances.inputs", sets=False) for name in self._given()[:1]))

    def _scatter(self, given: dict[str, Any], where: str) -> dict[str, Any]:
        """Convert what the user typed for a tolerance into the form in which a request states a distribution.

        `given` holds the path of the field, the name of the distribution, the mean and the width.
        """
        leaf = scalar_at(self.calculation.request, given["path"], f"{where}.path", "unknown_path")
        about: Any = given.get("mean")
        by: Any = given.get("deviation")
        for value, lacks in (
            (about, "the value around which the field scatters"),
            (by, "the amount by which the field scatters"),
        ):
            if not is_number(value):
                raise Unprocessable("missing", f"{leaf.title}: give {lacks}", where)
        law = given["distribution"]
        return {"path": leaf.path, "distribution": law, **_stated(law, about, by)}

    @property
    def _assumes_limit(self) -> bool:
        """True if the scuffing temperature is the default limit of the output that the page shows."""
        scuffing = SCUFFING.get(self.calculation.path)
        return scuffing is not None and (self.views.get("show") or self.usual_output.path) == scuffing.contact

    def _limits(self, given: dict[str, Any]) -> list[dict[str, Any]] | None:
        """Return a list with the limit of the output, or an empty list if the output has no limit.

        If the user typed no limit, the usual limit of the output is used; but if this usual limit is the scuffing
        temperature, return None, because the study then adds the limit itself. Raises Unprocessable if the user typed a
        deviation but no value.
        """
        view, scatter, value = self.output.view, given.get("deviation"), given.get("value")
        if value is None and view.bound and isinstance(view.limit, int | float) and not self._assumes_limit:
            value = view.limit
        if value is None and scatter is not None:
            raise Unprocessable(
                "missing",
                "the limit has a deviation but no value; give the value as well",
                "limits.0.above",
            )
        if value is None:
            return None if self._assumes_limit else []
        side = given.get("side") or ("below" if view.greatest_is_best else "above")
        threshold = {"value": value} if scatter is None else {"mean": value, "deviation": scatter}
        return [{"output": self.output.path, side: threshold}]

    def controls(self) -> tuple[Controls, ...]:
        """Return a group of form fields for the table of cases, and one group per tolerance.

        After the group of the last tolerance that is filled in, there are two empty groups for further tolerances. The
        number of groups for tolerances is limited to the number of names in `TOLERANCES`.
        """
        case = self.case
        text = as_typed(self.views.get("cases", "")) or _suggested(self.calculation, case)
        about = (
            "The first line names the columns: name, share (of the operating time), and fields as in the form.",
            "One line per case; columns are separated by tabs or semicolons, as in a spreadsheet.",
            "An empty cell leaves the value of the case unchanged.",
        )
        table = replace(self.field("cases", "cases"), widget="table", text=text, help=about)
        groups = [Controls("Load spectrum", fields=(table,))]
        last = max((place for place, name in enumerate(TOLERANCES) if self.views.get(name)), default=-1)
        choices = field_choices(self.calculation, case, texts=False) if self.asked.pairs else []
        for place, name in enumerate(TOLERANCES[: last + 3]):
            path = self.views.get(name, "")
            leaf, own = leaf_at(self.calculation.request, path), value_at(case, path)
            unit, usual = (leaf.unit or "", leaf.declared.tolerance) if leaf else ("", None)
            fields = (
                self.field(f"{name}.law", "distribution", options=LAWS),
                self.field(f"{name}.by", "by", usual, difference_unit(unit) or ""),
                self.field(f"{name}.about", "around", own, unit),
            )
            groups.append(Controls(f"Tolerance {place + 1}", self.menu(name, "field", "none", choices), fields))
        return tuple(groups)

    def shows(self) -> tuple[FieldView, ...]:
        """Return the form fields for the limit of the output, the number of machines and the hours of operation."""
        assumed = self._assumes_limit and not self.views.get("limit")
        deviation = f"{percent(RELATIVE_DEVIATION)} of it" if assumed else "none"
        return (
            self.field("limit", "limit", "its own"),
            self.field("limit.by", "deviation of the limit", deviation),
            self.field("limit.side", "side", options=SIDES),
            self.field("machines", "machines drawn", options=MACHINES),
            self.field("hours", "hours a year"),
        )

    def starters(self) -> Sequence[Starter]:
        """Return links to the ready studies of /v1/spectrum. If the query has a case, return no links."""
        starters = []
        for example in EXAMPLES["/v1/spectrum"].values():
            body = example["value"]
            if body["endpoint"] == self.calculation.path and not self.asked.pairs:
                address = address_of(self.calculation, pairs_of(body["request"]), body)
                starters.append(Starter(example["summary"], "example", address))
        return starters

    def result(self, lines: list[Line]) -> Result:
        """Return the figures and tables of the study.

        They show the probability of exceeding the limit, the cases that are most often the worst case, the influence of
        the tolerances, and the losses.
        """
        header, end, output = lines[0], lines[-1], self.output
        cases = len(self.study.cases)
        machines = end["points"] // cases
        counted = [f"{count} {noun}{'s' * (count > 1)}" for count, noun in ((machines, "machine"), (cases, "case"))]
        progress = f"{' in '.join(counted)}, {shown(end['elapsed_s'], 2)} s"
        figures, notes = dict[str, Figure](), [*end["notes"]]
        limit = next((content for content in end["limits"] if content["output"] == output.path), None)
        if limit is not None:
            limited, conclusion = self._limited(end, limit), sentence(limit)
            progress = f"{conclusion[0].upper()}{conclusion[1:]}; {progress}"
            for name, draw in (("limit", overlap), ("probability", chances), ("decides", deciding)):
                try:
                    figures[name] = draw(limited)
                except NoFigure as error:
                    notes.append(error.message)
        elif not notes:
            notes.append(f"the {output.title} has no limit here; state a limit to get a probability")
        unsolved = end["points"] - sum(end["counts"].get(status, 0) for status in SOLVED)
        if unsolved:
            notes.append(
                f"{unsolved} of {end['points']} points have no solution. Each probability is a range: these points "
                "count as good at the lower end and as bad at the upper end"
            )
        tables = (
            *((self._limit_table(end, limit),) if limit else ()),
            self._cases_table(end, limit),
            self._outputs_table(end),
            *((_tolerances_table(header, limit),) if header["tolerances"] else ()),
        )
        remarks = tuple(f"{note[0].upper()}{note[1:]}." for note in notes)
        leads = (Link("Report with this spectrum", self.view("/report")),)
        return Result(progress, figures | self._losses(end), tables, remarks, leads)

    def _limited(self, end: Line, limit: Line) -> Limited:
        """Return the data that the figures about a limit show.

        If there are more than `MOST_BARS` cases, the data contain only the cases that are most often beyond the limit.
        """
        place = end["limits"].index(limit)
        decides = limit["decides"] or [None] * len(end["cases"])
        cases = [
            SpectrumCase(case["name"], case["quantiles"][self.output.path], case["limits"][place], share)
            for case, share in zip(end["cases"], decides, strict=True)
        ]
        worst = sorted(cases, key=lambda case: -case.chance["bounds"][1])[:MOST_BARS]
        titles = {leaf.path: leaf.title for leaf in self.study.scattering}
        ranks = limit["rank_correlation"] or {}
        influences = {titles[path]: value for path, value in ranks.items() if value is not None}
        return Limited(axis_of(self.output), limit, [case for case in cases if case in worst], influences)

    def _losses(self, end: Line) -> dict[str, Figure]:
        """Return a dictionary with one figure, which shows the mean losses in each case [kW].

        If no loss has a mean value, the dictionary is empty.
        """
        wanted, outputs = LOSSES.get(self.calculation.path, ()), end["outputs"]
        titles = {leaf.path: leaf.title for leaf in self.study.outputs}
        drawn_losses = {path: titles[path] for path in wanted if outputs[path]["mean"] is not None}
        if not drawn_losses:
            return {}
        cases = {
            case["name"]: {title: (case["means"][path] or 0.0) / 1e3 for path, title in drawn_losses.items()}
            for case in end["cases"][:MOST_BARS]
        }
        mean = {title: outputs[path]["mean"] / 1e3 for path, title in drawn_losses.items()}
        years = [outputs[path].get("energy_kwh_per_year") for path in drawn_losses]
        return {"losses": losses(cases, mean, None if None in years else sum(years) / 1e3)}

    def _limit_table(self, end: Line, limit: Line) -> Table:
        """Return a table that states the limit, its standard deviation and its source."""
        reasons = (assumption["reason"] for assumption in end["assumptions"] if assumption["field"] == "limits")
        reason = next(reasons, None)
        row = (
            self.output.title,
            f"not {limit['side']}",
            shown(limit["mean"], 4),
            "exact" if limit["deviation"] is None else _deviation(limit["deviation"], self.output.unit, 4),
            self.output.unit or "",
            "given" if reason is None else f"assumed: {cited(reason)}",
        )
        return Table("Limit", ("output", "side", Number("limit"), Number("deviation"), "unit", "source"), (row,))

    def _cases_table(self, end: Line, limit: Line | None) -> Table:
        """Return a table with one row per load case.

        A row has the case's share of the operating time, the probability of exceeding the limit, the fraction of
        machines for which the case is the worst case, the quantiles of the output, and the fraction of machines without
        a solution.
        """
        output, rows = self.output, list[tuple[str | Link, ...]]()
        for index, (case, content) in enumerate(zip(self.study.cases, end["cases"], strict=True)):
            row: list[str | Link] = [Link(content["name"], self.address(case.set)), percent(content["share"])]
            if limit:
                row.append(chance_text(content["limits"][end["limits"].index(limit)]))
                row.append(percent(limit["decides"][index]) if limit["decides"] else "–")
            row += [shown(value, 4) for value in content["quantiles"][output.path] or [None] * 3]
            rows.append((*row, percent(content["unsolved"])))
        unit = f", {output.unit}" if output.unit else ""
        judged = ("probability alone", "decides") if limit else ()
        heads = ("share", *judged, f"5 %{unit}", "50 %", "95 %", "unsolved")
        note = (
            f"The columns state, for each case, the values of {output.title} below which 5, 50 and 95 % of the "
            "machines lie."
        )
        return Table("Cases", ("case", *map(Number, heads)), rows, f"{note} Click a name to open the nominal case.")

    def _outputs_table(self, end: Line) -> Table:
        """Return a table with one row per output: the mean over the operating time, and the extremes.

        Each extreme is printed as a link that opens the machine and the case with this extreme.
        """
        rows = []
        for leaf in self.study.outputs:
            content = end["outputs"][leaf.path]
            ends = (
                Link(shown(extreme["value"], 4), self.address(extreme["at"])) if extreme else "–"
                for extreme in (content["min"], content["max"])
            )
            mean, error = shown(content["mean"], 4), _deviation(content["standard_error"], leaf.unit, 2)
            energy = shown(content.get("energy_kwh_per_year"), 4)
            rows.append((leaf.title, mean, error, *ends, leaf.unit or "", energy))
        heads = map(Number, ("mean", "standard error", "least", "largest"))
        head = ("output", *heads, "unit", Number("kWh a year"))
        return Table(
            "Over the operating time", head, rows, "Click a number to open the machine and the case with this value."
        )


def _deviation(value: float | None, unit: str | None, digits: int) -> str:
    """Return a difference of two values as text.

    `unit` is the unit of the values. If a difference has another unit (K instead of degrees Celsius), the text states
    this other unit.
    """
    own = difference_unit(unit)
    return shown(value, digits) if own == unit or value is None else number(value, own, digits)


def _suggested(calculation: Calculation, case: dict[str, Any]) -> str:
    """Return a table for the user to change: one row with the load of `case`, and one row with half of this load."""
    full = {path: value for path in USUAL if isinstance(value := value_at(case, path), int | float)}
    half = {path: value / 2 if "power" in path or "torque" in path else value for path, value in full.items()}
    return table_of(
        calculation, [{NAME: "full load", SHARE: 0.8, "set": full}, {NAME: "half load", SHARE: 0.2, "set": half}]
    )


def _tolerances_table(header: Line, limit: Line | None) -> Table:
    """Return a table of the fields that scatter, with their distributions.

    For each field, the table states how large a share of the distribution is cut off. The table also states the rank
    correlation between the value of the field and the output in the worst case.
    """
    numbers = ("mean", "deviation", "median", "factor", "min", "mode", "max")
    ranks = (limit and limit["rank_correlation"]) or {}
    rows = []
    for scatter in header["tolerances"]["inputs"]:
        stated = {name: shown(scatter[name], 4) for name in numbers if scatter.get(name) is not None}
        if "deviation" in stated:
            stated["deviation"] = _deviation(scatter["deviation"], scatter["unit"], 4)
        law = ", ".join(f"{name} {value}" for name, value in stated.items())
        described = (scatter["title"], f"{scatter['distribution']}: {law}", scatter["unit"] or "")
        rows.append((*described, percent(scatter["cut_off"]), shown(ranks.get(scatter["path"]), 3)))
    head = ("field", "distribution", "unit", Number("cut off"), Number("rank"))
    note = '"Cut off" is the share of values beyond four deviations or outside the range of the field'
    return Table("Tolerances", head, rows, f'{note}. "Rank" is the rank correlation with the worst case.')


PAGE = SpectrumPage
