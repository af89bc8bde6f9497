"""Processes that calculate: admission, a pool of workers, and the fork server that starts them in milliseconds.

template     one warmed, single-threaded process; copies of it are the workers
worker       what a copy does: one call after the other
compiler     what other copies do on the first start
fork_server  the service's end of the template
pool         who calculates what; a worker that is late, unwanted, dead or stopped is replaced
admission    how many may wait, how long, and for whom

Why not a ready-made pool. `multiprocessing`'s fork server loads its modules once, before anything can be forked, and
cannot be told later that more kernels are ready. `ProcessPoolExecutor` and loky give up all calls when one worker
dies. pebble's workers share one channel behind a lock; a worker that is killed or stopped while it holds the lock
blocks all others. Here each worker has a socket of its own, and the copy is what it always was: `os.fork`.
"""
