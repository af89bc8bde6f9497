"""Conversion of rows into CSV. Spreadsheets do not interpret the cells of this CSV as formulas."""

import csv
import re
from collections.abc import Iterable
from io import StringIO
from typing import Any

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
