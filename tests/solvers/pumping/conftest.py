"""The verdict on choking is the matter of test_verdict.py."""

from collections.abc import Sequence

import pytest

from solvers.pumping.results import Choking
from solvers.pumping.verdict import Bands, decide


@pytest.fixture
def plain_verdict(monkeypatch: pytest.MonkeyPatch) -> None:
    """Decide on the slices of the request. The finer grids of a doubtful verdict take most of the time of a pair."""

    def unrefined(start: Sequence[Bands], slices: int, most: int, _: object) -> Choking:
        return decide(start, slices, most)

    monkeypatch.setattr("solvers.pumping.model.decide", unrefined)
