"""One module per kind of study, with its request, its points, its last lines and its page.

sweep           one or two fields varied, a list of cases, or a random sample
sensitivity     the inputs that move an output most
spectrum        a load spectrum with tolerances: probabilities and losses
corners         the worst combination of uncertain inputs
design          the flank correction whose worst corner is best

The service finds a module by its `PAGE`, a `StudyPage` whose `plan` is the study; there is no list of the modules.
"""
