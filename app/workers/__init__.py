"""Worker processes for the calculations, based on the worker processes of AnyIO, and those of a Dask cluster.

pool      the queue of calls, and the workers, which are replaced if they are lost or hang
worker    the functions that run in a worker: the preparation of the worker, and the calls
start_up  the compilation of the stages in other processes while the workers answer
cluster   kernels for the workers of a Dask cluster, and the service's connection to one
"""
