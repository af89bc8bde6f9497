"""The main results of a drive train. These results do not need the thermal film and take little time to compute."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from solvers.arrays import FloatArray
from solvers.drive_train.gap.balance import Equilibrium
from solvers.drive_train.gap.face_curves import face_slope
from solvers.drive_train.helices import decisive, loaded_face
from solvers.drive_train.inputs import DriveTrainInputs
from solvers.drive_train.prepared import Prepared, prepare, settle
from solvers.drive_train.unit_heat import asks_for_balance, check_face_heat, warm_unit
from solvers.scuffing.thermal.bulk import Flanks


@dataclass(frozen=True, slots=True)
class Outcome:
    """Main results of a unit: pressure [Pa], line load [N/m], slopes of the gap [m] and transmission error [m].

    A slope is the rise of the gap over the whole face. `safety` is the safety factor at the hottest place of the flank,
    by Blok's method. The method compares the contact temperature with the scuffing temperature `limit` [K].
    `temperature` (profile, face) [K] is the contact temperature over the flank. `shares` is the load along the face
    divided by the mean load. `gap` [m] can be the start value for the calculation of a similar unit.
    """

    face_load_factor: float | None
    safety: float | None
    max_pressure: float | None
    max_line_load: float
    shaft_slope: float
    total_slope: float
    transmission_error_peak_to_peak: float
    shares: FloatArray
    temperature: FloatArray
    limit: float | None
    gap: FloatArray


def outcome(inputs: DriveTrainInputs, start: FloatArray | None = None) -> Outcome:
    """Compute the main results of a unit.

    If `start` is given, the iteration starts from this gap [m], which may be the result for a similar unit. Raises the
    errors of `model.solve`.
    """
    if asks_for_balance(inputs):
        warm = warm_unit(
            replace(inputs, mesh=replace(inputs.mesh, cooling=replace(inputs.mesh.cooling, band=False))), start
        )
        return outcome_of(warm.inputs, warm.prepared, warm.equilibrium, warm.helix_flanks)
    check_face_heat(inputs)
    prepared = prepare(inputs)
    return outcome_of(inputs, prepared, settle(inputs, prepared, start))


def outcome_of(
    inputs: DriveTrainInputs,
    prepared: Prepared,
    equilibrium: Equilibrium,
    flanks: Sequence[Flanks | None] | None = None,
) -> Outcome:
    """Return the main results of a unit in equilibrium, of the decisive helix, without the thermal film."""
    closed = replace(inputs, mesh=replace(inputs.mesh, lubrication="closed_form"))
    faces = [
        loaded_face(closed, prepared, equilibrium, k, own)
        for k, own in enumerate(flanks or [None] * len(prepared.meshes))
    ]
    number = decisive(faces)
    spread, heat = faces[number].spread, faces[number].flank
    shares = np.trapezoid(spread.flank.line_load, axis=0)
    mean = float(np.trapezoid(shares) / (shares.size - 1))
    slope = face_slope(equilibrium.gap[number])
    return Outcome(
        face_load_factor=spread.load.face_load_factor,
        safety=None if heat.safety is None else heat.safety.blok_flank,
        max_pressure=spread.pressure.max,
        max_line_load=spread.load.max_line_load,
        shaft_slope=slope,
        total_slope=slope + face_slope(prepared.thermals[number].lead),
        transmission_error_peak_to_peak=spread.transmission_error.peak_to_peak,
        shares=np.asarray(shares) / (mean if mean > 0.0 else 1.0),
        temperature=heat.temperature,
        limit=faces[number].inputs.mesh.temperatures.scuffing,
        gap=equilibrium.gap,
    )
