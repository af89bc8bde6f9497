"""Quasi-one-dimensional gas dynamics: riemann, leakage -> cells -> step -> books -> march -> gas_dynamics."""
