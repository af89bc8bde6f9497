"""Air and mist pumped by the teeth of high-speed gears (Milian, Distretti, Leoni, Velex, Gear Technology 2004)."""

from math import pi, tan

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.gears.diameters import diameters_of
from solvers.notices import Notice
from solvers.pumping.checks import check_speed
from solvers.pumping.flow.nozzle import Gas
from solvers.pumping.flow.space_flow import SpaceFlow
from solvers.pumping.inputs import PumpingInputs
from solvers.pumping.lead_correction import LeadCorrection, lead_correction
from solvers.pumping.notices import flow_notices, net_flow_notices, resolution_notices, speed_notices
from solvers.pumping.pulsation import Pulsation, pulsation
from solvers.pumping.resolution import Grids, behind_jumps, compressed, net_uncertainty, radial_uncertainty, resolution
from solvers.pumping.results import (
    Balance,
    EndOfFace,
    FaceProfile,
    GasField,
    MassFlow,
    MeshGeometry,
    PumpingResult,
    SpacesResult,
    Stroke,
    Totals,
)
from solvers.pumping.space.stroke import StrokeTable
from solvers.pumping.space.tooth_space import normal_backlash
from solvers.pumping.spaces import (
    Mesh,
    Space,
    derived,
    face_stretches,
    finest_slices,
    prepare,
)
from solvers.pumping.verdict import Bands, bands, decide, on_grids

LEAST_HELIX = 1e-100  # rad; at a smaller angle the speed of the meshing point along the face overflows


def solve(inputs: PumpingInputs) -> PumpingResult:
    """Compute pressures, mass flow, power and temperatures of the gas in the tooth spaces at one speed.

    Parameters
    ----------
    inputs : PumpingInputs
        Gears, grooves, ambient gas and model, and the speed of the pinion [rad/s].

    Returns
    -------
    PumpingResult
        Results at the operating point in SI units: results of the spaces of the selected gears, totals, uncertainties
        and warnings.

    Raises
    ------
    InvalidInput
        The codes of `spaces.prepare` and of `spaces.flow_at`; also `speed_not_positive` if the speed is not positive.
    NoSolution
        unphysical_state if the gas dynamics fails, newton_not_converged if the pocket chain fails.

    Notes
    -----
    Eq. P9.

    Examples
    --------
    >>> from solvers import pumping
    >>> from solvers.gears.inputs import GearPairInputs, GearTeeth
    >>> gears = GearPairInputs(GearTeeth(39), GearTeeth(130), 6e-3, 0.2, rack_tip_radius=0.25)
    >>> slow = pumping.PumpingModel(flow=pumping.Flow.INCOMPRESSIBLE)
    >>> result = pumping.solve(pumping.PumpingInputs(pumping.PumpingSetup(gears, 0.3e-3, model=slow), 100.0))
    >>> round(result.total.pumping_power, 1)
    9.9
    """
    return _solve(inputs, refine=True)


def solve_on_slices(inputs: PumpingInputs) -> PumpingResult:
    """Solve without the finer grids of a doubtful verdict on choking, for callers that do not read the verdict."""
    return _solve(inputs, refine=False)


def _solve(inputs: PumpingInputs, *, refine: bool) -> PumpingResult:
    mesh = prepare(inputs.setup)
    speed, slices = inputs.pinion_speed, inputs.setup.model.slice_count
    check_speed(speed)
    frequency = mesh.pair.pinion.teeth * speed / (2 * pi)

    spaces = [on_grids(mesh, space, speed, slices) for space in mesh.spaces]
    flows = [grids.flow for grids in spaces]
    results = [
        _spaces_result(mesh.gas, space, grids, frequency) for space, grids in zip(mesh.spaces, spaces, strict=True)
    ]
    of_gear = {space.of_pinion: result for space, result in zip(mesh.spaces, results, strict=True)}
    correction = _pinion_correction(mesh, of_gear.get(True))
    resolved = resolution(mesh.gas, spaces)
    finest = finest_slices(mesh, speed, slices)
    found = [bands(mesh.gas, space.table, grids) for space, grids in zip(mesh.spaces, spaces, strict=True)]

    def refined(gear: int, number: int) -> Bands:
        space = mesh.spaces[gear]
        return bands(mesh.gas, space.table, on_grids(mesh, space, speed, number))

    total = _totals(mesh, speed, frequency, sum(result.pumping_power for result in results) * mesh.setup.gears.helices)
    return PumpingResult(
        geometry=_geometry(mesh),
        pinion_spaces=of_gear.get(True),
        wheel_spaces=of_gear.get(False),
        total=total,
        lead_correction=correction,
        pulsation=_pulsation(mesh, flows, speed, frequency),
        resolution=behind_jumps(resolved, mesh.gas, flows, [space.table.jump[0] for space in mesh.spaces]),
        choking=decide(found, slices, finest, refined if refine else None),
        slices=sum(part.cells for part in face_stretches(inputs.setup, slices)),
        derived=derived(mesh),
        warnings=(
            *mesh.notices,
            *speed_notices(mesh.pair, mesh.gas, speed),
            *_flow_notices(inputs, results),
            *resolution_notices(inputs.setup.model.flow, resolved, slices, finest),
            *net_flow_notices(inputs.setup.model.flow, [result.mass_flow for result in results], slices, finest),
            *_missing(results[0], total, correction),
        ),
    )


def _flow_notices(inputs: PumpingInputs, results: list[SpacesResult]) -> list[Notice]:
    """Return the warnings about flows that the flow model does not resolve."""
    mach = max(result.peak_axial_mach for result in results)
    span = max(result.peak_pressure_ratio - result.min_pressure_ratio for result in results)
    return flow_notices(inputs.setup.model.flow, mach, span)


def _geometry(mesh: Mesh) -> MeshGeometry:
    pair = mesh.pair
    return MeshGeometry(
        centre_distance=pair.centre_distance,
        backlash_free_centre_distance=pair.backlash_free_centre_distance,
        working_pressure_angle=pair.working_pressure_angle,
        transverse_contact_ratio=mesh.path.transverse_contact_ratio,
        normal_backlash=normal_backlash(pair, mesh.setup.normal_backlash),
        undercut=pair.pinion.undercut or pair.wheel.undercut,
        **diameters_of(pair),
    )


def _spaces_result(gas: Gas, space: Space, grids: Grids, frequency: float) -> SpacesResult:
    """Convert one stroke to results: mass flow, power, and values relative to the ambient state."""
    flow = grids.flow
    profile = FaceProfile(
        position=flow.position,
        temperature_rise=_rise(gas, flow.mean_stagnation_temperature),
        static_temperature_rise=_rise(gas, flow.mean_temperature),
        peak_pressure_ratio=frozen(flow.peak_pressure / gas.pressure),
    )
    hottest, largest_rise = _hottest(flow.position, profile.temperature_rise)
    return SpacesResult(
        stroke=_stroke(space.table),
        peak_pressure_ratio=flow.largest_pressure / gas.pressure,
        min_pressure_ratio=flow.smallest_pressure / gas.pressure,
        peak_axial_mach=flow.largest_mach,
        peak_axial_velocity=flow.largest_velocity,
        radial_choked=flow.largest_pressure * gas.critical_ratio > gas.pressure,
        axial_choked=flow.exit_demand > 1.0,
        inflow_choked=flow.inflow_demand > 1.0,
        front_end=EndOfFace(flow.demand.front_out, flow.demand.front_in, flow.demand.front_in > 1.0),
        rear_end=EndOfFace(flow.demand.rear_out, flow.demand.rear_in, flow.demand.rear_in > 1.0),
        max_temperature_rise=largest_rise,
        hottest_position=hottest,
        pumping_power=frequency * flow.work,
        work_per_space=flow.work,
        mass_flow=_mass_flow(grids, frequency, compressed(gas, space.table.jump[0])),
        balance=Balance(flow.mass_error, flow.energy_error),
        profile=profile,
        field=GasField(
            angle=flow.angle,
            position=flow.position,
            pressure_ratio=frozen(flow.pressure / gas.pressure),
            axial_mach=flow.mach,
            temperature_rise=_rise(gas, flow.stagnation_temperature),
        ),
        steps=flow.steps,
    )


def _rise(gas: Gas, temperature: FloatArray | None) -> FloatArray | None:
    return None if temperature is None else frozen(temperature - gas.temperature)


def _hottest(position: FloatArray, rise: FloatArray | None) -> tuple[float | None, float | None]:
    """Find the largest temperature rise [K] over the face, and its position [m].

    The largest rise is the top of a parabola through the hottest slice and both neighbours of this slice.
    """
    if rise is None:
        return None, None
    top = int(np.argmax(rise))
    if not 0 < top < rise.size - 1:
        return float(position[top]), float(rise[top])
    before, here, after = (float(value) for value in rise[top - 1 : top + 2])
    ahead, bend = 0.5 * (after - before), before - 2.0 * here + after
    back, apart = (float(step) for step in np.diff(position[top - 1 : top + 2]))
    if bend == 0.0 or abs(apart - back) > 1e-6 * apart:  # slices next to a groove are not evenly spaced
        return float(position[top]), here
    return float(position[top]) - apart * ahead / bend, here - 0.5 * ahead**2 / bend


def _mass_flow(grids: Grids, frequency: float, jumped: float) -> MassFlow:
    """Compute the mass flow of successive strokes, and its uncertainty.

    The uncertainty has two causes: the limited resolution, and sudden changes of the area through which the gas flows.
    """
    masses, ends = grids.flow.masses, grids.flow.ends
    return MassFlow(
        front=frequency * masses.front,
        rear=frequency * masses.rear,
        radial=frequency * masses.radial,
        grooves=frequency * masses.grooves,
        reset=frequency * masses.reset,
        front_out=frequency * float(np.maximum(ends.front, 0.0).sum()),
        front_in=frequency * float(np.maximum(-ends.front, 0.0).sum()),
        rear_out=frequency * float(np.maximum(ends.rear, 0.0).sum()),
        rear_in=frequency * float(np.maximum(-ends.rear, 0.0).sum()),
        net_uncertainty=frequency * net_uncertainty(grids, jumped),
        radial_uncertainty=frequency * radial_uncertainty(grids, jumped),
    )


def _stroke(table: StrokeTable) -> Stroke:
    limits = table.limits
    return Stroke(
        start=limits.start,
        contact_start=limits.contact_start,
        contact_end=limits.contact_end,
        end=limits.end,
        max_area=float(table.area.max()),
        min_area=float(table.area.min()),
        curves=table,
    )


def _totals(mesh: Mesh, speed: float, frequency: float, power: float) -> Totals:
    helix = abs(mesh.setup.gears.helix_angle)
    if helix < LEAST_HELIX:
        return Totals(power, frequency, None, None)
    axial = speed * mesh.pair.pinion.reference_radius / tan(helix)
    return Totals(power, frequency, axial, axial / mesh.gas.sound_speed)


def _pinion_correction(mesh: Mesh, result: SpacesResult | None) -> LeadCorrection | None:
    if result is None or result.profile.temperature_rise is None:
        return None
    return lead_correction(mesh.pair, result.profile.position, result.profile.temperature_rise)


def _pulsation(mesh: Mesh, flows: list[SpaceFlow], speed: float, frequency: float) -> Pulsation:
    """Superpose the flows out of the tooth spaces of both gears.

    The wheel's spaces reach the line of centres half a mesh period after the pinion's spaces.
    """
    delays = [0.0 if space.of_pinion else 0.5 for space in mesh.spaces]
    speeds = [speed * space.speed_ratio for space in mesh.spaces]
    return pulsation(frequency, list(zip(flows, speeds, delays, strict=True)))


def _missing(result: SpacesResult, total: Totals, correction: LeadCorrection | None) -> list[Notice]:
    """Return notices that explain which results are missing or uncertain with these gears and options."""
    notices = []
    if total.axial_meshing_speed is None:
        message = "a spur gear meshes over its whole face at once; there is no meshing point that moves along the face"
        notices.append(Notice("spur_gear", message, "helix_angle", rank="note"))
    if result.max_temperature_rise is None:
        notices.append(
            Notice("no_temperature", "the incompressible model gives no temperature rise", "flow", rank="note")
        )
    elif result.balance.energy_error is None:
        message = (
            "the isentropic closure does not conserve energy; its temperature rises are about half as large as with "
            "the energy closure"
        )
        notices.append(Notice("no_energy_balance", message, "closure"))
    if correction is None:
        message = (
            "the lead correction is computed from the temperatures in the tooth spaces of the pinion; these "
            "temperatures were not computed"
        )
        notices.append(Notice("no_lead_correction", message, "spaces", rank="note"))
    return notices
