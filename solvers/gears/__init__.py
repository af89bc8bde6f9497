"""Involute geometry of external gear pairs, spur or helical, with parallel axes. All models use the same geometry.

Data pass through the modules in this order: inputs -> gear (radii, involute, root fillet) -> pair (working
geometry, path of contact). `checks` refuses gear pairs that cannot mesh; `notices` warns of unfavourable gear pairs.
"""
