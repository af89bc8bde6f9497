"""Log and metrics of the service.

A separate thread writes the log, so that requests are not delayed if the reader of the log stops reading. Lines that do
not fit into the queue of this thread are dropped and counted. Lines about answered requests go to the standard output.
All other lines go to the standard error.
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

LINES_KEPT = 10_000  # most lines in the queue; further lines are dropped and counted
LAST_LINES_S = 1.0  # longest time to write the remaining lines when the service stops
REQUEST_LOG = "tribodrive.requests"

# The address /metrics shows these metrics in the Prometheus text format.
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
    """Handler that puts log records into the queue.

    A record is counted as dropped if it does not fit into the queue or cannot be formatted.
    """

    def handleError(self, record: logging.LogRecord) -> None:  # noqa: N802  logging's name
        del record
        LINES_DROPPED.inc()


class _Writer(logging.Handler):
    """Handler that writes log records without the locks of `logging`.

    Such a lock could delay the end of the process.
    """

    def handle(self, record: logging.LogRecord) -> bool:
        """Write a record. If writing fails, count the record as dropped, so that the thread continues."""
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
    """Send log records through the queue while the context is open.

    The root logger is not changed if it already has handlers.
    """
    lines: queue.Queue[logging.LogRecord] = queue.Queue(LINES_KEPT)
    handler, listener = _Handler(lines), QueueListener(lines, _Writer())
    logger = logging.getLogger("tribodrive")
    logger.setLevel(level.upper())
    logger.propagate = False
    loggers = [logger, *([logging.root] if not logging.root.handlers else [])]
    for own_logger in loggers:
        own_logger.addHandler(handler)
    listener.start()
    try:
        yield
    finally:
        logger.propagate = True
        for own_logger in loggers:
            own_logger.removeHandler(handler)
        with suppress(queue.Full):
            listener.enqueue_sentinel()
        end = time.monotonic() + LAST_LINES_S
        while not lines.empty() and time.monotonic() < end:
            time.sleep(0.01)
