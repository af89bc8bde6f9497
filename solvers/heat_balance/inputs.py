"""Inputs of the cooling of a gear pair or gear unit."""

from dataclasses import fields, replace
from typing import Literal

from solvers.errors import InvalidInput
from solvers.quantity import quantity, record
from solvers.sources import JUNGNICKEL, MAUZ, OWN

Jets = Literal["into_mesh", "out_of_mesh"]
GearName = Literal["pinion", "wheel"]

WETTING_SHARE, FLING_OFF_FACTOR, REWETTING_SHARE = 0.5, 1.0, 0.0


@record
class Casing:
    """The casing of a gear unit; if no area is given, the casing is left out of the heat balance."""

    area: float | None = quantity(
        "area of the casing",
        "A_C",
        unit="m2",
        default=None,
        ge=0.01,
        le=1000,
        default_text="the casing does not take part",
        assumed="no heat leaves through the casing, which is the safe side",
    )
    inside: float = quantity(
        "heat transfer inside the casing",
        "h_in",
        unit="w_per_m2_k",
        default=50.0,
        ge=0.1,
        le=5000,
        assumed="oil mist and oil that runs down",
    )
    outside: float = quantity(
        "heat transfer outside the casing",
        "h_out",
        unit="w_per_m2_k",
        default=12.0,
        ge=0.1,
        le=1000,
        assumed="free convection and radiation",
    )
    ambient: float = quantity(
        "temperature of the surroundings", "θ_amb", unit="c", default=25.0, ge=-50, le=80, tolerance=10, assumed="25 °C"
    )
    mass: float | None = quantity(
        "mass of the casing",
        "m_C",
        unit="kg",
        default=None,
        ge=1,
        le=1e6,
        default_text="required by a warm-up with a casing",
    )


@record
class JetDistribution:
    """Relative oil flow of the jets along the face, the same on both gears.

    It is linear between the positions, constant beyond them, and scaled to the mean 1 over the face.
    """

    position: tuple[float, ...] = quantity(
        "positions of the jets' distribution",
        "y_g",
        unit="mm",
        default=(),
        ge=0,
        le=5000,
        tolerance=1,
        length=(0, 100),
        text="rising, from the end that meshes first",
    )
    weight: tuple[float, ...] = quantity(
        "relative oil flow",
        "g",
        default=(),
        gt=0,
        le=1000,
        tolerance=0.1,
        length=(0, 100),
        text="oil per width of face at each position",
    )


@record
class FaceReading:
    """A temperature measured at a place of the face."""

    gear: GearName = quantity("gear of the reading")
    place: Literal["flank", "body"] = quantity("place of the reading", text="loaded flank, or tooth and rim")
    position: float = quantity(
        "position of the reading", "y_θ", unit="mm", ge=0, le=5000, tolerance=1, text="from the end that meshes first"
    )
    temperature: float = quantity("temperature of the reading", "θ", unit="c", ge=-50, le=400, tolerance=3)
    helix: Literal[1, 2] = quantity(
        "helix of the reading", default=1, text="of double-helical gears: 1 at the lower Z, or 2"
    )


@record
class Measured:
    """Temperatures measured in operation: at most one temperature per gear, and the temperature of the drained oil.

    A thermocouple in a tooth or in the rim measures the temperature of the body. An infrared sensor measures the
    temperature of the flank.
    """

    pinion_flank: float | None = quantity(
        "measured flank of the pinion",
        "θ_F1",
        unit="c",
        default=None,
        ge=-50,
        le=400,
        tolerance=3,
        default_text="not measured",
    )
    pinion_body: float | None = quantity(
        "measured body of the pinion",
        "θ_B1",
        unit="c",
        default=None,
        ge=-50,
        le=400,
        tolerance=3,
        default_text="not measured",
    )
    wheel_flank: float | None = quantity(
        "measured flank of the wheel",
        "θ_F2",
        unit="c",
        default=None,
        ge=-50,
        le=400,
        tolerance=3,
        default_text="not measured",
    )
    wheel_body: float | None = quantity(
        "measured body of the wheel",
        "θ_B2",
        unit="c",
        default=None,
        ge=-50,
        le=400,
        tolerance=3,
        default_text="not measured",
    )
    drain: float | None = quantity(
        "measured drain",
        "θ_D",
        unit="c",
        default=None,
        ge=-50,
        le=400,
        tolerance=2,
        default_text="not measured",
        text="all oil that leaves the unit, that of the bearings too",
    )
    face: tuple[FaceReading, ...] = quantity(
        "temperatures measured along the face",
        default=(),
        length=(0, 8),
        text="two or more thermocouples, instead of the single values; wetting share and skew of the jets follow",
    )

    @property
    def rotors(self) -> dict[str, float]:
        """Measured temperatures of the gears [K]. The keys are names of nodes; the pinion comes first."""
        given = {item.name: getattr(self, item.name) for item in fields(self) if item.name not in {"drain", "face"}}
        return {name: value for name, value in given.items() if value is not None}

    @property
    def any(self) -> bool:
        """Whether any temperature was measured."""
        return bool(self.rotors) or self.drain is not None or bool(self.face)


@record
class Cooling:
    """Supply of oil to the teeth, further losses that heat the oil, and measured temperatures."""

    gear_flow: float | None = quantity(
        "oil flow to the gears",
        "Q_g",
        OWN,
        unit="l_per_min",
        default=None,
        ge=0.1,
        le=5000,
        default_text="sized by its temperature rise",
        assumed="the flow that mesh friction and windage warm by the sizing rise; other heat does not order more oil",
    )
    flow_rise: float = quantity(
        "rise by which the flow is sized",
        "ΔT_Q",
        OWN,
        unit="k",
        default=20.0,
        ge=2,
        le=60,
        tolerance=2,
        assumed="20 K, usual for turbo gear units",
        folded=True,
    )
    flow_to_pinion: float = quantity(
        "share of the oil for the pinion",
        "s_1",
        OWN,
        default=0.5,
        ge=0.02,
        le=1,
        tolerance=0.1,
        assumed="both gears get as much",
        folded=True,
    )
    jets: Jets = quantity("direction of the jets", default="into_mesh", assumed="into the mesh")
    jet_speed: float = quantity(
        "speed of the jets",
        "v_jet",
        unit="m_per_s",
        default=20.0,
        ge=1,
        le=80,
        tolerance=5,
        assumed="20 m/s, a pressure of 2 bar",
        folded=True,
    )
    wetting_share: float | None = quantity(
        "wetting share",
        "w",
        OWN,
        default=None,
        ge=0.02,
        le=1,
        tolerance=0.2,
        text="share of the oil that reaches the flanks",
        default_text=f"{WETTING_SHARE:g}",
        assumed="0.5, the middle of 0.2 to 1; unknown without a measured temperature",
        folded=True,
    )
    rewetting_share: float | None = quantity(
        "rewetting share",
        "w_r",
        OWN,
        default=None,
        ge=0,
        le=1,
        tolerance=0.1,
        text="share of the gap to a flooded film that oil from the mist fills",
        default_text=f"{REWETTING_SHARE:g}",
        assumed="0, the safe side",
        folded=True,
    )
    fling_off_factor: float | None = quantity(
        "fling-off factor",
        "f",
        OWN,
        default=None,
        ge=0.2,
        le=5,
        tolerance=0.2,
        text="factor on the cooling by the film",
        default_text=f"{FLING_OFF_FACTOR:g}",
        assumed="1, the cooling as derived",
        folded=True,
    )
    mist_convection_factor: float = quantity(
        "mist convection factor",
        "f_m",
        JUNGNICKEL,
        default=3.0,
        ge=0.5,
        le=20,
        tolerance=1,
        text="cooling by mist over that by air",
        assumed="3; the mist carries oil",
        folded=True,
    )
    pumping_to_teeth: float = quantity(
        "share of the pumped heat for the teeth",
        "r",
        OWN,
        default=0.1,
        ge=0.02,
        le=1,
        tolerance=0.05,
        assumed="a tenth; the gas leaves the mesh with the rest",
        folded=True,
    )
    pumping: float = quantity(
        "pumping loss",
        "P_pump",
        unit="w",
        default=0.0,
        ge=0,
        le=1e7,
        tolerance=100,
        text="of both gears",
        assumed="none; the pumping check or the drive train computes it",
    )
    windage: float | None = quantity(
        "windage",
        "P_wind",
        MAUZ,
        unit="w",
        default=None,
        ge=0,
        le=1e7,
        tolerance=100,
        text="of both gears",
        default_text="by Mauz",
        assumed="by Mauz, the lowest of three formulas",
        folded=True,
    )
    other: float | None = quantity(
        "other losses into the oil mist",
        "P_other",
        unit="w",
        default=None,
        ge=0,
        le=1e7,
        tolerance=100,
        text="seals, thrust bearing, churning",
        default_text="0",
        assumed="none",
        folded=True,
    )
    bearing_film_share: float = quantity(
        "film share of a bearing's rise",
        "s",
        default=0.8,
        ge=0.02,
        le=1,
        tolerance=0.1,
        text="rise of the film over that of the oil that leaves",
        assumed="0.8 (Cameron; quoted, not verified)",
        folded=True,
    )
    jet_distribution: JetDistribution = quantity(
        "distribution of the jets along the face",
        default_factory=JetDistribution,
        text="used where the temperatures follow the face",
        folded=True,
    )
    band: bool = quantity(
        "band",
        default=True,
        text="adds the lowest and highest temperatures over the uncertain cooling",
        folded=True,
    )
    measured: Measured = quantity("measured temperatures", default_factory=Measured)
    casing: Casing = quantity("casing", default_factory=Casing)

    def jet_velocity(self) -> float:
        """Return the velocity of the jets [m/s]; negative if the jets point against the teeth that leave the mesh."""
        return self.jet_speed if self.jets == "into_mesh" else -self.jet_speed

    @property
    def wetting(self) -> float:
        """The given wetting share, or its default value."""
        return WETTING_SHARE if self.wetting_share is None else self.wetting_share

    @property
    def rewetting(self) -> float:
        """The given rewetting share, or its default value."""
        return REWETTING_SHARE if self.rewetting_share is None else self.rewetting_share

    @property
    def factor(self) -> float:
        """The given fling-off factor, or its default value."""
        return FLING_OFF_FACTOR if self.fling_off_factor is None else self.fling_off_factor

    @property
    def states_anything(self) -> bool:
        """Whether any input of the cooling differs from its default; one that is given and equals it does not."""
        used = replace(self, wetting_share=self.wetting, rewetting_share=self.rewetting, fling_off_factor=self.factor)
        plain = Cooling(wetting_share=WETTING_SHARE, rewetting_share=REWETTING_SHARE, fling_off_factor=FLING_OFF_FACTOR)
        return replace(used, other=self.other or None, band=True) != plain

    def check(self) -> None:
        """Refuse (`exclusive`) two measurements of one gear, or shares and losses given besides measurements."""
        measured = self.measured
        for gear in ("pinion", "wheel"):
            if {f"{gear}_flank", f"{gear}_body"} <= set(measured.rotors):
                message = (
                    f"measured temperatures are given for both the flank and the body of the {gear}; give only one of "
                    "them"
                )
                raise InvalidInput("exclusive", message, f"cooling.measured.{gear}_body")
        if measured.face and measured.rotors:
            message = (
                "temperatures are measured along the face and for a whole gear; give either the readings along the "
                "face or one temperature per gear"
            )
            raise InvalidInput("exclusive", message, "cooling.measured.face")
        if measured.face and self.jet_distribution.position:
            message = (
                "the skew of the jets follows from the temperatures measured along the face; give either the readings "
                "or the distribution"
            )
            raise InvalidInput("exclusive", message, "cooling.jet_distribution")
        if (measured.rotors or measured.face) and self.wetting_share is not None:
            message = (
                "the wetting share follows from the measured temperature of a gear; give either the measured "
                "temperature or the wetting share, not both"
            )
            raise InvalidInput("exclusive", message, "cooling.wetting_share")
        if measured.drain is not None and self.other is not None:
            message = (
                "the other losses follow from the measured drain temperature; give either the drain temperature or the "
                "other losses, not both"
            )
            raise InvalidInput("exclusive", message, "cooling.other")
