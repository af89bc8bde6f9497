"""Scuffing by the standard, beside the local check: flash temperature method and integral temperature method.

The calculation uses the modules in this order: mesh (under the `load_factors` of ISO 6336-1), flash, integral, check.
The formulas are those of ISO/TR 13989-1 and -2, today ISO/TS 6336-20 and -21, taken from a public implementation. All
of them are in the units of the standard: N, mm, m/s, um, mPa s.
"""
