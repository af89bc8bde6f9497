"""The feature line Psi from A1 to E2, the paper's short cut across the flank, and all its points need for scuffing."""

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.contact import hertz
from solvers.scuffing.flank import contact_pressure
from solvers.scuffing.load_balance import LoadBalance, line_loads
from solvers.scuffing.load_sharing import iso_load_sharing
from solvers.scuffing.path_of_contact import PathOfContact, reduced_radius
from solvers.scuffing.results import FeatureLine


def feature_line(
    path: PathOfContact,
    balance: LoadBalance,
    pinion_speed: float,
    tangential_force: float,
    modulus: float,
    psi: FloatArray,
) -> FeatureLine:
    """Line load, radius and speeds at psi in 0..1 (n,), x = psi g_alpha, y = psi b; F_bt [N], E' [Pa]."""
    x = psi * path.length
    load = line_loads(balance, x, psi * path.plane.face_width)
    radius = reduced_radius(path.plane, x)
    pinion, wheel = path.surface_speeds(x, pinion_speed)
    sharing = iso_load_sharing(path, x)
    return FeatureLine(
        psi=frozen(psi),
        gamma=frozen(path.profile_parameter(x)),
        line_load=frozen(load),
        pressure=frozen(contact_pressure(balance, x, load, modulus)),
        half_width=frozen(hertz.half_width(load, np.maximum(radius, 0.0), modulus)),
        radius=frozen(radius),
        pinion_speed=frozen(pinion),
        wheel_speed=frozen(wheel),
        sliding=frozen(pinion - wheel),
        load_sharing=None if tangential_force == 0.0 else frozen(_load_sharing(path, load, tangential_force)),
        iso_load_sharing=None if sharing is None else frozen(sharing),
    )


def _load_sharing(path: PathOfContact, load: FloatArray, tangential_force: float) -> FloatArray:
    """X = w b / F_bt: what the standard's load-sharing factor is for."""
    return load * path.plane.face_width / tangential_force
