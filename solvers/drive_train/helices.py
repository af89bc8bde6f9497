"""Results of one face of a unit, and what the two helices of a double-helical unit have in common."""

from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.drive_train.gap.balance import Equilibrium
from solvers.drive_train.gap.face_curves import face_mean
from solvers.drive_train.gap.misalignment import misalignment
from solvers.drive_train.gap.thermal_lead import ThermalLead
from solvers.drive_train.inputs import NAMES_OF_SHAFTS, DriveTrainInputs
from solvers.drive_train.prepared import Prepared, of_faces
from solvers.drive_train.results import AxialBalance, CouplingResult, FaceLoad, HelixResult
from solvers.drive_train.safety import FaceBulk, FlankHeat, contact_of, flank_heat
from solvers.drive_train.shafts.coupling_loads import runout_thrust
from solvers.scuffing.mesh_results import period_mean
from solvers.scuffing.micropitting.wear import wear_asked_for
from solvers.scuffing.model import distribution
from solvers.scuffing.modification import misalignment_slope
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety_results import BulkInForce
from solvers.scuffing.thermal.bulk import BulkRule, Flanks
from solvers.scuffing.thermal.temperatures import in_force


@dataclass(frozen=True, slots=True)
class LoadedFace:
    """A face in equilibrium: its inputs with friction and temperatures in force, its load and its temperatures."""

    inputs: DriveTrainInputs
    spread: LoadDistribution
    flank: FlankHeat
    rule: BulkRule
    ran: BulkInForce
    result: HelixResult


def on_face(inputs: DriveTrainInputs, face: int, share: float) -> DriveTrainInputs:
    """Return the unit with the modifications of a face and the share of the torque that the face carries."""
    given = of_faces(inputs)[face]
    if given.gears.helices == 1:
        return inputs
    given = replace(given, load=replace(given.load, helix_share=share))
    return replace(inputs, mesh=replace(inputs.mesh, distribution=given))


def loaded_face(
    inputs: DriveTrainInputs, prepared: Prepared, equilibrium: Equilibrium, face: int, flanks: Flanks | None
) -> LoadedFace:
    """Compute load, temperatures and safety of a face; `flanks` [K] are those of the helix's own heat balance."""
    share, system = float(equilibrium.shares[face]), prepared.unit
    inputs = on_face(inputs, face, share)
    if flanks is not None:
        temperatures = replace(inputs.mesh.temperatures, flanks=flanks, bulk=sum(flanks) / 2)
        inputs = replace(inputs, mesh=replace(inputs.mesh, temperatures=temperatures))
    spread = distribution(inputs.mesh.distribution, equilibrium.meshes[face].prepared, equilibrium.balances[face])
    asked = contact_of(inputs)
    contact, spread, flash, _, rule, ran = in_force(asked, spread)
    inputs = replace(inputs, mesh=contact)
    thermal = prepared.thermals[face]
    bulk = FaceBulk(inputs, thermal, _deviations(thermal, rule))
    flank = flank_heat(inputs, spread, flash, bulk, asked.temperatures.scuffing_test)
    here = system.frame.faces[face]
    return LoadedFace(
        inputs=inputs,
        spread=spread,
        flank=flank,
        rule=rule,
        ran=ran,
        result=HelixResult(
            hand="right" if here.hand > 0.0 else "left",
            start=here.start,
            share=share,
            axial_force=equilibrium.meshes[face].transmitted * float(here.force[2]),
            misalignment=misalignment(inputs, system, prepared.thermals[face], equilibrium, face),
            load=face_load(spread),
            flash=flank.flash,
            safety=flank.safety,
            pinion_flank=None if flanks is None else flanks[0],
            wheel_flank=None if flanks is None else flanks[1],
            bulk=inputs.mesh.temperatures.bulk,
            micropitting=flank.micropitting.answer,
            wear=wear_asked_for(inputs.mesh.micropitting, spread),
            mesh=spread,
            contact_temperature=frozen(flank.temperature),
            film_ratio=None if flank.micropitting.ratio is None else frozen(flank.micropitting.ratio),
        ),
    )


def _deviations(thermal: ThermalLead, rule: BulkRule) -> FloatArray | None:
    """Deviations of both surfaces from their means along the face [K], as far as the contact takes the balance."""
    if thermal.flanks is None or not rule.weight:
        return None
    return np.asarray(rule.weight * (thermal.flanks - np.array([[face_mean(own)] for own in thermal.flanks])))


def face_load(spread: LoadDistribution) -> FaceLoad:
    """Return the largest values of the load over the face, and the face load factor."""
    loaded = spread.load.face_load_factor is not None
    shares = np.trapezoid(spread.flank.line_load, axis=0)
    return FaceLoad(
        face_load_factor=spread.load.face_load_factor,
        face_load_at=float(spread.flank.face_fraction[int(np.argmax(shares))]) if loaded else None,
        max_line_load=spread.load.max_line_load,
        max_pressure=spread.pressure.max,
        contact_fraction=spread.load.contact_fraction,
        transmission_error_pp=spread.transmission_error.peak_to_peak,
    )


def decisive(faces: list[LoadedFace]) -> int:
    """Return the face with the least safety; without a safety, that with the largest pressure or line load."""

    def severity(face: LoadedFace) -> tuple[float, float, float]:
        safety, load = face.flank.safety, face.result.load
        known = [] if safety is None else [safety.minimum, safety.blok_flank, safety.blok_feature]
        least = min((factor for factor in known if factor is not None), default=np.inf)
        return -least, load.max_pressure or 0.0, load.max_line_load

    return max(range(len(faces)), key=lambda face: severity(faces[face]))


def axial_balance(
    inputs: DriveTrainInputs, prepared: Prepared, equilibrium: Equilibrium, couplings: tuple[CouplingResult, ...]
) -> AxialBalance | None:
    """Return the axial balance of the floating shaft and its bounds; None for a single helix (Eq. D20, D22)."""
    system = prepared.unit
    split = system.split
    if split is None:
        return None
    floating = [
        (port, coupling)
        for port, coupling in zip(system.couplings, couplings, strict=True)
        if port.inputs.shaft == NAMES_OF_SHAFTS[split.shaft]
    ]
    force, limit = prepared.meshes[0].transmitted, sum(coupling.thrust_limit for _, coupling in floating)
    runout = inputs.arrangement.apex_runout
    by_runout = [] if runout is None else [runout_thrust(port, runout, each.tilt) for port, each in floating]
    acting = split.force(equilibrium.hubs.loads)
    bounds = [
        min(max((1.0 + split.difference(split.external + sign * limit, force)) / 2, 0.0), 1.0) for sign in (-1.0, 1.0)
    ]
    given, gears = inputs.mesh.distribution.modifications, inputs.mesh.distribution.gears
    working = prepared.path.pair.working_pressure_angle
    slope = misalignment_slope(given.in_plane_deviation, given.out_of_plane_deviation, working)
    reach = system.frame.faces[0].direction * slope * (gears.total_width - gears.face_width) / (2 * gears.face_width)
    tilts = (-reach, reach)  # a tilt of the axes lifts one helix and lowers the other
    approaches = [period_mean(each.transmission_error, each.rolls.phase) for each in equilibrium.balances]
    first, second = (own + mean + lift for own, mean, lift in zip(approaches, equilibrium.mean_gap, tilts, strict=True))
    tilt = float(system.frame.faces[0].force[2])
    return AxialBalance(
        apex="leading" if tilt > 0.0 else "trailing",
        floating_shaft=NAMES_OF_SHAFTS[split.shaft],
        force=acting,
        share_factor=float(2 * equilibrium.shares.max()),
        share_bounds=((bounds[0], 1.0 - bounds[0]), (bounds[1], 1.0 - bounds[1])),
        unloading_force=split.unloading_force(force),
        runout_thrust_fraction=by_runout[0] if by_runout else None,
        float=-(first - second) / (2 * tilt) if tilt else None,
    )
