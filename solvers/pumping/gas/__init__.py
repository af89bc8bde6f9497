"""Quasi-one-dimensional gas dynamics of a tooth space; modules in order: riemann, leakage -> step -> gas_dynamics."""
