"""How many line contacts are solved, of the grid and of random ones, and how the time they take is spread.

Run from the project's root: python -m benchmarks.solvability [--seed 1] [--count 500]
"""

import argparse
from collections.abc import Sequence
from statistics import median, quantiles
from time import process_time

from benchmarks.ehl import EYRING, ISOTHERMAL, NEWTONIAN
from solvers.contact.ehl import LineContactInputs, warm_up
from solvers.contact.ehl.model import solve
from tests.support.line_contacts import grid_contacts, random_contacts


def print_row(name: str, contacts: Sequence[LineContactInputs]) -> None:
    """One row: each contact solved once."""
    durations, solved = [], 0
    for inputs in contacts:
        began = process_time()
        solved += solve(inputs).status != "no_solution"
        durations.append((process_time() - began) * 1e3)
    tenths = quantiles(durations, n=10)
    spread = f"{median(durations):.1f} / {tenths[-1]:.0f} / {max(durations):.0f} ms"
    print(f"| {name} | {solved} of {len(durations)} | {spread} |", flush=True)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=500)
    arguments = parser.parse_args()
    warm_up()
    print("| contacts | solved | median / 90th percentile / slowest |\n|---|---|---|")
    for name, model in (("Ree-Eyring", EYRING), ("Newtonian", NEWTONIAN), ("isothermal Newtonian", ISOTHERMAL)):
        print_row(f"grid, {name}", grid_contacts(model))
        print_row(f"random, seed {arguments.seed}, {name}", random_contacts(model, arguments.count, arguments.seed))


if __name__ == "__main__":
    main()
