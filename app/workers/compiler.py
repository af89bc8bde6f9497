"""What a compiler process does: compile stages, tell the service of every kernel and stage, end."""

import logging
import os
import signal
import socket
import threading
from collections.abc import Sequence
from typing import NoReturn

from app.warm_up import compile_stages, stage_of
from app.workers.worker import leave_with_the_service

logger = logging.getLogger("tribodrive")


def serve(connection: socket.socket, stages: Sequence[str]) -> NoReturn:
    """Compile the stages of these names; returns to nobody."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=leave_with_the_service, args=(connection,), daemon=True).start()
    try:
        compile_stages(map(stage_of, stages), lambda line: connection.sendall(f"{line}\n".encode()))
    except Exception:
        logger.exception("the compilation failed")
    finally:
        os._exit(0)
