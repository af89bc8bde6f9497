"""The load distribution of a helical or spur gear pair with modification and misalignment."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from solvers.arrays import frozen, without_rounding
from solvers.contact.hertz import reduced_modulus
from solvers.gears.diameters import diameters_of
from solvers.gears.gear import rack_tip_radius
from solvers.gears.pair import PathOfContact, meshing_path
from solvers.gears.tolerances import flank_tolerances
from solvers.scuffing.contact_lines import ContactLengths, RollPositions, contact_lengths, roll_positions
from solvers.scuffing.contact_slices import Mesh, Peak, largest, reaches_base_circle
from solvers.scuffing.flank_results import face_load_factor, feature_line, flank
from solvers.scuffing.inputs import Load, LoadDistributionInputs
from solvers.scuffing.load_balance import LoadBalance, balance_load
from solvers.scuffing.mesh_results import friction_loss, stiffness, transmission_error
from solvers.scuffing.modification import Gap, gap, kinks_along_face, kinks_along_path
from solvers.scuffing.notices import geometry_notices, load_notices, model_notices, relief_notices
from solvers.scuffing.results import (
    ContactLines,
    Derived,
    Geometry,
    LengthCurves,
    LoadDistribution,
    LoadOnFlank,
    Place,
    Pressure,
)
from solvers.scuffing.tooth_stiffness import pair_compliance


@dataclass(frozen=True, slots=True)
class PreparedMesh:
    """Values of a mesh that the load balance needs: path of contact, contact lengths, roll positions and forces.

    `mesh` contains the gap that follows from the inputs. `tangential_force` is F_bt [N]. `force` is the force [N] that
    the load balance distributes over the contact lines.
    """

    path: PathOfContact
    lengths: ContactLengths
    mesh: Mesh
    rolls: RollPositions
    tangential_force: float
    force: float

    def sharing(self, share: float) -> "PreparedMesh":
        """Return the mesh under a share of its force."""
        return replace(self, tangential_force=share * self.tangential_force, force=share * self.force)


def mesh_of(inputs: LoadDistributionInputs) -> PreparedMesh:
    """Prepare the mesh for the load balance (Eq. 1).

    Raises InvalidInput: if the pair cannot mesh (see the errors of `gear_pair`, `path_of_contact` and
    `contact_lengths`), or if two options exclude each other (see the errors of `pair_compliance`).
    """
    path = meshing_path(inputs.gears)
    compliance = pair_compliance(path, inputs.pinion_material, inputs.wheel_material, inputs.model)
    form = gap(inputs.modifications, path)
    tangential_force = inputs.load.contact_torque / path.pair.pinion.base_radius
    normal_force = tangential_force / path.plane.cos_base_helix
    return PreparedMesh(
        path=path,
        lengths=contact_lengths(path),
        mesh=Mesh(path.plane, compliance, form),
        rolls=roll_positions(
            path.plane, inputs.resolution.roll_positions, kinks_along_path(form), kinks_along_face(form)
        ),
        tangential_force=tangential_force,
        force=normal_force if inputs.model.load_convention == "exact" else tangential_force,
    )


def solve(inputs: LoadDistributionInputs) -> LoadDistribution:
    """Compute load, pressure, transmission error and friction loss of a pair, of two helices those of one.

    Raises the errors of `mesh_of`, and NoSolution `load_balance` if the load balance does not converge.
    """
    prepared = mesh_of(inputs)
    balance = balance_load(prepared.mesh, prepared.rolls, prepared.force, inputs.resolution.slices)
    return distribution(inputs, prepared, balance)


def distribution(inputs: LoadDistributionInputs, prepared: PreparedMesh, balance: LoadBalance) -> LoadDistribution:
    """Compute the results of a load distribution from the balanced mesh.

    The gap in `balance` is used. This gap may differ from the gap that follows from the inputs.
    """
    path, lengths, resolution = prepared.path, prepared.lengths, inputs.resolution
    modulus = reduced_modulus(inputs.pinion_material, inputs.wheel_material)
    tangential_force = prepared.tangential_force
    return LoadDistribution(
        path_of_contact=path,
        balance=balance,
        feature=partial(
            feature_line,
            path,
            balance,
            inputs.load.pinion_speed,
            tangential_force,
            modulus,
            np.linspace(0.0, 1.0, resolution.feature_points),
        ),
        maps=partial(flank, balance, modulus, resolution.profile_points, resolution.face_points),
        geometry=_geometry(path),
        contact_lines=_contact_lines(lengths, balance),
        stiffness=stiffness(path, balance, inputs, balance.force / lengths.mean, tangential_force),
        transmission_error=transmission_error(balance),
        load=_load_on_flank(path, balance, inputs.load, tangential_force),
        pressure=_pressure(path, balance, modulus),
        friction_loss=friction_loss(path, balance, inputs.load, inputs.friction_coefficient),
        derived=_derived(path, balance.mesh.gap, inputs.load),
        warnings=(
            *geometry_notices(path, lengths),
            *model_notices(path, inputs.model),
            *relief_notices(path, inputs.modifications),
            *load_notices(balance),
        ),
    )


def _geometry(path: PathOfContact) -> Geometry:
    pair = path.pair
    return Geometry(
        centre_distance=pair.centre_distance,
        working_pressure_angle=pair.working_pressure_angle,
        base_helix_angle=pair.base_helix_angle,
        transverse_base_pitch=pair.transverse_base_pitch,
        path_of_contact=path.length,
        transverse_contact_ratio=path.transverse_contact_ratio,
        overlap_ratio=path.overlap_ratio,
        total_contact_ratio=path.total_contact_ratio,
        undercut=pair.pinion.undercut or pair.wheel.undercut,
        **diameters_of(pair),
    )


def _derived(path: PathOfContact, form: Gap, load: Load) -> Derived:
    """Return values that follow from the inputs, including the values used for inputs that are not given."""
    pair = path.pair.inputs
    return Derived(
        pinion_torque=load.torque,
        power=load.transmitted_power,
        centre_distance=path.pair.centre_distance,
        tip_relief_length=form.tip_relief_length,
        root_relief_length=form.root_relief_length,
        end_relief_length=form.end_relief_length,
        rack_tip_radius=min(rack_tip_radius(pair, teeth) for teeth in (pair.pinion, pair.wheel)),
        total_face_width=None if pair.helices == 1 else pair.total_width,
        tolerances=flank_tolerances(pair),
    )


def _contact_lines(lengths: ContactLengths, balance: LoadBalance) -> ContactLines:
    """Return least, largest and mean total length of the contact lines, and the total length at every roll position."""
    phase = balance.rolls.phase
    return ContactLines(
        min_length=lengths.minimum,
        max_length=lengths.maximum,
        mean_length=lengths.mean,
        length_ratio=lengths.ratio,
        curves=LengthCurves(frozen(phase / phase[-1]), frozen(balance.survey.length)),
    )


def _load_on_flank(path: PathOfContact, balance: LoadBalance, load: Load, tangential_force: float) -> LoadOnFlank:
    """Return the forces, the largest line load of all roll positions, and the loaded share of the contact length."""
    peak = largest(balance.survey.peak_load)
    phase, loaded, length = balance.rolls.phase, balance.survey.loaded_length, balance.survey.length
    return LoadOnFlank(
        pinion_torque=load.torque,
        contact_factor=load.contact_factor,
        tangential_force=tangential_force,
        normal_force=balance.force,
        max_line_load=0.0 if peak is None else peak.value,
        max_at=_place(path, peak),
        contact_fraction=float(np.trapezoid(loaded, phase) / np.trapezoid(length, phase)),
        face_load_factor=None if peak is None else face_load_factor(balance, peak.y),
        balance_error=float(balance.residual.max()),
        pair_share=frozen(balance.survey.line_forces.T / balance.force) if balance.force > 0.0 else None,
    )


def _pressure(path: PathOfContact, balance: LoadBalance, modulus: float) -> Pressure:
    """Return the largest p_H = sqrt(E' w / (2 pi R_n)) of all roll positions, and its place."""
    if reaches_base_circle(balance.survey):
        return Pressure(None, None)
    peak = largest(balance.survey.peak_pressure)
    maximum = 0.0 if peak is None else float(np.sqrt(modulus * peak.value / (2 * np.pi)))
    return Pressure(maximum, _place(path, peak))


def _place(path: PathOfContact, peak: Peak | None) -> Place | None:
    if peak is None:
        return None
    gamma = without_rounding(float(path.profile_parameter(peak.x)), 1.0)
    return Place(gamma, peak.x / path.length, peak.y / path.plane.face_width)
