"""Involute geometry of external parallel-axis gear pairs, spur and helical: one verdict for every model.

Data flows inputs -> gear (radii, involute, root fillet) -> pair (working geometry, path of contact). `checks` refuses
pairs that cannot mesh, `notices` warns of poor ones.
"""
