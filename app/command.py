"""The command line: start the service, or solve one request; --help lists every setting."""

import argparse
import gc
import json
import os
import sys
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from app.settings import MEBIBYTE, Settings, settings

PROGRESS_S = 1.0  # between two lines
EXIT_STATUS = {"ok": 0, "ok_with_warnings": 3, "no_solution": 4}  # 1: refused or not written, 2: wrong arguments


def main() -> None:
    """Serve until told to stop, or print what a command asks for."""
    open_standard_streams()
    os.environ.pop("WEB_CONCURRENCY", None)  # which is for servers of several processes, whatever it says
    parser = argparse.ArgumentParser(
        prog="python -m app",
        description="Serve the tribodrive calculations.",
        epilog=_documentation(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = parser.add_subparsers(dest="command", metavar="command", required=False)
    rexs = commands.add_parser("rexs", help="print the requests of a gear unit's file (REXS) instead of serving")
    rexs.add_argument("file", type=Path, help="a .rexs, .rexsj or .rexsz file")
    solve = commands.add_parser("solve", help="print the answer to a request instead of serving")
    solve.add_argument("endpoint", help="address of the calculation, such as /v1/coupling")
    solve.add_argument("file", type=Path, help="the request as JSON; - reads the standard input")
    compiling = commands.add_parser("compile", help="compile the kernels and keep them on disk instead of serving")
    compiling.add_argument("stages", nargs="*", help="names of stages, such as coupling; by default all")
    asked = parser.parse_args()
    match asked.command:
        case "rexs":
            print_unit(asked.file)
        case "solve":
            print_answer(asked.endpoint, asked.file)
        case "compile":
            compile_kernels(asked.stages)
        case _:
            serve("app.main:app")


def print_unit(file: Path) -> None:
    """Print what /v1/rexs answers to a file; exits with the reason where the file cannot be read."""
    from app.errors import Unprocessable  # noqa: PLC0415  the service starts without this
    from app.rexs.answer import unit_of  # noqa: PLC0415

    try:
        found = unit_of(file.read_bytes(), settings().rexs_mb * MEBIBYTE)
    except OSError as error:
        sys.exit(f"tribodrive: {file}: {error.strerror}")
    except Unprocessable as error:
        sys.exit(f"tribodrive: {file}: {error.message}")
    _print_json(found)


def print_answer(endpoint: str, file: Path) -> None:
    """Print the answer of an endpoint to the request in a file, and exit with the status of `EXIT_STATUS`.

    Exits with the reason where the request is refused.
    """
    from app.calculations import BY_PATH  # noqa: PLC0415
    from app.errors import InvalidBody, Unprocessable, Unreadable, faults_of  # noqa: PLC0415
    from app.evaluate import answer, content_of  # noqa: PLC0415

    gc.enable()
    if endpoint not in BY_PATH:
        sys.exit(f"tribodrive: there is no {endpoint}; there are {', '.join(BY_PATH)}")
    try:
        body = sys.stdin.buffer.read() if file == Path("-") else file.read_bytes()
        found = answer(endpoint, content_of(body))
    except OSError as error:
        sys.exit(f"tribodrive: {file}: {error.strerror}")
    except Unreadable as error:
        sys.exit(f"tribodrive: {error.detail}")
    except (InvalidBody, Unprocessable) as error:
        faults = (f"{fault['pointer'] or 'request'}: {fault['message']}" for fault in faults_of(error))
        sys.exit("\n".join(f"tribodrive: {fault}" for fault in faults))
    _print_json(found)
    sys.exit(EXIT_STATUS[found["status"]])


def compile_kernels(names: Sequence[str]) -> None:
    """Compile stages, by default all, and print how far each of them is, every second; at 100 % it is on disk."""
    from numba.core import event  # noqa: PLC0415

    from app.workers.stages import STAGES, warm  # noqa: PLC0415
    from solvers.kernel_cache import FOLDER  # noqa: PLC0415

    gc.enable()
    known = {stage.name: stage for stage in STAGES}
    if unknown := set(names) - set(known):
        sys.exit(f"tribodrive: there is no {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    if FOLDER is None:
        sys.exit("tribodrive: the folder for compiled kernels cannot be written")
    for stage in [known[name] for name in names or known]:
        done = threading.Event()
        with event.install_recorder("numba:compile") as recorder:  # events when compilations begin and end
            arguments = (stage.name, stage.kernels, recorder.buffer, done)
            showing = threading.Thread(target=_show, args=arguments, daemon=True)
            showing.start()
            warm(stage)
            done.set()
            showing.join()
        _tell(stage.name, 100)
    os._exit(0)  # to take down the kernels would take a second


def _show(name: str, kernels: int, events: Sequence[object], done: threading.Event) -> None:
    while not done.wait(PROGRESS_S):
        _tell(name, min(99, 50 * len(events) // kernels))


def _tell(name: str, percent: int) -> None:
    """Print how far a stage is; ends the process if nobody can read it any more."""
    try:
        print(f"{name}: {percent} %", flush=True)  # noqa: T201
    except OSError:
        os._exit(1)


def _print_json(content: dict[str, Any]) -> None:
    """Print JSON, with escapes if the standard output has no bytes for a character; exits if it cannot be written."""
    text = json.dumps(content, indent=1, ensure_ascii=False)
    try:
        text.encode(sys.stdout.encoding)
    except UnicodeEncodeError:
        text = json.dumps(content, indent=1)
    try:
        print(text, flush=True)  # noqa: T201  a command's output
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for what is flushed at the end
        if not isinstance(error, BrokenPipeError):  # whoever reads a pipe has seen enough
            sys.exit(f"tribodrive: cannot write the answer: {error.strerror}")


def serve(application: str) -> None:
    """Serve the application at `application` ("module:attribute") with uvicorn until told to stop."""
    limits = settings()
    import uvicorn  # noqa: PLC0415  the other commands need no server

    uvicorn.run(
        application,
        host="" if limits.host == "::" else limits.host,  # both families; addresses of IPv4 clients stay as such
        port=limits.port,
        http="h11",
        h11_max_incomplete_event_size=limits.max_header_bytes,
        limit_concurrency=limits.limit_concurrency,
        timeout_graceful_shutdown=limits.shutdown_s,
        log_config=None,  # `app.log` writes
        log_level=limits.log_level,
        access_log=False,
        server_header=False,
    )


def open_standard_streams() -> None:
    """Open the null device where the standard streams are closed: a socket would get the number of one of them."""
    for name in ("stdin", "stdout", "stderr"):
        if getattr(sys, name) is None:
            stream = Path(os.devnull).open("r+")  # noqa: SIM115  the lowest free number, and these are 0 to 2
            os.set_inheritable(stream.fileno(), True)
            setattr(sys, name, stream)


def _documentation() -> str:
    """The settings, one line each."""
    rows = ["environment variables:"]
    for name, field in Settings.model_fields.items():
        default = field.get_default(call_default_factory=True)
        rows.append(f"  TRIBODRIVE_{name.upper():<18} {field.description} (default {default})")
    return "\n".join(rows)
