"""Studies: one request solved at many points.

requests    the bodies of requests for studies, and examples
fields      functions that find, check, read and set a single value of a request or answer by its dotted path
points      the request that a study varies, and the solution of the study's points in a worker
point_sets  sets of points: a grid, a list of cases, a random sample, the usual corners of a gear unit
runner      the common parts of all studies: the base class of the kinds of study, the solution of the points in chunks
            on a pool of processes, and the lines that report the progress
statistics  statistics of samples, and probabilities of exceeding limits
kinds       one module per kind of study
admission   the limit on the number of studies that run at once, and the choice of the processes that solve the points
cluster     a Dask cluster that solves the points instead of the service's own processes
"""
