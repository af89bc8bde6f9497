"""What yields: frame, shaft, bearings, coupling_loads -> thrust_budget -> influence, one system with few ports."""
