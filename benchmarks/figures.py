"""Time of every figure after its answer is known, and the memory that drawing adds to a process.

Run `python -m benchmarks.figures`. Aims: 250 ms of processor time for each figure, 80 MB.
"""

import time
from pathlib import Path
from typing import Any

from app.calculations import CALCULATIONS, Calculation
from app.evaluate import evaluate
from app.examples import examples
from app.figures.data import Figure, NoFigure

CASES = (
    "pahl-heavily-crowned",
    "pahl-sleeve-orbit",
    "pahl-recommended-crowning",
    "milian-case-1-groove",
    "milian-case-1-choking",
    "xue-pair-1-thermal",
    "xue-line-contact",
)
REPEATS = 5
AIM_MS = 250.0


def resident_mb() -> float:
    """Memory of this process in use."""
    pages = int(Path("/proc/self/statm").read_text("ascii").split()[1])
    return pages * 4096 / 1e6


def built_figures(calculation: Calculation, body: dict[str, Any]) -> list[tuple[str, Figure]]:
    """The data of every figure of a case, by name."""
    request = calculation.request.model_validate({**body, "detail": "fields"})
    answer, figures = evaluate(calculation, request), []
    for declaration in calculation.figures:
        try:
            figures.append((declaration.name, declaration.figure(request, answer)))
        except NoFigure as reason:
            print(f"{declaration.name}: {reason.message}")
    return figures


def main() -> None:
    """Print the table."""
    calculations = {calculation.path: calculation for calculation in CALCULATIONS}
    cases = [examples()[name] for name in CASES]
    figures = [pair for case in cases for pair in built_figures(calculations[case.endpoint], case.request)]
    before, started = resident_mb(), time.perf_counter()
    from app.figures.drawing.image import draw  # noqa: PLC0415  its import is what is measured

    print(f"import {time.perf_counter() - started:.2f} s, {resident_mb() - before:.0f} MB")
    shared = resident_mb()
    draw(figures[0][1], "svg")
    print(f"{'figure':20} {'svg ms':>8} {'png ms':>8} {'kB':>6}   CPU time, the best of {REPEATS}")
    for name, figure in figures:
        times = {each: min(_cpu_ms(lambda: draw(figure, each)) for _ in range(REPEATS)) for each in ("svg", "png")}  # noqa: B023
        late = " over its aim" * (times["svg"] > AIM_MS)
        print(f"{name:20} {times['svg']:8.0f} {times['png']:8.0f} {len(draw(figure, 'svg')) / 1e3:6.0f}{late}")
    by_import, by_drawing = shared - before, resident_mb() - shared
    print(f"memory added: {by_import:.0f} MB by import, which workers share; {by_drawing:.0f} MB by drawing")


def _cpu_ms(function: Any) -> float:
    started = time.process_time()
    function()
    return (time.process_time() - started) * 1e3


if __name__ == "__main__":
    main()
