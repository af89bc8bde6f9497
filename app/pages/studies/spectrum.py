"""A load spectrum: cases as a table to paste, tolerances beside the fields that scatter, probabilities and losses."""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any, NamedTuple

from app.calculations import Calculation
from app.errors import Unprocessable
from app.figures.data import Figure, NoFigure
from app.figures.spectrum import Limited, SpectrumCase, chance_text, chances, deciding, losses, overlap, sentence
from app.figures.units import axis_of
from app.figures.wording import difference_unit, number, percent
from app.pages import study_links
from app.pages.form import FieldView
from app.pages.query import SCATTERING, Pairs, link, pairs_of
from app.pages.studies.page import Controls, Link, Number, Result, StudyPage, Table, titled
from app.pages.studies.sweep import field_choices, is_number
from app.pages.templating import page_path
from app.pages.typed import as_typed, number_of, power_between, question, scaled, separator_of, text_of
from app.pages.typesetting import cited, shown, words
from app.schema.fields import ITEM, leaf_at, leaves
from app.schema.quantities import split_unit
from app.studies.engine import Line
from app.studies.fields import NUMBERS, scalar_at, value_at
from app.studies.points import SOLVED
from app.studies.requests import DRIVE_TRAIN, EXAMPLES
from app.studies.spectrum import RELATIVE_DEVIATION, SCUFFING, Spectrum

NAME, SHARE = "name", "share"
REPLICATES = 8  # samples from which the page tells how certain a mean is
MACHINES = (("", "256"), ("64", "64"), ("1024", "1024"), ("4096", "4096"))
LAWS = (("", "normal"), ("uniform", "uniform"), ("triangular", "triangular"), ("lognormal", "lognormal"))
SIDES = (("", "by the output"), ("above", "above is bad"), ("below", "below is bad"))
AROUND_UNIT = " ,;[]()"  # and between a label and its unit
# Fields that a case of the spectrum usually changes, for the table to start from.
USUAL = (
    *("load.power_kw", "load.pinion_torque_n_m", "load.pinion_speed_rpm"),
    *("operation.power_kw", "operation.pinion_torque_n_m", "operation.torque_n_m"),
    *("operation.pinion_speed_rpm", "operation.speed_rpm", "temperatures.oil_c"),
)
LOSSES = {
    "/v1/coupling": ("losses.friction_power_w",),
    "/v1/pumping": ("total.pumping_power_w",),
    "/v1/scuffing/load-distribution": ("friction_loss.power_w",),
    "/v1/scuffing": ("friction_loss.power_w",),
    DRIVE_TRAIN: ("losses.coupling_w", "losses.pumping_w", "losses.mesh_w", "losses.bearings_w"),
}
MOST_BARS = 40  # that fit a page side by side
TOLERANCES = tuple(f"t{place}" for place in range(SCATTERING))


class Column(NamedTuple):
    """A column of the table: name, share, or the path of a field; its numbers are multiplied by ten to the `power`."""

    path: str
    power: int = 0


def cases_of(calculation: Calculation, text: str) -> list[dict[str, Any]]:
    """The cases of a table whose first line names the columns: name, share, and fields by their labels or paths.

    Columns are parted by tabs, as a spreadsheet copies them, or by semicolons; an empty cell changes nothing. Raises
    Unprocessable.
    """
    lines = [line for line in text.splitlines() if line.strip()] or [""]
    try:
        heading, *rows = csv.reader(lines, delimiter=separator_of(text))
    except csv.Error:
        raise Unprocessable("table", "the table cannot be read", "cases") from None
    columns = [_column(calculation, cell.strip()) for cell in heading]
    return [_case(calculation, columns, row, place) for place, row in enumerate(rows, start=2)] or [{}]


def _column(calculation: Calculation, heading: str) -> Column:
    """The column of a heading, which may be a path, a name or a label of the form, with or without a unit.

    Raises Unprocessable where the heading means several fields; one that means none stays, for the study to refuse.
    """
    plain = heading.lower()
    if leaf_at(calculation.request, heading) or plain in {NAME, SHARE}:
        return Column(heading if plain not in {NAME, SHARE} else plain)
    if plain.startswith(SHARE) and plain.removeprefix(SHARE).strip(AROUND_UNIT) == "%":
        return Column(SHARE, -2)
    alike: dict[tuple[int, bool], dict[str, Column]] = {}  # by length; what the form shows counts before names
    for leaf in (leaf for leaf in leaves(calculation.request) if leaf.is_scalar and ITEM not in leaf.path):
        name = leaf.path.rpartition(".")[2]
        labels = {leaf.title, leaf.declared.title, name, words(split_unit(name)[0])}
        for label in filter(plain.startswith, map(str.lower, labels)):
            power = power_between(heading[len(label) :].strip(AROUND_UNIT), leaf.unit)
            if power is not None:
                shown = label == leaf.title.lower()
                alike.setdefault((len(label), shown), {})[leaf.title] = Column(leaf.path, power)
    meant = alike[max(alike)] if alike else {heading: Column(heading)}
    if len(meant) > 1:
        raise Unprocessable("table", f"the column {heading} may be {' or '.join(meant)}; write one of these", "cases")
    return next(iter(meant.values()))


def _case(calculation: Calculation, columns: list[Column], row: list[str], line: int) -> dict[str, Any]:
    """A line of the table; a cell that its field does not take stays text, for the study to refuse."""
    if any(cell.strip() for cell in row[len(columns) :]):
        raise Unprocessable("table", f"line {line} has more columns than the first line names", "cases")
    case: dict[str, Any] = {"set": {}}
    for (column, power), cell in zip(columns, map(str.strip, row), strict=False):
        leaf = leaf_at(calculation.request, column)
        if not cell:
            continue
        if column != NAME and (asked := question(cell)):
            raise Unprocessable("table", f"line {line}: {asked}", "cases")
        if column == NAME:
            case[NAME] = cell
        elif column == SHARE:
            share = scaled(number_of(cell.removesuffix("%").strip()), -2 if cell.endswith("%") else power)
            if isinstance(share, str):
                raise Unprocessable("table", f"line {line}: the share is no number", "cases")
            case[SHARE] = float(share)
        elif leaf is not None and leaf.kind == "boolean":
            case["set"][column] = {"true": True, "false": False}.get(cell, cell)
        else:
            case["set"][column] = scaled(number_of(cell), power) if leaf is None or leaf.kind in NUMBERS else cell
    return case


def table_of(calculation: Calculation, cases: list[dict[str, Any]]) -> str:
    """The table of cases as `cases_of` reads it, with the labels of the form in its first line."""
    paths = list(dict.fromkeys(path for case in cases for path in case.get("set", {})))
    rows = [[NAME, SHARE, *(_heading(calculation, path) for path in paths)]]
    for place, case in enumerate(cases, start=1):
        own = case.get("set", {})
        head = [str(case.get(NAME) or f"case {place}"), text_of(case[SHARE]) if case.get(SHARE) is not None else ""]
        rows.append([*head, *(text_of(own[path]) if path in own else "" for path in paths)])
    return "\n".join("\t".join(cell.replace("\t", " ") for cell in row) for row in rows)


def _heading(calculation: Calculation, path: str) -> str:
    """The label and unit of a field, or its path where a column of that name would be another one."""
    leaf = leaf_at(calculation.request, path)
    if leaf is None:
        return path
    try:
        meant = _column(calculation, titled(leaf))
    except Unprocessable:
        return path
    return titled(leaf) if meant == Column(path) else path


def address_of(
    endpoint: Calculation, request: Pairs, body: dict[str, Any], file: Mapping[str, str] = MappingProxyType({})
) -> str:
    """Return the page of a study of the interface, with the first of its limits, and the file it was read from."""
    views = {**file, "cases": table_of(endpoint, body["cases"])}
    for place, each in enumerate((body.get("tolerances") or {"inputs": []})["inputs"]):
        law, name = each["distribution"], f"t{place}"
        match each:
            case {"mean": about, "deviation": by} | {"median": about, "factor": by}:
                pass
            case {"min": low, "max": high}:
                about, by = (low + high) / 2, (high - low) / 2
        views |= {name: each["path"], f"{name}.about": text_of(about), f"{name}.by": text_of(by)}
        views |= {} if law == "normal" else {f"{name}.law": law}
    for each in (body.get("limits") or ())[:1]:
        (side,) = {"above", "below"} & set(each)
        known = each[side]
        views |= {"show": each["output"], "limit": text_of(known.get("value", known.get("mean"))), "limit.side": side}
        views |= {"limit.by": text_of(known["deviation"])} if "deviation" in known else {}
    if "hours_per_year" in body:
        views["hours"] = text_of(body["hours_per_year"])
    return link(f"{page_path(endpoint)}/{study_links.SPECTRUM.name}", request, **views)


class SpectrumPage(StudyPage):
    """A machine with its tolerances over its load spectrum."""

    link = study_links.SPECTRUM
    question = "its load spectrum"
    about = "Machines are drawn from the tolerances; each runs every case, and its worst case meets the limit."
    figures = ("limit", "probability", "decides", "losses")
    outputs = tuple(paths.contact for paths in SCUFFING.values())
    needs = ("cases", *TOLERANCES)
    choose = "Cases are a table of what each part of the operating time changes; tolerances say how the fields scatter."
    plan = Spectrum
    study: Spectrum

    def body(self) -> dict[str, Any]:
        """The cases and tolerances as typed, the output shown with its limit, and the losses."""
        calculation, views, output = self.calculation, self.views, self.output.path
        inputs = [self._scatter(name, place) for place, name in enumerate(self._given())]
        machines = self.number("machines", int(MACHINES[0][1]))
        if not isinstance(machines, int):
            raise Unprocessable("int_type", "give a whole number", "tolerances.count")
        tolerances = {"inputs": inputs, "count": machines // REPLICATES, "replicates": REPLICATES}
        return {
            "endpoint": calculation.path,
            "request": self.asked.body,
            "cases": cases_of(calculation, views.get("cases", "")),
            "tolerances": tolerances if inputs else None,
            "outputs": list(dict.fromkeys([output, *LOSSES.get(calculation.path, ())])),
            "limits": self._limits(),
            "hours_per_year": self.number("hours"),
        }

    def _given(self) -> list[str]:
        """The controls of the tolerances that are filled in; others between them may be empty."""
        return [name for name in TOLERANCES if self.views.get(name)]

    def _scatter(self, name: str, place: int) -> dict[str, Any]:
        """The distribution of one field: around the value of the case, by its usual tolerance."""
        where = f"tolerances.inputs.{place}"
        leaf = scalar_at(self.calculation.request, self.views[name], f"{where}.path", "unknown_path")
        about = self.number(f"{name}.about", value_at(self.case, leaf.path))
        by = self.number(f"{name}.by", leaf.declared.tolerance)
        for value, lacks in ((about, "around which value"), (by, "by how much")):
            if not is_number(value):
                raise Unprocessable("missing", f"{leaf.title}: say {lacks}", where)
        law = self.views.get(f"{name}.law") or "normal"
        known = {
            "normal": {"mean": about, "deviation": by},
            "lognormal": {"median": about, "factor": by},
            "uniform": {"min": about - by, "max": about + by},
            "triangular": {"min": about - by, "mode": about, "max": about + by},
        }
        return {"path": leaf.path, "distribution": law, **known.get(law, {})}

    @property
    def _assumes_limit(self) -> bool:
        """Whether the output is compared with the scuffing temperature where no limit is given."""
        scuffing = SCUFFING.get(self.calculation.path)
        return scuffing is not None and (self.views.get("show") or self.usual_output.path) == scuffing.contact

    def _limits(self) -> list[dict[str, Any]] | None:
        """The limit typed, or else the usual limit of the output; None if the scuffing temperature is the limit."""
        view, scatter, value = self.output.view, self.number("limit.by"), self.number("limit")
        if value is None and view.bound and isinstance(view.limit, int | float) and not self._assumes_limit:
            value = view.limit
        if value is None and scatter is not None:
            raise Unprocessable("missing", "give the limit whose deviation this is", "limits.0.above")
        if value is None:
            return None if self._assumes_limit else []
        side = self.views.get("limit.side") or ("below" if view.greatest_is_best else "above")
        threshold = {"value": value} if scatter is None else {"mean": value, "deviation": scatter}
        return [{"output": self.output.path, side: threshold}]

    def places(self) -> dict[str, str]:
        """The names of the controls of cases, tolerances, limit, machines and hours."""
        places = {"cases": "cases", "limits": "limit", "tolerances": "machines", "hours_per_year": "hours"}
        for place, name in enumerate(self._given()):
            where = f"tolerances.inputs.{place}"
            places |= {where: f"{name}.by", f"{where}.path": name}
            places |= {f"{where}.{middle}": f"{name}.about" for middle in ("mean", "median")}
            places.setdefault("tolerances.inputs", name)
        return places

    def controls(self) -> tuple[Controls, ...]:
        """The table of cases, and the tolerances: those given and two more."""
        case = self.case
        text = as_typed(self.views.get("cases", "")) or _suggested(self.calculation, case)
        about = (
            "The first line names the columns: name, share (of the time) and fields, as the form or the request does.",
            "One line a case, columns parted by tabs or semicolons, as pasted from a spreadsheet.",
            "An empty cell changes nothing.",
        )
        table = replace(self.field("cases", "cases"), widget="table", text=text, help=about)
        groups = [Controls("Load spectrum", fields=(table,))]
        last = max((place for place, name in enumerate(TOLERANCES) if self.views.get(name)), default=-1)
        choices = field_choices(self.calculation, case, texts=False) if self.asked.pairs else []
        for place, name in enumerate(TOLERANCES[: last + 3]):
            path = self.views.get(name, "")
            leaf, own = leaf_at(self.calculation.request, path), value_at(case, path)
            unit, usual = (leaf.unit or "", leaf.declared.tolerance) if leaf else ("", None)
            fields = (
                self.field(f"{name}.law", "distribution", options=LAWS),
                self.field(f"{name}.by", "by", usual, difference_unit(unit) or ""),
                self.field(f"{name}.about", "around", own, unit),
            )
            groups.append(Controls(f"Tolerance {place + 1}", self.menu(name, "field", "none", choices), fields))
        return tuple(groups)

    def shows(self) -> tuple[FieldView, ...]:
        """The limit of the output, how many machines are drawn, and the hours of operation."""
        assumed = self._assumes_limit and not self.views.get("limit")
        deviation = f"{percent(RELATIVE_DEVIATION)} of it" if assumed else "none"
        return (
            self.field("limit", "limit", "its own"),
            self.field("limit.by", "deviation of the limit", deviation),
            self.field("limit.side", "side", options=SIDES),
            self.field("machines", "machines drawn", options=MACHINES),
            self.field("hours", "hours a year"),
        )

    def starters(self) -> Sequence[study_links.Starter]:
        """Links to the ready studies of /v1/spectrum; none where the query has a case."""
        starters = []
        for each in EXAMPLES["/v1/spectrum"].values():
            body = each["value"]
            if body["endpoint"] == self.calculation.path and not self.asked.pairs:
                address = address_of(self.calculation, pairs_of(body["request"]), body)
                starters.append(study_links.Starter(each["summary"], "example", address))
        return starters

    def result(self, lines: list[Line]) -> Result:
        """The probability of failure with the limit, the deciding cases, the influences and the losses."""
        header, end, output = lines[0], lines[-1], self.output
        cases = len(self.study.cases)
        machines = end["points"] // cases
        counted = [f"{count} {noun}{'s' * (count > 1)}" for count, noun in ((machines, "machine"), (cases, "case"))]
        progress = f"{' in '.join(counted)}, {shown(end['elapsed_s'], 2)} s"
        figures, notes = dict[str, Figure](), [*end["notes"]]
        found = next((each for each in end["limits"] if each["output"] == output.path), None)
        if found is not None:
            limited, said = self._limited(end, found), sentence(found)
            progress = f"{said[0].upper()}{said[1:]}; {progress}"
            for name, draw in (("limit", overlap), ("probability", chances), ("decides", deciding)):
                try:
                    figures[name] = draw(limited)
                except NoFigure as error:
                    notes.append(error.message)
        elif not notes:
            notes.append(f"the {output.title} has no limit here; state one, and there is a probability")
        unsolved = end["points"] - sum(end["counts"].get(status, 0) for status in SOLVED)
        if unsolved:
            notes.append(
                f"{unsolved} of {end['points']} points have no solution; each probability lies between taking them as "
                "good and as bad"
            )
        tables = (
            *((self._limit_table(end, found),) if found else ()),
            self._cases_table(end, found),
            self._outputs_table(end),
            *((_tolerances_table(header, found),) if header["tolerances"] else ()),
        )
        remarks = tuple(f"{note[0].upper()}{note[1:]}." for note in notes)
        leads = (Link("Report with this spectrum", self.view("/report")),)
        return Result(progress, figures | self._losses(end), tables, remarks, leads)

    def _limited(self, end: Line, found: Line) -> Limited:
        """The limit shown, with its most probable cases where there are many."""
        place = end["limits"].index(found)
        decides = found["decides"] or [None] * len(end["cases"])
        cases = [
            SpectrumCase(each["name"], each["quantiles"][self.output.path], each["limits"][place], share)
            for each, share in zip(end["cases"], decides, strict=True)
        ]
        worst = sorted(cases, key=lambda case: -case.chance["bounds"][1])[:MOST_BARS]
        titles = {leaf.path: leaf.title for leaf in self.study.scattering}
        ranks = found["rank_correlation"] or {}
        influences = {titles[path]: value for path, value in ranks.items() if value is not None}
        return Limited(axis_of(self.output), found, [case for case in cases if case in worst], influences)

    def _losses(self, end: Line) -> dict[str, Figure]:
        """Mean losses of the cases [kW]; nothing where none of them is known."""
        wanted, outputs = LOSSES.get(self.calculation.path, ()), end["outputs"]
        titles = {leaf.path: leaf.title for leaf in self.study.outputs}
        known = {path: titles[path] for path in wanted if outputs[path]["mean"] is not None}
        if not known:
            return {}
        cases = {
            each["name"]: {title: (each["means"][path] or 0.0) / 1e3 for path, title in known.items()}
            for each in end["cases"][:MOST_BARS]
        }
        mean = {title: outputs[path]["mean"] / 1e3 for path, title in known.items()}
        years = [outputs[path].get("energy_kwh_per_year") for path in known]
        return {"losses": losses(cases, mean, None if None in years else sum(years) / 1e3)}

    def _limit_table(self, end: Line, found: Line) -> Table:
        """The limit with its deviation, and where it comes from."""
        assumed = next((each["reason"] for each in end["assumptions"] if each["field"] == "limits"), None)
        row = (
            self.output.title,
            f"not {found['side']}",
            shown(found["mean"], 4),
            "exact" if found["deviation"] is None else _deviation(found["deviation"], self.output.unit, 4),
            self.output.unit or "",
            "given" if assumed is None else f"assumed: {cited(assumed)}",
        )
        return Table("Limit", ("output", "side", Number("limit"), Number("deviation"), "unit", "source"), (row,))

    def _cases_table(self, end: Line, found: Line | None) -> Table:
        """Every case with its share, its probability, how often it decides, and its output."""
        output, rows = self.output, list[tuple[str | Link, ...]]()
        for index, (case, each) in enumerate(zip(self.study.cases, end["cases"], strict=True)):
            row: list[str | Link] = [Link(each["name"], self.address(case.set)), percent(each["share"])]
            if found:
                row.append(chance_text(each["limits"][end["limits"].index(found)]))
                row.append(percent(found["decides"][index]) if found["decides"] else "–")
            row += [shown(value, 4) for value in each["quantiles"][output.path] or [None] * 3]
            rows.append((*row, percent(each["unsolved"])))
        unit = f", {output.unit}" if output.unit else ""
        judged = ("probability alone", "decides") if found else ()
        heads = ("share", *judged, f"5 %{unit}", "50 %", "95 %", "unsolved")
        note = f"Of each case 5, 50 and 95 % of the machines have a lower {output.title}."
        return Table("Cases", ("case", *map(Number, heads)), rows, f"{note} A name leads to the nominal case.")

    def _outputs_table(self, end: Line) -> Table:
        """Means over the operating time, and the extremes with the machine and case where they are."""
        rows = []
        for leaf in self.study.outputs:
            found = end["outputs"][leaf.path]
            ends = (
                Link(shown(extreme["value"], 4), self.address(extreme["at"])) if extreme else "–"
                for extreme in (found["min"], found["max"])
            )
            mean, error = shown(found["mean"], 4), _deviation(found["standard_error"], leaf.unit, 2)
            energy = shown(found.get("energy_kwh_per_year"), 4)
            rows.append((leaf.title, mean, error, *ends, leaf.unit or "", energy))
        heads = map(Number, ("mean", "standard error", "least", "largest"))
        head = ("output", *heads, "unit", Number("kWh a year"))
        return Table("Over the operating time", head, rows, "A number leads to the machine and case where it is.")


def _deviation(value: float | None, unit: str | None, digits: int) -> str:
    """A difference of values in this unit, with a unit of its own where that is another one."""
    own = difference_unit(unit)
    return shown(value, digits) if own == unit or value is None else number(value, own, digits)


def _suggested(calculation: Calculation, case: dict[str, Any]) -> str:
    """A table to start from: the case itself for most of the time, and half its load."""
    known = {path: value for path in USUAL if isinstance(value := value_at(case, path), int | float)}
    half = {path: value / 2 if "power" in path or "torque" in path else value for path, value in known.items()}
    return table_of(
        calculation, [{NAME: "full load", SHARE: 0.8, "set": known}, {NAME: "half load", SHARE: 0.2, "set": half}]
    )


def _tolerances_table(header: Line, found: Line | None) -> Table:
    """How the fields scatter, what is cut off, and how the worst case goes with them."""
    numbers = ("mean", "deviation", "median", "factor", "min", "mode", "max")
    ranks = (found and found["rank_correlation"]) or {}
    rows = []
    for each in header["tolerances"]["inputs"]:
        stated = {name: shown(each[name], 4) for name in numbers if each.get(name) is not None}
        if "deviation" in stated:
            stated["deviation"] = _deviation(each["deviation"], each["unit"], 4)
        law = ", ".join(f"{name} {value}" for name, value in stated.items())
        drawn = (each["title"], f"{each['distribution']}: {law}", each["unit"] or "")
        rows.append((*drawn, percent(each["cut_off"]), shown(ranks.get(each["path"]), 3)))
    head = ("field", "distribution", "unit", Number("cut off"), Number("rank"))
    note = "Cut off is the share beyond four deviations or the field's range"
    return Table("Tolerances", head, rows, f"{note}; rank is the correlation with the worst case.")
