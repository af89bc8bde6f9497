"""Temperatures of the contact.

The calculation uses the main modules in this order: practice and blok; temperatures; thermal_path; verdict.
"""
