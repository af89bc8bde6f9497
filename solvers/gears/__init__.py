"""Involute geometry of external gear pairs with parallel axes, spur and helical. All models use the same geometry.

The data flow through the modules in this order: inputs -> gear (radii, involute, root fillet) -> pair (working
geometry, path of contact). `checks` refuses gear pairs that cannot mesh; `notices` warns of unfavourable gear pairs.
"""
