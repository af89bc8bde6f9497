"""python -m benchmarks.screenshots: the README's two pictures of pages, from a service started for them."""

import subprocess
import sys
import time
from pathlib import Path

import httpx
from playwright.sync_api import sync_playwright

from app.calculations import CALCULATIONS
from app.library import examples
from app.pages.links import example_link

CHROMIUM = "/usr/bin/chromium"
FOLDER = Path(__file__).parents[1] / "docs"
ADDRESS = "http://127.0.0.1:8000"
START_UP_S = 600.0
PICTURES = {
    "page-scuffing.png": ("starter-industrial-scuffing", "light"),
    "page-coupling.png": ("starter-turbo-coupling", "dark"),
}
WINDOW = {"width": 1280, "height": 800}


def main() -> None:
    """Take every picture."""
    FOLDER.mkdir(exist_ok=True)
    service = subprocess.Popen([sys.executable, "-m", "app"], stdout=subprocess.DEVNULL)
    try:
        _wait()
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--disable-gpu"])
            for file, (name, theme) in PICTURES.items():
                page = browser.new_page(base_url=ADDRESS, viewport=WINDOW)
                page.goto(f"{_link(name)}&theme={theme}")
                page.screenshot(path=FOLDER / file)
                print(file, (FOLDER / file).stat().st_size // 1024, "KiB")
            browser.close()
    finally:
        service.terminate()
        service.wait()


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


def _link(name: str) -> str:
    example = examples()[name]
    return example_link(next(each for each in CALCULATIONS if each.path == example.endpoint), example)


if __name__ == "__main__":
    main()
