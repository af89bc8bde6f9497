"""Involute geometry of external parallel-axis gear pairs, spur and helical: one verdict for every model.

Data flows inputs -> gear -> pair -> path_of_contact (the usable flank); `checks` refuses what cannot mesh, `notices`
says what a pair that does is short of; fillet is the root below the involute.
"""
