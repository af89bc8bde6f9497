"""Studies: one request solved at many points. `study` solves one in a script; over HTTP, `app.http` does.

requests    the bodies of requests for studies, and examples
fields      functions that find, check, read and set a single value of a request or answer by its dotted path
points      the request that a study varies, and the solution of the study's points in a worker
point_sets  sets of points: a grid, a list of cases, a random sample, the usual corners of a gear unit
oil_tests   whose oil a load stage belongs to: the limits that are held, the oils that bring stages of their own
tolerances  the tolerances of a gear pair by its quality class
search      where an output has a value or is extreme along one input, asked step by step
runner      the base class of the kinds of study, the solution of the points in chunks, the lines about the progress
uncertainty how well the models are known, as distributions
machines    the machines of a gear unit, drawn at random
price       how probable damage is by quality class, for one correction
statistics  statistics of samples, and probabilities of exceeding limits
kinds       one module per kind of study
kept        the points of former runs in a file
script      a study on any `map`
"""

from app.errors import OtherSources, PoolLost
from app.studies.script import Run, study

__all__ = ["OtherSources", "PoolLost", "Run", "study"]
