"""Micropitting and mild wear: inputs -> oil, film, mean_values -> standard (method B), local (method A), wear -> check.

The formulas are those of ISO/TR 15144-1:2014, today ISO/TS 6336-22, read in a public implementation.
"""
