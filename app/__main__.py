"""python -m app: start the service; --help lists every setting."""

import argparse
import logging
import sys

import uvicorn

from app.settings import Settings, settings


def main() -> None:
    """Serve until told to stop."""
    argparse.ArgumentParser(
        prog="python -m app",
        description="Serve the tribodrive calculations.",
        epilog=_documentation(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    ).parse_args()
    serve("app.main:create_app")


def serve(factory: str) -> None:
    """Run the application that `factory` ("module:function") creates, with the options it is meant to run with."""
    limits = settings()
    logging.logThreads = logging.logProcesses = logging.logMultiprocessing = False
    logging.basicConfig(level=limits.log_level.upper(), format="%(message)s", stream=sys.stdout)
    print(f"tribodrive: docs at http://{limits.host}:{limits.port}/docs", flush=True)  # noqa: T201
    uvicorn.run(
        factory,
        factory=True,
        host=limits.host,
        port=limits.port,
        loop="uvloop",
        http="httptools",
        access_log=False,
        server_header=False,
        log_level="warning",
        timeout_graceful_shutdown=limits.shutdown_s,
    )


def _documentation() -> str:
    """The settings, one line each."""
    rows = ["environment variables:"]
    for name, field in Settings.model_fields.items():
        rows.append(f"  TRIBODRIVE_{name.upper():<18} {field.description} (default {field.default})")
    return "\n".join(rows)


if __name__ == "__main__":
    main()
