"""Flank modifications of both gears as the gap of the mesh, on the flanks that carry the load.

Tip relief of the pinion and root relief of the wheel act at E, the others at A; a slope's sign follows from the end of
the face that meshes first.
"""

from math import sqrt

from app.rexs import table
from app.rexs.model import Component
from app.rexs.reading import Reading
from app.rexs.stages import ROLES, Involute, StageDraft


class Modifications:
    """Fills the fields of `modifications` in the draft of a stage."""

    def __init__(self, stage: StageDraft) -> None:
        self._stage, self._reading = stage, stage.reading
        self._carried = [(place, each) for place in (0, 1) for each in self._of_working_flank(place)]  # place of gear

    def fill(self) -> None:
        """Fill in the modifications of the request from the flanks of both gears."""
        self._relief("tip_relief", ("tip_relief", "root_relief"))
        self._relief("root_relief", ("root_relief", "tip_relief"))
        self._crowning("profile_crowning", "profile_crowning_um", ("_at_tip", "_at_root"))
        self._crowning("helix_crowning", "lead_crowning_um", ("_amount_datum_face", "_amount_non_datum_face"))
        self._slopes()
        self._end_relief()

    def _of_working_flank(self, place: int) -> list[Component]:
        """Modifications of the flank of pinion (0) or wheel (1) that carries the load."""
        sides = {side: modifications_of(self._reading, each) for side, each in self._stage.flanks(place).items()}
        if not any(sides.values()):
            return []
        side = self._working_side(place)
        if side is None:
            side = "right" if sides.get("right") else "left"
            self._stage.note("modifications", side, "which flank carries the load is not known")
        found = sides.get(side, [])
        for each in found:
            if each.type in table.OTHER_MODIFICATIONS:
                self._reading.find("modification", each, None, f"{table.OTHER_MODIFICATIONS[each.type]}; left out")
        return [each for each in found if each.type in table.MODIFICATIONS]

    def _working_side(self, place: int) -> str | None:
        """The flank that carries the load: as the file says, else by sense of rotation and driver.

        Seen from the end of the shaft where u is least (the datum face), a gear with positive speed turns clockwise:
        of a driving gear the right flank then leads and pushes, of a driven one the left flank is pushed.
        """
        stage = self._stage
        for each in stage.gear_data(place):
            if (said := self._reading.text(each, "loaded_tooth_flank")) in {"left", "right"}:
                return said
        speed = stage.flow.speed.get(stage.shafts[place].id)
        if not speed or stage.driver is None:
            return None
        return "right" if (speed > 0.0) == (place == 0) else "left"

    def _crowning(self, kind: str, field: str, ends: tuple[str, str]) -> None:
        """A crowning: the amounts of both gears add, each the mean of its two ends."""
        means, origin = [], None
        for _, each in self._carried:
            values = [self._reading.number(each, kind + end, "um") for end in ends] if each.type == kind else []
            known = [value for value in values if value is not None]
            if not known:
                continue
            if abs(known[0] - known[-1]) > 0.01:
                message = "the amounts at both ends differ; their mean is used"
                self._reading.find("ends_differ", each, kind + ends[1], message)
            means.append(sum(known) / len(known))
            origin = origin or each
        if origin is not None:
            self._stage.put(f"modifications.{field}", sum(means), origin, kind + ends[0])

    def _relief(self, name: str, kinds: tuple[str, str]) -> None:
        """A relief at one end of the path: amounts add, length and shape are those of the larger one.

        `kinds`: what of the pinion and what of the wheel relieves that end.
        """
        found = []
        for place, each in self._carried:
            kind = kinds[place]
            amount = self._reading.number(each, f"{kind}_depth", "um") if each.type == kind else None
            if amount:
                found.append((amount, each, kind, place))
        if not found:
            return
        path = f"modifications.{name}"
        largest, component, kind, place = max(found, key=lambda each: abs(each[0]))
        self._stage.put(f"{path}_um", sum(each[0] for each in found), component, f"{kind}_depth")
        length = self._relief_length(component, kind, place)
        if length is not None:
            self._stage.put(f"{path}_length_mm", length, component, f"{kind}_datum_length")
        if len(found) > 1:
            reason = "both gears are relieved there; amounts add, length and shape of the larger one"
            self._stage.note(f"{path}_um", largest, reason)
        shape = self._reading.text(component, "shape_of_relief")
        exponent = {"linear": 1.0, "parabolic": 2.0}.get(shape)
        path = "modifications.relief_exponent"
        if exponent is None:
            self._stage.assume(path, 1.0, f"the shape of the relief is {shape[:30] or 'not stated'}; linear is used")
        elif self._stage.fields.get(path, exponent) != exponent:
            self._stage.note(path, self._stage.fields[path], "tip and root relief have different shapes")
        else:
            self._stage.put(path, exponent, component, "shape_of_relief")

    def _relief_length(self, component: Component, kind: str, place: int) -> float | None:
        """Length of a relief along the line of action [mm]: as given, or found from the diameter where it begins."""
        length = self._reading.number(component, f"{kind}_datum_length", "mm")
        if length is not None:
            return length
        diameter = self._reading.number(component, f"{kind}_datum_diameter", "mm")
        gear, mate = self._stage.involute(place), self._stage.involute(1 - place)
        if diameter is None or gear is None or mate is None:
            return None
        begin = gear.roll_length(diameter)
        if kind == "tip_relief":
            return self._tip_roll(place, gear) - begin
        distance = self._stage.working_distance()
        if distance is None:
            return None
        base = (gear.base_diameter + mate.base_diameter) / 2.0
        line = sqrt(max(distance**2 - base**2, 0.0))
        return begin - (line - self._tip_roll(1 - place, mate))

    def _tip_roll(self, place: int, gear: Involute) -> float:
        """Roll length of a gear's tip [mm]."""
        addendum = self._stage.fields.get(f"gears.{ROLES[place]}.addendum", 1.0)
        return gear.roll_length(gear.reference_diameter + 2.0 * gear.module * (addendum + gear.shift))

    def _slopes(self) -> None:
        """Profile and helix slopes; positive amounts take material away at the tip and at the non-datum face."""
        sums, origins = {"profile_slope": 0.0, "helix_slope": 0.0}, {}
        for place, each in self._carried:
            amount = self._reading.number(each, each.type, "um") if each.type in sums else None
            if not amount:
                continue
            sense = (1.0, -1.0)[place] if each.type == "profile_slope" else self._end_sense(place)
            if sense is None:
                message = "left out: its sign needs the direction of rotation and the driver"
                self._reading.find("modification", each, "helix_slope", message)
                continue
            sums[each.type] += sense * amount
            origins[each.type] = each
        where = {"profile_slope": "tip", "helix_slope": "face where u is largest (the non-datum face)"}
        for kind, total in sums.items():
            if kind in origins:
                path = f"modifications.{kind}_um"
                self._stage.put(path, total, origins[kind], kind)
                self._stage.note(path, total, f"positive amounts remove material at the {where[kind]}")

    def _end_sense(self, place: int) -> float | None:
        """+1 where u of this gear's shaft grows towards the end that leaves the mesh last.

        Contact begins at the end that follows from sense of rotation and hand of the driver: seen along its u axis
        y runs against sigma h, sigma the sense of rotation and h +1 for a right-hand helix.
        """
        stage = self._stage
        speed = stage.flow.speed.get(stage.shafts[0].id)
        if not speed:
            return None
        hand = -1.0 if self._stage.fields.get("gears.hand") == "left" else 1.0
        return -(1.0 if speed > 0.0 else -1.0) * hand * stage.along(stage.shafts[place])

    def _end_relief(self) -> None:
        """Relief of both ends: ours is the same at both, so that the mean of the ends is used."""
        depths, lengths, origins = {"datum_face": 0.0, "non_datum_face": 0.0}, list[float](), list[Component]()
        for end in depths:
            for _, each in self._carried:
                if each.type != f"end_relief_{end}":
                    continue
                depth = self._reading.number(each, f"end_relief_depth_{end}", "um")
                length = self._reading.number(each, f"end_relief_length_{end}", "mm")
                if depth:
                    depths[end] += depth
                    origins.append(each)
                    lengths += [length] if length else []
        if not origins:
            return
        origin, (datum, other) = origins[0], depths.values()
        if abs(datum - other) > 0.01:
            self._reading.find("ends_differ", origin, None, "end reliefs differ; their mean is used at both ends")
        self._stage.put("modifications.end_relief_um", (datum + other) / 2.0, origin, "end_relief_depth_datum_face")
        if lengths:
            path = "modifications.end_relief_length_mm"
            self._stage.put(path, sum(lengths) / len(lengths), origin, "end_relief_length_datum_face")


def modifications_of(reading: Reading, flank: Component) -> list[Component]:
    """The modifications of a flank, those that are not modelled among them."""
    return list(reading.model.references_of(flank.id, *table.MODIFICATIONS, *table.OTHER_MODIFICATIONS))
