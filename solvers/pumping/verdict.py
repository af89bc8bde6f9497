"""Whether the flow chokes: the slices are doubled until the band of every Mach number lies on one side of 1."""

from collections.abc import Callable, Sequence
from math import inf
from typing import NamedTuple

from solvers.errors import InvalidInput, NoSolution
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.inputs import Flow
from solvers.pumping.resolution import Grids, compressed, uncertainties
from solvers.pumping.results import Choking, ChokingWord
from solvers.pumping.space.stroke import StrokeTable
from solvers.pumping.spaces import Mesh, Space, coarser_flow_at, flow_at


class Band(NamedTuple):
    """A quantity that chokes above 1, and its relative uncertainty."""

    value: float
    uncertainty: float

    @property
    def low(self) -> float:
        return self.value * (1.0 - self.uncertainty)

    @property
    def high(self) -> float:
        return self.value * (1.0 + self.uncertainty)

    @property
    def word(self) -> ChokingWord:
        if self.low <= 1.0 <= self.high:
            return "doubtful"
        return "choked" if self.value > 1.0 else "not choked"


class Bands(NamedTuple):
    """The Mach numbers of outflow and inflow, and the pressure in the spaces over the pressure that chokes the gaps."""

    outflow: Band
    inflow: Band
    clearances: Band

    @property
    def doubtful(self) -> bool:
        return any(band.word == "doubtful" for band in self)


def bands(gas: Gas, table: StrokeTable, grids: Grids) -> Bands:
    """Return the bands of the spaces of one gear."""
    flow, shares, jump = grids.flow, uncertainties(gas, grids), compressed(gas, table.jump[0])
    ratio, gauge = flow.largest_pressure / gas.pressure, max(shares["peak_pressure"], jump)
    return Bands(
        Band(flow.exit_demand, max(shares["outflow_mach"], jump)),
        Band(flow.inflow_demand, max(shares["inflow_mach"], jump)),
        Band(ratio * gas.critical_ratio, gauge * (ratio - 1.0) / ratio),
    )


Refined = Callable[[int, int], Bands]
"""A function of the index of a gear and a number of slices that returns the bands of the spaces of the gear."""


def decide(start: Sequence[Bands], slices: int, most: int, refined: Refined | None = None) -> Choking:
    """Double the slices of every gear with a doubtful band up to `most`; without `refined` they stay."""
    found, used = list(start), slices
    for index, of_gear in enumerate(start):
        latest, number = of_gear, slices
        while refined is not None and latest.doubtful and number < most:
            number = min(2 * number, most)
            try:
                latest = refined(index, number)
            except (InvalidInput, NoSolution):  # the speed allows no more slices
                break
            found[index], used = latest, max(used, number)
    outflow, inflow, clearances = (_worst(each) for each in zip(*found, strict=True))
    return Choking(
        outflow=outflow.word,
        inflow=inflow.word,
        clearances=clearances.word,
        outflow_mach=outflow.value,
        outflow_uncertainty=outflow.uncertainty,
        inflow_mach=inflow.value,
        inflow_uncertainty=inflow.uncertainty,
        slices=used,
    )


def _worst(gears: Sequence[Band]) -> Band:
    """Return the band that decides: of a choked gear if there is one, else of a doubtful one, else the highest."""
    order: dict[ChokingWord, int] = {"choked": 2, "doubtful": 1, "not choked": 0}
    return max(gears, key=lambda band: (order[band.word], band.value))


def on_grids(mesh: Mesh, space: Space, speed: float, slices: int) -> Grids:
    """One stroke on three grids: full, half and quarter resolution."""
    flow = flow_at(mesh, space, speed, slices)  # this call comes first, because it refuses a march that is too long
    half, quarter = (coarser_flow_at(mesh, space, speed, slices, times) for times in (2, 4))
    return Grids(flow, half, quarter, _lead(mesh, space, speed))


def _lead(mesh: Mesh, space: Space, speed: float) -> float:
    """`Grids.lead` = |c - v|/v; infinite for flow models without waves."""
    if mesh.setup.model.flow is not Flow.GAS_DYNAMICS:
        return inf
    return abs(mesh.gas.sound_speed * space.lag / (speed * space.speed_ratio) - 1.0)
