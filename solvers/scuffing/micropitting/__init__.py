"""Micropitting and mild wear of the flanks.

The calculation uses the modules in this order: oil, film and mean_values; standard (method B), local (method A) and
wear; check. The formulas are those of ISO/TR 15144-1:2014 (today ISO/TS 6336-22). They were taken from a public
implementation of this standard.
"""
