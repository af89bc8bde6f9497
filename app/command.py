"""The command line, which starts the service or runs a command; --help lists all settings."""

import argparse
import gc
import json
import os
import socket
import sys
import threading
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any

from app.settings import MEBIBYTE, Settings, settings

if TYPE_CHECKING:
    from app.studies import Run

LEAST_DESCRIPTORS = 32  # four of every worker, and those of the connections; chosen
PROGRESS_S = 1.0  # time between two lines that report progress
BAR, BAR_S = 30, 0.2  # length of the bar of a study, and time between two of its drawings
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
    solve = commands.add_parser(
        "solve", help="print the answer to a request, or the lines of a study, instead of serving"
    )
    solve.add_argument("endpoint", help="address of the calculation or study, such as /v1/coupling or /v1/sweep")
    solve.add_argument("file", type=Path, help="file with the request as JSON; - stands for the standard input")
    solve.add_argument("--csv", action="store_true", help="print a sweep as a table instead of JSON lines")
    solve.add_argument("--kept", type=Path, help="file that keeps the points of a study; a second run goes on from it")
    commands.add_parser("fields", help="print the table of all fields, one a line, for grep, instead of serving")
    compiling = commands.add_parser("compile", help="compile the kernels and keep them on disk instead of serving")
    compiling.add_argument("stages", nargs="*", help="names of stages, such as coupling; by default all")
    arguments = parser.parse_args()
    match arguments.command:
        case "rexs":
            print_unit(arguments.file)
        case "solve":
            print_solution(arguments.endpoint, arguments.file, arguments.csv, arguments.kept)
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


def print_solution(endpoint: str, file: Path, as_csv: bool, kept: Path | None) -> None:
    """Print the answer of an endpoint to the request in a file, or the lines of a study.

    The exit status of an answer is the number that `EXIT_STATUS` has for its status, that of a study 0. Without an
    answer or the end of the study, print the reason and exit with status 1.
    """
    from app.calculations import BY_PATH  # noqa: PLC0415
    from app.errors import InvalidBody, Unprocessable, Unreadable, faults_of, sentence  # noqa: PLC0415
    from app.evaluate import answer  # noqa: PLC0415
    from app.schema.reading import content_of  # noqa: PLC0415
    from app.studies import PoolLost  # noqa: PLC0415
    from app.studies.kinds import KINDS  # noqa: PLC0415

    gc.enable()
    plans = {kind.path: kind for kind in KINDS}
    if endpoint not in {*BY_PATH, *plans}:
        sys.exit(f"tribodrive: there is no endpoint {endpoint}; the endpoints are {', '.join([*BY_PATH, *plans])}")
    if as_csv and not (endpoint in plans and "csv" in plans[endpoint].formats):
        sys.exit(f"tribodrive: the answer of {endpoint} is no table; leave out --csv")
    if kept and endpoint not in plans:
        sys.exit(f"tribodrive: {endpoint} is no study; leave out --kept")
    try:
        content = content_of(sys.stdin.buffer.read() if file == Path("-") else file.read_bytes())
        if endpoint in plans:
            sys.exit(print_study(endpoint, content, as_csv, kept))
        solution = answer(endpoint, content)
    except OSError as error:
        sys.exit(f"tribodrive: {error.filename or file}: {error.strerror}")
    except Unreadable as error:
        sys.exit(f"tribodrive: {error.detail}")
    except (InvalidBody, Unprocessable) as error:
        sys.exit("\n".join(f"tribodrive: {sentence(fault)}" for fault in faults_of(error)))
    except (PoolLost, ValueError) as error:
        sys.exit(f"tribodrive: {error}")
    _print_json(solution)
    sys.exit(EXIT_STATUS[solution["status"]])


def print_study(endpoint: str, body: Any, as_csv: bool, kept: Path | None) -> int:
    """Print the lines of a study, solved by as many processes as the settings say. Return the exit status.

    A terminal to which the lines do not go shows the progress. An error that ends the study is printed there too.
    """
    from app.studies import study  # noqa: PLC0415
    from app.workers.worker import prepare  # noqa: PLC0415

    limits = settings()
    own = (limits.worker_memory_mb * MEBIBYTE, ("app.studies.points",))
    with ProcessPoolExecutor(limits.workers, get_context("spawn"), prepare, own) as processes:
        run = study(endpoint, body, processes.map, kept)
        encode, ended, problem = run.plan.encoder("csv" if as_csv else "ndjson"), threading.Event(), ""
        showing = threading.Thread(target=_show_points, args=(run, ended), daemon=True)
        if sys.stderr.isatty() and not sys.stdout.isatty():
            showing.start()
        try:
            for line in run:
                problem = line["message"] if line["type"] == "error" else ""
                if not _is_printed(encode(line)):
                    break
        finally:
            ended.set()
            if showing.is_alive():
                showing.join()
            processes.shutdown(wait=False, cancel_futures=True)
    if problem:
        print(f"tribodrive: {problem}", file=sys.stderr)  # noqa: T201
    return 1 if problem else 0


def _show_points(run: "Run", ended: threading.Event) -> None:
    """Show a bar with the progress of a study on the standard error until the study has ended."""
    is_shown = True
    while is_shown:
        is_shown = not ended.wait(BAR_S)
        done, total, left_s = run.progress
        left = "" if left_s is None else f", {left_s:.0f} s left"
        bar = f"[{'#' * round(BAR * done / total):<{BAR}}] {done} of {total} points{left}"
        print(f"\r{bar:<{BAR + 50}}", end="" if is_shown else "\n", file=sys.stderr, flush=True)  # noqa: T201


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
    """Print a text. Characters that the standard output cannot encode are escaped."""
    _is_printed(f"{text}\n".encode(sys.stdout.encoding, "backslashreplace"))


def _is_printed(content: bytes) -> bool:
    """Print bytes. Return False if the reader of a pipe has closed it; if printing fails otherwise, exit."""
    try:
        sys.stdout.buffer.write(content)
        sys.stdout.buffer.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # the flush at exit must not fail
        if not isinstance(error, BrokenPipeError):
            sys.exit(f"tribodrive: cannot write the answer: {error.strerror}")
        return False
    return True


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
