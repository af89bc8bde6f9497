"""Load distribution of helical gears with modifications and misalignment, and their scuffing safety.

Data flows gears.path_of_contact -> contact_lines -> tooth_compliance -> tooth_stiffness, modification -> loaded_zones
-> contact_slices -> position_balance -> load_balance -> mesh_stiffness, transmission_error, friction_loss, flank,
face_load, load_sharing, feature_line (all gathered by `model.solve`) -> safety.

Source: Xue, Zhang, Wang, "The Load Distribution with Modification and Misalignment and Thermal Elastohydrodynamic
Lubrication Simulation of Helical Gears", Global J. of Researches in Engineering A 20(1), 2020 ("the paper").
"""

from solvers.scuffing.model import solve as solve_load_distribution
from solvers.scuffing.safety import solve_scuffing

__all__ = ["solve_load_distribution", "solve_scuffing"]
