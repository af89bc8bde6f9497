"""Times of the line contact: isothermal, thermal cold and warm, the grid of contacts, the path of gear pair 1.

Run from the project's root: python -m benchmarks.ehl. Best of repeats with warm kernels unless a row says otherwise;
first-call times and memory come from fresh processes, with the kernels' cache and without. Solvability is counted
over the grid and over random contacts: --seed and --count draw others, --only-rates leaves out all else.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterable
from dataclasses import replace
from math import cos, pi, radians
from statistics import median, quantiles
from time import perf_counter

from solvers.contact.ehl import Contact, LineContactInputs, Model, solve, solve_path, warm_up
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.gears.pair import gear_pair
from tests.line_contacts import POINT, grid_contacts, random_contacts

EYRING = Model()
STIFF = Model(eyring_stress=10e6)
NEWTONIAN = Model(rheology="newtonian")
ISOTHERMAL = Model(thermal=False, rheology="newtonian")
FRESH = """
import json, resource, time
start = time.perf_counter()
from solvers.contact.ehl import warm_up
imported = time.perf_counter()
warm_up()
ready = time.perf_counter()
memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
print(json.dumps([imported - start, ready - imported, memory]))
"""


def path(model: Model, points: int = 50) -> list[LineContactInputs]:
    """Gear pair 1 from A to E at 273 N/mm."""
    pair = gear_pair(GearPairInputs(GearTeeth(23), GearTeeth(30), 3e-3, 20e-3, radians(20.0), radians(9.8)))
    turn = 2000 * pi / 30
    contacts = []
    for k in range(points):
        first = 4.859e-3 + (19.137e-3 - 4.859e-3) * k / (points - 1)
        second = pair.line_of_action - first
        radius = first * second / (pair.line_of_action * cos(pair.base_helix_angle))
        contact = Contact(2.73e5, radius, turn * first, turn * 23 / 30 * second)
        contacts.append(LineContactInputs(contact, model=model))
    return contacts


def times(run: Callable[[], object], repeats: int) -> list[float]:
    """Durations [ms]."""
    durations = []
    for _ in range(repeats):
        start = perf_counter()
        run()
        durations.append((perf_counter() - start) * 1e3)
    return durations


def report(figure: str, measured: str, target: str) -> None:
    """One line of the table."""
    print(f"{figure:58s} {measured:>26s}   {target}")


def single_points() -> None:
    """One contact, from nothing."""
    for name, model, target in (
        ("isothermal Newtonian point, 121 nodes, ms", ISOTHERMAL, "6"),
        ("isothermal Ree-Eyring point, 121 nodes, ms", replace(EYRING, thermal=False), "6"),
        ("thermal Ree-Eyring point A, cold, ms", EYRING, "18"),
        ("thermal Newtonian point A, cold, ms", NEWTONIAN, "34"),
        ("thermal Ree-Eyring point A, 241 nodes, ms", replace(EYRING, nodes=241), "-"),
    ):
        inputs = LineContactInputs(POINT, model=model)
        report(name, f"{min(times(lambda inputs=inputs: solve(inputs), 20)):.1f}", target)  # type: ignore[misc]


def paths() -> None:
    """Fifty points, and what one of them costs beyond the first."""
    for name, model, target in (
        ("Ree-Eyring 5 MPa", EYRING, "0.35"),
        ("Ree-Eyring 10 MPa", STIFF, "0.44"),
        ("Newtonian", NEWTONIAN, "0.70"),
        ("isothermal Ree-Eyring", replace(EYRING, thermal=False), "-"),
    ):
        contacts = path(model)
        whole = min(times(lambda contacts=contacts: solve_path(contacts), 3))  # type: ignore[misc]
        first = min(times(lambda contacts=contacts: solve_path(contacts[:1]), 5))  # type: ignore[misc]
        solved = sum(r.status != "no_solution" for r in solve_path(contacts))
        report(f"path of 50 points, {name}, s (solved)", f"{whole / 1e3:.3f} ({solved}/50)", target)
        report("  a warm point, mean, ms", f"{(whole - first) / 49:.1f}", "6" if model is EYRING else "-")


def many(name: str, contacts: Iterable[LineContactInputs], target: str) -> None:
    """Times, each contact solved once, and how many are solved."""
    durations, solved = [], 0
    for inputs in contacts:
        start = perf_counter()
        solved += solve(inputs).status != "no_solution"
        durations.append((perf_counter() - start) * 1e3)
    tenths = quantiles(durations, n=10)
    report(
        f"{name}: median/p90/max ms, solved",
        f"{median(durations):.1f}/{tenths[-1]:.0f}/{max(durations):.0f}, {solved} of {len(durations)}",
        target,
    )


def fresh_process() -> None:
    """Import, first solves and memory of a worker."""
    with tempfile.TemporaryDirectory() as cache:
        for name, target in (("without", "-"), ("with", "1")):
            environment = {**os.environ, "NUMBA_CACHE_DIR": cache}
            run = subprocess.run([sys.executable, "-c", FRESH], env=environment, capture_output=True, check=True)
            imported, ready, memory = json.loads(run.stdout)
            report(f"import, warm_up {name} kernel cache, s", f"{imported:.2f}, {ready:.2f}", target)
            report(f"  memory of the process {name} cache, MB", f"{memory:.0f}", "-")


def rates(count: int, seed: int) -> None:
    """Over the grid, and over `count` random contacts."""
    many("grid, Ree-Eyring", grid_contacts(EYRING), "18/60/-, 200")
    many("grid, Newtonian", grid_contacts(NEWTONIAN), "34/-/-, -")
    many("grid, isothermal Newtonian", grid_contacts(ISOTHERMAL), "-, 200")
    many(f"{count} random contacts (seed {seed}), Ree-Eyring", random_contacts(EYRING, count, seed), f"-, {count}")
    many(f"{count} random contacts (seed {seed}), Newtonian", random_contacts(NEWTONIAN, count, seed), "-")


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--only-rates", action="store_true")
    arguments = parser.parse_args()
    warm_up()
    report("figure", "measured", "target")
    if not arguments.only_rates:
        single_points()
        paths()
    rates(arguments.count, arguments.seed)
    if not arguments.only_rates:
        fresh_process()


if __name__ == "__main__":
    main()
