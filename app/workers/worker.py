"""What a worker process does: read a call, make it, write the outcome, until the service hangs up."""

import os
import pickle
import resource
import select
import signal
import socket
import struct
import threading
from typing import Any, NoReturn

LENGTH = struct.Struct("!Q")
MEBIBYTE = 2**20


def serve(connection: socket.socket, memory_mb: int) -> NoReturn:
    """Answer calls from the connection; returns to nobody."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a terminal's Ctrl-C reaches the whole group; the service decides
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    limit = memory_mb * MEBIBYTE
    resource.setrlimit(resource.RLIMIT_DATA, (limit, limit))
    threading.Thread(target=leave_with_the_service, args=(connection,), daemon=True).start()
    try:
        while (call := _read(connection)) is not None:
            connection.sendall(framed(_outcome(call)))
    except OSError:
        pass
    os._exit(0)


def framed(content: bytes) -> bytes:
    """The bytes with their length before them."""
    return LENGTH.pack(len(content)) + content


def _outcome(call: bytes) -> bytes:
    """The pickled pair of whether the call succeeded, and its result or exception."""
    try:
        function, arguments = pickle.loads(call)  # noqa: S301  from the service itself
        return pickle.dumps((True, function(*arguments)), pickle.HIGHEST_PROTOCOL)
    except Exception as error:  # noqa: BLE001  handed to the caller
        return _pickled_error(error)


def _pickled_error(error: Exception) -> bytes:
    """The exception with its cause as a note, or its words where it cannot be pickled."""
    try:
        content = pickle.dumps((False, error), pickle.HIGHEST_PROTOCOL)
        pickle.loads(content)  # noqa: S301
    except Exception:  # noqa: BLE001
        return pickle.dumps((False, RuntimeError(f"{type(error).__name__}: {error}")))
    return content


def _read(connection: socket.socket) -> bytes | None:
    """The next framed message, or None at the end."""
    header = _read_exactly(connection, LENGTH.size)
    return None if header is None else _read_exactly(connection, LENGTH.unpack(header)[0])


def _read_exactly(connection: socket.socket, size: int) -> bytes | None:
    content = bytearray(size)
    view: Any = memoryview(content)
    while view:
        received = connection.recv_into(view)
        if received == 0:
            return None
        view = view[received:]
    return bytes(content)


def leave_with_the_service(connection: socket.socket) -> None:
    """End this process, whatever it calculates, once the other end of its socket is gone."""
    poll = select.poll()
    poll.register(connection, 0)  # only the hang-up, which is always reported
    poll.poll()
    os._exit(1)
