"""Worker processes that calculate, on AnyIO's worker processes.

pool      which call a free worker gets; a worker that is lost or hangs is replaced
worker    what runs in a worker: its preparation, and calls
stages    the examples that compile every kernel, in the order in which endpoints open
start_up  compiles stage after stage in other processes while the workers answer
"""
