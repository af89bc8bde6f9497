"""Published models of the tribology of high-speed drive trains; all inputs and results are in SI units."""
