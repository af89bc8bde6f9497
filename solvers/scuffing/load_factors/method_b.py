"""Load factors of the standard: K_v and K_Halpha by method B of ISO 6336-1, K_Hbeta of the load distribution.

ISO 6336-1:2006, clauses 6 and 8, and the tolerances of ISO 1328-1:2013, all taken from a public implementation.
"""

from math import cos, pi, sin, sqrt
from typing import NamedTuple

from solvers.gears.pair import PathOfContact
from solvers.gears.tolerances import single_pitch
from solvers.scuffing.inputs import LoadDistributionInputs, ScuffingInputs, StandardFactors, grade_in_force
from solvers.scuffing.load_factors.results import FilmGrade, LoadFactors, StandardGrade
from solvers.scuffing.mesh_results import StandardStiffness, standard_stiffness
from solvers.scuffing.results import LoadDistribution

MM, UM, STIFFNESS = 1e-3, 1e-6, 1e9  # m, m, Pa per N/(mm um)
RUNNING_IN_SHARE, LARGEST_RUNNING_IN = 0.075, 3.0  # y_alpha = 0.075 f <= 3 um of case-hardened and nitrided flanks
RUN_IN_RELIEF = (1500.0 / 97.0 - 18.45) ** 2 / 18.0 + 1.5  # um, C_ay of case-hardened flanks, sigma_Hlim 1500 N/mm^2
COARSE_GRADE = 6  # from this grade on, tip relief does not lower the dynamic factor
LIGHT_LOAD = 100.0  # N/mm


class Deviations(NamedTuple):
    """Base pitch and profile form deviations after running in, of the gear with the larger ones [um]."""

    base_pitch: float
    profile_form: float


def deviations(path: PathOfContact, grade: int) -> Deviations:
    """Deviations that count in K_v and K_Halpha (Eq. T1): tolerances of ISO 1328-1:2013 less the running-in allowance.

    f_pT = (0.001 d + 0.4 m_n + 5) 2^((A - 5)/2), f_falphaT = (0.55 m_n + 5) 2^((A - 5)/2), not rounded.
    """
    pair = path.pair
    module, step = pair.inputs.normal_module / MM, 2.0 ** ((grade - 5) / 2)
    diameter = 2 * max(pair.pinion.reference_radius, pair.wheel.reference_radius) / MM
    base_pitch = single_pitch(diameter, module) * step * cos(pair.transverse_pressure_angle)
    form = (0.55 * module + 5.0) * step
    return Deviations(*(value - min(RUNNING_IN_SHARE * value, LARGEST_RUNNING_IN) for value in (base_pitch, form)))


def nominal_line_load(given: LoadDistributionInputs, path: PathOfContact) -> float:
    """Line load K_A K_gamma F_t/b at the reference circle [N/mm]."""
    load = given.load
    torque = load.helix_torque * load.application_factor * load.mesh_load_factor
    return torque / path.pair.pinion.reference_radius / given.gears.face_width * MM


def stiffness_of(given: LoadDistributionInputs, path: PathOfContact) -> StandardStiffness:
    """Stiffness of teeth and mesh by ISO 6336-1 under the load of the pair [Pa]."""
    moduli = given.pinion_material.youngs_modulus, given.wheel_material.youngs_modulus
    load = nominal_line_load(given, path) / MM
    return standard_stiffness(path, load, 2 * moduli[0] * moduli[1] / sum(moduli))


def standard_grade(inputs: ScuffingInputs) -> StandardGrade:
    """Return the quality grade of the checks by the standard."""
    return StandardGrade(grade_in_force(inputs.standard.quality_grade, inputs.distribution.gears))


def film_grade(inputs: ScuffingInputs) -> FilmGrade | None:
    """Return the quality grade of method B against micropitting; None if it is not checked."""
    check = inputs.micropitting
    return None if check is None else FilmGrade(grade_in_force(check.quality_grade, inputs.distribution.gears))


def factors_of(inputs: ScuffingInputs, distribution: LoadDistribution) -> LoadFactors:
    """Return the load factors of the standard for the load distribution of the pair."""
    computed = distribution.load.face_load_factor or 1.0
    return load_factors(inputs.distribution, distribution.path_of_contact, inputs.standard, computed)


def load_factors(
    given: LoadDistributionInputs, path: PathOfContact, asked: StandardFactors, computed_face_factor: float
) -> LoadFactors:
    """Load factors of the checks by the standard; what is given wins over method B and over the computed K_Hbeta."""
    ratio, grade = resonance_ratio(given, path), grade_in_force(asked.quality_grade, given.gears)
    dynamic = asked.dynamic_factor
    if dynamic is None:
        dynamic = given.load.dynamic_factor
        if dynamic == 1.0:
            dynamic = dynamic_factor(given, path, grade, ratio)
    face = computed_face_factor if asked.face_load_factor is None else asked.face_load_factor
    transverse = asked.transverse_load_factor
    if transverse is None:
        transverse = transverse_load_factor(given, path, grade, dynamic * face)
    line_load = nominal_line_load(given, path) * dynamic * face * transverse
    return LoadFactors(dynamic, ratio, transverse, face, line_load / MM)


def resonance_ratio(given: LoadDistributionInputs, path: PathOfContact) -> float:
    """Resonance ratio N = n_1/n_E1 of two solid discs (Eq. T2)."""
    pair, stiffness = path.pair, stiffness_of(given, path).mesh / STIFFNESS
    bodies = (pair.pinion, given.pinion_material.density), (pair.wheel, given.wheel_material.density)
    (first, density_1), (second, density_2) = sorted(bodies, key=lambda body: body[0].teeth)
    mean = (first.tip_radius + first.root_radius) / MM
    inverse = 1.0 / density_1 + 1.0 / (density_2 * (second.teeth / first.teeth) ** 2)  # of 1e-9 kg/mm^3
    reduced_mass = pi / 8 * (mean / (2 * first.base_radius / MM)) ** 2 * mean**2 / inverse * 1e-9  # kg/mm
    resonance = 30e3 / (pi * first.teeth) * sqrt(stiffness / reduced_mass)  # 1/min
    speed = given.load.pinion_speed * pair.pinion.teeth / first.teeth
    return speed * 30 / pi / resonance


def dynamic_factor(given: LoadDistributionInputs, path: PathOfContact, grade: int, ratio: float) -> float:
    """Internal dynamic factor K_v by method B of ISO 6336-1 at the resonance ratio N (Eq. T3); 1 without load.

    Below the main resonance 1 + N K, there and above it by its own formulas, linear between N = 1.15 and 1.5.
    """
    load = nominal_line_load(given, path)
    if load <= 0.0:
        return 1.0
    single, total = stiffness_of(given, path).single / STIFFNESS, path.total_contact_ratio
    off = deviations(path, grade)
    reliefs = given.modifications.tip_relief, given.modifications.root_relief
    relief = max(min(reliefs) / UM, RUN_IN_RELIEF)
    pitch, form = single * off.base_pitch / load, single * off.profile_form / load  # B_p, B_f
    relieved = 1.0 if grade >= COARSE_GRADE else abs(1.0 - single * relief / load)  # B_k
    many = total > 2.0
    c_2 = 0.57 / (total - 0.3) if many else 0.34
    c_3 = 0.096 / (total - 1.56) if many else 0.23
    c_4 = (0.57 - 0.05 * total) / (total - 1.44) if many else 0.90
    c_6 = 0.12 / (total - 1.74) if many else 0.47
    c_7 = 0.75 if total <= 1.5 else 0.125 * sin(pi * (min(total, 2.5) - 2.0)) + 0.875
    at_resonance = 1.0 + 0.32 * pitch + c_2 * form + c_4 * relieved
    above = 0.47 * pitch + c_6 * form + c_7
    main_from = 0.85 if load >= LIGHT_LOAD else 0.5 + 0.35 * sqrt(load / LIGHT_LOAD)
    if ratio <= main_from:
        return 1.0 + ratio * (0.32 * pitch + c_2 * form + c_3 * relieved)
    if ratio <= 1.15:
        return at_resonance
    share = min((ratio - 1.15) / 0.35, 1.0)
    return max(at_resonance + share * (above - at_resonance), 1.0)


def transverse_load_factor(
    given: LoadDistributionInputs, path: PathOfContact, grade: int, dynamic_and_face: float
) -> float:
    """Transverse load factor K_Halpha by method B of ISO 6336-1 (Eq. T4); `dynamic_and_face` is K_v K_Hbeta.

    At least 1, at most eps_gamma/(eps_alpha Z_eps^2); without load this largest value.
    """
    along, total = path.transverse_contact_ratio, path.total_contact_ratio
    overlap = min(path.overlap_ratio, 1.0)
    contact = (4.0 - along) / 3.0 * (1.0 - overlap) + overlap / along  # Z_eps^2
    largest = max(total / (along * contact), 1.0) if contact > 0.0 else 1.0
    load = nominal_line_load(given, path) * dynamic_and_face
    if load <= 0.0:
        return largest
    off = deviations(path, grade)
    excess = stiffness_of(given, path).mesh / STIFFNESS * max(off) / load
    factor = total / 2 * (0.9 + 0.4 * excess) if total <= 2.0 else 0.9 + 0.4 * sqrt(2 * (total - 1) / total) * excess
    return min(max(factor, 1.0), largest)
