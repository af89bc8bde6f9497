"""Many units instead of one: variation, outcome -> corners -> design; sensitivity; tolerances."""
