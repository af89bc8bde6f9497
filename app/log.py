"""Log and metrics of the service.

A thread of its own writes the log, so that a reader of it that stops never delays a request; lines that do not fit into
the queue are dropped and counted. Lines of answered requests go to the standard output, all others to the standard
error.
"""

import logging
import os
import queue
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from logging.handlers import QueueHandler, QueueListener

from prometheus_client import Counter, Gauge, Histogram

LINES_KEPT = 10_000  # for a reader that stalls; lines beyond are counted, not kept
LAST_LINES_S = 1.0  # for what is left to be written at the end
REQUEST_LOG = "tribodrive.requests"

# At /metrics, in the Prometheus text format.
REQUESTS = Counter("tribodrive_requests", "Requests answered", ["endpoint", "status"])
DURATION = Histogram("tribodrive_request_duration_seconds", "From first byte to last", ["endpoint"])
CALCULATIONS = Gauge("tribodrive_calculations", "Calculations running or waiting")
WAITING = Gauge("tribodrive_calculations_waiting", "Calculations waiting for a worker")
REFUSED = Counter("tribodrive_calculations_refused", "Calculations refused because the queue was full")
STUDIES = Gauge("tribodrive_studies", "Studies running")
STUDIES_UNFINISHED = Counter("tribodrive_studies_unfinished", "Studies that ended with an error, as by their deadline")
WORKERS_LOST = Counter("tribodrive_workers_lost", "Worker processes that died while they computed")
DEADLINES_MISSED = Counter("tribodrive_deadlines_missed", "Calculations ended at their deadline")
LINES_DROPPED = Counter("tribodrive_log_lines_dropped", "Log lines dropped because the log was not read fast enough")


class _Handler(QueueHandler):
    """Counts records that find no room or cannot be formatted; logging would write about them, and wait."""

    def handleError(self, record: logging.LogRecord) -> None:  # noqa: N802  logging's name
        """Count a record as lost."""
        del record
        LINES_DROPPED.inc()


class _Writer(logging.Handler):
    """Writes records without logging's locks, for which the end of the process would wait."""

    def handle(self, record: logging.LogRecord) -> bool:
        """Write one record; no failure ends the thread."""
        try:
            stream = sys.stdout if record.name == REQUEST_LOG else sys.stderr
            line = f"{record.getMessage()}\n".encode(errors="replace")
            while line:
                try:
                    line = line[os.write(stream.fileno(), line) :]
                except BlockingIOError:
                    time.sleep(0.01)
        except Exception:  # noqa: BLE001
            LINES_DROPPED.inc()
        return True


@contextmanager
def running(level: str) -> Iterator[None]:
    """Send log records through the queue while the context is open, except the root logger's if it has handlers."""
    lines: queue.Queue[logging.LogRecord] = queue.Queue(LINES_KEPT)
    handler, listener = _Handler(lines), QueueListener(lines, _Writer())
    logger = logging.getLogger("tribodrive")
    logger.setLevel(level.upper())
    logger.propagate = False
    loggers = [logger, *([logging.root] if not logging.root.handlers else [])]
    for each in loggers:
        each.addHandler(handler)
    listener.start()
    try:
        yield
    finally:
        logger.propagate = True
        for each in loggers:
            each.removeHandler(handler)
        with suppress(queue.Full):
            listener.enqueue_sentinel()
        end = time.monotonic() + LAST_LINES_S
        while not lines.empty() and time.monotonic() < end:
            time.sleep(0.01)
