"""Former names, which leave with the next minor version: oils that had the fields of a request.

`OilSheet`, `iso_vg` and `sheet_of_index` make an oil by its data sheet or grade, `Lubricant` one by its viscosity.
"""

from dataclasses import dataclass, fields, replace

from solvers.lubricants import Lubricant, OilKind, PressureViscosityLaw
from solvers.oils import IsoGrade, OilSheet, iso_vg, sheet_of_index


@dataclass(frozen=True)
class OilBySheet:
    """Now `OilSheet`, `iso_vg` or `sheet_of_index`."""

    iso_vg: IsoGrade | None = None
    kinematic_viscosity_40: float | None = None
    kinematic_viscosity_100: float | None = None
    viscosity_index: float | None = None
    kind: OilKind = "mineral"
    density_15: float | None = None

    def sheet(self) -> OilSheet | None:
        """Return the oil by grade or data sheet; None where neither is given."""
        index, kind, density = self.viscosity_index, self.kind, self.density_15
        if self.iso_vg is not None:
            return iso_vg(self.iso_vg, kind, index, density)
        if self.kinematic_viscosity_40 is None:
            return None
        if self.kinematic_viscosity_100 is None:
            return sheet_of_index(self.kinematic_viscosity_40, index, kind, density)
        return OilSheet(self.kinematic_viscosity_40, self.kinematic_viscosity_100, kind, density)


@dataclass(frozen=True)
class OilChoice(OilBySheet):
    """Now `OilSheet` or `Lubricant`."""

    viscosity: float | None = None
    reference_temperature: float | None = None
    pressure_viscosity: float | None = None
    temperature_viscosity: float | None = None
    density: float | None = None
    specific_heat: float | None = None
    thermal_conductivity: float | None = None
    pressure_viscosity_law: PressureViscosityLaw = "roelands"
    compressible: bool = True

    def resolve(self) -> OilSheet | Lubricant | None:
        """Return the oil of the models; None where nothing says how viscous it is."""
        given = {each.name: getattr(self, each.name) for each in fields(self)}
        if sheet := self.sheet():
            open_to = {each.name for each in fields(OilSheet)} - {each.name for each in fields(OilBySheet)}
            return replace(sheet, **{name: given[name] for name in open_to})
        properties = {each.name for each in fields(Lubricant)}
        known = {name: value for name, value in given.items() if name in properties and value is not None}
        return None if self.viscosity is None else Lubricant(**known)
