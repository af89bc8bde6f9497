"""Figures of all models. These modules compute the data of the figures, but do not draw."""
