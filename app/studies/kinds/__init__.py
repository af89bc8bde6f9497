"""One module for each kind of study: its request, its points, its conclusion, and its page.

sweep           one field or two varied, a list of cases, or a random sample
sensitivity     which input moves an output most
spectrum        a load spectrum with tolerances: probabilities and losses
corners         the worst combination of uncertain inputs
design          the flank correction whose worst corner is best

A module here that has a `PAGE`, a `StudyPage` with its `plan`, is a study of the service; nothing else names it.
"""
