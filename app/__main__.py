"""python -m app: runs `app.command`; Ctrl-C during its imports ends the process without a traceback."""

import gc
import os
import signal

INTERRUPTED = 130  # exit status of a process that Ctrl-C ended, as shells give it


def main() -> None:
    """Run the command line; uvicorn handles Ctrl-C itself while it serves, and passes it on when it has ended."""
    # An exception would get lost or change its type in the extension modules that are being imported.
    signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    gc.disable()  # for the time of the imports: they leave no garbage, and looking for it takes a third of it
    from app.command import main as run_command  # noqa: PLC0415

    run_command()


if __name__ == "__main__":
    main()
