"""The web service: validates input, converts units, runs the solvers and answers."""
