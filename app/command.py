"""The command line, which starts the service or runs a command; --help lists all settings."""

import argparse
import gc
import json
import os
import socket
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from app.settings import Settings, settings

LEAST_DESCRIPTORS = 32  # four of every worker, and those of the connections; chosen
PROGRESS_S = 1.0  # time between two lines that report progress
EXIT_STATUS = {"ok": 0, "ok_with_warnings": 3, "no_solution": 4}  # status 1: no answer, 2: wrong arguments


def main() -> None:
    """Serve until a signal stops the service, or run a command."""
    open_standard_streams()
    os.environ.pop("WEB_CONCURRENCY", None)  # this variable is meant for servers with several processes
    parser = argparse.ArgumentParser(
        prog="python -m app",
        description="Serve the tribodrive calculations.",
        epilog=_documentation(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--port", type=int, help="port to listen on, instead of TRIBODRIVE_PORT (see below)")
    commands = parser.add_subparsers(dest="command", metavar="command", required=False)
    rexs = commands.add_parser("rexs", help="print the requests of a gear unit's file (REXS) instead of serving")
    rexs.add_argument("file", type=Path, help="a .rexs, .rexsj or .rexsz file")
    solve = commands.add_parser("solve", help="print the answer to a request instead of serving")
    solve.add_argument("endpoint", help="address of the calculation, such as /v1/coupling")
    solve.add_argument("file", type=Path, help="file with the request as JSON; - stands for the standard input")
    commands.add_parser("fields", help="print the table of all fields, one a line, for grep, instead of serving")
    compiling = commands.add_parser("compile", help="compile the kernels and keep them on disk instead of serving")
    compiling.add_argument("stages", nargs="*", help="names of stages, such as coupling; by default all")
    arguments = parser.parse_args()
    match arguments.command:
        case "rexs":
            print_unit(arguments.file)
        case "solve":
            print_answer(arguments.endpoint, arguments.file)
        case "fields":
            print_fields()
        case "compile":
            compile_kernels(arguments.stages)
        case _:
            if arguments.port is not None:
                os.environ["TRIBODRIVE_PORT"] = str(arguments.port)
            serve("app.main:app")


def print_unit(file: Path) -> None:
    """Print the answer that /v1/rexs gives for a file. If the file cannot be read, exit with the reason."""
    from app.errors import Unprocessable  # noqa: PLC0415  the service starts without this
    from app.rexs.answer import unit_of  # noqa: PLC0415

    try:
        unit = unit_of(file.read_bytes(), settings().rexs_bytes)
    except OSError as error:
        sys.exit(f"tribodrive: {file}: {error.strerror}")
    except Unprocessable as error:
        sys.exit(f"tribodrive: {file}: {error.message}")
    _print_json(unit)


def print_answer(endpoint: str, file: Path) -> None:
    """Print the answer of an endpoint to the request in a file.

    The exit status is the number that `EXIT_STATUS` has for the status of the answer. If the service rejects the
    request, print the reason and exit with status 1.
    """
    from app.calculations import BY_PATH  # noqa: PLC0415
    from app.errors import InvalidBody, Unprocessable, Unreadable, faults_of, sentence  # noqa: PLC0415
    from app.evaluate import answer  # noqa: PLC0415
    from app.schema.reading import content_of  # noqa: PLC0415

    gc.enable()
    if endpoint not in BY_PATH:
        sys.exit(f"tribodrive: there is no endpoint {endpoint}; the endpoints are {', '.join(BY_PATH)}")
    try:
        body = sys.stdin.buffer.read() if file == Path("-") else file.read_bytes()
        content = answer(endpoint, content_of(body))
    except OSError as error:
        sys.exit(f"tribodrive: {file}: {error.strerror}")
    except Unreadable as error:
        sys.exit(f"tribodrive: {error.detail}")
    except (InvalidBody, Unprocessable) as error:
        sys.exit("\n".join(f"tribodrive: {sentence(fault)}" for fault in faults_of(error)))
    _print_json(content)
    sys.exit(EXIT_STATUS[content["status"]])


def print_fields() -> None:
    """Print the table of all fields of requests and answers, one field a line, with tabs between the columns."""
    from app.http.routes.manual import OTHER_ANSWERS  # noqa: PLC0415
    from app.manual.fields import COLUMNS, table  # noqa: PLC0415

    rows = [("section", *COLUMNS), *((entry.section, *entry.cells) for entry in table(OTHER_ANSWERS))]
    _print("\n".join("\t".join(row) for row in rows).replace("`", ""))


def compile_kernels(names: Sequence[str]) -> None:
    """Compile the kernels of the stages `names`, or of all stages if `names` is empty.

    Print the progress of the current stage every second. The progress is 100 % only after the kernels of the stage have
    been stored on disk.
    """
    from numba.core import event  # noqa: PLC0415

    from app.evaluate import warm  # noqa: PLC0415
    from app.models.kernels import KERNEL_GROUPS  # noqa: PLC0415
    from solvers.compiled import announcement  # noqa: PLC0415
    from solvers.kernel_cache import FOLDER  # noqa: PLC0415

    gc.enable()
    announcement.mute()
    stages = {stage.name: stage for stage in KERNEL_GROUPS}
    if unknown := set(names) - set(stages):
        sys.exit(f"tribodrive: there is no stage {', '.join(sorted(unknown))}; the stages are {', '.join(stages)}")
    if FOLDER is None:
        sys.exit("tribodrive: the folder for compiled kernels cannot be written")
    for stage in [stages[name] for name in names or stages]:
        done = threading.Event()
        with event.install_recorder("numba:compile") as recorder:  # records when a compilation begins and ends
            arguments = (stage.name, stage.kernels, recorder.buffer, done)
            showing = threading.Thread(target=_show, args=arguments, daemon=True)
            showing.start()
            warm(stage)
            done.set()
            showing.join()
        _tell(stage.name, 100)
    os._exit(0)  # a normal exit would take a second, because of the many kernels


def _show(name: str, kernels: int, events: Sequence[object], done: threading.Event) -> None:
    while not done.wait(PROGRESS_S):
        _tell(name, min(99, 50 * len(events) // kernels))


def _tell(name: str, percent: int) -> None:
    """Print the progress of a stage. End the process if no reader of the output is left."""
    try:
        print(f"{name}: {percent} %", flush=True)  # noqa: T201
    except OSError:
        os._exit(1)


def _print_json(content: dict[str, Any]) -> None:
    """Print JSON, with JSON's escapes for characters that the standard output cannot encode."""
    text = json.dumps(content, indent=1, ensure_ascii=False)
    try:
        text.encode(sys.stdout.encoding)
    except UnicodeEncodeError:
        text = json.dumps(content, indent=1)
    _print(text)


def _print(text: str) -> None:
    """Print a text. If the reader of a pipe has closed it, continue; if printing fails otherwise, exit with the reason.

    Characters that the standard output cannot encode are escaped.
    """
    encoding = sys.stdout.encoding
    try:
        print(text.encode(encoding, "backslashreplace").decode(encoding), flush=True)  # noqa: T201  a command's output
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # the flush at exit must not fail
        if not isinstance(error, BrokenPipeError):  # BrokenPipeError: the pipe has been closed
            sys.exit(f"tribodrive: cannot write the answer: {error.strerror}")


def serve(application: str) -> None:
    """Serve the application at `application` ("module:attribute") with uvicorn until a signal stops it."""
    limits = settings()
    import uvicorn  # noqa: PLC0415  the other commands need no server

    refuse_taken_port(limits.host, limits.port)
    warn_of_few_descriptors()
    uvicorn.run(
        application,
        host="" if limits.host == "::" else limits.host,  # IPv4 and IPv6; IPv4 addresses of clients keep their form
        port=limits.port,
        http="h11",
        h11_max_incomplete_event_size=limits.max_header_bytes,
        limit_concurrency=limits.limit_concurrency,
        timeout_graceful_shutdown=limits.shutdown_s,
        proxy_headers=bool(limits.proxies),
        forwarded_allow_ips=limits.proxies or None,
        log_config=None,  # `app.log` writes the log
        log_level=limits.log_level,
        access_log=False,
        server_header=False,
    )


def refuse_taken_port(host: str, port: int) -> None:
    """Exit with one line if the address cannot be used, before any worker starts."""
    try:
        for family, kind, protocol, _, address in socket.getaddrinfo(host, port, type=socket.SOCK_STREAM):
            with socket.socket(family, kind, protocol) as trial:
                trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # as asyncio does
                trial.bind(address)
    except OSError as error:
        sys.exit(f"tribodrive: cannot listen on port {port} of {host}: {error.strerror}; --port names another port")


def warn_of_few_descriptors() -> None:
    """Say if the process may open too few files to serve."""
    with suppress(ImportError):
        import resource  # noqa: PLC0415  not on all platforms

        limit, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
        if limit < LEAST_DESCRIPTORS:
            line = f"tribodrive: only {limit} files may be open at once, fewer than {LEAST_DESCRIPTORS} (ulimit -n)"
            print(line, file=sys.stderr, flush=True)  # noqa: T201  before the log is there


def open_standard_streams() -> None:
    """Replace closed standard streams by the null device.

    If a standard stream stayed closed, a socket could get the file number of this stream.
    """
    for name in ("stdin", "stdout", "stderr"):
        if getattr(sys, name) is None:
            stream = Path(os.devnull).open("r+")  # noqa: SIM115  gets the lowest free number, 0 to 2
            os.set_inheritable(stream.fileno(), True)
            setattr(sys, name, stream)


def _documentation() -> str:
    """Return the documentation of the settings, one line per setting."""
    rows = ["environment variables:"]
    for name, field in Settings.model_fields.items():
        default = field.get_default(call_default_factory=True)
        rows.append(f"  TRIBODRIVE_{name.upper():<18} {field.description} (default {default})")
    return "\n".join(rows)
