"""What scuffing needs to know of points of the flank, and the feature line Psi from A1 to E2, the paper's short cut."""

from dataclasses import fields

import numpy as np

from solvers.arrays import FloatArray, frozen
from solvers.contact import hertz
from solvers.gears.path_of_contact import PathOfContact, reduced_radius
from solvers.scuffing.balance.load_balance import LoadBalance, line_loads
from solvers.scuffing.distribution.flank_maps import contact_pressure
from solvers.scuffing.distribution.load_sharing import iso_load_sharing
from solvers.scuffing.results import ContactPoints, FeatureLine


def contact_points(
    path: PathOfContact, balance: LoadBalance, x: FloatArray, load: FloatArray, pinion_speed: float, modulus: float
) -> ContactPoints:
    """Load, radius and speeds at points x [m] of the path under w [N/m], arrays of one shape; E' [Pa]."""
    radius = reduced_radius(path.plane, x)
    pinion, wheel = path.surface_speeds(x, pinion_speed)
    return ContactPoints(
        gamma=frozen(path.profile_parameter(x)),
        line_load=frozen(load),
        pressure=frozen(contact_pressure(balance, x, load, modulus)),
        half_width=frozen(hertz.half_width(load, np.where(radius < path.plane.least_radius, 0.0, radius), modulus)),
        radius=frozen(radius),
        pinion_speed=frozen(pinion),
        wheel_speed=frozen(wheel),
    )


def feature_line(
    path: PathOfContact,
    balance: LoadBalance,
    pinion_speed: float,
    tangential_force: float,
    modulus: float,
    psi: FloatArray,
) -> FeatureLine:
    """The points at psi in 0..1 (n,), x = psi g_alpha, y = psi b; F_bt [N], E' [Pa]."""
    x = psi * path.length
    load = line_loads(balance, x, psi * path.plane.face_width)
    line = contact_points(path, balance, x, load, pinion_speed, modulus)
    sharing = iso_load_sharing(path, x)
    return FeatureLine(
        **{item.name: getattr(line, item.name) for item in fields(line)},
        psi=frozen(psi),
        load_sharing=None if tangential_force == 0.0 else frozen(_load_sharing(path, line.line_load, tangential_force)),
        iso_load_sharing=None if sharing is None else frozen(sharing),
    )


def _load_sharing(path: PathOfContact, load: FloatArray, tangential_force: float) -> FloatArray:
    """X = w b / F_bt: what the standard's load-sharing factor is for."""
    return load * path.plane.face_width / tangential_force
