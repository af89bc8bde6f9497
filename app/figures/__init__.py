"""Figures: a declaration turns a request and its answer into data, one place draws the data."""
