"""What every answer carries and leaves behind: request id, security headers, one log line, metrics."""

import logging
import re
import time
from functools import lru_cache
from secrets import token_hex

from prometheus_client import Counter, Histogram

from app.log import DURATION, REQUEST_LOG, REQUESTS

ACCEPTABLE_ID = re.compile(rb"[A-Za-z0-9._-]{1,128}")
CONTENT_POLICY = (
    b"default-src 'self'; img-src 'self' data:; style-src 'self' 'unsafe-inline'; "
    b"script-src 'self' 'unsafe-inline'; frame-ancestors 'none'"
)
SECURITY_HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
    (b"referrer-policy", b"no-referrer"),
    (b"cache-control", b"no-store"),
    (b"content-security-policy", CONTENT_POLICY),
)

# Written by hand: nothing in it needs escaping.
LOG_LINE = '{"time": %.3f, "request_id": "%s", "method": "%s", "endpoint": "%s", "status": %d, "duration_ms": %.3f}'

logger = logging.getLogger(REQUEST_LOG)


def request_id(sent: bytes = b"") -> str:
    """The client's request id if it is a decent one, else a new one."""
    return sent.decode() if ACCEPTABLE_ID.fullmatch(sent) else token_hex(16)


def own_headers(identifier: str, seconds: float) -> list[tuple[bytes, bytes]]:
    """The headers of every answer."""
    timing = b"total;dur=%.1f" % (seconds * 1e3)
    return [(b"x-request-id", identifier.encode()), (b"server-timing", timing), *SECURITY_HEADERS]


def record(identifier: str, method: str, endpoint: str, status: int, seconds: float) -> None:
    """One log line and the metrics of a finished request."""
    requests, duration = _meters(endpoint, status)
    requests.inc()
    duration.observe(seconds)
    if logger.isEnabledFor(logging.INFO):
        logger.info(LOG_LINE, time.time(), identifier, method, endpoint, status, seconds * 1e3)


@lru_cache(maxsize=1024)
def _meters(endpoint: str, status: int) -> tuple[Counter, Histogram]:
    return REQUESTS.labels(endpoint, status), DURATION.labels(endpoint)
