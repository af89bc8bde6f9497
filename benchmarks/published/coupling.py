"""Gear couplings: Pahl 1978, Bloch's hand method, Calistrat's measurements."""

from math import asin, pi, radians

from benchmarks.published import pahl
from benchmarks.published.bloch import END_CONTACT, bloch
from benchmarks.published.statement import Says, Statement

PAHL = "Pahl 1978"
BLOCH = "Bloch, Improving Machinery Reliability, pp. 208-210"

STATEMENTS: tuple[Statement, ...] = (
    Says(f"{PAHL}, Fig. 3", "load concentrates in the tilt zones: largest over mean, 0.2°").calculated(
        1.247, "-", lambda: pahl.concentration(0.2), 5e-3
    ),
    Says(f"{PAHL}, Fig. 3", "the same at 1°").calculated(4.018, "-", lambda: pahl.concentration(1.0), 5e-3),
    Says(f"{PAHL}, Fig. 3", "fewer teeth carry as the misalignment grows: teeth at 1°").calculated(
        22, "-", lambda: pahl.loaded(1.0), 0.0
    ),
    Says(f"{PAHL}, Fig. 5", "inertia force, third over first harmonic at 0.3°").calculated(
        0.546, "-", lambda: pahl.third_over_first(0.3), 2e-2
    ),
    Says(f"{PAHL}, Fig. 5", "inertia force at 0.1° is a sinusoid: third over first harmonic").below(
        1e-3, "-", lambda: pahl.third_over_first(0.1)
    ),
    Says(f"{PAHL}, Fig. 7", "contact overlap 1, heavily crowned, at").calculated(
        0.168, "°", lambda: pahl.overlap_one(pahl.HEAVY), 1e-2
    ),
    Says(f"{PAHL}, Fig. 7", "contact overlap 1, slightly crowned, at").calculated(
        0.0507, "°", lambda: pahl.overlap_one(pahl.SLIGHT), 1e-2
    ),
    Says(f"{PAHL}, Fig. 8", "a short inlet halves the film of large flank radii: inlet factor, 0.2°").calculated(
        0.494, "-", lambda: pahl.film(0.2, pahl.SLIGHT).lubrication.inlet_factor, 2e-3
    ),
    Says(f"{PAHL}, Fig. 9", "load capacity coefficient of the heavily crowned coupling at 0.4°: area 1.1").below(
        0.2, "-", lambda: pahl.film(0.4, pahl.HEAVY).lubrication.load_capacity_coefficient or 0.0
    ),
    Says(f"{PAHL}, Fig. 11", "least friction of the heavily crowned coupling").equals(
        0.05,
        "-",
        lambda: pahl.least_friction(pahl.HEAVY, 0.2, 0.8)[1],
        1e-2,
        "its sliding velocity is a calibration of ours",
    ),
    Says(f"{PAHL}, Fig. 11", "misalignment of least friction, heavily crowned").equals(
        0.4, "°", lambda: pahl.least_friction(pahl.HEAVY, 0.2, 0.8)[0], 2e-2
    ),
    Says(f"{PAHL}, Fig. 11", "least friction of the slightly crowned coupling").below(
        0.01, "-", lambda: pahl.least_friction(pahl.SLIGHT, 0.05, 0.2)[1]
    ),
    Says(f"{PAHL}, Fig. 11", "misalignment of least friction, slightly crowned").equals(
        0.1, "°", lambda: pahl.least_friction(pahl.SLIGHT, 0.05, 0.2)[0], 0.1
    ),
    Says(f"{PAHL}, Fig. 14", "coaxial thrust at 3000 N m").calculated(
        8186.0, "N", lambda: pahl.pahl(0.0, axial_velocity=pahl.CREEP).axial_thrust.force, 1e-5
    ),
    Says(f"{PAHL}, Fig. 16", "share of the coaxial thrust that is left at 0.05°, 200 1/s").below(
        0.1, "-", lambda: pahl.fraction(200.0)
    ),
    Says(f"{PAHL}, Fig. 15", "share that is left at a quarter of the speed").above(
        0.1, "-", lambda: pahl.fraction(50.0)
    ),
    Says(f"{PAHL}, Fig. 14", "thrust of equally loaded teeth, closed form").calculated(
        8186.0 * 2 / pi * asin(pahl.CREEP / (radians(0.05) * 200 * 0.078)),
        "N",
        lambda: pahl.pahl(0.05, axial_velocity=pahl.CREEP).axial_thrust.uniform_load_force,
        1e-5,
    ),
    Says(f"{PAHL}, Fig. 17", "self-induced thrust grows as the square of friction: exponent").calculated(
        2.0, "-", pahl.friction_exponent, 5e-3
    ),
    Says(f"{PAHL}, Fig. 13", "and as diameter over hub distance: thrust at half the distance over thrust").calculated(
        2.0, "-", lambda: pahl.offset_thrust(hub_distance=0.1) / pahl.offset_thrust(), 1e-2
    ),
    Says(f"{PAHL}, Fig. 13", "angular arrangement: thrust over T/r_o").below(
        1e-6, "-", lambda: abs(pahl.pahl(0.3, arrangement="angular").axial_thrust.force) * 0.078 / 3000.0
    ),
    Says(f"{PAHL}, conclusion", "crowning ratio for 0.05° to 0.1°").calculated(
        17.2, "-", lambda: pahl.crowning(0.05, 0.1), 2e-2
    ),
    Says(f"{PAHL}, conclusion", "crowning ratio for 0.1° to 0.3°").calculated(
        6.97, "-", lambda: pahl.crowning(0.1, 0.3), 2e-2
    ),
    Says(BLOCH, "axial force, coaxial limit").equals(60.9e3, "N", lambda: bloch().axial_thrust.coaxial_limit, 1e-3),
    Says(BLOCH, "friction moment between equal loads and load on the worst teeth").between(
        4165.0, 6542.0, "N m", lambda: bloch().losses.friction_moment
    ),
    Says(BLOCH, "contact-shift moment, all load at the tooth's end").equals(
        3150.0, "N m", lambda: bloch(END_CONTACT, 1e14).losses.contact_shift_moment, 2e-3
    ),
    Says("Calistrat, J. Mech. Des. 103 (1981)", "friction measured on high-speed couplings, at 0.1°").below(
        0.16, "-", lambda: pahl.film(0.1, pahl.HEAVY).lubrication.friction_coefficient
    ),
)
