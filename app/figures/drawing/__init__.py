"""Draws the data of a figure with matplotlib: `style` its look, `panels` what stands in axes, `image` the sheet."""
