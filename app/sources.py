"""The hash of the solvers' sources, and the entries of the changelog about changed results."""

import re
from importlib.resources import files

from solvers.digest import package_digest


def changes_since(sources: str) -> list[str]:
    """Return the newest entries of the changelog if the solvers have changed since a calculation; else an empty list.

    `sources` is the hash of the solvers' sources at the time of the calculation, or the beginning of this hash. If
    `sources` is empty, the hash is not known, and the list is empty.
    """
    return [] if SOURCES.startswith(sources) else recent_changes()


def recent_changes() -> list[str]:
    """Return the entries of the newest section of the changelog, newest first. Hashes in the text are left out."""
    section = files("app").joinpath("CHANGELOG.md").read_text("utf-8").split("\n## ")[1]
    entries = re.split(r"^\* ", section, flags=re.MULTILINE)[1:]
    return [" ".join(re.sub(r"`[0-9a-f]{64}`", "", entry).replace("`", "").split()) for entry in reversed(entries)]


SOURCES = package_digest()
SHORT_SOURCES = SOURCES[:16]
"""The part of the hash that links contain."""
