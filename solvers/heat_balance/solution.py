"""Equilibrium of the network by Newton's method with a Jacobian by finite differences."""

from dataclasses import dataclass

import numpy as np

from solvers.arrays import FloatArray
from solvers.errors import NoSolution
from solvers.heat_balance.network import Network

TOLERANCE = 1e-5  # K; largest last Newton step, which must be a full step. The error is about the square of the step.
DIFFERENCE = 1e-4  # K; step of the Jacobian's differences
MOST_STEPS, MOST_HALVINGS = 50, 30
LARGEST_STEP = 100.0  # K
COLDEST = 0.75  # share of the lowest given temperature [K]; at lower temperatures the laws of viscosity do not hold
HOTTEST = 1200.0  # K over the supply temperature; steel melts at such temperatures


@dataclass(frozen=True, slots=True)
class Equilibrium:
    """Temperature rises of the nodes over the supplied oil [K], number of Newton steps, and residual [W]."""

    rises: FloatArray
    iterations: int
    residual: float


def equilibrium(network: Network, start: FloatArray | None = None) -> Equilibrium:
    """Temperatures at which every node of the network gains as much heat as it loses (Eq. H18).

    Stable if the Jacobian's negative is an M-matrix. Row sums that are all positive exclude a second equilibrium; with
    hot flanks and little oil one is possible and not searched for. Raises NoSolution: `heat_balance` without
    convergence, `thermal_runaway` if not stable.
    """
    rises = np.zeros(network.size) if start is None else np.array(start, dtype=float)
    residual = network.residual(rises)
    lowest = COLDEST * network.coldest - network.oil.inlet
    for iteration in range(1, MOST_STEPS + 1):
        slopes = jacobian(network, rises, residual)
        step = np.linalg.solve(slopes, -residual)
        largest = float(np.abs(step).max())
        step *= min(1.0, LARGEST_STEP / largest) if largest > 0.0 else 1.0
        step = np.clip(rises + step, lowest, HOTTEST) - rises
        rises, residual, taken = _descend(network, step, rises, residual)
        if taken == 1.0 and largest <= TOLERANCE:
            _check_stability(network, slopes)
            return Equilibrium(rises, iteration, float(np.abs(residual).max()))
    raise _unsolved(residual)


def jacobian(network: Network, rises: FloatArray, residual: FloatArray) -> FloatArray:
    """Compute the derivatives of the residual with respect to the temperatures [W/K], by finite differences."""
    columns = []
    for node in range(network.size):
        moved = rises.copy()
        moved[node] += DIFFERENCE
        columns.append((network.residual(moved) - residual) / DIFFERENCE)
    return np.array(columns).T


def _descend(
    network: Network, step: FloatArray, rises: FloatArray, residual: FloatArray
) -> tuple[FloatArray, FloatArray, float]:
    """Halve the step until the residual falls, unless it is within tolerance; return rises, residual, share taken."""
    size, share = float(np.abs(residual).max()), 1.0
    final = float(np.abs(step).max()) <= TOLERANCE
    for _ in range(MOST_HALVINGS):
        tried = rises + share * step
        reached = _residual_where_defined(network, tried)
        if reached is not None and (final or float(np.abs(reached).max()) < size):
            return tried, reached, share
        share /= 2
    raise _unsolved(residual)


def _residual_where_defined(network: Network, rises: FloatArray) -> FloatArray | None:
    """Return the residual; return None if a bearing cannot carry its load with oil of these temperatures."""
    try:
        return network.residual(rises)
    except NoSolution:
        return None


def _check_stability(network: Network, slopes: FloatArray) -> None:
    """Raise NoSolution (`thermal_runaway`) unless every node becomes warmer when every node gains one more watt."""
    response = np.linalg.solve(-slopes, np.ones(network.size))
    if float(response.min()) <= 0.0:
        node = network.nodes[int(np.argmin(response))]
        message = (
            f"the losses at '{node}' grow faster with temperature than the cooling, so that the temperatures rise "
            "without limit; give more oil or a larger wetting share"
        )
        raise NoSolution("thermal_runaway", message, {"response_k_per_w": float(response.min())})


def _unsolved(residual: FloatArray) -> NoSolution:
    largest = float(np.abs(residual).max())
    message = (
        f"the heat balance does not converge; at one node {largest:.3g} W remain unbalanced. Reduce the losses or "
        "give more oil"
    )
    return NoSolution("heat_balance", message, {"residual_w": largest})
