"""The names that the HTTP layer still imports from here."""

from app.studies.kinds.spectrum import Spectrum

__all__ = ["Spectrum"]
