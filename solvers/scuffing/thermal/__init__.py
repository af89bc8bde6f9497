"""Temperatures of the contact: practice, blok -> temperatures -> thermal_path -> verdict."""
