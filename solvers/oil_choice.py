"""An oil as its user knows it: by ISO grade, by its data sheet, or by its viscosity at one temperature."""

from dataclasses import dataclass, fields, replace

from solvers.lubricants import Lubricant, OilKind, PressureViscosityLaw
from solvers.oils import OilSheet, iso_vg


@dataclass(frozen=True, slots=True)
class OilChoice:
    """What is known of an oil; one of `iso_vg`, the two kinematic viscosities and `viscosity` names it.

    Units as in `OilSheet` and `Lubricant`. `reference_temperature` and `density` belong to `viscosity`; a property that
    is None is that of the kind of oil with a grade or data sheet, and that of `Lubricant` otherwise.
    """

    iso_vg: int | None = None
    kinematic_viscosity_40: float | None = None
    kinematic_viscosity_100: float | None = None
    kind: OilKind = "mineral"
    density_15: float | None = None
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
        """The oil of the models; None where nothing says how viscous it is.

        Raises InvalidInput (viscosity_order) where it would not thin as it warms.
        """
        sheet = self._viscosities()
        if sheet is not None:
            known = {name: getattr(self, name) for name in _BEYOND_VISCOSITY}
            return replace(sheet, kind=self.kind, density_15=self.density_15, **known)
        if self.viscosity is None:
            return None
        given = {item.name: getattr(self, item.name) for item in fields(Lubricant)}
        return Lubricant(**{name: value for name, value in given.items() if value is not None})

    def _viscosities(self) -> OilSheet | None:
        """The sheet with nothing but its viscosities."""
        if self.iso_vg is not None:
            return iso_vg(self.iso_vg)
        if self.kinematic_viscosity_40 is None or self.kinematic_viscosity_100 is None:
            return None
        return OilSheet(self.kinematic_viscosity_40, self.kinematic_viscosity_100)


_BEYOND_VISCOSITY = (
    "pressure_viscosity",
    "temperature_viscosity",
    "specific_heat",
    "thermal_conductivity",
    "pressure_viscosity_law",
    "compressible",
)
