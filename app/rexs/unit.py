"""A gear unit from its file: every stage with ready requests, its load cases, and what is missing, assumed, ignored."""

from collections.abc import Iterable
from itertools import islice
from typing import Any

from app.rexs import drive_train, table
from app.rexs.document import Document
from app.rexs.draft import validated
from app.rexs.model import Component, LoadCase, Model
from app.rexs.power import Flow, Mesh, power_flow
from app.rexs.reading import Reading, rows
from app.rexs.stages import Pair, StageDraft, pairs, related_components, requests_of, shaft_axis

MOST_FINDINGS = 1000  # that an answer lists; who wrote the file sees the pattern earlier
MOST_STAGES = 50  # chosen: far beyond any unit
MOST_CASES = 200  # of a spectrum in the file that are read
LONGEST_NAME, MOST_SPECTRUM_CASES = 100, 100  # of /v1/spectrum
# Which field of a request a load case sets, where it is not the one of /v1/scuffing.
SPECTRUM_FIELDS: dict[str, dict[str, str]] = {
    "/v1/scuffing/load-distribution": {table.OIL_TEMPERATURE.field: ""},
    "/v1/scuffing": {},
    "/v1/pumping": {
        "load.pinion_torque_n_m": "",
        "load.pinion_speed_rpm": "operation.pinion_speed_rpm",
        table.OIL_TEMPERATURE.field: "",
    },
    "/v1/drive-train": {
        "load.pinion_torque_n_m": "operation.pinion_torque_n_m",
        "load.pinion_speed_rpm": "operation.pinion_speed_rpm",
    },
}
SHARES = (("operating_time_fraction", ""), ("operating_time", "h"))


def gear_unit(document: Document) -> dict[str, Any]:
    """The answer of /v1/rexs: version, shafts, stages with requests and cases, findings."""
    model = document.model
    reading = Reading(model)
    _check_relations(reading)
    found = list(islice(pairs(reading), MOST_STAGES + 1))
    if len(found) > MOST_STAGES:
        reading.find(
            "too_many_stages", None, None, f"the unit has more than {MOST_STAGES} stages; the first ones are read"
        )
        del found[MOST_STAGES:]
    unit = _Unit(reading, found)
    stages = [unit.stage(pair) for pair in found]
    findings = list(reading.findings)
    return {
        "version": model.version,
        "application": model.application,
        "name": _name(model),
        "shafts": [{"id": each.id, "name": each.name} for each in model.components.values() if each.type == "shaft"],
        "stages": stages,
        "findings": rows(findings[:MOST_FINDINGS]),
    }


class _Unit:
    """What the stages of one unit share: senses of the axes, joined shafts, speeds and torques of every case."""

    def __init__(self, reading: Reading, found: list[Pair]) -> None:
        self._reading = reading
        self._meshes = [pair.mesh for pair in found]
        self._senses = _senses(reading)
        self._joined = list(_joined(reading.model))
        self._opened = set(_opened(reading.model, {mesh.stage for mesh in self._meshes}))
        cases = reading.model.load_cases[:MOST_CASES]
        if len(cases) < len(reading.model.load_cases):
            reading.find("too_many_cases", None, None, f"the first {MOST_CASES} load cases are read")
        if len(cases) > MOST_SPECTRUM_CASES:
            message = f"a load spectrum of more than {MOST_SPECTRUM_CASES} load cases cannot be asked as it stands"
            reading.find("too_many_cases", None, None, message)
        self._base = self._flow(None)
        self._flows = [(case, self._flow(case)) for case in cases]

    def _flow(self, case: LoadCase | None) -> Flow:
        return power_flow(self._reading, self._meshes, self._joined, self._opened, self._senses, case)

    def stage(self, pair: Pair) -> dict[str, Any]:
        """One stage of the answer."""
        mesh = pair.mesh
        flow, first = self._flow_of(mesh)
        stage = StageDraft(self._reading, pair, flow, self._senses, first)
        draft = stage.fill()
        if first is not None:
            for path in ("load.pinion_torque_n_m", "load.pinion_speed_rpm", table.OIL_TEMPERATURE.field):
                if path in draft.fields:
                    draft.note(path, draft.fields[path], f"of the load case {first.name}; the model itself states none")
        requests = {endpoint: validated(endpoint, draft, own) for endpoint, own in requests_of(stage).items()}
        if drive_train.add_drive_train(stage, draft):
            requests["/v1/drive-train"] = validated("/v1/drive-train", draft, drive_train.paths(draft))
        cases = list(self._cases(stage))
        return {
            "id": pair.stage.id,
            "name": pair.stage.name,
            "pinion": stage.gears[0].id,
            "wheel": stage.gears[1].id,
            "driver": None if stage.driver is None else pair.gears[stage.driver].id,
            "hand": draft.fields.get("gears.hand"),
            "requests": requests,
            "cases": cases,
            "spectra": {endpoint: _spectrum(endpoint, cases) for endpoint in requests}
            if 0 < len(cases) <= MOST_SPECTRUM_CASES
            else {},
            "missing": rows(draft.missing.values()),
            "assumed": rows(draft.assumed.values()),
            "ignored": rows(self._reading.ignored(related_components(stage), table.IGNORED)),
        }

    def _flow_of(self, mesh: Mesh) -> tuple[Flow, LoadCase | None]:
        """The base model's flow of power, or where it states none that of the first load case, and the case."""
        if mesh.stage in self._base.mesh_torque and mesh.shafts[0] in self._base.speed:
            return self._base, None
        for case, flow in self._flows:
            if mesh.stage in flow.mesh_torque and mesh.shafts[0] in flow.speed:
                return flow, case
        return self._base, None

    def _cases(self, stage: StageDraft) -> Iterable[dict[str, Any]]:
        """The load spectrum as overrides of the stage's request."""
        shares, reason = _shares(self._reading, [case for case, _ in self._flows])
        for (case, flow), share in zip(self._flows, shares, strict=True):
            overrides: dict[str, float] = {}
            torques = flow.mesh_torque.get(stage.pair.stage.id)
            speed = flow.speed.get(stage.shafts[0].id)
            if torques is not None:
                overrides["load.pinion_torque_n_m"] = abs(torques[stage.order[0]])
            if speed is not None:
                overrides["load.pinion_speed_rpm"] = abs(speed)
            for origin in (stage.pair.stage, self._reading.model.casing):
                row = table.OIL_TEMPERATURE
                value = self._reading.number(origin, row.attributes, row.unit, case=case) if origin else None
                if value is not None:
                    overrides[row.field] = value
                    break
            yield {"name": case.name, "share": share, "overrides": overrides}
        if reason:
            stage.draft.note("cases", None, reason)


def _spectrum(endpoint: str, cases: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The cases as /v1/spectrum takes them for an endpoint; what its request does not know is left out."""
    own = SPECTRUM_FIELDS[endpoint]
    return [
        {
            "name": case["name"][:LONGEST_NAME],
            "share": case["share"],
            "set": {own.get(path, path): value for path, value in case["overrides"].items() if own.get(path, path)},
        }
        for case in cases
    ]


def _shares(reading: Reading, cases: list[LoadCase]) -> tuple[list[float], str | None]:
    """Share of the operating time of each load case, and how it was found where the file leaves that open."""
    if not cases:
        return [], None
    unit = next((each for each in reading.model.components.values() if each.type == "gear_unit"), None)
    names = [*SHARES]
    own = sorted(
        {name for case in cases for each in case.attributes.values() for name in each if name.endswith("_fraction")}
    )
    names += [(name, "") for name in own if (name, "") not in SHARES]
    for name, size in names:
        values = [reading.number(unit, name, size, case=case) for case in cases] if unit else []
        known = [value for value in values if value is not None and value >= 0.0]
        if values and len(known) == len(values) and sum(known) > 0.0:
            reason = f"shares from the attribute {name}, which is not of the standard" if name in own else None
            return [value / sum(known) for value in known], reason
    return [1.0 / len(cases)] * len(cases), "the file states no shares of the load cases: equal shares"


def _senses(reading: Reading) -> dict[int, float]:
    """+1 or -1 for each shaft: whether its u axis points as that of the first one."""
    senses: dict[int, float] = {}
    base = None
    for shaft in reading.model.components.values():
        if shaft.type == "shaft" and (axis := shaft_axis(reading, shaft)) is not None:
            base = base or axis.direction
            cosine = sum(a * b for a, b in zip(axis.direction, base, strict=True))
            senses[shaft.id] = 1.0 if cosine >= 0.0 else -1.0
    return senses


def _joined(model: Model) -> Iterable[tuple[int, int]]:
    """Shafts that a coupling makes turn as one."""
    for relation in model.relations:
        parts = dict(relation.parts)
        coupling = model.components.get(parts.get("assembly", -1))
        if relation.type == "side" and coupling is not None and coupling.type in {"coupling", "fixed_coupling"}:
            ends = [model.components.get(parts.get(role, -1)) for role in ("inner_part", "outer_part")]
            if ends[0] is not None and ends[1] is not None and ends[0].type == ends[1].type == "shaft":
                yield ends[0].id, ends[1].id


def _opened(model: Model, modelled: set[int]) -> Iterable[int]:
    """Shafts whose gears mesh in stages that are not modelled: what passes there is not known."""
    for relation in model.relations:
        if relation.type == "stage" and relation.part("stage") not in modelled:
            for role, part in relation.parts:
                shaft = model.whole_of(part, "shaft") if role != "stage" else None
                if shaft is not None:
                    yield shaft.id


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


def _name(model: Model) -> str:
    unit: Component | None = next((each for each in model.components.values() if each.type == "gear_unit"), None)
    return unit.name if unit else ""
