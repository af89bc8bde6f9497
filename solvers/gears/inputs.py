"""Inputs that describe a gear pair."""

from math import atan, cos, tan
from typing import Literal

from solvers.errors import InvalidInput
from solvers.quantity import quantities, quantity, record
from solvers.sources import ISO_1328, ISO_21771

GROUND_FILLET = 0.25  # usual tip radius of the rack for ground teeth, in normal modules
RACK_A = 0.38  # tip radius of rack A of ISO 53, in normal modules; assumed if the tooth stiffness matters


@record
class GearTeeth:
    """Teeth of one gear; all coefficients are in normal modules.

    If a tip diameter is given, the addendum is not used.
    """

    teeth: int = quantity(
        "number of teeth", "z", ISO_21771, ge=5, le=1000, if_negative="internal gears are not modelled"
    )
    profile_shift: float = quantity(
        "profile shift coefficient", "x", ISO_21771, default=0.0, ge=-2, le=3, tolerance=0.01
    )
    addendum: float | None = quantity(
        "addendum coefficient",
        "h_aP*",
        "ISO 53",
        default=1.0,
        ge=0.01,
        le=3,
        text="addendum coefficient of the rack; the tip diameter follows",
        default_text="by the tip diameter",
    )
    dedendum: float = quantity(
        "dedendum coefficient",
        "h_fP*",
        "ISO 53",
        default=1.25,
        ge=0.01,
        le=3,
        text="dedendum coefficient of the rack; the root radius follows",
    )
    tip_diameter: float | None = quantity(
        "tip diameter",
        "d_a",
        ISO_21771,
        unit="mm",
        kw_only=True,
        default=None,
        ge=0.1,
        le=20000,
        tolerance=0.05,
        text="tip diameter of the drawing, instead of the addendum coefficient",
        default_text="by the addendum coefficient",
    )


@record
class GearPairInputs:
    """An external gear pair, spur or helical, with parallel axes; the pinion drives."""

    pinion: GearTeeth = quantity("pinion", text="the driving gear")
    wheel: GearTeeth = quantity("wheel", text="the driven gear")
    module: float = quantity(
        "module", "m", ISO_21771, unit="mm", ge=0.01, le=100, text="module in the plane that is chosen below"
    )
    module_plane: Literal["normal", "transverse"] = quantity(
        "plane of the module",
        None,
        ISO_21771,
        kw_only=True,
        default="normal",
        text="plane of module and pressure angle",
    )
    pressure_angle: float = quantity(
        "pressure angle",
        "α",
        ISO_21771,
        unit="deg",
        kw_only=True,
        default=20.0,
        ge=10,
        le=35,
        text="pressure angle at the reference circle, in the module's plane",
    )
    helix_angle: float = quantity(
        "helix angle",
        "β",
        ISO_21771,
        unit="deg",
        kw_only=True,
        default=0.0,
        ge=0,
        le=45,
        tolerance=0.05,
        text="helix angle at the reference circle; the hand does not matter",
        if_negative=(
            "give the angle without a sign; the hand of the helix matters only in the drive train and is `gears.hand` "
            "there"
        ),
    )
    face_width: float = quantity(
        "face width",
        "b",
        ISO_21771,
        unit="mm",
        ge=0.01,
        le=5000,
        tolerance=0.1,
        text="common face width; of double-helical gears, the width of one helix",
    )
    gap_width: float | None = quantity(
        "gap between the helices",
        "e",
        unit="mm",
        kw_only=True,
        default=None,
        ge=0,
        le=2000,
        tolerance=0.1,
        text="its presence makes the gears double helical",
        default_text="single helical or spur",
    )
    centre_distance: float | None = quantity(
        "centre distance",
        "a",
        ISO_21771,
        unit="mm",
        kw_only=True,
        default=None,
        ge=0.1,
        le=20000,
        tolerance=0.02,
        default_text="the backlash-free value",
    )
    rack_tip_radius: float = quantity(
        "root fillet radius coefficient",
        "ρ_fP*",
        "ISO 53",
        kw_only=True,
        ge=0,
        le=0.6,
        tolerance=0.02,
        text="tip radius coefficient of the rack, at most the full radius",
        assumed="a usual ground fillet; the paper gives none",
    )
    quality_class: int | None = quantity(
        "quality class",
        "A",
        ISO_1328,
        kw_only=True,
        default=None,
        ge=1,
        le=11,
        text="flank tolerance class of both gears: what studies scatter, and the grade of the checks by the standard; "
        "the nominal flanks stay as they are",
        default_text="no tolerances",
        if_above="classes end at 11; the grade 12 of older editions has other tolerances",
    )

    @property
    def helices(self) -> int:
        """Number of helices side by side: 2 of double-helical gears."""
        return 1 if self.gap_width is None else 2

    @property
    def toothed_width(self) -> float:
        """Width of all helices, without the gap between them [m]."""
        return self.helices * self.face_width

    @property
    def total_width(self) -> float:
        """Width from the first helix's outer end to the last one's, with the gap [m]."""
        return self.toothed_width + (self.gap_width or 0.0)

    @property
    def normal_module(self) -> float:
        """Module in the normal section [m]."""
        return self.module if self.module_plane == "normal" else self.module * cos(self.helix_angle)

    def addendum_of(self, teeth: GearTeeth) -> float:
        """Return the addendum coefficient of one gear of the pair.

        If a tip diameter d_a is given, the coefficient is h_aP* = (d_a - d)/(2 m_n) - x. Raises InvalidInput:
        `missing_property` if neither addendum nor tip diameter is given; `tip_diameter` if the given tip diameter leads
        to an addendum coefficient outside its range.
        """
        name = "pinion" if teeth is self.pinion else "wheel"
        if teeth.tip_diameter is None:
            if teeth.addendum is None:
                raise InvalidInput("missing_property", "give addendum or tip_diameter", f"{name}.addendum")
            return teeth.addendum
        reference = teeth.teeth * self.normal_module / cos(self.helix_angle)
        addendum = (teeth.tip_diameter - reference) / (2 * self.normal_module) - teeth.profile_shift
        declared = quantities(GearTeeth)["addendum"].bounds
        if not declared["ge"] <= addendum <= declared["le"]:
            message = (
                f"a tip diameter of {teeth.tip_diameter * 1e3:.6g} mm corresponds to an addendum coefficient of "
                f"{addendum:.4g}, but the addendum coefficient must be between {declared['ge']:g} and "
                f"{declared['le']:g}; check the tip diameter, the module and the profile shift"
            )
            raise InvalidInput("tip_diameter", message, f"{name}.tip_diameter")
        return addendum

    @property
    def normal_pressure_angle(self) -> float:
        """Pressure angle at the reference circle in the normal section [rad]."""
        if self.module_plane == "normal":
            return self.pressure_angle
        return atan(tan(self.pressure_angle) * cos(self.helix_angle))
