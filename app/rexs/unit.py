"""A gear unit from its file: every stage with ready requests, its load cases, and what is missing, assumed, ignored."""

from collections.abc import Iterable, Iterator
from itertools import chain, islice
from typing import Any, NamedTuple

from pydantic import BaseModel

from app.rexs import table
from app.rexs.drive_train import add_drive_train, bearings_of
from app.rexs.lubrication import Lubrication
from app.rexs.model import Component, Model
from app.rexs.modifications import Modifications, modifications_of
from app.rexs.power import Flow, Pair, Train
from app.rexs.reading import MESH, SCUFFING, SECTIONS, Reading, path_in, rounded
from app.rexs.stages import SPEED, TORQUE, StageDraft, pairs

MOST_FINDINGS = 1000  # that an answer lists; who wrote the file sees the pattern earlier
MOST_STAGES = 50  # chosen: far beyond any unit
MOST_CASES = 200  # of a spectrum in the file that are read
MOST_DRAFTS = 2000  # stages times load cases, at 2 ms each
LONGEST_NAME, MOST_SPECTRUM_CASES = 100, 100  # of /v1/spectrum
MOST_IGNORED = 2000  # of a stage
SHARES = {"operating_time_fraction": "", "load_duration_fraction": "", "operating_time": "h", "load_duration": "h"}
"""Attributes and their units."""


def gear_unit(model: Model) -> dict[str, Any]:
    """The answer of /v1/rexs: version, shafts, stages with requests and cases, findings."""
    reading = Reading(model)
    _check_relations(reading)
    found = list(islice(pairs(reading), MOST_STAGES + 1))
    if len(found) > MOST_STAGES:
        message = f"the unit has more than {MOST_STAGES} stages; the first ones are read"
        reading.find("too_many_stages", None, None, message)
        del found[MOST_STAGES:]
    cases = model.load_cases[: min(MOST_CASES, MOST_DRAFTS // max(len(found), 1))]
    if len(cases) < len(model.load_cases):
        reading.find("too_many_cases", None, None, f"the first {len(cases)} load cases are read")
    if len(cases) > MOST_SPECTRUM_CASES:
        message = f"a load spectrum of more than {MOST_SPECTRUM_CASES} load cases cannot be asked as it stands"
        reading.find("too_many_cases", None, None, message)
    train = Train(reading, found)
    base, flows = train.flow(), [train.flow(case) for case in cases]
    unit = model.first("gear_unit")
    return {
        "version": model.version,
        "application": model.application,
        "name": unit.name if unit else "",
        "shafts": [{"id": each.id, "name": each.name} for each in model.by_type["shaft"]],
        "stages": _stages(reading, found, base, flows),
        "findings": _rows(islice(reading.findings, MOST_FINDINGS)),
    }


def _stages(reading: Reading, found: list[Pair], base: Flow, flows: list[Flow]) -> list[dict[str, Any]]:
    """The stages of the answer. What a load case says of components of no stage is told with each of them."""
    rows, parts, all_parts = [], [], set[int]()
    for pair in found:
        row, stage = _stage(pair, base, flows)
        rows.append(row)
        parts.append({each.id: each for each in _described_by(stage)})
        all_parts |= parts[-1].keys()
    for row, own in zip(rows, parts, strict=True):
        elsewhere = all_parts - own.keys()
        unused = chain(reading.ignored(own.values()), *(flow.reading.ignored_of_case(elsewhere) for flow in flows))
        row["ignored"] = _rows(islice(unused, MOST_IGNORED))
        if next(unused, None) is not None:
            message = f"more than {MOST_IGNORED} attributes of the stage {row['id']} are not used; the first are listed"
            reading.find("too_many_ignored", None, None, message)
    return rows


def _stage(pair: Pair, base: Flow, flows: list[Flow]) -> tuple[dict[str, Any], StageDraft]:
    """One stage of the answer, with the load of the base model, or where it states none of the first load case."""
    flow = next((each for each in (base, *flows) if each.knows(pair)), base)
    stage = _filled(pair, flow)
    if (case := flow.reading.case) is not None:
        for path in (TORQUE, SPEED, table.OIL_TEMPERATURE.field):
            if path in stage.fields:
                stage.note(path, stage.fields[path], f"of the load case {case.name}; the model itself states none")
    # the mesh first, then the oil
    paths = sorted({**stage.fields, **stage.missing}, key=lambda path: path.partition(".")[0] not in MESH)
    requests = {endpoint: stage.request(endpoint, paths) for endpoint in SECTIONS}
    if add_drive_train(stage):
        requests["/v1/drive-train"] = stage.request("/v1/drive-train", {**stage.fields, **stage.missing})
    cases = _cases(stage, pair, flows)
    askable = 0 < len(cases) <= MOST_SPECTRUM_CASES
    row = {
        "id": pair.stage.id,
        "name": pair.stage.name,
        "pinion": stage.gears[0].id,
        "wheel": stage.gears[1].id,
        "driver": None if stage.driver is None else pair.gears[stage.driver].id,
        "hand": stage.fields.get("gears.hand"),
        "requests": requests,
        "cases": [case.of_scuffing for case in cases],
        "spectra": {endpoint: [case.as_spectrum(endpoint) for case in cases] for endpoint in requests if askable},
        "missing": _rows(stage.missing.values()),
        "assumed": _rows(stage.assumed.values()),
    }
    return row, stage


def _filled(pair: Pair, flow: Flow, pinion: int | None = None) -> StageDraft:
    stage = StageDraft(pair, flow, pinion)
    stage.fill()
    Lubrication(stage).fill()
    Modifications(stage).fill()
    return stage


def _described_by(stage: StageDraft) -> Iterator[Component]:
    """The components that describe the mesh: what they say and nobody asked for is listed as ignored."""
    model = stage.reading.model
    yield stage.stage
    for place, shaft in enumerate(stage.shafts):
        yield stage.gears[place]
        yield from stage.gear_data(place)
        for flank in stage.flanks(place).values():
            yield flank
            yield from modifications_of(stage.reading, flank)
        yield from filter(None, (stage.tool(place), stage.material(place)))
        yield shaft
        yield from (part for part in model.parts_of(shaft.id) if part.type in table.ON_SHAFTS)
        yield from bearings_of(stage, shaft)
    yield from filter(None, (stage.lubricant, model.first("gear_casing"), model.first("gear_unit")))


class _Case(NamedTuple):
    """A load case of a stage: what it changes in the fields of its draft."""

    name: str
    share: float
    changes: dict[str, Any]

    @property
    def of_scuffing(self) -> dict[str, Any]:
        """The case with the fields of the request of /v1/scuffing."""
        return {"name": self.name, "share": self.share, "overrides": self._in(SCUFFING)}

    def as_spectrum(self, endpoint: str) -> dict[str, Any]:
        """The case as /v1/spectrum takes it for an endpoint; what its request does not know is left out."""
        return {"name": self.name[:LONGEST_NAME], "share": self.share, "set": self._in(endpoint)}

    def _in(self, endpoint: str) -> dict[str, Any]:
        general_last = sorted(self.changes, key=lambda path: path != table.SCUFFING_FACTOR, reverse=True)
        places = {path: path_in(endpoint, path) for path in general_last}
        return {place: rounded(self.changes[path]) for path, place in places.items() if place is not None}


def _cases(stage: StageDraft, pair: Pair, flows: list[Flow]) -> list[_Case]:
    """Return the load spectrum: for each load case the changes of torque, speed and the inputs that the case states."""
    found = []
    shares, reason = _shares([flow.reading for flow in flows])
    load_sources = stage.load_sources
    for flow, share in zip(flows, shares, strict=True):
        case = flow.reading.case
        if case is None:
            continue
        changes: dict[str, Any] = stage.load(flow)
        own = _filled(pair, flow, stage.order[0]) if case.attributes.keys() - load_sources else stage
        for path, value in own.fields.items():
            component, attribute = own.origins.get(path, (None, None))
            said = component is not None and attribute is not None and flow.reading.says(component, attribute)
            if path not in changes and (said or stage.fields.get(path) != value):
                changes[path] = value
        found.append(_Case(case.name, rounded(share), changes))
    if reason:
        stage.note("cases", None, reason)
    return found


def _rows(found: Iterable[BaseModel]) -> list[dict[str, Any]]:
    return [each.model_dump() for each in found]


def _shares(readings: list[Reading]) -> tuple[list[float], str | None]:
    """Share of the operating time of each load case, and how it was found where the file leaves that open."""
    if not readings:
        return [], None
    unit = readings[0].model.first("gear_unit")
    cases = [reading.case for reading in readings if reading.case is not None]
    stated = {name for case in cases for each in case.attributes.values() for name in each}
    own = sorted(name for name in stated if name.endswith("_fraction") and name not in SHARES)
    for name, size in (SHARES | dict.fromkeys(own, "")).items() if unit else ():
        values = [reading.number(unit, name, size) for reading in readings]
        known = [value for value in values if value is not None and value >= 0.0]
        if len(known) == len(values) and sum(known) > 0.0:
            reason = f"shares from the attribute {name}, which is not of the standard" if name in own else None
            return [value / sum(known) for value in known], reason
    return [1.0 / len(readings)] * len(readings), "the file states no shares of the load cases: equal shares"


def _check_relations(reading: Reading) -> None:
    """Relations to components that are not there, and assemblies that contain themselves, are findings."""
    model = reading.model
    parents: dict[int, int] = {}
    for relation in model.relations:
        absent = [id_ for _, id_ in relation.parts if id_ not in model.components]
        if absent:
            message = f"a relation of type {relation.type[:40]} names component {absent[0]}, which is not there"
            reading.find("relation", None, None, message)
        whole, part = relation.part("assembly"), relation.part("part")
        if relation.type == "assembly" and whole is not None and part is not None:
            parents[part] = whole
    settled: set[int] = set()
    for start in parents:
        path: dict[int, None] = {}
        here = start
        while here in parents and here not in path and here not in settled:
            path[here] = None
            here = parents[here]
        if here in path:
            reading.find("cycle", model.components.get(here), None, "the assembly contains itself")
        settled.update(path)
