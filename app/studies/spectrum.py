"""Load spectra: a machine with its tolerances over its cases, and the probability that it exceeds its limits."""

from collections.abc import Sequence
from time import perf_counter
from typing import NamedTuple

import numpy as np

from app.errors import Unprocessable
from app.schema.fields import Leaf
from app.studies import engine, probability
from app.studies.engine import Clock, Line, Lines, Pool, Study, output_header, paths_of
from app.studies.fields import NUMBERS
from app.studies.point_sets import anchors, cut, drawn, fields_set, scattering, unit_cube
from app.studies.points import SOLVED, BaseRequest, Question, solve_point
from app.studies.probability import Limit
from app.studies.requests import DRIVE_TRAIN, LoadCase, Overrides, SpectrumLimit, SpectrumRequest, Tolerances
from solvers.arrays import FloatArray

PROGRESS_S = 0.5  # between two lines that say how far a spectrum has come
KILOWATTS = {"W": 1e-3, "kW": 1.0}  # per unit
RELATIVE_DEVIATION = 0.15  # AGMA 925-A03, quoted, not verified against the standard
LIMIT_VARIES = 1e-9  # relative
SHARES_OFF = 0.01  # how far the sum of the shares may be from 1
ASSUMED_DEVIATION = (
    "the scuffing temperature is normally distributed with 0.15 of itself as deviation (AGMA 925-A03, secondary source)"
)

RARE = 0.005  # below this the intervals of a probability cover less than they say
RARE_NOTE = (
    "a probability below 0.5 %: the means of the replicates are skewed, and a 90 % interval covers less, about 80 % at "
    "0.1 % with 128 machines in each of 8 replicates; draw more machines"
)
NOT_USED = "not used"  # how the reason of an assumption begins whose value changes nothing


class Scuffing(NamedTuple):
    """The paths of contact temperature and scuffing temperature in an answer."""

    contact: str
    limit: str


SCUFFING = {
    "/v1/scuffing": Scuffing("contact_temperature.blok_max_c", "safety.scuffing_c"),
    DRIVE_TRAIN: Scuffing("flash.contact_max_c", "derived.temperatures.scuffing_c"),
}


class Spectrum(Study):
    """Machines are drawn from the tolerances; each runs every case, and its worst case is compared with the limits.

    The last line has the probability of exceeding each limit with its 90 % interval, for the spectrum and for each case
    alone; how often each case is the worst (`decides`); the rank correlation with each tolerance; and of every output
    the mean over the operating time, the extremes, and the 5, 50 and 95 % quantiles in each case. Draws without
    solution are counted: where there are any, the probability is only known between its `bounds`. Where no output needs
    the thermal film, it is not calculated. Lines of `progress` come every half second.
    """

    path = "/v1/spectrum"
    summary = "A machine with its tolerances over its load spectrum: probabilities, losses, what decides"
    answer = "a line for the spectrum, one for each point if asked for, and one for the end"
    model = SpectrumRequest
    most = "spectrum_solves"
    body: SpectrumRequest

    def _outputs(self, base: BaseRequest) -> tuple[Leaf, ...]:
        """The outputs asked for, by default the headline numbers, and those that are limited."""
        body = self.body
        found = {f"outputs.{place}": leaf for place, leaf in enumerate(base.outputs(body.outputs))}
        if body.outputs is None:
            found = {place: leaf for place, leaf in found.items() if leaf.kind in NUMBERS}
        for number, each in enumerate(body.limits or ()):
            place = f"limits.{number}.output"
            found[place] = base.output(each.output, place)
        for place, leaf in found.items():
            if leaf.kind not in NUMBERS:
                raise Unprocessable("unknown_output", f"{leaf.path} is no number", place)
        if body.limits is None and body.endpoint in SCUFFING:
            found["limits"] = base.output(SCUFFING[body.endpoint].contact, "limits")
        return tuple({leaf.path: leaf for leaf in found.values()}.values())

    def _planned(self, base: BaseRequest, most: int) -> int:
        body, tolerances = self.body, self.body.tolerances
        known = fields_set([case.set for case in body.cases], base, "cases.{}.set")
        inputs = tolerances.inputs if tolerances else []
        self.scattering = scattering(inputs, base, "tolerances.inputs")
        for place, leaf in enumerate(self.scattering):
            if leaf.path in known:
                message = f"{leaf.path} has a value in a case; a field either scatters or is set"
                raise Unprocessable("duplicate_path", message, f"tolerances.inputs.{place}.path")
        if body.limits is None and body.endpoint in SCUFFING:  # columns behind those of the outputs
            columns = dict.fromkeys([*self.question.outputs, *SCUFFING[body.endpoint]])
            self.question = self.question._replace(outputs=list(columns))
        typical = {each.path: next(iter(anchors(each).values())) for each in inputs}
        for case in body.cases:
            base.checked({**typical, **case.set})
        total = len(body.cases) * (tolerances.count * tolerances.replicates if tolerances else 1)
        if total > most:
            message = _too_many(self.question, {**typical, **body.cases[0].set}, total, most)
            raise Unprocessable("too_many_points", message, "tolerances.count" if tolerances else "cases")
        self.cases = _with_shares(body.cases)
        # The values that scatter, a row a machine, replicate after replicate; the nominal machine alone has none.
        self.machines = _machines(tolerances, self.scattering) if tolerances else np.empty((1, 0))
        return total

    def overrides(self, index: int) -> Overrides:
        """What a point changes in the base request; points are the cases of the first machine, then of the next."""
        draw, case = divmod(index, len(self.cases))
        machine = dict(zip(paths_of(self.scattering), self.machines[draw].tolist(), strict=True))
        return machine | self.cases[case].set

    async def lines(self, pool: Pool, clock: Clock) -> Lines:
        """The header, the points if they are asked for, how far it has come, the end."""
        yield [
            self.header(
                cases=[case.model_dump() for case in self.cases],
                tolerances=self._tolerances_header(),
                outputs=[output_header(leaf) for leaf in self.outputs],
                total=self.total,
            )
        ]
        tally, due = engine.Tally(self.question.outputs), PROGRESS_S
        async for indices, points in engine.in_order(pool, self.question, self.overrides, range(self.total), clock):
            lines: list[Line] = []
            for index, point in zip(indices, points, strict=True):
                tally.add(point)
                tally.keep(point.out if point.status in SOLVED else [None] * len(point.out))
                if self.body.points:
                    draw, case = divmod(index, len(self.cases))
                    shown = point._replace(out=point.out[: len(self.outputs)])
                    lines.append({**engine.point_line(index, self.overrides(index), shown), "draw": draw, "case": case})
            if clock.elapsed_s >= due:
                lines.append(clock.line())
                due = clock.elapsed_s + PROGRESS_S
            yield lines
        replicates = self.body.tolerances.replicates if self.body.tolerances else 1
        values = tally.values.reshape(replicates, -1, len(self.cases), len(self.question.outputs))
        statistics = await engine.twice_if_lost(pool, evaluated, self, values)
        assumptions = list(tally.assumptions.values())
        yield [
            {
                "type": "end",
                **statistics,
                "notes": [*statistics["notes"], *self._ignored(assumptions)],
                "points": self.total,
                "counts": dict(sorted(tally.counts.items())),
                "errors": dict(sorted(tally.errors.items())),
                "warnings": dict(sorted(tally.warnings.items())),
                "assumptions": [*statistics["assumptions"], *assumptions],
                "elapsed_s": clock.elapsed_s,
            }
        ]

    def _tolerances_header(self) -> Line | None:
        """How the machines are drawn, and what share of each distribution is cut off."""
        if self.body.tolerances is None:
            return None
        inputs = [
            {**each.model_dump(), "unit": leaf.unit, "title": leaf.title, "cut_off": cut(each, leaf).cut_off}
            for each, leaf in zip(self.body.tolerances.inputs, self.scattering, strict=True)
        ]
        return {**self.body.tolerances.model_dump(), "inputs": inputs}

    def _ignored(self, assumptions: Sequence[Line]) -> list[str]:
        """What is to be said of tolerances that the model does not use as the request stands."""
        found = {each["field"]: each["reason"] for each in assumptions if each["reason"].startswith(NOT_USED)}
        return [f"{path} scatters without effect; {found[path]}" for path in paths_of(self.scattering) if path in found]


def evaluated(study: Spectrum, values: FloatArray) -> Line:
    """The content of the last line, from the outputs `[replicate, draw, case, output]`; runs in a worker."""
    columns = {path: values[..., place] for place, path in enumerate(study.question.outputs)}
    limits, assumptions, notes = _limits(study, columns)
    limited = [_of_limit(study, each, columns[each.output]) for each in limits]
    if any(each["interval"] and each["deviation"] and each["bounds"][1] < RARE for each in limited):
        notes = [*notes, RARE_NOTE]
    shown = {leaf.path: columns[leaf.path] for leaf in study.outputs}
    return {
        "cases": [
            {
                "name": case.name,
                "share": case.share,
                "unsolved": float(np.isnan(values[:, :, place]).all(axis=-1).mean()),
                "means": {path: probability.mean(column[..., place]) for path, column in shown.items()},
                "quantiles": {path: probability.quantiles(column[..., place]) for path, column in shown.items()},
                "limits": [probability.of_case(columns[each.output][..., place], each)._asdict() for each in limits],
            }
            for place, case in enumerate(study.cases)
        ],
        "limits": limited,
        "outputs": {leaf.path: _of_output(study, leaf, columns[leaf.path]) for leaf in study.outputs},
        "notes": notes,
        "assumptions": assumptions,
    }


def _limits(study: Spectrum, columns: dict[str, FloatArray]) -> tuple[list[Limit], list[Line], list[str]]:
    """The limits used, the assumption where the default limit is used, and notes."""
    paths = SCUFFING.get(study.question.endpoint)
    if study.body.limits is not None or paths is None:
        return [_limit(each) for each in study.body.limits or ()], [], []
    known = columns[paths.limit][~np.isnan(columns[paths.limit])]
    if not known.size:
        return [], [], ["no limit is given, and the request has no scuffing temperature: give one of them"]
    first = columns[paths.limit][..., 0]
    mean = float(np.nanmedian(known if np.isnan(first).all() else first))  # no single machine of a sample sets it
    limit = Limit("above", mean, RELATIVE_DEVIATION * abs(mean), paths.contact)
    assumption = {"field": "limits", "value": limit.deviation, "reason": ASSUMED_DEVIATION}
    varies = np.ptp(known) > LIMIT_VARIES * abs(mean)
    note = (
        "the scuffing temperature differs between the cases or the machines; the limit is its median in the first "
        f"case, {mean:.4g}; give limits"
    )
    return [limit], [assumption], [note] if varies else []


def _of_limit(study: Spectrum, limit: Limit, outputs: FloatArray) -> Line:
    """The probability over the spectrum, how often each case is the worst, the correlation with each tolerance."""
    worst = limit.worst(outputs)
    edges, density = probability.histogram(worst)
    solved = ~np.isnan(outputs).any(axis=-1).ravel()
    correlation = {
        leaf.path: probability.rank_correlation(column[solved], worst.ravel()[solved])
        for leaf, column in zip(study.scattering, study.machines.T, strict=True)
    }
    return {
        "output": limit.output,
        "side": limit.side,
        "mean": limit.mean,
        "deviation": limit.deviation or None,
        **probability.of_spectrum(outputs, limit)._asdict(),
        "unsolved": 1.0 - float(solved.mean()),
        "decides": probability.deciding(outputs.reshape(-1, outputs.shape[-1]), limit),
        "rank_correlation": correlation or None,
        "quantiles": probability.quantiles(worst),
        "histogram": {"edges": edges, "density": density},
    }


def _of_output(study: Spectrum, leaf: Leaf, column: FloatArray) -> Line:
    """Mean of an output over the spectrum, the energy per year of a power, and the extremes."""
    mean = probability.weighted_mean(column, [case.share or 0.0 for case in study.cases])
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
    """A limit of the request."""
    threshold = given.above or given.below
    assert threshold is not None
    mean = threshold.mean if threshold.value is None else threshold.value
    assert mean is not None
    return Limit("above" if given.above else "below", mean, threshold.deviation or 0.0, given.output)


def _with_shares(cases: Sequence[LoadCase]) -> list[LoadCase]:
    """The cases with their names and their shares of the operating time, whose sum is 1; raises Unprocessable."""
    given = [each.share for each in cases if each.share is not None]
    if given and len(given) < len(cases):
        raise Unprocessable("shares", "give every case its share, or none", "cases")
    shares = given or [1.0] * len(cases)
    whole = sum(shares)
    if given and abs(whole - 1.0) > SHARES_OFF + 1e-12:
        message = f"the shares add up to {whole:.6g}; give fractions of the time that add up to 1"
        raise Unprocessable("shares", message, "cases")
    return [
        each.model_copy(update={"name": each.name or f"case {place}", "share": share / whole})
        for place, (each, share) in enumerate(zip(cases, shares, strict=True), start=1)
    ]


def _machines(tolerances: Tolerances, leaves: Sequence[Leaf]) -> FloatArray:
    """The values that scatter, a row a machine; each replicate is a random sample of its own."""
    seeds = np.random.SeedSequence(tolerances.seed).spawn(tolerances.replicates)
    cubes = [
        unit_cube(tolerances.method, tolerances.count, len(leaves), np.random.default_rng(seed), "tolerances.count")
        for seed in seeds
    ]
    return drawn(tolerances.inputs, leaves, np.concatenate(cubes))


def _too_many(question: Question, overrides: Overrides, total: int, most: int) -> str:
    """The refusal of a study with too many points, with an estimate of its time from one of them."""
    solve_point(question, overrides)  # the first one may load kernels
    started = perf_counter()
    solve_point(question, overrides)
    seconds = perf_counter() - started
    return (
        f"cases x machines are {total} solutions; the limit is {most}. One takes some {seconds:.2g} s, "
        f"all of them {total * seconds:,.0f} s on one core"
    )
