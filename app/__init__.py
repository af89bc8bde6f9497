"""The web service, which validates the input, converts units, runs the solvers and returns answers."""
