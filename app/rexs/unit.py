"""The answer about the file of a gear unit: the stages with their requests and load cases, and the faults of the file.

For each stage, the answer also lists missing fields, assumed values and attributes that are not used.
"""

from collections.abc import Iterable, Iterator
from itertools import chain, islice
from typing import Any, NamedTuple

from pydantic import BaseModel

from app.rexs import table
from app.rexs.drive_train import add_drive_train, bearings_of
from app.rexs.helices import helices_of, joined, with_twins
from app.rexs.lubrication import add_lubrication
from app.rexs.model import Component, RexsUnit
from app.rexs.modifications import add_modifications, modifications_of
from app.rexs.power import Pair, PowerFlow, Train
from app.rexs.reading import READABLE, SCUFFING, TRAIN, Reading, rounded
from app.rexs.stages import SPEED, TORQUE, StageDraft, pairs

MOST_FINDINGS = 1000  # largest number of findings in an answer; more would not help the author of the file
MOST_STAGES = 50  # largest number of stages; chosen: far more than any gear unit has
MOST_CASES = 200  # largest number of load cases; further load cases of a file are not read
MOST_DRAFTS = 2000  # largest product of stages and load cases; each combination needs a draft, which takes 2 ms
LONGEST_NAME, MOST_SPECTRUM_CASES = 100, 100  # length of a name and number of cases that /v1/spectrum accepts
MOST_IGNORED = 2000  # largest number of ignored attributes per stage
SHARES = {"operating_time_fraction": "", "load_duration_fraction": "", "operating_time": "h", "load_duration": "h"}
"""Attributes that state the duration of a load case, as a share of the operating time or in hours.

The keys are the names of the attributes, and the values are the units of the attributes.
"""


def gear_unit(model: RexsUnit) -> dict[str, Any]:
    """Return the answer of /v1/rexs about the gear unit of a REXS file."""
    reading = Reading(model)
    _check_relations(reading)
    for component in model.components.values():
        if reading.is_elsewhere(component):
            message = "the component refers to another file, which is not read; only the values of this file are used"
            reading.find("data_elsewhere", component, None, message)
    all_pairs = list(islice(pairs(reading), MOST_STAGES + 1))
    if len(all_pairs) > MOST_STAGES:
        message = f"the unit has more than {MOST_STAGES} stages; only the first stages are read"
        reading.find("too_many_stages", None, None, message)
        del all_pairs[MOST_STAGES:]
    all_pairs = with_twins(reading, all_pairs)
    cases = model.load_cases[: min(MOST_CASES, MOST_DRAFTS // max(len(all_pairs), 1))]
    if len(cases) < len(model.load_cases):
        reading.find("too_many_cases", None, None, f"only the first {len(cases)} load cases are read")
    if len(cases) > MOST_SPECTRUM_CASES:
        message = f"the file has more load cases than /v1/spectrum accepts; the largest number is {MOST_SPECTRUM_CASES}"
        reading.find("too_many_cases", None, None, message)
    train = Train(reading, all_pairs)
    base, flows = train.flow(), [train.flow(case) for case in cases]
    unit = model.first("gear_unit")
    return {
        "version": model.version,
        "application": model.application,
        "name": unit.name if unit else "",
        "shafts": [{"id": shaft.id, "name": shaft.name} for shaft in model.by_type["shaft"]],
        "stages": _stages(reading, all_pairs, base, flows),
        "findings": _rows(islice(reading.findings, MOST_FINDINGS)),
    }


def _stages(reading: Reading, all_pairs: list[Pair], base: PowerFlow, flows: list[PowerFlow]) -> list[dict[str, Any]]:
    """Return the stages in the answer."""
    rows, parts, all_parts = [], [], set[int]()
    for pair in all_pairs:
        row, stage = _stage(pair, base, flows)
        rows.append(row)
        parts.append({component.id: component for component in _described_by(stage)})
        all_parts |= parts[-1].keys()
    for row, own in zip(rows, parts, strict=True):
        elsewhere = all_parts - own.keys()
        unused = chain(reading.ignored(own.values()), *(flow.reading.ignored_of_case(elsewhere) for flow in flows))
        row["ignored"] = _rows(islice(unused, MOST_IGNORED))
        if next(unused, None) is not None:
            message = (
                f"more than {MOST_IGNORED} attributes of the stage {row['id']} are not used; the list contains only "
                "the first of these attributes"
            )
            reading.find("too_many_ignored", None, None, message)
    return rows


def _stage(pair: Pair, base: PowerFlow, flows: list[PowerFlow]) -> tuple[dict[str, Any], StageDraft]:
    """Return the part of the answer that describes a stage, and the draft from which this part is made."""
    flow = next((flow for flow in (base, *flows) if flow.knows(pair)), base)
    stage = _draft_of(pair, flow)
    if flow is not base:
        reason = f"the value is taken from the load case {flow.reading.case.name}, because the model states no value"
        for path in (TORQUE, SPEED, table.OIL_TEMPERATURE.field):
            if path in stage.fields:
                stage.note(path, stage.fields[path], reason)
    # The fields of oil and temperatures come last.
    paths = sorted(
        {**stage.fields, **stage.missing}, key=lambda path: path.partition(".")[0] in {"lubricant", "temperatures"}
    )
    requests = {endpoint: stage.request(endpoint, paths) for endpoint in READABLE if endpoint != TRAIN}
    is_train = add_drive_train(stage)
    if is_train:
        requests[TRAIN] = stage.request(TRAIN, {**stage.fields, **stage.missing})
    cases = _cases(stage, pair, flows, is_train=is_train)
    spectra = {
        endpoint: [{"name": each.name[:LONGEST_NAME], "share": each.share, "set": each.of(endpoint)} for each in cases]
        for endpoint in (requests if 0 < len(cases) <= MOST_SPECTRUM_CASES else ())
    }
    row = {
        "id": stage.stage.id,
        "name": ", ".join(dict.fromkeys(helix.stage.name for helix in helices_of(stage))),
        "helices": [helix.stage.id for helix in helices_of(stage)] if pair.twin else None,
        "pinion": stage.gears[0].id,
        "wheel": stage.gears[1].id,
        "driver": None if stage.driver is None else stage.pair.gears[stage.driver].id,
        "hand": stage.fields.get("gears.hand"),
        "requests": requests,
        "cases": [{"name": case.name, "share": case.share, "overrides": case.of(SCUFFING)} for case in cases],
        "spectra": spectra,
        "missing": _rows(stage.missing.values()),
        "assumed": _rows(stage.assumed.values()),
    }
    return row, stage


def _draft_of(pair: Pair, flow: PowerFlow, pinion: int | None = None) -> StageDraft:
    stage = StageDraft(pair, flow, pinion)
    stage.fill()
    add_lubrication(stage)
    add_modifications(stage)
    return stage if pair.twin is None else joined(stage, _draft_of(pair.twin, flow, stage.order[0]))


def _described_by(stage: StageDraft) -> Iterator[Component]:
    """Yield the components that describe a stage."""
    model = stage.reading.model
    helices = helices_of(stage)
    yield from (helix.stage for helix in helices)
    for place, shaft in enumerate(stage.shafts):
        for helix in helices:
            yield helix.gears[place]
            yield from helix.data_of(helix.gears[place])
            for flank in helix.flanks(place).values():
                yield flank
                yield from modifications_of(helix.reading, flank)
            yield from filter(None, (helix.tool(place), helix.material(place)))
        yield shaft
        yield from (part for part in model.parts_of(shaft.id) if part.type in table.ON_SHAFTS)
        yield from bearings_of(stage, shaft)
    yield from filter(None, (stage.lubricant, model.first("gear_casing"), model.first("gear_unit")))


class _StageCase(NamedTuple):
    """A load case of a stage. `changes` maps fields of the draft to the values of these fields in this load case."""

    name: str
    share: float
    changes: dict[str, Any]

    def of(self, endpoint: str) -> dict[str, Any]:
        """Return the changes as fields of the request of the calculation `endpoint`."""
        general_last = sorted(self.changes, key=lambda path: path != table.SCUFFING_FACTOR, reverse=True)
        places = {path: READABLE[endpoint].path(path) for path in general_last}
        return {place: rounded(self.changes[path]) for path, place in places.items() if place is not None}


def _cases(stage: StageDraft, pair: Pair, flows: list[PowerFlow], *, is_train: bool) -> list[_StageCase]:
    """Return the load cases of a stage. A load case changes torque and speed, and it may change further inputs."""
    cases = []
    shares, reason = _shares([flow.reading for flow in flows])
    for flow, share in zip(flows, shares, strict=True):
        case = flow.reading.case
        directions = {flow.direction(pair), stage.flow.direction(pair)} - {None}
        if len(directions) > 1:
            message = (
                f"in the load case {case.name[:40]}, torque or speed has another direction than in the request; the "
                "case is calculated with the driving gear, the rotation and the loaded flanks of the request"
            )
            flow.reading.find("other_direction", pair.stage, None, message)
        changes: dict[str, Any] = stage.load(flow)
        own = _draft_of(pair, flow, stage.order[0])
        if is_train:
            add_drive_train(own)
        for path, value in own.fields.items():
            component, attribute = own.origins.get(path, (None, None))
            is_stated = component is not None and attribute is not None and flow.reading.says(component, attribute)
            if path.startswith(("modifications.", "operation.rotation")) and not is_stated:
                continue  # of the other flanks, if the load has another direction
            if path not in changes and (is_stated or stage.fields.get(path) != value):
                changes |= dict(_differences(path, value, stage.fields.get(path)))
        cases.append(_StageCase(case.name, rounded(share), changes))
    if reason:
        stage.note("cases", None, reason)
    return cases


def _differences(path: str, value: Any, base: Any) -> Iterator[tuple[str, Any]]:
    """Yield the paths below `path` at which a value of a load case differs from the model's, and their values."""
    if isinstance(value, list) and isinstance(base, list):
        for index, (own, other) in enumerate(zip(value, base, strict=False)):
            yield from _differences(f"{path}.{index}", own, other) if own != other else ()
    elif isinstance(value, dict) and isinstance(base, dict):
        for name, own in value.items():
            yield from _differences(f"{path}.{name}", own, base.get(name)) if own != base.get(name) else ()
    else:
        yield path, value


def _rows(models: Iterable[BaseModel]) -> list[dict[str, Any]]:
    return [model.model_dump() for model in models]


def _shares(readings: list[Reading]) -> tuple[list[float], str | None]:
    """Return the fraction of the operating time that each load case takes, and a remark.

    The remark states the source of the fractions. The remark is None if the fractions are stated by an attribute of the
    standard, or if there are no load cases.
    """
    if not readings:
        return [], None
    unit = readings[0].model.first("gear_unit")
    cases = (reading.case for reading in readings)
    stated = {name for case in cases for attributes in case.attributes.values() for name in attributes}
    own = sorted(name for name in stated if name.endswith("_fraction") and name not in SHARES)
    for name, size in (SHARES | dict.fromkeys(own, "")).items() if unit else ():
        values = [reading.number(unit, name, size) for reading in readings]
        valid = [value for value in values if value is not None and value >= 0.0]
        if len(valid) == len(values) and sum(valid) > 0.0:
            reason = f"the shares are taken from the attribute {name}, which is not part of the standard"
            return [value / sum(valid) for value in valid], reason if name in own else None
    equal = [1.0 / len(readings)] * len(readings)
    return equal, "the file does not state the shares of the load cases; equal shares are used"


def _check_relations(reading: Reading) -> None:
    """Record a finding for each relation to an absent component, and for each assembly that contains itself."""
    model = reading.model
    parents: dict[int, int] = {}
    for relation in model.relations:
        absent = [id_ for _, id_ in relation.parts if id_ not in model.components]
        if absent:
            message = (
                f"a relation of type {relation.type[:40]} names component {absent[0]}, but the file has no such "
                "component"
            )
            reading.find("relation", None, None, message)
        whole, part = relation.part("assembly"), relation.part("part")
        if relation.type == "assembly" and whole is not None and part is not None:
            parents[part] = whole
    done: set[int] = set()
    for start in parents:
        path: dict[int, None] = {}
        here = start
        while here in parents and here not in path and here not in done:
            path[here] = None
            here = parents[here]
        if here in path:
            reading.find("cycle", model.components.get(here), None, "an assembly in the file contains itself")
        done.update(path)
