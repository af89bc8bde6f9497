"""Peak pressure and flow at the ends over the pinion speed, as the choking search sees them at full resolution."""

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.errors import InvalidInput, NoSolution
from solvers.pumping.inputs import PumpingSetup
from solvers.pumping.results import ChokingCurves
from solvers.pumping.spaces import Mesh, flow_at, prepare


def speed_scan(setup: PumpingSetup, speeds: FloatArray) -> ChokingCurves:
    """The largest over the spaces asked for at pinion speeds [rad/s]; NaN at a speed without a solution.

    Raises InvalidInput with the codes of `prepare`.
    """
    mesh = prepare(setup)
    pressure, demand = np.array([_point(mesh, float(speed)) for speed in speeds]).T
    return ChokingCurves(pinion_speed=frozen(speeds), peak_pressure_ratio=frozen(pressure), exit_mach=frozen(demand))


def _point(mesh: Mesh, speed: float) -> tuple[float, float]:
    """Peak pressure ratio, and the Mach number that the ambient pressure asks for at the ends."""
    try:
        flows = [flow_at(mesh, space, speed, mesh.setup.model.slice_count) for space in mesh.spaces]
    except (InvalidInput, NoSolution):
        return np.nan, np.nan
    pressure = max(flow.largest_pressure for flow in flows) / mesh.gas.pressure
    return pressure, max(flow.exit_demand for flow in flows)
