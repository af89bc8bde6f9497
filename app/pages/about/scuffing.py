"""Load distribution, thermal contact and scuffing."""

from app.pages.about.entry import About, Equation, Misprint

ABOUT = About(
    title="Load distribution and scuffing of helical gears",
    paper="J. Xue, W. Zhang, Y. Wang, The load distribution with modification and misalignment and thermal "
    "elastohydrodynamic lubrication simulation of helical gears, 2020",
    answers=(
        "How a modified, misaligned pair carries its load over the flank, and what transmission error follows.",
        "Film, pressure, friction and temperatures of the line contact, solved with its heat.",
        "How hot the contact becomes along the path, by Blok and by the solved film, and how far from scuffing.",
    ),
    equations=(
        Equation("Eq. 1", "force in the balance", "F_bn = T / (r_b cos β_b)"),
        Equation("Eq. 2", "base pitch", "p_bt = π m_t cos α_t"),
        Equation(
            "Eqs. 5, 6", "compliance of one tooth", "bending, shear and foundation (Ishikawa) + flattening (Weber)"
        ),
        Equation("Eq. 9", "load on a line of contact", "w = k max(0, TE − Δ),  Σ ∫ w dl = F_bn"),
        Equation("Eq. 14", "Hertz pressure", "p_H = √(E′ w / (2 π R))"),
        Equation("Eq. 17", "film", "Reynolds equation with density and viscosity across the film"),
        Equation("Eq. 20", "viscosity", "Roelands, with S_0 = β (θ_0 − 138 K) / A_1"),
        Equation(
            "Eqs. 23, 24",
            "heat of film and solids",
            "conduction, convection, compression and shear; moving heat sources",
        ),
        Equation("Eq. 25", "flash temperature by Blok", "Δθ = 0.7858 μ w |u_1 − u_2| / ((B_1 √u_1 + B_2 √u_2) √b_0)"),
        Equation("Eq. 26", "safety against scuffing", "S_B = (θ_S − θ_oil) / (θ_B,max − θ_oil)"),
        Equation(
            "ISO/TR 13989-1",
            "mean friction, where none is given",
            "μ = 0.060 (w_Bt / (v_ΣC ρ_relC))^0.2 X_L X_R,  w_Bt ≥ 150 N/mm,  v_t ≤ 50 m/s in v_ΣC",
        ),
        Equation("ISO/TR 13989-1", "bulk temperature, where none is given", "θ_M = θ_oil + 0.47 X_S Δθ_mean"),
        Equation("Eq. 28", "specific film thickness", "λ = h_min / mean roughness of both flanks"),
    ),
    misprints=(
        Misprint(
            "Eq. 1", "balance with F_bt", "F_bt / cos β_b", "the load of Hertz, Blok and film is normal to the line"
        ),
        Misprint("Eq. 2", "p_bt = π m_t", "π m_t cos α_t", "the contact ratios of Table 1 need it"),
        Misprint("Eq. 4", "missing", "sum of the lengths of contact", "derived; checked by its limits"),
        Misprint("δ_G", "h_x", "h_x²", "dimensions, and the root's rotation"),
        Misprint("Eqs. 5, 6", "E_1, ν_1 of one member", "E, ν of each member", "symmetry"),
        Misprint("Eq. 9", "TE of each point", "one TE for each roll position", "its definition"),
        Misprint("Eq. 10", "TE by repetition", "sorted exact balance", "diverges at low load"),
        Misprint(
            "Eqs. 12, 13", "cos³β_b / (1 − 2 sin² β_b)", "radius / cos β_b", "exact; the print is singular at 45°"
        ),
        Misprint("Eq. 14", "π/4 in the largest pressure", "without π/4", "π/4 gives the mean; 1.51 GPa fits without"),
        Misprint("Eq. 18", "speeds from normal radii", "transverse radii", "kinematics"),
        Misprint("Eq. 20", "S_0 = β / (A_1 (θ_0 − 138))", "β (θ_0 − 138) / A_1", "the slope must be β at θ_0"),
        Misprint("Eq. 23", "without convection across the film", "included", "continuity; else heat does not balance"),
        Misprint(
            "Eq. 24", "no sign at the second surface", "heat flows into the solid", "without it the surface cools"
        ),
    ),
    limits=(
        "Involute pairs without axial offset; undercut and paths shortened by the fillet are warned of.",
        "Quasi-static: no dynamics, so speed enters through power, sliding and film only.",
        "Smooth surfaces: below λ = 1 the film is thinner than the roughness, and the numbers are bounds.",
        "Surfaces move fast against heat: below a Peclet number of 5 the flash temperature is too high.",
        "The estimated bulk temperature is one of flooded flanks: beyond 60 m/s it is a lower bound.",
        "Where the bulk temperature is given it does not follow the oil: a hotter oil alone then looks safer.",
        "The scuffing temperature is the user's; it belongs to oil, additive, material and finish.",
        "The thinnest film printed, 0.42 µm, does not follow from the printed equations; see the table.",
    ),
)
