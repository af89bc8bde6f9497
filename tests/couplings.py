"""The coupling of Pahl's figures: z 52, m 3 mm, pitch diameter 156 mm."""

from dataclasses import replace
from math import radians

import numpy as np

from solvers.coupling.inputs import (
    Arrangement,
    Coupling,
    CouplingInputs,
    Friction,
    ModelOptions,
    Operation,
)

TEETH = 52
PITCH_RADIUS = 0.078


def pahl_coupling(
    misalignment_deg: float,
    *,
    torque: float = 3000.0,
    speed: float = 200.0,
    axial_velocity: float = 0.0,
    arrangement: Arrangement = "single",
    friction: float | None = 0.2,
    model: ModelOptions | None = None,
    **coupling: object,
) -> CouplingInputs:
    """The paper's coupling and friction 0.2; keywords beyond the named ones change the coupling."""
    steel = Coupling(teeth=TEETH, module=3e-3, face_width=24e-3, tooth_height=6e-3)
    return CouplingInputs(
        coupling=replace(steel, **coupling),  # type: ignore[arg-type]
        operation=Operation(torque, speed, radians(misalignment_deg), axial_velocity, arrangement),
        friction=Friction(coefficient=friction),
        model=model or ModelOptions(),
    )


def harmonic_pitch_errors(*orders: tuple[int, float, float]) -> tuple[float, ...]:
    """Sum of amplitude [m] cos(order phi + phase) over the teeth, for (order, amplitude, phase)."""
    phi = 2.0 * np.pi / TEETH * np.arange(TEETH)
    return tuple(sum(amplitude * np.cos(order * phi + phase) for order, amplitude, phase in orders))


def random_pitch_errors(seed: int, rms: float = 2e-6) -> tuple[float, ...]:
    """Normally distributed pitch errors [m] of exactly this rms, mean zero."""
    errors = np.random.default_rng(seed).normal(size=TEETH)
    errors -= errors.mean()
    return tuple(errors * rms / np.sqrt(np.mean(errors**2)))
