"""Studies: one request solved at many points.

requests     the bodies of requests for studies, and examples
fields       single values of requests and answers by their dotted paths
points       the request that a study varies, and the solution of its points in a worker
point_sets   sets of points: a grid, a list of cases, a random sample, the usual corners of a gear unit
engine       the common parts of all studies: the declaration of a kind, points solved in order in chunks on a pool of
             processes, lines with progress
probability  statistics of samples, and probabilities of exceeding limits
sweep, sensitivity, spectrum, design
             the kinds of study; corners are a sweep
admission    the limit on studies that run at once, and the processes that they run on
cluster      a Dask cluster instead of the service's own processes
"""
