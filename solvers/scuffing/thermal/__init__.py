"""Temperatures of the contact.

The calculation uses the modules in this order: practice, blok and flank; pair_heat; temperatures; thermal_path;
verdict.
"""
