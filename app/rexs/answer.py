"""What a worker makes from the file of a gear unit: the answer of /v1/rexs, a page, or the file with added results."""

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel

from app.calculations import BY_PATH
from app.errors import Unprocessable
from app.evaluate import evaluate, refuse_endless
from app.pages.cases import REFUSED, Asked, faults_of, solved
from app.pages.overview import endpoint_of, stage_cases, unit_page, with_common
from app.pages.pair_path import SCUFFING, TRAIN
from app.pages.query import Pairs
from app.rexs import table
from app.rexs.document import Document, File, packed, read, with_attributes
from app.rexs.model import Attribute
from app.rexs.reading import AssumedValue, Fault, MissingValue, Unused
from app.rexs.unit import gear_unit
from app.schema.fields import value_at
from app.schema.quantities import Output
from app.schema.reading import content_of, validated

PATH = "/v1/rexs"


class Shaft(BaseModel):
    """A shaft of the unit."""

    id: Annotated[int, Output("component in the file")]
    name: Annotated[str, Output("its name there")]


class Case(BaseModel):
    """A case of the load spectrum."""

    name: Annotated[str, Output("name in the file")]
    share: Annotated[float, Output("share of the operating time")]
    overrides: Annotated[dict[str, float | str], Output("its changes of the request of /v1/scuffing, by dotted path")]


class SpectrumCase(BaseModel):
    """A case of the load spectrum, in the form that /v1/spectrum takes."""

    name: Annotated[str, Output("name in the file")]
    share: Annotated[float, Output("share of the operating time")]
    set: Annotated[dict[str, float | str], Output("its changes of the request of the endpoint, by dotted path")]


class Stage(BaseModel):
    """A cylindrical gear stage with requests that are ready to send."""

    id: Annotated[int, Output("component in the file")]
    name: Annotated[str, Output("its name there")]
    helices: Annotated[
        list[int] | None,
        Output("the two stages of the file that are the helices of double-helical gears, in the order of Z; else null"),
    ]
    pinion: Annotated[
        int, Output("pinion of the requests: the driving gear, or the smaller gear if no gear is known to drive")
    ]
    wheel: Annotated[int, Output("the other gear")]
    driver: Annotated[int | None, Output("driving gear; null if power and speed do not follow from the file")]
    hand: Annotated[str | None, Output("hand of the pinion's helix; of double-helical gears, of that at the lower Z")]
    requests: Annotated[dict[str, dict[str, Any]], Output("requests by the address of their endpoint")]
    cases: Annotated[list[Case], Output("load spectrum of the file")]
    spectra: Annotated[
        dict[str, list[SpectrumCase]], Output("the same in the form of `cases` of /v1/spectrum, by endpoint")
    ]
    missing: Annotated[list[MissingValue], Output("fields that have to be filled in")]
    assumed: Annotated[list[AssumedValue], Output("values used for fields that the file does not give")]
    ignored: Annotated[list[Unused], Output("attributes that are not used")]


class GearUnit(BaseModel):
    """A gear unit as read from a file; nothing is calculated."""

    version: Annotated[str, Output("version of REXS that the file states")]
    application: Annotated[str, Output("program that wrote the file")]
    name: Annotated[str, Output("name of the unit")]
    shafts: Annotated[list[Shaft], Output("shafts")]
    stages: Annotated[list[Stage], Output("stages")]
    findings: Annotated[list[Fault], Output("faults of the file")]


def of_file(path: str, function: Callable[..., Any], *arguments: Any) -> Any:
    """Call `function` with the content of an uploaded file, which is read by the worker that needs it."""
    return function(Path(path).read_bytes(), *arguments)


def unit_of(content: bytes, most_bytes: int) -> dict[str, Any]:
    """Return the answer of /v1/rexs. Raises Unprocessable if the file is not a readable REXS file."""
    return gear_unit(read(content, most_bytes).model)


def unit_json(content: bytes, most_bytes: int) -> bytes:
    """Return the answer of /v1/rexs as JSON."""
    return json.dumps(unit_of(content, most_bytes), allow_nan=False, ensure_ascii=False).encode()


def unit_html(unit: bytes, root: str, *arguments: Any) -> bytes:
    """Return the page of a unit from the answer of /v1/rexs; `arguments` as those of `unit_page`."""
    return unit_page(root, json.loads(unit), *arguments).encode()


def cases_of(unit: bytes, common: Pairs) -> list[tuple[list[int], Asked]]:
    """Return, for every stage, its ids in the file and the case that is calculated, with what all stages share."""
    return stage_cases(with_common(json.loads(unit), common))


def with_results(content: bytes, most_bytes: int, stage: int, request: bytes | None, deadline_s: float) -> File:
    """Calculate a stage, and return the file with the results of the stage.

    Of double-helical gears, `stage` is either of their two stages, and both get results.
    `request` is the request that the user edited. If `request` is None, the request is made from the file. It is then a
    drive-train request if the file describes a drive train, and otherwise a request of /v1/scuffing.

    Raises Unprocessable if the file is not readable or does not contain the stage. Raises the errors of the endpoint if
    the request is not valid.
    """
    document = read(content, most_bytes)
    rows = ((row, row["helices"] or [row["id"]]) for row in gear_unit(document.model)["stages"])
    row, helices = next(((row, helices) for row, helices in rows if stage in helices), (None, []))
    if row is None:
        raise Unprocessable("unknown_stage", f"the file has no stage {stage} that can be calculated", None)
    if request is None:
        endpoint = endpoint_of(row)
        request = json.dumps(row["requests"][endpoint]).encode()
    else:
        endpoint = TRAIN if b'"pinion_shaft"' in request else SCUFFING
    calculation = BY_PATH[endpoint]
    inputs = validated(calculation.request, content_of(request))
    refuse_endless(calculation, inputs, deadline_s)
    answer = evaluate(calculation, inputs).model_dump(mode="json", exclude_unset=True)
    return packed(with_answer(document, helices, endpoint, answer), most_bytes)


def with_all_results(content: bytes, most_bytes: int, cases: Sequence[tuple[Sequence[int], Asked]]) -> File:
    """Return the file with the results of all stages, whose answers are kept with the cases.

    A stage that cannot be calculated gets the reason as its status. Raises Unprocessable if no stage can be calculated.
    """
    document, done, reasons = read(content, most_bytes), False, list[str]()
    for stages, asked in cases:
        try:
            case = solved(asked.calculation, asked.pairs, asked.kept, "summary")
        except REFUSED as error:
            reasons.append(faults_of(error, asked.calculation)[0].message)
            refused = Attribute(f"{table.CUSTOM}status", "none", f"refused: {reasons[-1]}")
            for stage in stages:
                document = document._replace(file=with_attributes(document.file, stage, [refused]))
            continue
        answer = case.response.model_dump(mode="json", exclude_unset=True)
        document = document._replace(file=with_answer(document, stages, asked.calculation.path, answer))
        done = True
    if not done:
        reason = f": {reasons[0]}" if reasons else ""
        raise Unprocessable("nothing_calculated", f"no stage of the file can be calculated{reason}", None)
    return packed(document.file, most_bytes)


def with_answer(document: Document, stages: Sequence[int], endpoint: str, answer: dict[str, Any]) -> File:
    """Return the file with new attributes of the stage, or of both stages of double-helical gears in the order of Z.

    Each stage gets the results of its helix; those of the whole unit, such as its losses, are written to the first
    stage only. An answer of /v1/scuffing is that of the more loaded helix, and is written to both.
    """
    major, file = int(document.model.version.split(".")[0]), document.file
    helices = answer.get("helices") or ()
    for place, stage in enumerate(stages):
        own, written = helices[place] if helices else answer, []
        for path, name, unit in BY_PATH[endpoint].words.to_file:
            is_own = path.partition(".")[0] in own
            value = value_at(own if is_own else answer, path) if is_own or place == 0 else None
            if value is not None:
                custom = major < table.STANDARD_FROM.get(name, major + 1)
                written.append(Attribute(f"{table.CUSTOM if custom else ''}{name}", unit, value))
        written += [Attribute(f"{table.CUSTOM}{name}", "none", answer[name]) for name in ("status", "case")]
        file = with_attributes(file, stage, written)
    return file
