"""Temperatures of the contact.

The main modules, in the order of the calculation: practice and blok; temperatures; thermal_path; verdict.
"""
