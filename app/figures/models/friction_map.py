"""Where a coupling stands on the map of friction regimes (Pahl 1978, Fig. 9)."""

from math import exp, inf, log

import numpy as np

from app.figures.data import Area, Axis, Figure, Hue, Line, Mark, Panel, Role, values
from app.figures.declaration import present
from app.figures.wording import number
from app.schema.coupling import CouplingRequest, CouplingResponse
from solvers.coupling.friction.regimes import CAPACITY_BOUNDARIES, OVERLAP_BOUNDARIES, friction_regime

MAP_ENDS = {"overlap": (0.1, 10.0), "capacity": (0.01, 10.0)}


def friction_map(_: CouplingRequest, answer: CouplingResponse) -> Figure:
    """Supply of oil against strength of film, with the nine areas and the distance to the next."""
    lubrication = present(answer.lubrication)
    regime = lubrication.regime
    overlap, capacity = _shown(lubrication.contact_overlap), _shown(lubrication.load_capacity_coefficient)
    x = Axis(
        "contact surface overlap Pu (right: worse supply of oil)",
        log=True,
        limits=_around("overlap", overlap),
        ticks=_ticks(*OVERLAP_BOUNDARIES),
    )
    y = Axis(
        "load capacity coefficient Tr (up: stronger film)",
        log=True,
        limits=_around("capacity", capacity),
        ticks=_ticks(*CAPACITY_BOUNDARIES),
    )
    assert x.limits is not None
    assert y.limits is not None
    at = min(max(overlap, x.limits[0]), x.limits[1]), min(max(capacity, y.limits[0]), y.limits[1])
    distance = regime.distance_to_boundary
    away = "" if distance is None else f", a factor {number(exp(distance))} from the next area"
    return Figure(
        finding=f"area {regime.area}, {regime.name}{away}; μ = {number(lubrication.friction_coefficient)}",
        panels=(
            Panel(
                x=x,
                y=y,
                areas=_areas(x.limits, y.limits),
                lines=() if distance is None else (_way_out(*at, distance),),
                marks=(Mark(*at, _at(lubrication.contact_overlap, lubrication.load_capacity_coefficient)),),
            ),
        ),
    )


def _shown(coordinate: float | None) -> float:
    """A coordinate without an end stands at the edge of the map."""
    return inf if coordinate is None else coordinate


def _around(which: str, value: float) -> tuple[float, float]:
    """Ends of the map that hold the point, if a map can."""
    low, high = MAP_ENDS[which]
    if not 0.0 < value < inf:
        return low, high
    return min(low, 10.0 ** np.floor(np.log10(value / 1.2))), max(high, 10.0 ** np.ceil(np.log10(value * 1.2)))


def _ticks(low: float, high: float) -> tuple[float, ...]:
    """The boundaries and the decades that do not crowd them."""
    decades = (10.0**exponent for exponent in range(-12, 13))
    far = (decade for decade in decades if decade <= low / 1.9 or decade >= high * 1.9)
    return tuple(sorted({low, high, *far}))


def _at(overlap: float | None, capacity: float | None) -> str:
    texts = ("∞" if value is None else number(value) for value in (overlap, capacity))
    return "Pu = {}\nTr = {}".format(*texts)


def _areas(x: tuple[float, float], y: tuple[float, float]) -> tuple[Area, ...]:
    """The nine areas with what the model itself says of each."""
    columns = list(zip((x[0], *OVERLAP_BOUNDARIES), (*OVERLAP_BOUNDARIES, x[1]), strict=True))
    rows = list(zip((y[0], *CAPACITY_BOUNDARIES), (*CAPACITY_BOUNDARIES, y[1]), strict=True))
    return tuple(_one_area(column, row) for row in rows for column in columns)


def _one_area(x: tuple[float, float], y: tuple[float, float]) -> Area:
    regime = friction_regime((x[0] * x[1]) ** 0.5, (y[0] * y[1]) ** 0.5)
    band = _band(regime.friction_min, regime.friction_max)
    words = {"transition from mixed to boundary lubrication": "transition", "mixed lubrication, unstable": "unstable"}
    name = words.get(regime.name, regime.name.replace(" lubrication", "").replace("predominantly ", ""))
    return Area(*x, *y, "\n".join([regime.area, *name.split(" or ", 1)[:1], band]).strip(), _tint(regime.name))


def _band(low: float | None, high: float | None) -> str:
    if low is None and high is None:
        return ""
    if low is None or high is None:
        return f"μ < {high:g}" if high is not None else f"μ > {low:g}"
    return f"μ ≈ {low:g}" if low == high else f"μ {low:g} to {high:g}"


def _tint(name: str) -> Hue:
    for word, hue in (
        ("full", Hue.GREEN),
        ("unstable", Hue.PURPLE),
        ("transition", Hue.ORANGE),
        ("boundary", Hue.VERMILLION),
    ):
        if word in name:
            return hue
    return Hue.SKY


def _way_out(overlap: float, capacity: float, distance: float) -> Line:
    """From the point to the nearest boundary, along an axis."""
    for boundary in OVERLAP_BOUNDARIES:
        if 0.0 < overlap < inf and abs(abs(log(overlap / boundary)) - distance) < 1e-9:
            return _reference([overlap, boundary], [capacity, capacity])
    nearest = min(CAPACITY_BOUNDARIES, key=lambda boundary: abs(abs(log(capacity / boundary)) - distance))
    return _reference([overlap, overlap], [capacity, nearest])


def _reference(x: list[float], y: list[float]) -> Line:
    return Line("to the next area", values(x), values(y), Hue.GREY, Role.REFERENCE, named=False)
