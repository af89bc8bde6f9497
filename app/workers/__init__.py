"""Worker processes that calculate: who gets one, how they are started and replaced, and the first start.

stages     what is compiled and loaded one after the other
processes  the template, which loads everything once and is forked, and its copies, the workers
pool       which call gets the next worker, is refused or interrupted; carries out calls of single requests and of
           studies; a worker that dies, stops or is not wanted any more is replaced
start_up   compiles and loads stage after stage while the port is open

multiprocessing's own fork server loads modules before its first fork only, and blocks when it is stopped, so the
template is ours. The pools of concurrent.futures, loky and pebble were tried: a dead or stopped worker costs other
callers their results or blocks them.
"""
