"""Former classes of oils; the next minor version removes these classes.

Use `OilSheet`, `iso_vg` or `sheet_of_index` for an oil that is given by its data sheet or grade, and `Lubricant` for an
oil that is given by its viscosity.
"""

from dataclasses import fields, replace

from solvers.lubricants import Lubricant, OilKind, PressureViscosityLaw
from solvers.oils import IsoGrade, OilSheet, iso_vg, sheet_of_index
from solvers.quantity import described, record


@record
class OilBySheet:
    """Former class of an oil given by grade or data sheet; use `OilSheet`, `iso_vg` or `sheet_of_index` instead."""

    iso_vg: IsoGrade | None = described("ISO 3448 viscosity grade.", default=None)
    kinematic_viscosity_40: float | None = described("Kinematic viscosity at 40 C [m^2/s].", default=None)
    kinematic_viscosity_100: float | None = described(
        "Kinematic viscosity at 100 C; None: by the viscosity index, else typical of the kind [m^2/s].", default=None
    )
    viscosity_index: float | None = described(
        "Viscosity index; None: by the viscosity at 100 C, else typical of the kind [-].", default=None
    )
    kind: OilKind = described("Kind of oil.", default="mineral")
    density_15: float | None = described("Density at 15 C; None: typical of the kind [kg/m^3].", default=None)

    def sheet(self) -> OilSheet | None:
        """Return the oil that the grade or the data sheet describes; return None if neither is given.

        Raises InvalidInput (`viscosity_order` or `viscosity_index`) if no oil has the given viscosities.
        """
        index, kind, density = self.viscosity_index, self.kind, self.density_15
        if self.iso_vg is not None:
            return iso_vg(self.iso_vg, kind, index, density)
        if self.kinematic_viscosity_40 is None:
            return None
        if self.kinematic_viscosity_100 is None:
            return sheet_of_index(self.kinematic_viscosity_40, index, kind, density)
        return OilSheet(self.kinematic_viscosity_40, self.kinematic_viscosity_100, kind, density)


@record
class OilChoice(OilBySheet):
    """Former class of an oil given by grade, data sheet or viscosity; use `OilSheet` or `Lubricant` instead.

    If a grade or data sheet is given, a property that is None gets a value typical of the kind of oil. If neither is
    given, a property that is None gets the value of the default `Lubricant`.
    """

    viscosity: float | None = described(
        "Viscosity at the reference temperature; not used with a grade or data sheet [Pa s].", default=None
    )
    reference_temperature: float | None = described("Temperature of viscosity and density [K].", default=None)
    pressure_viscosity: float | None = described("Pressure-viscosity coefficient of Barus [1/Pa].", default=None)
    temperature_viscosity: float | None = described(
        "Temperature-viscosity coefficient of Reynolds [1/K].", default=None
    )
    density: float | None = described("Density at the reference temperature [kg/m^3].", default=None)
    specific_heat: float | None = described("Specific heat [J/(kg K)].", default=None)
    thermal_conductivity: float | None = described("Thermal conductivity [W/(m K)].", default=None)
    pressure_viscosity_law: PressureViscosityLaw = described("Law of the viscosity over pressure.", default="roelands")
    compressible: bool = described("Whether the density depends on pressure and temperature.", default=True)

    def resolve(self) -> OilSheet | Lubricant | None:
        """Return the oil in the form that the models use.

        The result is None if neither a grade, nor a data sheet, nor a viscosity is given.
        """
        given = {item.name: getattr(self, item.name) for item in fields(self)}
        if sheet := self.sheet():
            names = {item.name for item in fields(OilSheet)} - {item.name for item in fields(OilBySheet)}
            return replace(sheet, **{name: given[name] for name in names & given.keys()})
        names = {item.name for item in fields(Lubricant)}
        properties = {name: value for name, value in given.items() if name in names and value is not None}
        return None if self.viscosity is None else Lubricant(**properties)
