"""Pumping between gear teeth."""

from app.pages.about.entry import About, Equation, Misprint

ABOUT = About(
    title="Pumping of air and oil mist between gear teeth",
    paper="C. Milian, J. P. Distretti, P. Leoni, P. Velex, A model of the pumping action between the teeth of "
    "high-speed spur and helical gears, Gear Technology, May/June 2004",
    answers=(
        "What pressure, velocity and temperature the mist reaches while a tooth fills the space of its mate.",
        "Whether the flow out of the tooth space becomes sonic, and from which speed on.",
        "How much power is lost, where the face becomes hottest, and what a groove does about it.",
        "How much lead correction the uneven heating calls for.",
    ),
    equations=(
        Equation("Eq. 1", "state of the mist", "p / ρ^γ constant without heat and loss"),
        Equation("Eq. 3", "mass that leaves a slice", "dm/dt = −Σ ρ S U, signed by the direction of flow"),
        Equation("Eq. 4", "pressure of a slice", "(1/V) dV/dt + (1/γp) dp/dt = −Σ (S U / V) × ratio of densities"),
        Equation("Eq. 5-1", "volume of a slice", "V = S_A b / N"),
        Equation("Eq. 6", "density and temperature", "ρ′ = ρ (p′/p)^(1/γ),  T′ = T (p′/p)^((γ−1)/γ)"),
        Equation("Eq. 7", "most that passes an opening", "choked nozzle: exact for every γ"),
        Equation("default", "gas dynamics along the space", "mass, momentum and energy in one dimension, second order"),
    ),
    misprints=(
        Misprint("Eq. 3", "radial term without density", "ρ S_R U", "unit kg/s"),
        Misprint("Eq. 4", "minus between the terms; (−p_e/p)", "plus; (p_e/p)^(1/γ)", "unit 1/s; density at the exit"),
        Misprint("Eq. 4", "densities inside the bracket", "none: terms are S U", "unit 1/s"),
        Misprint("Eq. 6-2", "ρ′ = ρ (p/p′)^(1/γ)", "ρ′ = ρ (p′/p)^(1/γ)", "contradicts Eqs. 1 and 6-1"),
        Misprint("α, δ", "direction of flow fixed from 1 to N", "signed upwind flow", "it reverses in suction"),
        Misprint("tables", "“module”", "normal module", "the centre distances become 590 and 455 mm"),
        Misprint(
            "radial gap",
            "from the tip corner to the flank",
            "the narrowest place of the flank's channel, closed by the contact (option `tip`: as printed)",
            "as printed the flow stays far below sonic at the test speeds",
        ),
        Misprint(
            "pocket chain",
            "N slices that each lose a velocity head",
            "gas dynamics (option `pocket_chain`: as printed)",
            "the chain does not converge with N",
        ),
    ),
    limits=(
        "The mist is one perfect gas; oil is in its molar mass and exponent only.",
        "One-dimensional flow along the tooth space; ends and gaps lose their velocity head.",
        "The paper gives neither face width nor groove: 200 mm and 16 mm are assumed in the examples.",
        "Heat goes to the walls by transport only; the teeth themselves do not expand while it computes.",
        "No measured number stands in the paper; the table below holds on to its statements.",
    ),
)
