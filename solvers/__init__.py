"""Published models of the tribology of high-speed drive trains: SI numbers in, SI results out."""
