"""An oil as its user knows it: by ISO grade, by its data sheet, or by its viscosity at one temperature."""

from dataclasses import fields, replace
from typing import Literal

from solvers.lubricants import Lubricant, OilKind, PressureViscosityLaw
from solvers.oils import OilSheet, iso_vg
from solvers.quantity import quantity, record
from solvers.sources import XUE

IsoGrade = Literal[32, 46, 68, 100, 150, 220, 320, 460, 680]


@record
class OilBySheet:
    """An oil by its ISO grade or by two kinematic viscosities, where that is what is known of it."""

    iso_vg: IsoGrade | None = quantity("ISO viscosity grade", "VG", "ISO 3448", default=None)
    kinematic_viscosity_40: float | None = quantity(
        "kinematic viscosity at 40 °C", "ν_40", "ASTM D341", unit="mm2_per_s", default=None, ge=2, le=5000
    )
    kinematic_viscosity_100: float | None = quantity(
        "kinematic viscosity at 100 °C",
        "ν_100",
        "ASTM D341",
        unit="mm2_per_s",
        default=None,
        ge=1,
        le=1000,
        default_text="with a grade, typical of a mineral oil of viscosity index 95",
        assumed="typical of a mineral oil with viscosity index 95",
    )
    kind: OilKind = quantity(
        "kind of oil", default="mineral", assumed="a mineral oil, where the data sheet's kind is not given"
    )
    density_15: float | None = quantity(
        "oil density at 15 °C",
        "ρ_15",
        unit="kg_per_m3",
        default=None,
        ge=500,
        le=2000,
        default_text="by the kind of oil; a data sheet rarely gives it",
        assumed="by the kind of oil; a data sheet rarely gives it",
    )

    def sheet(self) -> OilSheet | None:
        """The oil by grade or data sheet; None where neither is given.

        Raises InvalidInput (viscosity_order) where it would not thin as it warms.
        """
        if self.iso_vg is not None:
            known = iso_vg(self.iso_vg)
        elif self.kinematic_viscosity_40 is None or self.kinematic_viscosity_100 is None:
            return None
        else:
            known = OilSheet(self.kinematic_viscosity_40, self.kinematic_viscosity_100)
        return replace(known, kind=self.kind, density_15=self.density_15)


@record
class OilChoice(OilBySheet):
    """What is known of an oil; one of `iso_vg`, the two kinematic viscosities and `viscosity` names it.

    `reference_temperature` and `density` belong to `viscosity`; a property that is None is that of the kind of oil with
    a grade or data sheet, and that of `Lubricant` otherwise.
    """

    viscosity: float | None = quantity(
        "oil viscosity",
        "η_0",
        f"{XUE}, Table 2",
        unit="pa_s",
        default=None,
        ge=1e-5,
        le=100,
        text="viscosity at the reference temperature and no pressure",
        default_text="by grade or data sheet; with neither no oil is known",
    )
    reference_temperature: float | None = quantity(
        "oil reference temperature",
        "θ_0",
        f"{XUE}, Eq. 20",
        unit="c",
        default=None,
        ge=-50,
        le=300,
        tolerance=1,
        text="temperature of viscosity and density",
        default_text="with grade or data sheet, where the oil enters the contact",
        assumed="86.85 °C, 360 K, at which the paper's viscosity gives its film thickness; give that of yours",
    )
    pressure_viscosity: float | None = quantity(
        "pressure-viscosity coefficient",
        "α",
        f"{XUE}, Table 2",
        unit="per_gpa",
        default=None,
        ge=1,
        le=60,
        default_text="with grade or data sheet, by kind and viscosity (Gold, from memory)",
        assumed="the paper's oil; with grade or data sheet, by kind and viscosity (Gold, from memory)",
    )
    temperature_viscosity: float | None = quantity(
        "temperature-viscosity coefficient",
        "β",
        f"{XUE}, Table 2",
        unit="per_k",
        default=None,
        ge=0,
        le=0.2,
        tolerance=0.001,
        default_text="with grade or data sheet, the slope of the Walther law",
        assumed="the paper's oil; with grade or data sheet, the slope of the Walther law",
    )
    density: float | None = quantity(
        "oil density",
        "ρ_0",
        f"{XUE}, Table 2",
        unit="kg_per_m3",
        default=None,
        ge=100,
        le=5000,
        text="density at the reference temperature",
        default_text="with grade or data sheet, from the density at 15 °C",
        assumed="the paper's oil",
    )
    specific_heat: float | None = quantity(
        "oil specific heat",
        "c_oil",
        f"{XUE}, Table 2",
        unit="j_per_kg_k",
        default=None,
        ge=100,
        le=10000,
        default_text="with grade or data sheet, by kind",
        assumed="the paper's oil; with grade or data sheet, by the kind of oil; a data sheet rarely gives it",
    )
    thermal_conductivity: float | None = quantity(
        "oil thermal conductivity",
        "λ_oil",
        f"{XUE}, Table 2",
        unit="w_per_m_k",
        default=None,
        ge=0.01,
        le=10,
        default_text="with grade or data sheet, by kind",
        assumed="the paper's oil; with grade or data sheet, by the kind of oil; a data sheet rarely gives it",
    )
    pressure_viscosity_law: PressureViscosityLaw = quantity(
        "pressure-viscosity law",
        None,
        f"{XUE}, Table 2",
        default="roelands",
        text="how viscosity depends on pressure and temperature",
        advanced=True,
    )
    compressible: bool = quantity(
        "compressible oil",
        None,
        f"{XUE}, Table 2",
        default=True,
        text="whether density follows pressure and temperature (Dowson and Higginson)",
        advanced=True,
    )

    def resolve(self) -> OilSheet | Lubricant | None:
        """The oil of the models; None where nothing says how viscous it is.

        Raises InvalidInput (viscosity_order) where it would not thin as it warms.
        """
        sheet = self.sheet()
        if sheet is not None:
            return replace(sheet, **{name: getattr(self, name) for name in _BEYOND_VISCOSITY})
        if self.viscosity is None:
            return None
        given = {item.name: getattr(self, item.name) for item in fields(Lubricant)}
        return Lubricant(**{name: value for name, value in given.items() if value is not None})


_BEYOND_VISCOSITY = (
    "pressure_viscosity",
    "temperature_viscosity",
    "specific_heat",
    "thermal_conductivity",
    "pressure_viscosity_law",
    "compressible",
)
