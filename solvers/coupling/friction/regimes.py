"""Regimes of tooth friction and a coefficient that follows them continuously (Figs 9, 10 and 11)."""

from math import exp, inf, log

import numpy as np

from solvers.coupling.inputs import Friction, MixedFrictionCurve, MixedFrictionTable
from solvers.coupling.results import Regime

OVERLAP_BOUNDARIES = (1.0, 2.0)
CAPACITY_BOUNDARIES = (0.2, 0.8)
UNSTABLE_AREA = "3.3"

# Fig. 9: area -> name and the paper's band of friction, None where it states no end.
_AREAS: dict[str, tuple[str, float | None, float | None]] = {
    "1.1": ("mixed lubrication", 0.05, 0.1),
    "1.2": ("transition from mixed to boundary lubrication", 0.1, 0.1),
    "1.3": ("boundary lubrication", 0.1, None),
    "2.1": ("mixed lubrication", 0.01, 0.05),
    "2.2": ("mixed lubrication", 0.01, 0.1),
    "2.3": ("boundary or mixed lubrication", 0.1, 0.1),
    "3.1": ("predominantly full film", None, 0.01),
    "3.2": ("mixed lubrication", 0.01, 0.1),
    "3.3": ("mixed lubrication, unstable", None, None),
}


def friction_regime(overlap: float, load_capacity_coefficient: float) -> Regime:
    """The area of Fig. 9. A load capacity on a boundary belongs to the higher row, an overlap to the middle column."""
    row = 1 + sum(load_capacity_coefficient >= boundary for boundary in CAPACITY_BOUNDARIES)
    column = 1 + (overlap >= OVERLAP_BOUNDARIES[0]) + (overlap > OVERLAP_BOUNDARIES[1])
    area = f"{row}.{column}"
    name, friction_min, friction_max = _AREAS[area]
    return Regime(
        area=area,
        name=name,
        friction_min=friction_min,
        friction_max=friction_max,
        distance_to_boundary=_distance_to_boundary(overlap, load_capacity_coefficient),
    )


def _distance_to_boundary(overlap: float, load_capacity_coefficient: float) -> float | None:
    """Smallest |ln| of both coordinates against their boundaries; None if they lie infinitely far."""
    ratios = [overlap / boundary for boundary in OVERLAP_BOUNDARIES]
    ratios += [load_capacity_coefficient / boundary for boundary in CAPACITY_BOUNDARIES]
    return min((abs(log(ratio)) for ratio in ratios if 0.0 < ratio < inf), default=None)


def mixed_friction(law: MixedFrictionCurve | MixedFrictionTable, sliding_velocity: float) -> float:
    """Friction of area 1.1 at the largest sliding velocity [m/s] (Fig. 10, whose points the paper does not print)."""
    if isinstance(law, MixedFrictionTable):
        return float(np.interp(sliding_velocity, law.sliding_velocity, law.coefficient))
    ratio = sliding_velocity / law.velocity
    if ratio <= 1.0:
        return law.lowest + (law.highest - law.lowest) * (1.0 - ratio) ** 2
    return min(law.highest, law.lowest + 0.02 * log(ratio) ** 2)


def lowest_mixed_friction(law: MixedFrictionCurve | MixedFrictionTable) -> float:
    """The least that mixed friction comes to at any sliding velocity."""
    return min(law.coefficient) if isinstance(law, MixedFrictionTable) else law.lowest


def _interpolate_logarithm(x: float, points: tuple[tuple[float, float], ...]) -> float:
    """Linear interpolation of ln(y) in x, constant outside."""
    return exp(float(np.interp(x, [p[0] for p in points], [log(p[1]) for p in points])))


def _well_supplied(load_capacity_coefficient: float, mixed: float, lowest: float) -> float:
    """Friction at an overlap below 1: from the mixed friction in use through its least to that of a full film."""
    full_film = min(0.01, lowest)
    if load_capacity_coefficient > 0.8:
        return min(full_film, max(0.003, 0.008 / load_capacity_coefficient))
    return _interpolate_logarithm(load_capacity_coefficient, ((0.0, mixed), (0.2, lowest), (0.8, full_film)))


def _poorly_supplied(overlap: float, load_capacity_coefficient: float) -> float:
    """Friction at an overlap above 2; at no film it rises to 0.16, the largest that Calistrat measured (1981)."""
    dry = 0.1 + 0.06 * min(1.0, (overlap - 2.0) / 2.0)
    points = ((0.0, dry), (0.2, 0.1), (0.8, 0.1), (1.6, 0.05))
    return _interpolate_logarithm(load_capacity_coefficient, points)


def regime_friction(overlap: float, load_capacity_coefficient: float, mixed: float, lowest: float) -> float:
    """Coefficient of friction anywhere on the map, continuous, given that of mixed friction and its `lowest` value.

    The paper states bands; this law keeps to their end values and lies inside those of areas 1.1, 1.3, 2.1, 2.2, 2.3
    and 3.1. Across 1.2 it blends, and it may leave 3.2 near overlap 1: the paper calls the boundaries fluid. It never
    rises with the load capacity coefficient.
    """
    if overlap > 2.0:
        return _poorly_supplied(overlap, load_capacity_coefficient)
    well = _well_supplied(load_capacity_coefficient, mixed, lowest)
    if overlap < 1.0:
        return well
    poor = _poorly_supplied(2.0, load_capacity_coefficient)
    return exp((2.0 - overlap) * log(well) + (overlap - 1.0) * log(poor))


def friction_coefficient(
    friction: Friction, overlap: float, load_capacity_coefficient: float, sliding_velocity: float
) -> float:
    """The user's coefficient, or that of the regime at the largest sliding velocity [m/s]."""
    if friction.coefficient is not None:
        return friction.coefficient
    law = friction.law
    mixed = mixed_friction(law, sliding_velocity)
    return regime_friction(overlap, load_capacity_coefficient, mixed, lowest_mixed_friction(law))


def static_friction(friction: Friction) -> float:
    """The user's coefficient at rest, else the user's coefficient, else that of the regime at rest without film."""
    if friction.static_coefficient is not None:
        return friction.static_coefficient
    return friction_coefficient(friction, overlap=inf, load_capacity_coefficient=0.0, sliding_velocity=0.0)
