"""Xue, Zhang and Wang 2020: the four gear pairs, the contact at the start of the mesh (point A), and computed numbers.

The functions compute the numbers that the figures of the paper show.
"""

from dataclasses import replace
from functools import cache
from math import radians

import numpy as np

from solvers.contact import ehl
from solvers.gears.inputs import GearPairInputs, GearTeeth
from solvers.lubricants import Lubricant
from solvers.scuffing.inputs import (
    Load,
    LoadDistributionInputs,
    Model,
    Modifications,
    ScuffingInputs,
    Temperatures,
    angular_speed,
)
from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.results import LoadDistribution
from solvers.scuffing.safety import solve_scuffing
from solvers.scuffing.safety_results import Scuffing

# From Tables 1 and 2 of the paper: helix angle [deg] and face width [mm] of each pair, speed, load, and modifications.
HELIX_AND_WIDTH = {1: (9.8, 20.0), 2: (9.8, 40.0), 3: (20.2, 20.0), 4: (20.2, 40.0)}
PAPER_SPEED = angular_speed(2000.0)
PAPER_LOAD = Load(50e3 / PAPER_SPEED, PAPER_SPEED)
PAPER_MODEL = Model(contact="linear", section="transverse")
CALIBRATED_MODEL = replace(PAPER_MODEL, tooth_stiffness="parabola", load_convention="paper")
PAPER_MODIFICATIONS = Modifications(profile_crowning=10e-6, lead_crowning=10e-6, tip_relief=5e-6)

# The contact of gear pair 1 at point A, under a line load of 273 N/mm. All temperatures are 360 K.
POINT_A = ehl.Contact(2.73e5, 4.015e-3, 1.0179, 3.7076)


def paper_gears(number: int) -> GearPairInputs:
    """Return one of the gear pairs 1 to 4 of Table 1."""
    helix, width = HELIX_AND_WIDTH[number]
    return GearPairInputs(
        GearTeeth(23), GearTeeth(30), 3e-3, width * 1e-3, helix_angle=radians(helix), rack_tip_radius=0.38
    )


def paper_pair(
    number: int, modifications: Modifications | None = None, model: Model = PAPER_MODEL
) -> LoadDistributionInputs:
    """Return the inputs for one of the gear pairs 1 to 4. Each of these pairs transmits 50 kW at 2000 1/min."""
    return LoadDistributionInputs(paper_gears(number), PAPER_LOAD, modifications or Modifications(), model=model)


@cache
def pair(number: int, model: Model = PAPER_MODEL, modifications: Modifications | None = None) -> LoadDistribution:
    """Solve the load distribution of one of the gear pairs 1 to 4."""
    return solve_load_distribution(paper_pair(number, modifications, model))


@cache
def scuffing() -> Scuffing:
    """Solve the scuffing check of gear pair 1."""
    return solve_scuffing(
        ScuffingInputs(
            paper_pair(1),
            lubricant=Lubricant(),
            friction="given",
            temperatures=Temperatures(bulk=360.0, bulk_method="given"),
        )
    )


@cache
def point_a(rheology: ehl.Rheology = "ree_eyring", *, thermal: bool = True) -> ehl.LineContactResult:
    """Solve the line contact at point A on a grid of 241 nodes."""
    model = replace(ehl.Model(), thermal=thermal, nodes=241)
    return ehl.solve(ehl.LineContactInputs(POINT_A, model=replace(model, rheology=rheology), lubricant=Lubricant()))


def film(rheology: ehl.Rheology = "ree_eyring", *, thermal: bool = True) -> float:
    """Return the least film thickness [um] in the contact at point A (Fig. 20)."""
    return (point_a(rheology, thermal=thermal).film.minimum or 0.0) * 1e6


def mid_film_temperature() -> float:
    """Return the largest temperature [K] in the middle plane of the film, in the contact at point A (Fig. 21)."""
    temperature = point_a().temperature
    assert temperature is not None
    return temperature.mid_film_max


def centre_pressure() -> float:
    """Return the largest pressure [GPa] in the contact at point A (Fig. 20)."""
    pressure = point_a().pressure
    assert pressure is not None
    return pressure.maximum * 1e-9


def root_load(number: int, model: Model) -> float:
    """Return the line load [N/mm] at the start of the mesh, where the root of the pinion tooth meshes (Fig. 11)."""
    return float(pair(number, model).feature_line.line_load[0]) * 1e-3


def film_over_formula() -> float:
    """Return the largest ratio of two film thicknesses over all points of the path of contact (Fig. 23).

    The first film thickness is the least film thickness in the thermal EHL solution at a point. The second film
    thickness follows from the formula of Dowson and Higginson at the same point.
    """
    path = scuffing().path
    assert path.thermal is not None
    return float(np.nanmax(path.thermal.minimum_film / path.dowson_higginson))


def thinnest_psi() -> float:
    """Return the position psi on the path of contact at which the film is thinnest (Fig. 23)."""
    film = scuffing().film
    assert film is not None
    return film.min_at_psi or 0.0


def helix_slope_pressure(slope: float) -> float:
    """Return the largest contact pressure of gear pair 4. `slope` is the helix slope [m] (Fig. 17)."""
    largest = pair(4, PAPER_MODEL, replace(PAPER_MODIFICATIONS, helix_slope=slope)).pressure.max
    assert largest is not None
    return largest
