"""python -m benchmarks.screenshots: the README's two pictures of pages, from a service started for them."""

import os
import subprocess
import sys
import time
from io import BytesIO
from pathlib import Path

import httpx
from PIL import Image
from playwright.sync_api import sync_playwright

from app.calculations import BY_PATH
from app.examples import examples
from app.pages.study_links import STUDIES
from app.pages.templating import example_link

CHROMIUM = "/usr/bin/chromium"
FOLDER = Path(__file__).parents[1] / "docs"
PORT = "8765"
ADDRESS = f"http://127.0.0.1:{PORT}"
START_UP_S = 600.0
LOADING_MS = 120_000
SCUFFING = examples()["starter-industrial-scuffing"]
PICTURES = {
    "page-scuffing.png": example_link(BY_PATH[SCUFFING.endpoint], SCUFFING),
    "page-vary.png": STUDIES[0].address,
}
WINDOW = {"width": 1440, "height": 900}
COLOURS = 256


def main() -> None:
    """Take every picture."""
    FOLDER.mkdir(exist_ok=True)
    environment = {**os.environ, "TRIBODRIVE_PORT": PORT}
    service = subprocess.Popen([sys.executable, "-m", "app"], stdout=subprocess.DEVNULL, env=environment)
    try:
        _wait()
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
            page = browser.new_page(base_url=ADDRESS, viewport=WINDOW)
            for name, address in PICTURES.items():
                page.goto(address, timeout=LOADING_MS)
                _save(page.screenshot(), FOLDER / name)
                print(name, (FOLDER / name).stat().st_size // 1024, "KiB")
            browser.close()
    finally:
        service.terminate()
        service.wait()


def _save(picture: bytes, file: Path) -> None:
    """With a palette of its own: a third of the size, and no difference to the eye."""
    Image.open(BytesIO(picture)).convert("RGB").quantize(COLOURS).save(file, optimize=True)


def _wait() -> None:
    end = time.monotonic() + START_UP_S
    while time.monotonic() < end:
        try:
            if httpx.get(f"{ADDRESS}/readyz").is_success:
                return
        except httpx.TransportError:
            pass
        time.sleep(0.5)
    raise TimeoutError("the service did not become ready")


if __name__ == "__main__":
    main()
