"""Load factors of the standard, for the checks by the standard of scuffing and micropitting."""
