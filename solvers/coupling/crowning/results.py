"""What the search for a crowning ratio answers, in SI: forces [N], velocities [m/s], arrays read-only."""

from dataclasses import dataclass

from solvers.arrays import FloatArray
from solvers.coupling.inputs import Coupling
from solvers.notices import Notice


@dataclass(frozen=True, slots=True)
class RecommendedPoint:
    """The recommended coupling at one end of the misalignment range."""

    contact_overlap: float
    load_capacity_coefficient: float
    friction_coefficient: float
    axial_thrust: float
    sliding_velocity: float


@dataclass(frozen=True, slots=True)
class CrowningScan:
    """How crowning trades off, one value a crowning ratio whose contact can be computed.

    The smallest load capacity coefficient and the largest overlap over the range of misalignment.
    """

    crowning_ratio: FloatArray
    min_load_capacity_coefficient: FloatArray
    max_contact_overlap: FloatArray
    feasible: tuple[bool, ...]


@dataclass(frozen=True, slots=True)
class Recommendation:
    """The crowning ratio with the largest load capacity that meets every constraint over the range.

    Where there is none, `feasible` is False, `failed_constraint` names the constraint that excludes it
    (`contact_overlap`, `edge_contact`, `hertz_pressure`, `contact_width`, `sliding_velocity`) and the rest is None.
    """

    feasible: bool
    crowning_ratio: float | None
    min_load_capacity_coefficient: float | None
    failed_constraint: str | None
    at_min: RecommendedPoint | None
    at_max: RecommendedPoint | None
    scan: CrowningScan
    derived: Coupling
    warnings: tuple[Notice, ...]
