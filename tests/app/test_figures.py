"""Every figure exists, shows the numbers of the answer, and is written as an image and as a table."""

import csv
import io
import re
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from shapely import Polygon

from app.calculations import BY_PATH
from app.evaluate import evaluate
from app.examples import examples
from app.figures import units
from app.figures.comparison import compared
from app.figures.data import Figure, NoFigure, Role
from app.figures.drawing.image import draw
from app.figures.tables import table
from app.models.drive_train import figures as drive_train
from app.models.load_distribution.request import FlankModifications
from app.schema.model import Documented, members
from solvers.coupling.lubrication import regime_friction
from solvers.gears.pair import gear_pair
from solvers.pumping.spaces import flow_at, prepare
from solvers.scuffing.safety_results import ThermalPath
from tests.support.changes import changed
from tests.support.properties import one_per_endpoint

CROWNED, SLOPED = "pahl-heavily-crowned", "xue-pair-4-helix-slope-40"
GENERATOR, TURBO = "starter-generator-gear-drive-train", "starter-turbo-gear-drive-train"
# The figures that every calculation has.
FIGURES = {
    "/v1/coupling": "friction-regime tooth-loads tooth-motion contact-track axial-thrust losses",
    "/v1/coupling/sleeve-orbit": "orbit inertia-force orders",
    "/v1/coupling/recommendation": "crowning-scan",
    "/v1/pumping": (
        "section stroke heating peak-pressure pressure-map mach-map temperature-map lead-correction pulsation mass-flow"
    ),
    "/v1/pumping/choking-speed": "choking",
    "/v1/scuffing/load-distribution": (
        "section flank-load flank-pressure modification modification-traces contact-line-load transmission-error "
        "path-of-contact stiffness load-sharing pair-share"
    ),
    "/v1/scuffing": (
        "contact-temperature safety safety-band heat-flows node-temperatures oil-flow film friction micropitting "
        "micropitting-film wear"
    ),
    "/v1/scuffing/line-contact": "contact film-temperature heat",
    "/v1/drive-train": (
        "shafts section helices thrust-shares shaft-lines gap slope-parts face-load flank-load contact-temperature "
        "micropitting wear journals thrust losses heat-flows node-temperatures oil-flow"
    ),
    "/v1/drive-train/warm-up": "warm-up alignment",
}
BALANCE = {"safety-band", "heat-flows", "node-temperatures", "oil-flow", "face-heat"}
MICROPITTING = {"micropitting", "micropitting-film", "wear"}
TWO_HELICES = {"helices", "thrust-shares"}
# One ordinary case of each endpoint, drawn in the default run.
CASES = {
    "/v1/coupling": CROWNED,
    "/v1/coupling/sleeve-orbit": "pahl-sleeve-orbit",
    "/v1/coupling/recommendation": "pahl-recommended-crowning",
    "/v1/pumping": "milian-case-1-groove",
    "/v1/scuffing/load-distribution": SLOPED,
    "/v1/scuffing": "xue-pair-1-scuffing",
    "/v1/scuffing/line-contact": "xue-line-contact",
    "/v1/drive-train": GENERATOR,
    "/v1/drive-train/warm-up": "starter-turbo-gear-warm-up",
}
# Figures that the physics of an example leaves out, and why.
WITHOUT = {
    ("milian-table-1-incompressible", "heating"): "no_temperature",
    ("milian-table-1-incompressible", "temperature-map"): "no_temperature",
    ("milian-table-1-incompressible", "lead-correction"): "no_lead_correction",
    ("xue-line-contact-isothermal", "film-temperature"): "isothermal",
    ("xue-line-contact-isothermal", "heat"): "isothermal",
    (GENERATOR, "journals"): "no_plain_bearing",
}
# Figures of what follows from the answer; each has a test of its own.
DERIVED = {"safety", "contact-line-load", "modification-traces", "journals", "section", "shafts"}


@cache
def solved(name: str) -> tuple[Any, Any]:
    example = examples()[name]
    calculation = BY_PATH[example.endpoint]
    request = calculation.request.model_validate({**example.request, "detail": "fields"})
    return request, evaluate(calculation, request)


@cache
def figure(name: str, which: str) -> Figure:
    return drawn_of(examples()[name].endpoint, which, *solved(name))


def drawn_of(endpoint: str, which: str, request: Any, answer: Any) -> Figure:
    (declaration,) = (each for each in BY_PATH[endpoint].figures if each.name == which)
    return declaration.figure(request, answer)


def reason_to_leave_out(name: str, which: str) -> str | None:
    """Return the code of the reason why an example lacks a figure, or None if the example has the figure."""
    request, _ = solved(name)
    if which in MICROPITTING and request.micropitting is None:
        return "not_asked"
    if which in TWO_HELICES and request.gears.gap_width_mm is None:
        return "not_asked"
    if which in BALANCE and not request.asks_for_balance:
        return "not_asked"
    if which == "friction" and request.model.lubrication == "closed_form":
        return "closed_form"
    if which in {"modification", "modification-traces"} and request.modifications == FlankModifications():
        return "no_modification"
    return WITHOUT.get((name, which))


def figures(name: str) -> Iterator[tuple[str, Figure]]:
    """Yield the figures of an example with their names.

    Check that a figure that the example lacks is refused with the expected code.
    """
    for declaration in BY_PATH[examples()[name].endpoint].figures:
        reason = reason_to_leave_out(name, declaration.name)
        if reason is None:
            yield declaration.name, figure(name, declaration.name)
        else:
            with pytest.raises(NoFigure) as refusal:
                figure(name, declaration.name)
            assert refusal.value.code == reason


def numbers(model: Documented, unit: str | None = None) -> Iterator[tuple[str | None, Any]]:
    """Yield all numbers and arrays of an answer, each with the symbol of its unit."""
    # A member without a unit of its own has the unit of its group.
    for member in members(type(model)):
        value, own = getattr(model, member.name), member.unit.symbol if member.unit else unit
        items = value if isinstance(value, list) else [value]
        for group in items:
            if isinstance(group, Documented):
                yield from numbers(group, own)
        if isinstance(value, float):
            yield own, value
        elif value is items and items and isinstance(items[0], int | float | list | type(None)):
            yield own, np.array(items, dtype=float)


def answered(answer: Documented, unit: str | None, shown: np.ndarray[Any, Any]) -> bool:
    """Return whether an array of the answer, or a row of it, has this unit and equals the shown numbers.

    Gaps are ignored. The shown numbers may end with a copy of the first number.
    """
    known = shown[np.isfinite(shown)]
    for own, array in numbers(answer):
        if own != unit or isinstance(array, float):
            continue
        for candidate in array if array.ndim > shown.ndim else (array,):
            flat = candidate[np.isfinite(candidate)]
            closed = flat.size + 1 == known.size and known[-1] == known[0]
            if flat.size and np.array_equal(flat, known[:-1] if closed else known):
                return True
    return False


def test_every_figure_of_the_table_exists() -> None:
    assert set(FIGURES) == set(BY_PATH)
    both = f"{FIGURES['/v1/scuffing']} {FIGURES['/v1/scuffing/load-distribution']}"
    for path, names in {**FIGURES, "/v1/scuffing": both}.items():
        assert set(names.split()) <= {each.name for each in BY_PATH[path].figures}, path


@pytest.mark.parametrize("name", one_per_endpoint(examples()))
def test_examples_give_figures_with_finite_numbers_and_findings(name: str) -> None:
    for which, data in figures(name):
        assert all((data.title, data.finding, data.source)), which
        for panel in data.panels:
            assert panel.lines or panel.bars or panel.rows or panel.map or panel.areas, which
            shown = [line.y for line in panel.lines] + [bars.y for bars in panel.bars]
            for series in shown:
                assert np.isfinite(series).any(), which
            for mark in panel.marks:
                assert np.isfinite([mark.x, mark.y]).all(), which
        assert not re.search(r"\bnan\b", data.subtitle)


# Lines that are no array of the answer: bulk plus flash, magnitudes, ways drawn between points.
COMPUTED = {"pinion", "wheel", "Blok", "sliding speed", "to the next area", "pitch deviation"}
COMPUTED |= {"without coupling", "without heat", "without shafts", "mesh alone"}  # other units' loads


@pytest.mark.parametrize("name", CASES.values())
def test_curves_and_maps_are_the_answers_numbers_in_the_unit_of_their_axis(name: str) -> None:
    _, answer = solved(name)
    seen = 0
    for which, data in figures(name):
        for panel in data.panels if which not in DERIVED else ():
            series = [(line.title, line.y) for line in panel.lines] + [(bar.title, bar.y) for bar in panel.bars]
            if panel.map is not None:
                series.append((panel.map.title, panel.map.values))
            for title, shown in series:
                unit = panel.map.unit if panel.map is not None else panel.y.unit
                if (which == "contact-temperature" and panel.map is None) or title in COMPUTED - {"pinion", "wheel"}:
                    continue
                if which == "flank-temperature":  # bulk and flash, with lines over the flank: see below
                    continue
                if which == "film-temperature":
                    shown = shown.T  # noqa: PLW2901  the answer's field is [x][film]
                if which == "warm-up" and panel.y.title == "temperature":  # a column of the nodes' temperatures
                    assert any(
                        np.array_equal(shown, column)
                        for column in zip(*answer.warm_up.curves.temperature_c, strict=True)
                    ), title
                    continue
                assert answered(answer, unit, np.asarray(shown)), (which, title)
                seen += 1
    assert seen


@pytest.mark.parametrize(
    "name",
    [
        "pahl-axial-displacement",
        "pahl-z-arrangement",
        "milian-case-1-groove",
        "xue-line-contact",
        GENERATOR,
    ],
)
def test_rows_and_levels_are_the_answers_numbers(name: str) -> None:
    request, answer = solved(name)
    known = {found for model in (request, answer) for found in numbers(model) if isinstance(found[1], float)}
    rows = [(panel, row) for _, data in figures(name) for panel in data.panels for row in panel.rows]
    assert rows
    for panel, row in rows:
        assert np.isnan(row.value) or (panel.x.unit, row.value) in known, row.name


def test_contact_temperature_is_bulk_plus_flash() -> None:
    request, answer = solved("xue-pair-1-scuffing")
    (panel,) = figure("xue-pair-1-scuffing", "contact-temperature").panels
    (blok,) = panel.lines
    assert blok.y.max() == pytest.approx(answer.contact_temperature.blok_max_c, rel=1e-12)
    assert np.allclose(blok.y, request.temperatures.bulk_c + np.array(answer.path.blok_flash_k), rtol=1e-15)
    limits = {level.value for level in panel.levels if level.limit}
    assert limits == {request.temperatures.scuffing_c}


def test_film_has_the_roughness_as_its_limit() -> None:
    _, answer = solved("xue-pair-1-scuffing")
    (panel,) = figure("xue-pair-1-scuffing", "film").panels
    (limit,) = [level.value for level in panel.levels if level.limit]
    ratios = np.array(answer.path.thickness_ratio, dtype=float)
    assert np.allclose(panel.lines[0].y / limit, ratios, rtol=1e-12)


def test_friction_map_has_nine_areas_and_holds_the_point() -> None:
    _, answer = solved(CROWNED)
    (panel,) = figure(CROWNED, "friction-regime").panels
    (mark,) = panel.marks
    names = {f"{row}.{column}" for row in "123" for column in "123"}
    assert {area.text.split("\n")[0] for area in panel.areas} == names
    (home,) = [area for area in panel.areas if area.left <= mark.x < area.right and area.bottom <= mark.y < area.top]
    assert home.text.startswith(answer.lubrication.regime.area)
    assert (mark.x, mark.y) == (answer.lubrication.contact_overlap, answer.lubrication.load_capacity_coefficient)
    (way,) = panel.lines
    length = abs(np.log(way.x[1] / way.x[0])) + abs(np.log(way.y[1] / way.y[0]))
    assert length == pytest.approx(answer.lubrication.regime.distance_to_boundary)


@pytest.mark.parametrize("overlap", [0.3, 0.9, 1.1, 1.5, 1.9, 3.0])
@pytest.mark.parametrize("capacity", [0.05, 0.15, 0.3, 0.7])
@pytest.mark.parametrize("mixed", [0.05, 0.07, 0.1])
def test_the_law_of_friction_is_inside_the_drawn_bands(overlap: float, capacity: float, mixed: float) -> None:
    """Also in area 1.2, where the law rises to the paper's single value, and the drawn band does too."""
    (panel,) = figure(CROWNED, "friction-regime").panels
    (home,) = [area for area in panel.areas if area.left <= overlap < area.right and area.bottom <= capacity < area.top]
    (band,) = re.findall("μ (to|[<>≈])? ?([0-9.]+)(?:–([0-9.]+))?", home.text)
    relation, first, last = band
    low = 0.0 if relation in {"to", "<"} else float(first)
    high = np.inf if relation == ">" else float(last or first)
    friction = regime_friction(overlap, capacity, mixed, 0.05)
    assert low * (1 - 1e-9) <= friction <= high * (1 + 1e-9), home.text


def test_contact_track_is_as_wide_as_the_hertz_contact() -> None:
    _, answer = solved(CROWNED)
    (panel,) = figure(CROWNED, "contact-track").panels
    (ribbon,) = panel.ribbons
    assert np.allclose((ribbon.high - ribbon.low) / 2, answer.lubrication.hertz_half_width_mm)
    half = answer.derived.face_width_mm / 2
    assert {level.value for level in panel.levels} == {half, -half}


def test_contact_that_leaves_the_face_is_told_apart() -> None:
    _, answer = solved("starter-coupling-at-its-limits")
    data = figure("starter-coupling-at-its-limits", "contact-track")
    (panel,) = data.panels
    edge = answer.derived.face_width_mm / 2
    contact, above, below = panel.ribbons
    assert np.nanmax(np.abs([contact.low, contact.high])) == pytest.approx(edge)
    assert np.nanmin(above.low) == pytest.approx(edge)
    assert np.nanmax(below.high) == pytest.approx(-edge)
    assert f"reaches {np.nanmax(above.high):.1f} mm from the middle; the face ends at {edge:g} mm" in data.finding


def test_no_crowning_serves_because_two_bounds_of_the_ratio_contradict_each_other() -> None:
    data = figure("starter-coupling-crowning-infeasible", "crowning-scan")
    oil = data.panels[1]
    (leaves,) = [level.value for level in oil.levels if level.vertical and level.limit]
    needed = float(np.interp(0.0, -np.log(oil.lines[0].y), oil.lines[0].x))
    told = [float(number) for number in re.findall(r"[0-9.]+[0-9]", data.finding)]
    assert told == [pytest.approx(leaves, abs=0.05), pytest.approx(needed, rel=5e-3)]
    assert leaves < needed


def test_a_coefficient_of_friction_without_meaning_is_not_stated() -> None:
    assert "μ has no meaning" in figure("xue-line-contact-isothermal", "contact").finding
    assert "μ = 0.047" in figure("xue-line-contact-newtonian", "contact").finding


def test_the_mach_map_tells_what_is_marked_and_what_decides() -> None:
    _, answer = solved("milian-case-1")
    data = figure("milian-case-1", "mach-map")
    marked = max(float(mark.text) for panel in data.panels for mark in panel.marks)
    assert f"up to {marked:g} in the slices (marked), 1.08 at the ends" in data.finding
    assert f"{answer.choking.outflow_mach:.3g} outwards (choked)" in data.finding


def test_a_given_friction_and_a_point_below_the_scale_are_named() -> None:
    assert figure("pahl-z-arrangement", "friction-regime").finding.endswith("given: μ = 0.2, whatever the area")
    (mark,) = figure("starter-coupling-at-its-limits", "friction-regime").panels[0].marks
    assert mark.text.endswith("Tr = 0, below the scale")


@pytest.mark.ci
def test_choking_scan_repeats_the_pumping_endpoint_and_crosses_its_limits_at_the_speeds_found() -> None:
    _, answer = solved("milian-case-1-choking")
    data = figure("milian-case-1-choking", "choking")
    outflow, _, pressures = data.panels
    assert answer.inflow_choking_speed_rpm is None
    limits = (answer.axial_choking_speed_rpm, answer.radial_choking_speed_rpm)
    for panel, found in zip((outflow, pressures), limits, strict=True):
        (line,) = panel.lines
        (limit,) = [level.value for level in panel.levels if level.limit]
        assert line.x.size >= 24
        assert np.interp(found, line.x, line.y) == pytest.approx(limit, rel=5e-3)
    pressure = pressures.lines[0]
    body = {**examples()["milian-case-1-choking"].request, "operation": {"pinion_speed_rpm": float(pressure.x[3])}}
    pumping = BY_PATH["/v1/pumping"]
    spaces = evaluate(pumping, pumping.request.model_validate({**body, "detail": "summary"}))
    peaks = [spaces.pinion_spaces.peak_pressure_ratio, spaces.wheel_spaces.peak_pressure_ratio]
    assert pressure.y[3] == pytest.approx(max(peaks), rel=1e-9)


@pytest.mark.ci
def test_the_curve_of_choking_bends_where_gas_reaches_an_end_supersonic() -> None:
    """Above the bend, gas reaches an end of the face at supersonic speed."""
    # Above the bend, the Mach number of an expansion to ambient pressure rises less than half as fast with the speed of
    # the pinion as below the bend.
    request, _ = solved("starter-choking-speed")
    assert "bend" in figure("starter-choking-speed", "choking").finding
    mesh = prepare(request.inputs().setup)
    speeds = np.array([9300.0, 9500.0, 9900.0, 10100.0]) * np.pi / 30
    flows = [flow_at(mesh, mesh.spaces[1], speed, 100) for speed in speeds]
    assert [flow.largest_mach > 1.0 + 1e-9 for flow in flows] == [False, False, True, True]
    demand = [flow.exit_demand for flow in flows]
    assert demand[3] - demand[2] < 0.5 * (demand[1] - demand[0])


def partly_unsolved() -> tuple[Any, Any]:
    """Return a request, and an answer whose thermal path has two unsolved and two warned points."""
    # A single solved point lies between the unsolved points.
    request, answer = solved("xue-pair-1-scuffing")
    count = len(answer.path.psi)
    status = ["ok"] * count
    film = 0.3 + 0.001 * np.arange(count)
    for index in (4, 6):
        status[index], film[index] = "no_solution", np.nan
    status[20] = status[21] = "ok_with_warnings"
    flash = 40.0 * film
    known = answer.result
    thermal = ThermalPath(
        status=tuple(status),
        flash_bound=np.full(count, np.nan),
        film_bound=np.full(count, np.nan),
        film_max_temperature=300.0 + flash,
        minimum_film=1e-6 * film,
        central_film=1e-6 * film,
        pinion_flash=flash,
        wheel_flash=flash,
        friction_coefficient=film,
        max_pressure=1e6 * flash,
    )
    thinnest = replace(known.film, thickness_ratio=None, thickness_regime=None)
    path = replace(known.path, status=tuple(status), thermal=thermal)
    return request, answer.model_copy().read_from(replace(known, path=path, film=thinnest, unsolved_points=2))


def rows_of(data: Figure) -> list[list[str]]:
    return list(csv.reader(io.StringIO(table(data).decode())))


def test_unsolved_points_are_gaps_counted_in_the_subtitle() -> None:
    request, answer = partly_unsolved()
    for which in ("contact-temperature", "film", "friction"):
        data = drawn_of("/v1/scuffing", which, request, answer)
        assert "2 points without solution" in data.subtitle
        line = data.panels[0].lines[0]
        assert np.flatnonzero(np.isnan(line.y)).tolist() == [4, 6]
        (span,) = data.panels[0].spans
        psi = answer.path.psi
        assert psi[19] < span.start < psi[20] < psi[21] < span.stop < psi[22]
        draw(data, "svg")
        cells = [row[1] for row in rows_of(data)]
        assert cells[5] == cells[7] == ""


def test_a_case_without_solution_has_no_figure() -> None:
    request, answer = solved(CROWNED)
    unsolved = answer.model_copy(update={"status": "no_solution"})
    for declaration in BY_PATH["/v1/coupling"].figures:
        with pytest.raises(NoFigure, match="no solution") as reason:
            declaration.figure(request, unsolved)
        assert reason.value.code == "no_solution"


@pytest.mark.parametrize(("image_format", "start"), [("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")])
@pytest.mark.parametrize(("name", "which"), [(CROWNED, "tooth-motion"), ("milian-case-1-groove", "pressure-map")])
@pytest.mark.ci
def test_equal_figures_give_equal_bytes_without_a_date(name: str, which: str, image_format: str, start: bytes) -> None:
    first = draw(figure(name, which), image_format)
    assert first == draw(figure(name, which), image_format)
    assert first.startswith(start)
    assert not re.search(rb"<dc:date>|/CreationDate|/ModDate|[0-9]{4}-[0-9]{2}-[0-9]{2}T", first)


def test_svg_keeps_its_text_and_themes_differ() -> None:
    light, dark = (draw(figure(CROWNED, "losses"), "svg", theme) for theme in ("light", "dark"))
    assert b"friction power of one mesh" in light
    assert b"#ffffff" in light.lower()
    assert b"#ffffff" not in dark.lower()


def test_csv_holds_the_numbers_with_units_in_the_header() -> None:
    _, answer = solved(CROWNED)
    rows = rows_of(figure(CROWNED, "tooth-loads"))
    assert rows[0][1] == "tangential force [N]"
    assert [float(row[1]) for row in rows[1:]] == answer.load_distribution.curves.tangential_force_n
    grid = rows_of(figure(SLOPED, "flank-load"))
    assert grid[0][:3] == [
        "profile (0: A, 1: E) [-]",
        "position on the face, from the end that meshes first [mm]",
        "line load [N/mm]",
    ]
    _, flank = solved(SLOPED)
    assert [float(row[2]) for row in grid[1:]] == [each for row in flank.flank.line_load_n_per_mm for each in row]


@pytest.mark.ci
def test_comparison_draws_the_variant_dashed_in_the_same_hue() -> None:
    own, other = (figure(name, "tooth-motion") for name in (CROWNED, "pahl-slightly-crowned"))
    both = compared(own, other, "variant A")
    assert "dashed: variant A" in both.subtitle
    for panel, first, second in zip(both.panels, own.panels, other.panels, strict=True):
        result, variant = panel.lines
        assert result is first.lines[0]
        assert variant.role is Role.VARIANT
        assert variant.hue is result.hue
        assert np.array_equal(variant.y, second.lines[0].y)
    assert draw(both, "svg") != draw(own, "svg")
    section = compared(figure("xue-pair-4-modified", "section"), figure("xue-pair-1-modified", "section"), "A")
    dashed = {line.title for line in section.panels[0].lines if line.role is Role.VARIANT}
    assert {"pinion, 23 teeth", "wheel, 30 teeth", "line of action", "usable flanks"} <= dashed
    assert "the same in A" in compared(own, own, "A").subtitle
    spaces = compared(figure("milian-case-1-groove", "pressure-map"), figure("milian-case-1", "pressure-map"), "A")
    assert len(spaces.panels) == 4
    sloped, modified = (figure(name, "flank-pressure") for name in (SLOPED, "xue-pair-4-modified"))
    maps = compared(sloped, modified, "A")
    assert len(maps.panels) == 2
    left, right = (panel.map for panel in maps.panels)
    assert left.range == right.range


@pytest.mark.parametrize(
    ("name", "image_format", "theme"),
    [
        *((name, "svg", "light") for name in CASES.values()),
        *(pytest.param(name, "png", "dark", marks=pytest.mark.slow) for name in CASES.values()),
    ],
)
@pytest.mark.ci
def test_every_figure_of_an_example_is_drawn(name: str, image_format: str, theme: Any) -> None:
    """The figures of all examples are drawn in `test_figure_labels.py`."""
    for which, data in figures(name):
        assert len(draw(data, image_format, theme)) > 5_000, which


def test_load_along_the_face_is_another_unit_s_without_the_effect() -> None:
    name = TURBO
    (panel,) = figure(name, "face-load").panels
    lines = {line.title: line.y for line in panel.lines}
    assert set(lines) == {"as asked", "without coupling", "without heat", "without shafts", "mesh alone"}
    calculation = BY_PATH["/v1/drive-train"]
    for title, effects in (
        ("without coupling", {"coupling": False}),
        ("without heat", {"thermal": False}),
        ("mesh alone", {"shafts": False, "coupling": False, "thermal": False}),
    ):
        body = {**examples()[name].request, "effects": effects}
        other = evaluate(calculation, calculation.request.model_validate(body)).misalignment.curves
        assert np.allclose(lines[title], other.line_force_n_per_mm, rtol=1e-12)
    assert lines["mesh alone"][0] > 2 * lines["as asked"][0], "ground for the tilt of shafts that do not tilt"


def test_shaft_lines_carry_the_reactions_at_their_bearings() -> None:
    request, answer = solved(GENERATOR)
    panels, shafts = figure(GENERATOR, "shaft-lines").panels, (request.pinion_shaft, request.wheel_shaft)
    for panel, given, state in zip(panels, shafts, answer.shafts, strict=True):
        assert sorted(mark.x for mark in panel.marks) == sorted(2 * [each.position_mm for each in given.bearings])
        heights = [value for bearing in state.bearings for value in bearing.displacement_um]
        assert sorted(mark.y for mark in panel.marks) == pytest.approx(sorted(heights), abs=1e-6)


def test_thrust_names_the_bearing_of_each_limit_where_they_differ() -> None:
    request, answer = solved(GENERATOR)

    def limits(pinion: float | None, wheel: float | None) -> set[tuple[str, float]]:
        thrusts = {"pinion_shaft.ultimate_thrust": pinion, "wheel_shaft.ultimate_thrust": wheel}
        inputs = changed(request.inputs(), thrusts)
        (panel,) = drive_train.thrust(inputs, units.shown(answer.result)).panels
        assert {-level.value for level in panel.levels} == {level.value for level in panel.levels}
        return {(level.name, level.value) for level in panel.levels if level.value > 0.0}

    assert limits(None, None) == set()
    assert limits(None, 4e4) == limits(4e4, 4e4) == {("half the ultimate load", 2e4)}
    assert limits(2e4, 4e4) == {("half the ultimate, pinion", 1e4), ("half the ultimate, wheel", 2e4)}


def test_rounding_errors_are_no_misalignment() -> None:
    request, answer = solved(GENERATOR)
    slope = replace(answer.result.misalignment, thermal_slope=-7.6e-21, thermal_range=12e-6)
    finding = drive_train.gap(request.inputs(), units.shown(replace(answer.result, misalignment=slope))).finding
    assert "heat 0 µm" in finding


def test_a_loss_that_is_not_known_is_not_calculated() -> None:
    losses = figure(GENERATOR, "losses")
    (panel,) = losses.panels
    values = {row.name: row.value for row in panel.rows}
    assert np.isnan(values["bearings"])
    assert losses.finding.endswith("; without the bearings")
    image = draw(losses, "svg").decode()
    assert "not calculated" in image
    assert ">0 W<" not in image
    (panel,) = figure(TURBO, "losses").panels
    assert panel.rows[0].name == "plain bearings"
    assert panel.rows[0].value > 1e5


@pytest.mark.ci
def test_bounds_of_the_axial_load_stand_behind_its_value() -> None:
    image = draw(figure(GENERATOR, "thrust"), "svg").decode()
    for text in ("−8895 N", "(−20 993 to 3203)"):
        assert f">{text}<" in image


def test_flanks_without_modification_are_one_sentence() -> None:
    with pytest.raises(NoFigure, match="not modified") as reason:
        figure("xue-pair-1", "modification")
    assert reason.value.path == "modifications"


def test_the_path_of_contact_has_its_points_a_to_e() -> None:
    _, answer = solved(SLOPED)
    (panel, *_) = figure(SLOPED, "path-of-contact").panels
    points = {level.name: level.value for level in panel.levels}
    assert set(points) == set("ABCDE")
    assert (points["A"], points["E"]) == (0.0, 1.0)
    pitch, path = answer.geometry.transverse_base_pitch_mm, answer.geometry.path_of_contact_mm
    assert points["D"] == pytest.approx(pitch / path, rel=1e-9)
    assert points["B"] == pytest.approx(1.0 - pitch / path, rel=1e-9)
    assert panel.y.label == "line load w,\u00a0N/mm"


def test_the_face_is_in_mm_from_the_same_end_everywhere() -> None:
    for name, which, width in (
        (SLOPED, "flank-load", 40.0),
        (GENERATOR, "gap", 110.0),
        ("starter-compressor-gear-groove", "heating", 200.0),
        ("starter-compressor-gear-groove", "mach-map", 200.0),
    ):
        x = figure(name, which).panels[0].x
        assert (x.title, x.unit) == ("position on the face, from the end that meshes first", "mm")
        assert x.limits == pytest.approx((0.0, width))


@pytest.mark.parametrize("name", ["starter-industrial-scuffing", "xue-pair-1-scuffing"])
def test_the_flank_is_as_hot_as_the_answer_says_and_shows_the_lines_that_are_checked(name: str) -> None:
    _, answer = solved(name)
    (panel,) = figure(name, "flank-temperature").panels
    shown = panel.map.values
    assert shown == pytest.approx(answer.contact_temperature.bulk_c + np.array(answer.flank.flash_temperature_k))
    (mark,) = panel.marks
    assert panel.x.limits is not None
    assert mark.x == pytest.approx(answer.flash.blok_at_face_mm, abs=panel.x.limits[1] / 100)
    lines = {line.title: line for line in panel.lines}
    assert (lines["feature line"].x[-1], lines["feature line"].y[-1]) == (panel.x.limits[1], 1.0)
    solved_at, by_formula = answer.flash.thermal_ehl_at_face_mm, answer.flash.blok_at_face_mm
    hottest = "hottest profile" if solved_at is None else "hottest profile by thermal EHL"
    assert set(lines) == ({"feature line"} if answer.hottest_path is None else {"feature line", hottest})
    if answer.hottest_path is not None:
        assert lines[hottest].x[0] == (by_formula if solved_at is None else solved_at)


@pytest.mark.parametrize("name", ["starter-industrial-scuffing", "xue-pair-1-scuffing"])
def test_the_least_safety_along_the_path_is_that_of_the_answer(name: str) -> None:
    _, answer = solved(name)
    panels = figure(name, "safety").panels
    bloks = [next(line for line in panel.lines if line.title == "Blok") for panel in panels]
    # the profile line is the one through the hottest solved contact, where Blok's flash is nearly the largest
    least = min(np.nanmin(blok.y) for blok in bloks)
    assert answer.safety.blok_factor * (1 - 1e-9) <= least < answer.safety.blok_factor * 1.01
    assert np.nanmin(bloks[0].y) == pytest.approx(answer.safety.feature_line_factor, rel=1e-9)
    for panel in panels:
        assert [level.value for level in panel.levels if level.limit] == [1.0]
        assert panel.y == panels[0].y, "both on one scale"


def test_the_worst_contact_line_has_the_largest_load_and_leans_at_the_base_helix_angle() -> None:
    _, answer = solved(SLOPED)
    (panel,) = figure(SLOPED, "contact-line-load").panels
    worst = next(line for line in panel.lines if line.title == "highest loaded line")
    assert np.nanmax(worst.y) == pytest.approx(answer.load.max_line_load_n_per_mm, rel=5e-3)
    # A line of contact ends at A or E of the path: over the face it is as long as the path over tan(beta_b).
    reach = answer.geometry.path_of_contact_mm / np.tan(np.radians(answer.geometry.base_helix_angle_deg))
    along = worst.x[np.isfinite(worst.y)]
    assert along[-1] - along[0] <= reach + 0.5
    place = answer.load.max_at
    left = (1.0 - place.profile_fraction) * reach
    assert along[0] == pytest.approx(max(place.face_fraction * 40.0 - left, 0.0), abs=0.5)
    assert along[-1] == pytest.approx(min(place.face_fraction * 40.0 + place.profile_fraction * reach, 40.0), abs=0.5)


def test_charts_of_each_gear_are_cuts_through_the_modification() -> None:
    request, answer = solved(SLOPED)
    pinion, wheel, helix = figure(SLOPED, "modification-traces").panels
    removed = -np.array(answer.flank.modification_um)
    for panel in (pinion, wheel):
        assert np.allclose(panel.lines[0].y, removed[:, removed.shape[1] // 2], rtol=1e-12)
    assert np.allclose(helix.lines[0].y, removed[removed.shape[0] // 2], rtol=1e-12)
    # The pinion's tip meets at E, the wheel's at A.
    gears = request.inputs().gears
    tips = [2e3 * gear.tip_radius for gear in (gear_pair(gears).pinion, gear_pair(gears).wheel)]
    assert pinion.lines[0].x[-1] == pytest.approx(tips[0])
    assert wheel.lines[0].x[0] == pytest.approx(tips[1])
    assert {level.name: level.value for level in pinion.levels}["E"] == pytest.approx(tips[0])


@pytest.mark.parametrize("name", ["fzg-type-a", SLOPED, "starter-industrial-gear-loads"])
def test_teeth_of_the_transverse_section_touch_and_do_not_overlap(name: str) -> None:
    request, answer = solved(name)
    (panel,) = figure(name, "section").panels
    pinion, wheel = (Polygon(np.column_stack([shape.x, shape.y])).buffer(0.0) for shape in panel.shapes)
    assert pinion.intersection(wheel).area < 1e-3 * request.inputs().gears.normal_module ** 2 * 1e6
    assert pinion.distance(wheel) < 1e-3
    places = {mark.text: np.hypot(mark.x, mark.y) * np.sign(mark.x) for mark in panel.marks}
    assert places["C"] == 0.0
    assert places["E"] - places["A"] == pytest.approx(answer.geometry.path_of_contact_mm)
    assert places["D"] - places["A"] == pytest.approx(answer.geometry.transverse_base_pitch_mm)
    usable = [line for line in panel.lines if line.title == "usable flanks"]
    pair = gear_pair(request.inputs().gears)
    for line, gear, radius in zip(
        usable, (pair.pinion, pair.wheel), (pair.pinion_working_radius, -pair.wheel_working_radius), strict=True
    ):
        ends = np.hypot(line.x, line.y + 1e3 * radius)[[0, -1]]
        assert ends == pytest.approx([1e3 * gear.form_radius, 1e3 * gear.tip_radius])


def test_the_sketch_of_the_shafts_is_to_scale() -> None:
    request, answer = solved(TURBO)
    (panel,) = figure(TURBO, "shafts").panels
    spans = {
        (shape.title, *(round(float(each), 6) for each in (shape.x.min(), shape.x.max(), np.ptp(shape.y))))
        for shape in panel.shapes
    }
    marks = {(mark.text, mark.x, round(mark.y, 6)) for mark in panel.marks}
    heights = (0.0, round(answer.derived.centre_distance_mm, 6))
    used = (answer.derived.pinion_shaft, answer.derived.wheel_shaft)
    for shaft, derived, height in zip((request.pinion_shaft, request.wheel_shaft), used, heights, strict=True):
        for place, each in enumerate(shaft.bearings, 1):
            at, half = each.position_mm, each.width_mm / 2
            assert (f"{place}", at, height) in marks
            assert ("plain bearings", at - half, at + half, 1.3 * each.diameter_mm) in spans
        ends = np.cumsum([shaft.start_mm, *(each.length_mm for each in shaft.sections)])
        for start, end, section in zip(ends, ends[1:], derived.sections, strict=False):
            assert ("shafts", start, end, round(section.outer_diameter_mm, 6)) in spans
    assert {span[1:3] for span in spans if span[0] == "gears"} == {(320.0, 520.0)}


def test_journals_lie_at_their_eccentricity_on_the_curve_of_their_load() -> None:
    _, answer = solved(TURBO)
    for panel, shaft in zip(figure(TURBO, "journals").panels, answer.shafts, strict=True):
        wall, *curves = panel.lines
        assert np.allclose(np.hypot(wall.x, wall.y), 1.0)
        for curve, mark, bearing in zip(curves, panel.marks, shaft.bearings, strict=True):
            assert np.hypot(mark.x, mark.y) == pytest.approx(bearing.eccentricity_ratio, rel=1e-6)
            assert (curve.x[-1], curve.y[-1]) == pytest.approx((mark.x, mark.y), abs=1e-6)
            assert (curve.x[0], curve.y[0]) == pytest.approx((0.0, 0.0), abs=1e-12)
