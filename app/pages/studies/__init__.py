"""Pages of studies, each below that of the case.

declaration     what is declared of a study's page, what it shows, the addresses of its views and points
sweep           one field or two varied
spectrum        a load spectrum with tolerances: probabilities and losses
sensitivity     which input moves an output most
corners         the worst combination of uncertain inputs
design          the flank correction whose worst corner is best
page            the page of each of these before, during and after the calculation; made in workers
"""
