"""Checks of the inputs of a drive train; a failed check raises InvalidInput."""

import numpy as np

from solvers.drive_train.inputs import COINCIDENT, DriveTrainInputs, LinearBearing, Shaft
from solvers.errors import InvalidInput
from solvers.gears.pair import PathOfContact

NAMES = ("pinion_shaft", "wheel_shaft")
COLLAR_BEYOND_TEETH = 3.0  # normal modules; largest distance of the collar radius from the pitch circle
LEAST_BEARING_DISTANCE = 0.5  # in face widths; least distance between the two bearings of a shaft
LEAST_STIFFNESS = 1e6  # N/m; least stiffness in the weakest direction, from the symmetric part of the matrix
ROUNDING = 1e-9  # relative rounding error of numbers that were converted from other units


def check_inputs(inputs: DriveTrainInputs, path: PathOfContact) -> None:
    """Raise InvalidInput, with a code for each reason, unless shafts, bearings, couplings and collar fit together."""
    if inputs.heat.states_teeth and not inputs.heat.states_both_teeth:
        missing = "wheel_bulk" if inputs.heat.wheel_bulk is None else "pinion_bulk"
        message = (
            "only one tooth temperature is given. Give that of the other gear too; or give the bulk temperature of the "
            "contact and no tooth temperature; or give none, and the heat balance computes all"
        )
        raise InvalidInput("one_tooth_temperature", message, f"heat.{missing}")
    for index, (shaft, name) in enumerate(zip(inputs.shafts, NAMES, strict=True)):
        _check_sections(inputs, path, index, name)
        _check_bearings(inputs, shaft, name)
        _check_torque(inputs, index, name)
        _check_gear_body(inputs, path, index, name)
    _check_jets(inputs)
    _check_couplings(inputs)
    _check_collar(inputs, path)


def _check_sections(inputs: DriveTrainInputs, path: PathOfContact, index: int, name: str) -> None:
    shaft, tip = inputs.shafts[index], 2 * (path.pair.pinion, path.pair.wheel)[index].tip_radius
    start, end = _faces(inputs)
    if start < shaft.start - COINCIDENT or end > shaft.end + COINCIDENT:
        message = "the face of the gear lies outside the sections of the shaft"
        gears = inputs.mesh.distribution.gears
        if gears.gap_width is not None:
            message += (
                f"; two helices of {gears.face_width * 1e3:g} mm and the gap of {gears.gap_width * 1e3:g} mm need "
                f"{gears.total_width * 1e3:g} mm of shaft"
            )
        raise InvalidInput("face_outside", message, "face_start")
    position = shaft.start
    for k, section in enumerate(shaft.sections):
        field = f"{name}.sections.{k}"
        if section.inner_diameter >= section.outer_diameter:
            message = f"the inner diameter of section {k} must be smaller than its outer diameter"
            raise InvalidInput("section_diameter", message, f"{field}.inner_diameter")
        under_face = position < end - COINCIDENT and position + section.length > start + COINCIDENT
        if under_face and section.outer_diameter > tip:
            message = (
                f"the outer diameter of section {k} exceeds the tip diameter of the teeth on it; leave the outer "
                "diameter out"
            )
            raise InvalidInput("section_diameter", message, f"{field}.outer_diameter")
        position += section.length


def _faces(inputs: DriveTrainInputs) -> tuple[float, float]:
    """Return Z of both ends of the face; of double-helical gears, of both helices with the gap [m]."""
    return inputs.face_start, inputs.face_start + inputs.mesh.distribution.gears.total_width


def _check_gear_body(inputs: DriveTrainInputs, path: PathOfContact, index: int, name: str) -> None:
    body, shaft = inputs.shafts[index].gear_body, inputs.shafts[index]
    if body is None:
        return
    root, (start, end) = (path.pair.pinion, path.pair.wheel)[index].root_radius, _faces(inputs)
    bore, position = 0.0, shaft.start
    for section in shaft.sections:
        if position < end and position + section.length > start:
            bore = max(bore, section.inner_diameter)
        position += section.length
    message = None
    if body.hub_diameter / 2 >= root - body.rim_thickness:
        message = (
            f"rim and hub overlap: the root circle has {2e3 * root:.4g} mm; make the rim thinner or the hub smaller"
        )
    elif body.web_width > end - start:
        message = f"the web is wider than the face of {1e3 * (end - start):.4g} mm"
    elif body.hub_diameter <= bore:
        message = f"the hub is not larger than its bore of {1e3 * bore:.4g} mm"
    if message is not None:
        raise InvalidInput("gear_body", message, f"{name}.gear_body")


def _check_jets(inputs: DriveTrainInputs) -> None:
    jets, width = inputs.mesh.cooling.jet_distribution, inputs.mesh.distribution.gears.face_width
    position = np.asarray(jets.position)
    message = None
    if position.size != len(jets.weight) or np.any(np.diff(position) <= 0.0):
        message = "give rising positions, and one weight for each"
    elif np.any(position > width * (1 + ROUNDING)):
        message = f"a position lies outside the face, which is {1e3 * width:.4g} mm wide"
    if message is not None:
        raise InvalidInput("jet_distribution", message, "mesh.cooling.jet_distribution")


def check_readings(inputs: DriveTrainInputs) -> None:
    """Raise InvalidInput `reading_outside` unless every reading along the face is on the face of a helix there is."""
    gears = inputs.mesh.distribution.gears
    for k, reading in enumerate(inputs.mesh.cooling.measured.face):
        field = f"mesh.cooling.measured.face.{k}"
        if reading.position > gears.face_width * (1 + ROUNDING):
            message = f"the reading lies outside the face, which is {1e3 * gears.face_width:.4g} mm wide"
            raise InvalidInput("reading_outside", message, f"{field}.position")
        if reading.helix > gears.helices:
            raise InvalidInput("reading_outside", "the gears have one helix", f"{field}.helix")


def check_bearing_count(shaft: Shaft, name: str) -> None:
    """Raise InvalidInput `bearing_count` unless the shaft has two bearings; `name` is the field of the shaft."""
    if len(shaft.bearings) != 2:
        raise InvalidInput("bearing_count", "a shaft needs exactly two bearings", f"{name}.bearings")


def _check_bearings(inputs: DriveTrainInputs, shaft: Shaft, name: str) -> None:
    check_bearing_count(shaft, name)
    for k, bearing in enumerate(shaft.bearings):
        if not _is_on(shaft, bearing.position):
            message = f"bearing {k} lies beyond the ends of the shaft"
            raise InvalidInput("bearing_outside", message, f"{name}.bearings.{k}.position")
        if isinstance(bearing, LinearBearing):
            matrix = np.array(bearing.stiffness)
            if np.linalg.eigvalsh((matrix + matrix.T) / 2).min() < LEAST_STIFFNESS * (1 - ROUNDING):
                message = (
                    "the symmetric part of the stiffness matrix of a bearing must be at least 1 N/µm in every direction"
                )
                raise InvalidInput("stiffness_matrix", message, f"{name}.bearings.{k}.stiffness")
    distance = abs(shaft.bearings[0].position - shaft.bearings[1].position)
    if distance <= COINCIDENT:
        raise InvalidInput(
            "bearing_order", "the two bearings of a shaft need different positions", f"{name}.bearings.1.position"
        )
    if distance < LEAST_BEARING_DISTANCE * inputs.mesh.distribution.gears.total_width:
        message = "the distance between the bearings must be at least half the face width"
        raise InvalidInput("bearing_distance", message, f"{name}.bearings.1.position")


def _is_on(shaft: Shaft, position: float) -> bool:
    """Whether a position [m] is on the shaft, its ends included."""
    # the ends are sums of lengths, which are rounded
    return shaft.start - COINCIDENT <= position <= shaft.end + COINCIDENT


def _check_torque(inputs: DriveTrainInputs, index: int, name: str) -> None:
    shaft, field = inputs.shafts[index], f"{name}.torque_position"
    position = shaft.torque_position
    if position is None:
        hubs = [coupling.position for coupling in inputs.couplings if NAMES[index].startswith(coupling.shaft)]
        if not hubs:
            raise InvalidInput(
                "torque_position",
                "a shaft without a coupling needs the position at which the torque enters; give this position",
                field,
            )
        position = hubs[0]
    if not _is_on(shaft, position):
        raise InvalidInput("torque_position", "the torque must enter the shaft at a position within the shaft", field)
    start, end = _faces(inputs)
    if start + COINCIDENT < position < end - COINCIDENT:
        raise InvalidInput("torque_position", "the torque must enter the shaft outside the face of the gear", field)


def _check_couplings(inputs: DriveTrainInputs) -> None:
    middle = sum(_faces(inputs)) / 2
    names = [coupling.shaft for coupling in inputs.couplings]
    for k, coupling in enumerate(inputs.couplings):
        field = f"couplings.{k}"
        if names.index(coupling.shaft) != k:
            raise InvalidInput("couplings_on_shaft", "a shaft can have only one coupling", f"{field}.shaft")
        shaft = inputs.pinion_shaft if coupling.shaft == "pinion" else inputs.wheel_shaft
        if not _is_on(shaft, coupling.position):
            raise InvalidInput(
                "position_outside", "the hub of the coupling lies beyond the ends of the shaft", f"{field}.position"
            )
        if (coupling.position > middle) != (coupling.machine_side == "plus"):
            message = (
                "the machine would lie on the same side of the hub as the gears; change machine_side or move the hub"
            )
            raise InvalidInput("machine_side", message, f"{field}.machine_side")


def _check_collar(inputs: DriveTrainInputs, path: PathOfContact) -> None:
    if inputs.collar_radius is None:
        return
    if inputs.mesh.distribution.gears.helices > 1:
        message = "double-helical gears hold each other along Z; leave the thrust collar out"
        raise InvalidInput("thrust_collar_double_helical", message, "collar_radius")
    low = path.pair.pinion_working_radius
    high = low + COLLAR_BEYOND_TEETH * path.pair.inputs.normal_module
    if not low < inputs.collar_radius < high:
        message = (
            f"the radius of a thrust collar that touches the wheel must be between {low * 1e3:.2f} and "
            f"{high * 1e3:.2f} mm"
        )
        raise InvalidInput("thrust_collar_radius", message, "collar_radius")
