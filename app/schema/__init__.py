"""What the fields of requests and answers mean: units, quantities, names, and how they meet the solvers' SI."""
