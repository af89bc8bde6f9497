"""Run nginx in front of a service, with the configuration in deploy/."""

import socket
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from getpass import getuser
from pathlib import Path
from urllib.parse import urlsplit

from tests.support.server import ROOT, free_port, wait_until


@contextmanager
def running_proxy(folder: Path, address: str, **replaced: str) -> Iterator[str]:
    """Run nginx in front of the service at `address`, and yield the address of nginx."""
    # In the configuration, each of the keys of `replaced` is replaced by its value.
    port = free_port()
    site = (ROOT / "deploy" / "nginx.conf").read_text("utf-8")
    own = {"listen 80;": f"listen 127.0.0.1:{port};", "127.0.0.1:8000": urlsplit(address).netloc}
    for before, after in (own | replaced).items():
        assert before in site
        site = site.replace(before, after)
    main = folder / "nginx.conf"
    head = f"user {getuser()}; daemon off; pid {folder}/pid; error_log {folder}/log; events {{}}\n"
    head += "http { access_log off;\n"
    places = "".join(f"{each}_temp_path {folder}/{each};\n" for each in ("client_body", "proxy", "fastcgi"))
    places += "".join(f"{each}_temp_path {folder}/{each};\n" for each in ("uwsgi", "scgi"))
    main.write_text(f"{head}{places}{site}}}\n", "utf-8")
    process = subprocess.Popen(["nginx", "-p", str(folder), "-c", str(main), "-e", f"{folder}/log"])  # noqa: S607
    try:
        wait_until(lambda: is_open(port), 10)
        yield f"http://127.0.0.1:{port}"
    finally:
        process.terminate()
        process.wait(10)


def is_open(port: int) -> bool:
    with suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1):
        return True
    return False
