"""Print the numbers of papers, books and standards beside the computed numbers.

Run from the project's root: python -m benchmarks.papers
"""

from benchmarks.published import STATEMENTS, Row

COLUMNS = ("statement", "source", "basis", "expected", "computed", "unit", "deviation", "remark")


def main() -> None:
    """Print one table of published and computed numbers per model."""
    for model, statements in STATEMENTS.items():
        print(f"\n## {model}\n")
        print("| " + " | ".join(COLUMNS) + " |")
        print("|" + "---|" * len(COLUMNS))
        for statement in statements:
            print(_line(statement.row()))


def _line(row: Row) -> str:
    deviation = "" if row.deviation is None else f"{row.deviation:+.2%}"
    cells = (row.statement, row.source, row.basis, row.expected, f"{row.computed:.5g}", row.unit, deviation, row.remark)
    return "| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |"


if __name__ == "__main__":
    main()
