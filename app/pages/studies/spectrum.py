"""The page of a load spectrum: probabilities of exceeding a limit, what decides, and the losses.

The user pastes the cases as a table, chooses the fields that scatter, and states a tolerance for each of these fields.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from app.calculations import CALCULATIONS, Calculation
from app.errors import Unprocessable
from app.examples import study_bodies
from app.figures.data import Figure, NoFigure
from app.figures.spectrum import Limited, LimitedCase, chance_text, chances, deciding, losses, overlap, sentence
from app.figures.units import axis_of
from app.figures.wording import difference_unit, number, percent
from app.models.sections.gears import QUALITY_CLASS
from app.pages.cases import REFUSED
from app.pages.form import FieldView
from app.pages.query import Pairs, link, pairs_of
from app.pages.studies.controls import Control, field_choices, texts_of
from app.pages.studies.load_cases import cases_of, suggested, table_of
from app.pages.studies.page import Controls, Link, Number, Result, StudyPage, Table
from app.pages.study_kinds import CASES, SPECTRUM, TOLERANCES
from app.pages.study_links import Starter
from app.pages.templating import page_path
from app.pages.typed import as_typed, number_of, text_of
from app.pages.typesetting import cited, shown
from app.schema.fields import Leaf, leaf_at, value_at
from app.studies.fields import is_plain_number, scalar_at
from app.studies.kinds.spectrum import NO_LIMIT, Spectrum
from app.studies.points import SOLVED, BaseRequest
from app.studies.runner import Line
from app.studies.statistics import RELATIVE_DEVIATION
from app.studies.tolerances import class_remarks
from app.studies.uncertainty import model_distributions, quantities_of

REPLICATES = 8  # number of independent samples on the page; the scatter of their means gives the error of a mean
MACHINES = (("", "256"), ("64", "64"), ("1024", "1024"), ("4096", "4096"))
LAWS = (
    *(("", "normal"), ("uniform", "uniform"), ("triangular", "triangular"), ("lognormal", "lognormal")),
    ("listed", "listed values with weights"),
)
LISTED = "listed"
MODELS = (("", "not drawn"), ("true", "drawn"))
NOT_DRAWN = "how well the models are known ({}) is not in these numbers; one click draws it too"
SIDES = (("", "by the output"), ("above", "above is bad"), ("below", "below is bad"))
MOST_BARS = 40  # number of bars that fit side by side on a page


CONTROLS = (
    Control(CASES, "cases", "", str),
    Control("machines", "tolerances.count", int(MACHINES[0][1])),
    Control("hours", "hours_per_year"),
    Control("limit", "limit.value"),
    Control("limit.side", "limit.side", read=str),
    Control("limit.by", "limit.deviation"),
    Control("models", "tolerances.model_uncertainty", False, lambda text: text == "true"),
    Control("machines", "tolerances", sets=False),
    Control("limit", "limits", sets=False),
)
TOLERANCE = (
    Control("", "path", read=str),
    Control(".law", "distribution", "normal", str),
    Control(".about", "mean"),
    Control(".by", "deviation"),
)
"""The controls of a tolerance, with only the last parts of their names; `_tolerance` adds the first parts.

The paths `mean` and `deviation` hold the typed mean and the typed width, whatever the distribution is.
"""
STATED = {"normal": ("mean", "deviation"), "lognormal": ("median", "factor")}
"""For each distribution, the parameter that is set to the typed mean and the parameter that is set to the typed width.

The other distributions have the parameters `min` and `max`; the triangular distribution also has `mode`.
"""


def _tolerance(place: int, name: str, about: Any = None, by: Any = None) -> list[Control]:
    """Return the controls of a tolerance. The default of the mean is `about`, and the default of the width is `by`."""
    usual = {"mean": about, "deviation": by}
    return [
        part._replace(
            name=f"{name}{part.name}",
            path=f"tolerances.inputs.{place}.{part.path}",
            default=usual.get(part.path, part.default),
        )
        for part in TOLERANCE
    ]


def _stated(law: str, about: Any, by: Any) -> dict[str, Any]:
    """Convert mean and width into the parameters of a distribution; values and weights if it is listed."""
    if law == LISTED:
        values, weights = (
            [] if text is None else [number_of(part.strip()) for part in str(text).split(";")] for text in (about, by)
        )
        return {"values": values, "weights": weights or None}
    if names := STATED.get(law):
        return dict(zip(names, (about, by), strict=True))
    ends = {"uniform": ("min", "max"), "triangular": ("min", "mode", "max")}.get(law, ())
    return {end: {"min": about - by, "mode": about, "max": about + by}[end] for end in ends}


def _typed(scatter: dict[str, Any]) -> dict[str, Any]:
    """Convert a distribution in the body into the values of the controls."""
    law = scatter["distribution"]
    if law == LISTED:
        about = "; ".join(map(text_of, scatter["values"]))
        by = "; ".join(map(text_of, scatter.get("weights") or ())) or None
    elif names := STATED.get(law):
        about, by = (scatter[name] for name in names)
    else:
        about, by = (scatter["min"] + scatter["max"]) / 2, (scatter["max"] - scatter["min"]) / 2
    return {"path": scatter["path"], "distribution": law, "mean": about, "deviation": by}


def address_of(
    endpoint: Calculation, request: Pairs, body: dict[str, Any], file: Mapping[str, str] = MappingProxyType({})
) -> str:
    """Return the address of the page that shows the study with this body."""
    inputs, views = [_typed(scatter) for scatter in (body.get("tolerances") or {}).get("inputs") or ()], dict(file)
    given = {
        "cases": table_of(endpoint, body["cases"]),
        "tolerances": {"inputs": inputs, "model_uncertainty": (body.get("tolerances") or {}).get("model_uncertainty")},
        "hours_per_year": body.get("hours_per_year"),
    }
    for limit in (body.get("limits") or ())[:1]:
        (side,) = {"above", "below"} & set(limit)
        threshold = limit[side]
        views["show"] = limit["output"]
        given["limit"] = {"value": threshold.get("mean"), **threshold, "side": side}
    of_tolerances = (part for place in range(len(inputs)) for part in _tolerance(place, TOLERANCES[place]))
    controls = [*CONTROLS, *of_tolerances]
    return link(f"{page_path(endpoint)}/{SPECTRUM.name}", request, **views, **texts_of(controls, given))


class SpectrumPage(StudyPage):
    """The page that shows the study of a load spectrum."""

    link = SPECTRUM
    question = "its load spectrum"
    about = (
        "Random machines are drawn from the tolerances. Each machine runs every case, and its worst case is compared "
        "with the limit."
    )
    figures = ("limit", "probability", "decides", "losses")
    outputs = tuple(each.words.scuffing.contact for each in CALCULATIONS if each.words.scuffing)
    needs = ("cases", *TOLERANCES)
    choose = (
        "The table of cases lists what changes in each part of the operating time. The tolerances state how the "
        "fields scatter."
    )
    plan = Spectrum
    study: Spectrum

    def body(self) -> dict[str, Any]:
        """Return the body with the typed cases, tolerances and limit."""
        calculation, output, given = self.calculation, self.output.path, self.given()
        tolerances = given["tolerances"]
        typed = tolerances.get("inputs", [])
        inputs = [self._scatter(scatter, f"tolerances.inputs.{place}") for place, scatter in enumerate(typed)]
        machines = tolerances["count"]
        if not isinstance(machines, int):
            raise Unprocessable("int_type", "give a whole number", "tolerances.count")
        models = tolerances.get("model_uncertainty", False)
        draws = {"count": machines // REPLICATES, "replicates": REPLICATES, "model_uncertainty": models}
        scatters = inputs or models or value_at(self.case, QUALITY_CLASS)
        return {
            "endpoint": calculation.path,
            "request": self.asked.body,
            "cases": cases_of(calculation, given["cases"]),
            "tolerances": {"inputs": inputs or None, **draws} if scatters else None,
            "outputs": list(dict.fromkeys([output, *calculation.words.losses])),
            "limits": self._limits(given.get("limit", {})),
            "hours_per_year": given.get("hours_per_year"),
        }

    def _given(self) -> list[str]:
        """Return the names of the tolerances for which the user has entered values, in the order of the form."""
        return [name for name in TOLERANCES if self.views.get(name)]

    def declared(self) -> tuple[Control, ...]:
        """Return the controls for cases, machines, hours of operation, limit and tolerances."""
        controls = [*CONTROLS]
        for place, name in enumerate(self._given()):
            path = self.views[name]
            where, own = f"tolerances.inputs.{place}", value_at(self.case, path)
            is_listed = self.views.get(f"{name}.law") == LISTED
            controls += _tolerance(place, name, own, None if is_listed else _usual(self.field_at(path), own))
            controls += (
                Control(f"{name}.about", f"{where}.{'values' if is_listed else 'median'}", sets=False),
                Control(f"{name}.by", where, sets=False),
            )
        return (*controls, *(Control(name, "tolerances.inputs", sets=False) for name in self._given()[:1]))

    def _scatter(self, given: dict[str, Any], where: str) -> dict[str, Any]:
        """Convert what the user typed for a tolerance into the form in which a request states a distribution."""
        leaf = scalar_at(self.calculation.request, given["path"], f"{where}.path", "unknown_path")
        about: Any = given.get("mean")
        by: Any = given.get("deviation")
        law = given["distribution"]
        if law == LISTED:
            return {"path": leaf.path, "distribution": law, **_stated(law, about, by)}
        for value, lacks in (
            (about, "the value around which the field scatters"),
            (by, "the amount by which the field scatters"),
        ):
            if not is_plain_number(value):
                raise Unprocessable("missing", f"{leaf.title}: give {lacks}", where)
        return {"path": leaf.path, "distribution": law, **_stated(law, about, by)}

    @property
    def _assumes_limit(self) -> bool:
        """True if the scuffing temperature is the default limit of the output that the page shows."""
        scuffing = self.calculation.words.scuffing
        return scuffing is not None and (self.views.get("show") or self.usual_output.path) == scuffing.contact

    def _limits(self, given: dict[str, Any]) -> list[dict[str, Any]] | None:
        """Return a list with the limit of the output, or an empty list if the output has no limit.

        If the user typed no limit, the usual limit of the output is used; but if this usual limit is the scuffing
        temperature, return None, because the study then adds the limit itself. Raises Unprocessable if the user typed a
        deviation but no value.
        """
        view, scatter, value = self.output.view, given.get("deviation"), given.get("value")
        if value is None and view.bound and isinstance(view.limit, int | float) and not self._assumes_limit:
            value = view.limit
        if value is None and scatter is not None:
            raise Unprocessable(
                "missing",
                "the limit has a deviation but no value; give the value as well",
                "limits.0.above",
            )
        if value is None:
            return None if self._assumes_limit else []
        side = given.get("side") or ("below" if view.greatest_is_best else "above")
        threshold = {"value": value} if scatter is None else {"mean": value, "deviation": scatter}
        return [{"output": self.output.path, side: threshold}]

    def controls(self) -> tuple[Controls, ...]:
        """Return a group of form fields for the table of cases, and one group per tolerance."""
        case = self.case
        text = as_typed(self.views.get("cases", "")) or suggested(self.calculation, case)
        about = (
            "The first line names the columns: name, share (of the operating time), and fields as in the form.",
            "One line per case; columns are separated by tabs or semicolons, as in a spreadsheet.",
            "An empty cell leaves the value of the case unchanged.",
        )
        table = replace(self.field("cases", "cases"), widget="table", text=text, help=about)
        groups = [Controls("Load spectrum", fields=(table,))]
        last = max((place for place, name in enumerate(TOLERANCES) if self.views.get(name)), default=-1)
        choices = field_choices(self.calculation, case, texts=False) if self.asked.pairs else []
        for place, name in enumerate(TOLERANCES[: last + 3]):
            path = self.views.get(name, "")
            leaf, own = leaf_at(self.calculation.request, path), value_at(case, path)
            unit, usual = (leaf.unit or "") if leaf else "", _usual(leaf, own)
            law = self.field(f"{name}.law", "distribution", options=LAWS)
            if law.text == LISTED:
                values = self.field(f"{name}.about", "values, with semicolons", text_of(own), unit)
                fields = (law, values, self.field(f"{name}.by", "weights, with semicolons", "equal"))
            else:
                by = self.field(f"{name}.by", "by", usual, difference_unit(unit) or "")
                fields = (law, by, self.field(f"{name}.about", "around", own, unit))
            groups.append(Controls(f"Tolerance {place + 1}", self.menu(name, "field", "none", choices), fields))
        return tuple(groups)

    def shows(self) -> tuple[FieldView, ...]:
        """Return the form fields for the limit of the output, the number of machines and the hours of operation."""
        assumed = self._assumes_limit and not self.views.get("limit")
        deviation = f"{percent(RELATIVE_DEVIATION)} of it" if assumed else "none"
        return (
            self.field("limit", "limit", "its own"),
            self.field("limit.by", "deviation of the limit", deviation),
            self.field("limit.side", "side", options=SIDES),
            self.field("machines", "machines drawn", options=MACHINES),
            self.field("models", "uncertainty of the models", options=MODELS),
            self.field("hours", "hours a year"),
        )

    def starters(self) -> Sequence[Starter]:
        """Return links to the ready studies of /v1/spectrum. If the query has a case, return no links."""
        starters = []
        for example in study_bodies("/v1/spectrum").values():
            body = example["value"]
            if body["endpoint"] == self.calculation.path and not self.asked.pairs:
                address = address_of(self.calculation, pairs_of(body["request"]), body)
                starters.append(Starter(example["summary"], "example", address))
        return starters

    def result(self, lines: list[Line]) -> Result:
        """Return the figures and tables of the study."""
        header, end, output = lines[0], lines[-1], self.output
        cases = len(self.study.cases)
        machines = end["points"] // cases
        counted = [f"{count} {noun}{'s' * (count > 1)}" for count, noun in ((machines, "machine"), (cases, "case"))]
        progress = f"{' in '.join(counted)}, {shown(end['elapsed_s'], 2)} s"
        figures, notes, answer = dict[str, Figure](), [*end["notes"]], ""
        limit = next((content for content in end["limits"] if content["output"] == output.path), None)
        if limit is not None:
            limited, answer = self._limited(end, limit), f"{sentence(limit, self.output.title)}."
            for name, draw in (("limit", overlap), ("probability", chances), ("decides", deciding)):
                try:
                    figures[name] = draw(limited)
                except NoFigure as error:
                    notes.append(error.message)
        elif NO_LIMIT not in notes:
            notes.append(f"the {output.title} has no limit here; state a limit to get a probability")
        unsolved = end["points"] - sum(end["counts"].get(status, 0) for status in SOLVED)
        if unsolved:
            notes.append(
                f"{unsolved} of {end['points']} points have no solution. Each probability is a range: these points "
                "count as good at the lower end and as bad at the upper end"
            )
        tables = (
            *((self._limit_table(end, limit),) if limit else ()),
            self._cases_table(end, limit),
            self._outputs_table(end),
            *((_tolerances_table(header, limit),) if header["tolerances"] else ()),
        )
        notes += class_remarks(end["assumptions"])
        leads = [Link("Report with this spectrum", self.view("/report"))]
        could_draw = [] if limit is None else self._could_draw
        if could_draw:
            notes.append(NOT_DRAWN.format(", ".join(could_draw)))
        if could_draw and not self.too_long:
            leads.append(Link("Draw the uncertainty of the models too", self._with_models))
        remarks = tuple(f"{note[0].upper()}{note[1:]}." for note in notes)
        return Result(progress, figures | self._losses(end), tables, remarks, tuple(leads), answer=answer)

    @property
    def _could_draw(self) -> list[str]:
        """Name what the models do not know well and what is neither drawn nor set by the cases."""
        base = BaseRequest(self.calculation, self.study.body.request)
        taken = {leaf.path for leaf in self.study.scattering} | {path for case in self.study.cases for path in case.set}
        try:
            unknown = model_distributions(base.checked(self.study.overrides(0)))
        except REFUSED:
            return []
        return quantities_of(reason for path, (_, reason) in unknown.items() if path not in taken)

    @property
    def _with_models(self) -> str:
        """The address of this page with the uncertainty of the models drawn."""
        views = {name: text for name, text in self.views.items() if name in {*SPECTRUM.controls, "show"}}
        address = f"{self.asked.path}/{SPECTRUM.name}"
        return link(address, self.asked.pairs, **views, models="true", **self.asked.carried)

    def _limited(self, end: Line, limit: Line) -> Limited:
        """Return the data that the figures about a limit show."""
        place = end["limits"].index(limit)
        decides = limit["decides"] or [None] * len(end["cases"])
        cases = [
            LimitedCase(case["name"], case["quantiles"][self.output.path], case["limits"][place], share)
            for case, share in zip(end["cases"], decides, strict=True)
        ]
        worst = sorted(cases, key=lambda case: -case.chance["bounds"][1])[:MOST_BARS]
        titles = {leaf.path: leaf.title for leaf in self.study.scattering}
        shares = limit["variance_share"] or {}
        influences = {titles[path]: value for path, value in shares.items() if value is not None}
        return Limited(axis_of(self.output), limit, [case for case in cases if case in worst], influences)

    def _losses(self, end: Line) -> dict[str, Figure]:
        """Return a dictionary with one figure, which shows the mean losses in each case [kW]."""
        wanted, outputs = self.calculation.words.losses, end["outputs"]
        titles = {leaf.path: leaf.title for leaf in self.study.outputs}
        drawn_losses = {path: titles[path] for path in wanted if outputs[path]["mean"] is not None}
        if not drawn_losses:
            return {}
        cases = {
            case["name"]: {title: (case["means"][path] or 0.0) / 1e3 for path, title in drawn_losses.items()}
            for case in end["cases"][:MOST_BARS]
        }
        mean = {title: outputs[path]["mean"] / 1e3 for path, title in drawn_losses.items()}
        years = [outputs[path].get("energy_kwh_per_year") for path in drawn_losses]
        return {"losses": losses(cases, mean, None if None in years else sum(years) / 1e3)}

    def _limit_table(self, end: Line, limit: Line) -> Table:
        """Return a table that states the limit, its standard deviation and its source."""
        reasons = (assumption["reason"] for assumption in end["assumptions"] if assumption["field"] == "limits")
        reason = next(reasons, None)
        row = (
            self.output.title,
            f"not {limit['side']}",
            shown(limit["mean"], 4),
            "exact" if limit["deviation"] is None else _deviation(limit["deviation"], self.output.unit, 4),
            self.output.unit or "",
            "given" if reason is None else f"assumed: {cited(reason)}",
        )
        return Table("Limit", ("output", "side", Number("limit"), Number("deviation"), "unit", "source"), (row,))

    def _cases_table(self, end: Line, limit: Line | None) -> Table:
        """Return a table with one row per load case."""
        output, rows = self.output, list[tuple[str | Link, ...]]()
        for index, (case, content) in enumerate(zip(self.study.cases, end["cases"], strict=True)):
            row: list[str | Link] = [Link(content["name"], self.address(case.set)), percent(content["share"])]
            if limit:
                row.append(chance_text(content["limits"][end["limits"].index(limit)]))
                row.append(percent(limit["decides"][index]) if limit["decides"] else "–")
            row += [shown(value, 4) for value in content["quantiles"][output.path] or [None] * 3]
            rows.append((*row, percent(content["unsolved"])))
        unit = f", {output.unit}" if output.unit else ""
        judged = ("probability alone", "decides") if limit else ()
        heads = ("share", *judged, f"5 %{unit}", "50 %", "95 %", "unsolved")
        note = (
            f"The columns state, for each case, the values of {output.title} below which 5, 50 and 95 % of the "
            "machines lie."
        )
        return Table("Cases", ("case", *map(Number, heads)), rows, f"{note} Click a name to open the nominal case.")

    def _outputs_table(self, end: Line) -> Table:
        """Return a table with one row per output: the mean over the operating time, and the extremes."""
        rows = []
        for leaf in self.study.outputs:
            content = end["outputs"][leaf.path]
            ends = (
                Link(shown(extreme["value"], 4), self.address(extreme["at"])) if extreme else "–"
                for extreme in (content["min"], content["max"])
            )
            mean, error = shown(content["mean"], 4), _deviation(content["standard_error"], leaf.unit, 2)
            energy = shown(content.get("energy_kwh_per_year"), 4)
            rows.append((leaf.title, mean, error, *ends, leaf.unit or "", energy))
        heads = map(Number, ("mean", "standard error", "least", "largest"))
        head = ("output", *heads, "unit", Number("kWh a year"))
        return Table(
            "Over the operating time", head, rows, "Click a number to open the machine and the case with this value."
        )


def _usual(leaf: Leaf | None, value: Any) -> float | None:
    """Return the declared tolerance of a field at its value in the case; None without one."""
    return leaf.declared.tolerance_of(value if is_plain_number(value) else 0.0) if leaf else None


def _deviation(value: float | None, unit: str | None, digits: int) -> str:
    """Return a difference of two values as text."""
    own = difference_unit(unit)
    return shown(value, digits) if own == unit or value is None else number(value, own, digits)


def _tolerances_table(header: Line, limit: Line | None) -> Table:
    """Return a table of the fields that scatter, with their distributions."""
    numbers = ("mean", "deviation", "median", "factor", "min", "mode", "max")
    ranks, shares = ((limit and limit[name]) or {} for name in ("rank_correlation", "variance_share"))
    rows = []
    for scatter in header["tolerances"]["inputs"]:
        stated = {name: shown(scatter[name], 4) for name in numbers if scatter.get(name) is not None}
        if "deviation" in stated:
            stated["deviation"] = _deviation(scatter["deviation"], scatter["unit"], 4)
        if scatter["distribution"] == LISTED:
            stated = {"values": ", ".join(shown(value, 4) for value in scatter["values"])}
            weights = ", ".join(shown(weight, 4) for weight in scatter["weights"] or ())
            stated |= {"weights": weights} if weights else {}
        law = ", ".join(f"{name} {value}" for name, value in stated.items())
        described = (scatter["title"], f"{scatter['distribution']}: {law}", scatter["unit"] or "")
        share = shares.get(scatter["path"])
        measures = ("–" if share is None else percent(share), shown(ranks.get(scatter["path"]), 3))
        rows.append((*described, percent(scatter["cut_off"]), *measures))
    head = ("field", "distribution", "unit", *map(Number, ("cut off", "share of variance", "rank")))
    note = (
        '"Cut off" is the share of values beyond four deviations or outside the range of the field. "Share of '
        'variance" is what the field alone explains of the worst case, also if both sides cost. "Rank" is the rank '
        "correlation with the worst case; it is near zero if both sides cost."
    )
    return Table("Tolerances", head, rows, note)
