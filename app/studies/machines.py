"""Machines of a gear unit, drawn at random: what is uncertain of the unit, what the models do not know, and the flanks.

The slopes of the flanks scatter by a quality class, and every class meets the same draws (common random numbers), so
that a difference between classes or corrections is not one between samples. Machines come in pairs that differ in the
sign of these slopes alone (antithetic draws): what a slope does in proportion to itself cancels exactly in the mean,
and only what costs on both sides is left to chance.
"""

from collections.abc import Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np
from pydantic import Field

from app.errors import Unprocessable
from app.models.sections.gears import QUALITY_CLASS, SLOPES_BY_CLASS
from app.schema.fields import Leaf, value_at
from app.schema.model import Request
from app.schema.quantities import Input
from app.studies.point_sets import CUT, CheckedAxis, anchors, checked_axes, drawn, scattering, unit_cube, usual_corners
from app.studies.points import BaseRequest
from app.studies.requests import Inputs, Overrides, Part, Ranges, Scalar, Scatter, Seed
from app.studies.tolerances import class_tolerances
from app.studies.uncertainty import assumptions_of, load_distributions, model_distributions
from solvers.arrays import FloatArray
from solvers.drive_train.uncertainty import MOST_CORNERS
from solvers.gears.inputs import GearPairInputs
from solvers.gears.tolerances import DEVIATIONS
from solvers.quantity import quantities

VARIED, TAIL = 2.0, 0.0228  # standard deviations by which a quantity varies alone, and the share beyond on one side
PAIR = 2  # machines that differ in the sign of their slopes alone
CLASSES = [3, 4, 5, 6, 7]  # of ISO 1328-1 in which ground gears of fast units are made
USUAL_CLASS = 5  # at which corrections are judged if the gears have no class, chosen
FINEST, COARSEST = (int(quantities(GearPairInputs)["quality_class"].bounds[end]) for end in ("ge", "le"))
QualityClass = Annotated[int, Field(ge=FINEST, le=COARSEST)]


class MachineDraws(Part):
    """How many machines are drawn, what differs between them, and the quality classes that are compared."""

    count: Annotated[
        int,
        Input("pairs in a sample", text="pairs of machines with slopes of either sign; a power of two", ge=1, le=4096),
    ] = 8
    replicates: Annotated[
        int,
        Input(
            "samples",
            text="independent ones; the scatter of their means is the error; a search takes one",
            ge=1,
            le=100,
        ),
    ] = 4
    seed: Seed = 1
    classes: Annotated[
        list[QualityClass],
        Field(min_length=1, max_length=COARSEST - FINEST + 1),
        Input("quality classes", text="classes of ISO 1328-1 to compare"),
    ] = CLASSES
    uncertain: Annotated[
        Ranges,
        Input(
            "uncertain inputs",
            text="drawn evenly: between two numbers, else one of the values; an empty list: none",
            default_text="the usual corners of the unit",
        ),
    ] = None
    model_uncertainty: Annotated[
        bool,
        Input("uncertainty of models and load", text="draw cooling and friction, application factor and power"),
    ] = True
    inputs: Annotated[
        Inputs | None,
        Input("distributions", text="further fields that scatter, instead of those above", default_text="none"),
    ] = None


class Variation(NamedTuple):
    """A quantity that differs between machines: its name, its fields, and their values at the ends of its range."""

    name: str
    paths: list[str]
    rows: list[Overrides]


class Machines:
    """The draws of a study: `total` machines, in `replicates` independent samples of `count` pairs.

    Machines 2 k and 2 k + 1 are a pair, and are the same if their flanks are exact.
    `case` is a load case, without which the request may lack inputs.
    `classes` are the quality classes that are compared, `reference` is that at which corrections are judged: the class
    of the gears, or the middle one if that is not compared.
    """

    def __init__(
        self, given: MachineDraws, base: BaseRequest, case: Overrides, set_elsewhere: set[str], place: str
    ) -> None:
        request = base.checked(case)
        self.given, self.total = given, PAIR * given.count * given.replicates
        self._request = request
        self.classes = sorted(set(given.classes))
        self.tolerances = {each: _of_class(request, each, f"{place}.classes") for each in self.classes}
        own = value_at(request, QUALITY_CLASS)
        wanted = USUAL_CLASS if own is None else own
        self.reference = wanted if wanted in self.classes else self.classes[len(self.classes) // 2]
        self.slopes = [*self.tolerances[self.reference]]
        taken = {*set_elsewhere, *self.slopes}
        listed = list(given.inputs or ())
        leaves = scattering(listed, base, f"{place}.inputs")
        _refuse_taken([leaf.path for leaf in leaves], taken, f"{place}.inputs")
        taken |= {leaf.path for leaf in leaves}
        self.axes = _axes(given, base, request, taken, f"{place}.uncertain")
        taken |= {leaf.path for axis in self.axes.values() for leaf in axis.leaves}
        unknown = load_distributions(request) | model_distributions(request) if given.model_uncertainty else {}
        models = [each for path, (each, _) in unknown.items() if path not in taken]
        self.assumed = assumptions_of(request, unknown, {each.path for each in models})
        self.scatters: list[Scatter] = [*listed, *models]
        self.leaves: tuple[Leaf, ...] = (*leaves, *scattering(models, base, place))
        columns = len(self.slopes) + len(self.axes) + len(self.scatters)
        seeds = np.random.SeedSequence(given.seed).spawn(given.replicates)
        self.cube = np.concatenate(
            [unit_cube("sobol", given.count, columns, np.random.default_rng(seed), f"{place}.count") for seed in seeds]
        )
        self._scores = _normal_scores(self.cube[:, : len(self.slopes)])
        after = len(self.slopes) + len(self.axes)
        self._values = np.empty((len(self.cube), 0))
        if self.scatters:
            self._values = drawn(self.scatters, self.leaves, self.cube[:, after:])
        self._rows = [
            _positions(axis, self.cube[:, len(self.slopes) + number]) for number, axis in enumerate(self.axes.values())
        ]

    @property
    def typical(self) -> Overrides:
        """Return permissible values of the fields that scatter, to check the request with."""
        return {scatter.path: next(iter(anchors(scatter).values())) for scatter in self.scatters}

    def overrides(self, draw: int, quality_class: int | None, correction: Overrides) -> Overrides:
        """Return the values of a machine that is ground with a correction; exactly, if `quality_class` is None."""
        machine: Overrides = dict(correction)
        pair, sign = draw // PAIR, 1.0 - 2.0 * (draw % PAIR)
        for path, score in zip(self.slopes, self._scores[pair].tolist(), strict=True):
            width = 0.0 if quality_class is None else self.tolerances[quality_class][path] / DEVIATIONS
            machine[path] = self._about(path, correction) + sign * score * width
        for axis, rows in zip(self.axes.values(), self._rows, strict=True):
            machine |= _at(axis, rows[pair])
        names = (leaf.path for leaf in self.leaves)
        return machine | dict(zip(names, self._values[pair].tolist(), strict=True))

    def _about(self, path: str, correction: Overrides) -> float:
        """Return the slope that is ground; a second helix without one of its own is ground as the first."""
        own: Any = correction.get(path, value_at(self._request, path))
        if own is None:
            own = correction.get(SLOPES_BY_CLASS[0], value_at(self._request, SLOPES_BY_CLASS[0]))
        return float(own or 0.0)

    def variations(self, correction: Overrides) -> list[Variation]:
        """Return each quantity at two standard deviations to either side, as if it alone differed from the case.

        Slopes vary by the class at which corrections are judged; a quantity with several rows takes each of them.
        """
        reach = (-VARIED, VARIED)
        slopes = [
            Variation(
                path.rpartition(".")[2].removesuffix("_um").replace("_", " "),
                [path],
                [{path: self._about(path, correction) + sign * width / DEVIATIONS} for sign in reach],
            )
            for path, width in self.tolerances[self.reference].items()
        ]
        shares = np.array([TAIL, 1.0 - TAIL])
        axes = []
        for name, axis in self.axes.items():
            places = shares if _is_between(axis) else (np.arange(len(axis.values or ())) + 0.5) / len(axis.values or ())
            rows = [_at(axis, position) for position in _positions(axis, places)]
            axes.append(Variation(name, [leaf.path for leaf in axis.leaves], rows))
        scatters = [
            Variation(
                leaf.title,
                [leaf.path],
                [{leaf.path: float(end)} for end in drawn([own], [leaf], shares[:, None])[:, 0]],
            )
            for own, leaf in zip(self.scatters, self.leaves, strict=True)
        ]
        return [*slopes, *axes, *scatters]


def _of_class(request: Request, quality_class: int, place: str) -> dict[str, float]:
    """Return three standard deviations of the slopes by a class [um]; raise Unprocessable beyond the standard."""
    try:
        return class_tolerances(request, quality_class)
    except Unprocessable as error:
        raise Unprocessable(error.code, error.message, place) from error


def _axes(
    given: MachineDraws, base: BaseRequest, request: Request, taken: set[str], place: str
) -> dict[str, CheckedAxis]:
    """Return the uncertain inputs by their names; the usual ones without fields that vary otherwise."""
    if given.uncertain is None:
        usual = {name: axis for name, axis in usual_corners(request).items() if taken.isdisjoint(axis.paths)}
        return dict(zip(usual, checked_axes(list(usual.values()), base, MOST_CORNERS, place), strict=True))
    axes = checked_axes(given.uncertain, base, MOST_CORNERS, place)  # they are drawn, so that corners do not count
    _refuse_taken([leaf.path for axis in axes for leaf in axis.leaves], taken, place)
    titles = [" and ".join(dict.fromkeys(leaf.title for leaf in axis.leaves)) for axis in axes]
    names = [
        title if titles.count(title) == 1 else f"{title}, {axis.leaves[0].path}"
        for title, axis in zip(titles, axes, strict=True)
    ]
    return dict(zip(names, axes, strict=True))


def _refuse_taken(paths: Sequence[str], taken: set[str], place: str) -> None:
    for path in paths:
        if path in taken:
            message = f"{path} already varies in another part of this study; let it vary in one part only"
            raise Unprocessable("duplicate_path", message, place)


def _normal_scores(shares: FloatArray) -> FloatArray:
    """Return standard normal numbers, cut off at four deviations as all normal distributions of studies."""
    from scipy.stats import norm  # noqa: PLC0415  half a second that only random samples need

    tail = norm.cdf(-CUT)
    return np.asarray(np.clip(norm.ppf(tail + (1.0 - 2.0 * tail) * shares), -CUT, CUT))


def _is_between(axis: CheckedAxis) -> bool:
    """Whether an axis has two rows of numbers, between which machines lie; else they have one of its rows."""
    rows = [row if isinstance(row, list) else [row] for row in axis.values or ()]
    numbers = all(isinstance(each, int | float) and not isinstance(each, bool) for row in rows for each in row)
    return len(rows) == 2 and numbers and all(leaf.kind == "number" for leaf in axis.leaves)


def _positions(axis: CheckedAxis, shares: FloatArray) -> list[float]:
    """Return where each machine lies on an axis: a share of the way from row to row, or the number of a row."""
    if _is_between(axis):
        return [float(share) for share in shares]
    count = len(axis.values or ())
    return [float(min(int(share * count), count - 1)) for share in shares]


def _at(axis: CheckedAxis, position: float) -> Overrides:
    """Return the values of the fields of an axis at a position of `_positions`."""

    def row(place: int) -> list[Any]:
        own: Scalar | list[Scalar] = (axis.values or ())[place]
        return own if isinstance(own, list) else [own] * len(axis.leaves)

    values = row(0) if _is_between(axis) else row(int(position))
    if _is_between(axis):
        values = [first + position * (last - first) for first, last in zip(values, row(1), strict=True)]
    return {leaf.path: value for leaf, value in zip(axis.leaves, values, strict=True)}
