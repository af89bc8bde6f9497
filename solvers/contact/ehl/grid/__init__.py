"""Where a contact is computed: deflection, heat_matrix -> mesh; and dense, the algebra on it."""
