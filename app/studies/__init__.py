"""Studies: one request solved at many points.

requests      the bodies
fields        single values of requests and answers by their dotted paths
point_sets    which points: a grid, a list of cases, a random sample
points        the solution of points, in a worker
engine        chunks of points on a pool of processes, answered in order
base_request  the request that a study varies, and the checks of paths and values
study         what all studies share: first line, solving
sweep, sensitivity, spectrum, design
              the kinds of study; corners are a sweep
summary       counts, extremes, best point, statistics of a sample
distributions, probability
              random values of fields, and probabilities of exceeding limits
minimax       the search of a design
drive_train   uncertain inputs of a gear unit
stream        lines with progress between them, as JSON or as a table
admission     how many studies run at once, and on which processes
cluster       a Dask cluster instead of the service's own processes
"""
