"""The drive train: coupling, shafts in bearings, pumped heat and mesh in one answer."""

from app.pages.about.entry import About, Equation, Misprint

ABOUT = About(
    title="Drive train: coupling, shafts, bearings, heat and mesh",
    paper="own derivation on Pahl 1978, Milian 2004, Xue 2020; shafts by Timoshenko and Cowper 1966, journal bearings "
    "by DuBois and Ocvirk 1953",
    answers=(
        "Where the misalignment of the flanks comes from: bending, torsion, tilting moment, films, coupling, heat.",
        "How the load lies over the face in the unit as built, and what to grind so that it lies evenly.",
        "What the thrust bearings see, what the unit loses, how far the flank is from scuffing.",
    ),
    equations=(
        Equation("2.1", "shafts", "Timoshenko elements, exact for stepped cylinders; reactions by statics"),
        Equation("2.2", "gap by the load", "g = S Q + g_ext + g_rigid,  S = Aᵀ C A"),
        Equation("2.3", "common equilibrium", "g = S Q(g) + g_ext + g_rigid(Q), solved by Newton to 1e-12 m"),
        Equation("2.4", "journal bearing", "W = η ω (D/2) L³ / (4 c²) · ε / (1 − ε²)² · √(π² (1 − ε²) + 16 ε²)"),
        Equation("2.5", "coupling's friction", "F = τ F_max,  M_f = M_f0 cos(π τ / 2)"),
        Equation("2.7", "thermal lead", "gap = −(ε_1 s_C + tan β_b ∫ ε_1 + ε_2 (N − s_C) − tan β_b ∫ ε_2)"),
    ),
    misprints=(
        Misprint("coupling", "full thrust and full moment", "one or the other", "friction spent axially does not tilt"),
    ),
    limits=(
        "Shafts follow the mean load: the mesh frequency is far above bending and film frequencies.",
        "Journal bearings are short ones with a π film: too stiff above L/D 0.7 (warned); others as linear stiffness.",
        "The wall response (metal rise over gas rise) is an assumption until it is measured.",
        "No dynamics, no unbalance, rigid housing; offsets of bearings may be given instead.",
    ),
)
