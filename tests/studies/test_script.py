"""A study in a script gives the lines of the service with any `map`, and goes on from the points that were kept."""

import asyncio
import json
import os
import signal
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from functools import partial
from itertools import islice
from multiprocessing import get_context
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from weakref import WeakSet

import httpx
import pytest
from hypothesis import strategies as st

from app.errors import OtherSources, PoolLost, StudyEnded, Unprocessable, WorkerLost
from app.evaluate import evaluate
from app.examples import study_bodies
from app.sources import SOURCES
from app.studies import points, study
from app.studies.kept import Kept
from app.studies.points import Chunk, Point, solve_chunk
from app.studies.script import MapPool
from tests.support.pools import QUESTION, at
from tests.support.properties import examples
from tests.support.studies import study_of, timeless

HELD = "axial_thrust.design_force_n"
SWEEP, COUPLING = "/v1/sweep", "pahl-axial-displacement"
TORQUE, THRUST, SPEED = "operation.torque_n_m", "axial_thrust.force_n", "operation.speed_rpm"
HELIX = {"path": "modifications.helix_slope_um", "min": 0, "max": 60}
UNIT = {
    "request": {**study_of("starter-turbo-gear-drive-train")["request"], "model": {"lubrication": "closed_form"}},
}
GRID = study_of(COUPLING, vary=[{"path": TORQUE, "start": 1000, "stop": 3000, "count": 40}], outputs=[THRUST])
SCATTER = [{"path": "friction.coefficient", "distribution": "normal", "mean": 0.15, "deviation": 0.03}]
STUDIES: dict[str, tuple[str, dict[str, Any]]] = {
    "grid": (SWEEP, GRID),
    "cases": (SWEEP, study_of(COUPLING, cases=[{TORQUE: 2000}, {SPEED: 0.1}, {}])),
    "sample": (SWEEP, study_of(COUPLING, sample={"count": 16, "ranges": [{"path": TORQUE, "min": 1000, "max": 3000}]})),
    "sensitivity": ("/v1/sensitivity", study_of(COUPLING, outputs=[THRUST])),
    "spectrum": ("/v1/spectrum", study_of(COUPLING, cases=[{}], tolerances={"count": 16, "inputs": SCATTER})),
}
UNITS: dict[str, tuple[str, dict[str, Any]]] = {
    "corners": (
        "/v1/drive-train/corners",
        {**UNIT, "ranges": [{"path": "thermal.wall_response", "values": [0.3, 1.0]}]},
    ),
    "design": (
        "/v1/drive-train/design",
        {**UNIT, "variables": [HELIX], "objective": "safety.blok_flank", "evaluations": 3},
    ),
}


def futures(function: Callable[[Any], Any], calls: Iterable[Any]) -> list[Future[Any]]:
    """Give futures of the results, as `map` of a Dask client does."""
    found: list[Future[Any]] = [Future() for _ in calls]
    for future, call in zip(found, calls, strict=True):
        future.set_result(function(call))
    return found


def nothing(_: Callable[[Any], Any], calls: Iterable[Any]) -> Iterator[Any]:
    raise AssertionError(f"asked for {calls}")


def solved(endpoint: str, body: dict[str, Any], **options: Any) -> list[dict[str, Any]]:
    return timeless(list(study(endpoint, body, **options)))


def served(post: Callable[..., httpx.Response], endpoint: str, body: dict[str, Any]) -> list[dict[str, Any]]:
    return timeless([json.loads(line) for line in post(endpoint, body).text.splitlines()])


@pytest.mark.parametrize("name", [*STUDIES, *(pytest.param(name, marks=pytest.mark.ci) for name in UNITS)])
def test_the_lines_are_those_of_the_service(name: str, post: Callable[..., httpx.Response]) -> None:
    endpoint, body = (STUDIES | UNITS)[name]
    assert solved(endpoint, body) == served(post, endpoint, body)


@pytest.mark.parametrize("name", STUDIES)
def test_any_map_gives_the_same_lines(name: str, tmp_path: Path) -> None:
    expected = solved(*STUDIES[name])
    with ThreadPoolExecutor(2) as threads:
        for mapping in (futures, threads.map):
            assert solved(*STUDIES[name], map=mapping) == expected
    assert solved(*STUDIES[name], kept=tmp_path / "kept") == expected


@pytest.mark.ci
def test_processes_give_the_same_lines() -> None:
    with ProcessPoolExecutor(2, get_context("spawn")) as processes:
        for endpoint, body in STUDIES.values():
            assert solved(endpoint, body, map=processes.map) == solved(endpoint, body)


def test_a_study_runs_where_an_event_loop_runs() -> None:
    async def inside() -> list[dict[str, Any]]:
        return solved(SWEEP, GRID)

    assert asyncio.run(inside()) == solved(SWEEP, GRID)


def test_what_is_no_study_is_told_those_that_there_are() -> None:
    with pytest.raises(Unprocessable, match="/v1/spectrum"):
        study("/v1/coupling", {})


def first_points(kept: Path, lines: int) -> None:
    """Run the study until it has sent so many lines, and leave it."""
    for _ in islice(study(SWEEP, GRID, kept=kept), lines):
        pass


@examples(10, 60, lines=st.integers(1, 40), cut=st.integers(0, 1500))
def test_a_second_run_solves_what_is_missing(lines: int, cut: int) -> None:
    with TemporaryDirectory() as folder:
        kept = Path(folder) / "points.jsonl"
        first_points(kept, lines)
        written = kept.read_bytes()
        left = written[: max(len(written) - cut, 0)]
        kept.write_bytes(left)
        assert solved(SWEEP, GRID, kept=kept) == solved(SWEEP, GRID)
        assert kept.read_bytes().startswith(left[: left.rfind(b"\n") + 1])
        assert len(kept.read_bytes().splitlines()) == 1 + 40
        assert solved(SWEEP, GRID, kept=str(kept), map=map_of_flow_alone) == solved(SWEEP, GRID)


def map_of_flow_alone(function: Callable[[Any], Any], calls: Iterable[Any]) -> Iterator[Any]:
    """Solve no points; the oil flow of a study is sized in every run."""
    for call in calls:
        assert call[0] is not solve_chunk
        yield function(call)


def test_a_larger_study_shares_the_points_of_a_smaller_one(tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    torques = [{TORQUE: 1000.0}, {TORQUE: 2000.0}, {TORQUE: 3000.0}]
    small, large = (study_of(COUPLING, cases=cases, outputs=[THRUST]) for cases in (torques[1:2], torques))
    solved(SWEEP, small, kept=kept)
    asked: list[int] = []

    def noted(function: Callable[[Any], Any], calls: list[Any]) -> Iterator[Any]:
        asked.extend(len(call[1][1]) for call in calls if call[0] is solve_chunk)
        return map(function, calls)

    assert solved(SWEEP, large, kept=kept, map=noted) == solved(SWEEP, large)
    assert sum(asked) == 2
    assert solved(SWEEP, {**small, "outputs": ["losses.friction_power_w"]}, kept=kept)[1]["out"] != []


def test_points_of_other_solvers_are_refused_with_both_hashes(tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    first_points(kept, 2)
    before = kept.read_text("utf-8").replace(SOURCES, "0" * 64)
    kept.write_text(before, "utf-8")
    with pytest.raises(OtherSources) as caught:
        study(SWEEP, GRID, kept=kept)
    assert SOURCES in str(caught.value)
    assert "0" * 64 in str(caught.value)
    assert kept.read_text("utf-8") == before


@pytest.mark.parametrize("content", [b"notes", b"notes\nmore\n", b"[1]\n", b"{}\n", b'{"sources": 1'])
def test_a_file_that_holds_something_else_is_left_alone(tmp_path: Path, content: bytes) -> None:
    kept = tmp_path / "notes"
    kept.write_bytes(content)
    with pytest.raises(ValueError, match="holds no kept points; name another file"):
        study(SWEEP, GRID, kept=kept)
    assert kept.read_bytes() == content


def test_a_damaged_line_is_named(tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    first_points(kept, 30)
    head, second, *rest = kept.read_bytes().splitlines(keepends=True)
    kept.write_bytes(head + second[:20] + b"\n" + b"".join(rest))
    with pytest.raises(ValueError, match="line 2 of"):
        study(SWEEP, GRID, kept=kept)


def test_points_that_failed_are_solved_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = tmp_path / "kept"
    with monkeypatch.context() as patch:
        patch.setattr(points, "evaluate", partial(broken, evaluate))
        lines = solved(SWEEP, GRID, kept=kept)
    assert lines[-1]["counts"] == {"failed": 20, "ok": 20}
    assert solved(SWEEP, GRID, kept=kept) == solved(SWEEP, GRID)


def broken(whole: Callable[..., Any], calculation: Any, request: Any) -> Any:
    if request.operation.torque_n_m > 2000.0:
        raise MemoryError
    return whole(calculation, request)


def kill() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.ci
def test_lost_processes_are_told_and_the_study_goes_on(tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    with ProcessPoolExecutor(2, get_context("spawn")) as processes:

        def shot(function: Callable[[Any], Any], calls: list[Any]) -> Iterator[Any]:
            if kept.exists() and len(kept.read_bytes().splitlines()) > 2:
                with suppress(BrokenProcessPool):
                    processes.submit(kill).result()
            return processes.map(function, calls)

        with pytest.raises(PoolLost, match="kept"):
            list(study(SWEEP, GRID, map=shot, kept=kept))
    assert 2 < len(kept.read_bytes().splitlines()) < 1 + 40
    assert solved(SWEEP, GRID, kept=kept) == solved(SWEEP, GRID)


@pytest.mark.parametrize(
    ("error", "told"),
    [
        (type("KilledWorker", (Exception,), {})(), WorkerLost),
        (type("ClosedClientError", (Exception,), {})(), PoolLost),
        (ConnectionResetError(), PoolLost),
        (asyncio.CancelledError(), PoolLost),
        (BrokenProcessPool(), PoolLost),
        (ZeroDivisionError(), ZeroDivisionError),
    ],
)
def test_what_is_lost_has_one_name_whatever_the_map(error: BaseException, told: type[Exception]) -> None:
    def lost(_: Callable[[Any], Any], __: list[Any]) -> Iterator[Any]:
        raise error

    with pytest.raises(told):
        MapPool(lost, None).submit(len, []).result()


def test_busy_processes_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Four processes work for 100 s each within 100 s."""
    clock = [0.0]
    monkeypatch.setattr("app.studies.script.time.monotonic", lambda: clock[0])
    pool = MapPool(lambda _, calls: [Chunk([Point("ok", [1.0], [])], 100.0) for _ in calls], None)
    assert pool.slots == 1
    for _ in range(4):
        clock[0] += 25.0
        pool.submit(solve_chunk, QUESTION, [at(0)], 0.5).result()
    assert pool.slots == 4


class Task:
    """What Dask takes back with the last reference to it."""

    def __init__(self, value: Any) -> None:
        self.value = value

    def result(self) -> Any:
        return self.value


def test_leaving_lets_go_of_what_was_sent_ahead() -> None:
    tasks = WeakSet[Task]()

    def sent(function: Callable[[Any], Any], calls: list[Any]) -> list[Task]:
        own = [Task(function(call)) for call in calls]
        tasks.update(own)
        return own

    lines = iter(study(SWEEP, GRID, map=sent))
    for _ in range(3):
        next(lines)
    assert len(tasks) > 10
    lines.close()  # type: ignore[attr-defined]  # a generator
    assert not tasks


@pytest.mark.parametrize("name", [*STUDIES, pytest.param("design", marks=pytest.mark.ci)])
def test_a_frame_has_a_row_for_each_result(name: str) -> None:
    endpoint, body = (STUDIES | UNITS)[name]
    table = study(endpoint, body).frame()
    lines = solved(endpoint, body)
    assert len(table) == (1 if name == "spectrum" else len(lines) - (1 if name == "sensitivity" else 2))


def test_fields_that_move_together_are_columns_of_their_own() -> None:
    axis = {"path": [TORQUE, SPEED], "values": [[1000, 500], [2000, 700]]}
    table = study(SWEEP, study_of(COUPLING, vary=[axis], outputs=[THRUST])).frame()
    assert list(table.columns) == [TORQUE, SPEED, THRUST, "status"]
    assert list(table[SPEED]) == [500, 700]


def test_a_case_leaves_the_fields_empty_that_it_does_not_set() -> None:
    table = study(SWEEP, study_of(COUPLING, cases=[{TORQUE: 2000}, {SPEED: 700}], outputs=[THRUST])).frame()
    assert list(table.columns) == [TORQUE, THRUST, "status", SPEED]
    assert list(table[SPEED].isna()) == [True, False]


@pytest.mark.ci
def test_a_study_without_an_end_has_no_frame() -> None:
    unsolvable = {**UNITS["design"][1], "objective": "safety.thermal_ehl_feature"}
    with pytest.raises(StudyEnded, match="cannot start"):
        study("/v1/drive-train/design", unsolvable).frame()


def test_progress_counts_the_points() -> None:
    run = study(SWEEP, study_bodies(SWEEP)["cases"]["value"])
    assert (run.done, run.total) == (0, 2)
    list(run)
    assert run.done == 2


def test_studies_that_share_a_file_at_once_keep_their_own_assumptions(tmp_path: Path) -> None:
    """Lines of two runs alternate; each batch states its own assumptions, whatever line stands before it."""
    file = tmp_path / "points.jsonl"
    one, other = Kept(file), Kept(file)
    points = {name: Point("ok", [1.0], [], assumptions=({"path": name},)) for name in ("a", "b")}
    for run, name, number in ((one, "a", 1), (other, "b", 1), (one, "a", 2), (other, "b", 2)):
        run.add([f"{name}{number}"], Chunk([points[name]], 0.1))
    read = Kept(file)
    assert {case: read.leading([case]) for case in ("a1", "a2")} == {"a1": [points["a"]], "a2": [points["a"]]}
    assert read.leading(["b1", "b2"]) == [points["b"]] * 2


@pytest.mark.parametrize("content", [b'{"type": "header", "sources": "x"}\n{"type"', b"null\n"])
def test_a_file_of_something_else_is_refused_untouched(tmp_path: Path, content: bytes) -> None:
    file = tmp_path / "results.jsonl"
    file.write_bytes(content)
    with pytest.raises(ValueError, match="holds no kept points"):
        Kept(file)
    assert file.read_bytes() == content


def test_an_error_of_the_function_itself_is_not_a_lost_process() -> None:
    def broken(*_: object) -> list[object]:
        raise FileNotFoundError("no table")

    body = next(iter(study_bodies("/v1/sweep").values()))["value"]
    with pytest.raises(FileNotFoundError, match="no table"):
        list(study("/v1/sweep", body, map=broken))


def test_a_search_knows_in_the_end_how_many_points_it_took() -> None:
    run = study("/v1/solve-for", study_of(COUPLING, find={"path": TORQUE}, output=HELD, equals=10000))
    totals = [run.total]
    for line in run:
        assert run.done <= run.total, line
        totals.append(run.total)
    assert totals[0] == 21
    assert run.done == run.total == line["points"] > 21


def test_points_that_were_kept_do_not_count_for_the_pace(tmp_path: Path) -> None:
    kept = tmp_path / "kept"
    first_points(kept, 20)
    known = len(kept.read_bytes().splitlines()) - 1
    run = study(SWEEP, GRID, kept=kept)
    list(run)
    assert run._clock.kept == known > 0
    assert run.done == 40
