"""One module per kind of study, with its request, its points, its conclusion and its page.

sweep           one field or two varied, a list of cases, or a random sample
sensitivity     which input moves an output most
spectrum        a load spectrum with tolerances: probabilities and losses
corners         the worst combination of uncertain inputs
design          the flank correction whose worst corner is best

Every module here is a study of the service by its `PAGE`, a `StudyPage` with its `plan`; no list names the modules.
"""
