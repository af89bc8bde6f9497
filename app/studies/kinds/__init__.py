"""The kinds of study, one per module.

A module defines the request, the answer and the page of its study.

sweep           the results over a grid of field values, at a list of cases, or at a random sample
sensitivity     the inputs that change an output most
spectrum        probabilities of exceeding limits, and losses, for a load spectrum with tolerances
corners         the results at all combinations of the uncertain inputs
design          the flank correction that gives the best result at the worst corner

The service uses every module of this package, so a new module need not be registered. Each module must have a class
`PAGE`, a subclass of `StudyPage`. The attribute `plan` of `PAGE` is the class of the study.
"""
