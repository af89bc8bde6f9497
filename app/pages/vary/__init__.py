"""A case with one field or two varied, on a page that grows while its points are calculated.

wish       what the query asks: which fields, from where to where, which output
choices    what can be varied and shown, and where a range starts and ends when nothing is said
gathered   the points that have come so far, as a figure's data
views      the page before and after its figures, the figures, files; made in workers
"""
