"""python -m benchmarks.pages: time and size of a page and a report of one example each, and a worker's memory."""

import gzip
import resource
import statistics
import time
from collections.abc import Callable

from app.calculations import CALCULATIONS
from app.library import examples
from app.pages import views
from app.pages.query import pairs_of
from app.pages.templating import page_path

REPEATS = 7


def main() -> None:
    """Print a line a calculation: form alone, solved page, page of a kept answer, report."""
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print("| page | form, ms | solved, ms | kept, ms | report, ms | page, KiB | compressed, KiB |")
    print("|---|---|---|---|---|---|---|")
    for calculation in CALCULATIONS:
        example = next(each for each in examples().values() if each.endpoint == calculation.path)
        path, pairs = page_path(calculation), pairs_of(example.request)
        shown = views.page(views.Asked(path, pairs))
        kept = views.Asked(path, pairs, {}, shown.fresh)
        times = [
            _milliseconds(lambda path=path: views.page(views.Asked(path, []))),
            _milliseconds(lambda path=path, pairs=pairs: views.page(views.Asked(path, pairs))),
            _milliseconds(lambda kept=kept: views.page(kept)),
            _milliseconds(lambda kept=kept: views.report(kept, "http://localhost")),
        ]
        sizes = [len(shown.content) // 1024, len(gzip.compress(shown.content, 4)) // 1024]
        print(f"| {path} | " + " | ".join(f"{value:.0f}" for value in (*times, *sizes)) + " |")
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(f"\nmemory of the process: {before // 1024} MiB before, at most {after // 1024} MiB")


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
