"""python -m benchmarks.pages: processor time and size of a page of one example each, its figures and its report."""

import gzip
import resource
import statistics
import time
from collections.abc import Callable
from contextlib import suppress

from app.calculations import CALCULATIONS
from app.errors import Unprocessable
from app.examples import examples
from app.pages import views
from app.pages.cases import Asked, solved
from app.pages.query import pairs_of
from app.pages.templating import page_path

REPEATS = 5


def main() -> None:
    """Print a line a calculation: form alone, answer, page beyond its answer, its figures in all and the slowest."""
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(
        "| page | form, ms | answer, ms | page, ms | figures, ms | slowest | report, ms | page, KiB | compressed, KiB |"
    )
    print("|---|---|---|---|---|---|---|---|---|")
    for calculation in CALCULATIONS:
        example = next(each for each in examples().values() if each.endpoint == calculation.path)
        path, pairs = page_path(calculation), pairs_of(example.request)
        shown = views.page(Asked(path, pairs))
        kept = Asked(path, pairs, {}, *shown.keep.values())
        times = [
            _milliseconds(lambda path=path: views.page(Asked(path, []))),
            _milliseconds(lambda calculation=calculation, pairs=pairs: solved(calculation, pairs, None)),
            _milliseconds(lambda kept=kept: views.page(kept)),
        ]
        drawn = {
            each.name: _milliseconds(lambda kept=kept, name=each.name: _draw(kept, name))
            for each in calculation.figures
        }
        slowest = max(drawn, key=drawn.__getitem__)
        report = _milliseconds(lambda kept=kept: views.report(kept, "http://localhost"))
        cells = [*(f"{value:.0f}" for value in (*times, sum(drawn.values()))), f"{slowest} {drawn[slowest]:.0f}"]
        cells += [f"{report:.0f}", str(len(shown.content) // 1024), str(len(gzip.compress(shown.content, 4)) // 1024)]
        print(f"| {path} | " + " | ".join(cells) + " |")
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(f"\nmemory of the process: {before // 1024} MiB before, at most {after // 1024} MiB")


def _draw(kept: Asked, name: str) -> None:
    """Draw a figure of a kept answer, if the case has it."""
    with suppress(Unprocessable):
        views.figure(kept, name, "svg")


def _milliseconds(make: Callable[[], object]) -> float:
    """Median CPU time, which neighbours on the machine disturb less."""
    times = []
    for _ in range(REPEATS):
        start = time.process_time()
        make()
        times.append(time.process_time() - start)
    return 1e3 * statistics.median(times)


if __name__ == "__main__":
    main()
