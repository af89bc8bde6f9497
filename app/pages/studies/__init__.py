"""Pages of studies, each below that of the case.

declaration     what is declared of a study's page, what it shows, the addresses of its views and points
sensitivity     which input moves an output most
corners         the worst combination of uncertain inputs
design          the flank correction whose worst corner is best
page            the page of these three, before and after its figures; made in workers
sweep_query     the sweep that a query asks for
sweep_form      its form
sweep           its page, whose figures are drawn while the points come
sweep_examples  sweeps to start from
"""
