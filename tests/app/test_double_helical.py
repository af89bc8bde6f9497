"""Double-helical units as users see them: figures of both helices, which one decides, whether the coupling locks."""

from copy import deepcopy
from functools import cache
from typing import Any

import numpy as np
import pytest

from app.calculations import BY_PATH
from app.evaluate import evaluate
from app.examples import examples
from app.figures import units
from app.figures.data import Figure
from app.manual import chapters
from app.models.drive_train import helix_figures
from app.models.scuffing.heat_balance_figures import FLOWS, curve_over_the_flow
from app.pages.results import cards, conclusion, groups, resolved

UNIT, PAIR = "starter-turbo-double-helical", "starter-turbo-pair-heat"
# A unit without a heat balance is solved faster.
GIVEN = {
    "temperatures__bulk_method": "given",
    "temperatures__bulk_c": 80.0,
    "thermal__pinion_bulk_c": 80.0,
    "thermal__wheel_bulk_c": 75.0,
}


@cache
def solved(name: str, **changes: Any) -> tuple[Any, Any]:
    """Return request and answer of an example; the names of `changes` have two underscores for dots."""
    example = examples()[name]
    calculation = BY_PATH[example.endpoint]
    body: Any = deepcopy(example.request) | {"detail": "curves"}
    for path, value in changes.items():
        *around, last = path.split("__")
        section: Any = body
        for part in around:
            section = section[int(part) if part.isdecimal() else part]
        section[last] = value
    request = calculation.request.model_validate(body)
    return request, evaluate(calculation, request)


def unit(**changes: Any) -> tuple[Any, Any]:
    return solved(UNIT, **GIVEN, **changes)


def figure(name: str, request: Any, answer: Any) -> Figure:
    (declaration,) = (each for each in BY_PATH["/v1/drive-train"].figures if each.name == name)
    return declaration.figure(request, answer)


def test_the_sketch_shows_two_helices_their_gap_and_which_shaft_floats() -> None:
    sketch = figure("shafts", *unit())
    (panel,) = sketch.panels
    faces = {(shape.x.min(), shape.x.max()) for shape in panel.shapes if shape.title == "gears"}
    assert faces == {(320.0, 430.0), (490.0, 600.0)}
    (between,) = panel.spans
    assert (between.start, between.stop, between.name) == (430.0, 490.0, "110 + 60 + 110 mm")
    assert "together 280 mm" in sketch.finding
    assert [mark.y for mark in panel.marks if mark.text == "floats"] == [0.0]


def test_both_helices_stand_on_the_axis_of_the_unit() -> None:
    _, answer = unit()
    load, gap = figure("helices", *unit()).panels
    for line, helix in zip(load.lines, answer.helices, strict=True):
        assert np.array_equal(line.x, helix.misalignment.curves.z_mm)
        assert np.array_equal(line.y, helix.misalignment.curves.line_force_n_per_mm)
        assert (line.x.min(), line.x.max()) == pytest.approx((helix.start_mm, helix.start_mm + 110.0))
    totals = [line.y for line in gap.lines if line.title == "total"]
    assert all(np.array_equal(y, h.misalignment.curves.total_um) for y, h in zip(totals, answer.helices, strict=True))


def test_the_shares_over_the_thrust_end_at_their_bounds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(helix_figures, "FRACTIONS", np.array([-1.0, 0.0, 1.0]))
    request, answer = unit(gears__apex_runout_um=10.0)
    drawn = figure("thrust-shares", request, answer)
    shares, safety = drawn.panels
    computed = np.array([line.y for line in shares.lines]) / 100.0
    assert pytest.approx(np.array(answer.axial.share_bounds), rel=1e-9) == computed[:, [0, -1]].T
    assert computed[:, 1] == pytest.approx([helix.share for helix in answer.helices])
    assert [line.y[1] for line in safety.lines] == pytest.approx([h.safety.minimum for h in answer.helices], rel=1e-9)
    reached = {level.value for level in shares.levels if level.vertical}
    assert reached == {
        answer.couplings[0].held_thrust_fraction,
        *(s * answer.axial.runout_thrust_fraction for s in (1, -1)),
    }
    assert drawn.finding.startswith("locked: 70.3 % on one helix")


def test_a_tile_names_the_helix_that_decides() -> None:
    _, answer = unit(couplings__0__thrust_fraction=1.0)
    assert answer.decisive_helix == 2
    for card in cards(answer, resolved(answer))[:3]:
        assert "helix 2 decides" in card.remark
    assert cards(answer, resolved(answer))[0].remark.partition(";")[0].endswith("risk of scuffing (helix 2 decides)")
    assert answer.safety.minimum == answer.helices[1].safety.minimum


def test_the_answer_says_whether_the_coupling_locks_and_what_is_ground_on_each_helix() -> None:
    _, answer = unit()
    locks, *grind = conclusion(answer).splitlines()
    assert locks.startswith("The coupling does not lock: its hubs tilt by ")
    assert locks.endswith("both helices carry half; if dirt or wear lock it, one helix carries 70.3 % (K_γ = 1.41).")
    slopes = [helix.misalignment.recommended_helix_slope_um for helix in answer.helices]
    assert [line.split(",")[0] for line in grind] == [
        f"Grind on helix {place}: slope {slope:.3g} µm".replace("-", "−") for place, slope in enumerate(slopes, start=1)
    ]
    (coupling,) = answer.couplings
    holding = answer.model_copy(update={"couplings": [coupling.model_copy(update={"held_thrust_fraction": 0.25})]})
    assert "can lock" in conclusion(holding)
    assert "hold 25 %" in conclusion(holding)


def test_a_unit_without_load_and_one_whose_helix_lifts_off_have_their_words_and_figures(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(helix_figures, "FRACTIONS", np.array([-1.0, 0.0, 1.0]))
    assert "without load" in conclusion(unit(operation__power_kw=0.0)[1])
    request, answer = unit(couplings__0__friction__coefficient=0.45)
    assert conclusion(answer).splitlines()[0].endswith("if dirt or wear lock it, one helix lifts off.")
    drawn = figure("thrust-shares", request, answer)
    assert (drawn.unsolved, drawn.finding.partition(";")[0]) == (2, "locked: one helix lifts off")


def test_both_helices_stand_side_by_side_in_the_table() -> None:
    _, answer = unit()
    tables = groups(answer)
    rows = {row.path: row for title, rows in tables.items() if title.startswith("helix 1 and helix 2") for row in rows}
    assert rows["helices.0.hand"].items == ("right", "left")
    assert all(len(row.items) == 2 for row in rows.values())
    assert not any(path.startswith("helices.1.") for path in rows)


def test_a_pair_names_its_more_loaded_helix_and_its_figures_show_it() -> None:
    request, answer = solved(PAIR, gears__gap_width_mm=60.0, load__axial_force_n=5000.0)
    for card in cards(answer, resolved(answer)):
        assert "the helix that carries 62.8 %" in card.remark
    curve = curve_over_the_flow(request.inputs(), units.shown(answer.result))
    own = int(np.flatnonzero(FLOWS == 1.0)[0])
    assert curve.pinion_flank[own] - 273.15 == pytest.approx(answer.heat.pinion.flank_c, abs=0.01)


@pytest.mark.ci
def test_the_table_of_the_chapter_is_computed_from_the_starter() -> None:
    text = chapters()["double-helical"].text
    lines = text[text.index("| thrust of the coupling |") :].splitlines()[2:5]
    for line, fraction in zip(lines, (-1.0, 0.0, 1.0), strict=True):
        _, shares, factors, flanks, safety = (cell.strip() for cell in line.strip("|").split("|"))
        _, answer = solved(UNIT, couplings__0__thrust_fraction=fraction)
        for printed, computed, digit in (
            (shares, [helix.share for helix in answer.helices], 1e-3),
            (factors, [helix.load.face_load_factor for helix in answer.helices], 1e-3),
            (flanks.removesuffix(" °C"), [helix.pinion_flank_c for helix in answer.helices], 0.1),
            (safety, [helix.safety.blok_flank for helix in answer.helices], 0.01),
        ):
            assert [float(each) for each in printed.split(" / ")] == pytest.approx(computed, abs=0.501 * digit)
