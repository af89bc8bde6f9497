"""Data of the figures for the answers of all models, without any drawing."""
