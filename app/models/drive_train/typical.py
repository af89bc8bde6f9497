"""Typical shafts and bearings of a gear pair: rules of thumb for a unit whose shafts are not drawn yet.

Lengths are in mm, as in requests. Both shafts have two plain bearings; the pinion, which drives, is driven from the end
of lowest Z, and the wheel's torque leaves at the end of highest Z. No coupling is part of it.
"""

from math import cos, floor, pi, sqrt
from typing import Any, NamedTuple

from solvers.gears.inputs import GearPairInputs, GearTeeth

SHEAR = 40.0  # N/mm^2, permissible shear stress of a journal that carries the torque
PRESSURE = 2.5  # N/mm^2, specific pressure of a bearing at full load
LEAST_SHARE = 0.2  # journal over reference diameter
MOST_SHARE = 0.85  # journal over root diameter
WIDTH, MOST_WIDTH = 0.7, 1.2  # bearing width over journal diameter
SIDE = 0.25  # room between bearing and teeth over journal diameter
LEAST_SIDE = 10.0  # mm
SHOULDER = 1.15  # shoulder over journal diameter
SHAFT_END = 0.8  # shaft end over journal diameter
COARSE, FINE, FROM = 5.0, 1.0, 50.0  # lengths from 50 mm are multiples of 5 mm, shorter ones of 1 mm
LEAST = 5.0  # mm, smallest diameter of a request


class Rule(NamedTuple):
    """A rule: what it gives, how, and who says so."""

    title: str
    rule: str
    source: str


RULES = {
    "journal": Rule(
        "journal diameter",
        f"the largest of: torsion at {SHEAR:g} N/mm²; {PRESSURE:g} N/mm² on two bearings that share the tooth force; "
        f"{LEAST_SHARE:g} of the reference diameter. At most {MOST_SHARE:g} of the root diameter",
        "rule of thumb; 3.4 N/mm² is quoted as the limit of API 613, not verified",
    ),
    "width": Rule(
        "bearing width",
        f"L/D = {WIDTH:g}; wider, up to {MOST_WIDTH:g}, where the root circle bounds the journal",
        "rule of thumb for turbo gears",
    ),
    "clearance": Rule(
        "radial clearance",
        "left to its default, 1.5 ‰ of the journal's radius",
        "the default of the drive train for plain bearings",
    ),
    "span": Rule(
        "bearing span",
        f"face, and on each side {SIDE:g} journal diameters of room and half a bearing",
        "rule of thumb: as short as seals and oil drains allow",
    ),
    "shoulder": Rule(
        "shoulders",
        f"{SHOULDER:g} journal diameters between bearing and teeth, at most the root diameter",
        "rule of thumb",
    ),
    "teeth": Rule(
        "sections under the teeth",
        "the diameter that carries torsion, d − m_n h_fP*; between two helices the root diameter",
        "a published program's rule, and the pitch diameter by ISO 6336-1 as its upper bound",
    ),
    "end": Rule(
        "shaft end",
        f"the larger of {SHAFT_END:g} journal diameters and torsion at {SHEAR:g} N/mm², at most the journal; torque "
        "enters or leaves one journal diameter from the bearing",
        "rule of thumb",
    ),
    "place": Rule("positions", "the pinion's shaft begins at Z = 0; both shafts share the face", "choice of the datum"),
}


class Value(NamedTuple):
    """A value of the template, in the unit of its field, and the name of its rule."""

    value: Any
    rule: str


def typical_unit(gears: GearPairInputs, torque: float) -> dict[str, Value]:
    """Fields of a drive-train request that describe typical shafts, by dotted path; `torque` of the pinion [N m]."""
    face = 1e3 * gears.total_width
    force = _tooth_force(gears, torque)
    pinion = _Shaft.of(gears, gears.pinion, torque, force)
    wheel = _Shaft.of(gears, gears.wheel, torque * gears.wheel.teeth / gears.pinion.teeth, force)
    face_start = pinion.end + pinion.width + pinion.side
    wheel_start = face_start - wheel.side - wheel.width
    return {
        "face_start_mm": Value(face_start, "place"),
        **pinion.fields("pinion_shaft", gears, 0.0, face_start, face, driven=True),
        **wheel.fields("wheel_shaft", gears, wheel_start, face_start, face, driven=False),
    }


def _reference(gears: GearPairInputs, teeth: GearTeeth) -> float:
    """Reference diameter [mm]."""
    return 1e3 * teeth.teeth * gears.normal_module / cos(gears.helix_angle)


def _tooth_force(gears: GearPairInputs, torque: float) -> float:
    """Force between the teeth, in the transverse plane: 2 T/(d cos alpha) [N], with alpha of the module's plane."""
    return 2e3 * torque / (_reference(gears, gears.pinion) * cos(gears.pressure_angle))


def _rounded(length: float) -> float:
    """Round a length up to a multiple of the step for its size [mm]."""
    return _step(length) * -floor(-length / _step(length))


def _rounded_down(length: float) -> float:
    return _step(length) * floor(length / _step(length))


def _step(length: float) -> float:
    return COARSE if length > FROM else FINE


class _Shaft(NamedTuple):
    """Diameters and lengths of a shaft [mm]."""

    journal: float
    width: float  # of a bearing
    side: float  # room between bearing and teeth
    shoulder: float
    root: float
    end: float  # length of the shaft end
    end_diameter: float

    @classmethod
    def of(cls, gears: GearPairInputs, teeth: GearTeeth, torque: float, force: float) -> "_Shaft":
        """Return the shaft of a gear that carries this torque [N m] and this tooth force [N]."""
        reference = _reference(gears, teeth)
        root = reference - 2e3 * gears.normal_module * (teeth.dedendum - teeth.profile_shift)
        torsion = (16e3 * torque / (pi * SHEAR)) ** (1 / 3)
        pressed = sqrt(force / (2 * WIDTH * PRESSURE))
        most = max(MOST_SHARE * root, LEAST)
        wanted = _rounded(max(torsion, pressed, LEAST_SHARE * reference, LEAST))
        journal = min(wanted, max(float(floor(most)), LEAST))
        needed = force / (2 * PRESSURE * journal)
        width = min(_rounded(max(WIDTH * journal, needed)), _rounded_down(MOST_WIDTH * journal))
        shoulder = max(journal, min(_rounded(SHOULDER * journal), float(floor(root))))
        side, end = _rounded(max(SIDE * journal, LEAST_SIDE)), _rounded(journal)
        end_diameter = min(_rounded(max(SHAFT_END * journal, torsion, LEAST)), journal)
        return cls(journal, width, side, shoulder, root, end, end_diameter)

    def fields(
        self, name: str, gears: GearPairInputs, start: float, face_start: float, face: float, *, driven: bool
    ) -> dict[str, Value]:
        """Return the fields of the shaft; `driven`: from the end of lowest Z, else it drives from the other end."""
        end = (self.end, self.end_diameter, "end")
        bearing, shoulder = (self.width, self.journal, "width"), (self.side, self.shoulder, "shoulder")
        teeth: list[tuple[float, float | None, str]] = [(1e3 * gears.face_width, None, "teeth")]
        if gears.gap_width:
            between = max(float(floor(self.root)), self.journal)
            teeth = [*teeth, (1e3 * gears.gap_width, between, "teeth"), *teeth]
        sections = [bearing, shoulder, *teeth, shoulder, bearing]
        sections = [end, *sections] if driven else [*sections, end]
        fields = {f"{name}.start_mm": Value(start, "place")}
        for k, (length, diameter, rule) in enumerate(sections):
            fields[f"{name}.sections.{k}.length_mm"] = Value(length, rule)
            if diameter is not None:
                fields[f"{name}.sections.{k}.outer_diameter_mm"] = Value(
                    diameter, "journal" if rule == "width" else rule
                )
        middle = self.side + self.width / 2
        places = face_start - middle, face_start + face + middle
        beyond = self.journal + self.width / 2
        fields[f"{name}.torque_position_mm"] = Value(places[0] - beyond if driven else places[1] + beyond, "end")
        for k, place in enumerate(places):
            fields |= {
                f"{name}.bearings.{k}.position_mm": Value(place, "span"),
                f"{name}.bearings.{k}.diameter_mm": Value(self.journal, "journal"),
                f"{name}.bearings.{k}.width_mm": Value(self.width, "width"),
            }
        return fields
