"""The names that the HTTP layer still imports from here."""

from app.studies.kinds.corners import Corners
from app.studies.kinds.sweep import Sweep, table_row

__all__ = ["Corners", "Sweep", "table_row"]
