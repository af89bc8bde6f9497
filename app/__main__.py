"""The command `python -m app`: it runs `app.command`; Ctrl-C during imports ends the process without a traceback."""

import gc
import os
import signal

INTERRUPTED = 130  # exit status in shells of a process that Ctrl-C ended


def main() -> None:
    """Run the command line. While uvicorn serves, it handles Ctrl-C itself, and passes it on after its end."""
    # An exception could get lost or change its type in the extension modules that are being imported.
    signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    gc.disable()  # during the imports: they leave no garbage, and the search for it takes a third of their time
    from app.command import main as run_command  # noqa: PLC0415

    run_command()


if __name__ == "__main__":
    main()
