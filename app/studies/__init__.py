"""Studies: one request solved at many points.

requests    the bodies of requests for studies, and examples
fields      single values of requests and answers by their dotted paths
points      the request that a study varies, and the solution of its points in a worker
point_sets  sets of points: a grid, a list of cases, a random sample, the usual corners of a gear unit
runner      the common parts of all studies: the declaration of a kind of study, the solution of the points in chunks on
            a pool of processes, and the lines with the progress
statistics  statistics of samples, and probabilities of exceeding limits
kinds       one module per kind of study
admission   the limit on the number of studies that run at once, and the processes that solve their points
cluster     a Dask cluster instead of the service's own processes
"""
