"""Gear units from REXS files: read, turned into requests, and given their results back."""
