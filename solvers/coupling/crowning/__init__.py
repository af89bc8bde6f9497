"""Which crowning suits a range of misalignment: recommendation -> results."""
