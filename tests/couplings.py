"""The coupling of Pahl's figures (z 52, m 3 mm, pitch diameter 156 mm), and random ones of the kind users have."""

from dataclasses import replace
from math import pi, radians

import numpy as np
from numpy.random import Generator

from solvers.coupling.inputs import (
    Arrangement,
    Coupling,
    CouplingInputs,
    Friction,
    Lubricant,
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


def spread(random: Generator, low: float, high: float) -> float:
    """A number between two bounds, every order of magnitude alike."""
    return float(np.exp(random.uniform(np.log(low), np.log(high))))


def random_coupling(random: Generator, *, errors: bool | None = None) -> Coupling:
    """A gear coupling as they are built, with or without pitch errors (None: either)."""
    teeth, module = int(random.integers(20, 90)), float(random.choice([1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 8.0]) * 1e-3)
    pitch_errors = None
    if random.random() < 0.4 if errors is None else errors:
        pitch_errors = tuple(spread(random, 0.2e-6, 10e-6) * random.normal(size=teeth))
    return Coupling(
        teeth=teeth,
        module=module,
        face_width=module * random.uniform(5.0, 12.0),
        tooth_height=module * random.uniform(1.6, 2.2),
        pressure_angle=radians(random.choice([14.5, 20.0, 20.0, 25.0, 30.0])),
        crowning_ratio=spread(random, 0.5, 20.0),
        hub_distance=teeth * module * spread(random, 0.7, 5.0),
        tooth_stiffness=14e9 * module * random.uniform(5.0, 12.0),
        sleeve_mass=1e6 * (teeth * module) ** 2 * module * random.uniform(0.02, 0.08),
        pitch_errors=pitch_errors,
    )


def random_inputs(random: Generator, *, errors: bool | None = None, single: bool = False) -> CouplingInputs:
    """A gear coupling at work: mean tooth pressures of 0.5 to 30 N/mm2, rim speeds of 1 to 150 m/s."""
    coupling = random_coupling(random, errors=errors)
    radius = coupling.module * coupling.teeth / 2.0
    mean_force = spread(random, 0.5e6, 30e6) * coupling.tooth_height * coupling.face_width
    operation = Operation(
        torque=mean_force * coupling.teeth * radius,
        speed=float(random.choice([-1.0, 1.0])) * spread(random, 1.0, 150.0) / radius,
        misalignment=float(random.choice([-1.0, 1.0])) * radians(spread(random, 0.005, 1.5)),
        axial_velocity=float(random.choice([0.0, -1.0, 1.0])) * spread(random, 1e-4, 3e-2),
        arrangement="single" if single else str(random.choice(["single", "parallel_offset", "angular"])),
    )
    model = ModelOptions(
        kinematics=str(random.choice(["tangential", "spatial"])),
        sleeve=str(random.choice(["centred", "floating"])),
        inlet=str(random.choice(["face", "face", "travel", "infinite"])),
        rotor_angle=random.uniform(0.0, 2.0 * pi),
    )
    lubricant = Lubricant(viscosity=spread(random, 5e-3, 0.3), reference_film=spread(random, 0.3e-6, 2e-6))
    friction = Friction(None if random.random() < 0.5 else random.uniform(0.02, 0.25))
    return CouplingInputs(coupling, operation, lubricant, friction, model)
