"""Results of the warm face: temperatures and leads of every face, what their heat adds, and the band of the gain."""

from dataclasses import replace

import numpy as np

from solvers.arrays import frozen
from solvers.drive_train.gap.face_curves import face_crown, face_slope
from solvers.drive_train.helices import loaded_face
from solvers.drive_train.unit_heat import WarmUnit, mean_flanks
from solvers.errors import NoSolution
from solvers.heat_balance import Heat
from solvers.heat_balance.band import end_networks
from solvers.heat_balance.results import FaceHeat, GearAlongFace, UniformHeat
from solvers.heat_balance.solution import equilibrium


def face_heats(warm: WarmUnit) -> tuple[FaceHeat, ...]:
    """Return the temperatures along every face and what they do; empty where temperatures are uniform."""
    face, loop = warm.face, warm.faces
    if face is None or loop is None:
        return ()
    closed = replace(warm.inputs, mesh=replace(warm.inputs.mesh, lubrication="closed_form", micropitting=None))
    prepared, even, flanks = loop.even(face.equilibrium)
    stations, load, results = face.prepared.unit.stations, loop.relative_load(face.equilibrium), []
    for k, own in enumerate(mean_flanks(flanks)):
        at_even = loaded_face(closed, prepared, even, k, own).result
        (pinion, wheel), lead = (
            (GearAlongFace(frozen(face.flanks[gear, k]), frozen(face.bodies[gear, k])) for gear in (0, 1)),
            face.leads[k],
        )
        results.append(
            FaceHeat(
                position=frozen(stations),
                pinion=pinion,
                wheel=wheel,
                lead=frozen(lead),
                lead_slope=face_slope(lead),
                lead_crown=face_crown(lead),
                gain=face.amplification.gain[k],
                amplification=face.amplification.skew[k],
                end_amplification=face.amplification.end[k],
                largest_eigenvalue=face.amplification.largest_eigenvalue,
                uniform_heat=UniformHeat(
                    face_load_factor=at_even.load.face_load_factor,
                    blok_flank=None if at_even.safety is None else at_even.safety.blok_flank,
                    pinion_flank=frozen(flanks[0, k]),
                    wheel_flank=frozen(flanks[1, k]),
                    line_force=at_even.misalignment.curves.line_force,
                ),
                jet_skew=loop.skew if warm.readings else None,
                reading_deviation=frozen(loop.deviations(warm.readings, load)) if warm.readings else None,
                balance_error=face.along.balance_error,
            )
        )
    return tuple(results)


def with_amplification_band(heat: Heat, warm: WarmUnit, face: int) -> Heat:
    """Return the heat balance with the amplification of a face at the coolest and the hottest flanks of its band.

    The load stays. None where one of them is unstable or has no solution.
    """
    own, loop = warm.face, warm.faces
    if heat.band is None or own is None or loop is None:
        return heat
    load, values = loop.relative_load(own.equilibrium), []
    for network in end_networks(loop.network, warm.balance.cooling, heat.flank_cases):
        try:
            there = replace(loop, network=network, rises=equilibrium(network, loop.rises).rises)
            values.append(there.amplified(own.equilibrium, load).skew[face])
        except (NoSolution, np.linalg.LinAlgError):
            return heat
    known = [value for value in values if value is not None]
    if len(known) < len(values):
        return heat
    return replace(heat, band=replace(heat.band, amplification=(min(known), max(known))))
