"""A path of contacts: the same as each alone, and a failed point costs only itself."""

from dataclasses import replace

import pytest

from solvers.contact.ehl import Contact, LineContactInputs, Model, path, solve, solve_path
from solvers.contact.ehl.continuation import Attempt
from solvers.errors import InvalidInput


def contacts(points: int = 8, step: float = 0.1) -> list[LineContactInputs]:
    """Load, radius and speeds all change."""
    return [
        LineContactInputs(Contact(2.5e5 + 5e4 * t, 4e-3 + 2e-3 * t, 1.0 + 2.0 * t, 3.7 - 2.0 * t))
        for t in (step * k for k in range(points))
    ]


def test_path_is_what_its_points_are_alone() -> None:
    """The path has one mesh for all, graded for the mean film: 1 %."""
    for alone, along in zip([solve(c) for c in contacts()], solve_path(contacts()), strict=True):
        assert along.status == alone.status
        assert along.film.minimum == pytest.approx(alone.film.minimum, rel=0.01)
        assert along.friction is not None
        assert alone.friction is not None
        assert along.friction.coefficient == pytest.approx(alone.friction.coefficient, rel=0.005)
        assert along.convergence.load_error < 1e-9


def test_path_from_heavy_to_light_loads_gets_meshes_for_each() -> None:
    """A thousandfold load: every film is that of the contact alone, but for what one grading differs from another."""
    at = contacts(1)[0]
    heavy_to_light = [
        replace(at, contact=replace(at.contact, line_load=at.contact.line_load * 10.0 ** (-k / 5))) for k in range(16)
    ]
    for alone, along in zip([solve(c) for c in heavy_to_light], solve_path(heavy_to_light), strict=True):
        assert along.status != "no_solution"
        assert along.film.minimum == pytest.approx(alone.film.minimum, rel=0.02)


def test_direction_of_the_path_does_not_matter() -> None:
    forward, backward = solve_path(contacts()), solve_path(contacts()[::-1])[::-1]
    for one, other in zip(forward, backward, strict=True):
        assert one.film.minimum == pytest.approx(other.film.minimum, rel=1e-5)


def test_neighbours_start_from_each_other() -> None:
    first, *others = [result.convergence.iterations for result in solve_path(contacts(50, 0.02))]
    assert sum(others) / len(others) < 4 < first / 4


def test_failed_point_neither_stops_nor_fills(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[float] = []

    def failing(attempt: Attempt) -> Attempt:
        return replace(attempt, converged=False)

    warm, cold = path.polish, path.solve_cold
    third = contacts()[2].contact.speed_1

    monkeypatch.setattr(
        path,
        "polish",
        lambda p, *rest: failing(warm(p, *rest)) if p.speed_1 == pytest.approx(third) else warm(p, *rest),
    )

    def counted(p: object, *rest: object) -> Attempt:
        attempt: Attempt = cold(p, *rest)  # type: ignore[arg-type]
        seen.append(p.speed_1)  # type: ignore[attr-defined]
        return failing(attempt) if seen[-1] == pytest.approx(third) else attempt

    monkeypatch.setattr(path, "solve_cold", counted)
    results = solve_path(contacts())
    assert [r.status == "no_solution" for r in results] == [k == 2 for k in range(8)]
    assert results[2].friction is None
    assert len(seen) == 3  # the first, the failed one again, and the one behind it


def test_empty_path() -> None:
    assert solve_path([]) == []


def test_isothermal_path() -> None:
    results = solve_path([replace(c, model=Model(thermal=False)) for c in contacts()])
    assert {r.status for r in results} == {"ok"}


def test_bad_point_is_refused_at_once() -> None:
    bad = [*contacts(2), LineContactInputs(Contact(2.5e5, 4e-3, 0.0, 3.0))]
    with pytest.raises(InvalidInput, match="both speeds must be positive"):
        solve_path(bad)


def test_models_of_a_path_must_agree() -> None:
    mixed = [*contacts(2), replace(contacts(3)[2], model=Model(nodes=91))]
    with pytest.raises(InvalidInput) as refusal:
        solve_path(mixed)
    assert refusal.value.code == "mixed_models"


def test_another_mesh_costs_no_steps() -> None:
    """Loads that fall to a fifth, over five meshes: once a pressure left at the inlet's end made 60 steps of 5."""
    at = contacts(1)[0]
    falling = [replace(at, contact=replace(at.contact, line_load=2.5e5 * 0.96**k)) for k in range(40)]
    results = solve_path(falling)
    assert len({result.curves.x[0] / result.hertz.half_width for result in results if result.curves is not None}) > 2
    assert max(result.convergence.iterations for result in results[1:]) < 12
    assert all(result.curves is not None and result.curves.pressure[0] == 0.0 for result in results)
