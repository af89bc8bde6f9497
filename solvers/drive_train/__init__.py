"""A gear unit whole: coupling, shafts in bearings, pumped heat and mesh agree on one gap over the face.

Data flows inputs, checks -> frame -> shaft, bearings, coupling_loads -> influence (one system by its ports),
thermal_lead -> balance -> misalignment, elements, thrust_budget, safety, losses (all gathered by `model.solve`, for
the hot unit and the cold one by `states.solve`).
Studies on top: corners, sensitivity, tolerances, design. Own derivation; sources stand with the equations.
"""

from solvers.drive_train.states import solve

__all__ = ["solve"]
