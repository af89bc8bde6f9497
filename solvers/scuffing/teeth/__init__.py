"""How a pair of teeth yields: compliance of one tooth -> stiffness of two in contact."""
