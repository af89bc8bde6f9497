"""The hash of the solvers' sources, and what the changelog says of changed numbers."""

import re
from importlib.resources import files

from solvers.digest import package_digest


def changes_since(sources: str) -> list[str]:
    """Recent changes if a calculation was made with other sources; `sources` begins their hash, or is empty."""
    return [] if SOURCES.startswith(sources) else recent_changes()


def recent_changes() -> list[str]:
    """What moved numbers in the newest version, newest first."""
    numbers = files("app").joinpath("CHANGELOG.md").read_text("utf-8").partition("### Numbers")[2].partition("\n#")[0]
    entries = re.split(r"^\* ", numbers, flags=re.MULTILINE)[1:]
    return [" ".join(entry.replace("`", "").split()) for entry in reversed(entries)]


SOURCES = package_digest()
SHORT_SOURCES = SOURCES[:16]
"""The part of the hash that links contain."""
