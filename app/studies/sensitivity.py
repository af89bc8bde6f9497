"""The names that the HTTP layer still imports from here."""

from app.studies.kinds.sensitivity import Sensitivity

__all__ = ["Sensitivity"]
