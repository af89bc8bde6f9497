"""Warnings about the dry line contact; every model of a line contact gives these warnings."""

from collections.abc import Iterator

from solvers.notices import Notice, unusual_value

HIGHEST_PRESSURE = 2.5e9  # Pa, chosen; steel deforms plastically at this pressure


def high_pressure(pressure: float | None, field: str = "pinion_torque") -> Iterator[Notice]:
    """Warn if the Hertzian pressure [Pa] exceeds the strength of steel."""
    if pressure is not None and pressure > HIGHEST_PRESSURE:
        message = (
            f"the Hertzian pressure of {pressure / 1e6:.4g} MPa exceeds the strength of steel; is the load correct?"
        )
        yield unusual_value(field, message)
