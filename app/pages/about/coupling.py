"""Gear couplings."""

from app.pages.about.entry import About, Equation, Misprint

ABOUT = About(
    title="Gear couplings",
    paper="G. Pahl, The operating characteristics of gear-type couplings, Seventh Turbomachinery Symposium, 1978",
    answers=(
        "How the teeth of a misaligned coupling share the torque, and which of them lift off.",
        "Whether oil reaches the contact, how much load its film can carry, and which friction follows.",
        "How much axial force the coupling passes on before it slides, and the force that it makes itself.",
        "Which crowning keeps the best film over a range of misalignment.",
    ),
    equations=(
        Equation("geometry", "flank radii of a crowned tooth", "R_t = ε r_o / tan α,  R_e = ε r_o / sin α"),
        Equation("Fig. 6", "sliding velocity of a tooth at angle φ", "v_G = δ ω r_o sin φ"),
        Equation("Fig. 6", "hydrodynamic velocity, the sum of both surfaces", "v_H = |2 s′ + v_G|"),
        Equation("Figs. 3, 4", "tooth force; teeth never pull", "F_t = c_t max(0, ψ + f_t(φ) + p − e·n / cos α)"),
        Equation(
            "Fig. 7", "overlap of the contact with itself", "Pu = a_HZ / s_max,  a_HZ = √(8 F R_e (1 − ν²) / (π E h))"
        ),
        Equation("Fig. 8", "load capacity of the film", "F_HD = 2.447 h η v_H R_e / h_0 · f(B),  Tr = F_HD / F_n,max"),
        Equation("Fig. 9", "friction by the area of (Pu, Tr)", "nine areas, continuous across their boundaries"),
        Equation("axial part", "axial thrust", "F_ax = Σ μ F_n sgn(v_ax + v_G)"),
        Equation("axial part", "coaxial limit", "F_ax,max = μ T / (r_o cos α)"),
    ),
    misprints=(
        Misprint(
            "load capacity",
            "h above and “trag” below the bar",
            "h_trag, the load-carrying height",
            "units; the constant is Martin's 4.895/2",
        ),
        Misprint("test coupling", "ω = 200 rev/s", "200 rad/s = 1910 1/min", "head of the table, 1/s"),
        Misprint("load capacity", "v_C", "v_G, sliding velocity", "defined so in the axial part"),
        Misprint("text to Fig. 9", "area 1.1 of Figure 7", "Figure 9", "the areas are in Fig. 9"),
        Misprint("curve 2", "boundary lubrication, μ ≥ 0.01", "μ ≥ 0.1", "Fig. 9 and curve 1"),
        Misprint("axial part", "F_R is the sum of all normal forces", "F_R = μ Σ F_n", "the formula after it"),
        Misprint("conclusion", "r_p", "r_b", "definition ε = r_b / r_o"),
        Misprint(
            "curve 1",
            "Tr rises slightly as the misalignment falls",
            "flat to slowly falling",
            "linear tooth springs; not reproduced",
        ),
    ),
    limits=(
        "Misalignment up to 6 degrees in first order; contact at the edge of the face is warned of.",
        "Film: smooth, isoviscous, rigid flanks between which the oil has the viscosity given.",
        "The friction law is ours between the paper's bands; a measured table replaces its mixed branch.",
        "Tooth stiffness is a constant; profile errors, wear and centrifugal growth are not included.",
        "The inlet length of the oil is not defined in the paper: the face left ahead of the contact is taken.",
    ),
)
