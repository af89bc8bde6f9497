"""The heat in a film, column by column: balance -> elimination."""
