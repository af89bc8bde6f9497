"""The names that the HTTP layer still imports from here."""

from app.studies.kinds.corners import Corners
from app.studies.kinds.sweep import Sweep, encoder, table_row

__all__ = ["Corners", "Sweep", "encoder", "table_row"]
