"""Outside the service's workers a contact is solved with one BLAS thread, and then all threads are given back."""

from collections.abc import Iterator

import pytest

from solvers import blas_threads
from solvers.contact.ehl import LineContactInputs, Model, continuation, newton
from solvers.contact.ehl.model import solve
from solvers.lubricants import Lubricant
from solvers.published.xue import POINT_A

TWO = 2


def threads() -> list[int]:
    return [library["num_threads"] for library in blas_threads.libraries().info()]


@pytest.fixture
def two_threads() -> Iterator[None]:
    with blas_threads.libraries().limit(limits=TWO):
        assert threads()
        assert set(threads()) == {TWO}
        yield


@pytest.mark.usefixtures("two_threads")
def test_a_block_has_one_thread_and_gives_the_others_back() -> None:
    def fails() -> None:
        with blas_threads.one_blas_thread():
            assert set(threads()) == {1}
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fails()
    assert set(threads()) == {TWO}


@pytest.mark.usefixtures("two_threads")
def test_a_contact_is_solved_with_one_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    met = []

    def solve_isothermal(*arguments: object) -> bool:
        met.append(set(threads()))
        return original(*arguments)

    original = newton.solve_isothermal
    monkeypatch.setattr(continuation, "solve_isothermal", solve_isothermal)
    assert solve(LineContactInputs(POINT_A, model=Model(thermal=False, nodes=61), lubricant=Lubricant())).status == "ok"
    assert met
    assert all(each == {1} for each in met)
    assert set(threads()) == {TWO}
