"""One module per kind of study, with its request, its points, its last lines and its page.

sweep           one or two fields varied, a list of cases, or a random sample
sensitivity     the inputs that change an output most
spectrum        a load spectrum with tolerances: probabilities and losses
corners         the worst combination of uncertain inputs
design          the flank correction that gives the best result at the worst corner

The service finds a module by the name `PAGE` in the module. `PAGE` is a `StudyPage`, and its attribute `plan` is the
class of the study. There is no list of the modules.
"""
