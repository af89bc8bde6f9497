"""Involute geometry of external parallel-axis gear pairs, spur and helical."""
