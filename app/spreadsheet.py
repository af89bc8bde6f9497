"""Tables: rows as CSV, whose cells spreadsheets do not interpret as formulas, and studies as tables of pandas."""

import csv
import re
from collections.abc import Iterable
from io import StringIO
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pandas import DataFrame

FORMULA_SIGNS = r"=+\-@\t\r\n"
# A cell begins at the start of the text, and after a separator of lists, at which some spreadsheets split it.
_STARTS = re.compile(rf"(^|[;\t]\s*)([{FORMULA_SIGNS}])")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)  # a number with a sign is not a formula


def csv_of(rows: Iterable[Iterable[Any]], digits: int | None = None) -> bytes:
    """Return rows as comma-separated values.

    None becomes an empty cell. Floats are written with `digits` significant digits, or with all digits if `digits` is
    None.
    """
    text = StringIO(newline="")
    csv.writer(text).writerows([_cell(cell, digits) for cell in row] for row in rows)
    return text.getvalue().encode()


def _cell(value: Any, digits: int | None) -> Any:
    """Return a value as a cell that spreadsheets do not interpret as a formula."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and digits is not None:
        return f"{value:.{digits}g}"
    if isinstance(value, str) and not _NUMBER.fullmatch(value):
        return _STARTS.sub(r"\1'\2", value)
    return value


def frame_of(header: dict[str, Any], results: list[dict[str, Any]], end: dict[str, Any]) -> "DataFrame":
    """Return a study as a table with a row per point, per result of another kind, or per load case of a spectrum."""
    from pandas import DataFrame, json_normalize  # noqa: PLC0415  only tables need it

    if not results:
        return json_normalize(end.get("cases", []))
    if "axes" not in header:
        return DataFrame(results)
    outputs = [column["path"] for column in header["outputs"]]
    points = [line for line in results if line["type"] == "point"]
    rows = [
        {
            **_inputs(header["axes"], line["at"]),
            **dict(zip(outputs, line["out"], strict=True)),
            "status": line["status"],
        }
        for line in points
    ]
    return DataFrame(rows, index=[line["index"] for line in points])


def _inputs(axes: list[dict[str, Any]], at: Any) -> dict[str, Any]:
    """Return the varied inputs of a point by their paths; the fields of one axis have one value, or one each."""
    if isinstance(at, dict):
        return at
    inputs: dict[str, Any] = {}
    for axis, value in zip(axes, at, strict=True):
        paths = axis["path"] if isinstance(axis["path"], list) else [axis["path"]]
        inputs |= dict(zip(paths, value if isinstance(value, list) else [value] * len(paths), strict=True))
    return inputs
