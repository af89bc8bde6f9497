"""Results of a heat balance; SI units."""

from solvers.arrays import FloatArray
from solvers.notices import Notice
from solvers.quantity import described, quantity, record
from solvers.sources import ISO_6336, OWN

Range = tuple[float, float]


@record(equation="H18")
class GearTemperatures:
    """Temperatures of a gear, frictional heat that enters the gear, and cooling by the oil film."""

    flank: float = quantity("flank temperature", "θ_F", OWN, unit="c", text="loaded flank")
    body: float = quantity("body temperature", "θ_B", OWN, unit="c", text="unloaded flank, rim and shaft")
    friction: float = quantity("frictional heat of the gear", "P_F", unit="w", equation="H7")
    oil_conductance: float = quantity(
        "cooling by the oil", "G", OWN, unit="w_per_k", text="conductance of the film on both flanks", equation="H5"
    )
    flooded_conductance: float = quantity(
        "cooling by flooded flanks",
        "G_fl",
        OWN,
        unit="w_per_k",
        text="conductance of a film so thick that more oil does not help",
        equation="H5",
    )
    film: float = quantity("film laid in a turn", "h_0", OWN, unit="um", equation="H4")
    turn_film: float = quantity(
        "film that a turn can use",
        "h_turn",
        OWN,
        unit="um",
        text="film thickness that carries 0.9 of the flooded heat",
        equation="H5",
    )
    oil_limited: bool = quantity(
        "cooling limited by the oil", text="all oil reaches the temperature of the flank", equation="H5"
    )


@record(equation="H18")
class BearingHeat:
    """Temperatures, oil flow and friction of a plain bearing."""

    outlet: float = quantity("oil that leaves the bearing", "θ_J", unit="c")
    film: float = quantity("film temperature of the bearing", "θ_f", unit="c", equation="H12")
    oil_flow: float = quantity("oil flow of the bearing", "Q_B", unit="l_per_min", equation="H12")
    friction_power: float = quantity("friction power in the balance", "P_B", unit="w", equation="D5")


@record(equation="heat-balance#network")
class HeatFlow:
    """Heat flow between two nodes of the network."""

    from_: str = quantity("origin of the heat", text="node of the network, or source")
    to: str = quantity("target of the heat", text="node of the network, or oil, ambient")
    carrier: str = quantity("what carries the heat")
    power: float = quantity("heat flow", "P", unit="w")


@record(equation="H6")
class HeatLosses:
    """Losses that the oil and the surroundings take up [W]."""

    mesh: float = quantity("mesh loss", "P_mesh", unit="w", text="at the temperature of the flanks")
    pumping: float = quantity("pumping loss", "P_pump", unit="w", equation="heat-balance#losses")
    oil_acceleration: float = quantity(
        "acceleration of the oil",
        "P_acc",
        OWN,
        unit="w",
        text="power that the teeth give to the oil that hits them; negative if faster jets drive the teeth",
        equation="H9",
    )
    windage: float = quantity("windage", "P_wind", unit="w", equation="H8")
    bearings: float = quantity("bearing losses", "P_B", unit="w", equation="D5")
    couplings: float = quantity(
        "coupling losses", "P_C", unit="w", text="friction of the couplings; not part of the balance", equation="D9"
    )
    other: float = quantity("other losses", "P_other", unit="w", equation="heat-balance#losses")
    jets: float = quantity(
        "power of the oil jets",
        "P_jet",
        OWN,
        unit="w",
        text="supplied by the oil pump; no loss of the gears",
        equation="H9",
    )
    total: float = quantity("total heat of the losses", "P_V", unit="w", equation="heat-balance#losses")


@record(equation="H17")
class Balance:
    """Supplied heat, removed heat, and the difference of the two divided by the supplied heat."""

    supplied: float = quantity("heat supplied", "P_in", unit="w")
    removed: float = quantity("heat removed", "P_out", unit="w")
    error: float = quantity("error of the balance", text="difference over the heat supplied")


@record(equation="R8")
class BulkEstimates:
    """Bulk temperatures [K] by formulas of standards, for comparison."""

    iso_tr_13989_bulk: float | None = quantity("bulk by ISO/TS 6336-20", "θ_M", unit="c", default=None)
    iso_ts_6336_22_bulk: float | None = quantity(
        "bulk by ISO/TS 6336-22", "θ_M", unit="c", default=None, equation="H13"
    )


@record(equation="H21")
class HeatBand:
    """Ranges of temperatures and safety factor that follow from the uncertain cooling alone."""

    pinion_flank: Range = quantity("band of the pinion's flank", "θ_F1", unit="c", index="low, high")
    wheel_flank: Range = quantity("band of the wheel's flank", "θ_F2", unit="c", index="low, high")
    bulk: Range | None = quantity(
        "band of the bulk temperature", "θ_M", unit="c", default=None, index="low, high", text="of the contact"
    )
    safety: Range | None = quantity(
        "band of the safety",
        "S_B",
        default=None,
        index="low, high",
        text="covers the cooling only, not load, alignment or oil",
    )
    amplification: Range | None = quantity(
        "band of the amplification",
        "A",
        default=None,
        index="low, high",
        text="of misalignment by heat, at the coolest and the hottest flanks; left out with uniform temperatures",
        left_out=True,
        equation="W9",
    )


@record(equation="W1")
class GearAlongFace:
    """Temperatures of a gear at the stations of a face."""

    flank: FloatArray = quantity(
        "flank temperature along the face", "θ_F(y)", OWN, unit="c", index="station of the face"
    )
    body: FloatArray = quantity(
        "temperature of the teeth along the face",
        "θ_S(y)",
        OWN,
        unit="c",
        text="middle of the teeth, and root circle of the body",
        index="station of the face",
        equation="W2",
    )


@record(equation="W1")
class UniformHeat:
    """The same unit heated as by an even load; the difference is what the load's own heat adds."""

    face_load_factor: float | None = quantity("face load factor at even heat", "K_Hβ,0", ISO_6336)
    blok_flank: float | None = quantity(
        "safety factor at even heat", "S_B,0", text="on the flank by Blok; null without a scuffing temperature"
    )
    pinion_flank: FloatArray = quantity(
        "flank of the pinion at even heat",
        "θ_F1,0",
        OWN,
        unit="c",
        text="at the same positions",
        index="station of the face",
        detail="curves",
    )
    wheel_flank: FloatArray = quantity(
        "flank of the wheel at even heat",
        "θ_F2,0",
        OWN,
        unit="c",
        text="at the same positions",
        index="station of the face",
        detail="curves",
    )
    line_force: FloatArray = quantity(
        "transverse force per face at even heat",
        "q_0",
        unit="n_per_mm",
        text="at the same positions",
        index="station of the face",
        detail="curves",
        equation="D11",
    )


@record(kw_only=True, equation="W9")
class FaceHeat:
    """Temperatures along a face that follow from the load, and what they do to the load."""

    position: FloatArray = quantity(
        "position on the face", "y", unit="mm", text="from the end that meshes first", detail="curves"
    )
    pinion: GearAlongFace = quantity("pinion along the face", detail="curves")
    wheel: GearAlongFace = quantity("wheel along the face", detail="curves")
    lead: FloatArray = quantity(
        "gap by the own heat",
        "g_own",
        unit="um",
        text="of teeth and rotors",
        axis="position",
        equation="W5",
        detail="curves",
    )
    lead_slope: float = quantity("slope by the own heat", "f_own", unit="um", equation="W5")
    lead_crown: float = quantity("crown by the own heat", "C_own", unit="um", equation="W5")
    gain: float | None = quantity(
        "gain of the loop", "g", text="share of a skew of the load that its heat adds; null if it is unstable"
    )
    amplification: float | None = quantity(
        "amplification of misalignment", "A", text="1/(1 − g): what heat makes of a skewed gap; null if it is unstable"
    )
    end_amplification: float | None = quantity(
        "amplification at the end of the face", "A_end", text="of the largest line load; null if it is unstable"
    )
    largest_eigenvalue: float = quantity(
        "largest eigenvalue of the loop", "λ_1", text="from 1 on one end of the face takes the load"
    )
    uniform_heat: UniformHeat = quantity("at even heat")
    jet_skew: float | None = quantity(
        "skew of the jets",
        "j",
        default=None,
        text="that fits the readings along the face; stands for all that is unknown along it, sweeping oil included; "
        "left out without readings",
        left_out=True,
        equation="heat-balance#the-warm-face",
    )
    reading_deviation: FloatArray | None = quantity(
        "deviations from the readings",
        "Δθ",
        unit="k",
        default=None,
        text="calculated minus measured; left out without readings",
        index="reading, in the order of the request",
        left_out=True,
        equation="heat-balance#the-warm-face",
    )
    balance_error: float = quantity(
        "error of the balance along the face", text="difference over the heat supplied", equation="W3"
    )


@record(equation="H11")
class CoolingInForce:
    """Values that the calculation used for the optional inputs of the cooling."""

    gear_flow: float = quantity("oil flow to the gears used", "Q_g", unit="l_per_min")
    wetting_share: float = quantity("wetting share used", "w", equation="H4")
    rewetting_share: float = quantity("rewetting share used", "w_r", equation="heat-balance#network")
    fling_off_factor: float = quantity("fling-off factor used", "f", equation="H5")
    windage: float = quantity("windage used", "P_wind", unit="w", equation="H8")
    other: float = quantity("other losses used", "P_other", unit="w", equation="heat-balance#losses")


@record(equation="H18")
class Heat:
    """Temperatures, losses and heat flows of a gear pair or gear unit."""

    pinion: GearTemperatures = quantity("pinion in the balance")
    wheel: GearTemperatures = quantity("wheel in the balance")
    mist: float = quantity("oil mist", "θ_mist", OWN, unit="c")
    drain: float = quantity("drained oil", "θ_D", OWN, unit="c", text="all oil that leaves, mixed", equation="H20")
    casing: float | None = quantity("casing temperature", "θ_C", unit="c")
    gear_flow: float = quantity("oil flow to the gears in use", "Q_g", unit="l_per_min", equation="H11")
    total_flow: float = quantity("oil flow of all parts", "Q", unit="l_per_min", equation="H12")
    wetting_share: float = quantity("wetting share in use", "w", OWN, equation="H4")
    friction_to_pinion: float = quantity("share of the friction for the pinion", "φ", OWN, equation="H7")
    bearings: tuple[BearingHeat, ...] = quantity("bearings in the balance")
    flows: tuple[HeatFlow, ...] = quantity("flows of heat", detail="curves")
    losses: HeatLosses = quantity("losses in the balance")
    balance: Balance = quantity("balance of heat")
    estimates: BulkEstimates = quantity("estimates of the bulk")
    band: HeatBand | None = quantity(
        "band of the balance", text="range of the results over the uncertain cooling; null if the cooling is given"
    )
    wheel_deviation: float | None = quantity(
        "deviation of the wheel",
        "Δθ_2",
        unit="k",
        text="calculated minus measured, if both gears are measured",
        equation="H19",
    )
    drain_deviation: float | None = quantity(
        "deviation of the drain",
        "Δθ_D",
        unit="k",
        default=None,
        text="calculated minus measured; positive: the calculated losses warm the drain more than was measured",
        equation="H20",
    )
    backlash_loss: float | None = quantity(
        "loss of backlash by heat",
        "Δj",
        OWN,
        unit="um",
        default=None,
        text="from the temperatures of gears and casing; null without that of the casing",
        equation="H22",
    )
    face: FaceHeat | None = quantity(
        "temperatures along the face",
        text="of the face, or helix, that decides; left out where they are uniform",
        default=None,
        left_out=True,
    )
    flank_cases: tuple[tuple[float, float], ...] = described(
        "Temperatures of both flanks in the nominal case and at the corners of the band [K].",
        default=(),
    )
    warnings: tuple[Notice, ...] = ()
