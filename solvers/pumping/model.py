"""Air and mist pumped by the teeth of a high-speed gear pair (Milian, Distretti, Leoni, Velex, Gear Technology 2004)."""

from math import pi, tan

import numpy as np

from solvers.arrays import frozen
from solvers.notices import Notice
from solvers.pumping.checks import check_speed
from solvers.pumping.flow import ExitMasses, SpaceFlow
from solvers.pumping.inputs import PumpingInputs
from solvers.pumping.lead_correction import LeadCorrection, lead_correction
from solvers.pumping.nozzle import Gas
from solvers.pumping.pulsation import pulsation
from solvers.pumping.results import FaceProfile, GasField, MeshGeometry, PumpingResult, SpacesResult, Totals
from solvers.pumping.spaces import Mesh, Space, face_stretches, flow_at, prepare
from solvers.pumping.tooth_space import normal_backlash, transverse_contact_ratio


def solve(inputs: PumpingInputs) -> PumpingResult:
    """Flow through the tooth spaces of a pair at one speed, and what it costs and heats.

    Raises InvalidInput (codes in `spaces.prepare`; speed_not_positive, too_many_steps) and NoSolution (unphysical_state,
    newton_not_converged).
    """
    mesh = prepare(inputs.setup)
    speed, slices = inputs.pinion_speed, inputs.setup.model.slice_count
    notices = [*mesh.notices, *check_speed(mesh.pair, mesh.gas, speed)]
    frequency = mesh.pair.pinion.teeth * speed / (2 * pi)
    flows = [flow_at(mesh, space, speed, slices) for space in mesh.spaces]
    results = {
        space.of_pinion: _spaces_result(mesh.gas, space, flow, frequency)
        for space, flow in zip(mesh.spaces, flows, strict=True)
    }
    total, spur_notices = _totals(mesh, speed, frequency, list(results.values()))
    correction = _pinion_correction(mesh, results.get(True))
    notices += spur_notices + _missing(list(results.values()), correction)
    return PumpingResult(
        geometry=_geometry(mesh),
        pinion_spaces=results.get(True),
        wheel_spaces=results.get(False),
        total=total,
        lead_correction=correction,
        pulsation=pulsation(
            frequency,
            [
                (flow, speed * space.speed_ratio, 0.0 if space.of_pinion else 0.5)
                for space, flow in zip(mesh.spaces, flows, strict=True)
            ],
        ),
        slices=sum(part.cells for part in face_stretches(inputs.setup, slices)),
        notices=tuple(notices),
    )


def _geometry(mesh: Mesh) -> MeshGeometry:
    pair = mesh.pair
    return MeshGeometry(
        centre_distance=pair.centre_distance,
        backlash_free_centre_distance=pair.backlash_free_centre_distance,
        working_pressure_angle=pair.working_pressure_angle,
        transverse_contact_ratio=transverse_contact_ratio(pair),
        normal_backlash=normal_backlash(pair, mesh.setup.normal_backlash),
        undercut=pair.pinion.undercut or pair.wheel.undercut,
    )


def _spaces_result(gas: Gas, space: Space, flow: SpaceFlow, frequency: float) -> SpacesResult:
    """Ratios to the ambient state, and rates of one stroke per mesh period."""
    rise = None if flow.mean_stagnation_temperature is None else flow.mean_stagnation_temperature - gas.temperature
    static = None if flow.mean_temperature is None else flow.mean_temperature - gas.temperature
    momentary = None if flow.stagnation_temperature is None else flow.stagnation_temperature - gas.temperature
    masses = flow.masses
    return SpacesResult(
        stroke=space.table,
        peak_pressure_ratio=flow.largest_pressure / gas.pressure,
        min_pressure_ratio=flow.smallest_pressure / gas.pressure,
        peak_axial_mach=flow.largest_mach,
        peak_axial_velocity=flow.largest_velocity,
        radial_choked=bool(flow.largest_pressure * gas.critical_ratio > gas.pressure),
        axial_choked=bool(flow.exit_demand > 1.0),
        max_temperature_rise=None if rise is None else float(rise.max()),
        hottest_position=None if rise is None else float(flow.position[int(np.argmax(rise))]),
        pumping_power=frequency * flow.work,
        work_per_space=flow.work,
        mass_flow=ExitMasses(
            front=frequency * masses.front,
            rear=frequency * masses.rear,
            radial=frequency * masses.radial,
            grooves=frequency * masses.grooves,
            reset=frequency * masses.reset,
        ),
        mass_error=flow.mass_error,
        energy_error=flow.energy_error,
        profile=FaceProfile(
            position=flow.position,
            temperature_rise=None if rise is None else frozen(rise),
            static_temperature_rise=None if static is None else frozen(static),
            peak_pressure_ratio=frozen(flow.peak_pressure / gas.pressure),
        ),
        field=GasField(
            angle=flow.angle,
            position=flow.position,
            pressure_ratio=frozen(flow.pressure / gas.pressure),
            axial_mach=flow.mach,
            temperature_rise=None if momentary is None else frozen(momentary),
        ),
        steps=flow.steps,
    )


def _totals(mesh: Mesh, speed: float, frequency: float, results: list[SpacesResult]) -> tuple[Totals, list[Notice]]:
    power = sum(result.pumping_power for result in results)
    helix = abs(mesh.setup.gears.helix_angle)
    if helix == 0.0:
        message = "a spur gear meshes over its whole face at once: the meshing point has no speed along it"
        return Totals(power, frequency, None, None), [Notice("spur_gear", message, "helix_angle")]
    axial = speed * mesh.pair.pinion.reference_radius / tan(helix)
    return Totals(power, frequency, axial, axial / mesh.gas.sound_speed), []


def _pinion_correction(mesh: Mesh, result: SpacesResult | None) -> LeadCorrection | None:
    if result is None or result.profile.temperature_rise is None:
        return None
    return lead_correction(mesh.pair, result.profile.position, result.profile.temperature_rise)


def _missing(results: list[SpacesResult], correction: LeadCorrection | None) -> list[Notice]:
    """Notices of values that the options leave without a meaning."""
    notices = []
    if results[0].max_temperature_rise is None:
        notices.append(Notice("no_temperature", "an incompressible gas has no temperature rise of its own", "flow"))
    elif results[0].energy_error is None:
        message = "the isentropic closure conserves no energy: its temperatures are low by a factor of about two"
        notices.append(Notice("no_energy_balance", message, "closure"))
    if correction is None:
        message = "a lead correction needs the temperatures of the pinion's spaces"
        notices.append(Notice("no_lead_correction", message, "spaces"))
    return notices
