"""Friction on the teeth: lubrication -> regimes; sums -> averaging -> losses."""
