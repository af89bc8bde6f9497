"""The log continues after a line that cannot be formatted or written."""

import io
import logging
import sys
import time

import pytest

from app import log

logger = logging.getLogger("tribodrive")


def dropped() -> float:
    (metric,) = log.LINES_DROPPED.collect()
    return metric.samples[0].value


def wait_until_dropped(count: float) -> None:
    end = time.monotonic() + 10
    while dropped() < count:
        assert time.monotonic() < end
        time.sleep(0.01)


def test_the_log_goes_on_after_an_exception(capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    before = dropped()
    with log.running("info"):
        with monkeypatch.context() as broken:
            broken.setattr(sys, "stderr", io.StringIO())  # has no descriptor: writing raises
            logger.info("lost")
            wait_until_dropped(before + 1)
        logger.info("%d kernels", "no number")
        wait_until_dropped(before + 2)
        logger.info("kept")
    assert capfd.readouterr().err == "kept\n"


def test_a_logged_exception_has_its_traceback(capfd: pytest.CaptureFixture[str]) -> None:
    with log.running("info"):
        try:
            1 / 0  # noqa: B018
        except ZeroDivisionError:
            logger.exception("failed")
    text = capfd.readouterr().err
    assert text.startswith("failed\nTraceback")
    assert text.endswith("ZeroDivisionError: division by zero\n")
