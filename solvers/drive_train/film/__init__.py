"""The film of plain bearings: Reynolds' equation, its solutions over eccentricity and width, and their splines.

`reynolds` solves the equation, `table` keeps the solutions, and `law` interpolates them.
"""

from solvers.drive_train.film.law import WIDEST, FilmLaw, FilmPoint, eccentricity_at, film_at, film_law
from solvers.drive_train.film.table import LARGEST_ECCENTRICITY

__all__ = ["LARGEST_ECCENTRICITY", "WIDEST", "FilmLaw", "FilmPoint", "eccentricity_at", "film_at", "film_law"]
