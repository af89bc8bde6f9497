"""What both methods take from the pair, in the units of the standard: radii, speeds, thermo-elastic factor, oil."""

from dataclasses import dataclass
from functools import cached_property
from math import cos

import numpy as np

from solvers.arrays import FloatArray
from solvers.contact.hertz import reduced_modulus
from solvers.errors import InvalidInput
from solvers.gears.pair import PathOfContact
from solvers.lubricants import Lubricant, OilKind
from solvers.materials import Solid
from solvers.oils import SQUARE_MILLIMETRE, OilSheet, lubricant_at
from solvers.scuffing.inputs import LoadDistributionInputs, OilSupply, StandardFactors, Temperatures, grade_in_force
from solvers.scuffing.load_factors.method_b import MM, UM
from solvers.scuffing.load_factors.results import LoadFactors
from solvers.scuffing.thermal.practice import OIL_SUPPLY_FACTOR, pitch_line_velocity


@dataclass(frozen=True, slots=True)
class StandardOil:
    """The oil of the pair."""

    viscosity: float  # at the oil temperature, mPa s
    kinematic_viscosity_40: float | None  # mm^2/s; None if the oil is given by its viscosity
    kind: OilKind


def standard_oil(oil: OilSheet | Lubricant, temperature: float) -> StandardOil | None:
    """Return the oil at the oil temperature [K]; None if its law does not reach this temperature."""
    try:
        viscosity = lubricant_at(oil, temperature).viscosity_at(0.0, temperature)
    except InvalidInput:  # the request does not need this viscosity elsewhere: friction and bulk are given
        return None
    thick = oil.kinematic_viscosity_40 / SQUARE_MILLIMETRE if isinstance(oil, OilSheet) else None
    return StandardOil(viscosity * 1e3, thick, oil.kind)


@dataclass(frozen=True)
class StandardMesh:
    """A loaded pair in mm, N, m/s and um; `pinion` and `wheel` are driver and driven gear as everywhere in the service.

    `factors` has the load factors, `asked` the state of the flanks.
    """

    given: LoadDistributionInputs
    path: PathOfContact
    factors: LoadFactors
    asked: StandardFactors
    temperatures: Temperatures
    oil: StandardOil

    @property
    def line_load(self) -> float:
        """Transverse unit load w_Bt [N/mm]."""
        return self.factors.line_load * MM

    @cached_property
    def velocity(self) -> float:
        """Speed of the working pitch circles [m/s]."""
        return pitch_line_velocity(self.given, self.path)

    @property
    def roughness(self) -> float:
        """Mean roughness of both flanks [um]."""
        return (self.given.pinion_material.roughness + self.given.wheel_material.roughness) / 2 / UM

    @property
    def grade(self) -> int:
        """Quality grade of the flanks."""
        return grade_in_force(self.asked.quality_grade, self.given.gears)

    @property
    def centre_distance(self) -> float:
        """Centre distance [mm]."""
        return self.path.pair.centre_distance / MM

    @property
    def supply_factor(self) -> float:
        """Lubrication system factor X_S [-]."""
        supply: OilSupply = self.temperatures.oil_supply
        return OIL_SUPPLY_FACTOR[supply]

    @property
    def oil_temperature(self) -> float:
        """Oil temperature [C]."""
        return self.temperatures.oil - 273.15

    @cached_property
    def pitch_radius(self) -> float:
        """Reduced radius of curvature at the pitch point, in the normal section [mm]."""
        return float(self.reduced_radius(self.pitch))

    @property
    def pitch(self) -> float:
        """Distance of the pitch point from A [m]."""
        return self.path.pitch_point - self.path.start

    def radii(self, x: FloatArray | float) -> tuple[FloatArray, FloatArray]:
        """Transverse radii of curvature of driver and driven gear at x [m] from A [mm]."""
        first = np.asarray(self.path.start + x)
        return first / MM, (self.path.pair.line_of_action - first) / MM

    def reduced_radius(self, x: FloatArray | float) -> FloatArray:
        """Reduced radius of curvature at x [m] from A, in the normal section [mm]."""
        first, second = self.radii(x)
        return first * second / (first + second) / cos(self.path.pair.base_helix_angle)

    def thermo_elastic_factor(self, x: FloatArray | float) -> FloatArray:
        """Thermo-elastic factor X_M at x [m] from A [K s^0.5 m^0.5 mm/N^0.75] (Eq. T5).

        sqrt(1000) E_r^0.25 (sqrt v_1 + sqrt v_2)/(B_1 sqrt v_1 + B_2 sqrt v_2), E_r in N/mm^2, B in 1e3 W s^.5/(m^2 K).
        """
        pinion, wheel = self.given.pinion_material, self.given.wheel_material
        roots = [np.sqrt(speed) for speed in self.path.surface_speeds(np.asarray(x), 1.0)]
        conducted = _contact_coefficient(pinion) * roots[0] + _contact_coefficient(wheel) * roots[1]
        elastic = np.sqrt(1e3) * (reduced_modulus(pinion, wheel) * 1e-6) ** 0.25
        return np.asarray(elastic * (roots[0] + roots[1]) / conducted)


def _contact_coefficient(solid: Solid) -> float:
    """Thermal contact coefficient B_M = sqrt(lambda rho c) [1e3 W s^0.5/(m^2 K)]."""
    return float(np.sqrt(solid.thermal_conductivity * solid.density * solid.specific_heat)) * 1e-3
