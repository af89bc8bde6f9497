"""Studies: one request solved at many points.

requests      the bodies, and examples of them
fields        single values of requests and answers by their dotted paths
point_sets    which points: a grid, a list of cases, a random sample, the usual corners of a gear unit
points        the solution of points, in a worker
engine        what all studies share: points solved in order in chunks on a pool of processes, the first line
base_request  the request that a study varies, and the checks of paths and values
sweep, sensitivity, spectrum, design
              the kinds of study; corners are a sweep
summary       counts, extremes, best point, statistics of a sample
distributions, probability
              random values of fields, and probabilities of exceeding limits
minimax       the search of a design
stream        lines with progress between them, as JSON or as a table
admission     how many studies run at once, and on which processes
cluster       a Dask cluster instead of the service's own processes
"""
