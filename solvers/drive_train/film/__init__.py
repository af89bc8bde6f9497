"""The film of plain bearings: Reynolds' equation, its solutions over eccentricity and width, and their splines.

`reynolds` solves the equation, `table` keeps the solutions, and `law` interpolates them.
"""
