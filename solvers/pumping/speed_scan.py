"""Peak pressure and the Mach numbers of outflow and inflow at the ends over the pinion speed.

The total number of steps is limited for all speeds together. Low speeds need more steps than high speeds. If the steps
do not suffice at a low speed, gas dynamics uses fewer slices.
"""

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.errors import InvalidInput, NoSolution
from solvers.pumping.inputs import Flow, PumpingSetup
from solvers.pumping.results import ChokingCurves
from solvers.pumping.spaces import CELL_STEP_LIMIT, Mesh, flow_at, prepare

# Divisors of the number of slices, tried in turn until the permitted number of steps is enough. The pocket chain has no
# divisors, because the number of pockets is a constant of the model.
_COARSENINGS = {Flow.GAS_DYNAMICS: (1, 2, 4)}


def speed_scan(setup: PumpingSetup, speeds: FloatArray) -> ChokingCurves:
    """Largest pressure ratio and Mach numbers of the spaces at each pinion speed [rad/s]; NaN without a solution."""
    mesh, limit = prepare(setup), CELL_STEP_LIMIT // speeds.size
    pressure, outflow, inflow = np.array([_point(mesh, float(speed), limit) for speed in speeds]).T
    return ChokingCurves(frozen(speeds), frozen(pressure), exit_mach=frozen(outflow), inflow_mach=frozen(inflow))


def _point(mesh: Mesh, speed: float, limit: int) -> tuple[float, float, float]:
    """Compute the peak pressure ratio and the Mach numbers of outflow and inflow at one speed."""
    for coarsening in _COARSENINGS.get(mesh.setup.model.flow, (1,)):
        slices = mesh.setup.model.slice_count // coarsening
        try:
            flows = [flow_at(mesh, space, speed, slices, cell_step_limit=limit) for space in mesh.spaces]
        except InvalidInput:
            continue
        except NoSolution:
            break
        pressure = max(flow.largest_pressure for flow in flows) / mesh.gas.pressure
        return pressure, max(flow.exit_demand for flow in flows), max(flow.inflow_demand for flow in flows)
    return np.nan, np.nan, np.nan
