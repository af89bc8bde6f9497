"""Incompressible flow out of a single spur tooth space (Rosen's theory), for checks at low speed.

Even at low speed the results of this model differ from the results of gas dynamics. In gas dynamics the pressure varies
along the face; in this model it does not.
"""

import numpy as np

from solvers.arrays import frozen
from solvers.errors import InvalidInput
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.flow.space_flow import EndDemand, EndFlow, ExitMasses, SpaceFlow
from solvers.pumping.inputs import rpm
from solvers.pumping.space.stroke import StrokeTable


def incompressible(
    gas: Gas, table: StrokeTable, face_width: float, pinion_speed: float, speed_ratio: float, discharge: float
) -> SpaceFlow:
    """Incompressible flow out of a single spur tooth space over one stroke (Eq. P14).

    U = -(dV/dt)/[C_d (2 S + L b)] in every opening, p - p_e = rho U |U|/2. Values are at the middle of the intervals of
    the table; no temperatures, because the model does not say where work becomes heat. Raises InvalidInput:
    incompressible_vacuum.
    """
    time = (table.angle - table.angle[0]) / (pinion_speed * speed_ratio)
    step = np.diff(time)
    area = 0.5 * (table.area[1:] + table.area[:-1])
    clearance = table.clearance_left + table.clearance_right
    gap = 0.5 * (clearance[1:] + clearance[:-1]) * face_width
    displaced = -np.diff(table.area) * face_width
    velocity = displaced / step / (discharge * (2 * area + gap))
    gauge = 0.5 * gas.density * velocity * np.abs(velocity)
    pressure = gas.pressure + gauge
    if pressure.min() <= 0.0:
        slower = rpm(pinion_speed) * float(np.sqrt(-gas.pressure / gauge.min()))
        message = (
            "the suction of a growing tooth space would exceed the ambient pressure, which is impossible; stay below "
            f"{slower:.6g} rpm of the pinion, or use gas dynamics"
        )
        raise InvalidInput("incompressible_vacuum", message, "pinion_speed")
    out = gas.density * velocity * discharge * step
    front, radial = out * area, out * gap
    outwards, inwards = (float(max(0.0, largest)) / gas.sound_speed for largest in (velocity.max(), -velocity.min()))
    return SpaceFlow(
        angle=frozen(0.5 * (table.angle[1:] + table.angle[:-1])),
        position=frozen([0.5 * face_width]),
        pressure=frozen(pressure[:, None]),
        mach=frozen(np.abs(velocity)[:, None] / gas.sound_speed),
        stagnation_temperature=None,
        mean_temperature=None,
        mean_stagnation_temperature=None,
        peak_pressure=frozen([max(pressure.max(), gas.pressure)]),
        lowest_pressure=frozen([min(pressure.min(), gas.pressure)]),
        peak_mach=frozen([np.abs(velocity).max() / gas.sound_speed]),
        largest_pressure=float(max(pressure.max(), gas.pressure)),
        smallest_pressure=float(min(pressure.min(), gas.pressure)),
        largest_mach=float(np.abs(velocity).max() / gas.sound_speed),
        largest_velocity=float(np.abs(velocity).max()),
        demand=EndDemand(outwards, outwards, inwards, inwards),
        exit_demand=outwards,
        inflow_demand=inwards,
        work=float((gauge * displaced).sum()),
        masses=ExitMasses(
            front=float(front.sum()),
            rear=float(front.sum()),
            radial=float(radial.sum()),
            grooves=0.0,
            reset=float(gas.density * face_width * (table.area[-1] - table.area[0])),
        ),
        mass_error=float(
            abs(out @ (2 * area + gap) - gas.density * displaced.sum()) / (gas.density * face_width * table.area[0])
        ),
        energy_error=None,
        ends=EndFlow(frozen(0.5 * (time[1:] + time[:-1])), frozen(front), frozen(front)),
        steps=step.size,
    )
