"""The kinds of study, one per module, each with its request and its answer.

sweep           the results over a grid of field values, at a list of cases, or at a random sample
solve_for       the value of an input at which an output has a wanted value, or is least or greatest
sensitivity     the inputs that change an output most
spectrum        probabilities of exceeding limits, and losses, for a load spectrum with tolerances
corners         the results at all combinations of the uncertain inputs
design          the flank correction that gives the best result at the worst corner
"""

from app.studies.kinds.corners import Corners
from app.studies.kinds.design import Design
from app.studies.kinds.sensitivity import Sensitivity
from app.studies.kinds.solve_for import SolveFor
from app.studies.kinds.spectrum import Spectrum
from app.studies.kinds.sweep import Sweep
from app.studies.runner import Study

KINDS: tuple[type[Study], ...] = (Sweep, SolveFor, Sensitivity, Spectrum, Corners, Design)
"""The kinds of study, in the order of their endpoints."""
