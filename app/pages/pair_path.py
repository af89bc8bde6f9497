"""The path of a gear pair over the pages: is it safe, is it choked, on which shafts, what to grind, and one report.

Every step is a link that holds the whole case; nothing is typed twice. If the shafts are not known, the step to the
drive train fills in typical ones. The query field `typical` keeps the pair for which they were made, so that a page can
tell which values are still the assumed ones.
"""

from dataclasses import replace
from typing import NamedTuple
from urllib.parse import urlencode

from app.calculations import BY_PATH, card_of
from app.errors import InvalidBody, Unreadable
from app.models.drive_train.request import TrainGears, TrainOperation
from app.models.drive_train.typical import RULES, Rule, Value, typical_unit
from app.pages.carried import address_of, carried_to, missing
from app.pages.cases import Asked
from app.pages.form import IF_USED, Alternatives, Block, FieldView, FormSection, FormState, form
from app.pages.query import LONGEST_QUERY, Pairs, body_of, pairs_of_query
from app.pages.study_kinds import DESIGN
from app.pages.templating import page_path
from app.pages.typed import text_of
from app.schema.model import Request
from app.schema.reading import validated
from solvers.errors import InvalidInput
from solvers.gears.inputs import RACK_A
from solvers.scuffing.inputs import Load

SCUFFING, PUMPING, TRAIN = "/v1/scuffing", "/v1/pumping", "/v1/drive-train"
UNIT = ("face_start_mm", "pinion_shaft", "wheel_shaft")  # what the typical shafts fill in
BASIS = ("gears", "operation")  # sections on which they depend
WITH_PAIR = "pair"
"""The extent of a report that also contains the other calculations of the pair."""
ENTRY = (
    *("gears.pinion.teeth", "gears.wheel.teeth", "gears.pinion.profile_shift", "gears.wheel.profile_shift"),
    *("gears.module_mm", "gears.helix_angle_deg", "gears.face_width_mm", "gears.gap_width_mm"),
    *("gears.centre_distance_mm", "load.pinion_torque_n_m", "load.power_kw", "load.pinion_speed_rpm"),
    *("load.application_factor", "lubricant.iso_vg", "lubricant.kind", "temperatures.oil_c"),
    *("temperatures.scuffing_test.fzg_stage", "cooling.gear_flow_l_per_min"),
)
"""Fields of the page of a new gear pair: the pair, its load and its oil."""
LAST = ("lubricant", "temperatures", "cooling")


class Step(NamedTuple):
    """A step of the path: its question, the page that answers it, and the link; without one, `trouble` says why."""

    question: str
    title: str
    address: str = ""
    current: bool = False
    trouble: str = ""


class Assumed(NamedTuple):
    """The typical values of a case: their rules by field, the rules that apply, and a link to fill them in again.

    `renewed` is empty if the values were made for the pair of the case.
    """

    fields: dict[str, Rule]
    rules: list[Rule]
    renewed: str


def path_of(asked: Asked, study: str = "") -> list[Step]:
    """Return the steps of the path for the page of a case or of a study of the case; none if it is no gear pair."""
    here = asked.calculation
    if card_of(here).subject != "pair":
        return []
    if not asked.pairs:
        return [Step(question, title) for question, title in _questions(typical=True)]
    unit = asked if here.path == TRAIN else carried_to(asked, BY_PATH[TRAIN])
    filled = with_typical(unit)
    places = [asked if here.path == path else carried_to(asked, BY_PATH[path]) for path in (SCUFFING, PUMPING)]
    addresses = [*map(address_of, (*places, filled)), filled.study(DESIGN.name), filled.reported(extent=WITH_PAIR)]
    basis = [] if _has_shafts(unit) else missing(unit, UNIT)  # what is missing for typical shafts
    lacking = [missing(each) for each in places] + 3 * [basis or missing(filled)]
    troubles = [_trouble(lacks, address) for lacks, address in zip(lacking, addresses, strict=True)]
    if study == DESIGN.name:
        troubles[-1] = "below, with the correction found"
    now = DESIGN.name if study == DESIGN.name else here.path
    current = [now == place for place in (SCUFFING, PUMPING, TRAIN, DESIGN.name, "")]
    questions = _questions(typical=bool(basis) or "typical" in filled.views)
    return [
        Step(question, title, "" if trouble else address, is_current, trouble)
        for (question, title), address, is_current, trouble in zip(questions, addresses, current, troubles, strict=True)
    ]


def _trouble(lacks: list[str], address: str) -> str:
    """Return why a step cannot be opened, or an empty text."""
    if lacks:
        return f"missing: {', '.join(lacks)}"
    return "the case is too long for a link" if len(address) > LONGEST_QUERY else ""


def _questions(*, typical: bool) -> list[tuple[str, str]]:
    shafts = "typical shafts and bearings" if typical else "shafts and bearings"
    return [
        ("Safe?", "scuffing with heat"),
        ("Choked?", "pumping of the teeth"),
        ("On shafts", shafts),
        ("What to grind", "search of the best correction"),
        ("One report", "of all steps"),
    ]


def _has_shafts(unit: Asked) -> bool:
    return any(name.partition(".")[0] in UNIT for name, _ in unit.pairs)


def with_typical(unit: Asked) -> Asked:
    """Return the case of a drive train with typical shafts; unchanged if it has shafts, or lacks gears or load."""
    if _has_shafts(unit):
        return unit
    basis = _basis(unit.pairs)
    filled = [(name, text_of(each.value)) for name, each in template(basis).items()]
    if not filled:
        return unit
    return replace(unit, pairs=[*unit.pairs, *filled], views=unit.views | {"typical": urlencode(basis)})


def _basis(pairs: Pairs) -> Pairs:
    """Return the fields of a drive train on which its typical shafts depend."""
    return [(name, text) for name, text in pairs if name.partition(".")[0] in BASIS]


def template(basis: Pairs) -> dict[str, Value]:
    """Return the typical fields for gears and load; empty if these are incomplete or not valid."""
    try:
        body = body_of(BY_PATH[TRAIN].request, basis)
        gears = validated(TrainGears, body.get("gears")).pair(RACK_A)
        load = validated(TrainOperation, body.get("operation")).si(Load)
        return typical_unit(gears, load.torque)
    except (InvalidBody, InvalidInput, Unreadable):
        return {}


def assumed_of(asked: Asked) -> Assumed | None:
    """Return the values of a drive train that are still those of its typical shafts; None if it has none."""
    basis = pairs_of_query(asked.views.get("typical", ""))
    if asked.calculation.path != TRAIN or not basis:
        return None
    given = dict(asked.pairs)
    made = template(basis)
    kept = {name: each.rule for name, each in made.items() if given.get(name) == text_of(each.value)}
    if not kept:
        return None
    own = [(name, text) for name, text in asked.pairs if name not in made]
    is_same = sorted(basis) == sorted(_basis(asked.pairs))
    renewed = "" if is_same else address_of(with_typical(replace(asked, pairs=own)))
    rules = [rule for name, rule in RULES.items() if name in {*kept.values(), "clearance"}]
    return Assumed({name: RULES[rule] for name, rule in kept.items()}, rules, renewed)


def entry_form() -> list[FormSection]:
    """Return the form of a new gear pair: the fields of the scuffing page that every step of the path needs."""
    return chosen_form(BY_PATH[SCUFFING].request, FormState(endpoint=SCUFFING), frozenset(ENTRY))


def chosen_form(request: type[Request], state: FormState, names: frozenset[str]) -> list[FormSection]:
    """Return the form of a request with only the fields `names`, unfolded; the gears and their load come first."""
    chosen = [found for section in form(request, state) if (found := _only(section, names))]
    return sorted(chosen, key=lambda section: section.path in LAST)


def _only(section: FormSection, names: frozenset[str]) -> FormSection | None:
    """Return a section of the form with only some fields, unfolded; None if it has none of them."""
    blocks = [found for block in section.blocks if (found := _block(block, names)) is not None]
    if not blocks:
        return None
    return replace(section, blocks=tuple(blocks), open=True, switch=None, description="")


def _block(block: Block, names: frozenset[str]) -> Block | None:
    if isinstance(block, FormSection):
        return _only(block, names)
    if isinstance(block, Alternatives):
        kept = tuple(each for each in block.fields if each.name in names)
        return replace(block, fields=kept, picked=kept[-1].name) if len(kept) > 1 else kept[0] if kept else None
    if isinstance(block, FieldView):
        needed = "" if block.required == IF_USED else block.required
        return replace(block, required=needed) if block.name in names else None
    return block if block[0].name in names else None


PAGE = page_path(BY_PATH[SCUFFING])
"""The page that answers the form of a new gear pair."""
