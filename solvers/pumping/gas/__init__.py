"""Quasi-one-dimensional gas dynamics of a tooth space: riemann, leakage -> step -> gas_dynamics."""
