"""Involute geometry of external parallel-axis gear pairs, spur and helical, with the same checks for all models.

The data flow through the modules in this order: inputs -> gear (radii, involute, root fillet) -> pair (working
geometry, path of contact). `checks` refuses gear pairs that cannot mesh; `notices` warns of unfavourable gear pairs.
"""
