"""The rotors of a unit as bodies of revolution: gear body, and shaft up to the bearings beside the face (Eq. W3)."""

from collections.abc import Iterator

from solvers.drive_train.inputs import COINCIDENT, DriveTrainInputs, GearBody, JournalBearing, Shaft
from solvers.gears.pair import GearPair
from solvers.heat_balance.face import Rotor
from solvers.heat_balance.rings import Cylinder, RotorGeometry


def web_edges(inputs: DriveTrainInputs) -> list[float]:
    """Positions Z of the edges of all webs [m]."""
    middle = inputs.face_start + inputs.mesh.distribution.gears.total_width / 2
    bodies = [shaft.gear_body for shaft in inputs.shafts if shaft.gear_body is not None]
    return [middle + sign * body.web_width / 2 for body in bodies for sign in (-1.0, 1.0)]


def rotors_of(inputs: DriveTrainInputs, pair: GearPair, faces: tuple[tuple[float, ...], ...]) -> tuple[Rotor, Rotor]:
    """Return the rotors of pinion and wheel; `faces` are the lines between the rings of every face along Z [m]."""
    numbers = iter(range(4))
    bearings = [
        [next(numbers) if isinstance(bearing, JournalBearing) else None for bearing in shaft.bearings]
        for shaft in inputs.shafts
    ]
    pinion, wheel = (
        _rotor(shaft, own, gear.root_radius, faces)
        for shaft, own, gear in zip(inputs.shafts, bearings, (pair.pinion, pair.wheel), strict=True)
    )
    return pinion, wheel


def _rotor(shaft: Shaft, numbers: list[int | None], root: float, faces: tuple[tuple[float, ...], ...]) -> Rotor:
    low, high = float(faces[0][0]), float(faces[-1][-1])
    ends, held = [shaft.start, shaft.end], list[int | None]([None, None])
    for bearing, number in zip(shaft.bearings, numbers, strict=True):
        place = bearing.position
        if ends[0] < place < low - COINCIDENT:
            ends[0], held[0] = place, number
        elif high + COINCIDENT < place < ends[1]:
            ends[1], held[1] = place, number
    sections = list(_sections(shaft, root))
    bore = next(part.inner for part in sections if part.end > (low + high) / 2)
    body = list(_body(shaft.gear_body, low, high, bore, root))
    sides = list[list[Cylinder]]()
    for k, (start, end, parts) in enumerate(((ends[0], low, sections[::-1]), (high, ends[1], sections))):
        inner, outer, side = bore, root, list[Cylinder]()
        for part in parts:
            first, last = max(part.start, start), min(part.end, end)
            if last - first < COINCIDENT:
                continue
            if part.inner >= outer or part.outer <= inner:  # what hangs in the air conducts nothing
                held[k] = None
                break
            side.append(Cylinder(first, last, part.inner, part.outer))
            inner, outer = part.inner, part.outer
        sides.append(side)
        held[k] = held[k] if side else None
    return Rotor(
        geometry=RotorGeometry(
            (*sides[0][::-1], *body, *sides[1]), root, faces, (held[0] is not None, held[1] is not None)
        ),
        bearings=(held[0], held[1]),
        shaft_radii=(sides[0][0].outer if sides[0] else 0.0, sides[1][0].outer if sides[1] else 0.0),
    )


def _sections(shaft: Shaft, root: float) -> Iterator[Cylinder]:
    """Yield the sections of a shaft in the order of Z, cut at the root circle."""
    start = shaft.start
    for section in shaft.sections:
        yield Cylinder(start, start + section.length, section.inner_diameter / 2, min(section.outer_diameter / 2, root))
        start += section.length


def _body(body: GearBody | None, low: float, high: float, bore: float, root: float) -> Iterator[Cylinder]:
    """Yield the gear's body under the face: solid, or hub, web at mid-face and rim."""
    if body is None:
        yield Cylinder(low, high, bore, root)
        return
    middle, hub, rim = (low + high) / 2, body.hub_diameter / 2, root - body.rim_thickness
    yield Cylinder(low, high, bore, hub)
    yield Cylinder(middle - body.web_width / 2, middle + body.web_width / 2, hub, rim)
    yield Cylinder(low, high, rim, root)
