"""What may be asked: the bodies of the HTTP contract, converted to SI for the solvers."""
