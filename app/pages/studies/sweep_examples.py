"""Studies to start from, each a link: an example with one field or two varied."""

from typing import Any, NamedTuple

from app.calculations import BY_PATH, Calculation
from app.examples import examples
from app.pages.query import Pairs, link, pairs_of
from app.pages.templating import page_path
from app.studies.fields import value_at


class StudyExample(NamedTuple):
    """A question, the example that it is asked of, and what is varied."""

    title: str
    source: str
    example: str
    study: dict[str, str]

    @property
    def calculation(self) -> Calculation:
        """Whose page it is on."""
        return BY_PATH[examples()[self.example].endpoint]

    @property
    def address(self) -> str:
        """The page that answers it."""
        request = examples()[self.example].request
        return link(f"{page_path(self.calculation)}/vary", pairs_of(request), **self.study)


class StudyLink(NamedTuple):
    """A study to start from: its question and its address."""

    title: str
    address: str


def _axis(name: str, path: str, start: float, stop: float, count: int, scale: str = "linear") -> dict[str, str]:
    parts = {"": path, ".from": f"{start:g}", ".to": f"{stop:g}", ".count": str(count)}
    return {f"{name}{part}": text for part, text in parts.items()} | (
        {f"{name}.scale": scale} if scale == "log" else {}
    )


STUDIES = (
    StudyExample(
        "Which crowning forgives ±20 µm of misalignment?",
        "Xue 2020, Fig. 17, as a map of 17 by 11 load distributions",
        "xue-pair-1-modified",
        _axis("x", "modifications.helix_slope_um", -20, 20, 17)
        | _axis("y", "modifications.lead_crowning_um", 0, 30, 11)
        | {"show": "pressure.max_mpa"},
    ),
    StudyExample(
        "Axial thrust over misalignment, by axial velocity",
        "Pahl 1978, Figs. 15 and 16",
        "pahl-axial-displacement",
        _axis("x", "operation.misalignment_deg", 0, 0.15, 61)
        | _axis("y", "operation.axial_velocity_mm_per_s", 0.5, 4, 4, "log")
        | {"show": "axial_thrust.force_n"},
    ),
    StudyExample(
        "How far does misalignment throw the sleeve?",
        "largest displacement over misalignment, by crowning",
        "pahl-sleeve-orbit",
        _axis("x", "operation.misalignment_deg", 0, 1, 41)
        | _axis("y", "coupling.crowning_ratio", 1, 4, 4)
        | {"show": "max_displacement_um", "best": "greatest"},
    ),
    StudyExample(
        "Which oil for how much torque?",
        "load capacity at the best crowning, over torque, by the oil's grade",
        "starter-coupling-crowning",
        _axis("x", "operation.torque_n_m", 1000, 4500, 15)
        | {"y": "lubricant.iso_vg", "y.from": "32", "y.to": "150"}
        | {"show": "min_load_capacity_coefficient", "best": "greatest"},
    ),
    StudyExample(
        "What does squeezing out the air cost, over speed and backlash?",
        "pumping power over speed, by backlash",
        "milian-table-1",
        _axis("x", "operation.pinion_speed_rpm", 1000, 6000, 11)
        | _axis("y", "gears.normal_backlash_mm", 0, 1, 4)
        | {"show": "total.pumping_power_w"},
    ),
    StudyExample(
        "From which speed does a face width choke?",
        "speed at which the ends become sonic, over face width",
        "starter-choking-speed",
        _axis("x", "gears.face_width_mm", 100, 300, 11) | {"show": "axial_choking_speed_rpm", "best": "greatest"},
    ),
    StudyExample(
        "How much load does a hotter oil leave?",
        "scuffing safety over power, by oil temperature",
        "starter-industrial-scuffing",
        _axis("x", "load.power_kw", 200, 800, 7)
        | _axis("y", "temperatures.oil_c", 60, 80, 2)
        | {"show": "safety.blok_factor", "best": "greatest"},
    ),
    StudyExample(
        "How safe is it, over speed and power?",
        "scuffing safety by Blok as a map of 9 by 9 pairs",
        "starter-industrial-scuffing",
        _axis("x", "load.pinion_speed_rpm", 500, 2500, 9)
        | _axis("y", "load.power_kw", 200, 800, 9)
        | {"show": "safety.blok_factor", "best": "greatest"},
    ),
    StudyExample(
        "How thin does the film get, over speed?",
        "minimum film thickness over the speed of a flank",
        "starter-line-contact",
        _axis("x", "contact.speed_1_m_per_s", 3.5, 40, 12, "log") | {"show": "film.minimum_um", "best": "greatest"},
    ),
    StudyExample(
        "Does the unit stay safe at more power?",
        "scuffing safety of the hot unit over power",
        "starter-turbo-gear-drive-train",
        _axis("x", "operation.power_kw", 4000, 16000, 7) | {"show": "safety.minimum", "best": "greatest"},
    ),
    StudyExample(
        "How safe is it, over speed and power?",
        "scuffing safety of the hot unit as a map of 9 by 9 units",
        "starter-turbo-gear-drive-train",
        _axis("x", "operation.pinion_speed_rpm", 4000, 12000, 9)
        | _axis("y", "operation.power_kw", 4000, 16000, 9)
        | {"show": "safety.minimum", "best": "greatest"},
    ),
    StudyExample(
        "How evenly does the face carry, over speed and power?",
        "face load factor as a map of 9 by 9 units",
        "starter-turbo-gear-drive-train",
        _axis("x", "operation.pinion_speed_rpm", 4000, 12000, 9)
        | _axis("y", "operation.power_kw", 3000, 15000, 9)
        | {"show": "load.face_load_factor"},
    ),
)


def studies_of(calculation: Calculation) -> list[StudyExample]:
    """The studies that start from examples of a calculation."""
    return [each for each in STUDIES if each.calculation is calculation]


def studies_of_case(calculation: Calculation, pairs: Pairs, case: Any) -> list[StudyLink]:
    """The same studies asked of a case: fields that have a value in it vary around that."""
    address, found = f"{page_path(calculation)}/vary", []
    for each in studies_of(calculation):
        own = [f"{axis}.{end}" for axis in "xy" if value_at(case, each.study.get(axis, "")) for end in ("from", "to")]
        study = {name: text for name, text in each.study.items() if name not in own}
        found.append(StudyLink(each.title, link(address, pairs, **study)))
    return found
