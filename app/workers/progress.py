"""Progress bars on a terminal; one line for each finished part where the output is no terminal."""

import logging
import sys

WIDTH = 30

logger = logging.getLogger("tribodrive")


class Progress:
    """One bar for each part."""

    def __init__(self, parts: list[str]) -> None:
        self._parts = parts
        self._terminal = sys.stderr.isatty()
        self._drawn = False
        self._done: set[str] = set()

    def show(self, shares: dict[str, float]) -> None:
        """Draw how far each part is."""
        if self._terminal:
            self._draw(shares)
        else:
            for part in self._parts:
                if shares[part] >= 1 and part not in self._done:
                    logger.info("tribodrive: %s is warm", part)
        self._done |= {part for part in self._parts if shares[part] >= 1}

    def finish(self, message: str) -> None:
        """Say that all is done."""
        logger.info(message)

    def _draw(self, shares: dict[str, float]) -> None:
        up = f"\x1b[{len(self._parts)}A" if self._drawn else ""
        self._drawn = True
        width = max(map(len, self._parts))
        lines = (
            f"\x1b[2K  {part:<{width}} {'█' * round(WIDTH * shares[part]):░<{WIDTH}} {shares[part]:>4.0%}"
            for part in self._parts
        )
        logger.info("%s", up + "\n".join(lines))
