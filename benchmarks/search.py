"""Check random cases against the invariants of the tests for a given time.

Run from the project's root: python -m benchmarks.search. Each run has a new seed unless --seed gives one. The search is
not part of CI, because CI must not fail by chance. Every case that fails in a search becomes a fixed case of the tests.
"""

import argparse
import time
import traceback
from collections import Counter
from collections.abc import Callable
from secrets import randbits

import numpy as np

from tests.support import coupling_checks, flanks, modified_pairs, pumping_cases

Check = Callable[[np.random.Generator], object]

CHECKS: dict[str, Check] = {
    **{f"coupling: {check.__name__}": check for check in coupling_checks.CHECKS},
    **{f"flank: {check.__name__}": check for check in flanks.SEARCHES},
    "pumping: check_books": pumping_cases.check_books,
    "pumping: check_resolution": pumping_cases.check_resolution,
    "pumping: check_no_jump": pumping_cases.check_no_jump,
    "path: search_paths": modified_pairs.search_paths,
}


def main() -> None:
    """Run the selected checks on random cases until the time is up, and print the numbers of cases and failures.

    The exit status is 1 if a check has failed, otherwise 0.
    """
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--minutes", type=float, default=60.0)
    options.add_argument("--seed", type=int, default=None, help="repeat a search")
    options.add_argument("--only", default="", help="checks whose name contains this")
    given = options.parse_args()
    seed = randbits(32) if given.seed is None else given.seed
    print(f"seed {seed}")
    checks = {name: check for name, check in CHECKS.items() if given.only in name}
    counts = search(checks, seed, 60.0 * given.minutes)
    print("\n| check | cases | failures |\n|---|---|---|")
    for name in checks:
        print(f"| {name} | {counts[name, 'cases']} | {counts[name, 'failures']} |")
    raise SystemExit(any(count for (_, kind), count in counts.items() if kind == "failures"))


def search(checks: dict[str, Check], seed: int, seconds: float) -> Counter[tuple[str, str]]:
    """Run checks on random cases for the given time, and return the numbers of cases and failures of each check.

    The next check is always the check that has used the least time so far.
    """
    counts: Counter[tuple[str, str]] = Counter()
    spent = dict.fromkeys(checks, 0.0)
    while sum(spent.values()) < seconds:
        name = min(spent, key=spent.__getitem__)
        started = time.perf_counter()
        number = counts[name, "cases"]
        try:
            checks[name](np.random.default_rng([seed, sum(name.encode()), number]))
        except Exception:  # noqa: BLE001  an exception is a finding like any other
            counts[name, "failures"] += 1
            print(f"\n{name}: seed {seed}, case {number}\n{traceback.format_exc(limit=-3)}", flush=True)
        counts[name, "cases"] += 1
        spent[name] += time.perf_counter() - started
    return counts


if __name__ == "__main__":
    main()
