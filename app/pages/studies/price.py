"""The price of a tolerance on the page "what to grind": verdict, tables and figures of the probabilities by class."""

from collections.abc import Sequence
from typing import Any

from app.figures.data import Figure, Hue, Row
from app.figures.spectrum import chance_text
from app.figures.studies import dominating, price
from app.figures.wording import percent
from app.pages.studies.page import Number, Table
from app.pages.typesetting import lasting, shown
from app.studies.price import MICROPITTING, SCUFFING
from app.studies.requests import Overrides
from app.studies.runner import LONG_S, Line
from app.studies.statistics import MODERATE
from app.studies.uncertainty import quantities_of

NAMED = 8  # inputs in the table of what dominates
NO_PRICE = (
    "How exactly it must be ground is not known: state a scuffing temperature, a scuffing test or a micropitting test, "
    "with which the probability of damage can be computed."
)


def exact_enough(found: Line) -> Overrides:
    """Return the tolerances of the slopes by the coarsest class that is exact enough [um]; empty without one."""
    rows = {row["quality_class"]: row for row in found["classes"]}
    widths = rows.get(found["coarsest_class"], {}).get("tolerances", {})
    return {f"modifications.{name}": width for name, width in widths.items()}


def price_verdict(found: Line) -> str:
    """Say how exactly it must be ground: verdict, number, reason."""
    if found["exact"]["bounds"][1] >= MODERATE:
        chance, coarsest = chance_text(found["exact"]), found["coarsest_class"]
        costs = f"{f'Class {coarsest}' if coarsest else 'No class'} costs less than a tenth more."
        return (
            f"Not safe however exactly it is ground: with exact flanks damage is {chance} probable. Change oil, relief "
            f"or geometry first. {costs}"
        )
    rows = {row["quality_class"]: row for row in found["classes"]}
    exact, coarsest = chance_text(found["exact"]), found["coarsest_class"]
    if coarsest == max(rows) and not any(row["more"] for row in rows.values()):
        chance = chance_text(rows[coarsest])
        return f"Any of these classes is enough: even with class {coarsest} damage is {chance} probable."
    if coarsest is None:
        finest = min(rows)
        more = rows[finest]["more"]
        against = (
            f"with exact flanks {exact}" if more is None else f"{percent(more)} more than with exact flanks ({exact})"
        )
        return f"Not even class {finest} is enough: damage is {chance_text(rows[finest])} probable, {against}."
    own = rows[coarsest]
    width = shown(own["tolerances"]["helix_slope_um"], 3)
    rest = ""
    for row in [row for name, row in rows.items() if name > coarsest][:1]:
        costs = f"makes it {chance_text(row)}" if row["more"] is None else f"costs {percent(row['more'])} more"
        rest = f"; class {row['quality_class']} {costs}"
    return (
        f"Class {coarsest} is exact enough: damage is {chance_text(own)} probable, with exact flanks {exact}, because "
        f"±{width} µm of helix slope cost less than a tenth{rest}."
    )


def price_remarks(found: Line) -> list[str]:
    """Say what leaves the verdict open: the error of sampling, and machines without solution."""
    remarks = []
    if found["undecided"]:
        remarks.append(
            f"With {found['machines']} machines the error of sampling leaves open whether a class costs a tenth more; "
            "draw more machines."
        )
    unsolved = max(row["unsolved"] for row in (found["exact"], *found["classes"]))
    if unsolved:
        remarks.append(f"Up to {percent(unsolved)} of the machines have no solution; probabilities are ranges.")
    return remarks


def price_tables(found: Line) -> tuple[Table, ...]:
    """Return the table of the classes, and that of what the damage depends on."""
    kinds = [name for name in (SCUFFING, MICROPITTING) if name in found["exact"]["kinds"]]
    both = len(kinds) > 1
    rows = [("exact", "0", "0", *_chances(found["exact"], kinds), "–")]
    for row in found["classes"]:
        widths = [shown(row["tolerances"][name], 3) for name in ("helix_slope_um", "profile_slope_um")]
        rows.append((str(row["quality_class"]), *widths, *_chances(row, kinds), _more(row)))
    heads = ("helix slope, ± µm", "profile slope, ± µm", *(f"probability of {kind}" for kind in kinds), "90 % interval")
    note = (
        f"{found['machines']} machines each, the same ones for every class; the interval is the error of sampling "
        "alone. ± are three standard deviations of both gears together."
    )
    drawn = _drawn(found)
    note += f" Drawn are also {', '.join(drawn)}." if drawn else ""
    note += " The more probable damage counts." if both else ""
    head = ("quality class", *map(Number, (*heads, "more than exact")))
    classes = Table("How exactly to grind", head, rows, note)
    shares = [(line["name"], percent(line["share"])) for line in found["influences"] if line["share"] is not None]
    if not shares:
        return (classes,)
    note = (
        "Each input alone at two standard deviations to either side, all others nominal; the shares are those of the "
        "squared changes of the margin to damage. What costs on both sides counts."
    )
    title = f"What the damage depends on, class {found['reference_class']}"
    return classes, Table(title, ("input", Number("share")), shares[:NAMED], note)


def _drawn(found: Line) -> list[str]:
    """Name what differs between the machines beside the slopes of their flanks."""
    reasons = {line["field"]: line["reason"] for line in found["assumptions"]}
    slopes = {f"modifications.{name}" for row in found["classes"] for name in row["tolerances"]}
    others = [line for line in found["influences"] if not slopes.intersection(line["paths"])]
    inputs = [line["name"] for line in others if reasons.keys().isdisjoint(line["paths"])]
    models = quantities_of(reasons[path] for line in others for path in line["paths"] if path in reasons)
    return [*inputs, *(name for name in models if name not in inputs)]


def _chances(row: Line, kinds: Sequence[str]) -> tuple[str, ...]:
    interval = row["interval"]
    said = f"{percent(interval[0])} to {percent(interval[1])}" if interval else "–"
    return (*(chance_text(row["kinds"][kind]) for kind in kinds), said)


def _more(row: Line) -> str:
    """Return by how much damage is more probable than with exact flanks, with its standard error."""
    if row["more"] is None:
        return "exact is safe"
    error = "" if row["more_error"] is None else f" ± {percent(row['more_error'])}"
    return f"{percent(row['more'])}{error}"


def price_figures(found: Line) -> dict[str, Figure]:
    """Return the figures of the probability by class, and of what it depends on."""
    rows = []
    for name, row in (("exact", found["exact"]), *((f"class {row['quality_class']}", row) for row in found["classes"])):
        enough = name == "exact" or row["enough"]
        bounds = None if row["interval"] is None else (100.0 * row["interval"][0], 100.0 * row["interval"][1])
        rows.append(Row(name, 100.0 * row["bounds"][1], Hue.BLUE if enough else Hue.VERMILLION, bounds))
    coarsest = found["coarsest_class"]
    finding = "no class costs less than a tenth" if coarsest is None else f"class {coarsest} costs less than a tenth"
    figures = {"price": price(rows, f"{finding}; blue: less than a tenth more than exact")}
    shares = {line["name"]: line["share"] for line in found["influences"] if line["share"]}
    if shares:
        figures["dominating"] = dominating(shares)
    return figures


def time_left(study: Any, trials: Sequence[Line], rows: Sequence[Line]) -> str:
    """Say how far the search is, and how much longer it takes at most, from the pace so far."""
    pricing, elapsed = study.pricing, trials[-1]["elapsed_s"]
    solved = len(trials) * study.points_per_trial
    if rows and pricing is not None:
        elapsed = rows[-1]["elapsed_s"]
        searched = trials[-1]["elapsed_s"]
        pace = (elapsed - searched) / (len(rows) + 1)
        left, doing = pace * (len(pricing.machines.classes) + 1 - len(rows)), "the classes are compared"
    else:
        left = (study.total - solved) * elapsed / solved
        doing = f"correction {len(trials)} of at most {study.body.evaluations}"
    most = f"; at most {lasting(left)} more" if elapsed + left > LONG_S else ""
    return f"{doing[0].upper()}{doing[1:]}{most}."
