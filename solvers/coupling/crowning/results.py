"""What the search for a crowning ratio answers, in SI: forces [N], velocities [m/s], arrays read-only."""

from solvers.arrays import FloatArray
from solvers.coupling.inputs import Coupling
from solvers.notices import Notice
from solvers.quantity import quantity, record
from solvers.sources import PAHL


@record
class RecommendedPoint:
    """The recommended coupling at one end of the misalignment range."""

    contact_overlap: float = quantity("contact surface overlap", "Pu", PAHL)
    load_capacity_coefficient: float = quantity("load capacity coefficient", "Tr", PAHL)
    friction_coefficient: float = quantity("friction coefficient in use", "μ")
    axial_thrust: float = quantity("axial thrust", "F_ax", unit="n", text="axial thrust at the axial velocity given")
    sliding_velocity: float = quantity("largest sliding velocity", "v_G,max", unit="m_per_s")


@record
class CrowningScan:
    """How crowning trades off, one value a crowning ratio whose contact can be computed.

    The smallest load capacity coefficient and the largest overlap over the range of misalignment.
    """

    crowning_ratio: FloatArray = quantity("crowning ratio scanned", "ε")
    min_load_capacity_coefficient: FloatArray = quantity(
        "smallest load capacity coefficient", "Tr", axis="crowning_ratio", gaps=True
    )
    max_contact_overlap: FloatArray = quantity(
        "largest contact surface overlap", "Pu", axis="crowning_ratio", gaps=True
    )
    feasible: tuple[bool, ...] = quantity("feasible", text="whether every constraint is met", axis="crowning_ratio")


@record
class Recommendation:
    """The crowning ratio with the largest load capacity that meets every constraint over the range.

    Where there is none, `feasible` is False, `failed_constraint` names the constraint that excludes it
    (`contact_overlap`, `edge_contact`, `hertz_pressure`, `contact_width`, `sliding_velocity`) and the rest is None.
    """

    feasible: bool = quantity("feasible crowning", text="whether any crowning ratio meets every constraint")
    crowning_ratio: float | None = quantity("best crowning ratio", "ε")
    min_load_capacity_coefficient: float | None = quantity(
        "least load capacity coefficient", "Tr_min", text="smallest over the range"
    )
    failed_constraint: str | None = quantity("failed constraint", text="the constraint that leaves no crowning ratio")
    at_min: RecommendedPoint | None = quantity("at the smallest misalignment")
    at_max: RecommendedPoint | None = quantity("at the largest misalignment")
    scan: CrowningScan = quantity("scan", text="how crowning trades off", detail="curves")
    derived: Coupling = quantity("proportions used")
    warnings: tuple[Notice, ...]
