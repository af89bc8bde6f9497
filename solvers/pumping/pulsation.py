"""Amplitudes of the mass flow at both ends of the face, for the first multiples of the meshing frequency."""

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.pumping.flow.space_flow import SpaceFlow
from solvers.quantity import quantity, record

HARMONICS = 8  # number of harmonics, chosen


@record(equation="P13")
class Pulsation:
    """Amplitudes of the mass flow at both ends of the face: one value per multiple of the meshing frequency."""

    frequency: FloatArray = quantity("pulsation frequency", "k f_m", unit="hz")
    front_mass_flow: FloatArray = quantity(
        "front mass flow amplitude", "m_f,k", unit="g_per_s", text="at the end that meshes first", axis="frequency"
    )
    rear_mass_flow: FloatArray = quantity(
        "rear mass flow amplitude", "m_r,k", unit="g_per_s", text="at the end that meshes last", axis="frequency"
    )


def pulsation(meshing_frequency: float, flows: list[tuple[SpaceFlow, float, float]]) -> Pulsation:
    """Superpose the flows of successive spaces; harmonics of the mass flow [kg/s] (Eq. P13).

    The amplitude of order k is 2 f_m |int m_dot exp(-2 pi i k f_m t) dt|; the exponential is a power of that of order
    1.
    """
    front = np.zeros(HARMONICS, dtype=complex)
    rear = np.zeros(HARMONICS, dtype=complex)
    for flow, speed, delay in flows:
        time = flow.ends.time + flow.angle[0] / speed + delay / meshing_frequency
        first = wave = np.exp(-2j * np.pi * meshing_frequency * time)
        for k in range(HARMONICS):
            front[k] += wave @ flow.ends.front
            rear[k] += wave @ flow.ends.rear
            wave = wave * first
    return Pulsation(
        frequency=frozen(meshing_frequency * np.arange(1, HARMONICS + 1)),
        front_mass_flow=frozen(2 * meshing_frequency * np.abs(front)),
        rear_mass_flow=frozen(2 * meshing_frequency * np.abs(rear)),
    )
