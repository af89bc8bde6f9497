"""The command `python -m app`, which runs `app.command`.

Ctrl-C during the imports ends the process without a traceback.
"""

import gc
import os
import signal

INTERRUPTED = 130  # exit status that shells report if Ctrl-C has ended a process


def main() -> None:
    """Run the command line.

    While uvicorn serves, uvicorn itself handles Ctrl-C. After uvicorn has stopped serving, uvicorn sends the signal of
    Ctrl-C to this process once more. This second signal ends the process.
    """
    # Ctrl-C must not raise an exception: a module that is being imported could lose the exception or change its type.
    signal.signal(signal.SIGINT, lambda *_: os._exit(INTERRUPTED))
    gc.disable()  # imports leave no garbage, and searching for garbage would take a third of the time
    from app.command import main as run_command  # noqa: PLC0415

    run_command()


if __name__ == "__main__":
    main()
