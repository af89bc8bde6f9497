"""Studies with a page each below that of the case: what is asked, how its lines are shown.

declaration  what such a study is, and what its page shows: figures, tables, links
influence    which input moves an output most
corners      where an output is worst, over every combination of what nobody knows better
design       which correction of the flank is best where it is worst
page         the page before and after its figures, the figures, files; made in workers
"""
