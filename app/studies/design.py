"""The names that the HTTP layer still imports from here."""

from app.studies.kinds.design import Design

__all__ = ["Design"]
