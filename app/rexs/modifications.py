"""Modifications of the mesh. A modification of the mesh is the sum of the modifications of the two loaded flanks.

Tip relief of the pinion and root relief of the wheel act at E, the end of contact. Root relief of the pinion and tip
relief of the wheel act at A, the start of contact. The sign of a helix slope depends on which end of the face meshes
first.
"""

from math import sqrt

from app.rexs import table
from app.rexs.model import Component
from app.rexs.reading import Reading
from app.rexs.stages import ROLES, Involute, StageDraft

Carried = list[tuple[int, Component]]
"""The modifications of the loaded flanks, each with its gear: 0 for the pinion, 1 for the wheel."""


def add_modifications(stage: StageDraft) -> None:
    """Fill in the section `modifications` in the draft of a stage."""
    carried = [(place, modification) for place in (0, 1) for modification in _of_working_flank(stage, place)]
    _relief(stage, carried, "tip_relief", ("tip_relief", "root_relief"))
    _relief(stage, carried, "root_relief", ("root_relief", "tip_relief"))
    _crowning(stage, carried, "profile_crowning", "profile_crowning_um", ("_at_tip", "_at_root"))
    _crowning(stage, carried, "helix_crowning", "lead_crowning_um", ("_amount_datum_face", "_amount_non_datum_face"))
    _slopes(stage, carried)
    _end_relief(stage, carried)


def _of_working_flank(stage: StageDraft, place: int) -> list[Component]:
    """Return the modifications of the loaded flank of pinion (0) or wheel (1)."""
    sides = {side: modifications_of(stage.reading, flank) for side, flank in stage.flanks(place).items()}
    if not any(sides.values()):
        return []
    side = _working_side(stage, place)
    if side is None:
        side = "right" if sides.get("right") else "left"
        stage.note("modifications", side, "it is not known which flank carries the load")
    modifications = sides.get(side, [])
    for item in modifications:
        if item.type in table.OTHER_MODIFICATIONS:
            message = f"{table.OTHER_MODIFICATIONS[item.type]}; the modification is left out"
            stage.reading.find("modification", item, None, message)
    return [item for item in modifications if item.type in table.MODIFICATIONS]


def _working_side(stage: StageDraft, place: int) -> str | None:
    """Return which flank of a gear is loaded, "left" or "right"; return None if the loaded flank is not known."""
    for data in stage.data_of(stage.gears[place]):
        if (side := stage.reading.text(data, "loaded_tooth_flank")) in {"left", "right"}:
            return side
    speed = stage.flow.speed.get(stage.shafts[place].id)
    if not speed or stage.driver is None:
        return None
    return "right" if (speed > 0.0) == (stage.order[place] == stage.driver) else "left"


def _crowning(stage: StageDraft, carried: Carried, kind: str, field: str, ends: tuple[str, str]) -> None:
    """Fill in the crowning, which is the sum of the crownings of both gears."""
    means, origin = [], None
    for _, item in carried:
        values = [stage.reading.number(item, kind + end, "um") for end in ends] if item.type == kind else []
        amounts = [value for value in values if value is not None]
        if not amounts:
            continue
        if abs(amounts[0] - amounts[-1]) > 0.01:
            message = "the amounts at the two ends differ; the mean of both amounts is used"
            stage.reading.find("ends_differ", item, kind + ends[1], message)
        means.append(sum(amounts) / len(amounts))
        origin = origin or item
    if origin is not None:
        stage.put(f"modifications.{field}", sum(means), origin, kind + ends[0])


def _relief(stage: StageDraft, carried: Carried, name: str, kinds: tuple[str, str]) -> None:
    """Fill in the relief at one end of the path of contact."""
    reliefs = []
    for place, item in carried:
        kind = kinds[place]
        amount = stage.reading.number(item, f"{kind}_depth", "um") if item.type == kind else None
        if amount:
            reliefs.append((amount, item, kind, place))
    if not reliefs:
        return
    path = f"modifications.{name}"
    largest, component, kind, place = max(reliefs, key=lambda relief: abs(relief[0]))
    stage.put(f"{path}_um", sum(relief[0] for relief in reliefs), component, f"{kind}_depth")
    length = _relief_length(stage, component, kind, place)
    if length is not None:
        stage.put(f"{path}_length_mm", length, component, f"{kind}_datum_length")
    if len(reliefs) > 1:
        reason = (
            "both gears have a relief at this place; the sum of both amounts is used, with the length and the shape "
            "of the larger relief"
        )
        stage.note(f"{path}_um", largest, reason)
    shape = stage.reading.text(component, "shape_of_relief")
    exponent = {"linear": 1.0, "parabolic": 2.0}.get(shape)
    path = "modifications.relief_exponent"
    if exponent is None:
        reason = f"the shape of the relief is {shape[:30] or 'not stated'}; a linear relief is used"
        stage.assume(path, 1.0, reason)
    elif stage.fields.get(path, exponent) != exponent:
        stage.note(path, stage.fields[path], "tip and root relief have different shapes")
    else:
        stage.put(path, exponent, component, "shape_of_relief")


def _relief_length(stage: StageDraft, component: Component, kind: str, place: int) -> float | None:
    """Return the length of a relief along the line of action [mm], or None if the length is not known."""
    length = stage.reading.number(component, f"{kind}_datum_length", "mm")
    if length is not None:
        return length
    diameter = stage.reading.number(component, f"{kind}_datum_diameter", "mm")
    gear, mate = stage.involute(place), stage.involute(1 - place)
    if diameter is None or gear is None or mate is None:
        return None
    begin = gear.roll_length(diameter)
    if kind == "tip_relief":
        return _tip_roll(stage, place, gear) - begin
    distance = stage.working_distance()
    if distance is None:
        return None
    base = (gear.base_diameter + mate.base_diameter) / 2.0
    line = sqrt(max(distance**2 - base**2, 0.0))
    return begin - (line - _tip_roll(stage, 1 - place, mate))


def _tip_roll(stage: StageDraft, place: int, gear: Involute) -> float:
    """Return the roll length of a gear's tip [mm]."""
    addendum = stage.fields.get(f"gears.{ROLES[place]}.addendum", 1.0)
    return gear.roll_length(gear.reference_diameter + 2.0 * gear.module * (addendum + gear.shift))


def _slopes(stage: StageDraft, carried: Carried) -> None:
    """Fill in the profile slope and the helix slope."""
    sums, origins = {"profile_slope": 0.0, "helix_slope": 0.0}, {}
    for place, item in carried:
        amount = stage.reading.number(item, item.type, "um") if item.type in sums else None
        if not amount:
            continue
        sense = (1.0, -1.0)[place] if item.type == "profile_slope" else _end_sense(stage, place)
        if sense is None:
            message = (
                "the modification is left out, because its sign depends on the direction of rotation and on the "
                "driving gear, and these are not known"
            )
            stage.reading.find("modification", item, "helix_slope", message)
            continue
        sums[item.type] += sense * amount
        origins[item.type] = item
    where = {"profile_slope": "tip", "helix_slope": "the end of the face where u is largest (the non-datum face)"}
    for kind, total in sums.items():
        if kind in origins:
            path = f"modifications.{kind}_um"
            stage.put(path, total, origins[kind], kind)
            stage.note(path, total, f"positive amounts remove material at the {where[kind]}")


def _end_sense(stage: StageDraft, place: int) -> float | None:
    """Return +1 if the u axis of the gear's shaft points to the end of the face that leaves the mesh last, else -1.

    The u axis is the axis of the coordinate u along the shaft. Return None if the sense of rotation is not known. For
    the shaft of the driving gear, the result is -sigma h. Here sigma is the sense of rotation of the driving gear about
    the u axis, +1 or -1. The helix of the driving gear determines h: +1 for a right-hand helix, -1 for a left-hand
    helix.
    """
    speed = stage.flow.speed.get(stage.shafts[0].id)
    if not speed:
        return None
    hand = -1.0 if stage.fields.get("gears.hand") == "left" else 1.0
    return -(1.0 if speed > 0.0 else -1.0) * hand * stage.along(stage.shafts[place])


def _end_relief(stage: StageDraft, carried: Carried) -> None:
    """Fill in the end relief."""
    depths, lengths, origins = {"datum_face": 0.0, "non_datum_face": 0.0}, list[float](), list[Component]()
    for end in depths:
        for _, item in carried:
            if item.type != f"end_relief_{end}":
                continue
            depth = stage.reading.number(item, f"end_relief_depth_{end}", "um")
            length = stage.reading.number(item, f"end_relief_length_{end}", "mm")
            if depth:
                depths[end] += depth
                origins.append(item)
                lengths += [length] if length else []
    if not origins:
        return
    origin, (datum, other) = origins[0], depths.values()
    if abs(datum - other) > 0.01:
        message = "the reliefs at the two ends differ; the mean of both reliefs is used at both ends"
        stage.reading.find("ends_differ", origin, None, message)
    stage.put("modifications.end_relief_um", (datum + other) / 2.0, origin, "end_relief_depth_datum_face")
    if lengths:
        path = "modifications.end_relief_length_mm"
        stage.put(path, sum(lengths) / len(lengths), origin, "end_relief_length_datum_face")


def modifications_of(reading: Reading, flank: Component) -> list[Component]:
    """Return all modifications of a flank. Modifications that are not modelled are included."""
    return list(reading.model.references_of(flank.id, *table.MODIFICATIONS, *table.OTHER_MODIFICATIONS))
