"""Worker processes of every kind of work, threads, and the budget of cores that they share.

``ProcessPoolExecutor`` does not serve: one killed process ends all calls of the pool, and its own call is not
named; a process that is killed while it writes a result blocks the pool; a call cannot be interrupted; and
every process runs a script without ``if __name__ == "__main__"`` once more.
"""
