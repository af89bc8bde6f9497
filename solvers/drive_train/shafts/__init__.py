"""The elastic parts of a unit.

`frame` gives the directions of the forces. `shaft`, `bearings` and `coupling_loads` model the parts, and
`thrust_budget` computes the axial forces. `influence` joins all parts into one flexibility matrix.
"""
