"""Which crowning suits a range of misalignment: window -> recommendation -> results."""
