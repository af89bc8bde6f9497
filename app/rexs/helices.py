"""Double-helical gears: two stages of a file between the same two shafts, with opposite hands, are one mesh."""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from math import isclose

from app.rexs import table
from app.rexs.model import Component
from app.rexs.power import Pair, PowerFlow
from app.rexs.reading import Reading
from app.rexs.stages import OFF_CENTRE, ROLES, SAME, TORQUE, StageDraft

GAP, SECOND = "gears.gap_width_mm", "modifications.second_helix"
AGREEING = {table.MODULE: "modules", table.HELIX_ANGLE: "helix angles", table.STAGE[0]: "centre distances"}
OF_ONE_HELIX = ("helix_slope_um", "lead_crowning_um")  # modifications that a request has for each helix
OWN = {"gears.hand", table.FACE_WIDTH.field, TORQUE, *(f"modifications.{name}" for name in OF_ONE_HELIX)}
"""Fields that may differ between the helices."""


def with_twins(reading: Reading, pairs: Sequence[Pair]) -> list[Pair]:
    """Put the two stages of double-helical gears together, as a pair and its twin.

    Two stages between the same shafts that are no double-helical gears are a finding. Gears of a shift gearbox, which a
    switchable coupling holds, are left alone.
    """
    between: dict[frozenset[int], list[Pair]] = defaultdict(list)
    for pair in pairs:
        between[frozenset(shaft.id for shaft in pair.shafts)].append(pair)
    twins: dict[int, Pair] = {}
    for stages in between.values():
        gears = [gear for pair in stages for gear in pair.gears]
        if len(stages) != 2 or any(_is_shifted(reading, gear) for gear in gears):
            continue
        first, other = stages
        twin = other if other.shafts[0].id == first.shafts[0].id else other.turned
        if (difference := next(_obstacles(reading, first, twin), None)) is None:
            twins[first.stage.id] = twin
            continue
        message = f"the stages {first.stage.id} and {twin.stage.id} are not one double-helical unit: {difference}"
        reading.find("not_double_helical", twin.stage, None, message)
    second = {twin.stage.id for twin in twins.values()}
    return [pair._replace(twin=twins.get(pair.stage.id)) for pair in pairs if pair.stage.id not in second]


def _is_shifted(reading: Reading, gear: Component) -> bool:
    """Return whether a switchable coupling fastens the gear to its shaft."""
    joints = (
        joint
        for role in ("inner_part", "outer_part")
        for joint in reading.model.related("side", role, gear.id, "assembly")
    )
    return any(joint.type == table.SWITCHABLE for joint in joints)


def _obstacles(reading: Reading, first: Pair, twin: Pair) -> Iterator[str]:
    """Yield the reasons why two stages between the same shafts are not the helices of one pair."""
    aside = PowerFlow(Reading(reading.model))  # what is found here is found again when the stages are read
    drafts = [StageDraft(pair, aside, 0) for pair in (first, twin)]
    for draft in drafts:
        draft.fill()
    one, other = drafts
    if one.teeth != other.teeth:
        teeth = ("/".join(map(str, draft.teeth)) for draft in drafts)
        yield f"the numbers of teeth are {' and '.join(teeth)}"
    for row, name in AGREEING.items():
        own, theirs = (draft.fields.get(row.field) for draft in drafts)
        if own is not None and theirs is not None and not isclose(own, theirs, rel_tol=OFF_CENTRE):
            yield f"the {name} are {own:.6g} and {theirs:.6g} {row.unit}"
    if not one.fields.get(table.HELIX_ANGLE.field):
        yield "the gears have no helix"
    if one.fields["gears.hand"] == other.fields["gears.hand"]:
        yield f"both helices of the pinion are {one.fields['gears.hand']}-hand"
    lower, upper = sorted((draft.faces() for draft in drafts), key=lambda faces: faces[:1])
    if not lower or not upper:
        yield "the file does not say at which positions of the shafts the gears sit"
    elif upper[0][0] - lower[0][1] < -OFF_CENTRE:
        yield "the faces of the helices overlap"


def joined(stage: StageDraft, twin: StageDraft) -> StageDraft:
    """Return the draft of double-helical gears, which is that of the helix at the lower Z with what the other adds."""
    lower, upper = sorted((stage, twin), key=lambda draft: draft.faces()[:1])
    faces = [*lower.faces(), *upper.faces()]
    lower.second_helix = upper
    if len(faces) != 2:  # a load case moves a gear to where it cannot sit
        lower.lacks(GAP, upper.stage, None, "the file does not say at which positions of the shafts the gears sit")
        return lower
    _widths(lower, upper, *faces)
    _torque(lower, upper)
    _axial(lower)
    for name in OF_ONE_HELIX:
        path = f"modifications.{name}"
        own, theirs = (draft.fields.get(path, 0.0) for draft in (lower, upper))
        if not isclose(own, theirs, abs_tol=SAME):
            lower.put(f"{SECOND}.{name}", theirs, *upper.origins.get(path, (upper.stage, None)))
    _differences(lower, upper)
    return lower


def _widths(lower: StageDraft, upper: StageDraft, near: tuple[float, float], far: tuple[float, float]) -> None:
    widths = [end - start for start, end in (near, far)]
    width = min(widths)
    if not isclose(*widths, rel_tol=SAME):
        message = (
            f"the helices are {widths[0]:.6g} and {widths[1]:.6g} mm wide; both are calculated with the smaller width, "
            "next to the gap between them"
        )
        lower.reading.find("widths_differ", upper.stage, table.FACE_WIDTH.name, message)
    lower.put(table.FACE_WIDTH.field, width, lower.gears[0], table.FACE_WIDTH.name)
    lower.put(GAP, max(far[0] - near[1], 0.0), upper.gears[0], table.POSITION.name)
    lower.face_start = near[1] - width


def _torque(lower: StageDraft, upper: StageDraft) -> None:
    """Give the draft the torque of both stages: that of the shafts, or else the sum of what the gears state."""
    torque = lower.fields.get(TORQUE)
    if lower.stage.id not in lower.flow.mesh_torque and torque is not None:
        theirs = upper.fields.get(TORQUE)
        if theirs is None:
            del lower.fields[TORQUE]
            lower.lacks(TORQUE, upper.gears[0], table.GEAR_TORQUE.name, "the torque of the other helix is not stated")
            return
        torque += theirs
        lower.fields[TORQUE] = torque
    if torque is not None:
        reason = (
            f"the torque of the stages {lower.stage.id} and {upper.stage.id}, which are the helices of one pair; the "
            "axial balance divides it, and a division that the file states is not used"
        )
        lower.note(TORQUE, torque, reason)


def _axial(lower: StageDraft) -> None:
    """Take the shaft that no bearing holds along its axis as the floating one, and the external forces along it."""
    reading, model = lower.reading, lower.reading.model
    held = [
        any(
            reading.text(bearing, table.HOLDS_ALONG_U) not in table.HOLDS_NOTHING
            for bearing in model.related("side", "inner_part", shaft.id, "assembly")
        )
        for shaft in lower.shafts
    ]
    floating = int(lower.teeth[1] < lower.teeth[0])
    if sum(held) == 1:
        floating = held.index(False)
        lower.put("floating_shaft", ROLES[floating], lower.shafts[floating])
    elif all(held):
        message = (
            "bearings hold both shafts along their axes, but of double-helical gears one shaft floats; that of the "
            "gear with fewer teeth is taken"
        )
        reading.find("both_shafts_held", lower.shafts[floating], None, message)
    shaft = lower.shafts[floating]
    loads = (part for part in model.parts_of(shaft.id) if part.type == "external_load")
    if forces := lower.values_of(loads, table.AXIAL_FORCE):
        force = lower.along(shaft) * sum(value for value, _ in forces)
        lower.put(table.AXIAL_FORCE.field, force, forces[0][1], table.AXIAL_FORCE.name)


def _differences(lower: StageDraft, upper: StageDraft) -> None:
    """Record what else differs between the helices as findings; take over what only the other helix states."""
    for path in dict.fromkeys([*lower.fields, *upper.fields]):
        if path in OWN or path.startswith((GAP, SECOND)):
            continue
        usual = 0.0 if path.startswith("modifications.") and path.endswith("_um") else None
        own, theirs = (draft.fields.get(path, usual) for draft in (lower, upper))
        if own is None:
            lower.put(path, theirs, *upper.origins.get(path, (upper.stage, None)))
            lower.missing.pop(path, None)
        elif theirs is not None and not _same(own, theirs):
            component, attribute = upper.origins.get(path, (upper.stage, None))
            message = (
                f"{path}: the helices differ ({_written(own)} and {_written(theirs)}), which is not modelled; the "
                "value of the helix at the lower Z is used"
            )
            lower.reading.find("helices_differ", component, attribute, message)


def _same(own: object, theirs: object) -> bool:
    if isinstance(own, float | int) and isinstance(theirs, float | int):
        return isclose(own, theirs, rel_tol=SAME, abs_tol=SAME)
    return own == theirs


def _written(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def helices_of(stage: StageDraft) -> tuple[StageDraft, ...]:
    """Return the drafts of the helices in the order of Z; of a single helix, the draft itself."""
    return (stage,) if stage.second_helix is None else (stage, stage.second_helix)
