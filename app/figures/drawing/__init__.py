"""Draws a figure's data with matplotlib: `style` has colours and fonts, `panels` fills axes, `image` writes files."""
