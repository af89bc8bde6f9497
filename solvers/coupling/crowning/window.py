"""What a crowning ratio means over a range of misalignment, and the ratios that meet every constraint."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import exp, log

from scipy.optimize import brentq

from solvers.coupling.checks import MAX_CONTACT_PRESSURE, MAX_CONTACT_WIDTH
from solvers.coupling.friction.lubrication import film_state
from solvers.coupling.inputs import CouplingInputs, RecommendationInputs
from solvers.coupling.results import Geometry
from solvers.coupling.teeth.geometry import tooth_geometry
from solvers.coupling.teeth.kinematics import max_contact_travel, mesh_motion

MIN_CROWNING_RATIO = 0.2
MAX_CROWNING_RATIO = 1000.0
# Constraint by its public name, and the quantity that a larger crowning ratio lowers.
_LOWER_BOUNDS = (("hertz_pressure", "pressure"), ("contact_width", "width"), ("contact_overlap", "overlap"))


@dataclass(frozen=True, slots=True)
class CrowningState:
    """A crowning ratio over the range of misalignment, each quantity at its worst end.

    `overlap`, `edge` (reach of the contact over half the face), `pressure` and `width` (over what is allowed) must
    stay below 1; `load_capacity_coefficient` is the smallest.
    """

    overlap: float
    edge: float
    pressure: float
    width: float
    load_capacity_coefficient: float

    @property
    def computable(self) -> bool:
        """Whether the contact is one of Hertz."""
        return self.pressure <= 1.0 and self.width <= 1.0

    @property
    def feasible(self) -> bool:
        """Whether every constraint of the crowning is met."""
        return self.computable and self.overlap < 1.0 and self.edge <= 1.0


def at_misalignment(inputs: RecommendationInputs, ratio: float, misalignment: float) -> CouplingInputs:
    """The design with a crowning ratio at a misalignment [rad]."""
    design = inputs.design
    return replace(
        design,
        coupling=replace(design.coupling, crowning_ratio=ratio),
        operation=replace(design.operation, misalignment=misalignment),
    )


def crowning_state(inputs: RecommendationInputs, ratio: float) -> CrowningState:
    """Constraints and load capacity of a crowning ratio at both ends of the range."""
    design = inputs.design
    crowned = replace(design, coupling=replace(design.coupling, crowning_ratio=ratio))
    geometry = tooth_geometry(crowned.coupling)
    first = _state_at(inputs.min_misalignment, crowned, geometry)
    last = _state_at(inputs.max_misalignment, crowned, geometry)
    return CrowningState(
        overlap=max(first.overlap, last.overlap),
        edge=max(first.edge, last.edge),
        pressure=max(first.pressure, last.pressure),
        width=max(first.width, last.width),
        load_capacity_coefficient=min(first.load_capacity_coefficient, last.load_capacity_coefficient),
    )


def _state_at(misalignment: float, crowned: CouplingInputs, geometry: Geometry) -> CrowningState:
    """Constraints and load capacity at one misalignment [rad]: of all the film takes, it moves the mesh alone."""
    operation = replace(crowned.operation, misalignment=misalignment)
    mesh = mesh_motion(crowned.coupling, geometry, operation, crowned.model.kinematics)
    film = film_state(crowned, geometry, mesh)
    reach = max_contact_travel(mesh) + film.contact_half_width
    return CrowningState(
        overlap=film.overlap,
        edge=reach / (crowned.coupling.face_width / 2.0),
        pressure=film.contact_pressure / MAX_CONTACT_PRESSURE,
        width=film.contact_half_width / (MAX_CONTACT_WIDTH * geometry.normal_flank_radius),
        load_capacity_coefficient=film.load_capacity_coefficient,
    )


def crowning_window(state: Callable[[float], CrowningState]) -> tuple[float, float, str | None]:
    """Smallest and largest crowning ratio that meet every constraint, and the name of the one that fails, if any.

    Overlap, pressure and width ask for at least, the edge for at most some crowning ratio.
    """
    low = MIN_CROWNING_RATIO
    for name, constraint in _LOWER_BOUNDS:
        bound = _root(state, constraint)
        if bound >= MAX_CROWNING_RATIO:
            return low, low, name
        low = max(low, bound)
    # Inside both ends, whatever the rounding: the overlap must be below 1, not at it.
    low *= 1.0 + 1e-9
    high = _root(state, "edge") * (1.0 - 1e-9)
    return low, high, None if low < high else "edge_contact"


def _root(state: Callable[[float], CrowningState], constraint: str) -> float:
    """The crowning ratio at which a constraint reaches 1, or the end of the range on whose side it always is."""

    def excess(logarithm: float) -> float:
        return log(getattr(state(exp(logarithm)), constraint))

    low, high = log(MIN_CROWNING_RATIO), log(MAX_CROWNING_RATIO)
    at_low, at_high = excess(low), excess(high)
    if at_low * at_high < 0.0:
        return exp(brentq(excess, low, high, xtol=1e-12, rtol=1e-12))
    rising = at_high > at_low
    below = at_low < 0.0
    return MAX_CROWNING_RATIO if rising == below else MIN_CROWNING_RATIO
