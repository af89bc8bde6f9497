"""The lubricated line contact: pressure, film, temperature and friction, isothermal or thermal.

Data pass through the modules in this order: inputs, checks -> problem, grid, linear_algebra -> shear -> rheology ->
flow -> reynolds, heat -> state -> temperature -> newton -> continuation -> measures, refinement -> results, notices.
`model.solve` solves one contact, `path.solve_path` a sequence of contacts.
`tests/support/line_contact_equations.py` states the discrete problem in plain NumPy; the kernels are compared with it.
"""

from solvers.contact.ehl import model
from solvers.contact.ehl.checks import check, lightest
from solvers.contact.ehl.inputs import Contact, LineContactInputs, Model, Rheology, Temperatures
from solvers.contact.ehl.model import warm_up
from solvers.contact.ehl.notices import unusual_values
from solvers.contact.ehl.path import solve_path
from solvers.contact.ehl.results import LineContactResult, Stage
from solvers.guards import guarded
from solvers.lubricants import Lubricant

solve = guarded(model.solve, unusual_values)

__all__ = [
    "Contact",
    "LineContactInputs",
    "LineContactResult",
    "Lubricant",
    "Model",
    "Rheology",
    "Stage",
    "Temperatures",
    "check",
    "lightest",
    "solve",
    "solve_path",
    "warm_up",
]
