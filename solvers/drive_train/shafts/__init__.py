"""Elastic parts: frame, shaft, bearings, coupling_loads -> thrust_budget -> influence (their flexibility matrix)."""
