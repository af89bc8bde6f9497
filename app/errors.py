"""The exceptions of the service: reasons why a request has no answer.

The table `PROBLEMS` states HTTP status, code and title for all exceptions except `InvalidBody` and `Unprocessable`.
"""

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

LONGEST_POINTER_PART = 100  # characters; the names of all fields are shorter


class Fault(NamedTuple):
    """An error in one field of the request.

    `pointer` is the JSON Pointer to the field. `code` is a stable name of the error. `message` says what to change.
    """

    pointer: str
    code: str
    message: str


def sentence(fault: Mapping[str, Any]) -> str:
    """Return the place of a fault and what to change there. The message may begin with the name of the place."""
    place, message = fault["pointer"] or "request", fault["message"]
    name = place.rpartition("/")[2]
    return place + message.removeprefix(name) if message.startswith(f"{name} is ") else f"{place}: {message}"


def pointer(location: Iterable[str | int]) -> str:
    """Return the JSON Pointer (RFC 6901) to a location."""
    return "".join("/" + printable(part).replace("~", "~0").replace("/", "~1") for part in location)


def printable(name: str | int) -> str:
    """Return a name from the request as valid text of at most `LONGEST_POINTER_PART` characters."""
    return str(name).encode(errors="replace").decode()[:LONGEST_POINTER_PART]


class ServiceError(Exception):
    """Base class of the exceptions in `PROBLEMS`. `detail` explains the individual case; it may be empty."""

    def __init__(self, detail: str = "") -> None:
        super().__init__(detail)
        self.detail = detail


class Unreadable(ServiceError):
    """The body cannot be read as JSON."""


class ContentTooLarge(ServiceError):
    """The body is larger than the settings allow."""


class InvalidBody(Exception):
    """The body is not a valid request; at most a hundred faults are listed."""

    def __init__(self, faults: list[Fault]) -> None:
        super().__init__(faults)
        self.faults = faults


class Unprocessable(Exception):
    """A valid request that the service cannot process, for example because the input is physically impossible.

    `path` is the dotted path of the field that causes the error.
    """

    def __init__(self, code: str, message: str, path: str | None = None) -> None:
        super().__init__(code, message, path)
        self.code = code
        self.message = message
        self.path = path


def faults_of(error: InvalidBody | Unprocessable) -> list[dict[str, str]]:
    """Return pointer, code and message of every fault in the exception."""
    if isinstance(error, Unprocessable):
        parts = error.path.split(".") if error.path else ()
        return [{"pointer": pointer(parts), "code": error.code, "message": error.message}]
    return [fault._asdict() for fault in error.faults]


class QueueFull(ServiceError):
    """The number of waiting requests has reached the limit in the settings."""


class StudiesFull(ServiceError):
    """The number of studies that may run at once has been reached."""


class StudyEnded(ServiceError):
    """A study ended before its figure could be drawn."""


class PoolLost(Exception):
    """The processes that solve the points of a study are lost. `code` is the code of the error in a stream."""

    code = "scheduler_lost"


class OtherSources(PoolLost):
    """The solvers of a worker, or of points that were kept, are others than those of this process."""

    code = "other_sources"


class SchedulerUnavailable(ServiceError):
    """The cluster for studies cannot be used."""


class DeadlineExceeded(ServiceError):
    """The calculation took longer than the settings allow."""


class WorkerLost(ServiceError):
    """The worker process died while it computed."""


class WarmingUp(ServiceError):
    """The kernels of this calculation are still being compiled."""


class Stopping(ServiceError):
    """The service is stopping and does not wait for the calculation."""


class ClientGone(ServiceError):
    """The client closed the connection, so the service gave up the calculation."""


class Kind(NamedTuple):
    """Status, code and title of a problem, and the time [s] after which the client should try again.

    The time is None if the client should not try again.
    """

    status: int
    code: str
    title: str
    retry_after_s: int | None = None

    @property
    def headers(self) -> dict[str, str]:
        """HTTP headers that tell the client when to try again; empty if the client should not try again."""
        return {} if self.retry_after_s is None else {"Retry-After": str(self.retry_after_s)}


PROBLEMS: dict[type[Exception], Kind] = {
    Unreadable: Kind(400, "bad_request", "The request cannot be read"),
    ContentTooLarge: Kind(413, "content_too_large", "The request body is too large"),
    WarmingUp: Kind(503, "warming_up", "The kernels of this calculation are still being compiled; try again", 2),
    QueueFull: Kind(503, "queue_full", "Too many calculations are waiting; try again later", 1),
    StudiesFull: Kind(503, "studies_full", "Other studies are running; try again later", 5),
    StudyEnded: Kind(503, "study_ended", "The study ended before its figure could be drawn"),
    SchedulerUnavailable: Kind(
        503, "scheduler_unavailable", "The cluster for studies cannot be used; try again later", 10
    ),
    WorkerLost: Kind(503, "worker_lost", "The calculation was lost with its process; try again", 1),
    Stopping: Kind(503, "shutting_down", "The service is shutting down", 5),
    MemoryError: Kind(
        503, "memory_limit", "The calculation needs more memory than a worker may use; make the calculation smaller"
    ),
    DeadlineExceeded: Kind(
        504,
        "deadline_exceeded",
        "The calculation took too long; make the calculation smaller, or try again later if the service is busy",
    ),
    ClientGone: Kind(499, "client_gone", "The client closed the connection"),
}


def kind_of(error: Exception) -> Kind:
    """Return the row of `PROBLEMS` that belongs to an exception.

    The class of the exception, or one of its base classes, must be in the table.
    """
    return next(PROBLEMS[base] for base in type(error).__mro__ if base in PROBLEMS)
