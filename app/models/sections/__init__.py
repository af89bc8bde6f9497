"""Sections that the requests of several models have: gears and materials, oil, cooling."""
