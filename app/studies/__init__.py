"""Studies: one request solved at many points.

requests     the bodies, and examples of them
fields       single values of requests and answers by their dotted paths
points       the request that a study varies, and the solution of its points in a worker
point_sets   which points: a grid, a list of cases, a random sample, the usual corners of a gear unit
engine       what all studies share: the declaration of a kind, points solved in order in chunks on a pool of
             processes, lines with progress
probability  statistics of samples, and probabilities of exceeding limits
sweep, sensitivity, spectrum, design
             the kinds of study; corners are a sweep
admission    how many studies run at once, and on which processes
cluster      a Dask cluster instead of the service's own processes
"""
