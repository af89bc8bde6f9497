"""A gear unit from its file: every stage with ready requests, its load cases, and what is missing, assumed, ignored."""

from collections.abc import Iterable, Iterator
from itertools import islice
from typing import Any

from pydantic import BaseModel

from app.rexs import table
from app.rexs.drive_train import add_drive_train
from app.rexs.model import Component, LoadCase, Model
from app.rexs.modifications import Modifications, modifications_of
from app.rexs.power import Flow, Pair, Train
from app.rexs.reading import MESH, SECTIONS, Reading, path_in
from app.rexs.stages import SPEED, TORQUE, StageDraft, pairs

MOST_FINDINGS = 1000  # that an answer lists; who wrote the file sees the pattern earlier
MOST_STAGES = 50  # chosen: far beyond any unit
MOST_CASES = 200  # of a spectrum in the file that are read
LONGEST_NAME, MOST_SPECTRUM_CASES = 100, 100  # of /v1/spectrum
SHARES = {"operating_time_fraction": "", "operating_time": "h"}  # attributes and their units


def gear_unit(model: Model) -> dict[str, Any]:
    """The answer of /v1/rexs: version, shafts, stages with requests and cases, findings."""
    reading = Reading(model)
    _check_relations(reading)
    found = list(islice(pairs(reading), MOST_STAGES + 1))
    if len(found) > MOST_STAGES:
        message = f"the unit has more than {MOST_STAGES} stages; the first ones are read"
        reading.find("too_many_stages", None, None, message)
        del found[MOST_STAGES:]
    cases = model.load_cases[:MOST_CASES]
    if len(cases) < len(model.load_cases):
        reading.find("too_many_cases", None, None, f"the first {MOST_CASES} load cases are read")
    if len(cases) > MOST_SPECTRUM_CASES:
        message = f"a load spectrum of more than {MOST_SPECTRUM_CASES} load cases cannot be asked as it stands"
        reading.find("too_many_cases", None, None, message)
    train = Train(reading, found)
    base, flows = train.flow(), [(case, train.flow(case)) for case in cases]
    unit = model.first("gear_unit")
    return {
        "version": model.version,
        "application": model.application,
        "name": unit.name if unit else "",
        "shafts": [{"id": each.id, "name": each.name} for each in model.by_type["shaft"]],
        "stages": [_stage(reading, pair, base, flows) for pair in found],
        "findings": _rows(islice(reading.findings, MOST_FINDINGS)),
    }


def _stage(reading: Reading, pair: Pair, base: Flow, flows: list[tuple[LoadCase, Flow]]) -> dict[str, Any]:
    """One stage of the answer, with the load of the base model, or where it states none of the first load case."""
    stated: list[tuple[LoadCase | None, Flow]] = [(None, base), *flows]
    case, flow = next((each for each in stated if each[1].knows(pair)), stated[0])
    stage = StageDraft(reading, pair, flow, case)
    stage.fill()
    Modifications(stage).fill()
    if case is not None:
        for path in (TORQUE, SPEED, table.OIL_TEMPERATURE.field):
            if path in stage.fields:
                stage.note(path, stage.fields[path], f"of the load case {case.name}; the model itself states none")
    # the mesh first, then the oil
    paths = sorted({**stage.fields, **stage.missing}, key=lambda path: path.partition(".")[0] not in MESH)
    requests = {endpoint: stage.request(endpoint, paths) for endpoint in SECTIONS}
    if add_drive_train(stage):
        requests["/v1/drive-train"] = stage.request("/v1/drive-train", {**stage.fields, **stage.missing})
    cases = _cases(stage, flows)
    askable = 0 < len(cases) <= MOST_SPECTRUM_CASES
    return {
        "id": pair.stage.id,
        "name": pair.stage.name,
        "pinion": stage.gears[0].id,
        "wheel": stage.gears[1].id,
        "driver": None if stage.driver is None else pair.gears[stage.driver].id,
        "hand": stage.fields.get("gears.hand"),
        "requests": requests,
        "cases": cases,
        "spectra": {endpoint: _spectrum(endpoint, cases) for endpoint in requests if askable},
        "missing": _rows(stage.missing.values()),
        "assumed": _rows(stage.assumed.values()),
        "ignored": _rows(reading.ignored(_described_by(stage))),
    }


def _described_by(stage: StageDraft) -> Iterator[Component]:
    """The components that describe the mesh: what they say and nobody asked for is listed as ignored."""
    yield stage.stage
    for place in (0, 1):
        yield stage.gears[place]
        for flank in stage.flanks(place).values():
            yield flank
            yield from modifications_of(stage.reading, flank)
        yield from filter(None, (stage.tool(place), stage.material(place)))
    if stage.lubricant is not None:
        yield stage.lubricant


def _cases(stage: StageDraft, flows: list[tuple[LoadCase, Flow]]) -> list[dict[str, Any]]:
    """The load spectrum as overrides of the stage's request."""
    found, row = [], table.OIL_TEMPERATURE
    shares, reason = _shares(stage.reading, [case for case, _ in flows])
    for (case, flow), share in zip(flows, shares, strict=True):
        overrides = stage.load(flow)
        stated = (stage.reading.number(origin, row, case=case) for origin in stage.oil_origins)
        temperature = next((value for value in stated if value is not None), None)
        if temperature is not None:
            overrides[row.field] = temperature
        found.append({"name": case.name, "share": share, "overrides": overrides})
    if reason:
        stage.note("cases", None, reason)
    return found


def _rows(found: Iterable[BaseModel]) -> list[dict[str, Any]]:
    return [each.model_dump() for each in found]


def _spectrum(endpoint: str, cases: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The cases as /v1/spectrum takes them for an endpoint; what its request does not know is left out."""
    spectrum = []
    for case in cases:
        places = {path: path_in(endpoint, path) for path in case["overrides"]}
        changes = {place: case["overrides"][path] for path, place in places.items() if place is not None}
        spectrum.append({"name": case["name"][:LONGEST_NAME], "share": case["share"], "set": changes})
    return spectrum


def _shares(reading: Reading, cases: list[LoadCase]) -> tuple[list[float], str | None]:
    """Share of the operating time of each load case, and how it was found where the file leaves that open."""
    if not cases:
        return [], None
    unit = reading.model.first("gear_unit")
    stated = {name for case in cases for each in case.attributes.values() for name in each}
    own = sorted(name for name in stated if name.endswith("_fraction") and name not in SHARES)
    for name, size in (SHARES | dict.fromkeys(own, "")).items() if unit else ():
        values = [reading.number(unit, name, size, case) for case in cases]
        known = [value for value in values if value is not None and value >= 0.0]
        if len(known) == len(values) and sum(known) > 0.0:
            reason = f"shares from the attribute {name}, which is not of the standard" if name in own else None
            return [value / sum(known) for value in known], reason
    return [1.0 / len(cases)] * len(cases), "the file states no shares of the load cases: equal shares"


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
