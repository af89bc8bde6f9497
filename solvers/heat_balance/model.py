"""Heat balance: build the network from the inputs, calibrate the network, find the equilibrium, compute the band."""

from collections.abc import Iterator
from dataclasses import replace
from math import pi

import numpy as np

from solvers.arrays import FloatArray
from solvers.errors import NoSolution
from solvers.heat_balance.band import flank_band, flank_cases
from solvers.heat_balance.bearings import Journal
from solvers.heat_balance.calibration import drain_rise, oil_flows, with_drain, with_rotor
from solvers.heat_balance.fling_off import turning_teeth
from solvers.heat_balance.inputs import Cooling
from solvers.heat_balance.losses import MeshHeat, flow_by_rise, ts_6336_22_bulk_rise, windage
from solvers.heat_balance.network import BODIES, FLANKS, MIST, CasingWalls, CooledGear, Flow, Network, Spray
from solvers.heat_balance.notices import heat_notices, measured_notices, unusual_flow, unusual_measurements
from solvers.heat_balance.oil import CoolingOil
from solvers.heat_balance.results import (
    Balance,
    BearingHeat,
    BulkEstimates,
    CoolingInForce,
    GearTemperatures,
    Heat,
    HeatBand,
    HeatFlow,
    HeatLosses,
)
from solvers.heat_balance.solution import Equilibrium, equilibrium
from solvers.notices import Notice
from solvers.quantity import described, record

SPRAY_FACTOR = 1.2  # X_S of ISO/TS 6336-22


@record
class GearGeometry:
    """One gear of the pair."""

    teeth: int = described("Number of teeth.")
    face_width: float = described("Face width, of all helices [m].")
    module: float = described("Normal module [m].")
    reference_radius: float = described("Reference radius [m].")
    tip_radius: float = described("Tip radius [m].")
    speed: float = described("Speed, positive [rad/s].")
    conductivity: float = described("Thermal conductivity [W/(m K)].", default=46.0)
    shaft_radii: tuple[float, float] = described(
        "Radii of the shaft at both faces of the gear, 0 without a shaft there [m].", default=(0.0, 0.0)
    )
    gap_width: float = described("Width of the rim between two helices [m].", default=0.0)

    @property
    def face_area(self) -> float:
        """Area of both faces of the gear without the cross-sections of the shaft [m^2]."""
        return pi * sum(max(self.tip_radius**2 - radius**2, 0.0) for radius in self.shaft_radii)


@record
class HeatBalanceInputs:
    """Inputs of the heat balance of a gear pair or gear unit."""

    cooling: Cooling
    oil: CoolingOil
    gears: tuple[GearGeometry, GearGeometry] = described("Geometry and speed of pinion and wheel.")
    mesh: MeshHeat
    pumping: tuple[float, float] | None = described(
        "Pumping losses of pinion and wheel; None: half of `cooling.pumping` per gear [W].", default=None
    )
    journals: tuple[Journal, ...] = described("Plain bearings.", default=())
    couplings: float = described("Losses of the couplings, which are reported only [W].", default=0.0)
    centre_distance: float | None = described("Centre distance, for the estimate by ISO/TS 6336-22 [m].", default=None)
    iso_tr_13989_bulk: float | None = described(
        "Bulk temperature by ISO/TR 13989, which is reported beside the estimate [K].", default=None
    )


def solve(inputs: HeatBalanceInputs) -> Heat:
    """Solve the heat balance of a gear pair or gear unit.

    Parameters
    ----------
    inputs : HeatBalanceInputs
        Geometry, losses, oil and what the user states about the cooling.

    Returns
    -------
    Heat
        Temperatures of all nodes, heat flows, losses, and the uncertainty band of the flank temperatures.

    Raises
    ------
    InvalidInput
        `exclusive` if a measured temperature excludes another input or another measured temperature of the same gear;
        `measured_unreachable` if the model cannot reach a measured temperature.
    NoSolution
        `heat_balance` if the iteration does not converge; `thermal_runaway` if the equilibrium is not stable; the error
        of the bearing model if a bearing cannot carry its load.

    Examples
    --------
    >>> from solvers import heat_balance, oils
    >>> oil, mesh = heat_balance.cooling_oil(oils.iso_vg(46), 328.15), heat_balance.MeshHeat(37e3, 368.15, 0.49)
    >>> gear = heat_balance.GearGeometry(39, 0.2, 6e-3, 0.119, 0.125, 1047.0)
    >>> inputs = heat_balance.HeatBalanceInputs(heat_balance.Cooling(), oil, (gear, gear), mesh)
    >>> round(heat_balance.solve(inputs).pinion.flank - 273.15)
    94
    """
    cooling = inputs.cooling
    cooling.check()
    network = calibrated(network_of(inputs), cooling)
    state = equilibrium(network)
    cases, unsolved = _cases(network, cooling, state)
    bands = flank_band(cases, cooling) if len(cases) > 1 else None
    flows = network.flows(state.rises)
    measured, drain = cooling.measured, network.oil.inlet + drain_rise(network, state.rises)
    deviation = _deviation(network, cooling, state.rises)
    return Heat(
        pinion=_gear(network, 0, state.rises, flows),
        wheel=_gear(network, 1, state.rises, flows),
        mist=network.oil.inlet + float(state.rises[MIST]),
        drain=drain,
        casing=network.oil.inlet + float(state.rises[-1]) if network.casing else None,
        gear_flow=network.spray.flow,
        total_flow=network.spray.flow + float(oil_flows(network, state.rises).sum()),
        wetting_share=network.spray.wetting_share,
        friction_to_pinion=network.mesh.share_to_pinion,
        bearings=tuple(_bearings(network, state.rises)),
        flows=tuple(_flows(network, flows)),
        losses=_losses(network, flows, inputs.couplings),
        balance=_balance(network, flows),
        estimates=_estimates(inputs),
        band=HeatBand(*bands) if bands else None,
        wheel_deviation=deviation,
        drain_deviation=None if measured.drain is None else drain - measured.drain,
        flank_cases=cases,
        warnings=(
            *heat_notices(network, state.rises, cooling),
            *measured_notices(network, cooling, drain, deviation),
            *unsolved,
        ),
    )


def network_of(inputs: HeatBalanceInputs) -> Network:
    """Build the network of the nominal case, before any calibration.

    Parameters
    ----------
    inputs : HeatBalanceInputs
        Geometry, losses, oil and what the user states about the cooling.

    Returns
    -------
    Network
        The network of nodes and heat flows.

    Examples
    --------
    >>> from solvers import heat_balance, oils
    >>> oil, mesh = heat_balance.cooling_oil(oils.iso_vg(46), 328.15), heat_balance.MeshHeat(37e3, 368.15, 0.49)
    >>> gear = heat_balance.GearGeometry(39, 0.2, 6e-3, 0.119, 0.125, 1047.0)
    >>> inputs = heat_balance.HeatBalanceInputs(heat_balance.Cooling(), oil, (gear, gear), mesh)
    >>> heat_balance.network_of(inputs).nodes
    ('pinion_flank', 'pinion_body', 'wheel_flank', 'wheel_body', 'mist')
    """
    cooling, oil = inputs.cooling, inputs.oil
    pumping = (cooling.pumping / 2, cooling.pumping / 2) if inputs.pumping is None else inputs.pumping
    velocity = inputs.gears[0].speed * inputs.gears[0].reference_radius
    by_mauz = sum(
        windage(velocity, 2 * one.reference_radius, one.face_width, one.module, one.speed) for one in inputs.gears
    )
    drag = by_mauz if cooling.windage is None else cooling.windage
    flow = cooling.gear_flow
    if flow is None:  # by formulas alone: heat that the user adds must not order more oil, and so cool the teeth
        flow = flow_by_rise(oil, inputs.mesh.sizing + by_mauz, cooling.flow_rise)
    shares = (cooling.flow_to_pinion, cooling.wetting, cooling.rewetting, cooling.factor)
    walls = cooling.casing
    return Network(
        oil=oil,
        gears=(_cooled(inputs.gears[0], pumping[0]), _cooled(inputs.gears[1], pumping[1])),
        mesh=inputs.mesh,
        spray=Spray(flow, velocity, cooling.jet_velocity(), *shares),
        windage=drag,
        other=cooling.other or 0.0,
        pumping_to_teeth=cooling.pumping_to_teeth,
        mist_convection_factor=cooling.mist_convection_factor,
        journals=inputs.journals,
        bearing_film_share=cooling.bearing_film_share,
        casing=CasingWalls(walls.area, walls.inside, walls.outside, walls.ambient) if walls.area else None,
    )


def calibrated(network: Network, cooling: Cooling) -> Network:
    """Fit the network to the measured temperatures of one gear and of the drain.

    Parameters
    ----------
    network : Network
        The network of the nominal case.
    cooling : Cooling
        What the user states about the cooling; of two measured gears only the pinion counts.

    Returns
    -------
    Network
        The network with the wetting share that fits the gear, and with the other losses that fit the drain.

    Examples
    --------
    >>> from solvers import heat_balance, oils
    >>> oil, mesh = heat_balance.cooling_oil(oils.iso_vg(46), 328.15), heat_balance.MeshHeat(37e3, 368.15, 0.49)
    >>> gear = heat_balance.GearGeometry(39, 0.2, 6e-3, 0.119, 0.125, 1047.0)
    >>> inputs = heat_balance.HeatBalanceInputs(heat_balance.Cooling(), oil, (gear, gear), mesh)
    >>> hot = heat_balance.Cooling(measured=heat_balance.Measured(pinion_flank=390.0))
    >>> round(heat_balance.calibrated(heat_balance.network_of(inputs), hot).spray.wetting_share, 2)
    0.23
    """
    measured = cooling.measured
    if measured.rotors:
        node, temperature = next(iter(measured.rotors.items()))
        return with_rotor(network, node, temperature, measured.drain)
    return network if measured.drain is None else with_drain(network, measured.drain)


def _cooled(gear: GearGeometry, pumping: float) -> CooledGear:
    return CooledGear(
        teeth=gear.teeth,
        face_width=gear.face_width,
        module=gear.module,
        tip_radius=gear.tip_radius,
        flanks=turning_teeth(gear.teeth, gear.face_width, gear.module, gear.reference_radius, gear.speed),
        face_area=gear.face_area,
        conductivity=gear.conductivity,
        pumping=pumping,
        gap_width=gear.gap_width,
    )


def _cases(
    network: Network, cooling: Cooling, state: Equilibrium
) -> tuple[tuple[tuple[float, float], ...], tuple[Notice, ...]]:
    """Flank temperatures of both gears, nominal and at the corners of the band; else a notice why there is none."""
    inlet = network.oil.inlet
    nominal = ((inlet + float(state.rises[FLANKS[0]]), inlet + float(state.rises[FLANKS[1]])),)
    if not cooling.band:
        return nominal, ()
    try:
        cases = flank_cases(network, cooling, state.rises)
    except NoSolution as failure:
        message = (
            f"no band of temperatures is stated. A corner of the uncertain cooling has no solution: {failure.message}"
        )
        return nominal, (Notice("band_unsolved", message, "cooling.wetting_share"),)
    if len(cases) > 1:
        return cases, ()
    message = (
        "no band of temperatures is stated, because wetting share, fling-off factor, rewetting share and windage are "
        "all given"
    )
    return nominal, (Notice("no_band", message, "cooling.band", rank="note"),)


def _gear(network: Network, gear: int, rises: FloatArray, flows: list[Flow]) -> GearTemperatures:
    cooling, flank = network.cooling(gear, rises), FLANKS[gear]
    friction = [flow.power for flow in flows if flow.target == flank and flow.carrier == "friction of the mesh"]
    return GearTemperatures(
        flank=network.oil.inlet + float(rises[flank]),
        body=network.oil.inlet + float(rises[BODIES[gear]]),
        friction=sum(friction),
        oil_conductance=cooling.conductance,
        flooded_conductance=cooling.flooded,
        film=cooling.film,
        turn_film=cooling.turn_film,
        oil_limited=cooling.limited,
    )


def _bearings(network: Network, rises: FloatArray) -> Iterator[BearingHeat]:
    for number in range(len(network.journals)):
        rise = float(rises[MIST + 1 + number])
        power, flow = network.operation(number, rise)
        yield BearingHeat(network.oil.inlet + rise, network.film_temperature(number, rise), flow, power)


def _flows(network: Network, flows: list[Flow]) -> Iterator[HeatFlow]:
    """Yield the heat flows that are not zero."""
    for flow in flows:
        if flow.power != 0.0:
            yield HeatFlow(network.places[flow.origin], network.places[flow.target], flow.carrier, flow.power)


def _losses(network: Network, flows: list[Flow], couplings: float) -> HeatLosses:
    powers: dict[str, float] = {}
    for flow in flows:
        powers[flow.carrier] = powers.get(flow.carrier, 0.0) + flow.power
    parts = {
        "mesh": powers["friction of the mesh"],
        "pumping": powers["pumped gas"],
        "oil_acceleration": powers["oil brought to speed"],
        "windage": network.windage,
        "bearings": powers.get("friction of the bearing", 0.0),
        "couplings": couplings,
        "other": network.other,
        "jets": powers["oil jets"],
    }
    return HeatLosses(**parts, total=sum(parts.values()))


def _balance(network: Network, flows: list[Flow]) -> Balance:
    oil, ambient, source = network.gains(flows)[network.size :]
    supplied, removed = -float(source), float(oil + ambient)
    return Balance(supplied, removed, (supplied - removed) / supplied if supplied else 0.0)


def _estimates(inputs: HeatBalanceInputs) -> BulkEstimates:
    bulk = None
    if inputs.centre_distance is not None:
        width = inputs.gears[0].face_width
        bulk = inputs.oil.inlet + ts_6336_22_bulk_rise(inputs.mesh.power, inputs.centre_distance, width, SPRAY_FACTOR)
    return BulkEstimates(inputs.iso_tr_13989_bulk, bulk)


def _deviation(network: Network, cooling: Cooling, rises: FloatArray) -> float | None:
    """Calculated minus measured temperature of the wheel [K]; None unless both gears were measured."""
    rotors = list(cooling.measured.rotors.items())
    if len(rotors) < 2:
        return None
    node, temperature = rotors[1]
    return network.oil.inlet + float(rises[network.nodes.index(node)]) - temperature


def backlash_loss(
    heat: Heat, working_radii: tuple[float, float], working_pressure_angle: float, expansion: float
) -> Heat:
    """Compute the backlash that is lost because the gears are warmer than the casing, and add it to the result.

    Parameters
    ----------
    heat : Heat
        Result of `solve`.
    working_radii : tuple of float
        Working pitch radii of pinion and wheel [m].
    working_pressure_angle : float
        Working transverse pressure angle [rad].
    expansion : float
        Thermal expansion of the gears and of the casing [1/K].

    Returns
    -------
    Heat
        The result with `backlash_loss` [m], which is None if no casing is given.

    Notes
    -----
    Eq. H22: 2 tan(alpha_wt) alpha_L sum r_wi (B_i - C), with the expansion alpha_L, the working pitch radius r_wi of
    gear i, and the temperatures B_i of its body and C of the casing.

    Examples
    --------
    >>> from solvers import heat_balance, oils
    >>> oil, mesh = heat_balance.cooling_oil(oils.iso_vg(46), 328.15), heat_balance.MeshHeat(37e3, 368.15, 0.49)
    >>> gear = heat_balance.GearGeometry(39, 0.2, 6e-3, 0.119, 0.125, 1047.0)
    >>> cooling = heat_balance.Cooling(casing=heat_balance.Casing(area=6.0))
    >>> heat = heat_balance.solve(heat_balance.HeatBalanceInputs(cooling, oil, (gear, gear), mesh))
    >>> round(heat_balance.backlash_loss(heat, (0.119, 0.119), 0.35, 1.2e-5).backlash_loss * 1e6)
    43
    """
    if heat.casing is None:
        return heat
    rises = np.array([heat.pinion.body, heat.wheel.body]) - heat.casing
    loss = 2 * np.tan(working_pressure_angle) * expansion * np.dot(working_radii, rises)
    return replace(heat, backlash_loss=float(loss))


def cooling_in_force(cooling: Cooling, heat: Heat) -> CoolingInForce:
    """Return the values that the calculation used for the optional inputs of the cooling.

    Parameters
    ----------
    cooling : Cooling
        Inputs of the cooling.
    heat : Heat
        Result of `solve`.

    Returns
    -------
    CoolingInForce
        Flow, shares and losses in use.

    Examples
    --------
    >>> from solvers import heat_balance, oils
    >>> oil, mesh = heat_balance.cooling_oil(oils.iso_vg(46), 328.15), heat_balance.MeshHeat(37e3, 368.15, 0.49)
    >>> gear = heat_balance.GearGeometry(39, 0.2, 6e-3, 0.119, 0.125, 1047.0)
    >>> inputs = heat_balance.HeatBalanceInputs(heat_balance.Cooling(), oil, (gear, gear), mesh)
    >>> heat_balance.cooling_in_force(inputs.cooling, heat_balance.solve(inputs)).wetting_share
    0.5
    """
    return CoolingInForce(
        gear_flow=heat.gear_flow,
        wetting_share=heat.wetting_share,
        rewetting_share=cooling.rewetting,
        fling_off_factor=cooling.factor,
        windage=heat.losses.windage,
        other=heat.losses.other,
    )


def unusual_values(inputs: HeatBalanceInputs, heat: Heat) -> Iterator[Notice]:
    """Return warnings about unusual inputs."""
    yield from unusual_flow(inputs.cooling.gear_flow, heat, inputs.oil)
    yield from unusual_measurements(inputs.cooling)
