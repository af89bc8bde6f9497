"""Warnings of a coupling calculation: inputs outside the range of validity, and results without a meaning."""

from collections.abc import Iterator
from math import degrees

from solvers.coupling.friction import equal_loads_friction_moment
from solvers.coupling.inputs import MAX_MISALIGNMENT, CouplingInputs, RecommendationInputs
from solvers.coupling.lubrication import UNSTABLE_AREA
from solvers.coupling.results import AxialThrust, Geometry, Kinematics, Limits, LoadDistribution, Lubrication
from solvers.coupling.tooth_loads import SLIDING_VELOCITY_LIMIT
from solvers.lubricants import oil_temperature, thick_oil
from solvers.notices import Notice, unusual_value

ORBIT_RESOLUTION = 0.01
"""Relative uncertainty of an orbit above which a notice is given."""
TALLEST_TOOTH = 4.0  # in modules, chosen
LEAST_ORBIT = 1e-10
"""If the largest displacement of an orbit is below this value [m], the orbit counts as zero.

With perfect teeth, the displacement consists of rounding errors only.
"""


def motion_notices(
    inputs: CouplingInputs, geometry: Geometry, kinematics: Kinematics, thrust: AxialThrust, limits: Limits
) -> Iterator[Notice]:
    """Yield the notices about misalignment, speed and sliding."""
    operation, sliding = inputs.operation, kinematics.max_sliding_velocity
    if operation.misalignment == 0.0:
        yield Notice(
            "no_misalignment",
            "without misalignment the contact does not travel; there is no contact overlap and no oil film",
            "misalignment",
            rank="note",
        )
    if operation.speed == 0.0:
        yield Notice(
            "not_turning",
            "the coupling does not turn; there is no oil film, and no permissible misalignment is stated",
            "speed",
            rank="note",
        )
    elif limits.allowable_misalignment is None:
        message = (
            "the coupling turns so slowly that no misalignment reaches the limit of the sliding velocity; no "
            "permissible misalignment is stated"
        )
        yield Notice("no_sliding_limit", message, "speed", rank="note")
    elif limits.allowable_misalignment > MAX_MISALIGNMENT:
        angle = degrees(limits.allowable_misalignment)
        message = (
            f"the permissible misalignment of {angle:.3g} degrees exceeds the 6 degrees up to which the theory holds"
        )
        yield Notice("allowable_misalignment", message, "speed", rank="note")
    if sliding > SLIDING_VELOCITY_LIMIT:
        message = f"the sliding velocity of {sliding:.3g} m/s exceeds the limit of {SLIDING_VELOCITY_LIMIT} m/s"
        yield Notice("sliding_velocity", message, "misalignment")
    if thrust.indeterminate:
        message = (
            "no tooth slides. Friction can then balance any thrust between the bounds; the thrust is stated as the "
            "mean of the bounds"
        )
        yield Notice("friction_indeterminate", message, "axial_velocity")
    elif thrust.self_induced is not None and sliding == 0.0:
        message = (
            "at this misalignment no tooth slides; the direction of the self-induced thrust is therefore unknown, and "
            "this thrust is stated as zero"
        )
        yield Notice("friction_indeterminate", message, "misalignment")
    if sliding == operation.axial_velocity == 0.0 < thrust.coaxial_limit:
        bound = equal_loads_friction_moment(thrust.coaxial_limit, geometry.pitch_radius)
        message = (
            f"no tooth slides. Friction can then resist a tilt with any moment up to {bound:.4g} N m; the moment is "
            "stated as zero"
        )
        yield Notice("indeterminate_moment", message, "speed" if operation.speed == 0.0 else "misalignment")


def load_notices(
    inputs: CouplingInputs, load: LoadDistribution, thrust: AxialThrust, limits: Limits
) -> Iterator[Notice]:
    """Yield the notices about torque, friction and the displacement of the sleeve."""
    torque = inputs.operation.torque
    if torque == 0.0:
        message = (
            "without torque there is no load concentration, load capacity coefficient or thrust limit; the friction "
            "regime and the coefficient of friction are stated for a very small load"
        )
        yield Notice("no_load", message, "torque", rank="note")
    elif thrust.coaxial_limit == 0.0:
        yield Notice(
            "no_friction",
            "without friction the limit of the thrust is zero, so the ratio of the thrust to this limit is not defined",
            "coefficient",
            rank="note",
        )
    if torque < limits.sleeve_centring_torque:
        message = (
            f"below a torque of {limits.sleeve_centring_torque:.4g} N m the teeth cannot centre a horizontal sleeve"
        )
        yield Notice("sleeve_not_centred", message, "torque")
    if inputs.model.sleeve == "floating" and 0 < load.loaded_teeth < 3:
        message = "fewer than three teeth carry load; the position of the floating sleeve is therefore not unique"
        yield Notice("sleeve_position", message, "sleeve")


def contact_notices(inputs: CouplingInputs, kinematics: Kinematics, lubrication: Lubrication) -> Iterator[Notice]:
    """Yield the notices about the oil, the position of the contact on the tooth face, and the oil film."""
    yield from thick_oil(inputs.lubricant.viscosity)
    if inputs.lubricant.temperature is not None:
        yield from oil_temperature(inputs.lubricant.temperature, "lubricant.temperature")
    half_face = inputs.coupling.face_width / 2.0
    if lubrication.hertz_half_width > half_face:
        yield Notice(
            "wide_contact",
            "the contact between two teeth is wider than the tooth face",
            "face_width",
            rank="invalid",
        )
    if kinematics.max_contact_travel >= half_face:
        message = (
            f"the contact travels {kinematics.max_contact_travel * 1e3:.3g} mm and leaves the tooth face; there is no "
            "oil film"
        )
        yield Notice("edge_contact", message, "face_width", rank="invalid")
    elif kinematics.max_contact_travel + lubrication.hertz_half_width > half_face:
        reach = kinematics.max_contact_travel + lubrication.hertz_half_width
        message = (
            f"the contact reaches a distance of {reach * 1e3:.3g} mm from the middle of the face, which is beyond the "
            "end of the face"
        )
        yield Notice("edge_contact", message, "face_width")
    if lubrication.inlet_ratio is None:
        yield Notice(
            "infinite_inlet",
            "the inlet is infinitely long; the inlet ratio is therefore not defined",
            "inlet",
            rank="note",
        )
    if lubrication.regime.area == UNSTABLE_AREA:
        message = (
            "the friction regime is area 3.3, in which the friction is unstable; for this area the paper states no "
            "coefficient of friction"
        )
        yield Notice("unstable_regime", message, "misalignment", rank="invalid")


def orbit_notices(
    fewest_teeth: int,
    displacement: float,
    displacement_uncertainty: float | None,
    harmonic: float,
    harmonic_uncertainty: float | None,
) -> Iterator[Notice]:
    """Yield notices if the sleeve's position is not unique at some rotor angle, or if the orbit may be inaccurate.

    `fewest_teeth` is the smallest number of loaded teeth at any rotor angle. `displacement` [m] is the largest
    displacement of the orbit, and `harmonic` [N] is the largest harmonic of the inertia force.
    """
    if fewest_teeth < 3:
        message = (
            "at some rotor angles fewer than three teeth carry load; the position of the sleeve is not unique there"
        )
        yield Notice("sleeve_position", message, "torque")
    if displacement < LEAST_ORBIT:
        return
    if displacement_uncertainty is None or harmonic_uncertainty is None:
        message = (
            "the orbit does not converge with twice the number of harmonics; the uncertainty of the orbit is "
            "therefore not known"
        )
        yield Notice("orbit_resolution", message, "speed")
        return
    uncertain = (
        (displacement_uncertainty / displacement, "largest displacement"),
        (harmonic_uncertainty / harmonic if harmonic > 0.0 else 0.0, "largest harmonic of the force"),
    )
    share, name = max(uncertain)
    if share > ORBIT_RESOLUTION:
        message = (
            "some teeth alternately carry load and lift off; "
            f"the {name} is therefore uncertain by {100.0 * share:.2g} %"
        )
        yield Notice("orbit_resolution", message, "misalignment")


def unusual_values(inputs: CouplingInputs | RecommendationInputs, _result: object) -> Iterator[Notice]:
    """Return the notices about unusual values in the description of a coupling."""
    coupling = (inputs.design if isinstance(inputs, RecommendationInputs) else inputs).coupling
    return tall_tooth(coupling.tooth_height, coupling.module)


def tall_tooth(height: float, module: float, section: str = "coupling") -> Iterator[Notice]:
    """Warn if the tooth height [m] of a coupling is unusually large for the module [m]."""
    if height > TALLEST_TOOTH * module:
        message = (
            f"the tooth height of {height * 1e3:g} mm exceeds {TALLEST_TOOTH:g} modules; was a diameter entered "
            "instead of a height?"
        )
        yield unusual_value(f"{section}.tooth_height", message)
